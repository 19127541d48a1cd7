"""A run of rows of numbers within a sheet, with what stands above it."""

from __future__ import annotations

from dataclasses import dataclass, field

from mckibben.measurement.reading.model import Sheet, Span
from mckibben.measurement.reading.numbers import MARK, NUMBER, TEXT, kind_of


@dataclass
class Run:
    """Rows of numbers, and what stands above them."""

    sheet: Sheet
    rows: list[int] = field(default_factory=list)
    columns: list[int] = field(default_factory=list)
    above: list[int] = field(default_factory=list)
    heads: dict[int, str] = field(default_factory=dict)
    units: dict[int, str] = field(default_factory=dict)
    more: dict[int, tuple[str, ...]] = field(default_factory=dict)
    described: dict[int, tuple[Span, ...]] = field(default_factory=dict)
    title: list[Span] = field(default_factory=list)
    remarks: list[int] = field(default_factory=list)
    score: float = 0.0
    head_row: int | None = None
    unit_row: int | None = None

    @property
    def names(self) -> list[tuple[str, str]]:
        """Heads with their units, in their order."""
        return [
            (self.heads.get(c, "").strip(), self.units.get(c, ""))
            for c in sorted(set(self.heads) | set(self.columns))
        ]


def is_axis(sheet: Sheet, i: int) -> bool:
    """Whether a row of numbers behind a text is the upper axis of a map: the text, or one above it, names the
    axis down, full rows are below.
    """
    row = sheet.rows[i]
    numbers = [j for j, cell in enumerate(row) if kind_of(cell) == NUMBER]
    above = sheet.rows[i - 1] if i else []
    named = str(row[0]).strip() or sum(kind_of(cell) == TEXT for cell in above[:2]) == 2
    if len(numbers) < 3 or 0 in numbers or not named:
        return False
    full = 0
    for below in sheet.rows[i + 1 : i + 4]:
        at = [j for j, cell in enumerate(below) if kind_of(cell) in (NUMBER, MARK)]
        full += len(at) >= len(numbers) and 0 in at
    return full >= 2
