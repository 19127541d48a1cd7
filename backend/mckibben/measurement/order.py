"""Order of the rows of a file without time: whether it is that of the test, and which way the muscle went.

Weights are put on one after the other and taken off again, a pressure is stepped up and down: the rows go
there and come back step by step, which no sorted list does. Friction then has a direction although nothing
was timed.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.kind import STROKES, turning_points

Array = NDArray[np.float64]

FROM_ROWS = "order of the rows"  # where a direction comes from that no column holds
_FEWEST = 8  # rows of an ordered test
_STEPS = 3  # one after the other on both sides of a reversal
_AT_ONCE = 0.4  # of the range of a block; more between two rows is no step on the way but a new beginning
_NEW_LEVEL = 0.1  # of the range of the quantity that is held; the same
_TURNS = 0.1  # of the range; less is scatter
_BACK = 0.5  # of the way there
_MOVED = 0.02  # of the range; less is none
_MOST = 0.8  # share of the rows that has to lie in blocks of there and back, or to agree with a direction


@dataclass(frozen=True, eq=False)
class RowOrder:
    """What the order of rows says.

    Attributes:
        direction: of each row, -1 shortening or filling, +1 lengthening or venting, 0 before the first one.
        starts: first row of each block; between blocks something else was done.
    """

    direction: Array
    starts: tuple[int, ...]


def order_of_rows(columns: Mapping[str, NDArray]) -> RowOrder | None:
    """The order of the rows of a file without time, where the rows themselves show it.

    The swept quantity (stroke, pressure) goes there and back in most blocks of rows; a block ends where it
    jumps, or where what is held jumps. A stated direction has to agree.

    Args:
        columns: channels in SI; ``time`` is not looked at.
    """
    stroke = next((name for name in STROKES if name in columns), None)
    pressure = columns.get("pressure")
    if stroke is None or pressure is None:
        return None
    longer = columns[stroke] if stroke == "length" else -columns[stroke]
    force = columns.get("force")
    tried = [(longer, longer, pressure)]  # isobaric
    if force is None:
        tried.append((-pressure, longer, np.zeros(len(pressure))))  # one load throughout
    else:
        tried += [(-pressure, -pressure, longer), (-pressure, longer, force)]  # isometric, isotonic
    for swept, moved, constant in tried:
        if (found := _there_and_back(swept, moved, constant)) is not None:
            stated = columns.get("direction")
            if stated is None or _agree(stated, found.direction):
                return found
    return None


def _there_and_back(swept: Array, moved: Array, constant: Array) -> RowOrder | None:
    """Order and directions of blocks in which one quantity is swept and another is constant."""
    rows = len(swept)
    span = float(np.ptp(swept))
    if rows < _FEWEST or not span > 0.0:
        return None
    new = np.abs(np.diff(constant)) > _NEW_LEVEL * max(float(np.ptp(constant)), 1e-12)
    if np.ptp(constant) <= _MOVED * float(np.max(np.abs(constant))):
        new[:] = False
    if np.count_nonzero(new) * _STEPS > rows:
        return None  # it is not constant
    new |= np.abs(np.diff(swept)) > _AT_ONCE * span
    starts = [0, *(np.flatnonzero(new) + 1).tolist()]
    direction, moves = np.zeros(rows), float(np.ptp(moved))
    returned = 0
    for first, last in zip(starts, [*starts[1:], rows], strict=True):
        returned += (last - first) * _comes_back(swept[first:last])
        direction[first:last] = _ways(moved[first:last], moves)
    return RowOrder(direction, tuple(starts)) if returned >= _MOST * rows else None


def _comes_back(values: Array) -> bool:
    """Whether a quantity goes several steps one way and comes back by several steps."""
    span = float(np.ptp(values))
    if len(values) < 2 * _STEPS + 1 or not span > 0.0:
        return False
    turns = np.flatnonzero(turning_points(values, threshold=_TURNS * span)).tolist()
    later = np.minimum.accumulate(values[::-1])[::-1], np.maximum.accumulate(values[::-1])[::-1]
    good = sum(_is_turn(values, turn, span, later) for turn in turns)
    # Scatter turns at every other row, and by chance a few times step by step.
    return good > 0 and 2 * good >= len(turns) and len(values) >= _STEPS * (len(turns) + 1)


def _is_turn(values: Array, turn: int, span: float, later: tuple[Array, Array]) -> bool:
    """Whether several steps lead to a reversal and several lead back from it, most of the way.

    ``later``: the lowest and the highest value from each row on.
    """
    before, after = values[max(0, turn - _STEPS) : turn + 1], values[turn : turn + _STEPS + 1]
    if len(before) <= _STEPS or len(after) <= _STEPS:
        return False
    there, back = np.diff(before), np.diff(after)
    sign = np.sign(np.sum(there))
    steady = (sign * there >= -_MOVED * span).all() and (sign * back <= _MOVED * span).all()
    end = later[0] if sign > 0.0 else later[1]
    return bool(steady and abs(float(values[turn] - end[turn])) >= _BACK * span and sign != 0.0)


def _ways(moved: Array, span: float) -> Array:
    """-1 or +1 by the way to each row from the reversal before it; 0 of the first row."""
    threshold = _MOVED * span
    ways = np.zeros(len(moved))
    if len(moved) < _STEPS or not np.ptp(moved) > threshold:
        return ways
    ends = [0, *np.flatnonzero(turning_points(moved, threshold=threshold)).tolist(), len(moved) - 1]
    for begin, end in pairwise(ends):
        ways[begin + 1 : end + 1] = np.sign(moved[end] - moved[begin])
    # A reading that is taken twice has the way of the first.
    changes = np.concatenate([[True], np.diff(moved) != 0.0])
    return ways[np.maximum.accumulate(np.where(changes, np.arange(len(moved)), 0))]


def _agree(stated: Array, found: Array) -> bool:
    both = (stated != 0.0) & (found != 0.0)
    return bool(np.any(both) and np.mean(stated[both] == found[both]) >= _MOST)
