"""How likely a drive does its task when its muscle, its friction and its supply are not as computed.

Each specimen is simulated. What varies:

- the blocked force, normally distributed, two standard deviations = the spread the task states. Between
  specimens and laboratories the curves are displaced along the contraction axis (the length at which a
  muscle is called uncontracted differs), so a specimen starts from a contraction of its own:
  its force at kappa is that of the computed muscle at kappa + shift, and shift makes the blocked force
  differ by its share.
- hysteresis, evenly distributed between none and the loop's full width: a force that opposes the motion
  both ways, half the loop wide.
- the supply pressure, evenly distributed within its tolerance.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

import numpy as np
from scipy.special import ndtri

from mckibben.physics.drive_terms import INPUTS
from mckibben.physics.errors import InputError
from mckibben.physics.ideal import ATMOSPHERE
from mckibben.sizing.bench import Bench, Prepared
from mckibben.sizing.catalogue import Design
from mckibben.sizing.statics import outputs
from mckibben.sizing.task import Task

_SEED = 20260
_CHUNK = 25  # specimens a thread takes at a time
_HOLDS_BACK = 0.999  # friction holds a load, it does not lift it
_STEP = 1e-3  # of contraction, for its slope at the begin


@dataclass(frozen=True, slots=True)
class Chance:
    """Share of the specimens that do the task, its standard error, and how many there were."""

    probability: float
    error: float
    specimens: int


@dataclass(frozen=True, slots=True)
class Spread:
    """Deviations of specimens, shape (specimens,) each.

    Attributes:
        shift: added to the contraction ratio.
        opposing: force of one muscle against the motion [N].
        pressure: factor of the supply pressure.
    """

    shift: np.ndarray
    opposing: np.ndarray
    pressure: np.ndarray


def chance(bench: Bench, design: Design, share: tuple[float, float], specimens: int | None = None) -> Chance:
    """The probability that a design does the task.

    Args:
        bench: of the task.
        design: what is built.
        share: of the whole work before and after, for its progress.
        specimens: instead of the task's.

    Raises:
        EndedError: the bench's watch says so.
    """
    count = bench.task.uncertainty.specimens if specimens is None else specimens
    prepared = bench.prepared(design)
    spread = spread_of(design, bench.task, count)
    starts = range(0, count, _CHUNK)

    def met(begin: int) -> int:
        return sum(_met(prepared, bench.task, spread, i) for i in range(begin, min(begin + _CHUNK, count)))

    done = sum(bench.each(met, starts, share, len(starts)))
    probability = done / count
    return Chance(probability, sqrt(max(probability * (1.0 - probability), 1.0 / count) / count), count)


def spread_of(design: Design, task: Task, count: int) -> Spread:
    """Deviations of so many specimens: a Latin hypercube, the same at every call."""
    random = np.random.default_rng(_SEED)
    cells = np.array([random.permutation(count) for _ in range(3)])
    even = (cells + random.uniform(size=cells.shape)) / count
    given = task.uncertainty
    part = design.group.muscle
    near = np.array([0.0, _STEP, design.contraction, design.contraction])
    near[3] += _STEP
    pressure = np.full(4, design.pressure)
    force = outputs(
        part, length=np.full(4, design.length), contraction=near, pressure=pressure, temperature=task.temperature
    )["force"]
    begin, end = (force[0] - force[1]) / _STEP, (force[2] - force[3]) / _STEP  # N lost per contraction
    normal = ndtri(np.clip(even[0], 1e-9, 1.0 - 1e-9))
    shift = -0.5 * given.blocked_force * normal * max(force[0], 0.0) / max(begin, 1e-9)
    width = part.hysteresis if given.hysteresis is None else given.hysteresis
    return Spread(
        shift,
        0.5 * width * even[1] * max(end, 0.0),
        1.0 + given.supply_pressure * (2.0 * even[2] - 1.0),
    )


def _met(prepared: Prepared, task: Task, spread: Spread, index: int) -> bool:
    """Whether one specimen does the task."""
    drive = prepared.drive
    parameters, inputs = prepared.parameters.copy(), prepared.inputs
    moved = float(spread.shift[index]) * drive.muscle.nominal_length
    parameters[prepared.place("precontraction")] += moved
    supply = drive.supply_pressure * float(spread.pressure[index]) + ATMOSPHERE
    parameters[prepared.place("supply_pressure")] = supply
    opposing = float(spread.opposing[index]) * drive.load.lever_ratio
    assert isinstance(drive.load.force, float)  # noqa: S101 - a design's force is a number
    back = opposing
    if not drive.pair:  # what pulls back at the begin of the stroke, where it is least
        back = min(opposing, _HOLDS_BACK * max(prepared.design.group.duty.weight / _count(prepared)
                                               + drive.load.force, 0.0))  # fmt: skip
    filling = inputs[:, INPUTS.index("opening")] > 0.0
    inputs[:, INPUTS.index("external_force")] += np.where(filling, opposing, -back)
    try:
        figures = prepared.figures(parameters, inputs, task.returns)
    except InputError:
        return False
    return does(task, figures.time, figures.time_down, figures.held)


def _count(prepared: Prepared) -> int:
    return prepared.design.group.parallel


def does(task: Task, time: float | None, time_down: float | None, held: bool) -> bool:
    """Whether a run does what the task demands of it."""
    if time is None or not held:
        return False
    if task.time is not None and time > task.time:
        return False
    if not task.returns:
        return True
    if time_down is None or (task.time_down is not None and time_down > task.time_down):
        return False
    return task.cycle_time is None or time + time_down <= task.cycle_time
