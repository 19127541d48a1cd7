"""Covariance of a fit under correlated noise: against dense algebra, and the coverage of intervals."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import toeplitz

from mckibben.identification.residual import correlated
from mckibben.identification.residual.correlated import Noise, covariance

LINES = [np.arange(first, first + 60) for first in range(0, 300, 60)]
WAYS = [[LINES, [np.arange(300)]]]
TRUE = np.array([14.0, 800.0, 20.0, 10.0])


def design() -> np.ndarray:
    """Loops at five pressures: a factor of the pressure, a spring, dry friction, an offset."""
    pressure = np.repeat(np.arange(2.0, 7.0), 60)
    there = np.linspace(0.0, 0.18, 30)
    contraction = np.tile(np.concatenate([there, there[::-1]]), 5)
    direction = np.tile(np.repeat([1.0, -1.0], 30), 5)
    return np.column_stack(
        [pressure * 30.0 * (1.0 - contraction) ** 2, -contraction, -direction, -np.ones(300)]
    )


def autoregressive(rho: float, random: np.random.Generator, rows: int) -> np.ndarray:
    """Of unit variance."""
    noise = random.standard_normal(rows)
    for row in range(1, rows):
        noise[row] = rho * noise[row - 1] + np.sqrt(1.0 - rho**2) * noise[row]
    return noise


def noise_of(kind: str, random: np.random.Generator) -> np.ndarray:
    white = random.standard_normal(300)
    match kind:
        case "white":
            return white
        case "mixed":
            return np.sqrt(0.5) * (white + autoregressive(0.98, random, 300))
        case "by lines":
            return np.concatenate([autoregressive(0.95, random, 60) for _ in LINES])
        case "growing":
            return white * np.linspace(0.3, 1.7, 300)
        case "in steps":
            return np.round(white / 2.0) * 2.0
    return autoregressive(float(kind), random, 300)


@pytest.mark.parametrize("kind", ["white", "0.98", "mixed", "by lines", "growing"])
def test_intervals_hold_what_they_promise(kind: str) -> None:
    """95 % of 160 intervals; independence would hold 44 to 68 % of those under correlated noise."""
    random = np.random.default_rng(7)
    columns, inside, alone = design(), [], []
    for _ in range(40):
        measured = columns @ TRUE + 2.5 * noise_of(kind, random)
        estimate, *_ = np.linalg.lstsq(columns, measured, rcond=None)
        residual = measured - columns @ estimate
        for found, into in (
            (covariance(columns, residual, WAYS), inside),
            (covariance(columns, residual), alone),
        ):
            into.append(np.abs(estimate - TRUE) <= 1.96 * np.sqrt(np.diag(found)))
    assert np.mean(inside) >= 0.85
    if kind in ("0.9", "0.98", "mixed"):
        assert np.mean(alone) < 0.75
    else:
        assert np.mean(alone) > 0.75 or kind == "by lines"


@pytest.mark.parametrize(("rho", "share"), [(0.9, 1e-5), (0.8, 0.3)])
def test_the_banded_algebra_is_that_of_full_matrices(
    rho: float, share: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One hypothesis alone: the sandwich and the variance by generalised least squares, R written out."""
    monkeypatch.setattr(correlated, "correlated_noises", lambda: (Noise(rho, 0.0, share),))
    monkeypatch.setattr(correlated, "_WHITE_PRIOR", 1e-300)
    columns = design()
    residual = autoregressive(0.9, np.random.default_rng(1), 300)
    residual -= columns @ np.linalg.lstsq(columns, residual, rcond=None)[0]
    block = (1.0 - share) * toeplitz(rho ** np.arange(60)) + share * np.eye(60)
    full = np.kron(np.eye(5), block)
    inverse = np.linalg.inv(full)
    whitened = (
        inverse - inverse @ columns @ np.linalg.inv(columns.T @ inverse @ columns) @ columns.T @ inverse
    )
    variance = float(residual @ whitened @ residual) / (300 - 4)
    bread = np.linalg.inv(columns.T @ columns)
    expected = variance * bread @ columns.T @ full @ columns @ bread
    np.testing.assert_allclose(covariance(columns, residual, [[LINES]]), expected, rtol=1e-6, atol=1e-12)


def test_two_channels_add_and_one_without_a_parameter_says_nothing_of_it() -> None:
    """Two channels, each with its own constant and its own noise: two separate fits."""
    random = np.random.default_rng(4)
    first, second = random.standard_normal((2, 300))
    column = np.linspace(1.0, 2.0, 300)
    columns = np.zeros((600, 2))
    columns[:300, 0] = columns[300:, 1] = column
    residual = np.concatenate([first, 10.0 * second])
    rows = np.arange(300)
    together = covariance(columns, residual, [[[rows]], [[rows + 300]]])
    for place, part in enumerate((first, 10.0 * second)):
        assert together[place, place] == pytest.approx(
            covariance(column[:, None], part, [[[rows]]])[0, 0], rel=1e-9
        )
    assert together[0, 1] == pytest.approx(0.0, abs=1e-12)


def test_a_few_rows_and_an_exact_fit_are_no_failure() -> None:
    columns = np.column_stack([np.ones(4), np.arange(4.0)])
    assert np.all(np.isfinite(covariance(columns, np.array([0.1, -0.1, -0.1, 0.1]), [[[np.arange(4)]]])))
    exact = covariance(columns, np.zeros(4), [[[np.arange(4)]]])
    assert np.max(np.abs(exact)) < 1e-200
