"""Parts a drive may be built from, in SI, and the drive that a choice of parts gives."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

from mckibben.physics import gas
from mckibben.physics.effect import Effect
from mckibben.physics.muscle import Muscle
from mckibben.presets.fit import FitRecord
from mckibben.simulation.command.signals import Signal, signal_from
from mckibben.simulation.drive.parts import Drive, Load, Tube, Valve
from mckibben.simulation.statics.limits import MuscleLimits
from mckibben.simulation.statics.model import StaticModel
from mckibben.sizing.task import Duty, Task

Values = Mapping[str, Mapping[str, float]]


@dataclass(frozen=True, slots=True, eq=False)
class CataloguePart:
    """A muscle, valve or tube of the catalogue.

    Attributes:
        effects, values: effects it adds to the model, and their parameters.
        unverified: names of its figures that are not verified.
    """

    id: str
    effects: tuple[Effect, ...] = ()
    values: Values = ()  # type: ignore  # always given with effects
    unverified: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class MusclePart(CataloguePart):
    """A muscle of any length between ``shortest`` and ``longest`` [m].

    Attributes:
        hysteresis: largest width of the hysteresis loop as a contraction ratio.
        coldest, hottest: permitted ambient temperature [K].
        suspended_mass: largest mass that may hang freely on it [kg]; None where not known.
        extrapolated: why its force is not known from a curve; None when it is.
        fit: how its values were fitted to measurements; None where they were not.
    """

    muscle: Muscle
    limits: MuscleLimits
    shortest: float
    longest: float
    hysteresis: float = 0.0
    coldest: float | None = None
    hottest: float | None = None
    suspended_mass: float | None = None
    extrapolated: str | None = None
    fit: FitRecord | None = None


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class ValvePart(CataloguePart):
    """A switching or proportional valve; used fully open.

    Attributes:
        min_pressure, max_pressure: supply pressures it is made for, gauge [Pa]; None where not known.
    """

    valve: Valve
    min_pressure: float | None = None
    max_pressure: float | None = None


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class TubePart(CataloguePart):
    """A tube between the valve and each muscle; None = the valve is mounted on the muscle."""

    tube: Tube | None


@dataclass(frozen=True, slots=True)
class PartsCatalogue:
    """Parts that may be combined."""

    muscles: tuple[MusclePart, ...]
    valves: tuple[ValvePart, ...]
    tubes: tuple[TubePart, ...]


@dataclass(frozen=True, eq=False)
class Group:
    """A choice of parts; nominal length and pressure are still free."""

    duty: Duty
    muscle: MusclePart
    parallel: int
    valve: ValvePart
    tube: TubePart

    @cached_property
    def effects(self) -> tuple[Effect, ...]:
        """Effects of all parts; of two with the same id the later part's is used."""
        effects_by_id = {effect.id: effect for part in self._parts for effect in part.effects}
        return tuple(effects_by_id.values())

    @cached_property
    def values(self) -> dict[str, Mapping[str, float]]:
        """Parameters of the effects, by effect id."""
        return {name: parameters for part in self._parts for name, parameters in dict(part.values).items()}

    @property
    def _parts(self) -> tuple[CataloguePart, ...]:
        return (self.muscle, self.valve, self.tube)

    @property
    def muscles(self) -> int:
        """Number of muscles of the drive."""
        return self.parallel * (2 if self.duty.pair else 1)

    @property
    def conductance(self) -> float:
        """Sonic conductance of the narrowest part between supply and one muscle [m^3/(s Pa)]."""
        valve_share = self.valve.valve.fill_conductance / self.parallel
        tube = self.tube.tube
        if tube is None:
            return valve_share
        return min(
            valve_share, float(gas.tube_conductance(diameter=tube.inside_diameter, length=tube.length))
        )

    @cached_property
    def valve_share(self) -> Valve:
        """The valve of one of the parallel muscles."""
        flow, count = self.valve.valve, self.parallel
        return replace(
            flow,
            fill_conductance=flow.fill_conductance / count,
            exhaust_conductance=flow.exhaust_conductance / count,
        )

    @cached_property
    def load_share(self) -> Load:
        """The load of one of the parallel muscles."""
        duty, count = self.duty, self.parallel
        force, spring = duty.straight()
        return Load(
            mass=duty.mass / count,
            inclination=duty.inclination,
            force=force / count,
            spring=spring / count,
            lever_ratio=duty.lever_ratio,
        )

    def drive(self, task: Task, length: float, pressure: float) -> Drive:
        """The drive of one of the parallel muscles, with its share of the load and of the valve's flow.

        Equal muscles with equal shares move alike, so one drive represents all of them.

        Args:
            task: the task.
            length: nominal length [m].
            pressure: gauge pressure of the supply [Pa].
        """
        duty = self.duty
        model = StaticModel.of(self.muscle.muscle._replace(nominal_length=length), self.effects, self.values)
        model.limits = self.muscle.limits
        reach = duty.pull / length
        return Drive(
            model=model,
            valve=self.valve_share,
            load=self.load_share,
            command=command_of(task, duty),
            duration=switch_on(task, duty) + task.fill_time + task.vent_time,
            supply_pressure=pressure,
            tube=self.tube.tube,
            min_contraction=0.0,
            max_contraction=reach,
            pair=duty.pair,
            precontraction=0.5 * reach if duty.pair else 0.0,
            pulley_radius=duty.pulley_radius,
            temperature=task.temperature,
        )


def switch_on(task: Task, duty: Duty) -> float:
    """Start of the fill [s]; the second muscle of a pair is filled first."""
    return task.fill_time if duty.pair else 0.0


def command_of(task: Task, duty: Duty) -> Signal:
    """The command: fill, then vent."""
    on = switch_on(task, duty)
    return _pulse(on, on + task.fill_time)


@lru_cache(maxsize=64)
def _pulse(on: float, off: float) -> Signal:
    document = {"shape": "pulse", "on": on, "off": off}
    return signal_from(document, unit="1", field="command", rest=-1.0, limits=(-1.0, 1.0))


@dataclass(frozen=True, slots=True, eq=False)
class Design:
    """A group with its nominal length [m] and pressure [Pa]."""

    group: Group
    length: float
    pressure: float

    @property
    def contraction(self) -> float:
        """Contraction ratio at the end of the stroke."""
        return self.group.duty.pull / self.length


def alike_designs(designs: Sequence[Design]) -> list[list[int]]:
    """Numbers of the designs, those with the same muscle and duty together."""
    found: dict[tuple[int, int], list[int]] = {}
    for index, design in enumerate(designs):
        found.setdefault((id(design.group.muscle), id(design.group.duty)), []).append(index)
    return list(found.values())
