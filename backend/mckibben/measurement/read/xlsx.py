"""Measurements from Excel workbooks (.xlsx): the first sheet that holds a table with a known column.

Above the header ``# key: value`` may stand in one cell, or ``# key`` and the value in two. Formulas count
with the values they had when the file was saved; nothing of a workbook is ever executed.
"""

from __future__ import annotations

import threading
import warnings
from collections.abc import Iterator, Sequence
from datetime import date, datetime, time, timedelta
from sys import getsizeof
from typing import Any

from mckibben.measurement.read.cells import Cell, CellTable, Problems, no_rows, read_cells
from mckibben.measurement.read.conditions import Note, note_of_line
from mckibben.measurement.read.header import HEADER_EXAMPLE, map_headers
from mckibben.measurement.read.limits import WORD, Allowance, check_columns
from mckibben.measurement.read.source import SAMPLE_ROWS, RawTable
from mckibben.measurement.read.workbook import MAX_ROWS, open_book
from mckibben.physics.errors import InputError

_MAX_SHEETS = 20
_MAX_CELLS = 8_000_000  # of all sheets; a cell takes 40 bytes and more
_HEADER_WITHIN = 200  # rows
_AT_ONCE = 64  # cells
_warnings_lock = threading.Lock()  # catch_warnings is not safe between threads

Rows = list[tuple[int, tuple[Cell, ...]]]


def open_xlsx(data: bytes, name: str) -> RawTable:
    """The table of a workbook.

    Raises:
        InputError: not a workbook, damaged, packed beyond measure, or without a table.
    """
    problem: InputError | None = None
    for sheet, rows in _sheets(data, name):
        place = f"{name}, sheet '{sheet}'"
        try:
            return _table(rows, place)
        except InputError as error:
            problem = problem or error
    raise problem or InputError(
        f"{name}, sheet 1: the workbook holds no rows", field="sheet 1", hint=HEADER_EXAMPLE
    )


def _sheets(data: bytes, name: str) -> list[tuple[str, Rows]]:
    """Title and rows of the sheets that are not empty; rows by their number in the sheet."""
    found = []
    try:
        with _warnings_lock, warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of features that hold no data
            book = open_book(data, name)
            cells = _Cells(name, len(data))
            for sheet in book.worksheets[:_MAX_SHEETS]:
                title = str(sheet.title)[:40]
                rows = list(cells.rows(sheet, title))
                if rows:
                    found.append((title, rows))
            book.close()
    except InputError:
        raise
    except Exception as error:  # openpyxl raises whatever a damaged part leads to
        raise InputError(
            f"{name}: no column can be read: the workbook is damaged "
            f"({type(error).__name__}: {str(error)[:100]})",
            field="file", hint="save it again, or as CSV",
        ) from error  # fmt: skip
    if not found:
        raise InputError(f"{name}, sheet 1: the workbook holds no rows", field="sheet 1", hint=HEADER_EXAMPLE)
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
                why = f"the workbook has more than {_MAX_CELLS} cells, which is more than is read"
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
    """The source of a sheet."""
    notes: list[Note] = []
    for position, (number, cells) in enumerate(rows[:_HEADER_WITHIN]):
        texts = ["" if cell is None else str(cell).strip() for cell in cells]
        said = _note(texts, f"{place}, row {number}")
        if said is not None or next(text for text in texts if text).startswith("#"):
            notes += [said] if said else []
        elif sum(isinstance(cell, str) for cell in cells) and _known(texts, place):
            return _below(rows[position + 1 :], texts, place, number, notes)
    # No row above names a known column: the first that could be a header says why.
    number, cells = next(((n, c) for n, c in rows if not str(c[0]).startswith("#")), rows[0])
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


def _below(rows: Rows, headers: list[str], place: str, number: int, notes: list[Note]) -> RawTable:
    width = len(headers)

    def full() -> Iterator[tuple[int, tuple[Cell, ...]]]:
        # Empty cells at the end of a row are not kept by the format.
        origin: datetime | None = None
        for line, cells in rows:
            padded = cells + (None,) * (width - len(cells))
            if isinstance(padded[0], datetime):
                origin = origin or padded[0].replace(tzinfo=None)
                padded = (padded[0].replace(tzinfo=None) - origin, *padded[1:])
            yield line, padded

    def read(numeric: Sequence[int], text: Sequence[int], skip: bool) -> CellTable:
        if not rows:
            raise no_rows(place)
        return read_cells(
            full(), headers, numeric=numeric, text=text, problems=Problems(place, "column", skip=skip)
        )

    sample = [["" if cell is None else str(cell) for cell in cells] for _, cells in rows[:SAMPLE_ROWS]]
    return RawTable(
        place=place,
        format="xlsx",
        headers=headers,
        read=read,
        sample=sample,
        notes=notes,
        messages=[],
        header_row=number,
    )
