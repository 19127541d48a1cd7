"""The rows of a delimited text: numbers and labels by column, and an error that names the row.

Two ways that give the same result. The careful one walks the rows with the csv module and knows the line of
every cell. The fast one (pandas, for large regular tables) leaves anything odd to the former.
"""

from __future__ import annotations

import csv
import io
import math
import re
from array import array
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mckibben.physics.errors import InputError

_POINT = re.compile(r"[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
_COMMA = re.compile(r"[+-]?(?:[0-9]+,[0-9]*|,[0-9]+)(?:[eE][+-]?[0-9]+)?")
FAST_FROM = 200_000  # characters; below, importing pandas costs more than it saves


class Labels(NamedTuple):
    """A text column: ``words[codes]``, words in order of first appearance."""

    codes: NDArray[np.intp]
    words: list[str]


class Table(NamedTuple):
    """``numbers`` and ``labels`` by column index; ``lines``: 1-based line of the file of each row."""

    numbers: dict[int, NDArray[np.float64]]
    labels: dict[int, Labels]
    lines: NDArray[np.int64]


def split_header(line: str, separator: str, *, name: str, row: int) -> list[str]:
    """The cells of a header line."""
    try:
        return next(csv.reader([line], delimiter=separator, strict=True, skipinitialspace=True), [])
    except csv.Error as error:
        raise _quote_error(name, row, error) from error


def read_table(
    body: str, separator: str, headers: Sequence[str], *, numeric: Sequence[int], text: Sequence[int],
    name: str, first_line: int,
) -> Table:  # fmt: skip
    """Read the lines below the header.

    Args:
        body: the lines, ended by ``\\n``.
        separator: one character.
        headers: all column headers.
        numeric: indices of the columns to read as numbers.
        text: indices of the columns to read as labels.
        name: file name, for messages.
        first_line: 1-based line of the file on which ``body`` begins.

    Raises:
        InputError: ragged rows, text or nothing or nan where a number must be, mixed decimal signs, an
            unterminated quote, no rows; names the first row and how many more there are.
    """
    body = _without_empty_end(body, separator)
    if not body:
        raise InputError(
            f"{name}: there are no rows below the header", field="rows", hint="one line per reading"
        )
    table = None
    if len(body) >= FAST_FROM:
        table = _read_fast(body, separator, len(headers), numeric, text, first_line)
    return table or _read_carefully(body, separator, headers, numeric, text, name, first_line)


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
    body: str, separator: str, width: int, numeric: Sequence[int], text: Sequence[int], first_line: int
) -> Table | None:
    """The table by pandas; None when anything is irregular."""
    comma = separator != "," and "," in body
    if '"' in body or "\n\n" in body or body[0] == "\n" or (comma and "." in body):
        return None
    raw = np.frombuffer(body.encode(), np.uint8)
    ends = np.append(np.flatnonzero(raw == ord("\n")), len(raw))
    before = np.searchsorted(np.flatnonzero(raw == ord(separator)), ends)
    if np.any(np.diff(before, prepend=0) != width - 1):
        return None
    import pandas as pd  # 150 ms: only when a large file comes

    columns = sorted((*numeric, *text))
    try:
        frame = pd.read_csv(
            io.StringIO(body), sep=separator, decimal="," if comma else ".", header=None, index_col=False,
            names=range(width), usecols=columns, dtype=dict.fromkeys(text, "category"), na_filter=False,
            low_memory=False, engine="c",
        )  # fmt: skip
    except (ValueError, OverflowError):  # includes pandas' ParserError; the careful way says what is wrong
        return None
    if len(frame) != len(ends):
        return None
    numbers = {}
    for index in numeric:
        if frame[index].dtype.kind not in "fiu":
            return None
        numbers[index] = frame[index].to_numpy(np.float64)
        if not np.isfinite(numbers[index]).all():
            return None
    labels = {}
    for index in text:
        codes, words = pd.factorize(frame[index])
        labels[index] = _stripped(codes, [str(word) for word in words])
    return Table(numbers, labels, np.arange(first_line, first_line + len(frame)))


def _stripped(codes: NDArray[np.intp], words: Sequence[str]) -> Labels:
    """Labels without surrounding blanks; words that become equal become one."""
    position: dict[str, int] = {}
    new = np.array([position.setdefault(word.strip(), len(position)) for word in words], dtype=np.intp)
    return Labels(new[codes], list(position))


