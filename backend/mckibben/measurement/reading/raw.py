"""The first rows of a file as they stand in it, for whoever checks how it is read."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import islice

SHOWN_ROWS = 60
_BELOW = 8  # rows shown below a head further down
_ABOVE = 20  # and above it
_MOST_CELLS = 60  # of a row
_LONGEST = 80  # characters of a cell

Rows = tuple[tuple[int, tuple[str, ...]], ...]


@dataclass(frozen=True)
class RawRows:
    """The first rows of a file.

    Attributes:
        rows: 1-based number of each row and its cells; where the head is far down, rows between are left out.
        places: the cell of a row that each header of the table has; None = it stands in no column.
        units_row: row of the units, where they stand apart from the names.
        head_moves: whether the user may say which row is the head.
        also: cells that hold the same columns again, beside the first ones.
    """

    rows: Rows
    places: tuple[int | None, ...]
    units_row: int | None = None
    head_moves: bool = True
    also: tuple[int, ...] = ()


def shown_rows(rows: Iterable[tuple[int, Iterable[object]]], head: int | None) -> Rows:
    """The rows that are shown: the first ones, and those about a head further down.

    Args:
        rows: (number, cells) in the order of the file; read only as far as needed.
        head: row of the names, None where there is none.
    """
    last = max(SHOWN_ROWS, (head or 0) + _BELOW)
    gap = range(SHOWN_ROWS - _BELOW - _ABOVE, (head or 0) - _ABOVE) if last > SHOWN_ROWS else range(0)
    shown = []
    for number, cells in rows:
        if number > last:
            break
        if number not in gap:
            texts = ("" if cell is None else str(cell).strip() for cell in islice(cells, _MOST_CELLS))
            shown.append((number, tuple(text[:_LONGEST] for text in texts)))
    return tuple(shown)
