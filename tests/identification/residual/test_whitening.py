"""Innovations of correlated noise against full matrices."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.linalg import block_diag, toeplitz

from mckibben.identification.residual.correlated import WHITE, Chain, Noise

#: A long line, one in which rows are missing, and one that is too short to swing.
LINES = [np.arange(40), np.array([40, -1, 41, 42, -1, -1, 43, 44, 45]), np.arange(46, 49)]
TABLE = np.random.default_rng(2).normal(size=(49, 3))


def correlations(noise: Noise) -> np.ndarray:
    """Of the rows that are there; the course by the difference equation of the noise."""
    parts = []
    for line in LINES:
        course = [1.0, noise.first / (1.0 - noise.second)]
        while len(course) < len(line):
            course.append(noise.first * course[-1] + noise.second * course[-2])
        whole = (1.0 - noise.white) * toeplitz(course[: len(line)]) + noise.white * np.eye(len(line))
        there = line >= 0
        short = noise.second and len(line) < 4
        parts.append(np.eye(len(line)) if short else whole[np.ix_(there, there)])
    return block_diag(*parts)


NOISES = [WHITE, Noise(0.9, 0.0, 0.3), Noise(0.999, 0.0, 1e-5), Noise.swinging(0.97, 10.0, 0.4)]


def test_products_and_determinants_are_those_of_whole_matrices() -> None:
    for noise, (products, log_det) in zip(NOISES, Chain(LINES).products(TABLE, NOISES), strict=True):
        full = correlations(noise)
        np.testing.assert_allclose(products, TABLE.T @ np.linalg.solve(full, TABLE), rtol=1e-9, atol=1e-9)
        assert log_det == pytest.approx(np.linalg.slogdet(full)[1], abs=1e-9)


def test_the_misfit_is_minus_twice_the_log_likelihood_beside_the_other_columns() -> None:
    misfit = Chain(LINES).misfit(TABLE, 1e-300)
    for noise in NOISES:
        root = np.linalg.cholesky(correlations(noise))
        columns, last = np.hsplit(np.linalg.solve(root, TABLE), [2])
        square = float(np.linalg.lstsq(columns, last[:, 0])[1][0])
        expected = 49.0 * np.log(square / 49.0) + 2.0 * np.sum(np.log(np.diag(root)))
        assert misfit(noise) == pytest.approx(expected, rel=1e-9)


def test_columns_of_no_rank_have_no_likelihood() -> None:
    table = np.column_stack([np.zeros(49), TABLE[:, 0]])
    assert Chain(LINES).misfit(table, 1e-300)(WHITE) == np.inf
