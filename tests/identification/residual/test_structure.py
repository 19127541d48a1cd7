"""Structure that nobody knows: how much there is, and over which variables; it was put in here."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.identification.residual.structure import Forest, structure

ROWS = 1200
RANDOM = np.random.default_rng(9)
#: Six pressures, each swept over the contraction and back, as on a rig.
PRESSURE = np.repeat(np.linspace(1e5, 6e5, 6), ROWS // 6)
CONTRACTION = 0.2 * np.tile(np.interp(np.linspace(0, 2, ROWS // 6), [0, 1, 2], [0, 1, 0]), 6)
DIRECTION = np.tile(np.where(np.arange(ROWS // 6) < ROWS // 12, -1.0, 1.0), 6)
TIME = np.linspace(0.0, 60.0, ROWS)
VARIABLES = {"pressure": PRESSURE, "contraction": CONTRACTION, "direction": DIRECTION, "time": TIME}
NOISE = RANDOM.normal(0.0, 1.0, ROWS)

SPLITS = np.random.default_rng(4)
TABLE = SPLITS.uniform(-1.0, 1.0, (600, 3))
STEP = np.where(TABLE[:, 1] > 0.2, 3.0, -1.0)


def test_noise_has_no_structure():
    found = structure(NOISE, VARIABLES)
    assert found.share < 0.05
    assert found.variables == ()


def test_a_ripple_is_structure_over_its_variable():
    found = structure(5.0 * np.sin(80.0 * CONTRACTION) + 0.2 * NOISE, VARIABLES)
    assert found.share > 0.8
    assert found.variables[0][0] == "contraction"
    assert found.variables[0][1] > 0.5


def test_two_variables_are_named_in_order():
    residual = 3e-5 * PRESSURE * DIRECTION + 0.5 * NOISE
    found = structure(residual, VARIABLES)
    assert found.share > 0.8
    assert [name for name, _ in found.variables[:2]] == ["direction", "pressure"]


def test_half_noise_is_half_structure():
    found = structure(np.sqrt(2.0) * np.sin(40.0 * CONTRACTION) + NOISE, VARIABLES)
    assert found.share == pytest.approx(0.5, abs=0.1)


def test_little_data_have_none():
    few = {name: values[:30] for name, values in VARIABLES.items()}
    assert structure(NOISE[:30], few).share == 0.0
    assert structure(np.zeros(ROWS), VARIABLES).share == 0.0
    assert structure(NOISE, {}).share == 0.0
    assert structure(DIRECTION, {"group": DIRECTION}).share == 0.0  # the number of a group is no cause


def test_long_records_are_thinned_and_repeatable():
    rows = 30_000
    x = np.linspace(0.0, 0.2, rows)
    residual = np.sin(60.0 * x) + 0.1 * np.random.default_rng(0).normal(size=rows)
    first, second = (structure(residual, {"contraction": x}) for _ in range(2))
    assert first == second
    assert first.share > 0.9


def _forest(target: np.ndarray, trees: int = 40) -> Forest:
    return Forest(TABLE, target, trees=trees, random=np.random.default_rng(0))


def test_a_step_is_followed_and_the_other_variables_do_not_matter():
    forest = _forest(STEP)
    far = np.array([[0.9, 0.8, -0.3], [-0.7, 0.8, 0.6], [0.2, -0.7, 0.1]])
    assert forest.predict(far) == pytest.approx([3.0, 3.0, -1.0], abs=0.05)


def test_values_stay_between_those_of_the_table():
    forest = _forest(STEP + 0.3 * SPLITS.normal(size=len(STEP)))
    beyond = forest.predict(np.array([[50.0, 50.0, 50.0], [-50.0, -50.0, -50.0]]))
    assert np.all(np.abs(beyond - 1.0) < 2.6)
    assert beyond[0] > beyond[1] + 2.0


def test_leaves_average_the_noise():
    noise = SPLITS.normal(size=len(TABLE))
    left = noise - _forest(noise).predict(TABLE)
    assert 0.2 < np.std(left) / np.std(noise) < 0.95  # single rows are no leaves: the noise is not copied


def test_a_constant_table_gives_the_mean_and_a_forest_repeats():
    flat = Forest(np.ones((50, 2)), np.arange(50.0), trees=5, random=np.random.default_rng(1))
    assert flat.predict(np.ones((2, 2))) == pytest.approx([24.5, 24.5])
    assert np.array_equal(_forest(STEP).predict(TABLE), _forest(STEP).predict(TABLE))
