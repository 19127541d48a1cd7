"""The first rows of a file as they stand in it, for whoever checks how it is read."""

from __future__ import annotations

from dataclasses import dataclass

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
