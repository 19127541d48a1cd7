"""How specimens, friction and supply differ from the computed values.

- The blocked force is normally distributed; two standard deviations are the spread the task states. The
  curves of specimens and laboratories are displaced along the contraction axis, because the length taken as
  uncontracted differs. So the force of a specimen at kappa is that of the computed muscle at kappa + shift,
  and the shift changes its blocked force.
- Hysteresis is uniformly distributed between the loop of the model and the full width that is stated: a force
  of half that width, less the friction of the model, against the motion in both directions.
- The supply pressure is uniformly distributed within its tolerance.

All muscles of a drive deviate together, like muscles of one batch; that is the harder case.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mckibben.sizing.catalogue import Design, alike_designs
from mckibben.sizing.statics import outputs
from mckibben.sizing.task import Task

_SEED = 20260
_STEP = 1e-3  # contraction step for a slope
# A weak specimen has all three deviations at once: together as rare as an extreme value of one alone.
_WEAK, _USUAL = 1.5, 0.6


@dataclass(frozen=True, slots=True)
class Deviation:
    """Deviations of one muscle: standard deviation of the shift [-], and the largest friction beyond that of
    the model [N].
    """

    shift: float
    friction: float


@dataclass(frozen=True, slots=True)
class Spread:
    """Deviations of specimens, shape (specimens,) each.

    Attributes:
        shift: added to the contraction ratio.
        friction: force of one muscle against the motion, beyond the friction of the model [N].
        pressure: factor on the supply pressure.
    """

    shift: np.ndarray
    friction: np.ndarray
    pressure: np.ndarray


def deviation_of(design: Design, task: Task) -> Deviation:
    """Deviations of a design, linearised at the blocked force (shift) and at the end of the stroke (loop)."""
    return deviations_of([design], task)[0]


def deviations_of(designs: Sequence[Design], task: Task) -> list[Deviation]:
    """`deviation_of` of several designs."""
    found: dict[int, Deviation] = {}
    for alike in alike_designs(designs):
        for index, force in zip(alike, _forces([designs[i] for i in alike], task), strict=True):
            found[index] = _deviation(designs[index], task, force)
    return [found[index] for index in range(len(designs))]


def _deviation(design: Design, task: Task, force: np.ndarray) -> Deviation:
    """The deviation from the forces at the contractions of `_forces`."""
    part, stated = design.group.muscle, task.uncertainty
    own = max(float(force[2] - force[4]), 0.0)  # friction of the model while it fills
    lost = np.maximum(force[[0, 2]] - force[[1, 3]], 1e-9) / _STEP  # N per contraction
    width = part.hysteresis if stated.hysteresis is None else stated.hysteresis
    shift = 0.5 * stated.blocked_force * max(float(force[0]), 0.0) / float(lost[0])
    return Deviation(shift, max(0.5 * width * float(lost[1]) - own, 0.0))


def weak(designs: Sequence[Design], task: Task) -> list[tuple[float, float, float]]:
    """Shift, friction and pressure factor of a weak specimen of each design: about 19 of 20 are better."""
    pressure = 1.0 - (1.0 - _USUAL) * task.uncertainty.supply_pressure
    return [
        (_WEAK * deviation.shift, _USUAL * deviation.friction, pressure)
        for deviation in deviations_of(designs, task)
    ]


def spread_of(design: Design, task: Task, count: int) -> Spread:
    """Deviations of ``count`` specimens: a Latin hypercube, the same at every call."""
    from scipy.special import ndtri  # 0.2 s import, not paid at start

    random = np.random.default_rng(_SEED)
    cells = np.array([random.permutation(count) for _ in range(3)])
    even = (cells + random.uniform(size=cells.shape)) / count
    deviation = deviation_of(design, task)
    normal = ndtri(np.clip(even[0], 1e-12, 1.0 - 1e-12))
    return Spread(
        deviation.shift * normal,
        deviation.friction * even[1],
        1.0 + task.uncertainty.supply_pressure * (2.0 * even[2] - 1.0),
    )


def _forces(designs: Sequence[Design], task: Task) -> np.ndarray:
    """Forces without friction at contraction 0, a step on, the end of the stroke, a step on, and at the end
    while it fills, shape (designs, 5); of designs with one muscle.
    """
    ends = np.array([design.contraction for design in designs])
    contraction = np.stack([0.0 * ends, 0.0 * ends + _STEP, ends, ends + _STEP, ends], axis=1)
    points = contraction.shape[1]
    return outputs(
        designs[0].group.muscle,
        length=np.repeat([design.length for design in designs], points),
        contraction=contraction.ravel(),
        pressure=np.repeat([design.pressure for design in designs], points),
        direction=np.tile([0.0, 0.0, 0.0, 0.0, -1.0], len(designs)),
        temperature=task.temperature,
    )["force"].reshape(contraction.shape)
