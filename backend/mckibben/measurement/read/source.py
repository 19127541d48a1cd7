"""One table of a file before its columns have a meaning: what every reader of a format gives."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.read.cells import MAX_WORDS, CellTable, Labels, added, check_words, no_rows
from mckibben.measurement.read.conditions import Note
from mckibben.measurement.read.limits import check_rows
from mckibben.measurement.read.raw import RawRows
from mckibben.physics.errors import InputError

SAMPLE_ROWS = 8
#: (indices of numeric columns, of text columns, leave bad rows out) -> the table.
ReadRows = Callable[[Sequence[int], Sequence[int], bool], CellTable]
HeaderColumn = NDArray[np.float64] | list[str]


@dataclass(frozen=True)
class RawTable:
    """A table of a file.

    Attributes:
        place: file (and sheet), for messages.
        format: ``csv``, ``json``, ``xlsx``, ``mat``, ``hdf5`` or ``tdms``.
        headers: names of the columns, units in them where the format keeps them apart.
        read: reads the rows of the wanted columns.
        sample: the first rows as texts.
        notes: conditions as the file says them.
        messages: what was assumed.
        header_row: 1-based row of the header, None where the format has none.
        noun: what the format calls a column.
        units: units that stand apart from the headers, one per header; empty = none do.
        unit_where: where they stand, for people.
        clocks: columns of times of day or dates, which count from their first row.
        rest: texts of the file that belong to no table, and where they stand.
        unread: columns of the file that are not among ``headers``, and why.
        choices: other tables of the file that could be meant: (option that picks it, what it is).
        raw: the first rows as they stand in the file; None where the format has no rows.
        tables: the tables that the user may pick by name, and whether each is read.
        unzeroed: columns read by a scale of which the file does not say at which reading the value is 0.
        stood: the headers with their units before anything was computed; empty = they are the same.
    """

    place: str
    format: str
    headers: list[str]
    read: ReadRows
    sample: list[list[str]]
    notes: list[Note] = field(default_factory=list)
    messages: list[str] = field(default_factory=list)
    header_row: int | None = None
    noun: str = "column"
    units: tuple[str | None, ...] = ()
    unit_where: str = ""
    clocks: frozenset[int] = frozenset()
    rest: tuple[tuple[str, str], ...] = ()
    unread: tuple[tuple[str, str], ...] = ()
    choices: tuple[tuple[str, str], ...] = ()
    raw: RawRows | None = None
    tables: tuple[tuple[str, bool], ...] = ()
    unzeroed: frozenset[int] = frozenset()
    stood: tuple[str, ...] = ()


def array_source(
    columns: Mapping[str, HeaderColumn],
    *,
    place: str,
    format: str,
    noun: str,
    notes: list[Note],
    messages: list[str],
) -> RawTable:
    """The source of a format that keeps whole columns: numbers as arrays, words as lists, all equally long.

    A value that is not finite is such a format's way to say "missing": its rows are left out, with a count.
    """
    headers = list(columns)
    values = list(columns.values())

    def read(numeric: Sequence[int], text: Sequence[int], skip: bool) -> CellTable:
        numbers = {}
        for index in numeric:
            column = values[index]
            if isinstance(column, list):
                raise InputError(
                    f"{place}, {noun} '{headers[index]}', row 1: {column[0][:30] if column else ''!r} "
                    "is not a number",
                    field=f"{noun} {headers[index]}",
                    hint="a vector of numbers",
                )
            numbers[index] = column
        labels = {index: _labels(values[index]) for index in text}
        for index, label in labels.items():
            check_words(len(label.words), place, noun, headers[index])
        rows = _length(values)
        if rows == 0:
            raise no_rows(place)
        check_rows(rows, place)
        lines = np.arange(1, rows + 1)
        bad, first, skipped = np.zeros(rows, bool), "", {}
        for index, column in numbers.items():
            missing = ~np.isfinite(column) & ~bad
            if missing.any():
                first = f"row {int(np.argmax(missing)) + 1}, {noun} '{headers[index]}'"
                count = int(np.count_nonzero(missing))
                skipped = added(skipped, "not a finite number", count, first)
                bad |= missing
        if bad.all():
            raise no_rows(place, skipped)
        if not bad.any():
            return CellTable(numbers, labels, lines, skipped)
        keep = ~bad
        return CellTable(
            {index: column[keep] for index, column in numbers.items()},
            {index: Labels(label.codes[keep], label.words) for index, label in labels.items()},
            lines[keep],
            skipped,
        )

    sample = [[_shown(column[row]) for column in values] for row in range(min(SAMPLE_ROWS, _length(values)))]
    return RawTable(
        place=place,
        format=format,
        headers=headers,
        read=read,
        sample=sample,
        notes=notes,
        messages=messages,
        header_row=None,
        noun=noun,
    )


def _length(values: Sequence[HeaderColumn]) -> int:
    return len(values[0]) if values else 0


def _shown(value: float | str) -> str:
    return value if isinstance(value, str) else f"{value:.10g}"


def _labels(column: HeaderColumn) -> Labels:
    words: dict[str, int] = {}
    if isinstance(column, list):
        codes = [words.setdefault(word.strip(), len(words)) for word in column]
        return Labels(np.array(codes, dtype=np.intp), list(words))
    unique, first, inverse = np.unique(column, return_index=True, return_inverse=True)
    if len(unique) > MAX_WORDS:  # refused by whoever asked
        return Labels(inverse, [""] * len(unique))
    order = np.argsort(first)  # in order of first appearance
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    return Labels(rank[inverse], [f"{value:.10g}" for value in unique[order]])
