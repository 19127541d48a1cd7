"""Short heads that a text of the file explains."""

from __future__ import annotations

import pytest

from mckibben.physics.errors import InputError
from tests.measurement.reading.isobaric import FORCE, PRESSURE, STROKE, assert_is_the_test, read, table

ROWS = "p;F;s\n" + table(PRESSURE * 1e3 + 960.0, FORCE, STROKE, separator=";")
AIR = "Luftdruck: 960 mbar\nRuhelänge: 300 mm\n"


def test_a_legend_says_what_short_heads_are() -> None:
    legend = "Legende: p = Absolutdruck in mbar, F = Zugkraft in N, s = Hub in mm\n"
    found = read(legend + AIR + ROWS)
    assert_is_the_test(found)
    assert any("explained by line 1" in message for message in found.messages)


def test_values_are_no_legend() -> None:
    with pytest.raises(InputError, match="has no unit"):
        read(f"p = 3 bar, F = 20 N, s = 4 mm\n{AIR}{ROWS}")


def test_numbers_as_fortran_writes_them() -> None:
    lines = [
        " ".join(f"{value:.6E}".replace("E", "D") for value in row)
        for row in zip(PRESSURE, FORCE, STROKE, strict=True)
    ]
    assert_is_the_test(read("RUN 7\nL0 = 3.00D+02 MM\nP(BAR) F(N) X(MM)\n" + "\n".join(lines)))
