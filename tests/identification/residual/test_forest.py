"""Regression trees without a formula: what they follow, what they leave, and that they repeat."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.identification.residual.forest import Forest

RANDOM = np.random.default_rng(4)
TABLE = RANDOM.uniform(-1.0, 1.0, (600, 3))
STEP = np.where(TABLE[:, 1] > 0.2, 3.0, -1.0)


def _forest(target: np.ndarray, trees: int = 40) -> Forest:
    return Forest(TABLE, target, trees=trees, random=np.random.default_rng(0))


def test_a_step_is_followed_and_the_other_variables_do_not_matter():
    forest = _forest(STEP)
    far = np.array([[0.9, 0.8, -0.3], [-0.7, 0.8, 0.6], [0.2, -0.7, 0.1]])
    assert forest.predict(far) == pytest.approx([3.0, 3.0, -1.0], abs=0.05)


def test_values_stay_between_those_of_the_table():
    forest = _forest(STEP + 0.3 * RANDOM.normal(size=len(STEP)))
    beyond = forest.predict(np.array([[50.0, 50.0, 50.0], [-50.0, -50.0, -50.0]]))
    assert np.all(np.abs(beyond - 1.0) < 2.6)
    assert beyond[0] > beyond[1] + 2.0


def test_leaves_average_the_noise():
    noise = RANDOM.normal(size=len(TABLE))
    left = noise - _forest(noise).predict(TABLE)
    assert 0.2 < np.std(left) / np.std(noise) < 0.95  # single rows are no leaves: the noise is not copied


def test_a_constant_table_gives_the_mean_and_a_forest_repeats():
    flat = Forest(np.ones((50, 2)), np.arange(50.0), trees=5, random=np.random.default_rng(1))
    assert flat.predict(np.ones((2, 2))) == pytest.approx([24.5, 24.5])
    assert np.array_equal(_forest(STEP).predict(TABLE), _forest(STEP).predict(TABLE))
