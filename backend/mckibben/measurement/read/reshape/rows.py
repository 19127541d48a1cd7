"""Rows of cells that stand for those of another grid, with the numbers of its rows."""

from __future__ import annotations

from collections.abc import Sequence

from mckibben.measurement.read.cells import Cell
from mckibben.measurement.read.grid import Grid

SAMPLED = 400  # rows from which the way of writing is told
MAX_CELLS = 8_000_000  # of a grid that is rewritten

#: A grid rewritten: the new one, what was done, columns that are not read and why.
Rewritten = tuple["RowsGrid", list[str], list[tuple[str, str]]]


class RowsGrid:
    """Rows of cells with their numbers in the file.

    Attributes:
        units: column -> unit that stands in its cells.
    """

    def __init__(
        self, source: Grid, rows: Sequence[Sequence[Cell]], places: Sequence[int], *, units: dict[int, str]
    ) -> None:
        self.place, self.title = source.place, source.title
        self.units = units
        self._source, self._rows, self._places = source, rows, places

    def __len__(self) -> int:
        return len(self._rows)

    def cells(self, index: int) -> Sequence[Cell]:
        """The cells of a row."""
        return self._rows[index]

    def line(self, index: int) -> int:
        """1-based row in the file."""
        return self._source.line(self._places[index])

    def where(self, index: int, column: int | None = None) -> str:
        """The row of the file, for people."""
        return self._source.where(self._places[index], column)
