"""A log without time that counts its rows: the counter may be the time, and nobody is left to guess it."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.measurement import Measurement
from mckibben.measurement.reading import read_measurement
from mckibben.measurement.reading.correction import spoken_correction


def log(rows: int, *, step: int = 1, columns: tuple[str, ...] = ()) -> Measurement:
    """A muscle that creeps under a weight."""
    number = np.arange(rows) * step + 1
    lines = [f"{n};20.0{n % 7};{30.0 + 2.0 * np.log(n):.3f};3.0{n % 3}" for n in number]
    text = "\n".join(["# rest length 300 mm", "Sample;Load [kgf];Stroke [mm];Pressure [bar]", *lines])
    return read_measurement(text.encode(), "log.csv", spoken_correction(columns=columns))


def told(found: Measurement) -> list[str]:
    return [message for message in found.messages if "counts the rows" in message]


def test_a_counter_beside_many_rows_without_time_is_pointed_out() -> None:
    (message,) = told(log(300))
    assert "time=Sample [0 to 1 counts = 0 to 2 s]" in message


def test_the_answer_is_the_time() -> None:
    found = log(300, columns=("time=Sample [0 to 1 counts = 0 to 2 s]",))
    assert found.columns["time"] == pytest.approx(2.0 * np.arange(1, 301))
    assert not told(found)


@pytest.mark.parametrize(("rows", "step"), [(60, 1), (300, 3)])
def test_points_by_hand_and_other_numbers_are_not(rows: int, step: int) -> None:
    assert not told(log(rows, step=step))
