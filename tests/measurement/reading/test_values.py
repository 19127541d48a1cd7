"""Cells as people write them."""

from __future__ import annotations

import math
from datetime import datetime

import pytest

from mckibben.measurement.reading.numbers import (
    CLOCK,
    NUMBER,
    TEXT,
    NumberStyle,
    kind_of,
    number_of,
    seconds_of,
    style_of,
)

KINDS = {
    "1": "n", "-2.5": "n", "1,5": "n", "1.234,56": "n", "1 234,5": "n", "1'234.5": "n", "1,234.5": "n",
    "1e-3": "n", "": "", "-": "m", "NaN": "m", "n/a": "m", "abc": "t", "2 bar": "t", "0x1": "t",
    "10:15:02": "c", "10:15:02,118": "c", "14.03.2024": "c", "2024-03-14T09:30:00.200Z": "c",
    "3/14/2024 9:30:00 AM": "c", "1.2.3": "t",
}  # fmt: skip


@pytest.mark.parametrize("cell", KINDS)
def test_the_kind_of_a_cell(cell: str) -> None:
    assert kind_of(cell) == KINDS[cell]


@pytest.mark.parametrize(
    ("cells", "style", "values"),
    [
        (["1.234,56", "2,5"], NumberStyle(",", "."), [1234.56, 2.5]),
        (["1,234.56", "2.5"], NumberStyle(".", ","), [1234.56, 2.5]),
        (["0,250", "1.105"], NumberStyle(",", "."), [0.25, 1105.0]),
        (["1'234.5", "7"], NumberStyle(".", "'"), [1234.5, 7.0]),
        (["1 234,5", "7,0"], NumberStyle(",", " "), [1234.5, 7.0]),
        (["2,290", "4,579"], NumberStyle(",", ""), [2.29, 4.579]),
        (["1.234", "0.5"], NumberStyle(".", ""), [1.234, 0.5]),
    ],
)
def test_decimal_signs_and_thousands(cells: list[str], style: NumberStyle, values: list[float]) -> None:
    assert style_of(cells) == style
    assert [number_of(cell, style) for cell in cells] == values


@pytest.mark.parametrize(("text", "style"), [("1.6", NumberStyle(",", "")), ("1.65", NumberStyle(",", "."))])
def test_a_number_of_another_style_is_none(text: str, style: NumberStyle) -> None:
    assert math.isnan(number_of(text, style))


@pytest.mark.parametrize(("text", "value"), [("+    2.003", 2.003), ("-  17.5", -17.5), ("- 3", -3.0)])
def test_a_sign_may_stand_apart(text: str, value: float) -> None:
    assert kind_of(text) == NUMBER
    assert number_of(text, NumberStyle(".", "")) == value


@pytest.mark.parametrize(
    ("cells", "seconds"),
    [
        (["13:59:57,345", "13:59:59,045", "14:00:01"], [0.0, 1.7, 3.655]),
        (["23:59:59", "23:59:59.5", "0:00:00.5", "0:00:01"], [0.0, 0.5, 1.5, 2.0]),  # over midnight
        (["11:59:59 AM", "12:00:01 PM"], [0.0, 2.0]),
        (["2024-03-14T09:30:00.000Z", "2024-03-14T09:30:00.200Z"], [0.0, 0.2]),
        (["31.12.2023 23:59:59", "01.01.2024 00:00:01"], [0.0, 2.0]),
        ([datetime(2024, 3, 14, 9, 30), datetime(2024, 3, 14, 9, 30, 0, 100000)], [0.0, 0.1]),
        (["00:58,75", "01:00,25", "100:00.5"], [0.0, 1.5, 5941.75]),  # minutes and seconds
    ],
)
def test_times_count_from_the_first(cells: list[str | datetime], seconds: list[float]) -> None:
    assert seconds_of(cells) == pytest.approx(seconds, abs=1e-6)


def test_no_minute_has_75_seconds() -> None:
    assert (kind_of("00:00,25"), kind_of("12:75,5")) == (CLOCK, TEXT)
