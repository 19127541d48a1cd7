"""Measurements from Excel workbooks (.xlsx): the first sheet that holds a table with a known column.

Above the header ``# key: value`` may stand in one cell, or ``# key`` and the value in two. Formulas count
with the values they had when the file was saved; nothing of a workbook is ever executed.
"""

from __future__ import annotations

import io
import threading
import warnings
import zipfile
from collections.abc import Iterator, Sequence
from datetime import date, datetime, time, timedelta
from typing import Any

from mckibben.measurement.read.cells import Cell, CellTable, Problems, no_rows, read_cells
from mckibben.measurement.read.conditions import Note, note_of_line
from mckibben.measurement.read.header import HEADER_EXAMPLE, map_headers
from mckibben.measurement.read.source import SAMPLE_ROWS, RawTable
from mckibben.physics.errors import InputError

_MAX_UNPACKED = 512_000_000  # bytes of all parts together
_MAX_RATIO = 200  # of one part; number tables reach about 20
_MAX_SHEETS = 20
_MAX_COLUMNS = 300
_HEADER_WITHIN = 200  # rows
_RATIO_FROM = 1_000_000  # bytes; smaller parts may be as dense as they like
_warnings_lock = threading.Lock()  # catch_warnings is not safe between threads

Rows = list[tuple[int, tuple[Cell, ...]]]


def open_xlsx(data: bytes, name: str) -> RawTable:
    """The table of a workbook.

    Raises:
        InputError: not a workbook, damaged, packed beyond measure, or without a table.
    """
    _check_archive(data, name)
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


def _check_archive(data: bytes, name: str) -> None:
    """Refuse what is no workbook or would unpack to more than its size can mean."""

    def refused(why: str, hint: str) -> InputError:
        return InputError(f"{name}: no column can be read: {why}", field="file", hint=hint)

    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            parts = archive.infolist()
            names = {part.filename for part in parts}
            if "xl/workbook.xml" not in names:
                if any(part.endswith(".bin") and part.startswith("xl/") for part in names):
                    raise refused("it is a binary workbook (.xlsb)", "save it as .xlsx or CSV")
                shown = ", ".join(sorted(names)[:3])
                raise refused(
                    f"a ZIP archive without a workbook in it (it holds {shown[:100]})", "unpack it first"
                )
            if sum(part.file_size for part in parts) > _MAX_UNPACKED:
                raise refused("the workbook is too large once unpacked", "save it as CSV")
            for part in parts:
                if part.flag_bits & 1:
                    raise refused("the workbook is protected by a password", "save it without")
                if part.file_size > max(_RATIO_FROM, _MAX_RATIO * part.compress_size):
                    raise refused(
                        f"its part '{part.filename[:80]}' is packed beyond measure", "save it as CSV"
                    )
            for part in parts:
                if part.filename.endswith((".xml", ".rels")) and _declares_entities(archive.read(part)):
                    raise refused(
                        f"its part '{part.filename[:80]}' declares entities", "save it from Excel again"
                    )
    except InputError:
        raise
    except Exception as error:  # whatever a damaged archive makes zipfile raise
        raise refused("the workbook is damaged, it cannot be unpacked", "save it again") from error


def _declares_entities(part: bytes) -> bool:
    """Whether an XML part could expand to more than it holds, in any encoding Excel may read."""
    return any(
        mark.encode(code) in part
        for mark in ("<!DOCTYPE", "<!ENTITY")
        for code in ("ascii", "utf-16-le", "utf-16-be")
    )


def _sheets(data: bytes, name: str) -> list[tuple[str, Rows]]:
    """Title and rows of the sheets that are not empty; rows by their number in the sheet."""
    import openpyxl

    found = []
    try:
        with _warnings_lock, warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of features that hold no data
            book = openpyxl.load_workbook(io.BytesIO(data), read_only=True, data_only=True, keep_links=False)
            for sheet in book.worksheets[:_MAX_SHEETS]:
                rows = list(_rows(sheet))
                if rows:
                    found.append((str(sheet.title)[:40], rows))
            book.close()
    except Exception as error:  # openpyxl raises whatever a damaged part leads to
        raise InputError(
            f"{name}: no column can be read: the workbook is damaged "
            f"({type(error).__name__}: {str(error)[:100]})",
            field="file", hint="save it again, or as CSV",
        ) from error  # fmt: skip
    if not found:
        raise InputError(f"{name}, sheet 1: the workbook holds no rows", field="sheet 1", hint=HEADER_EXAMPLE)
    return found


def _rows(sheet: Any) -> Iterator[tuple[int, tuple[Cell, ...]]]:
    """(row number, cells up to the last filled one) of each row that is not empty."""
    for number, cells in enumerate(sheet.iter_rows(values_only=True, max_col=_MAX_COLUMNS), start=1):
        last = len(cells)
        while last and (cells[last - 1] is None or cells[last - 1] == ""):
            last -= 1
        if last:
            yield number, tuple(_plain(cell) for cell in cells[:last])


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
