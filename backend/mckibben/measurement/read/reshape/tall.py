"""Tables with one value per line, and the name of its signal beside it: as one column per signal."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from itertools import pairwise
from typing import NamedTuple

from mckibben.measurement.read.cells import Cell, marker_of
from mckibben.measurement.read.grid import Grid
from mckibben.measurement.read.head_text import taken_apart
from mckibben.measurement.read.locate import texts_of
from mckibben.measurement.read.recognise import BY_UNIT, Recognised, recognise
from mckibben.measurement.read.reshape.rows import MAX_CELLS, SAMPLED, Rewritten, RowsGrid
from mckibben.measurement.read.unit_words import unit_of
from mckibben.measurement.read.values import CLOCK, GAP, NUMBER, TEXT, kind_of
from mckibben.measurement.read.vocabulary import NO_CHANNEL, VALUE_WORDS, has_word, words_of

_MOST_TAGS = 60
_NAMED = 8  # signals that a message names
_FEWEST_ROWS = 6
_FURTHER = 200  # rows beyond the first ones that are looked at
_SPARSE = 0.5  # of the readings of the other signals; fewer are of a slow one
_NOT_GOOD = ("bad", "invalid", "fail", "error", "uncertain", "stale", "false")


class _Columns(NamedTuple):
    """Columns of a tall table: that of the names, the values, the instants, units and judgements.

    ``kept``: columns that say which run or way a row of readings belongs to; ``number``: one that numbers the
    readings of each signal, where there are no instants.
    """

    tag: int
    value: int
    instant: int | None
    unit: int | None
    quality: int | None
    first: int  # row of the grid
    kept: tuple[int, ...] = ()
    number: int | None = None


def pivoted(grid: Grid) -> Rewritten | None:
    """The grid with a column per signal; None = it is no tall table."""
    columns = _columns_of(grid)
    if columns is None or len(grid) * 4 > MAX_CELLS:
        return None
    readings = [
        (index, cells)
        for index in range(columns.first, len(grid))
        if (cells := grid.cells(index)) and len(cells) > max(columns.tag, columns.value)
        and str(cells[columns.tag] or "").strip()
    ]  # fmt: skip
    counts = Counter(str(cells[columns.tag]).strip() for _, cells in readings)
    if len(counts) > _MOST_TAGS:
        return None
    most = max(counts.values())
    tags = [tag for tag, count in counts.items() if count >= _SPARSE * most]
    heads = {tag: _head(grid, tag, columns, readings) for tag in counts}
    unread = [
        (heads[tag], f"it has {count} readings, the other signals have up to {most}")
        for tag, count in counts.items() if tag not in tags
    ]  # fmt: skip
    instants = _instants(readings, columns, tags)
    clock_head = texts_of(grid.cells(columns.first - 1)) if columns.first else []
    column = columns.instant
    first = [] if column is None else [_instant_head(clock_head, column)]
    first += [clock_head[place] for place in columns.kept]
    rows: list[list[Cell]] = [list(grid.cells(index)) for index in range(max(0, columns.first - 1))]
    places = list(range(max(0, columns.first - 1)))
    rows.append([*first, *(heads[tag] for tag in tags)])
    places.append(max(0, columns.first - 1))
    for index, beside, values in instants:
        rows.append([*beside, *(values.get(tag) for tag in tags)])
        places.append(index)
    said = [
        f"one value per line, its signal named in '{_name(clock_head, columns.tag)}': "
        f"{len(tags)} signals are read as columns, {', '.join(tags[:_NAMED])}{', …' * (len(tags) > _NAMED)}"
    ]
    said += [f"'{name}' is not read: {why}" for name, why in unread]
    return RowsGrid(grid, rows, places, units={}), said, unread


def _instant_head(heads: Sequence[str], column: int) -> str:
    """The head of the instants; numbers of samples are no samples."""
    head = heads[column] if column < len(heads) else "time"
    return head if recognise(head).channel == "time" else f"{head} no."


def _name(heads: Sequence[str], column: int) -> str:
    return heads[column] if column < len(heads) and heads[column] else f"column {column + 1}"


def _columns_of(grid: Grid) -> _Columns | None:
    """The columns of a tall table: one of words that name channels, one of numbers, beside instants."""
    first, rows = _body(grid)
    if len(rows) < _FEWEST_ROWS:
        return None
    width = Counter(map(len, rows)).most_common(1)[0][0]
    kinds = [Counter(kind_of(row[c]) for row in rows if c < len(row)) for c in range(width)]
    words = [c for c in range(width) if kinds[c][TEXT] > 0.9 * len(rows)]
    unit = next((c for c in words if all(unit_of(str(row[c])) for row in rows[:20] if c < len(row))), None)
    names = [c for c in words if c != unit]
    tag = next((c for c in names if _names_signals(grid, rows, c, unit)), None)
    if tag is None:
        return None
    clocks = [c for c in range(width) if kinds[c][CLOCK] > 0.9 * len(rows)]
    numbers = [c for c in range(width) if kinds[c][NUMBER] > 0.5 * len(rows) and c not in clocks]
    heads = texts_of(grid.cells(first - 1)) if first else []
    times = [c for c in numbers if c < len(heads) and recognise(heads[c]).channel == "time"]
    running = [c for c in numbers if c not in times and _counts_on([row[c] for row in rows if c < len(row)])]
    kept = tuple(
        c
        for c in range(min(width, len(heads)))
        if c not in (tag, unit) and recognise(heads[c]).channel in ("group", "direction")
    )
    values = [c for c in numbers if c not in (*times, *kept) and (c not in running or len(numbers) == 1)]
    if len(values) > 1:  # beside the values stand marks of their quality, which hardly change
        values = [
            c
            for c in values
            if not (_is_no_value(heads, c) or len({str(r[c]) for r in rows if c < len(r)}) < 2)
        ]
    if len(values) > 1:
        values = [c for c in values if c < len(heads) and has_word(words_of(heads[c]), VALUE_WORDS)] or values
    if len(values) != 1:
        return None
    instant = next(iter([*clocks, *times]), None)
    steady = [c for c in running if c not in kept]
    instant = next(iter(steady), None) if instant is None and len(steady) == 1 else instant
    others = [c for c in words if c not in (tag, *kept)]
    quality = next(
        (c for c in others if c != unit and _judges([str(row[c]) for row in rows if c < len(row)])), None
    )
    number = next((c for c in numbers if c not in (values[0], *kept, *times, *running)), None)
    return _Columns(tag, values[0], instant, unit, quality, first, kept, number)


def _is_no_value(heads: Sequence[str], column: int) -> bool:
    """Whether a head says that its column holds a mark or a running number."""
    return column < len(heads) and any(word in NO_CHANNEL for word in words_of(heads[column]))


def _body(grid: Grid) -> tuple[int, list[Sequence[Cell]]]:
    """The first row of the table and some of its rows: those with a number and a word each."""
    first, rows = 0, []
    for index in range(min(len(grid), SAMPLED)):
        cells = grid.cells(index)
        kinds = [kind_of(cell) for cell in cells]
        if TEXT in kinds and (NUMBER in kinds or (rows and GAP in kinds)) and 2 <= len(cells) <= 12:
            first = first if rows else index
            rows.append(cells)
        elif rows and TEXT in kinds and len(rows) < _FEWEST_ROWS:
            first, rows = 0, []
    step = max(1, (len(grid) - SAMPLED) // _FURTHER)  # the signals may stand in blocks, one after the other
    for index in range(SAMPLED, len(grid), step) if len(rows) >= _FEWEST_ROWS else ():
        cells = grid.cells(index)
        if len(cells) == len(rows[0]) and TEXT in (kinds := [kind_of(cell) for cell in cells]) and (
            NUMBER in kinds
        ):  # fmt: skip
            rows.append(cells)
    return first, rows


def _names_signals(grid: Grid, rows: Sequence[Sequence[Cell]], column: int, unit: int | None) -> bool:
    """Whether the words of a column come again and again and name at least two channels."""
    units: dict[str, str] = {}
    counts: Counter[str] = Counter()
    for row in rows:
        if column < len(row):
            counts[tag := str(row[column]).strip()] += 1
            if unit is not None and unit < len(row):
                units[tag] = str(row[unit]).strip()
    if not 2 <= len(counts) <= _MOST_TAGS or counts.total() < 2 * len(counts):
        return False
    channels = {_known(grid, tag, units.get(tag)).channel for tag in counts} - {None, "group", "direction"}
    return len(channels) >= 2


def _counts_on(values: Sequence[Cell]) -> bool:
    """Whether numbers never fall, as running numbers and times do."""
    try:
        numbers = [float(str(value).replace(",", ".")) for value in values if kind_of(value) == NUMBER]
    except ValueError:
        return False
    return len(numbers) > 2 and all(b >= a for a, b in pairwise(numbers)) and (numbers[-1] > numbers[0])


def _judges(words: Sequence[str]) -> bool:
    return any(
        marker_of(word) or word.strip().lower() in (*_NOT_GOOD, "good", "ok", "valid") for word in set(words)
    )


def _known(grid: Grid, tag: str, unit: str | None) -> Recognised:
    explained = _explained(grid, tag)
    known = recognise(tag, unit)
    if unit is not None and known.channel is not None:
        return known
    return known if known.channel is not None and known.penalty < BY_UNIT else recognise(explained or tag)


def _explained(grid: Grid, tag: str) -> str | None:
    """What the texts of a grid say of a name: ``PT-101 = muscle pressure, bar(g); ...``."""
    pattern = re.compile(rf"(?<![\w-]){re.escape(tag)}(?![\w-])\s*(?:=|:|->|–|\bis\b)\s*([^;|]+)")
    for index in range(min(len(grid), 60)):
        text = "; ".join(cell for cell in texts_of(grid.cells(index)) if cell)
        if (found := pattern.search(text)) is not None:
            return found[1].strip(" .")
    return None


def _head(grid: Grid, tag: str, columns: _Columns, readings: Sequence[tuple[int, Sequence[Cell]]]) -> str:
    """A name with what the file says of it and its unit."""
    known = recognise(tag)
    explained = None if known.channel is not None and known.unit is not None else _explained(grid, tag)
    head = tag if explained is None else f"{tag} {explained}"
    if columns.unit is not None and taken_apart(head).unit is None:
        at = columns.unit
        units = {
            str(cells[at]).strip()
            for _, cells in readings
            if len(cells) > at and str(cells[columns.tag]).strip() == tag
        }
        units = {unit for unit in units if unit_of(unit) is not None}
        if len(units) == 1:
            head = f"{head} [{units.pop()}]"
    return head


def _instants(
    readings: Sequence[tuple[int, Sequence[Cell]]], columns: _Columns, tags: Sequence[str]
) -> list[tuple[int, list[Cell], dict[str, Cell]]]:
    """(row, what stands beside, values by name): readings of one instant, else until a name comes again.

    Signals that stand in blocks, one after the other, belong together by their number in the block.
    """
    wanted = set(tags)
    chosen = [(i, cells) for i, cells in readings if str(cells[columns.tag]).strip() in wanted]
    instant, kept = columns.instant, columns.kept
    ordinals = _ordinals([str(cells[columns.tag]).strip() for _, cells in chosen])
    at = instant if instant is not None else columns.number if ordinals else None
    if at is None and ordinals:
        keys: list[object] = list(ordinals)
    else:
        runs = [c for c in kept if c != at]
        keys = [
            None if at is None else tuple(str(cells[c]) for c in (at, *runs) if c < len(cells))
            for _, cells in chosen
        ]
    by_key = keys[:1] != [None] and 2 * len(set(keys)) <= len(keys)
    beside = [*([] if instant is None else [instant]), *kept]
    found: list[tuple[int, list[Cell], dict[str, Cell]]] = []
    places: dict[object, int] = {}
    for key, (index, cells) in zip(keys, chosen, strict=True):
        tag = str(cells[columns.tag]).strip()
        place = places.get(key) if by_key else len(found) - 1 if found else None
        if place is None or tag in found[place][2]:
            place = places[key] = len(found)
            found.append((index, [cells[c] if c < len(cells) else None for c in beside], {}))
        found[place][2][tag] = _value(cells, columns)
    return found


def _ordinals(tags: Sequence[str]) -> list[int]:
    """Number of each reading among those of its name, where the names stand in blocks; else nothing."""
    changes = sum(one != other for one, other in pairwise(tags))
    if changes != len(set(tags)) - 1 or len(set(Counter(tags).values())) > 1:
        return []
    counts: Counter[str] = Counter()
    result = []
    for tag in tags:
        result.append(counts[tag])
        counts[tag] += 1
    return result


def _value(cells: Sequence[Cell], columns: _Columns) -> Cell:
    """The value of a line; one that is judged bad is none."""
    at = columns.quality
    if at is not None and at < len(cells):
        word = str(cells[at]).strip().lower()
        if word in _NOT_GOOD or marker_of(word) is not None:
            return "bad"
    return cells[columns.value]
