"""The closed form: force, pressure and dimensions of a muscle at rest, over whole arrays of designs.

It uses the static model with the effects of the muscle (`mckibben.simulation.statics`), not the ideal force.
"""

from __future__ import annotations

from dataclasses import dataclass, fields
from operator import attrgetter
from typing import Literal

import numpy as np

from mckibben.physics import gas, ideal
from mckibben.physics.muscle import GEOMETRY
from mckibben.physics.sliding import sliding_effects
from mckibben.simulation.statics.compiled import compiled_state
from mckibben.simulation.statics.model import settle
from mckibben.sizing.catalogue import MusclePart
from mckibben.sizing.task import STATIONS, Duty, Task

Array = np.ndarray

#: A limit of a task that a design may fail.
LimitName = Literal[
    "length", "pressure", "contraction", "force", "force_limit", "diameter", "stiffness", "life",
    "temperature", "time", "time_down", "cycle_time", "suspended_mass", "valve_pressure",
]  # fmt: skip

# Life of a fluidic muscle, "100 000 to 10 million load cycles depending on load": general knowledge.
_LONGEST_LIFE, _LIFE_DECADES = 1e7, 2.0
_NO_FORCE = 1e-9  # N
#: Margin of a quantity that has no limit.
HAIR = 1e-9  # a margin is kept down to this far below zero: rounding
AMPLE = 1e3


def outputs(
    part: MusclePart,
    *,
    length: Array,
    contraction: Array,
    pressure: Array,
    direction: float | Array = -1.0,
    temperature: float = 293.15,
) -> dict[str, Array]:
    """Outputs of the static model for muscles of different nominal lengths; all arrays of one shape (rows,).

    ``length`` is the nominal one [m], ``pressure`` gauge [Pa]; direction -1 fills, +1 vents, with friction
    fully built up, 0 is their mean.
    """
    compiled = compiled_state(sliding_effects(effects=part.effects))
    packed = compiled.pack(part.muscle, part.values)
    constants = np.repeat(packed[None, :], len(length), axis=0)
    constants[:, GEOMETRY.index("nominal_length")] = length
    state = {
        "length": length * (1.0 - contraction),
        "pressure": pressure,
        "velocity": 0.0,
        "direction": direction,
        "temperature": temperature,
    }
    return settle(compiled, constants, state)[0]


@dataclass(frozen=True, eq=False)
class Rest:
    """Designs of one muscle and duty at rest; arrays of shape (designs,), per muscle unless stated otherwise.

    Attributes:
        length, pressure, parallel: the designs.
        contraction: contraction ratio at the end of the stroke.
        capacity: least ratio of force to load over the stroke, of all parallel muscles together.
        load: of one muscle at the end of the stroke, without the second muscle of a pair [N].
        tension: largest load of one muscle [N].
        lifting, holding: pressure that just carries the load at the start and at the end of the stroke [Pa];
            NaN where none does.
        needed: least pressure that carries it on the whole stroke [Pa]; NaN where none does.
        stiffness, stiffness_closed: at the load at the end of the stroke, valve open and closed [N/m].
        outer_diameter: at the end of the stroke [m].
        volume_start, volume: at the start and at the end of the stroke [m^3].
        blocked: force at the start of the stroke [N].
        life: load cycles, an estimate.
    """

    length: Array
    pressure: Array
    parallel: Array
    contraction: Array
    capacity: Array
    load: Array
    tension: Array
    lifting: Array
    holding: Array
    needed: Array
    stiffness: Array
    stiffness_closed: Array
    outer_diameter: Array
    volume_start: Array
    volume: Array
    blocked: Array
    life: Array

    def only(self, index: int) -> Rest:
        """One of the designs."""
        one = slice(index, index + 1)
        return Rest(*[array[one] for array in _arrays_of(self)])

    @property
    def air(self) -> Array:
        """Air that all muscles of one side take for a full fill, at ANR [m^3]."""
        filled = (self.pressure + ideal.ATMOSPHERE) * self.volume - ideal.ATMOSPHERE * self.volume_start
        return self.parallel * filled / (gas.GAS_CONSTANT * gas.ANR_TEMPERATURE * gas.ANR_DENSITY)


_arrays_of = attrgetter(*(item.name for item in fields(Rest)))


