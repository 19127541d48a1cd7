"""Correlation of a residual with the input, on residuals whose correlation is known."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import lfilter

from mckibben.identification.residual.cross import cross_correlation

ROWS = 2000
SWEEPS = np.split(np.arange(ROWS), 4)


def autoregressive(random: np.random.Generator, rho: float) -> np.ndarray:
    """A first-order process of unit variance."""
    return lfilter([np.sqrt(1.0 - rho**2)], [1.0, -rho], random.normal(size=ROWS))


def test_a_residual_that_follows_the_input_later_peaks_at_that_lag() -> None:
    random = np.random.default_rng(4)
    pressure = 3e5 + 1e5 * random.normal(size=ROWS)
    late = np.concatenate([np.zeros(5), pressure[:-5] - 3e5]) / 1e5 + random.normal(size=ROWS)
    found = cross_correlation("force", late, {"pressure": pressure}, SWEEPS)
    assert found is not None
    assert found.input == "pressure"
    assert found.lags[np.argmax(found.correlation)] == 5
    assert found.correlation.max() == pytest.approx(np.sqrt(0.5), abs=0.05)  # half of the variance is noise
    assert np.sum(np.abs(found.correlation) > 2.0 * found.band) == 1
    # Turned round, the input follows the residual: feedback.
    back = cross_correlation("force", pressure, {"load": late}, SWEEPS)
    assert back is not None
    assert back.lags[np.argmax(back.correlation)] == -5


@pytest.mark.parametrize("rho", [0.0, 0.9])
def test_the_band_holds_an_independent_residual_also_where_both_are_correlated(rho: float) -> None:
    random = np.random.default_rng(5)
    outside, naive = [], []
    for _ in range(30):
        residual, load = autoregressive(random, rho), 5.0 + autoregressive(random, rho)
        found = cross_correlation("force", residual, {"load": load}, SWEEPS)
        assert found is not None
        outside.append(found.outside)
        naive.append(np.mean(np.abs(found.correlation) > 1.96 / np.sqrt(ROWS)))
    assert np.mean(outside) == pytest.approx(0.05, abs=0.03)
    if rho == 0.9:
        assert np.mean(naive) > 0.3  # the band of white noise would cry wolf


def test_an_input_that_is_held_and_short_sweeps_have_none() -> None:
    random = np.random.default_rng(6)
    residual, held = random.normal(size=ROWS), 3e5 + 1e3 * random.normal(size=ROWS)
    assert cross_correlation("force", residual, {"pressure": held}, SWEEPS) is None
    moving = {"pressure": held, "contraction": np.linspace(0.0, 0.2, ROWS)}
    found = cross_correlation("force", residual, moving, SWEEPS)
    assert found is not None
    assert found.input == "contraction"
    # What is not known in every row, and the predicted quantity itself, are no input.
    gaps = moving | {"load": np.where(np.arange(ROWS) == 7, np.nan, moving["contraction"])}
    found = cross_correlation("pressure", residual, gaps | {"pressure": residual}, SWEEPS)
    assert found is not None
    assert found.input == "contraction"
    short = np.split(np.arange(ROWS), 40)
    assert cross_correlation("force", residual, moving, short) is None
