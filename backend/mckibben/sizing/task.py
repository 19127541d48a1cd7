"""The task of a drive in SI: load, stroke, times and limits."""

from __future__ import annotations

from dataclasses import dataclass, field
from math import sin

import numpy as np

from mckibben.facts.sizing import FILL_TIMES, SHORTEST_FILL, UNTIMED_FILL
from mckibben.facts.sizing import STATIONS as COMPARED
from mckibben.facts.task import usual
from mckibben.physics.errors import InputError
from mckibben.physics.units import GRAVITY

#: Shares of the stroke at which load and muscle are compared.
STATIONS = np.linspace(0.0, 1.0, COMPARED)
#: Pulley radii tried when the task does not fix one [m].
_RADII = (0.01, 0.015, 0.02, 0.03, 0.04, 0.06, 0.08, 0.12)


@dataclass(frozen=True, slots=True)
class Pair:
    """An antagonist pair on a pulley: swing [rad], torque against it [N m], inertia [kg m^2], radius [m]."""

    angle: float
    torque: float = 0.0
    inertia: float = 0.0
    pulley_radius: float | None = None


@dataclass(frozen=True, slots=True)
class DesignLimits:
    """Limits of a drive; None = no such limit.

    Attributes:
        max_contraction: contraction ratio at the end of the stroke.
        force_reserve: share by which the static force must exceed the load everywhere on the stroke.
        pressure_reserve: share of the supply pressure kept in reserve.
        max_length, end_fittings: installed length, and the length of both end fittings within it [m].
        max_diameter: largest outside diameter, at the end of the stroke [m].
        max_parallel: largest number of parallel muscles (on each side of a pair).
        max_impact_energy: impact energy at either end stop that costs no rank [J].
        stiffness: least stiffness at the load at the end of the stroke, valve open [N/m].
        life: least number of load cycles.
    """

    max_contraction: float = usual("limits.max_contraction")
    force_reserve: float = usual("limits.force_reserve")
    pressure_reserve: float = usual("limits.pressure_reserve")
    max_length: float = usual("limits.max_length")
    end_fittings: float = usual("limits.end_fittings")
    max_diameter: float | None = None
    max_parallel: int = int(usual("limits.max_parallel"))
    max_impact_energy: float | None = None
    stiffness: float | None = None
    life: float | None = None


@dataclass(frozen=True, slots=True)
class Uncertainty:
    """How far a built drive may differ from the computed one.

    Attributes:
        blocked_force: two standard deviations of the blocked force between specimens, as a share of it.
        hysteresis: largest width of the loop as a contraction ratio; None = that of the muscle.
        supply_pressure: largest deviation of the supply pressure, as a share of it.
        specimens: number of specimens simulated for each proposal.
    """

    blocked_force: float = usual("uncertainty.blocked_force")
    hysteresis: float | None = None
    supply_pressure: float = usual("uncertainty.supply_pressure")
    specimens: int = int(usual("uncertainty.specimens"))