def at_rest(
    part: MusclePart, duty: Duty, task: Task, length: Array, pressure: Array, parallel: Array
) -> Rest:
    """Designs of one muscle at rest; all arrays of shape (designs,)."""
    count, stations = len(length), len(STATIONS)
    lever = duty.lever_ratio
    strokes = STATIONS * duty.stroke
    loads = duty.load(strokes)  # at the load, all muscles together
    reach = duty.pull / length
    rows = count * stations
    contraction = (reach[:, None] * STATIONS[None, :]).reshape(rows)
    repeated = np.repeat(length, stations)
    common = {"length": repeated, "contraction": contraction, "temperature": task.temperature}
    full = outputs(part, pressure=np.repeat(pressure, stations), **common)
    empty = outputs(part, pressure=np.zeros(rows), **common)
    force = full["force"].reshape(count, stations)
    passive = empty["force"].reshape(count, stations)
    against = np.zeros((count, stations))
    counter_stiffness = np.zeros(count)
    if duty.pair:
        stretched = outputs(part, pressure=np.zeros(rows), direction=1.0, **common)["force"]
        against = np.maximum(stretched.reshape(count, stations)[:, ::-1], 0.0)
        pulling = passive[:, 0] > 0.0
        counter_stiffness = np.where(pulling, empty["force_by_length"].reshape(count, stations)[:, 0], 0.0)
    share = loads[None, :] / (lever * parallel[:, None])  # of one muscle
    demand = share + against
    with np.errstate(divide="ignore", invalid="ignore"):
        # Without a load the muscle still has to overcome its own friction.
        free = np.where(force > 0.0, AMPLE, 0.0)
        ratio = np.where(demand > 0.0, force / np.maximum(demand, 1e-9), free)
        # At a fixed length the force is nearly linear in pressure.
        slope = (force - passive) / pressure[:, None]
        carrying = np.where(slope > 0.0, (demand - passive) / slope, np.nan)
    end = {name: full[name].reshape(count, stations)[:, -1] for name in full}
    bulk = 1.4 * (pressure + ideal.ATMOSPHERE)
    closed = end["force_by_length"] - end["force_by_pressure"] * bulk * end["volume_by_length"] / (
        end["volume"] + bulk * end["volume_by_pressure"]
    )
    at_load = parallel * lever**2
    tension = np.max(np.maximum(share, 0.0) + against, axis=1)
    limits = part.limits
    used = np.maximum(
        reach / limits.max_contraction if limits.max_contraction else 0.0,
        tension / limits.max_force if limits.max_force else 0.0,
    )
    return Rest(
        length=length,
        pressure=pressure,
        parallel=parallel,
        contraction=reach,
        capacity=np.minimum(ratio.min(axis=1), AMPLE),
        load=share[:, -1],
        tension=tension,
        lifting=np.maximum(carrying[:, 0], 0.0),
        holding=np.maximum(carrying[:, -1], 0.0),
        needed=np.maximum(carrying.max(axis=1), 0.0),
        stiffness=at_load * (end["force_by_length"] + counter_stiffness) + duty.spring,
        stiffness_closed=at_load * (closed + counter_stiffness) + duty.spring,
        outer_diameter=end["outer_diameter"],
        volume_start=empty["volume"].reshape(count, stations)[:, 0],
        volume=end["volume"],
        blocked=force[:, 0],
        life=_LONGEST_LIFE * 10.0 ** (-_LIFE_DECADES * np.clip(used, 0.0, 1.0)),
    )


def margins(rest: Rest, part: MusclePart, task: Task) -> dict[LimitName, Array]:
    """Margin to each limit, as `mckibben.facts.sizing` defines it; shape (designs,) each."""
    limits = task.limits
    most = contraction_limit(part, task)
    none = np.full(len(rest.length), AMPLE)
    hanging, stiffness = none, none
    if part.suspended_mass is not None and task.suspended_mass > 0.0:
        hanging = part.suspended_mass * rest.parallel * task.lever_ratio / task.suspended_mass - 1.0
    if limits.stiffness is not None:
        stiffness = rest.stiffness / limits.stiffness - 1.0
    tension = none
    if part.limits.max_force is not None:  # a pair without a torque has no tension at rest
        tension = part.limits.max_force / np.maximum(rest.tension, _NO_FORCE) - 1.0
    return {
        "length": limits.max_length / (rest.length + limits.end_fittings) - 1.0,
        "pressure": task.available_pressure / rest.pressure - 1.0,
        "contraction": most / rest.contraction - 1.0,
        "force": rest.capacity / (1.0 + limits.force_reserve) - 1.0,
        "force_limit": tension,
        "suspended_mass": hanging,
        "diameter": none if limits.max_diameter is None else limits.max_diameter / rest.outer_diameter - 1.0,
        "stiffness": stiffness,
        "life": none if limits.life is None else rest.life / limits.life - 1.0,
    }


def contraction_limit(part: MusclePart, task: Task) -> float:
    """The smaller of the task's and the maker's limit of the contraction ratio."""
    makers_limit = part.limits.max_contraction
    return (
        task.limits.max_contraction
        if makers_limit is None
        else min(makers_limit, task.limits.max_contraction)
    )


def least_time(rest: Rest, duty: Duty, task: Task, *, conductance: float) -> Array:
    """Lower bound of the stroke time of these designs [s]; shape (designs,).

    The load lifts when the air for the lifting pressure has come in at choked flow. From then on at most the
    blocked force at full pressure accelerates it.

    Args:
        rest: shape (designs,).
        conductance: sonic conductance of the narrowest part between supply and one muscle [m^3/(s Pa)].
    """
    supply = rest.pressure + ideal.ATMOSPHERE
    flow = conductance * gas.ANR_DENSITY * supply * np.sqrt(gas.ANR_TEMPERATURE / task.temperature)
    per_mass = 1.4 * gas.GAS_CONSTANT * task.temperature  # adiabatic: the fastest rise of pressure
    lifting = np.where(np.isfinite(rest.lifting), rest.lifting, 0.0)
    lift_off = lifting * rest.volume_start / (per_mass * flow)
    lowest = float(np.min(duty.load(STATIONS * duty.stroke)))
    spare = rest.parallel * duty.lever_ratio * rest.blocked - lowest
    with np.errstate(divide="ignore", invalid="ignore"):
        flight = np.where(spare > 0.0, np.sqrt(2.0 * duty.stroke * duty.mass / spare), np.inf)
    return lift_off + flight
