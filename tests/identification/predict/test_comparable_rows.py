"""Rows beside a corner of the motion: the velocity fitted over neighbours mixes the speeds of both sides."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.identification.predict.comparable_rows import jumps
from mckibben.measurement.derivative import rates
from mckibben.measurement.motion import RecordedMotion, directions

STEP = 0.34  # s


def flagged(time: np.ndarray, length: np.ndarray) -> np.ndarray:
    rate = rates(time, length)
    moved = RecordedMotion(rate.value, rate.sigma, directions(rate.value, rate.sigma), False, ())
    return jumps(time, length, moved, np.zeros(len(time), np.int64))


def triangle(time: np.ndarray, period: float) -> np.ndarray:
    """Length between 220 and 280 mm, turning suddenly."""
    return 0.28 - 0.06 * np.abs((2.0 * time / period) % 2.0 - 1.0)


@pytest.mark.parametrize("noise", [0.0, 2e-5])
@pytest.mark.parametrize("period", [8.1, 11.3])
def test_rows_on_both_sides_of_a_corner_between_them(noise: float, period: float) -> None:
    time = STEP * np.arange(120)
    length = triangle(time, period) + np.random.default_rng(1).normal(0.0, noise, len(time))
    found = flagged(time, length)
    # The velocity by three rows is wrong where a corner lies within one step of the row.
    corners = np.arange(1, int(2.0 * time[-1] / period) + 2) * period / 2.0
    nearest = np.min(np.abs(time[:, None] - corners), axis=1)
    wrong = (nearest < 0.8 * STEP) & (time > 2 * STEP) & (time < time[-1] - 2 * STEP)
    assert np.all(found[wrong])
    assert not np.any(found[(nearest > 2.01 * STEP) & (np.arange(120) > 1) & (np.arange(120) < 118)])


@pytest.mark.parametrize("noise", [0.0, 2e-5, 2e-4])
def test_a_motion_that_bends_all_along_has_no_corners(noise: float) -> None:
    time = STEP * np.arange(120)
    random = np.random.default_rng(2)
    length = 0.25 + 0.03 * np.cos(2.0 * np.pi * time / 8.1) + random.normal(0.0, noise, len(time))
    assert np.mean(flagged(time, length)) < 0.04
