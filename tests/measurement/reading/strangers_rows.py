"""Readings of a muscle of 300 mm for the tests of habits: pressure in bar, length in mm, pull in N."""

from __future__ import annotations

from collections.abc import Iterable

ROWS = 120
PRESSURE = [round(1.0 + 4.0 * n / (ROWS - 1), 3) for n in range(ROWS)]
LENGTH = [round(300.0 - 50.0 * n / (ROWS - 1), 2) for n in range(ROWS)]
PULL = [
    round(200.0 * p * max(0.0, 1.0 - (300.0 - L) / 75.0) + 5.0, 1)
    for p, L in zip(PRESSURE, LENGTH, strict=True)
]


def table(head: str, *columns: Iterable[float]) -> bytes:
    """A text table, its cells parted by semicolons."""
    rows = [";".join(f"{value:g}" for value in row) for row in zip(*columns, strict=True)]
    return "\n".join([head, *rows]).encode()
