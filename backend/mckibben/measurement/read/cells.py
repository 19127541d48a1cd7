"""Rows of cells to numbers and labels by column; a bad row is an error that names it, or is counted."""

from __future__ import annotations

import math
import re
from array import array
from collections.abc import Iterable, Iterator, Mapping, Sequence
from datetime import datetime, timedelta
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.read.words import MARKERS
from mckibben.physics.errors import InputError

Cell = str | float | int | bool | datetime | timedelta | None

_POINT = re.compile(r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?")
_COMMA = re.compile(r"[+-]?(?:[0-9]+,[0-9]*|,[0-9]+)(?:[eE][+-]?[0-9]+)?")
_MARKERS = {text: reason for reason, texts in MARKERS.items() for text in texts}
_SIGNS = re.compile(r"([-+*#?<>.–—_])\1+")  # "--", "+++++++", "####"
_SHOWN = 30
MAX_WORDS = 200_000  # different ones in a column


def marker_of(text: str) -> str | None:
    """Why a text stands where a number should: "no reading", "out of range"; None = no such text.

    >>> marker_of("OL")
    'out of range'
    """
    bare = text.strip().lower()
    if (reason := _MARKERS.get(bare)) is not None:
        return reason
    if _SIGNS.fullmatch(bare):
        return "out of range" if bare[0] in "+#<>" else "no reading"
    return None


class Labels(NamedTuple):
    """A text column: ``words[codes]``, words in order of first appearance."""

    codes: NDArray[np.intp]
    words: list[str]


class Skip(NamedTuple):
    """Rows left out for one reason, and where the first of them is."""

    rows: int
    first: str


class CellTable(NamedTuple):
    """``numbers`` and ``labels`` by column index; ``lines``: 1-based row of the file of each row.

    ``skipped``: reason -> rows that are not in the table.
    """

    numbers: dict[int, NDArray[np.float64]]
    labels: dict[int, Labels]
    lines: NDArray[np.int64]
    skipped: Mapping[str, Skip] = {}

    def only(self, keep: NDArray[np.bool_], reason: str, first: str) -> CellTable:
        """The table without the other rows, which are counted under a reason."""
        return CellTable(
            {index: values[keep] for index, values in self.numbers.items()},
            {index: Labels(label.codes[keep], label.words) for index, label in self.labels.items()},
            self.lines[keep],
            added(self.skipped, reason, int(np.count_nonzero(~keep)), first),
        )


def check_words(count: int, place: str, noun: str, header: str) -> None:
    """Refuse a column of more words than directions or groups have."""
    if count > MAX_WORDS:
        raise InputError(
            f"{place}, {noun} '{header}': it has more than {MAX_WORDS} different words",
            field=f"{noun} {header}",
            hint="a word per direction, group or sample, not per row",
        )


def added(skipped: Mapping[str, Skip], reason: str, rows: int, first: str) -> dict[str, Skip]:
    """The counts with some more rows left out."""
    before = skipped.get(reason)
    return {**skipped, reason: Skip(rows + (before.rows if before else 0), before.first if before else first)}


class Problems:
    """Bad rows: the first one to raise, or all of them counted by reason.

    Rows without a reading in a column that is used (an empty cell, ``NaN``, ``OL``) are left out and
    counted, unless there are more of them than of others and too few others.

    Args:
        place: the file (and sheet), for messages.
        noun: what the format calls a column.
        skip: count instead of raising.
    """

    def __init__(self, place: str, noun: str, *, skip: bool) -> None:
        self.place = place
        self.noun = noun
        self.skip = skip
        self.first: InputError | None = None
        self.missing: InputError | None = None
        self.rows = self.without = 0
        self.skipped: dict[str, Skip] = {}

    def clear(self) -> None:
        """Forget all of them."""
        self.first, self.rows, self.skipped, self.missing, self.without = None, 0, {}, None, 0

    def add(
        self, line: int, column: str | None, what: str, hint: str, *, reason: str, missing: bool = False
    ) -> None:
        """One more bad row; ``missing``: it only lacks a reading."""
        where = f"row {line}" + (f", {self.noun} '{column}'" if column else "")
        if self.skip or missing:
            self.skipped = added(self.skipped, reason, 1, where)
        field = f"row {line}" + (f", {self.noun} {column}" if column else "")
        if missing and not self.skip:
            self.without += 1
            if self.missing is None:
                self.missing = InputError(f"{self.place}, {where}: {what}", field=field, hint=hint)
        elif not self.skip:
            self.rows += 1
            if self.first is None:
                self.first = InputError(f"{self.place}, {where}: {what}", field=field, hint=hint)

    def raise_any(self, kept: int | None = None) -> None:
        """Raise the first one, with the number of the others; of those without a reading when most are.

        ``kept``: number of good rows; None = not known yet.
        """
        first, rows = self.first, self.rows
        if first is None and kept is not None and self.without > kept and not _suffices(kept, self.without):
            first, rows = self.missing, self.without
        if first is None:
            return
        more = f" (and {rows - 1} more such rows)" if rows > 1 else ""
        raise InputError(first.message + more, field=first.field, hint=first.hint)


def _suffices(kept: int, without: int) -> bool:
    """Whether the rows with readings make a test although most others have none: a muscle that is slack."""
    return kept >= _ENOUGH_ROWS and without <= _MOST_WITHOUT * kept


_ENOUGH_ROWS = 20
_MOST_WITHOUT = 4  # rows without a reading for each other one; more are a slow signal or a wrong column


def read_cells(
    rows: Iterable[tuple[int, Sequence[Cell]]], headers: Sequence[str], *, numeric: Sequence[int],
    text: Sequence[int], problems: Problems,
) -> CellTable:  # fmt: skip
    """Walk rows of cells.

    Args:
        rows: (1-based row of the file, cells); rows that are empty throughout are passed over.
        headers: all column headers.
        numeric: indices of the columns to read as numbers.
        text: indices of the columns to read as labels.
        problems: what becomes of bad rows.

    Raises:
        InputError: ragged rows, text or nothing or nan where a number must be, mixed decimal signs, no rows
            left; names the first row and how many more there are.
    """
    numbers = {index: array("d") for index in numeric}
    codes = {index: array("q") for index in text}
    words: dict[int, dict[str, int]] = {index: {} for index in text}
    lines = array("q")
    for line, row, values in good_rows(rows, headers, numeric, problems):
        lines.append(line)
        for index, value in zip(numeric, values, strict=True):
            numbers[index].append(value)
        for index in text:
            label = _word(row[index])
            codes[index].append(words[index].setdefault(label, len(words[index])))
            if codes[index][-1] >= MAX_WORDS:
                check_words(len(words[index]), problems.place, problems.noun, headers[index])
    problems.raise_any(len(lines))
    if not lines:
        raise no_rows(problems.place, problems.skipped)
    return CellTable(
        {index: np.array(values, dtype=np.float64) for index, values in numbers.items()},
        {i: Labels(np.array(values, dtype=np.intp), list(words[i])) for i, values in codes.items()},
        np.array(lines, dtype=np.int64),
        problems.skipped,
    )


def good_rows(
    rows: Iterable[tuple[int, Sequence[Cell]]], headers: Sequence[str], numeric: Sequence[int],
    problems: Problems,
) -> Iterator[tuple[int, Sequence[Cell], list[float]]]:  # fmt: skip
    """(row of the file, cells, numbers of the numeric columns) of the good rows; the others are problems."""
    width = len(headers)
    style = ""  # the decimal sign of the file, once a cell has shown it
    for line, row in rows:
        if not row or (width > 1 and len(row) == 1 and not str(row[0]).strip()):
            continue  # an empty line
        if len(row) != width:
            what = f"{len(row)} cells, the header has {width}"
            problems.add(line, None, what, _ragged_hint(len(row), width), reason="another number of cells")
            continue
        values = []
        for index in numeric:
            value, sign = _number(row[index])
            if isinstance(value, str):
                what, hint = _why_no_number(value, headers[index] or f"column {index + 1}")
                missing = not value or marker_of(value) is not None
                problems.add(line, headers[index], what, hint, reason=_reason(value), missing=missing)
                break
            if sign and sign != style:
                if style:
                    cell = str(row[index]).strip()[:_SHOWN]
                    what = f"'{cell}' has a decimal '{sign}', earlier cells a '{style}'"
                    hint = "use one decimal sign in the whole file"
                    problems.add(line, headers[index], what, hint, reason="mixed decimal signs")
                    break
                style = sign
            values.append(value)
        else:
            yield line, row, values


def no_rows(place: str, skipped: Mapping[str, Skip] = {}) -> InputError:
    """The refusal of a table of which nothing remains."""
    if not skipped:
        return InputError(
            f"{place}: there are no rows below the header", field="rows", hint="one line per reading"
        )
    reason, first = next((reason, skip.first) for reason, skip in skipped.items())
    return InputError(
        f"{place}, {first}: no row can be read ({reason})", field=first, hint="correct the columns"
    )


def _number(cell: Cell) -> tuple[float | str, str]:
    """(value, decimal sign it was written with), or (the text that is no number, "")."""
    if isinstance(cell, (float, int)) and not isinstance(cell, bool):
        return (float(cell), "") if math.isfinite(cell) else (repr(cell), "")
    if isinstance(cell, (datetime, timedelta)):
        return cell.total_seconds() if isinstance(cell, timedelta) else cell.timestamp(), ""
    text = "" if cell is None else str(cell).strip()
    if text[:1] in ("+", "-"):  # loggers set the sign apart: "+    2.003"
        text = text[0] + text[1:].lstrip()
    if _POINT.fullmatch(text):
        sign = "." if "." in text else ""
    elif _COMMA.fullmatch(text):
        sign = ","
    else:
        return text, ""
    value = float(text.replace(",", "."))
    return (value, sign) if math.isfinite(value) else (text, "")


def _word(cell: Cell) -> str:
    if isinstance(cell, float) and cell.is_integer():
        return str(int(cell))  # a spreadsheet keeps every number as a float
    return "" if cell is None else str(cell).strip()


def _reason(cell: str) -> str:
    if not cell:
        return "an empty cell"
    return marker_of(cell) or "not a number"


def _why_no_number(cell: str, column: str) -> tuple[str, str]:
    """(what is wrong, what would be right) for a cell that is no number."""
    unwanted = f'or leave the column out: --ignore "{column}"'
    if not cell:
        return "the cell is empty", f"a number, {unwanted}"
    if marker_of(cell) is not None:
        return f"'{cell}' is not a number that can be used", f"a finite number, {unwanted}"
    if _POINT.fullmatch(cell) or _COMMA.fullmatch(cell):
        return f"'{cell[:_SHOWN]}' is too large", "a finite number"
    if re.fullmatch(r"[+-]?[0-9]{1,3}([.,' ][0-9]{3})+([.,][0-9]*)?", cell):
        return f"'{cell[:_SHOWN]}' has a thousands separator", "digits and one decimal sign only"
    return f"{cell[:_SHOWN]!r} is not a number", "a number; text belongs in a '#' line above the header"


def _ragged_hint(cells: int, width: int) -> str:
    if cells > width and cells % width == 0:
        return "with decimal commas the columns must be separated by ';' or tabs"
    return "every row needs one cell per column"
