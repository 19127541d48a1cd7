"""The rows of a large delimited text by pandas: a few odd rows by the careful way, none of it when many are.

The text is read in pieces: it takes little more memory than it has, and other threads come in between.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.read.cells import CellTable, Labels, Problems, check_words, good_rows
from mckibben.measurement.read.limits import MAX_ROW_LENGTH

_MANY_ODD = 1000  # rows
_PIECE = 8_000_000  # bytes


class _PlainLines(NamedTuple):
    """Lines of a text: where each ends, and the numbers of those with another number of cells."""

    data: bytes
    ends: NDArray[np.intp]
    odd: NDArray[np.intp]

    def begin(self, line: int) -> int:
        """Where a line begins."""
        return int(self.ends[line - 1]) + 1 if line else 0

    def cells(self, line: int, separator: str) -> list[str]:
        """The cells of one line; raises csv.Error."""
        text = self.data[self.begin(line) : int(self.ends[line])].decode()
        return next(csv.reader([text], delimiter=separator), [])

    def regular(self, first: int, last: int) -> tuple[bytes, NDArray[np.intp]]:
        """The text of some lines without the odd ones, and their numbers."""
        odd = self.odd[np.searchsorted(self.odd, first) : np.searchsorted(self.odd, last)]
        pieces, position = [], self.begin(first)
        for line in odd.tolist():
            pieces.append(self.data[position : self.begin(line)])
            position = int(self.ends[line]) + 1
        pieces.append(self.data[position : int(self.ends[last - 1]) + 1])
        return b"".join(pieces), np.delete(np.arange(first, last), odd - first)

    def blocks(self) -> Iterator[tuple[int, int]]:
        """First line and last (exclusive) of pieces of the text."""
        first = 0
        while first < len(self.ends):
            last = int(np.searchsorted(self.ends, self.begin(first) + _PIECE))
            last = min(max(last, first + 1), len(self.ends))
            yield first, last
            first = last


class _Format(NamedTuple):
    """How the lines are to be read."""

    separator: str
    decimal: str
    width: int
    numeric: Sequence[int]
    text: Sequence[int]


class _Piece(NamedTuple):
    """Good rows of some lines, with the number of their line, and the lines that are not."""

    numbers: dict[int, NDArray[np.float64]]
    codes: dict[int, NDArray[np.intp]]
    lines: NDArray[np.intp]
    bad: NDArray[np.intp]


def read_fast(
    body: str, separator: str, headers: Sequence[str], *, numeric: Sequence[int], text: Sequence[int],
    problems: Problems, first_line: int,
) -> CellTable | None:  # fmt: skip
    """The table, None when too much of it is odd; arguments as those of `read_table`."""
    width = len(headers)
    comma = separator != "," and "," in body
    if '"' in body or (width == 1 and "\n\n" in body) or (comma and "." in body):
        return None
    lines = _lines(body.encode(), separator, width)
    if len(lines.odd) > _MANY_ODD or len(lines.odd) == len(lines.ends):
        return None
    form = _Format(separator, "," if comma else ".", width, numeric, text)
    words: dict[int, dict[str, int]] = {index: {} for index in text}
    pieces: list[_Piece] = []
    suspects = len(lines.odd)
    for first, last in lines.blocks():
        piece = _piece(lines, first, last, form, words)
        suspects += 0 if piece is None else len(piece.bad)
        if piece is None or suspects > _MANY_ODD:
            return None
        pieces.append(piece)
        for index in text:
            check_words(len(words[index]), problems.place, problems.noun, headers[index])
    if not any(len(piece.lines) for piece in pieces):
        return None
    bad = np.sort(np.concatenate([lines.odd, *(piece.bad for piece in pieces)]))
    if len(bad) and not _told(lines, bad, separator, headers, numeric, problems, first_line):
        return None
    numbers = {index: np.concatenate([piece.numbers.pop(index) for piece in pieces]) for index in numeric}
    labels = {
        index: Labels(np.concatenate([piece.codes.pop(index) for piece in pieces]), list(words[index]))
        for index in text
    }
    rows = np.concatenate([piece.lines for piece in pieces])
    problems.raise_any(len(rows))
    return CellTable(numbers, labels, first_line + rows, problems.skipped)


def _lines(data: bytes, separator: str, width: int) -> _PlainLines:
    raw = np.frombuffer(data, np.uint8)
    found = [
        begin + np.flatnonzero(raw[begin : begin + _PIECE] == ord("\n"))
        for begin in range(0, len(raw), _PIECE)
    ]
    ends = np.concatenate([*found, [len(raw)]])
    begins = np.concatenate([[0], ends[:-1] + 1])
    marks = (raw == ord(separator)).view(np.uint8)
    counts = np.add.reduceat(marks, begins, dtype=np.int32)
    return _PlainLines(data, ends, np.flatnonzero(counts != width - 1))


def _piece(
    lines: _PlainLines, first: int, last: int, form: _Format, words: dict[int, dict[str, int]]
) -> _Piece | None:
    """Some lines read; None when pandas makes something else of them. New words join the known ones."""
    import pandas as pd  # 150 ms: only when a large file comes

    content, rows = lines.regular(first, last)
    if not len(rows):
        return _Piece(
            {index: np.empty(0) for index in form.numeric},
            {index: np.empty(0, np.intp) for index in form.text},
            rows,
            rows,
        )
    try:
        frame = pd.read_csv(
            io.BytesIO(content), sep=form.separator, decimal=form.decimal, header=None, index_col=False,
            names=range(form.width), usecols=sorted((*form.numeric, *form.text)),
            dtype=dict.fromkeys(form.text, "category"), na_filter=False, low_memory=False, engine="c",
        )  # fmt: skip
    except (ValueError, OverflowError):  # includes pandas' ParserError; the careful way says what is wrong
        return None
    if len(frame) != len(rows):
        return None
    numbers, good = {}, np.ones(len(rows), bool)
    for index in form.numeric:
        column: Any = frame[index]
        if column.dtype.kind not in "fiu":
            if column.dtype.kind == "b":
                return None
            column = column.str.replace(",", ".") if form.decimal == "," else column
            column = pd.to_numeric(column, errors="coerce")
        numbers[index] = np.asarray(column, dtype=np.float64)
        good &= np.isfinite(numbers[index])
    codes = {}
    for index in form.text:
        chosen: Any = frame[index]
        own, found = pd.factorize(chosen[good])
        known = words[index]  # words that differ by blanks around them are one
        new = [known.setdefault(str(word).strip(), len(known)) for word in found]
        codes[index] = np.array(new, dtype=np.intp)[own]
    if not good.all():
        numbers = {index: values[good] for index, values in numbers.items()}
    return _Piece(numbers, codes, rows[good], rows[~good])


def _told(
    lines: _PlainLines, bad: NDArray[np.intp], separator: str, headers: Sequence[str], numeric: Sequence[int],
    problems: Problems, first_line: int,
) -> bool:  # fmt: skip
    """Whether every bad line is one by the careful way too; then the problems know them."""
    if max(int(lines.ends[line]) - lines.begin(line) for line in bad.tolist()) > MAX_ROW_LENGTH:
        return False
    rows = ((first_line + line, lines.cells(line, separator)) for line in bad.tolist())
    try:
        if any(True for _ in good_rows(rows, headers, numeric, problems)):
            problems.clear()
            return False  # odd, and right all the same
    except csv.Error:
        problems.clear()
        return False
    problems.raise_any()
    return True
