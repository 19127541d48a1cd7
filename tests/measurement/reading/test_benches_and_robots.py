"""Habits of benches and controllers: printed pages, scatter, tenths of units, cycles, broken rows."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.reading import preview, read_measurement
from mckibben.physics.errors import InputError
from tests.measurement.reading.strangers_rows import LENGTH, PRESSURE, PULL, table

ROWS = len(PULL)


def test_the_head_of_a_page_is_no_block() -> None:
    lines = [f"{n + 1:8d}{L:12.2f}{F:12.1f}" for n, (L, F) in enumerate(zip(LENGTH, PULL, strict=True))]
    head = ["LAB   Page 1 of 2", "", "   Point      Length       Force", "                (mm)         (N)"]
    text = "\n".join(["p = 2 bar, L0 = 300 mm", *head, *lines[:30], "", *head, *lines[30:]])
    found = read_measurement(text.replace("1 of 2", "2 of 2", 1).encode(), "a.txt")
    np.testing.assert_allclose(found.columns["length"], np.array(LENGTH) / 1e3)
    assert len(set(found.columns["group"].tolist())) <= 2


def test_scatter_beside_a_mean_is_no_second_force() -> None:
    found = read_measurement(
        table("p [bar];L [mm];F [N];s(F) [N]", PRESSURE, LENGTH, PULL, [0.2] * ROWS), "a.csv"
    )
    np.testing.assert_allclose(found.columns["force"], PULL)


def test_a_count_may_be_a_tenth_of_a_unit() -> None:
    tenths = [round(10 * F) for F in PULL]
    found = read_measurement(table("p [bar];L [mm];F [0.1 N]", PRESSURE, LENGTH, tenths), "a.csv")
    np.testing.assert_allclose(found.columns["force"], np.array(tenths) / 10)


def test_a_label_row_says_the_scales_of_volts() -> None:
    rows = table("CH1;CH2;CH3", [p / 2 for p in PRESSURE], LENGTH, [F / 100 for F in PULL]).decode()
    text = f"Units;V;mm;V\nLabel;p 2 bar/V (gauge);L;F 100 N/V\n\n{rows}"
    found = read_measurement(text.encode(), "a.csv")
    np.testing.assert_allclose(found.columns["pressure"], np.array(PRESSURE) * 1e5)
    np.testing.assert_allclose(found.columns["force"], PULL)


def test_cycles_of_a_controller_are_no_groups() -> None:
    text = table(
        "Cycle;p [bar];x [mm];F [N]", range(1000, 1000 + ROWS), PRESSURE, [300 - L for L in LENGTH], PULL
    )
    asked = [q.about for q in preview(b"L0 = 300 mm\n" + text, "a.csv").questions if q.stops]
    assert asked == ["unit of time"]


@pytest.mark.parametrize("broken", ["0.7", "1.5;2.0", "1.5,290"])
def test_a_row_that_breaks_off_is_refused_or_counted(broken: str) -> None:
    lines = table("p [bar];L [mm];F [N]", PRESSURE, LENGTH, PULL).decode().split("\n")
    few = "\n".join([*lines[:12], broken, *lines[12:20]])
    with pytest.raises(InputError, match=r"row 13: .* the header has 3"):
        read_measurement(few.encode(), "a.csv")
    many = "\n".join([*lines[:12], broken, *lines[12:]])
    assert sum(read_measurement(many.encode(), "a.csv").skipped.values()) == 1
