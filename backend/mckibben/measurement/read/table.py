"""The rows of a delimited text.

Two ways that give the same result. The careful one walks the rows with the csv module and knows the line of
every cell. The fast one (pandas, for large tables) leaves odd rows, or a table of many, to the former.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.read.cells import CellTable, Labels, Problems, good_rows, no_rows, read_cells
from mckibben.physics.errors import InputError

FAST_FROM = 200_000  # characters; below, importing pandas costs more than it saves
_MANY_ODD = 1000  # rows


def split_header(line: str, separator: str, *, name: str, row: int) -> list[str]:
    """The cells of a header line."""
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
    problems = Problems(name, "column", skip=skip)
    table = None
    if len(body) >= FAST_FROM:
        table = _read_fast(body, separator, headers, numeric, text, problems, first_line)
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
    end = len(body)
    while end > 0:
        start = body.rfind("\n", 0, end) + 1
        if body[start:end].strip(f"{separator} \t"):
            break
        end = max(start - 1, 0)
    return body[:end]


def _read_fast(
    body: str, separator: str, headers: Sequence[str], numeric: Sequence[int], text: Sequence[int],
    problems: Problems, first_line: int,
) -> CellTable | None:  # fmt: skip
    """The table by pandas, its few odd rows by the careful way; None when more is odd."""
    width = len(headers)
    comma = separator != "," and "," in body
    if '"' in body or (width == 1 and "\n\n" in body) or (comma and "." in body):
        return None
    data = body.encode()
    raw = np.frombuffer(data, np.uint8)
    ends = np.append(np.flatnonzero(raw == ord("\n")), len(raw))
    before = np.searchsorted(np.flatnonzero(raw == ord(separator)), ends)
    odd = np.flatnonzero(np.diff(before, prepend=0) != width - 1)
    if len(odd) > _MANY_ODD or len(odd) == len(ends):
        return None
    regular = np.delete(np.arange(len(ends)), odd)
    import pandas as pd  # 150 ms: only when a large file comes

    columns = sorted((*numeric, *text))
    try:
        frame = pd.read_csv(
            io.BytesIO(_without(data, ends, odd)), sep=separator, decimal="," if comma else ".", header=None,
            index_col=False, names=range(width), usecols=columns, dtype=dict.fromkeys(text, "category"),
            na_filter=False, low_memory=False, engine="c",
        )  # fmt: skip
    except (ValueError, OverflowError):  # includes pandas' ParserError; the careful way says what is wrong
        return None
    if len(frame) != len(regular):
        return None
    numbers, good = {}, np.ones(len(regular), bool)
    for index in numeric:
        column: Any = frame[index]
        if column.dtype.kind not in "fiu":
            if column.dtype.kind == "b":
                return None
            column = pd.to_numeric(column.str.replace(",", ".") if comma else column, errors="coerce")
        numbers[index] = np.asarray(column, dtype=np.float64)
        good &= np.isfinite(numbers[index])
    suspects = np.sort(np.concatenate([odd, regular[~good]]))
    if len(suspects) > _MANY_ODD or not good.any():
        return None
    if len(suspects):
        rows = ((first_line + int(n), _cells(data, ends, int(n), separator)) for n in suspects)
        if any(True for _ in good_rows(rows, headers, numeric, problems)):
            problems.clear()
            return None  # odd, and right all the same
        problems.raise_any()
    labels = {}
    for index in text:
        chosen: Any = frame[index]
        codes, words = pd.factorize(chosen[good])
        labels[index] = _stripped(codes, [str(word) for word in words])
    kept = {index: values[good] if len(suspects) else values for index, values in numbers.items()}
    return CellTable(kept, labels, first_line + regular[good], problems.skipped)


def _without(data: bytes, ends: NDArray[np.intp], lines: NDArray[np.intp]) -> bytes:
    """The text without some of its lines."""
    if not len(lines):
        return data
    pieces, position = [], 0
    for line in lines.tolist():
        pieces.append(data[position : int(ends[line - 1]) + 1 if line else 0])
        position = int(ends[line]) + 1
    return b"".join([*pieces, data[position:]])


def _cells(data: bytes, ends: NDArray[np.intp], line: int, separator: str) -> list[str]:
    """The cells of one line."""
    text = data[int(ends[line - 1]) + 1 if line else 0 : int(ends[line])].decode()
    return next(csv.reader([text], delimiter=separator), [])


def _stripped(codes: NDArray[np.intp], words: Sequence[str]) -> Labels:
    """Labels without surrounding blanks; words that become equal become one."""
    position: dict[str, int] = {}
    new = np.array([position.setdefault(word.strip(), len(position)) for word in words], dtype=np.intp)
    return Labels(new[codes], list(position))


def _read_carefully(
    body: str, separator: str, headers: Sequence[str], numeric: Sequence[int], text: Sequence[int],
    problems: Problems, first_line: int,
) -> CellTable:  # fmt: skip
    reader = csv.reader(io.StringIO(body), delimiter=separator, strict=True)

    def rows() -> Iterator[tuple[int, list[str]]]:
        while True:
            line = first_line + reader.line_num
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
    if "unexpected end" in text or "field larger" in text:
        what = 'a quote (") is opened and never closed'
    else:
        what = f"the quotes are wrong: {text}"
    return InputError(
        f"{name}, row {line}: {what}", field=f"row {line}", hint="quote a whole cell, or no quotes at all"
    )
