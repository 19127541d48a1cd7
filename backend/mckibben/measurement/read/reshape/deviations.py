"""Cells that hold a mean and its deviation (``571.5 ± 1.4``): the mean is the reading."""

from __future__ import annotations

import re

from mckibben.measurement.read.cells import Cell
from mckibben.measurement.read.grid import Grid
from mckibben.measurement.read.reshape.rows import MAX_CELLS, SAMPLED, Rewritten, RowsGrid

_CELL = re.compile(
    r"\s*([+-]?[0-9]+(?:[.,][0-9]+)?(?:[eE][+-]?[0-9]+)?)\s*(?:±|\+/-|\+-|\\pm)\s*[0-9.,eE+-]+\s*%?\s*"
)
_FEWEST = 3


def without_deviations(grid: Grid) -> Rewritten | None:
    """The grid with the means alone; None = none of its cells holds a deviation, or it is too large."""
    first = range(min(len(grid), SAMPLED))
    columns = {
        column
        for column in {c for i in first for c in range(len(grid.cells(i)))}
        if sum(_mean(grid.cells(i), column) is not None for i in first) >= _FEWEST
    }
    if not columns or len(grid) * max(len(grid.cells(i)) for i in first) > MAX_CELLS:
        return None
    rows: list[list[Cell]] = []
    for index in range(len(grid)):
        row = list(grid.cells(index))
        for column in columns:
            mean = _mean(row, column)
            if mean is not None:
                row[column] = mean
        rows.append(row)
    shown = ", ".join(str(column + 1) for column in sorted(columns))
    said = f"the cells of column {shown} hold a mean and its deviation: the mean is read, not the deviation"
    return RowsGrid(grid, rows, range(len(rows)), units=getattr(grid, "units", {})), [said], []


def _mean(cells: object, column: int) -> str | None:
    """The mean in a cell; None = it holds no deviation."""
    row = list(cells)  # type: ignore
    cell = row[column] if column < len(row) else None
    found = _CELL.fullmatch(cell) if isinstance(cell, str) else None
    return None if found is None else found[1]