class _Problems:
    """The first bad row and how many there are."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.first: InputError | None = None
        self.rows = 0

    def add(self, line: int, column: str | None, what: str, hint: str) -> None:
        self.rows += 1
        if self.first is None:
            where = f"row {line}" + (f", column '{column}'" if column else "")
            field = f"row {line}" + (f", column {column}" if column else "")
            self.first = InputError(f"{self.name}, {where}: {what}", field=field, hint=hint)

    def raise_any(self) -> None:
        if self.first is None:
            return
        more = f" (and {self.rows - 1} more such rows)" if self.rows > 1 else ""
        raise InputError(self.first.message + more, field=self.first.field, hint=self.first.hint)


def _read_carefully(
    body: str, separator: str, headers: Sequence[str], numeric: Sequence[int], text: Sequence[int],
    name: str, first_line: int,
) -> Table:  # fmt: skip
    width = len(headers)
    reader = csv.reader(io.StringIO(body), delimiter=separator, strict=True)
    numbers = {index: array("d") for index in numeric}
    codes = {index: array("q") for index in text}
    words: dict[int, dict[str, int]] = {index: {} for index in text}
    lines = array("q")
    problems = _Problems(name)
    style = ""  # the decimal sign of the file, once a cell has shown it
    start = 0
    while True:
        start = reader.line_num
        line = first_line + start
        try:
            row = next(reader, None)
        except csv.Error as error:
            raise _quote_error(name, line, error) from error
        if row is None:
            break
        if not row or (width > 1 and len(row) == 1 and not row[0].strip()):
            continue  # an empty line
        if len(row) != width:
            what = f"{len(row)} cells, the header has {width}"
            problems.add(line, None, what, _ragged_hint(len(row), width))
            continue
        for index in numeric:
            cell = row[index].strip()
            sign = ""
            if _POINT.fullmatch(cell):
                sign = "." if "." in cell else ""
            elif _COMMA.fullmatch(cell):
                sign = ","
            else:
                problems.add(line, headers[index], *_why_no_number(cell))
                break
            if sign:
                style = style or sign
                if sign != style:
                    what = f"'{cell[:30]}' has a decimal '{sign}', earlier cells a '{style}'"
                    problems.add(line, headers[index], what, "use one decimal sign in the whole file")
                    break
            value = float(cell.replace(",", "."))
            if not math.isfinite(value):
                problems.add(line, headers[index], f"'{cell[:30]}' is too large", "a finite number")
                break
            numbers[index].append(value)
        else:
            lines.append(line)
            for index in text:
                label = row[index].strip()
                codes[index].append(words[index].setdefault(label, len(words[index])))
    problems.raise_any()
    return Table(
        {index: np.array(values, dtype=np.float64) for index, values in numbers.items()},
        {i: Labels(np.array(values, dtype=np.intp), list(words[i])) for i, values in codes.items()},
        np.array(lines, dtype=np.int64),
    )


def _why_no_number(cell: str) -> tuple[str, str]:
    """(what is wrong, what would be right) for a cell that is no number."""
    if not cell:
        return "the cell is empty", "a number, or leave the row out"
    if cell.lower().lstrip("+-") in ("nan", "inf", "infinity", "na", "n/a", "none", "null"):
        return f"'{cell}' is not a number that can be used", "a finite number, or leave the row out"
    if re.fullmatch(r"[+-]?[0-9]{1,3}([.,' ][0-9]{3})+([.,][0-9]*)?", cell):
        return f"'{cell[:30]}' has a thousands separator", "digits and one decimal sign only"
    return f"{cell[:30]!r} is not a number", "a number; text belongs in a '#' line above the header"


def _ragged_hint(cells: int, width: int) -> str:
    if cells > width and cells % width == 0:
        return "with decimal commas the columns must be separated by ';' or tabs"
    return "every row needs one cell per column"


def _quote_error(name: str, line: int, error: csv.Error) -> InputError:
    text = str(error)
    if "unexpected end" in text or "field larger" in text:
        what = 'a quote (") is opened and never closed'
    else:
        what = f"the quotes are wrong: {text}"
    return InputError(
        f"{name}, row {line}: {what}", field=f"row {line}", hint="quote a whole cell, or no quotes at all"
    )
