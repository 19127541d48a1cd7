"""A file as rows of cells before anything in it has a meaning: the lines of a text, the rows of a sheet."""

from __future__ import annotations

import csv
import re
from collections import Counter
from collections.abc import Sequence
from typing import Protocol

from mckibben.measurement.read.cells import Cell
from mckibben.measurement.read.quantity import quantity_of
from mckibben.measurement.read.unit_words import dimension_of, unit_of
from mckibben.measurement.read.values import CLOCK, GAP, NUMBER, kind_of

#: Between the cells of a line: a sign, or any number of blanks.
BLANKS = " "
SEPARATORS = ("\t", ";", ",", "|", BLANKS)
_RULE = re.compile(r"[|:\-=+\s]*[-=]{2,}[|:\-=+\s]*")
#: A word, with what stands in brackets behind it or alone: "(DEG F)", "Pressure(bar abs)".
_BRACKETED = re.compile(r"(?:[^\s\[\](){}]*(?:\([^()]*\)|\[[^\[\]]*\]))+[^\s\[\]()]*|\S+")
_TWO_PAIRS = 4  # words
_SAMPLE = 600  # lines from which the separator is told


class Grid(Protocol):
    """Rows of cells.

    Attributes:
        place: file (and sheet), for messages.
        title: name of the sheet, group or struct; "" for a text.
    """

    place: str
    title: str

    def __len__(self) -> int:
        """Number of rows."""
        ...

    def cells(self, index: int) -> Sequence[Cell]:
        """The cells of a row."""
        ...

    def line(self, index: int) -> int:
        """1-based row in the file."""
        ...

    def where(self, index: int, column: int | None = None) -> str:
        """A row, or a cell of it, for people: ``line 4``, ``sheet 'Cover', B4``."""
        ...


class TextGrid:
    """The lines of a delimited text; comment signs before a line are left out."""

    title = ""

    def __init__(self, lines: Sequence[str], place: str, separator: str) -> None:
        self.place = place
        self.separator = separator
        self.lines = lines

    def __len__(self) -> int:
        return len(self.lines)

    def cells(self, index: int) -> Sequence[Cell]:
        """The cells of a line; a cell that is a percent sign alone is a unit, no comment."""
        line = self.lines[index]
        if self.separator != BLANKS and line.partition(self.separator)[0].strip() == "%":
            return split_line(line, self.separator)
        return split_line(re.sub(r"^\s*(?:[#%]+|//)\s*", "", line), self.separator)

    def line(self, index: int) -> int:
        """Number of the line."""
        return index + 1

    def where(self, index: int, column: int | None = None) -> str:
        """The line, for people."""
        return f"line {index + 1}"


class SheetGrid:
    """The rows of a sheet that are not empty, by their number."""

    def __init__(self, rows: Sequence[tuple[int, Sequence[Cell]]], place: str, title: str) -> None:
        self.place = place
        self.title = title
        filled = dict(rows)
        self._first = 1
        last = max(filled, default=0)
        # Rows far below each other are kept close: an empty row tells as much as a thousand.
        self._numbers: list[int] = []
        for number in sorted(filled):
            if self._numbers and number > self._numbers[-1] + 1:
                self._numbers.append(number - 1)
            self._numbers.append(number)
        self._rows = filled
        self._last = last

    def __len__(self) -> int:
        return len(self._numbers)

    def cells(self, index: int) -> Sequence[Cell]:
        """The cells of a row."""
        return self._rows.get(self._numbers[index], ())

    def line(self, index: int) -> int:
        """Number of the row."""
        return self._numbers[index]

    def where(self, index: int, column: int | None = None) -> str:
        """Sheet and cell, for people."""
        cell = f"row {self.line(index)}" if column is None else f"{column_letters(column)}{self.line(index)}"
        return f"sheet '{self.title}', {cell}" if self.title else cell


def column_letters(column: int) -> str:
    """A 0-based column as spreadsheets name it: 0 -> ``A``, 27 -> ``AB``."""
    name = ""
    column += 1
    while column:
        column, digit = divmod(column - 1, 26)
        name = chr(ord("A") + digit) + name
    return name


def split_line(line: str, separator: str) -> list[str]:
    """The cells of a line without blanks around them; quotes that do not match are kept."""
    if separator == BLANKS:
        # A bracket belongs to the word before it, but not to another bracket some blanks away.
        line = re.sub(r"(?<![\])\s])\s+(?=[\[(])|(?<=[\])])[ ](?=[\[(])", "", line)
        if line.count('"') > 1:
            return [cell.strip('"').strip() for cell in re.findall(r'"[^"]*"\S*|\S+', line)]
        return _BRACKETED.findall(line) if "(" in line or "[" in line else _with_units(line.split())
    if separator == "|":  # tables of notebooks have one at either end, and a line of dashes below the head
        line = line.strip()
        if _RULE.fullmatch(line):
            return []
        line = line.removeprefix("|").removesuffix("|")
    if '"' in line:
        try:
            return [
                cell.strip()
                for cell in next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])
            ]
        except csv.Error:
            pass
    return [cell.strip() for cell in line.split(separator)]


def _with_units(words: list[str]) -> list[str]:
    """Words of a head in which each name is followed by its unit, as ``mass [kg]``; others as they are."""
    names, units = words[::2], words[1::2]
    if len(words) < _TWO_PAIRS or len(names) != len(units) or any(word[:1].isdigit() for word in words):
        return words
    known = [unit_of(word) for word in units]
    if not all(unit is not None and dimension_of(unit.unit) for unit in known):
        return words
    if all(unit_of(word) is not None for word in names):
        return words  # a line of units
    return [f"{name} [{unit}]" for name, unit in zip(names, units, strict=True)]


def separator_of(lines: Sequence[str]) -> str:
    """The separator that gives the longest run of rows with equally many numbers."""
    best, most = ",", 0
    for separator in SEPARATORS:
        score = longest = rows = width = 0
        for line in lines[:_SAMPLE]:
            cells = split_line(line, separator) if line.strip() else []
            kinds = [NUMBER if quantity_of(cell) else kind_of(cell) for cell in cells]
            numbers = kinds.count(NUMBER) + kinds.count(CLOCK)
            texts = len(kinds) - numbers - kinds.count(GAP)
            if numbers >= 2 and numbers > texts and len(cells) == width:
                rows += 1
                longest = max(longest, rows)
                score = max(score, rows * numbers)
            elif numbers >= 2 and numbers > texts:
                rows, width = 1, len(cells)
                score = max(score, numbers)
            elif cells:
                rows = width = 0
        if score > most:
            best, most = separator, score
    return best if most else _by_width(lines)


def _by_width(lines: Sequence[str]) -> str:
    """The separator that gives most rows of equally many cells, some of them numbers; texts may be more."""
    best, most = ",", 0
    for separator in SEPARATORS[:-1]:
        rows = [split_line(line, separator) for line in lines[:_SAMPLE] if separator in line]
        widths = Counter(
            len(cells) for cells in rows if any(kind_of(cell) in (NUMBER, CLOCK) for cell in cells)
        )
        width, count = widths.most_common(1)[0] if widths else (0, 0)
        if width > 1 and count * width > most:
            best, most = separator, count * width
    return best
