"""Distributions and statistics against closed forms."""

from __future__ import annotations

from math import exp, log, sqrt

import numpy as np
import pytest
from scipy import stats

from mckibben.studies.optimise import FigureLimit
from mckibben.studies.plan import latin_hypercube, monte_carlo
from mckibben.studies.statistics import Estimate, correlations, probabilities, probability, summaries
from mckibben.studies.variable import Variable, log_uniform, lognormal, normal, triangular, uniform
from tests.studies.subjects import table_of

SHARES = np.linspace(0.0005, 0.9995, 1000)


@pytest.mark.parametrize(
    ("quantile", "law"),
    [
        (normal(mean=3.0, deviation=0.5), stats.norm(3.0, 0.5)),
        (normal(mean=3.0, deviation=0.5, least=2.8, most=4.0), stats.truncnorm(-0.4, 2.0, 3.0, 0.5)),
        (normal(mean=0.0, deviation=1.0, least=5.0, most=9.0), stats.truncnorm(5.0, 9.0)),
        (lognormal(median=2.0, log_deviation=0.3), stats.lognorm(0.3, scale=2.0)),
        (uniform(least=-1.0, most=4.0), stats.uniform(-1.0, 5.0)),
        (log_uniform(least=0.1, most=10.0), stats.loguniform(0.1, 10.0)),
        (triangular(least=1.0, mode=2.0, most=5.0), stats.triang(0.25, 1.0, 4.0)),
        (triangular(least=1.0, mode=1.0, most=5.0), stats.triang(0.0, 1.0, 4.0)),
    ],
)
def test_quantiles_are_those_of_scipy(quantile, law):
    assert quantile(SHARES) == pytest.approx(law.ppf(SHARES), rel=1e-9, abs=1e-12)


def test_a_truncated_lognormal_stays_inside_with_the_right_median():
    quantile = lognormal(median=2.0, log_deviation=0.3, least=1.5, most=2.5)
    assert quantile(np.array([0.0, 1.0])) == pytest.approx([1.5, 2.5])
    low, high = stats.norm.cdf(np.log(np.array([1.5, 2.5]) / 2.0) / 0.3)
    assert quantile(np.array([0.5]))[0] == pytest.approx(
        stats.lognorm.ppf(0.5 * (low + high), 0.3, scale=2.0)
    )


def tolerances(*deviations: float) -> list[Variable]:
    return [
        Variable(f"x{i}", f"x{i}", "1", quantile=normal(mean=10.0, deviation=s), tolerance=True)
        for i, s in enumerate(deviations)
    ]


def ends(estimate: Estimate | None) -> tuple[float, float]:
    """The ends of an interval; NaN where there is none, which no comparison holds for."""
    if estimate is None or estimate.low is None or estimate.high is None:
        return float("nan"), float("nan")
    return estimate.low, estimate.high


def test_a_normal_monte_carlo_agrees_with_closed_forms():
    """The sum of two independent normal values is normal: mean 20, deviation 5."""
    table = table_of(
        monte_carlo(tolerances(3.0, 4.0), 20_000, seed=11), lambda p: p.sum(axis=1, keepdims=True)
    )
    (found,) = summaries(table, 0.999, independent=True)
    assert found.mean
    assert found.deviation
    exact = {"5": 20.0 + 5.0 * stats.norm.ppf(0.05), "50": 20.0, "99": 20.0 + 5.0 * stats.norm.ppf(0.99)}
    for estimate, value in [
        (found.mean, 20.0),
        (found.deviation, 5.0),
        *((found.percentiles[name], value) for name, value in exact.items()),
    ]:
        low, high = ends(estimate)
        assert low < value < high
        assert high - low < 0.8
    limit = FigureLimit("y", at_least=15.0, at_most=30.0)
    low, high = ends(probabilities(table, [limit], 0.999, True)[-1].probability)
    assert low < stats.norm.cdf(2.0) - stats.norm.cdf(-1.0) < high < low + 0.03


def test_intervals_of_percentiles_cover_as_often_as_they_say():
    """Of 400 samples of 60 values; the distribution-free interval covers at least 90 %."""
    covered = {"25": 0, "50": 0, "mean": 0}
    for seed in range(400):
        table = table_of(monte_carlo(tolerances(1.0), 60, seed), lambda p: p)
        (found,) = summaries(table, 0.9, independent=True)
        for name, exact in (("25", 10.0 + stats.norm.ppf(0.25)), ("50", 10.0)):
            low, high = ends(found.percentiles[name])
            covered[name] += low <= exact <= high
        low, high = ends(found.mean)
        covered["mean"] += low <= 10.0 <= high
    # 90 % of 400, less three standard deviations (6); percentiles may cover more.
    assert min(covered.values()) >= 342
    assert covered["mean"] <= 378


def test_a_latin_hypercube_has_one_value_in_each_share_and_no_intervals():
    plan = latin_hypercube(tolerances(1.0, 2.0), 50, seed=4)
    for column, deviation in zip(plan.points.T, (1.0, 2.0), strict=True):
        cells = np.floor(stats.norm.cdf(column, 10.0, deviation) * 50).astype(int)
        assert sorted(cells) == list(range(50))
    (found,) = summaries(table_of(plan, lambda p: p[:, :1]), 0.95, independent=False)
    assert found.mean
    assert found.mean.low is None
    assert found.mean.value == pytest.approx(10.0, abs=0.02)


@pytest.mark.parametrize(
    ("kept", "runs", "low", "high"),
    [(0, 20, 0.0, 1.0 - 0.025 ** (1.0 / 20.0)), (20, 20, 0.025 ** (1.0 / 20.0), 1.0)],
)
def test_clopper_and_pearson_at_the_ends_in_closed_form(kept, runs, low, high):
    found = probability("all", np.arange(runs) < kept, 0.95).probability
    assert (found.low, found.high) == pytest.approx((low, high))


def test_clopper_and_pearson_is_that_of_scipy():
    found = probability("all", np.arange(80) < 61, 0.9).probability
    exact = stats.binomtest(61, 80).proportion_ci(0.9, "exact")
    assert (found.low, found.high) == pytest.approx((exact.low, exact.high))


def test_rank_correlation_of_a_monotonous_function_is_one():
    table = table_of(monte_carlo(tolerances(1.0, 1.0), 300, seed=1), lambda p: np.exp(-p[:, :1]))
    first, second = correlations(table)
    assert first.rank_correlation == pytest.approx(-1.0)
    assert second.rank_correlation == pytest.approx(
        stats.spearmanr(table.points[:, 1], table.values[:, 0]).statistic
    )


def test_the_logarithm_of_a_lognormal_value_has_its_deviation():
    variable = Variable("x", "x", "1", quantile=lognormal(median=exp(2.0), log_deviation=0.25))
    points = monte_carlo([variable], 10_000, seed=2).points[:, 0]
    assert np.log(points).mean() == pytest.approx(2.0, abs=4 * 0.25 / sqrt(1e4))
    assert np.log(points).std() == pytest.approx(0.25, abs=4 * 0.25 / sqrt(2e4))
    assert log(float(np.median(points))) == pytest.approx(2.0, abs=0.02)
