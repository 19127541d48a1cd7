"""Readings that leap away and back are found; steps, tips, coarse records and noise are left alone."""

import numpy as np
import pytest

from mckibben.measurement import spikes
from mckibben.measurement.measurement import build
from mckibben.measurement.spikes import spiked_rows

ROWS = 400
TIME = np.arange(ROWS) * 0.05
PHASE = (TIME / 5.0) % 1.0
TRIANGLE = np.where(PHASE < 0.5, 2.0 * PHASE, 2.0 - 2.0 * PHASE)
NOISE = np.random.default_rng(3).standard_normal(ROWS)


@pytest.mark.parametrize("height", [150.0, -150.0])
@pytest.mark.parametrize("rows", [1, 2])
def test_one_row_or_two_are_found(height: float, rows: int) -> None:
    force = 400.0 * TRIANGLE + 1.5 * NOISE
    for start in (30, 222):
        force[start : start + rows] += height
    (reason, found) = next(iter(spiked_rows({"force": force}).items()))
    assert reason == "spikes of the force"
    assert set(np.flatnonzero(found)) == {start + k for start in (30, 222) for k in range(rows)}


UP, BOTH = [1, 1, 1, 1, 1, 1, 1], [1, -1, 1, 1, -1, 1, -1]


@pytest.mark.parametrize(
    ("height", "ways", "count"), [(150.0, UP, 0), (-150.0, UP, 0), (150.0, BOTH, 7), (300.0, UP, 7)]
)
def test_frequent_spikes_have_to_be_high_or_to_go_both_ways(
    height: float, ways: list[int], count: int
) -> None:
    """Seven in 400 rows: pulses of a signal, unless they go up and down or nothing else is as high by far."""
    force = 400.0 * TRIANGLE + 1.5 * NOISE
    rows = [20, 71, 130, 188, 222, 301, 370]
    force[rows] += height * np.array(ways)
    found = spiked_rows({"force": force})
    assert [np.flatnonzero(mask).tolist() for mask in found.values()] == ([rows] if count else [])


@pytest.mark.parametrize("at_once", [1, 7, 31, 400])
def test_spikes_are_found_wherever_a_long_record_is_cut(
    at_once: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    force = 400.0 * TRIANGLE + 1.5 * NOISE
    rows = [31, 62, 222]
    force[rows] += 150.0
    monkeypatch.setattr(spikes, "_AT_ONCE", at_once)
    (found,) = spiked_rows({"force": force}).values()
    assert np.flatnonzero(found).tolist() == rows


@pytest.mark.parametrize(
    "force",
    [
        400.0 * TRIANGLE + 1.5 * NOISE,
        400.0 * TRIANGLE,  # sharp tips
        400.0 * np.sign(np.sin(2.0 * np.pi * PHASE)) + 1.5 * NOISE,  # steps stay away
        400.0 * np.sin(2.0 * np.pi * TIME / 0.15),  # three rows a period
        40.0 * NOISE,
        np.where(np.arange(ROWS) % 10 == 0, 100.0, 0.0) + NOISE,  # a pulse train is no exception
        np.zeros(ROWS),
    ],
)
def test_what_is_no_spike_is_left_alone(force: np.ndarray) -> None:
    assert spiked_rows({"force": force}) == {}


def test_a_spike_does_not_count_and_is_told() -> None:
    force = 400.0 * (1.0 - TRIANGLE) + 100.0 + 1.5 * NOISE
    force[57] += 200.0
    columns = {"time": TIME, "pressure": np.full(ROWS, 3e5), "length": 0.3 - 0.03 * TRIANGLE, "force": force}
    measurement = build(columns, name="a.csv", id="0" * 64)
    assert np.flatnonzero(~measurement.usable).tolist() == [57]
    assert measurement.exclusions["spikes of the force"] == 1
    assert "1 of 400 rows are excluded: spikes of the force" in measurement.messages
