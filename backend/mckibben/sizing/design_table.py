"""All designs of one muscle for a duty in closed form: which keep every limit, and what the others miss."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mckibben.sizing.catalogue import MusclePart
from mckibben.sizing.statics import HAIR, LimitName, Rest, at_rest, contraction_limit, margins
from mckibben.sizing.task import Duty, Task

Array = np.ndarray


#: Lengths and pressures of each muscle, within the limits of the task.
LENGTHS, PRESSURES = 12, 8
_LOWEST_SHARE = 0.3  # of the pressure available
# The grid beyond the task's limits, to find out what would help.
_LONGER, _FURTHER_LENGTHS, _FURTHER_PRESSURES, _MORE_PARALLEL = 4.0, 24, 8, 2
_ZOOMS, _DIVISIONS = 4, 8  # of the grid, around the least change that would help


@dataclass(frozen=True, eq=False)
class Sheet:
    """Designs of a muscle, within the limits of the task and somewhat beyond.

    Attributes:
        rest: figures of all designs at rest.
        margins: limit -> margin of each design; see `mckibben.sizing.statics.margins`.
    """

    part: MusclePart
    duty: Duty
    task: Task
    rest: Rest
    margins: dict[LimitName, Array]

    @cached_property
    def lacking(self) -> Array:
        """How many limits each design violates; shape (designs,)."""
        return np.sum([margin < -HAIR for margin in self.margins.values()], axis=0)

    @cached_property
    def allowed(self) -> Array:
        """Designs within length, pressure and contraction of the task: the combinations tried."""
        inside = [self.margins[name] >= -HAIR for name in ("length", "pressure", "contraction")]
        return np.all(inside, axis=0) & (self.rest.parallel <= self.task.limits.max_parallel)

    def sound(self, parallel: int) -> Array:
        """Positions of the designs with this number of muscles that keep every limit."""
        return np.flatnonzero((self.lacking == 0) & (self.rest.parallel == parallel))

    def of(self, parallel: int) -> Array:
        """Positions of all designs with this number of muscles."""
        return np.flatnonzero(self.rest.parallel == parallel)


def sheet_of(part: MusclePart, duty: Duty, task: Task) -> Sheet:
    """The sheet of a muscle on the usual grid of nominal lengths, pressures and numbers in parallel."""
    lengths, pressures = _lengths(part, duty, task), _pressures(part, task)
    counts = np.arange(1, task.limits.max_parallel + _MORE_PARALLEL + 1)
    mesh = np.meshgrid(counts, lengths, pressures, indexing="ij")
    parallel, length, pressure = (axis.ravel().astype(float) for axis in mesh)
    rest = at_rest(part, duty, task, length, pressure, parallel)
    return Sheet(part, duty, task, rest, margins(rest, part, task))


def _lengths(part: MusclePart, duty: Duty, task: Task) -> Array:
    """Nominal lengths that fit, and shorter and longer ones that break a limit of the task."""
    least = max(part.shortest, duty.pull / contraction_limit(part, task))
    most = min(part.longest, task.limits.max_length - task.limits.end_fittings)
    inside = np.geomspace(least, most, LENGTHS) if least <= most else np.zeros(0)
    makers_limit = part.limits.max_contraction
    shortest = least if makers_limit is None else max(part.shortest, duty.pull / makers_limit)
    shorter = np.geomspace(shortest, least, 4) if shortest < least else np.zeros(0)
    begin = max(least, most)
    longer = np.geomspace(begin, _LONGER * begin, _FURTHER_LENGTHS)
    candidates = np.unique(np.concatenate([inside, shorter, longer]))
    made = candidates[(candidates >= part.shortest) & (candidates <= part.longest)]
    return made if len(made) else np.array([part.longest])


def _pressures(part: MusclePart, task: Task) -> Array:
    """Pressures up to the available one, and beyond up to the limit of the muscle."""
    makers_limit = part.limits.max_pressure
    most = task.available_pressure if makers_limit is None else min(task.available_pressure, makers_limit)
    usual = most * np.linspace(_LOWEST_SHARE, 1.0, PRESSURES)
    if makers_limit is None or makers_limit <= most:
        return usual
    return np.concatenate([usual, np.linspace(most, makers_limit, _FURTHER_PRESSURES + 1)[1:]])


@dataclass(frozen=True, eq=False)
class Remedy:
    """The design that violates one limit alone, and that by the least.

    Attributes:
        rest: its figures, one entry each.
        share: of itself by which the limit must move.
    """

    rest: Rest
    share: float


@dataclass(frozen=True, slots=True)
class Shortfall:
    """Why no design with this number of muscles suffices: the binding limit, and what would help.

    Attributes:
        binding: name of the limit.
        best: position of the nearest allowed design; None when none is allowed.
        remedies: limit -> what it takes to move it alone.
    """

    binding: LimitName
    best: int | None
    remedies: dict[LimitName, Remedy]


def shortfall(sheet: Sheet, parallel: int) -> Shortfall:
    """The limit that prevents this number of muscles, and what would help.

    The binding limit is the one that must move by the least share when nothing else may move. Limits of the
    task come first; if none of them helps alone, it is a limit of the muscle itself.
    """
    designs = sheet.of(parallel)
    remedies: dict[LimitName, Remedy] = {}
    for name, margin in sheet.margins.items():
        alone = designs[(sheet.lacking[designs] == 1) & (margin[designs] < -HAIR)]
        if len(alone):
            remedies[name] = _least_change(sheet, name, int(alone[np.argmax(margin[alone])]))
    stated = {name: each.share for name, each in remedies.items() if _movable(sheet, name, each.rest)}
    inside = designs[sheet.allowed[designs]]
    worst = np.min(list(sheet.margins.values()), axis=0)
    best = int(inside[np.argmax(worst[inside])]) if len(inside) else None
    if stated:
        binding = min(stated, key=lambda name: stated[name])
    elif best is not None:
        binding = min(sheet.margins, key=lambda name: float(sheet.margins[name][best]))
    else:  # no length that the maker offers would suffice, or none fits
        too_long = sheet.duty.pull / contraction_limit(sheet.part, sheet.task) > sheet.part.longest
        binding = "contraction" if too_long else "length"
    return Shortfall(binding, best, remedies)


def _least_change(sheet: Sheet, name: LimitName, index: int) -> Remedy:
    """The least violation of one limit alone, from a design of the sheet on.

    The lengths and pressures between the design's neighbours are divided in 16 each, around the best of them
    again, and so on: four times, to a ten-thousandth of the first divisions.
    """
    rest, part = sheet.rest, sheet.part
    lengths, pressures = (
        np.unique(axis[rest.parallel == rest.parallel[index]]) for axis in (rest.length, rest.pressure)
    )
    best = rest.only(index)
    margin = float(sheet.margins[name][index])
    reach = [_gap(axis, float(at[0])) for axis, at in ((lengths, best.length), (pressures, best.pressure))]
    for _ in range(_ZOOMS):
        axes = [
            np.clip(at[0] + gap * np.linspace(-1.0, 1.0, 2 * _DIVISIONS + 1), axis[0], axis[-1])
            for at, gap, axis in ((best.length, reach[0], lengths), (best.pressure, reach[1], pressures))
        ]
        length, pressure = (each.ravel() for each in np.meshgrid(*axes, indexing="ij"))
        found = at_rest(
            part, sheet.duty, sheet.task, length, pressure, np.full(length.shape, best.parallel[0])
        )
        limits = margins(found, part, sheet.task)
        others = np.all([each >= -HAIR for key, each in limits.items() if key != name], axis=0)
        left = np.where(others, limits[name], -np.inf)
        nearest = int(np.argmax(left))
        if left[nearest] > margin:
            best, margin = found.only(nearest), float(left[nearest])
        reach = [gap / _DIVISIONS for gap in reach]
    return Remedy(best, max(_share(margin), 0.0))


def _gap(axis: Array, at: float) -> float:
    """Larger distance of a value of an axis to its neighbours."""
    return float(np.max(np.diff(axis)[max(int(np.searchsorted(axis, at)) - 1, 0) :][:2], initial=0.0))


def _movable(sheet: Sheet, name: str, rest: Rest) -> bool:
    """Whether the task can move a limit: not the strength of the muscle, nor a limit of its maker."""
    if name == "force":
        return bool(rest.capacity[0] >= 1.0)  # only the reserve is missing
    if name == "contraction":
        makers_limit = sheet.part.limits.max_contraction
        return makers_limit is None or bool(rest.contraction[0] <= makers_limit * (1.0 + HAIR))
    return name not in ("force_limit", "suspended_mass")


def _share(margin: float) -> float:
    """The share of itself by which a limit must move to be kept."""
    return 1.0 / max(1.0 + margin, 1e-6) - 1.0
