"""All designs of one muscle for a duty in closed form: which keep every limit, and what the others lack."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mckibben.sizing.catalogue import MusclePart
from mckibben.sizing.statics import AMPLE, Rest, at_rest, contraction_limit, margins
from mckibben.sizing.task import Duty, Task

Array = np.ndarray

_LENGTHS, _PRESSURES = 12, 8
_LOWEST_SHARE = 0.3  # of the pressure available
# Beyond what the task allows, to see what would help.
_LONGER, _FURTHER_LENGTHS, _FURTHER_PRESSURES, _MORE_PARALLEL = 4.0, 24, 8, 2
_HAIR = 1e-9


@dataclass(frozen=True, eq=False)
class Sheet:
    """Designs of a muscle, the allowed ones and those a little beyond.

    Attributes:
        rest: of all designs.
        margins: limit -> margin of each design; see `mckibben.sizing.statics.margins`.
    """

    part: MusclePart
    duty: Duty
    task: Task
    rest: Rest
    margins: dict[str, Array]

    @cached_property
    def lacking(self) -> Array:
        """How many limits each design violates; shape (designs,)."""
        return np.sum([margin < -_HAIR for margin in self.margins.values()], axis=0)

    @cached_property
    def allowed(self) -> Array:
        """Designs within the space, the pressure and the contraction of the task: the combinations tried."""
        inside = [self.margins[name] >= -_HAIR for name in ("length", "pressure", "contraction")]
        return np.all(inside, axis=0) & (self.rest.parallel <= self.task.limits.max_parallel)

    def sound(self, parallel: int) -> Array:
        """Positions of the designs with so many muscles that keep every limit."""
        return np.flatnonzero((self.lacking == 0) & (self.rest.parallel == parallel))

    def of(self, parallel: int) -> Array:
        """Positions of all designs with so many muscles."""
        return np.flatnonzero(self.rest.parallel == parallel)

    def margin(self, index: int) -> dict[str, float]:
        """Margins of one design that are limited at all."""
        found = {name: float(margin[index]) for name, margin in self.margins.items()}
        return {name: value for name, value in found.items() if value < AMPLE}


def sheet_of(part: MusclePart, duty: Duty, task: Task) -> Sheet:
    """The sheet of a muscle on the usual grid of nominal lengths, pressures and numbers in parallel."""
    lengths, pressures = _lengths(part, duty, task), _pressures(part, task)
    counts = np.arange(1, task.limits.max_parallel + _MORE_PARALLEL + 1)
    mesh = np.meshgrid(counts, lengths, pressures, indexing="ij")
    parallel, length, pressure = (axis.ravel().astype(float) for axis in mesh)
    rest = at_rest(part, duty, task, length, pressure, parallel)
    return Sheet(part, duty, task, rest, margins(rest, part, task))


def _lengths(part: MusclePart, duty: Duty, task: Task) -> Array:
    """Nominal lengths: what fits, and shorter and longer ones that would break a limit of the task."""
    least = max(part.shortest, duty.pull / contraction_limit(part, task))
    most = min(part.longest, task.limits.max_length - task.limits.end_fittings)
    inside = np.geomspace(least, most, _LENGTHS) if least <= most else np.zeros(0)
    own = part.limits.max_contraction
    shortest = least if own is None else max(part.shortest, duty.pull / own)
    shorter = np.geomspace(shortest, least, 4) if shortest < least else np.zeros(0)
    begin = max(least, most)
    longer = np.geomspace(begin, _LONGER * begin, _FURTHER_LENGTHS)
    found = np.unique(np.concatenate([inside, shorter, longer]))
    made = found[(found >= part.shortest) & (found <= part.longest)]
    return made if len(made) else np.array([part.longest])


def _pressures(part: MusclePart, task: Task) -> Array:
    """Pressures up to what is available, and beyond up to what the muscle stands."""
    own = part.limits.max_pressure
    most = task.available_pressure if own is None else min(task.available_pressure, own)
    usual = most * np.linspace(_LOWEST_SHARE, 1.0, _PRESSURES)
    if own is None or own <= most:
        return usual
    return np.concatenate([usual, np.linspace(most, own, _FURTHER_PRESSURES + 1)[1:]])


@dataclass(frozen=True, slots=True)
class Shortfall:
    """Why no design of so many muscles does: the limit in the way, and what it takes.

    Attributes:
        binding: name of the limit.
        best: position of the allowed design that comes nearest; None when not one is allowed.
        remedies: limit -> position of the design that violates it alone, and by how much of the limit.
    """

    binding: str
    best: int | None
    remedies: dict[str, tuple[int, float]]


def shortfall(sheet: Sheet, parallel: int) -> Shortfall:
    """What stands in the way of a muscle that does not do.

    The binding limit is the one that must move by the least share when nothing else may move: a limit of the
    task first; where none of those helps alone, what the muscle itself cannot.
    """
    own = sheet.of(parallel)
    remedies: dict[str, tuple[int, float]] = {}
    for name, margin in sheet.margins.items():
        alone = own[(sheet.lacking[own] == 1) & (margin[own] < -_HAIR)]
        if len(alone):
            index = int(alone[np.argmax(margin[alone])])
            remedies[name] = index, _share(float(margin[index]))
    stated = {name: share for name, (index, share) in remedies.items() if _movable(sheet, name, index)}
    inside = own[sheet.allowed[own]]
    worst = np.min(list(sheet.margins.values()), axis=0)
    best = int(inside[np.argmax(worst[inside])]) if len(inside) else None
    if stated:
        binding = min(stated, key=lambda name: stated[name])
    elif best is not None:
        binding = min(sheet.margins, key=lambda name: float(sheet.margins[name][best]))
    else:  # not made in any length that would do, or in none that fits
        too_long = sheet.duty.pull / contraction_limit(sheet.part, sheet.task) > sheet.part.longest
        binding = "contraction" if too_long else "length"
    return Shortfall(binding, best, remedies)


def _movable(sheet: Sheet, name: str, index: int) -> bool:
    """Whether a limit is the task's to move: not the strength of the muscle, nor what its maker allows."""
    if name == "force":
        return bool(sheet.rest.capacity[index] >= 1.0)  # only the reserve is missing
    if name == "contraction":
        own = sheet.part.limits.max_contraction
        return own is None or bool(sheet.rest.contraction[index] <= own * (1.0 + _HAIR))
    return name != "force_limit"


def _share(margin: float) -> float:
    """By which share of itself a limit must move to be kept."""
    return 1.0 / max(1.0 + margin, 1e-6) - 1.0
