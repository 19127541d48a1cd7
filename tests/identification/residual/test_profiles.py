"""Where a residual is: shares, ranges, maps, whiteness and loops of made-up residuals."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.facts.comparison import CHANNELS
from mckibben.identification.predict import predictor_of
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.residual.profiles import (
    loops,
    mean_loop,
    profiles,
    variables_of,
    whiteness,
)
from tests.identification.diagnose.test_score import autoregressive
from tests.identification.synthetic import MUSCLE, Plain, cycles, force_map

ROWS = 6000
RANDOM = np.random.default_rng(5)
PRESSURE = RANDOM.uniform(1e5, 6e5, ROWS)
CONTRACTION = RANDOM.uniform(0.0, 0.2, ROWS)
DIRECTION = RANDOM.choice([-1.0, 1.0], ROWS)
VARIABLES = {"pressure": PRESSURE, "contraction": CONTRACTION, "direction": DIRECTION}
NOISE = RANDOM.normal(0.0, 1.0, ROWS)
FOLDS = np.arange(ROWS) % 6


def test_the_variable_that_makes_the_residual_explains_it():
    found = profiles(CONTRACTION - 0.1, VARIABLES, FOLDS)
    assert found[0].over == "contraction"
    # Ten bins of a uniform variable leave a hundredth of its variance.
    assert found[0].share_explained == pytest.approx(0.99, abs=2e-3)
    assert found[1].share_explained < 0.01
    assert found[2].share_explained < 0.01


def test_noise_is_explained_by_nothing():
    for profile in profiles(NOISE, VARIABLES, FOLDS):
        assert profile.share_explained < 0.01, profile.over


def test_bins_seen_once_explain_nothing():
    """Each fold has levels of its own: what the others say of them is nothing."""
    groups = np.repeat(np.arange(6.0), ROWS // 6)
    residual = np.repeat([3.0, -1.0, 2.0, -4.0, 1.0, -1.0], ROWS // 6)
    found = profiles(residual, {"group": groups}, groups)
    assert found[0].share_explained == 0.0
    mixed = profiles(residual, {"group": groups}, FOLDS)
    assert mixed[0].share_explained > 0.9


def test_bins_hold_equal_counts_means_and_squares():
    residual = NOISE + 2.0
    profile = next(p for p in profiles(residual, VARIABLES, FOLDS) if p.over == "pressure")
    assert len(profile.edges) == 11
    assert profile.count.tolist() == [600] * 10
    for number in range(10):
        low, high = profile.edges[number : number + 2]
        inside = (low <= PRESSURE) & ((high > PRESSURE) | (number == 9))
        assert profile.mean[number] == pytest.approx(np.mean(residual[inside]))
        assert profile.rms[number] == pytest.approx(np.sqrt(np.mean(residual[inside] ** 2)))
    assert np.sum(profile.count * profile.rms**2) == pytest.approx(np.sum(residual**2))


def test_the_worst_range_is_told_in_words():
    residual = np.where(PRESSURE > 5.5e5, 9.0, 0.1)
    profile = next(p for p in profiles(residual, VARIABLES, FOLDS) if p.over == "pressure")
    low, high = (
        float(word) for word in profile.worst.removeprefix("pressure ").split(" bar")[0].split(" to ")
    )
    assert low == pytest.approx(5.5, abs=0.05)
    assert high == pytest.approx(6.0, abs=0.05)
    assert profile.rmse == pytest.approx(9.0, rel=1e-2)
    only = profiles(np.where(DIRECTION > 0, 9.0, 0.1), {"direction": DIRECTION}, FOLDS)[0]
    assert only.worst == "lengthening"
    assert only.rmse == pytest.approx(9.0)
    held = profiles(
        np.where(PRESSURE > 3e5, 1.0, 2.0), {"pressure": np.where(PRESSURE > 3e5, 4e5, 2e5)}, FOLDS
    )
    assert held[0].worst == "pressure 2 bar"


def test_a_residual_of_zeros_has_profiles_too():
    for profile in profiles(np.zeros(ROWS), VARIABLES, FOLDS):
        assert profile.share_explained == 0.0
        assert profile.rmse == 0.0


def test_white_noise_is_white_nearly_always():
    random = np.random.default_rng(6)
    rows = 400
    verdicts = [whiteness(random.normal(size=rows), [np.arange(rows)]) for _ in range(200)]
    assert np.mean([v.white for v in verdicts]) > 0.93
    # The band holds 95 % of the lags.
    assert np.mean([v.outside for v in verdicts]) == pytest.approx(0.05, abs=0.01)
    assert np.mean([v.sign_changes for v in verdicts]) == pytest.approx(1.0, abs=0.01)
    assert verdicts[0].band == pytest.approx(1.96 / np.sqrt(rows), rel=1e-3)


@pytest.mark.parametrize("rho", [0.3, 0.6, 0.95])
def test_correlated_noise_is_not_white(rho):
    found = whiteness(autoregressive(rho, 4000), [np.arange(4000)])
    assert not found.white
    lags = np.arange(1, 6)
    assert found.autocorrelation[:5] == pytest.approx(rho**lags, abs=0.12)
    # A Gaussian AR(1) changes its sign with probability arccos(rho)/pi per row.
    assert found.sign_changes == pytest.approx(2.0 * np.arccos(rho) / np.pi, abs=0.06)


def test_slow_structure_under_noise_is_not_white():
    residual = NOISE + 0.7 * np.sin(np.linspace(0.0, 30.0, ROWS))
    assert not whiteness(residual, [np.arange(ROWS)]).white
    alternating = np.tile([1.0, -1.0], 200)
    found = whiteness(alternating, [np.arange(400)])
    assert not found.white
    assert found.sign_changes == pytest.approx(2.0)


def test_whiteness_within_sweeps_only():
    """The rows of two sweeps are not neighbours, and an order within a sweep is what counts."""
    sweeps = np.split(np.arange(4000), 40)
    assert whiteness(NOISE[:4000], sweeps).white
    shuffled = np.random.default_rng(1).permutation(4000)
    correlated = autoregressive(0.9, 4000)
    assert whiteness(correlated[shuffled], sweeps).white


def test_too_few_rows_have_no_correlation():
    found = whiteness(np.array([1.0, -1.0, 2.0]), [np.arange(3)])
    assert len(found.autocorrelation) == 0
    assert found.outside == 0.0
    zeros = whiteness(np.zeros(50), [np.arange(50)])
    assert np.isfinite(zeros.sign_changes)


def loop(amount: float, way: float, rows: int = 400) -> tuple[np.ndarray, np.ndarray]:
    """Coulomb friction along a closed way: force and length."""
    length = 0.3 - way * np.interp(np.linspace(0.0, 2.0, rows), [0, 1, 2], [0.0, 1.0, 0.0])
    return amount * np.sign(np.gradient(length)), length


def test_a_friction_loop_takes_twice_its_force_times_the_way():
    force, length = loop(15.0, 0.04)
    found = loops(force, length, np.zeros(len(force), int), None)
    assert len(found) == 1
    assert found[0].area == pytest.approx(2 * 15.0 * 0.04, rel=1e-2)
    assert found[0].span == pytest.approx(0.04, rel=1e-2)
    assert found[0].friction == pytest.approx(15.0, rel=1e-2)
    assert found[0].area_noise is None
    # The other way round energy would come out of nothing.
    assert loops(-force, length, np.zeros(len(force), int), None)[0].area < 0.0


def test_noise_alone_gives_an_area_too():
    length, random, sigma = loop(1.0, 0.04)[1], np.random.default_rng(8), 5.0
    groups = np.zeros(len(length), int)
    areas = [loops(random.normal(0.0, sigma, len(length)), length, groups, None)[0].area for _ in range(2000)]
    expected = loops(np.zeros(len(length)), length, groups, sigma)[0].area_noise
    assert np.std(areas) == pytest.approx(expected, rel=0.05)  # a standard deviation of 2000: 1.6 %
    # n rows go through the span twice: each weighs 2 span/n.
    assert expected == pytest.approx(2.0 * 0.04 * sigma / np.sqrt(len(length)), rel=0.02)


def test_the_mean_of_loops_is_that_of_the_friction_on_all_of_them():
    (one_force, one), (other_force, other) = loop(15.0, 0.04), loop(15.0, 0.01)
    groups = np.repeat([0, 1], len(one))
    found = loops(np.append(one_force, other_force), np.append(one, other), groups, 2.0)
    mean = mean_loop(found)
    assert mean is not None
    assert mean.area == pytest.approx(15.0 * (0.04 + 0.01), rel=1e-2)
    assert mean.friction == pytest.approx(15.0, rel=1e-2)
    sizes = [each.area_noise or 0.0 for each in found]
    assert mean.area_noise == pytest.approx(0.5 * np.hypot(*sizes))
    assert mean_loop([]) is None


def test_an_elastic_force_makes_no_loop():
    length = loop(1.0, 0.04)[1]
    found = loops(2e3 * (length - 0.3) + 50.0, length, np.zeros(len(length), int), None)
    assert found[0].area == pytest.approx(0.0, abs=1e-9)


def test_only_closed_ways_are_loops():
    force, length = loop(15.0, 0.04)
    half = len(force) // 2
    assert loops(force[:half], length[:half], np.zeros(half, int), None) == []
    assert loops(force[:6], length[:6], np.zeros(6, int), None) == []
    twice = np.concatenate([np.zeros(len(force), int), np.full(len(force), 4)])
    found = loops(np.tile(force, 2), np.tile(length, 2), twice, None)
    assert [each.group for each in found] == [0, 4]


def test_variables_are_what_changes_and_has_a_name():
    predictor = predictor_of(force_map(), MUSCLE)
    found = variables_of(predictor, FitModel(MUSCLE))
    assert set(found) == {"pressure", "contraction"}
    assert found["contraction"] == pytest.approx(1.0 - predictor.inputs["length"] / 0.3)
    moved = variables_of(predictor_of(cycles(), MUSCLE), FitModel(MUSCLE))
    assert {"pressure", "contraction", "velocity", "direction", "time"} <= set(moved) <= set(CHANNELS)
    odd = Plain(np.zeros(5), np.empty((5, 0)), [np.zeros(5)], {"colour": np.arange(5.0), "time": np.ones(5)})
    assert variables_of(odd, FitModel(MUSCLE)) == {}
    assert set(variables_of(odd, FitModel(MUSCLE), np.array([0, 0, 1, 1, 2]))) == {"group"}
