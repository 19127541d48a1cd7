"""From grids to the one table that is read: all tables, those that belong together, the best one."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from typing import NamedTuple

from mckibben.measurement.measurement import CHANNEL_UNITS, STROKES
from mckibben.measurement.read.blocks import MapPart, Table, tables_of_run
from mckibben.measurement.read.grid import Grid, TextGrid
from mckibben.measurement.read.header import map_headers
from mckibben.measurement.read.heads import head_of
from mckibben.measurement.read.limits import MAX_BLOCKS
from mckibben.measurement.read.locate import (
    Run,
    TableHead,
    find_runs,
    main_runs,
    texts_of,
    titles_of,
    with_broken_rows,
)
from mckibben.physics.errors import InputError, did_you_mean

_TEXT_ROWS = 400  # rows beside the tables of which the texts are kept
_SUMMARY = 0.2  # of the rows of the longest table; a shorter one of the same channels sums it up
_MAX_TEXT = 300  # characters of one


class Chosen(NamedTuple):
    """The table that is read, what was left out, other tables that could be meant (name, columns).

    ``unread`` lists the columns of the other tables, with the reason.
    """

    table: Table
    messages: list[str]
    choices: tuple[tuple[str, str], ...]
    unread: list[tuple[str, str]]


def tables_of_grid(grid: Grid, *, head: int | None = None, until: int | None = None) -> list[Table]:
    """The tables of a grid, those with the same heads as parts of one.

    Args:
        grid: the rows.
        head: 1-based row of the names, where the user says it.
        until: number of rows that are searched; the last run found there goes on to the end.

    Raises:
        InputError: the row of the user is not there, or no numbers stand below it.
    """
    runs = find_runs(grid, until)
    at = None if head is None else _row_at(grid, head)
    if at is None:
        kept = main_runs(grid, runs)
    else:
        below = [run for run in runs if run.last > at + 1]
        if not below:
            raise InputError(
                f"{grid.place}, row {head}: there are no rows of numbers below it", field="head",
                hint="--head names the row of the column names, counted from 1",
            )  # fmt: skip
        below[0].first = max(below[0].first, at + 1)
        kept = main_runs(grid, below) or below[:1]
    if until is not None and kept and kept[-1].last >= until:
        kept[-1].last = _end(grid, kept[-1])
    if len(kept) > MAX_BLOCKS:
        raise InputError(
            f"{grid.place}: the file holds more than {MAX_BLOCKS} blocks of readings, which is too many",
            field="rows",
            hint="split the file, or write the blocks as columns of one table",
        )
    tables: list[Table] = []
    taken: set[int] = set()
    after = -1
    before: TableHead | None = None
    for run in kept:
        own = at if at is not None and at >= after and run is kept[0] else None
        if run.headless and before is not None:
            table_head = before
        else:
            table_head = head_of(grid, run, after=after, at=own)
            with_broken_rows(grid, run, table_head)
        before = table_head
        titles = _titles(grid, run, table_head, after)
        table = tables_of_run(grid, run, table_head, titles)
        if not isinstance(table.parts[0], MapPart):  # above a map stand titles only
            taken.update(row for row in (table_head.row, table_head.units_at) if row is not None)
        page = _is_next_page(grid, after, run)
        after = run.last - 1
        same = next((t for t in tables if t.signature == table.signature and t.names), None)
        if same is not None and page and _continue_part(same, table):
            continue
        if same is not None:
            same.parts += table.parts
            same.messages += table.messages
        else:
            tables.append(table)
    for table in tables:
        table.rest = _rest(grid, kept, taken, table)
    return tables


def _is_next_page(grid: Grid, before: int, run: Run) -> bool:
    """Whether a form feed stands between the table above and these rows."""
    return isinstance(grid, TextGrid) and any("\f" in grid.lines[i] for i in range(before + 1, run.first + 1))


def _continue_part(table: Table, page: Table) -> bool:
    """Take the rows of a page with the same head into the part above, where both have the same columns."""
    last, new = table.parts[-1], page.parts[0]
    if len(page.parts) > 1 or len(table.parts) > 1 or isinstance(new, MapPart):
        return False
    if (last.columns, last.held) != (new.columns, new.held):
        return False
    last.pieces += new.pieces
    said = "the head is repeated on the pages of the file: they are read as one table"
    table.messages += [said] if said not in table.messages else []
    return True


def _row_at(grid: Grid, head: int) -> int:
    for index in range(len(grid)):
        if grid.line(index) == head and any(texts_of(grid.cells(index))):
            return index
    raise InputError(
        f"{grid.place}: there is no row {head} with column names", field="head",
        hint="--head names the row of the column names, counted from 1",
    )  # fmt: skip


def _end(grid: Grid, run: Run) -> int:
    """The end of a run that goes on: the last rows of the grid without the texts below the table."""
    last = len(grid)
    while last > run.last:
        cells = texts_of(grid.cells(last - 1))
        first = next((cell for cell in cells if cell), "")
        if first and not first[:3].isalpha():
            break
        last -= 1
    return last


def _titles(grid: Grid, run: Run, head: TableHead, after: int) -> list[tuple[int, int, str]]:
    """(row, column, text) of what stands between the table above and the numbers, without names and units."""
    first = max(after + 1, run.first - 40)
    return [
        (index, column, text)
        for index in range(first, run.first)
        if index not in (head.row, head.units_at)
        for column, text in titles_of(grid, index)
    ]


def _rest(grid: Grid, runs: Sequence[Run], taken: set[int], table: Table) -> list[tuple[str, str]]:
    """Texts outside of the tables, row by row, with their places; remarks between readings are said."""
    rows: list[tuple[str, str]] = []
    between: list[str] = []
    below: list[tuple[int, str]] = []
    inside = sorted((run.first, run.last) for run in runs)
    pieces = [piece for run in runs for piece in (run.pieces or [(run.first, run.last)])]
    total = len(grid) if not isinstance(grid, TextGrid) or len(grid) < 200_000 else 0
    candidates = [*range(inside[0][0])] if inside else []
    if total:
        read = bytearray(total)
        for first, last in pieces:
            read[first:last] = b"\1" * (min(last, total) - first)
        candidates = [i for i in range(total) if not read[i]]
    elif inside:
        candidates += range(inside[-1][1], len(grid))
    for index in candidates:
        if index in taken:
            continue
        cells = texts_of(grid.cells(index))
        text = " ".join(cell for cell in cells if cell)[:_MAX_TEXT]
        if not text:
            continue
        at = bisect_right(inside, (index, len(grid))) - 1
        if at >= 0 and inside[at][0] <= index < inside[at][1]:
            between.append(f"{grid.where(index)}: '{text[:60]}'")
        elif inside and index >= inside[-1][1]:
            below.append((grid.line(index), text[:40]))
        if len(rows) < _TEXT_ROWS:
            filled = [column for column, cell in enumerate(cells) if cell]
            rows.append((text, grid.where(index, filled[1] if len(filled) > 1 else filled[0])))
    if between:
        table.messages.append(f"texts between the readings are not read: {'; '.join(between[:5])}")
    if below:
        shown = ", ".join(f"'{text}'" for _, text in below[:4])
        where = f"row {below[0][0]}" if len(below) == 1 else f"rows {below[0][0]} to {below[-1][0]}"
        table.messages.append(f"{where} below the table are not readings: {shown}")
    return rows


def channels_of(table: Table) -> set[str]:
    """The channels that the heads of a table name, and the pressure of its titles."""
    if not any(table.names) and not any(table.units):
        return set()
    meaning = map_headers([*table.names, "?"], place=table.place, collect=True, units=[*table.units, None])
    found = {column.use for column in meaning.columns if column.use in CHANNEL_UNITS}
    for channel in dict.fromkeys(channel for part in table.parts for channel in part.held):
        if is_told(table, channel, found):
            found.add(channel)
    return found - {"group", "direction"}


def is_told(table: Table, channel: str, known: set[str]) -> bool:
    """Whether the titles of all parts tell a channel that no column holds."""
    there = channel in known or (channel in STROKES and bool(known & set(STROKES)))
    if there or not all(channel in part.held for part in table.parts):
        return False
    # What a preamble says of a single table may be the rest length or the supply: it has to be named.
    return len(table.parts) > 1 or table.parts[0].held[channel].quantity.named


def titled_channels(table: Table) -> list[str]:
    """The channels that only the titles tell, in every part; of a single part its named pressure."""
    meaning = map_headers([*table.names, "?"], place=table.place, collect=True, units=[*table.units, None])
    known = {column.use for column in meaning.columns}
    found: list[str] = []
    for channel in dict.fromkeys(channel for part in table.parts for channel in part.held):
        if is_told(table, channel, known):
            found.append(channel)
            known.add(channel)
    return found


def choose(tables: Sequence[Table], *, sheet: str | None, noun: str = "sheet") -> Chosen:
    """The table with most channels; tables of the same heads that differ in their pressure belong together.

    Raises:
        InputError: the sheet that the user names is not there.
    """
    if sheet is not None:
        named = [table for table in tables if table.title == sheet]
        if not named:
            titles = [table.title for table in tables if table.title]
            raise InputError(
                f"{tables[0].place.partition(',')[0]}: there is no {noun} '{sheet}' with a table",
                field="sheet",
                hint=did_you_mean(sheet, titles) or f"the file has {', '.join(titles)}",
            )  # fmt: skip
        best = _best(named)
        return Chosen(best, [], (), _unread([table for table in tables if table is not best]))
    best = _best(tables)
    wanted = channels_of(best)
    alike = [table for table in tables if table.signature == best.signature]
    titled = titled_channels(_together(alike)) if len(alike) > 1 else []
    if len(alike) > 1 and titled:
        best = _together(alike)
        others = [table for table in tables if table not in alike]
        return Chosen(best, _left_out(others, noun), (), _unread(others))
    rivals = [
        t
        for t in tables
        if t is not best
        and len(wanted) >= 2
        and len(channels_of(t)) >= len(wanted)
        and _rows_of(t) >= _SUMMARY * _rows_of(best)
    ]
    choices: tuple[tuple[str, str], ...] = ()
    if rivals:
        choices = tuple(
            (table.title, ", ".join(n for n in table.names if n)[:80]) for table in (best, *rivals)
        )
    others = [table for table in tables if table is not best]
    return Chosen(best, _left_out(others, noun), choices, _unread(others))


def _unread(tables: Sequence[Table]) -> list[tuple[str, str]]:
    """The columns of tables that are not read."""
    return [
        (f"{table.title}: {name}" if table.title else name, "it is in another table")
        for table in tables
        for name in table.names
        if name
    ]


def _best(tables: Sequence[Table]) -> Table:
    def score(table: Table) -> tuple[int, int]:
        return len(channels_of(table)), _rows_of(table)

    return max(tables, key=score)


def _together(tables: Sequence[Table]) -> Table:
    first = tables[0]
    return Table(
        place=first.place.partition(", ")[0], title="", names=first.names, units=first.units,
        unit_where=first.unit_where, head_row=first.head_row, units_row=first.units_row,
        parts=[part for table in tables for part in table.parts],
        rest=[text for table in tables for text in table.rest],
        messages=[message for table in tables for message in table.messages],
    )  # fmt: skip


def _rows_of(table: Table) -> int:
    return sum(last - first for part in table.parts for first, last in part.pieces)


def _left_out(tables: Sequence[Table], noun: str) -> list[str]:
    return [
        f"another table{f' in {noun} ' + repr(table.title) if table.title else ''} is not read: columns "
        f"{', '.join(repr(name) for name in table.names if name)[:120] or 'without names'}"
        for table in tables
        if channels_of(table) or sum(last - first for part in table.parts for first, last in part.pieces) > 2
    ]
