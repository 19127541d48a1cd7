"""What passes from step to step: sheets, tables, evidence, the decision. None of it is changed once it is
made.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from datetime import datetime
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
#: A cell: a number, a text ("" = empty), or a date.
Cell = float | str | datetime


class Span(NamedTuple):
    """Where something stands in a file, ``line 7`` or ``sheet 'Info', row 3``, and its words."""

    where: str
    text: str


@dataclass(frozen=True)
class Sheet:
    """One sheet of cells, or columns that the file names itself.

    Attributes:
        name: of the sheet, group or struct; empty where the format has none.
        rows: its cells.
        noun: what one row is called, ``row`` or ``line``.
        format: ``csv``, ``xlsx``, ``json``, ``mat``, ``hdf5``, ``tdms`` or ``parquet``.
        decimal: the decimal sign of its texts.
        thousands: the mark between thousands; empty = none.
        arrays: name -> values, where the format keeps whole columns.
        units: name -> unit that stands apart from it.
        texts: what stands beside the columns.
        lines: number in the file of each row; empty = they count from 1.
        messages: what was assumed.
        bulk: (row before which it stands, numbers) of the middle of a long table, which are no cells.
        whole: the sheet with all of its rows as cells, where there is a bulk.
        dropped: (name, why) of what stands among its arrays and is no column.
        notes: what stands beside the table.
    """

    name: str = ""
    rows: list[list[Cell]] = field(default_factory=list)
    noun: str = "row"
    format: str = "csv"
    decimal: str = "."
    thousands: str = ""
    arrays: Mapping[str, Any] | None = None
    units: Mapping[str, str] = field(default_factory=dict)
    texts: tuple[Span, ...] = ()
    lines: tuple[int, ...] = ()
    messages: tuple[str, ...] = ()
    bulk: tuple[int, Array] | None = None
    whole: Callable[[], Sheet] | None = None
    dropped: tuple[tuple[str, str], ...] = ()
    notes: tuple[Span, ...] = ()

    def line(self, row: int) -> int:
        """Number in the file of a row."""
        return self.lines[row] if self.lines else row + 1

    def place(self, row: int) -> str:
        """Where a row stands, in words."""
        sheet = f"sheet '{self.name}', " if self.name and self.format in ("xlsx", "zip") else ""
        return f"{sheet}{self.noun} {self.line(row)}"


class Skip(NamedTuple):
    """Rows left out for one reason, and where the first of them is."""

    rows: int
    first: str


class Gap(NamedTuple):
    """A cell without a number: why (``empty``, ``no reading``, ..., ``broken``), and its text."""

    reason: str
    text: str


@dataclass(frozen=True)
class Column:
    """A column of a table.

    Attributes:
        head: its name as it stands in the file.
        values: its readings; NaN = the cell holds none.
        where: its place, for people.
        unit: text of the cell that holds its unit; empty = none.
        above: other texts over it; ``described``: those of a row that describes this column by its name.
        words: the texts of a column that holds no numbers.
        gaps: row -> what stands where no number stands.
        clock: times of day or dates, as seconds.
        place: its cell in the rows of the file; -1 = it stands in none.
        key: the head as users name it, where several are called alike.
    """

    head: str
    values: Array
    where: str
    unit: str = ""
    above: tuple[str, ...] = ()
    described: tuple[Span, ...] = ()
    words: tuple[str, ...] | None = None
    gaps: Mapping[int, Gap] = field(default_factory=dict)
    clock: bool = False
    place: int = -1
    key: str = ""

    @property
    def title(self) -> str:
        """What a user calls it."""
        return self.key or self.head.strip()


@dataclass(frozen=True)
class Table:
    """Columns of one length.

    Attributes:
        columns: all of them.
        texts: what stands beside the table.
        blocks: number of the block of each row.
        titles: what stands over each block.
        where: place of the table.
        noun: what the format calls a column.
        format: of the file.
        lines: number in the file of each row.
        head_row: number of the row of names; None = there is none.
        unit_where: where the units stand, if apart from the names.
        unit_row: number of the row of the units, if they have one.
        also: cells of a row that hold the same columns again, beside the first ones.
        others: columns that are in another table, and why they are not read.
        tables: titles of the tables that a user may pick, and whether each is read.
        rivals: titles of tables that could be meant as well.
        raw: the first rows as they stand: (number, cells).
        messages: what was assumed.
        headless: the file has no names; they were made.
        bad: row -> why it is none of the table, as "2 cells, the header has 3".
        dropped: (name, why) of what is called like a column and is none.
    """

    columns: tuple[Column, ...]
    texts: tuple[Span, ...]
    blocks: NDArray[np.intp]
    titles: tuple[tuple[Span, ...], ...] = ((),)
    where: str = ""
    noun: str = "column"
    format: str = "csv"
    lines: NDArray[np.int64] = field(default_factory=lambda: np.zeros(0, np.int64))
    head_row: int | None = None
    unit_where: str = ""
    unit_row: int | None = None
    also: tuple[int, ...] = ()
    others: tuple[tuple[str, str], ...] = ()
    tables: tuple[tuple[str, bool], ...] = ()
    rivals: tuple[tuple[str, str], ...] = ()
    raw: tuple[tuple[int, tuple[str, ...]], ...] = ()
    messages: tuple[str, ...] = ()
    headless: bool = False
    bad: Mapping[int, str] = field(default_factory=dict)
    dropped: tuple[tuple[str, str], ...] = ()

    @property
    def rows(self) -> int:
        """Number of rows."""
        return len(self.blocks)


#: Targets of evidence besides the number of a column: the file, and block k as ``BLOCK - k``.
FILE, BLOCK = -1, -2


class Evidence(NamedTuple):
    """A claim about a column, a block or the file, with its weight [nats] and where it stands."""

    target: int
    facet: str
    value: Any
    weight: float
    span: Span
    rule: str = ""


class Use(NamedTuple):
    """What a column may be: value in SI = sign * (scale * (reading - offset) in its unit - zero), less the
    air.

    ``unit`` is what the scaled reading is in; ``zero`` [SI] is subtracted before the sign.
    """

    channel: str
    unit: str
    sign: int = 1
    absolute: bool = False
    scale: float = 1.0
    offset: float = 0.0
    zero: float = 0.0