@dataclass(frozen=True, slots=True)
class Task:
    """A task; SI, pressures gauge, strokes and forces at the load.

    Attributes:
        force_over_stroke: additional force against the pull as (strokes, forces), linear in between.
        counterweight: mass on the other side of a pulley that pulls with the muscle [kg].
        lever_ratio: stroke of the muscle per stroke of the load.
        time, time_down, cycle_time: required times [s]; None = not required.
    """

    stroke: float = 0.0
    mass: float = 0.0
    inclination: float = usual("load.inclination")
    force: float = 0.0
    force_over_stroke: tuple[tuple[float, ...], tuple[float, ...]] = ((), ())
    spring: float = 0.0
    counterweight: float = 0.0
    lever_ratio: float = 1.0
    pair: Pair | None = None
    time: float | None = None
    time_down: float | None = None
    cycle_time: float | None = None
    supply_pressure: float = usual("supply_pressure")
    temperature: float = usual("ambient_temperature")
    limits: DesignLimits = field(default_factory=DesignLimits)
    uncertainty: Uncertainty = field(default_factory=Uncertainty)
    rank_by: str = "balanced"
    max_proposals: int = int(usual("max_proposals"))

    @property
    def robust(self) -> bool:
        """Whether a margin to each limit, for the tolerances of specimens, is part of what it ranks by."""
        return self.rank_by in ("balanced", "probability")

    @property
    def available_pressure(self) -> float:
        """Supply pressure less the reserve [Pa]."""
        return self.supply_pressure * (1.0 - self.limits.pressure_reserve)

    @property
    def fill_time(self) -> float:
        """Duration of the fill [s]: longer than the required time, to see whether the load stays."""
        whole = _least(self.time, self.cycle_time)
        return UNTIMED_FILL if whole is None else _held(whole)

    @property
    def vent_time(self) -> float:
        """Duration of the venting after it [s]."""
        whole = _least(self.time_down, self.cycle_time)
        return self.fill_time if whole is None else _held(whole)

    @property
    def returns(self) -> bool:
        """Whether the return stroke is timed."""
        return self.time_down is not None or self.cycle_time is not None

    @property
    def suspended_mass(self) -> float:
        """Mass whose weight the muscles carry, at the load [kg]; 0 for a pair."""
        if self.pair is not None:
            return 0.0
        return max(self.mass * sin(self.inclination) - self.counterweight, 0.0)

    def duties(self) -> list[Duty]:
        """The duty of the muscles; one for each pulley radius to try.

        Raises:
            InputError: there is no stroke, or nothing stretches the muscle again.
        """
        if self.pair is not None:
            pair = self.pair
            radii = _RADII if pair.pulley_radius is None else (pair.pulley_radius,)
            return [
                Duty(
                    stroke=radius * pair.angle,
                    mass=pair.inertia / radius**2,
                    inclination=0.0,
                    force=pair.torque / radius,
                    profile=((), ()),
                    spring=0.0,
                    lever_ratio=1.0,
                    pulley_radius=radius,
                )
                for radius in radii
            ]
        if not self.stroke > 0.0:
            raise InputError("the task has no stroke", field="stroke", hint='e.g. "stroke": "60 mm"')
        duty = Duty(
            stroke=self.stroke,
            mass=self.mass + self.counterweight,
            inclination=self.inclination,
            force=self.force - self.counterweight * GRAVITY * (1.0 + sin(self.inclination)),
            profile=self.force_over_stroke,
            spring=self.spring,
            lever_ratio=self.lever_ratio,
        )
        if not float(duty.load(np.array([0.02 * self.stroke]))[0]) > 0.0:
            raise InputError(
                "nothing pulls the load back at the start of the stroke, and a muscle cannot push",
                field="load",
                hint="give a mass to lift, a force, a spring, or an antagonist pair",
            )
        return [duty]


@dataclass(frozen=True, slots=True)
class Duty:
    """The load on the muscles: moved mass and static force over the stroke.

    Attributes:
        force: constant force against the pull in addition to the weight of ``mass`` [N].
        pulley_radius: pulley radius of a pair [m]; the stroke is then that of the rim.
    """

    stroke: float
    mass: float
    inclination: float
    force: float
    profile: tuple[tuple[float, ...], tuple[float, ...]]
    spring: float
    lever_ratio: float
    pulley_radius: float | None = None

    @property
    def pair(self) -> bool:
        """Whether two muscles pull against each other."""
        return self.pulley_radius is not None

    @property
    def pull(self) -> float:
        """Stroke of the muscle [m]."""
        return self.stroke * self.lever_ratio

    @property
    def weight(self) -> float:
        """Weight along the stroke [N]."""
        return self.mass * GRAVITY * sin(self.inclination)

    def load(self, stroke: np.ndarray) -> np.ndarray:
        """Static force against the pull at each stroke of the load [N]; shape of ``stroke``."""
        return self.weight + self.force + self.spring * stroke + self._profile(stroke)

    def straight(self) -> tuple[float, float]:
        """Constant force [N] and spring [N/m] that are nowhere below the load's, without the weight.

        A drive has only a constant force and a spring. So this is the line with the least excess among all
        lines above the profile that do not fall.
        """
        strokes = np.array(self.profile[0])
        if not len(strokes):
            return self.force, self.spring
        inner = strokes[(strokes > 0.0) & (strokes < self.stroke)]
        at = np.unique(np.concatenate([[0.0, self.stroke], inner]))
        values = self._profile(at)
        slopes = {0.0} | {
            float((values[j] - values[i]) / (at[j] - at[i])) for i in range(len(at)) for j in range(i)
        }
        rising = [slope for slope in slopes if slope >= 0.0]
        lines = [(float(np.max(values - slope * at)), slope) for slope in rising]
        start, slope = min(lines, key=lambda line: line[0] + 0.5 * line[1] * self.stroke)
        return self.force + start, self.spring + slope

    def _profile(self, stroke: np.ndarray) -> np.ndarray:
        strokes, forces = self.profile
        return np.interp(stroke, strokes, forces) if strokes else np.zeros_like(stroke)


def _held(required: float) -> float:
    """Long enough also for the dead time of a valve and for the pressure to settle."""
    return max(FILL_TIMES * required, SHORTEST_FILL)


def _least(*times: float | None) -> float | None:
    stated = [time for time in times if time is not None]
    return min(stated) if stated else None
