"""Structure that nobody knows: how much there is, and a term for it that was put in here."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.identification.residual.structure import proposed_term, structure
from mckibben.physics.custom import custom_effect

ROWS = 1200
RANDOM = np.random.default_rng(9)
#: Six pressures, each swept over the contraction and back, as on a rig.
PRESSURE = np.repeat(np.linspace(1e5, 6e5, 6), ROWS // 6)
CONTRACTION = 0.2 * np.tile(np.interp(np.linspace(0, 2, ROWS // 6), [0, 1, 2], [0, 1, 0]), 6)
DIRECTION = np.tile(np.where(np.arange(ROWS // 6) < ROWS // 12, -1.0, 1.0), 6)
TIME = np.linspace(0.0, 60.0, ROWS)
VARIABLES = {"pressure": PRESSURE, "contraction": CONTRACTION, "direction": DIRECTION, "time": TIME}
NOISE = RANDOM.normal(0.0, 1.0, ROWS)


def effect_force(formula: str, coefficients: dict[str, float]) -> np.ndarray:
    """What the formula adds to the tension when it is typed."""
    effect = custom_effect(formula, coefficients)
    known = {
        "pressure": PRESSURE, "length": 0.3 * (1.0 - CONTRACTION), "velocity": 0.02 * DIRECTION,
        "direction": DIRECTION, "elapsed": TIME,
    }  # fmt: skip
    muscle = type("Straight", (), {"contraction": staticmethod(lambda length: 1.0 - length / 0.3)})
    known |= {"muscle": muscle} | coefficients
    return effect.slots["friction"](**{name: known[name] for name in effect.wanted("friction")})


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


def test_a_ripple_over_contraction_is_recovered():
    hidden = 6.0 * np.sin(2.0 * np.pi * 5.0 * CONTRACTION / 0.2 + 0.7)
    term = proposed_term(hidden + 0.3 * NOISE, VARIABLES)
    assert term is not None
    assert term.share > 0.95
    assert np.sqrt(np.mean((term.values - hidden) ** 2)) < 0.2
    assert "kappa)" in term.formula
    amplitude = np.hypot(*list(term.coefficients.values())[:2])
    assert amplitude == pytest.approx(6.0, rel=0.05)


def friction_at(pressure: np.ndarray) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    return 4e-5 * DIRECTION * pressure, {**VARIABLES, "pressure": pressure}


def test_friction_that_grows_with_pressure_is_recovered():
    hidden, variables = friction_at(1e5 + 5e5 * RANDOM.uniform(size=ROWS))
    term = proposed_term(hidden + 0.3 * NOISE, variables)
    assert term is not None
    assert term.formula == "c1*sign(v)*P"
    assert term.coefficients["c1"] == pytest.approx(4e-5, rel=0.01)
    assert term.share == pytest.approx(1.0 - 0.09 / np.mean((hidden + 0.3 * NOISE) ** 2), abs=0.01)


def test_a_few_levels_are_not_taken_for_a_wave():
    """At whole bars sin and cos of 2 pi P/bar are 0 and 1: a wave there says nothing that 1 does not."""
    hidden, variables = friction_at(PRESSURE)
    term = proposed_term(hidden + 0.3 * NOISE, variables)
    assert term is not None
    assert term.formula == "c1*sign(v)*P"


@pytest.mark.parametrize(
    "hidden",
    [
        4e-5 * DIRECTION * PRESSURE,
        6.0 * np.sin(2.0 * np.pi * 5.0 * CONTRACTION / 0.2 + 0.7),
        2e-4 * PRESSURE * CONTRACTION,
        25.0 * np.exp(-(((CONTRACTION - 0.09) / 0.02) ** 2)),
        0.1 * TIME,
        7.0 * np.ones(ROWS),
    ],
    ids=["friction", "ripple", "product", "bump", "drift", "offset"],
)
def test_a_proposed_term_can_be_typed_and_means_what_it_says(hidden):
    term = proposed_term(hidden + 0.2 * NOISE, VARIABLES)
    assert term is not None
    assert effect_force(term.formula, term.coefficients) == pytest.approx(term.values, rel=1e-9, abs=1e-9)
    assert np.sqrt(np.mean((term.values - hidden) ** 2)) < 0.15 * np.sqrt(np.mean(hidden**2))


def test_noise_has_no_term():
    assert proposed_term(NOISE, VARIABLES) is None


def test_without_a_variable_that_a_term_may_have_there_is_none():
    assert proposed_term(NOISE, {"load": PRESSURE}) is None


def test_what_the_model_can_take_up_is_not_proposed():
    basis = np.column_stack([CONTRACTION, np.ones(ROWS)])
    hidden, variables = friction_at(1e5 + 5e5 * RANDOM.uniform(size=ROWS))
    term = proposed_term(100.0 * CONTRACTION - 3.0 + hidden + 0.2 * NOISE, variables, basis)
    assert term is not None
    assert term.formula == "c1*sign(v)*P"
    assert term.coefficients["c1"] == pytest.approx(4e-5, rel=0.01)
    assert proposed_term(100.0 * CONTRACTION - 3.0 + NOISE, variables, basis) is None


def test_at_most_three_terms():
    hidden = sum(3.0 * np.sin(2.0 * np.pi * count * CONTRACTION / 0.2 + count) for count in (2, 3, 5, 7, 11))
    term = proposed_term(hidden + 0.1 * NOISE, VARIABLES)
    assert term is not None
    assert len(term.coefficients) <= 6  # a wave has two
    assert 0.4 < term.share < 0.9


def test_terms_that_vanish_wherever_they_would_act_are_passed_over():
    """A muscle that moves at the lowest pressures only: a bump at 5 bar times the speed is nowhere."""
    pressure = np.linspace(1e5, 6e5, ROWS)
    bump = 60.0 * np.exp(-(((pressure - 3.2e5) / 2e4) ** 2))
    velocity = np.where(pressure < 1.1e5, 0.02, 0.0)
    with np.errstate(all="raise", under="ignore"):
        term = proposed_term(bump + NOISE, {"pressure": pressure, "velocity": velocity}, np.zeros((ROWS, 1)))
    assert term is not None
    assert term.share > 0.8
    assert np.sqrt(np.mean((term.values - bump) ** 2)) < 0.2 * np.sqrt(np.mean(bump**2))
