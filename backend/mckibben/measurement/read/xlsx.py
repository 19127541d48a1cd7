"""Measurements from Excel workbooks (.xlsx): the first sheet that holds a table with a known column.

Above the header ``# key: value`` may stand in one cell, or ``# key`` and the value in two. Formulas count
with the values they had when the file was saved; nothing of a workbook is ever executed.
"""

from __future__ import annotations

import re
import threading
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import replace
from datetime import date, datetime, time, timedelta
from sys import getsizeof
from typing import Any

from mckibben.measurement.read.blocks import Held, Table
from mckibben.measurement.read.cells import Cell, no_rows
from mckibben.measurement.read.conditions import Note, note_of_line
from mckibben.measurement.read.correction import Correction
from mckibben.measurement.read.grid import Grid, SheetGrid
from mckibben.measurement.read.header import HEADER_EXAMPLE, map_headers
from mckibben.measurement.read.held import held_quantities
from mckibben.measurement.read.limits import WORD, Allowance, check_columns
from mckibben.measurement.read.locate import texts_of
from mckibben.measurement.read.reshape import regular
from mckibben.measurement.read.source import RawTable
from mckibben.measurement.read.stated import in_known_words, statements
from mckibben.measurement.read.table_source import source_of
from mckibben.measurement.read.tables import channels_of, choose, tables_of_grid
from mckibben.measurement.read.workbook import MAX_ROWS, open_book
from mckibben.physics.errors import InputError, did_you_mean

_MAX_SHEETS = 20
_MAX_CELLS = 8_000_000  # of all sheets; a cell takes 40 bytes and more
_HEADER_WITHIN = 200  # rows
_AT_ONCE = 64  # cells
_ALL_ROWS = 100_000  # a longer sheet is taken as one table after its first rows
_FIRST_ROWS = 5000
_ERROR_VALUE = re.compile(r"#(?:[A-Z0-9/]+[!?]|N/A|NV)")  # of a formula
_LONGEST_TEXT = 300  # characters of a row of texts
_warnings_lock = threading.Lock()  # catch_warnings is not safe between threads

Rows = list[tuple[int, tuple[Cell, ...]]]


def open_xlsx(data: bytes, name: str, correction: Correction | None = None) -> RawTable:
    """The table of a workbook: of the sheet with most channels, or of several sheets that belong together.

    Raises:
        InputError: not a workbook, damaged, compressed too far, without a table, or without the sheet that
            the user names.
    """
    sheets = _sheets(data, name)
    correction = correction or Correction()
    wanted = correction.sheet
    tables: list[Table] = []
    notes: dict[str, list[Note]] = {}
    rest: list[tuple[str, str]] = []
    for title, rows in sheets:
        place = f"{name}, sheet '{title}'"
        notes[title] = _comments(rows, place)
        reshaped = regular(SheetGrid([row for row in rows if not _is_comment(row[1])], place, title))
        grid = reshaped.grid
        head = correction.head if wanted in (None, title) else None
        try:
            until = _FIRST_ROWS if len(grid) > _ALL_ROWS else None
            found = tables_of_grid(grid, head=head, until=until)
        except InputError:
            if wanted == title or len(sheets) == 1:
                raise
            found = []
        where = f"name of sheet '{title}'"
        named = {q.channel: Held(q._replace(named=True), where) for q in held_quantities(title)}
        for table in found:
            table.messages += reshaped.messages
            table.unread += reshaped.unread
            for part in table.parts:
                part.held = named | part.held
        tables += found
        rest += found[0].rest if found else _texts(grid)
    if (wanted is None and not any(channels_of(table) for table in tables)) or not tables:
        return _refused_or_empty(sheets, name, wanted)
    chosen = choose(tables, sheet=wanted)
    table = chosen.table
    table.rest = [*table.rest, *(text for text in rest if text not in table.rest)]
    own = notes.get(table.title) or []
    found_notes = in_known_words([*(n for t, ns in notes.items() if t != table.title for n in ns), *own])
    known = {note.key for note in found_notes}
    found_notes += [note for note in statements(table.rest, name) if note.key not in known]
    table.unread = [*table.unread, *chosen.unread]
    read = {part.grid.title for part in table.parts}
    first = table.parts[0].grid.title if table.parts else table.title
    source = source_of(
        table, format="xlsx", notes=found_notes, messages=chosen.messages, shown=dict(sheets).get(first, [])
    )
    titles = dict.fromkeys(found.title for found in tables)
    return replace(source, choices=chosen.choices, tables=tuple((title, title in read) for title in titles))


def _refused_or_empty(sheets: Sequence[tuple[str, Rows]], name: str, wanted: str | None) -> RawTable:
    """The refusal of a workbook without a table: the first sheet, or the one of the user, says why."""
    title, rows = next((sheet for sheet in sheets if sheet[0] == wanted), sheets[0])
    if wanted is not None and title != wanted:
        titles = [sheet[0] for sheet in sheets]
        raise InputError(
            f"{name}: there is no sheet '{wanted}' with a table",
            field="sheet",
            hint=did_you_mean(wanted, titles),
        )
    return _table(rows, f"{name}, sheet '{title}'")


def _is_comment(cells: Sequence[Cell]) -> bool:
    first = next((str(cell).strip() for cell in cells if cell is not None and str(cell).strip()), "")
    return first.startswith("#") and _ERROR_VALUE.fullmatch(first) is None


