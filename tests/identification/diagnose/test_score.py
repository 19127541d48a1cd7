"""The price of numbers: independent rows of correlated noise, folds that count alike, what is earned."""

from __future__ import annotations

from dataclasses import replace
from math import log

import numpy as np
import pytest

from mckibben.identification.diagnose.score import better, effective_rows, score
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.thresholds import SCORE
from tests.identification.synthetic import linear_node

ROWS = 40_000


def autoregressive(rho: float, rows: int = ROWS, seed: int = 0) -> np.ndarray:
    """AR(1) noise with unit variance."""
    random = np.random.default_rng(seed)
    found = np.empty(rows)
    found[0] = random.normal()
    steps = random.normal(0.0, np.sqrt(1.0 - rho**2), rows)
    for row in range(1, rows):
        found[row] = rho * found[row - 1] + steps[row]
    return found


@pytest.mark.parametrize("rho", [0.3, 0.6, 0.9])
def test_correlated_noise_has_fewer_rows(rho):
    """The integrated autocorrelation time of AR(1) noise is (1 + rho)/(1 - rho)."""
    folds = [np.arange(ROWS) * 6 // ROWS]
    found = effective_rows(autoregressive(rho), [np.arange(ROWS)], folds)
    # The sum ends where the correlation falls below 0.05: that much of the tail is missing.
    missing = 2.0 * 0.05 * rho / (1.0 - rho)
    expected = ROWS * (1.0 - rho) / (1.0 + rho)
    assert 0.93 * expected < found < 1.1 * ROWS / ((1.0 + rho) / (1.0 - rho) - missing)


def test_white_noise_keeps_its_rows():
    noise = np.random.default_rng(1).normal(size=ROWS)
    assert effective_rows(noise, [np.arange(ROWS)], [np.arange(ROWS) * 6 // ROWS]) == pytest.approx(
        ROWS, rel=0.02
    )


def test_correlation_does_not_reach_across_sweeps():
    """Offsets of sweeps of two rows: within each the correlation is that of the offset."""
    offsets = np.repeat(np.random.default_rng(2).normal(size=ROWS // 2), 2)
    sweeps = [np.array([k, k + 1]) for k in range(0, ROWS, 2)]
    found = effective_rows(offsets, sweeps, [np.arange(ROWS) * 6 // ROWS])
    assert found == pytest.approx(ROWS / 3.0, rel=0.02)  # 1 + 2 * 1


def test_a_constant_and_a_slow_residual():
    folds = [np.repeat(np.arange(6), 50), np.tile(np.arange(4), 75)]
    assert effective_rows(np.full(300, 2.0), [np.arange(300)], folds) == 300.0
    slow = np.sin(np.linspace(0.0, 3.0, 300))
    assert effective_rows(slow, [np.arange(300)], folds) == pytest.approx(20.0)  # two for each of ten folds


def node_of(squares: list[float], *, free: int = 0, rows: int = 30) -> FittedModel:
    """A node with given mean squares of its folds and so many numbers that do not change them."""
    residual = np.concatenate([np.full(rows, np.sqrt(square)) for square in squares])
    labels = np.repeat(np.arange(len(squares)), rows)
    # Whole waves in each fold: at right angles to what is constant there.
    phase = 2.0 * np.pi * np.arange(rows) / rows
    waves = [wave(count * phase) for count in range(1, rows // 2) for wave in (np.cos, np.sin)][:free]
    design = np.tile(np.reshape(waves, (free, rows)).T, (len(squares), 1))
    return linear_node(residual, design, [labels])


def test_score_is_the_mean_log_of_the_folds_and_the_price_of_the_numbers():
    fitted_model = node_of([4.0, 1.0, 0.25], free=2)
    assert score(fitted_model, rows=50.0, noise=None) == pytest.approx(50.0 * 0.0 + 2 * log(50.0))
    fitted_model = node_of([4.0, 4.0, 4.0])
    assert score(fitted_model, rows=50.0, noise=None) == pytest.approx(50.0 * log(4.0))


def test_folds_count_alike_whatever_their_size():
    """Halving the error of a quiet fold is worth as much as halving that of a loud one."""
    before = score(node_of([100.0, 1.0]), rows=50.0, noise=None)
    loud = score(node_of([25.0, 1.0]), rows=50.0, noise=None)
    quiet = score(node_of([100.0, 0.25]), rows=50.0, noise=None)
    assert loud == pytest.approx(quiet)
    assert before - loud == pytest.approx(50.0 * log(4.0) / 2)


def test_errors_far_below_the_noise_are_luck():
    least = score(node_of([1e-9, 1e-9]), rows=50.0, noise=2.0)
    assert least == pytest.approx(50.0 * log(1.0))  # half of the noise, squared
    assert least == score(node_of([1e-3, 1e-6]), rows=50.0, noise=2.0)


def test_a_model_must_earn_its_numbers():
    before = node_of([1.0, 1.0, 1.0])
    rows = 90.0
    assert better(node_of([0.5, 0.5, 0.5], free=1), before, rows=rows, noise=None)
    # 20 ln 90 is more than 90 ln 2: twenty numbers for half of the square are too many.
    assert not better(node_of([0.5, 0.5, 0.5], free=20), before, rows=rows, noise=None)
    # A gain below the least one, however sure.
    tiny = (1.0 - 0.5 * SCORE.least_gain) ** 2
    assert not better(node_of([tiny] * 3), before, rows=1e6, noise=None)
    # A gain that few rows cannot prove.
    small = float(np.exp(-0.9 * SCORE.least_score / 9.0))
    assert not better(node_of([small] * 3), before, rows=9.0, noise=None)
    assert better(node_of([small] * 3), before, rows=12.0, noise=None)


def test_an_implausible_number_is_never_better():
    before = node_of([1.0, 1.0])
    after = node_of([0.01, 0.01], free=1)
    assert better(after, before, rows=60.0, noise=None)
    stuck = replace(after, free=(replace(after.free[0], lower=after.free[0].start),))
    assert stuck.implausible == 1
    assert not better(stuck, before, rows=60.0, noise=None)
