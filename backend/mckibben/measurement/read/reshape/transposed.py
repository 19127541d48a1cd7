"""Tables that lie on their side: a row per quantity, a column per reading."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from mckibben.measurement.measurement import STROKES
from mckibben.measurement.read.cells import Cell
from mckibben.measurement.read.grid import BLANKS, Grid, TextGrid
from mckibben.measurement.read.locate import texts_of
from mckibben.measurement.read.recognise import BY_UNIT, recognise
from mckibben.measurement.read.reshape.rows import MAX_CELLS, Rewritten, RowsGrid
from mckibben.measurement.read.unit_words import unit_of
from mckibben.measurement.read.values import CLOCK, GAP, NUMBER, TEXT, kind_of

_MOST_ROWS = 2000  # of a grid; a table on its side is wide, not long
_FEWEST = 3  # readings
_CHANNELS = ("pressure", "force", "time", "command", "temperature", *STROKES)
_NEEDED = ("pressure", "force", *STROKES)


class _Line(NamedTuple):
    """A row of one quantity: its row in the grid, its head, its values."""

    row: int
    head: str
    values: list[Cell]


def transposed(grid: Grid) -> Rewritten | None:
    """The grid with a column per quantity; None = it does not lie on its side."""
    if len(grid) > _MOST_ROWS or (isinstance(grid, TextGrid) and grid.separator == BLANKS):
        return None
    lines = {line.row: line for index in range(len(grid)) if (line := _line(grid, index)) is not None}
    blocks = _blocks(sorted(lines))
    blocks = [block for block in blocks if _is_table([lines[index] for index in block])]
    if not blocks or sum(len(lines[i].values) for block in blocks for i in block) > MAX_CELLS:
        return None
    taken = {index: block for block in blocks for index in block}
    rows: list[Sequence[Cell]] = []
    places: list[int] = []
    for index in range(len(grid)):
        block = taken.get(index)
        if block is None:
            rows.append(grid.cells(index))
            places.append(index)
        elif index == block[0]:
            inside = [lines[i] for i in block]
            count = max(len(line.values) for line in inside)
            rows.append([line.head for line in inside])
            rows += [
                [line.values[n] if n < len(line.values) else None for line in inside] for n in range(count)
            ]
            places += [index] * (count + 1)
    first, last = grid.where(blocks[0][0]), grid.where(blocks[-1][-1])
    said = f"each row holds one quantity ({first} to {last}): the table is transposed"
    return RowsGrid(grid, rows, places, units={}), [said], []


def _line(grid: Grid, index: int) -> _Line | None:
    """A row that begins with a name, perhaps a unit, and goes on with numbers to its end."""
    cells = list(grid.cells(index))
    texts, kinds = texts_of(cells), [kind_of(cell) for cell in cells]
    begin = next((i for i, kind in enumerate(kinds) if kind != GAP), len(kinds))
    if begin >= len(kinds) or kinds[begin] != TEXT:
        return None
    head, after = texts[begin], begin + 1
    if after < len(kinds) and kinds[after] == TEXT and unit_of(texts[after]) is not None:
        if recognise(head).unit is None:
            head = f"{head} [{texts[after]}]"
        after += 1
    elif after < len(kinds) and kinds[after] == GAP:
        after += 1
    values = cells[after:]
    while values and kind_of(values[-1]) == GAP:
        values.pop()
    numbers = sum(kind_of(value) in (NUMBER, CLOCK) for value in values)
    if numbers < _FEWEST or any(kind_of(value) == TEXT for value in values):
        return None
    return _Line(index, head, values)


def _blocks(indices: Sequence[int]) -> list[list[int]]:
    """Rows that follow each other."""
    found: list[list[int]] = []
    for index in indices:
        if found and index == found[-1][-1] + 1:
            found[-1].append(index)
        else:
            found.append([index])
    return found


def _is_table(lines: Sequence[_Line]) -> bool:
    """Whether the heads of the rows name different channels, two that are measured among them."""
    known = [recognise(line.head) for line in lines]
    channels = [one.channel for one in known if one.channel in _CHANNELS and one.penalty < BY_UNIT]
    lengths = {len(line.values) for line in lines}
    return (
        len({channel for channel in channels if channel in _NEEDED}) >= 2
        and len({line.head for line in lines}) == len(lines)
        and max(lengths) - min(lengths) <= max(lengths) // 2
        and max(lengths) > len(lines) / 2
    )
