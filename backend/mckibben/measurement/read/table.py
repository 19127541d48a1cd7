"""The rows of a delimited text.

Two ways that give the same result. The careful one walks the rows with the csv module and knows the line of
every cell. The fast one (pandas, for large tables) leaves odd rows, or a table of many, to the former.
"""

from __future__ import annotations

import csv
from collections.abc import Iterator, Sequence

from mckibben.measurement.read.cells import CellTable, Problems, no_rows, read_cells
from mckibben.measurement.read.fast import read_fast
from mckibben.measurement.read.limits import MAX_COLUMNS, MAX_ROW_LENGTH, check_columns, check_rows
from mckibben.physics.errors import InputError

FAST_FROM = 200_000  # characters; below, importing pandas costs more than it saves
_MOST_LINES = 100  # of one row, by line ends within quotes


def split_header(line: str, separator: str, *, name: str, row: int) -> list[str]:
    """The cells of a header line."""
    if line.count(separator) >= MAX_COLUMNS:
        check_columns(line.count(separator) + 1, f"{name}, row {row}", f"row {row}")
    try:
        return next(csv.reader([line], delimiter=separator, strict=True, skipinitialspace=True), [])
    except csv.Error as error:
        raise _quote_error(name, row, error) from error


def read_table(
    body: str, separator: str, headers: Sequence[str], *, numeric: Sequence[int], text: Sequence[int],
    name: str, first_line: int, skip: bool = False,
) -> CellTable:  # fmt: skip
    """Read the lines below the header.

    Args:
        body: the lines, ended by ``\\n``.
        separator: one character.
        headers: all column headers.
        numeric: indices of the columns to read as numbers.
        text: indices of the columns to read as labels.
        name: file name, for messages.
        first_line: 1-based line of the file on which ``body`` begins.
        skip: leave bad rows out, with a count, instead of refusing the table.

    Raises:
        InputError: ragged rows, text or nothing or nan where a number must be, mixed decimal signs, an
            unterminated quote, no rows; names the first row and how many more there are.
    """
    body = _without_empty_end(body, separator)
    if not body:
        raise no_rows(f"{name}, row {first_line - 1}")
    check_rows(body.count("\n") + 1, name)
    problems = Problems(name, "column", skip=skip)
    table = None
    if len(body) >= FAST_FROM:
        table = read_fast(
            body, separator, headers, numeric=numeric, text=text, problems=problems, first_line=first_line
        )
    if table is None:
        table = _read_carefully(body, separator, headers, numeric, text, problems, first_line)
    return table


def first_rows(body: str, separator: str, rows: int) -> list[list[str]]:
    """The cells of the first lines, as they are written."""
    lines = [line for line in body[: 2000 * rows].split("\n", 2 * rows)[: 2 * rows] if line.strip()][:rows]
    try:
        return list(csv.reader(lines, delimiter=separator))
    except csv.Error:
        return [line.split(separator) for line in lines]


def _without_empty_end(body: str, separator: str) -> str:
    """Without the empty lines and lines of bare separators spreadsheets leave at the end."""
    kept = len(body.rstrip(f"{separator} \t\n"))
    if not kept:
        return ""
    end = body.find("\n", kept)
    return body if end < 0 else body[:end]


def _read_carefully(
    body: str, separator: str, headers: Sequence[str], numeric: Sequence[int], text: Sequence[int],
    problems: Problems, first_line: int,
) -> CellTable:  # fmt: skip
    lines = _Lines(body, problems.place, first_line)
    reader = csv.reader(lines, delimiter=separator, strict=True)

    def rows() -> Iterator[tuple[int, list[str]]]:
        while True:
            line = lines.begin_row()
            try:
                row = next(reader, None)
            except csv.Error as error:
                raise _quote_error(problems.place, line, error) from error
            if row is None:
                return
            yield line, row

    return read_cells(rows(), headers, numeric=numeric, text=text, problems=problems)


def _quote_error(name: str, line: int, error: csv.Error) -> InputError:
    text = str(error)
    if "unexpected end" in text:
        what = 'a quote (") is opened and never closed'
    elif "field larger" in text:
        what = f'a cell has more than {csv.field_size_limit()} characters, or a quote (") is never closed'
    else:
        what = f"the quotes are wrong: {text}"
    return InputError(
        f"{name}, row {line}: {what}", field=f"row {line}", hint="quote a whole cell, or no quotes at all"
    )


class _Lines:
    """The lines of a text one by one; refuses a row that is longer than any can be."""

    def __init__(self, body: str, name: str, first_line: int) -> None:
        self._body, self._name = body, name
        self._position = 0
        self._line = first_line  # the next one
        self._row = first_line  # where the row begins
        self._begin = 0

    def __iter__(self) -> Iterator[str]:
        return self

    def __next__(self) -> str:
        begin = self._position
        if begin >= len(self._body):
            raise StopIteration
        end = self._body.find("\n", begin) + 1 or len(self._body)
        if end - self._begin > MAX_ROW_LENGTH:
            raise self._refused(f"the row has more than {MAX_ROW_LENGTH} characters")
        if self._line - self._row >= _MOST_LINES:
            raise self._refused(f'a quote (") is opened and not closed within {_MOST_LINES} lines')
        self._position, self._line = end, self._line + 1
        return self._body[begin:end]

    def begin_row(self) -> int:
        """The line of the file on which the next row begins."""
        self._begin, self._row = self._position, self._line
        return self._row

    def _refused(self, what: str) -> InputError:
        return InputError(
            f"{self._name}, row {self._row}: {what}", field=f"row {self._row}", hint="one line per reading"
        )
