"""What a drive may be made of, in SI, and the drive that a choice of it makes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache

from mckibben.physics import gas
from mckibben.physics.effect import Effect
from mckibben.physics.muscle import Muscle
from mckibben.simulation.command.signals import Signal, signal_from
from mckibben.simulation.drive.parts import Drive, Load, Tube, Valve
from mckibben.simulation.statics.limits import MuscleLimits
from mckibben.simulation.statics.model import StaticModel
from mckibben.sizing.task import Duty, Task

Values = Mapping[str, Mapping[str, float]]


@dataclass(frozen=True, slots=True, eq=False)
class CataloguePart:
    """A muscle, valve or tube that may be used.

    Attributes:
        effects, values: what it brings into the model.
        unverified: names of its figures that nobody verified.
    """

    id: str
    effects: tuple[Effect, ...] = ()
    values: Values = ()  # type: ignore[assignment]  # always given with effects
    unverified: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class MusclePart(CataloguePart):
    """A muscle of any length between ``shortest`` and ``longest`` [m].

    Attributes:
        hysteresis: largest width of its loop as a contraction ratio.
        coldest, hottest: ambient temperatures the maker allows [K].
    """

    muscle: Muscle
    limits: MuscleLimits
    shortest: float
    longest: float
    hysteresis: float = 0.0
    coldest: float | None = None
    hottest: float | None = None


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class ValvePart(CataloguePart):
    """A switching or proportional valve; used fully open."""

    valve: Valve
    max_pressure: float | None = None


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class TubePart(CataloguePart):
    """A tube between the valve and each muscle; None sits the valve on the muscle."""

    tube: Tube | None


@dataclass(frozen=True, slots=True)
class PartsCatalogue:
    """What may be combined."""

    muscles: tuple[MusclePart, ...]
    valves: tuple[ValvePart, ...]
    tubes: tuple[TubePart, ...]


@dataclass(frozen=True, eq=False)
class Group:
    """A choice of parts; nominal length and pressure remain."""

    duty: Duty
    muscle: MusclePart
    parallel: int
    valve: ValvePart
    tube: TubePart

    @cached_property
    def effects(self) -> tuple[Effect, ...]:
        """Of all parts; a later part's take the place of an earlier one's."""
        found = {effect.id: effect for part in self._parts for effect in part.effects}
        return tuple(found.values())

    @cached_property
    def values(self) -> dict[str, Mapping[str, float]]:
        """Parameters of the effects."""
        return {name: own for part in self._parts for name, own in dict(part.values).items()}

    @property
    def _parts(self) -> tuple[CataloguePart, ...]:
        return (self.muscle, self.valve, self.tube)

    @property
    def muscles(self) -> int:
        """All muscles of the drive."""
        return self.parallel * (2 if self.duty.pair else 1)

    @property
    def conductance(self) -> float:
        """Of the narrowest part of the way to one muscle [m^3/(s Pa)]."""
        own = self.valve.valve.fill_conductance / self.parallel
        tube = self.tube.tube
        if tube is None:
            return own
        return min(own, float(gas.tube_conductance(diameter=tube.inside_diameter, length=tube.length)))

    def drive(self, task: Task, length: float, pressure: float) -> Drive:
        """The drive of one of the parallel muscles: it has its share of the load and of the valve's flow.

        Equal muscles with equal shares move alike, so this is the drive of all of them.

        Args:
            task: what it does.
            length: nominal length [m].
            pressure: of the supply, gauge [Pa].
        """
        duty, count = self.duty, self.parallel
        model = StaticModel.of(self.muscle.muscle._replace(nominal_length=length), self.effects, self.values)
        model.limits = self.muscle.limits
        flow = self.valve.valve
        force, spring = duty.straight()
        reach = duty.pull / length
        return Drive(
            model=model,
            valve=replace(
                flow,
                fill_conductance=flow.fill_conductance / count,
                exhaust_conductance=flow.exhaust_conductance / count,
            ),
            load=Load(
                mass=duty.mass / count,
                inclination=duty.inclination,
                force=force / count,
                spring=spring / count,
                lever_ratio=duty.lever_ratio,
            ),
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
    """When the fill begins [s]; the second muscle of a pair is filled before."""
    return task.fill_time if duty.pair else 0.0


def command_of(task: Task, duty: Duty) -> Signal:
    """Fill, then vent."""
    on = switch_on(task, duty)
    return _pulse(on, on + task.fill_time)


@lru_cache(maxsize=64)
def _pulse(on: float, off: float) -> Signal:
    given = {"shape": "pulse", "on": on, "off": off}
    return signal_from(given, unit="1", field="command", rest=-1.0, limits=(-1.0, 1.0))


@dataclass(frozen=True, slots=True, eq=False)
class Design:
    """A group with its nominal length [m] and pressure [Pa]."""

    group: Group
    length: float
    pressure: float

    @property
    def contraction(self) -> float:
        """At the end of the stroke."""
        return self.group.duty.pull / self.length
