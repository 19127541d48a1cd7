"""The least value of a function of a few numbers, by a simplex (Nelder & Mead, Comput. J. 7 (1965) 308).

For functions that take microseconds, where a general library's search would take most of the time.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

_NEAR, _ALIKE = 1e-4, 1e-4  # of the corners, and of their values, below which the search ends


class _SpentError(Exception):
    """No evaluation is left."""


def lowest(
    function: Callable[[Sequence[float]], float], corners: Sequence[Sequence[float]], most: int
) -> list[float]:
    """Where a function is lowest.

    Args:
        function: of a list of numbers; may be infinite.
        corners: of the first simplex, one more than there are numbers.
        most: evaluations.
    """
    left = most

    def value(place: Sequence[float]) -> float:
        nonlocal left
        if not left:
            raise _SpentError
        left -= 1
        return function(place)

    found = sorted(((value(corner), list(corner)) for corner in corners), key=_value)
    try:
        while not _small(found):
            found = sorted(_moved(found, value), key=_value)
    except _SpentError:
        pass
    return found[0][1]


def _value(corner: tuple[float, list[float]]) -> float:
    return corner[0]


def _small(found: list[tuple[float, list[float]]]) -> bool:
    """Whether all corners are as good as one."""
    (least, best), *others = found
    apart = max(abs(x - y) for _, place in others for x, y in zip(place, best, strict=True))
    return apart <= _NEAR and found[-1][0] - least <= _ALIKE


def _moved(
    found: list[tuple[float, list[float]]], value: Callable[[Sequence[float]], float]
) -> list[tuple[float, list[float]]]:
    """The simplex with its worst corner reflected, drawn out or drawn in; else drawn to the best one."""
    *kept, (worst, last) = found
    middle = [sum(each) / len(kept) for each in zip(*(place for _, place in kept), strict=True)]

    def along(share: float) -> tuple[float, list[float]]:
        place = [m + share * (m - w) for m, w in zip(middle, last, strict=True)]
        return value(place), place

    reflected = along(1.0)
    if reflected[0] < kept[0][0]:
        further = along(2.0)
        return [*kept, min(further, reflected, key=_value)]
    if reflected[0] < kept[-1][0]:
        return [*kept, reflected]
    inside = along(0.5 if reflected[0] < worst else -0.5)
    if inside[0] <= reflected[0] < worst or inside[0] < worst <= reflected[0]:
        return [*kept, inside]
    best = kept[0]
    drawn = ([b + 0.5 * (x - b) for b, x in zip(best[1], place, strict=True)] for _, place in found[1:])
    return [best, *((value(place), place) for place in drawn)]
