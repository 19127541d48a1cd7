"""Columns of counts whose meaning a text states: the time of a tick, of a sample, the states of a valve."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.reading.scales import valve_scale
from tests.measurement.reading.isobaric import FORCE, PRESSURE, ROWS, STROKE, TIME, read, table

COUNT = np.arange(ROWS) + 7.0
COMMAND = np.where(np.arange(ROWS) < ROWS // 2, 100.0, -100.0)

TIMES = {
    ("tick", "1 tick = 0.5 ms"): 0.5e-3,
    ("tick", "0.25 ms per tick"): 0.25e-3,
    ("sample", "sample period 2 ms"): 2e-3,
    ("Sample no", "sampling interval: 0.5 s"): 0.5,
    ("n", "sample rate 500 Hz"): 2e-3,
}
NO_TIMES = [
    ("tick", "the ticks are not evenly spaced"),
    ("sample", "sampling rate 10 kHz, averaged to one row"),
    ("sample", "sample period 2 ms; log interval 5 ms"),
    ("temperature of the wall", "1 tick = 0.5 ms"),
]


@pytest.mark.parametrize(("header", "text"), TIMES)
def test_the_time_of_a_count(header: str, text: str) -> None:
    rows = table(COUNT, PRESSURE, FORCE, STROKE)
    found = read(f"# {text}\n{header},pressure_bar,force_N,stroke_mm\n{rows}")
    np.testing.assert_allclose(np.diff(found.columns["time"]), TIMES[header, text])


@pytest.mark.parametrize(("header", "text"), NO_TIMES)
def test_no_time_of_a_count(header: str, text: str) -> None:
    rows = table(COUNT, PRESSURE, FORCE, STROKE)
    found = read(f"# {text}\n{header},pressure_bar,force_N,stroke_mm\n{rows}")
    assert "time" not in found.columns
    assert any("no time: " in message for message in found.messages) == (header == "sample")


@pytest.mark.parametrize("head", ["# 1 count = 0.5 s\n", "tool 4\n1 count = 0.5 s\n\n"])
def test_a_column_of_counts_is_a_time_from_the_first_row(head: str) -> None:
    found = read(f"{head}count,pressure_bar,force_N,stroke_mm\n{table(COUNT, PRESSURE, FORCE, STROKE)}")
    np.testing.assert_allclose(found.columns["time"], TIME, atol=1e-12)
    assert any(
        "'count' is scaled: '" in message and "1 count = 0.5 s'" in message for message in found.messages
    )


def test_a_time_of_its_own_is_left_alone() -> None:
    rows = table(TIME * 3.0, COUNT, PRESSURE, FORCE, STROKE)
    found = read(f"# 1 count = 0.5 s\nt_s,count,pressure_bar,force_N,stroke_mm\n{rows}")
    np.testing.assert_allclose(found.columns["time"], TIME * 3.0)
    assert [column for column, _ in found.unread] == ["count"]


STATES = {
    "cmd: 100 = fully open to fill, 0 = closed, -100 = fully open to exhaust": (0.01, 0.0),
    "cmd [%]: 100 % = fill, 0 = closed, -100 % = exhaust": (0.01, 0.0),
    "cmd = 0 = exhaust, 50 = closed, 100 = fill": (0.02, -1.0),
}
NO_STATES = [
    "cmd: 100 = fully open to fill, -100 = fully open to exhaust",
    "cmd: 100 = fill, 0 = closed, -50 = exhaust",
    "cmd: 100 = 6 bar, 0 = 0 bar",
    "cmd: from the controller",
]


@pytest.mark.parametrize("text", STATES)
def test_the_states_of_a_valve(text: str) -> None:
    found = valve_scale(text)
    assert found is not None
    assert (found.factor, -found.offset * found.factor) == pytest.approx(STATES[text])


@pytest.mark.parametrize("text", NO_STATES)
def test_no_states_of_a_valve(text: str) -> None:
    assert valve_scale(text) is None


def test_states_of_another_column_are_none_of_this_one() -> None:
    head = "# other: 100 = fill, 0 = closed, -100 = exhaust\n# load_mass: 5 kg\n"
    found = read(f"{head}t_s,cmd [%],pressure_bar,stroke_mm\n{table(TIME, COMMAND, PRESSURE, STROKE)}")
    assert "command" not in found.columns


def test_a_column_with_stated_states_is_the_command() -> None:
    head = "# cmd: 100 = fill, 0 = closed, -100 = exhaust\n# load_mass: 5 kg\n"
    found = read(f"{head}t_s,cmd [%],pressure_bar,stroke_mm\n{table(TIME, COMMAND, PRESSURE, STROKE)}")
    np.testing.assert_allclose(found.columns["command"], COMMAND / 100.0)
    assert found.kind == "transient"
    assert any(
        "'cmd [%]' is scaled: '100 = fill, 0 = closed, -100 = exhaust' (line 1)" in message
        for message in found.messages
    )
    rows = table(TIME, COMMAND, PRESSURE, STROKE)
    silent = read(f"# load_mass: 5 kg\nt_s,cmd [%],pressure_bar,stroke_mm\n{rows}")
    assert "command" not in silent.columns
