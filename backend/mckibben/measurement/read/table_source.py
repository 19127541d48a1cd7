"""The table of a grid as the source of a measurement: its parts one below the other, its cells as numbers."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import islice

from mckibben.measurement.measurement import CHANNEL_UNITS
from mckibben.measurement.read.blocks import MapPart, Part, Table
from mckibben.measurement.read.cells import Cell, CellTable, Problems, no_rows, read_cells
from mckibben.measurement.read.conditions import Note
from mckibben.measurement.read.directions import PAIRS, way_of_word
from mckibben.measurement.read.grid import BLANKS, TextGrid
from mckibben.measurement.read.header import map_headers
from mckibben.measurement.read.raw import RawRows, shown_rows
from mckibben.measurement.read.recognise import recognise
from mckibben.measurement.read.source import SAMPLE_ROWS, RawTable
from mckibben.measurement.read.stated import KIND_SAID
from mckibben.measurement.read.table import FAST_FROM, read_table
from mckibben.measurement.read.tables import titled_channels
from mckibben.measurement.read.values import Clock, NumberStyle, is_elapsed, is_falling, number_of, style_of
from mckibben.measurement.read.vocabulary import word_set, words_of
from mckibben.measurement.read.words.ways import LOADING
from mckibben.physics.units import factor

PART = "group"  # head of the column that numbers the parts
WAY = "direction"  # head of the column with the ways that the heads of the parts say
_LOADING = word_set(LOADING)
_STYLE_ROWS = 2000  # rows from which the way of writing numbers is told


def source_of(
    table: Table, *, format: str, notes: Sequence[Note], messages: Sequence[str],
    shown: Iterable[tuple[int, Iterable[object]]] = (), rewritten: bool = False,
) -> RawTable:  # fmt: skip
    """The source of a table; parts get a number each, and the pressure that their titles say.

    Args:
        table: the table.
        format, notes, messages: of the source.
        shown: the rows of the file as the user knows them.
        rewritten: the cells of the table are not those of the rows that are shown.
    """
    names, units = list(table.names), list(table.units)
    titled = titled_channels(table)
    several = len(table.parts) > 1
    numbered = several and not _has(table, "group")
    if several and "force" in titled and not any(note.key == KIND_SAID for note in notes):
        where = table.parts[0].held["force"].where  # a load in the title of each part
        notes = [*notes, Note(where, KIND_SAID, "isotonic")]
    said = list(messages) + table.messages
    for channel in titled:
        names.append(channel)
        units.append(_unit_of_held(table, channel))
    if numbered:
        names.append(PART)
        units.append(None)
    style = style_of(
        cell for part in table.parts for _, row in islice(part.rows(), _STYLE_ROWS) for cell in row
    )
    back = _ways_back(table, style) if not _has(table, WAY) else None
    if back is not None:
        names.append(WAY)
        units.append(None)
        words = ", ".join(f"'{way}'" for way in dict.fromkeys(part.way for part in table.parts))
        reverse = ", ".join(f"'{way}'" for way in sorted(back))
        said.append(f"the columns {words} are two ways of one test; {reverse} was gone from the last row up")
    ways = _ways_of_clocks(table, said)

    def rows(clocks: bool) -> Iterator[tuple[int, list[Cell]]]:
        for number, part in enumerate(table.parts):
            more: list[Cell] = [
                part.held[channel].quantity.value * _scale(part, table, channel) for channel in titled
            ]
            if numbered:
                more.append(number)
            times = {
                i: Clock(**ways.get(i, {})) for i, c in enumerate(part.columns) if clocks and c in part.clocks
            }
            if back is not None:
                more.append(part.way)
            backwards = back is not None and part.way in back
            for line, row in reversed(list(part.rows())) if backwards else part.rows():
                cells: list[Cell] = [number_of(cell, style) for cell in row]
                for i, clock in times.items():
                    cells[i] = clock.seconds(row[i])
                yield line, cells + more

    def read(numeric: Sequence[int], text: Sequence[int], skip: bool) -> CellTable:
        if not table.parts:
            raise no_rows(table.place)
        quick = _quick(table, style, names, numeric, text, skip)
        if quick is not None:
            return quick
        problems = Problems(table.place, "column", skip=skip)
        return read_cells(rows(True), names, numeric=numeric, text=text, problems=problems)

    sample = [
        ["" if cell is None else str(cell) for cell in row] for _, row in islice(rows(False), SAMPLE_ROWS)
    ]
    for channel in titled:
        places = ", ".join(dict.fromkeys(f"'{part.held[channel].quantity.text}'" for part in table.parts))
        said.append(f"{channel} is taken from the titles: {places} ({table.parts[0].held[channel].where})")
    if several:
        said.append(f"{len(table.parts)} tables with the same columns are read as parts of one measurement")
    return RawTable(
        place=table.place, format=format, headers=names, read=read, sample=sample, notes=list(notes),
        messages=said, header_row=table.head_row, noun="column", units=tuple(units),
        unit_where=table.unit_where, rest=tuple(table.rest), unread=tuple(table.unread),
        clocks=frozenset(i for part in table.parts for i, c in enumerate(part.columns) if c in part.clocks),
        raw=_raw(table, shown, len(names), rewritten),
    )  # fmt: skip


def _ways_back(table: Table, style: NumberStyle) -> frozenset[str] | None:
    """The ways that run against the order of the rows; None where the parts are no ways there and back.

    Rows of both ways stand beside each other, so one of the two runs against the test: the way back, but of
    loading and unloading the one on which the force would change the wrong way.
    """
    known = {part.way: way_of_word(part.way) for part in table.parts}
    pair = next((pair for pair in PAIRS if set(known.values()) == set(pair)), None)
    if pair is None or any(len(part.columns) == len(part.own) for part in table.parts):
        return None  # each way has rows of its own
    there = next(part for part in table.parts if known[part.way] == pair[0])
    falls = set(words_of(there.way)) & _LOADING and _force_falls(table, there, style)
    return frozenset(way for way, meant in known.items() if meant == pair[0 if falls else 1])


def _force_falls(table: Table, part: Part, style: NumberStyle) -> bool:
    """Whether the force falls from the first row of a part to its last; it may be in any of its columns."""
    names = zip(table.names, table.units, strict=True)
    place = next((i for i, head in enumerate(names) if recognise(*head).channel == "force"), None)
    if place is None:
        return False
    values = [v for _, row in part.rows() if isinstance(v := number_of(row[place], style), float)]
    return len(values) > 1 and values[-1] < values[0]


def _ways_of_clocks(table: Table, said: list[str]) -> dict[int, dict[str, bool]]:
    """How the times of each column are to be read, from the first rows."""
    ways: dict[int, dict[str, bool]] = {}
    for part in table.parts[:1]:
        clocked = [i for i, c in enumerate(part.columns) if c in part.clocks]
        shown = [row for _, row in islice(part.rows(), _STYLE_ROWS)] if clocked else []
        for i in clocked:
            cells = [row[i] for row in shown]
            ways[i] = {"elapsed": is_elapsed(cells), "falling": is_falling(cells)}
            name = f"column '{table.names[i] or f'column {i + 1}'}'"
            if ways[i]["elapsed"]:
                said.append(f"{name} is read as minutes:seconds: it begins at '{cells[0]}'")
            if ways[i]["falling"]:
                said.append(f"{name} runs backwards: the newest row stands first")
    return ways


def _raw(table: Table, shown: Iterable[tuple[int, Iterable[object]]], width: int, rewritten: bool) -> RawRows:
    """The rows of the file with the places of the columns of the first part."""
    fixed = rewritten or not table.parts or isinstance(table.parts[0], MapPart)
    places: list[int | None] = [] if fixed else list(table.parts[0].columns)
    places += [None] * (width - len(places))
    beside = [] if fixed else [part for part in table.parts[1:] if part.grid is table.parts[0].grid]
    also = {column for part in beside for column in part.columns} - set(places)
    rows = shown_rows(shown, table.head_row)
    return RawRows(rows, tuple(places), table.units_row, not fixed, tuple(sorted(also)))


def _has(table: Table, use: str) -> bool:
    meaning = map_headers([*table.names, "?"], place=table.place, collect=True, units=[*table.units, None])
    return any(column.use == use for column in meaning.columns)


def _unit_of_held(table: Table, channel: str) -> str:
    quantity = table.parts[0].held[channel].quantity
    mark = {True: "(a)", False: "(g)", None: ""}[quantity.absolute]
    return f"{quantity.unit}{mark}"


def _scale(part: Part, table: Table, channel: str) -> float:
    """The unit of this part's quantity in that of the first part."""
    first, own = table.parts[0].held[channel].quantity.unit, part.held[channel].quantity.unit
    if first == own:
        return 1.0
    si = "kg" if {first, own} <= {"kg", "g"} else CHANNEL_UNITS[channel]
    this, other = factor(own, si), factor(first, si)
    return this.multiplier / this.divisor * other.divisor / other.multiplier


def _quick(
    table: Table, style: NumberStyle, names: Sequence[str], numeric: Sequence[int], text: Sequence[int],
    skip: bool,
) -> CellTable | None:  # fmt: skip
    """A long plain text by the way for plain texts; None = it is not as plain as that."""
    part = table.parts[0]
    grid = part.grid
    if (
        len(table.parts) > 1
        or isinstance(part, MapPart)
        or part.carried
        or not isinstance(grid, TextGrid)
        or len(part.pieces) > 1
    ):
        return None
    first, last = part.pieces[0]
    if grid.separator == BLANKS or style.thousands or part.columns != tuple(range(len(names))):
        return None
    if any(part.columns[i] in part.clocks for i in numeric if i < len(part.columns)):
        return None
    body = "\n".join(grid.lines[first:last])
    if len(body) < FAST_FROM:
        return None
    return read_table(
        body,
        grid.separator,
        names,
        numeric=numeric,
        text=text,
        name=table.place,
        first_line=first + 1,
        skip=skip,
    )
