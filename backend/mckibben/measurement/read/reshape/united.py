"""Columns whose cells hold number and unit (``1,086 kN``): as numbers in one unit each."""

from __future__ import annotations

from collections import Counter

from mckibben.measurement.read.cells import Cell
from mckibben.measurement.read.grid import Grid
from mckibben.measurement.read.quantity import quantity_of
from mckibben.measurement.read.reshape.rows import MAX_CELLS, SAMPLED, Rewritten, RowsGrid
from mckibben.measurement.read.unit_words import CLOCK, dimension_of
from mckibben.measurement.read.values import GAP, NumberStyle, kind_of, number_of, style_of
from mckibben.physics.units import factor

_SHARE = 0.6  # of the filled cells of a column
_FEWEST = 4


def without_units(grid: Grid) -> Rewritten | None:
    """The grid with plain numbers in columns of quantities; None = it has none, or is too large for it."""
    units = _units_of(grid)
    if not units or len(grid) * max(len(grid.cells(i)) for i in range(min(len(grid), SAMPLED))) > MAX_CELLS:
        return None
    style = style_of(
        found.number
        for index in range(min(len(grid), SAMPLED))
        for column, cell in enumerate(grid.cells(index))
        if column in units and (found := quantity_of(str(cell))) is not None
    )
    seen: dict[int, Counter[str]] = {column: Counter() for column in units}
    rows = [_row(grid.cells(index), units, style, seen) for index in range(len(grid))]
    said = [
        f"the cells of column {column + 1} state their unit ({', '.join(counts)}): read in {units[column]}"
        for column, counts in seen.items()
    ]
    return RowsGrid(grid, rows, range(len(rows)), units=units), said, []


def _units_of(grid: Grid) -> dict[int, str]:
    """Column -> unit in which most of its cells are written."""
    counts: dict[int, Counter[str]] = {}
    filled: Counter[int] = Counter()
    first = max(0, min(len(grid) // 2, len(grid) - SAMPLED))
    for index in {*range(min(len(grid), SAMPLED)), *range(first, min(len(grid), first + SAMPLED // 2))}:
        for column, cell in enumerate(grid.cells(index)):
            if not isinstance(cell, str) or not cell[:1].strip() or not _begins_a_number(cell):
                filled[column] += kind_of(cell) != GAP
                continue
            filled[column] += 1
            if (found := quantity_of(cell)) is not None and found.unit != CLOCK:
                mark = {True: "(a)", False: "(g)", None: ""}[found.absolute]
                counts.setdefault(column, Counter())[f"{found.unit}{mark}"] += 1
    units = {}
    for column, found in counts.items():
        if sum(found.values()) >= max(_FEWEST, _SHARE * filled[column]):
            units[column] = found.most_common(1)[0][0]
    return units


def _begins_a_number(cell: str) -> bool:
    return cell[0].isdigit() or cell[0] in "+-"


def _row(
    cells: object, units: dict[int, str], style: NumberStyle, seen: dict[int, Counter[str]]
) -> list[Cell]:
    row: list[Cell] = list(cells)  # type: ignore
    for column, unit in units.items():
        cell = row[column] if column < len(row) else None
        found = quantity_of(cell) if isinstance(cell, str) else None
        if found is None:
            continue
        number = number_of(found.number, style)
        target = unit.removesuffix("(a)").removesuffix("(g)")
        if not isinstance(number, float) or dimension_of(found.unit) != dimension_of(target):
            continue
        seen[column][found.unit] += 1
        scale = factor(found.unit, target) if found.unit != target else None
        row[column] = number if scale is None else number * scale.multiplier / scale.divisor
    return row
