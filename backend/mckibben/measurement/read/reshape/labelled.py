"""Heads in which each channel has a column of labels before its own (``Name|p|Name|F``), as plain heads."""

from __future__ import annotations

import re
from collections.abc import Sequence

from mckibben.measurement.read.cells import Cell
from mckibben.measurement.read.grid import Grid
from mckibben.measurement.read.head_text import taken_apart
from mckibben.measurement.read.locate import texts_of
from mckibben.measurement.read.recognise import recognise
from mckibben.measurement.read.reshape.rows import SAMPLED, Rewritten, RowsGrid
from mckibben.measurement.read.unit_words import dimension_of, unit_of
from mckibben.measurement.read.values import CLOCK, NUMBER, kind_of

_UNIT_LABEL = re.compile(r"(?i)unit|einheit|dim(?!ension)|unidad|unité|unità")
_WITHIN = 60  # rows
_FEWEST = 2  # channels, and rows of labels


def without_labels(grid: Grid) -> Rewritten | None:
    """The grid with one row of names; None = its head holds no labels before each channel."""
    rows = [index for index in range(min(len(grid), _WITHIN)) if _label(texts_of(grid.cells(index)))]
    if len(rows) < _FEWEST:
        return None
    width = max(len(grid.cells(index)) for index in rows)
    body = next(
        (i for i in range(rows[-1] + 1, min(len(grid), SAMPLED)) if _is_body(grid.cells(i), width)), None
    )
    if body is None:
        return None
    said: dict[int, list[tuple[str, str]]] = {c: [] for c in range(1, width, 2)}
    for index in rows:
        cells = texts_of(grid.cells(index))
        for column in said:
            if column < len(cells) and cells[column]:
                said[column].append((cells[0], cells[column]))
    times = _unit_of_times(grid, rows)
    head: list[Cell] = []
    for column in range(width):
        number = f" #{column // 2 + 1}" if column > 1 else ""
        head.append(
            _head(said[column]) if column in said else f"time{number}{f' [{times}]' if times else ''}"
        )
    first = rows[0]
    places = [*range(first), first, *range(body, len(grid))]
    content: list[Sequence[Cell]] = [*(grid.cells(i) for i in range(first)), head]
    content += [grid.cells(i) for i in range(body, len(grid))]
    where = f"{grid.where(first)} to {grid.where(rows[-1])}"
    message = f"a column of labels stands before each channel ({where}): the labels are read as its name"
    return RowsGrid(grid, content, places, units={}), [message], []


def _label(cells: Sequence[str]) -> str | None:
    """The label that stands before each of the other cells of a row."""
    labels = {cell for cell in cells[0::2] if cell}
    channels = sum(bool(cell) for cell in cells[1::2])
    if len(labels) != 1 or len(cells) < 2 * _FEWEST or channels < 1 or sum(map(bool, cells[0::2])) < _FEWEST:
        return None
    label = labels.pop()
    if unit_of(label) is not None:
        return None
    return label if label not in cells[1::2] and kind_of(label) not in (NUMBER, CLOCK) else None


def _is_body(cells: Sequence[Cell], width: int) -> bool:
    return sum(kind_of(cell) in (NUMBER, CLOCK) for cell in cells) > width // 2


def _head(said: Sequence[tuple[str, str]]) -> str:
    """Name, remark and unit of a channel; the remark alone where it says what it is."""
    units = [
        (label, text)
        for label, text in said
        if kind_of(text) != NUMBER and (u := unit_of(text)) is not None and dimension_of(u.unit)
    ]
    labelled = [text for label, text in units if _UNIT_LABEL.search(label)]
    unit = next(iter(labelled or [text for _, text in units]), None)
    texts = [text for _, text in said if text != unit and kind_of(text) != NUMBER][:2]
    known = next((text for text in texts[::-1] if recognise(text, unit).channel is not None), None)
    why = next((text for text in texts[::-1] if recognise(text, unit).otherwise), None)
    name = (
        " ".join(texts[:1] + [text for text in (why, known) if text and text != texts[0]][:1])
        if texts
        else ""
    )
    return f"{name} [{unit}]" if unit and taken_apart(name).unit is None else name


def _unit_of_times(grid: Grid, rows: Sequence[int]) -> str | None:
    """The unit that a label says of times: ``SampleTime[ms]``."""
    for index in rows:
        label = _label(texts_of(grid.cells(index))) or ""
        unit = taken_apart(label).unit
        if unit is not None and dimension_of(unit) == "a time":
            return unit
    return None