def _comments(rows: Rows, place: str) -> list[Note]:
    """The conditions in ``# key: value`` above a table."""
    found = []
    for number, cells in rows[:_HEADER_WITHIN]:
        if _is_comment(cells):
            note = _note(
                ["" if cell is None else str(cell).strip() for cell in cells], f"{place}, row {number}"
            )
            found += [note] if note else []
    return found


def _texts(grid: Grid) -> list[tuple[str, str]]:
    """The texts of a sheet without a table, row by row."""
    found = []
    for index in range(min(len(grid), _HEADER_WITHIN)):
        cells = texts_of(grid.cells(index))
        text = " ".join(cell for cell in cells if cell)[:_LONGEST_TEXT]
        filled = [column for column, cell in enumerate(cells) if cell]
        if text:
            found.append((text, grid.where(index, filled[1] if len(filled) > 1 else filled[0])))
    return found


def _sheets(data: bytes, name: str) -> list[tuple[str, Rows]]:
    """Title and rows of the sheets that are not empty; rows by their number in the sheet."""
    found = []
    problem: InputError | None = None
    try:
        with _warnings_lock, warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of features that hold no data
            book = open_book(data, name)
            cells = _Cells(name, len(data))
            for sheet in book.worksheets[:_MAX_SHEETS]:
                title = str(sheet.title)[:40]
                try:
                    rows = list(cells.rows(sheet, title))
                except InputError as error:  # of this sheet: the others may be what is wanted
                    problem = problem or error
                    continue
                if rows:
                    found.append((title, rows))
            book.close()
    except (InputError, MemoryError):
        raise
    except Exception as error:  # openpyxl raises whatever a damaged part leads to
        raise InputError(
            f"{name}: no column can be read: the workbook is damaged "
            f"({type(error).__name__}: {str(error)[:100]})",
            field="file", hint="save it again, or as CSV",
        ) from error  # fmt: skip
    if not found:
        raise problem or InputError(
            f"{name}, sheet 1: the workbook holds no rows", field="sheet 1", hint=HEADER_EXAMPLE
        )
    return found


class _Cells:
    """The cells of all sheets, counted."""

    def __init__(self, name: str, size: int) -> None:
        self._name = name
        self._texts = Allowance(name, size)  # the long ones
        self._cells = self._rows = 0

    def rows(self, sheet: Any, title: str) -> Iterator[tuple[int, tuple[Cell, ...]]]:
        """(row number, cells up to the last filled one) of each row that is not empty."""
        place = f"sheet '{title}'"
        sheet.reset_dimensions()  # what it says of its size may be wrong; rows beyond would be missing
        for number, cells in enumerate(sheet.iter_rows(values_only=True), start=1):
            self._rows += 1
            if number > MAX_ROWS or self._rows > _MAX_SHEETS * MAX_ROWS // 4:
                raise self._refused(f"{place}, row {number}", f"a sheet has at most {MAX_ROWS} rows")
            last = _filled(cells)
            if not last:
                continue
            check_columns(last, f"{self._name}, {place}, row {number}", f"{place}, row {number}")
            self._cells += last
            if self._cells > _MAX_CELLS:
                why = f"the workbook has more than {_MAX_CELLS} cells, more than can be read"
                raise self._refused(f"{place}, row {number}", why)
            for cell in cells[:last]:
                if isinstance(cell, str) and len(cell) > WORD:
                    self._texts.take(getsizeof(cell), place)
            yield number, tuple(_plain(cell) for cell in cells[:last])

    def _refused(self, where: str, why: str) -> InputError:
        hint = "save it as CSV, or keep only the sheet of the measurement"
        return InputError(f"{self._name}, {where}: {why}", field=where, hint=hint)


def _filled(cells: Sequence[Any]) -> int:
    """Number of cells up to the last one that is filled."""
    last = len(cells)
    while last > _AT_ONCE and cells[last - _AT_ONCE : last].count(None) == _AT_ONCE:
        last -= _AT_ONCE
    while last and (cells[last - 1] is None or cells[last - 1] == ""):
        last -= 1
    return last


def _plain(cell: Any) -> Cell:
    """A cell as the readers take it; a time of day counts from midnight."""
    if isinstance(cell, time):
        return timedelta(
            hours=cell.hour, minutes=cell.minute, seconds=cell.second, microseconds=cell.microsecond
        )
    if isinstance(cell, date) and not isinstance(cell, datetime):
        return str(cell)
    return cell


def _table(rows: Rows, place: str) -> RawTable:
    """The refusal of a sheet in which no table was found; names what could be its header."""
    for number, cells in rows[:_HEADER_WITHIN]:
        texts = ["" if cell is None else str(cell).strip() for cell in cells]
        if not _is_comment(cells) and sum(isinstance(cell, str) for cell in cells) and _known(texts, place):
            map_headers(texts, place=place, row=number)
            raise no_rows(f"{place}, row {number}")
    number, cells = next(((n, c) for n, c in rows if not _is_comment(c)), rows[0])
    map_headers(["" if cell is None else str(cell) for cell in cells], place=place, row=number)
    raise no_rows(f"{place}, row {number}")


def _note(texts: Sequence[str], where: str) -> Note | None:
    filled = [text for text in texts if text]
    if not filled[0].startswith("#"):
        return None
    line = (
        filled[0]
        if ":" in filled[0].rstrip(":") or len(filled) < 2
        else f"{filled[0].rstrip(':')}: {filled[1]}"
    )
    return note_of_line(line, where)


def _known(texts: list[str], place: str) -> bool:
    """Whether a row is a header: it names at least one channel, or nearly does."""
    meaning = map_headers(texts, place=place, collect=True)
    return bool(meaning.columns or meaning.problems)
