"""Short formulas for a residual: those that were put in are found, others get none."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.identification.residual.term import proposed_term
from mckibben.identification.thresholds import TERM
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
FOLDS = (np.repeat(np.arange(6), ROWS // 6), np.minimum((CONTRACTION / 0.2 * 6).astype(int), 5))


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


def test_friction_that_grows_with_pressure_is_recovered():
    hidden = 4e-5 * DIRECTION * PRESSURE
    residual = hidden + 0.3 * NOISE
    term = proposed_term(residual, VARIABLES, folds=FOLDS)
    assert term is not None
    assert term.formula == "c1*P*sign(v)"
    assert term.coefficients["c1"] == pytest.approx(4e-5, rel=0.01)
    assert term.share == pytest.approx(1.0 - 0.09 / np.mean(residual**2), abs=0.01)
    # On folds left out the noise stays, of all that was there.
    assert term.left_out == pytest.approx(0.3 / np.sqrt(np.mean(residual**2)), rel=0.05)


HIDDEN = {
    "offset": 7.0 * np.ones(ROWS),
    "product": 2e-4 * PRESSURE * CONTRACTION,
    "cubic": 9e2 * CONTRACTION**3,
    "squared pressure": 4e-10 * PRESSURE**2 * CONTRACTION * DIRECTION,
    "settling": 8.0 * (1.0 - np.exp(-TIME / 6.0)),
    "two": 60.0 * CONTRACTION**2 * DIRECTION - 2e-5 * PRESSURE,
}


@pytest.mark.parametrize("hidden", HIDDEN.values(), ids=HIDDEN.keys())
def test_a_proposed_term_can_be_typed_and_means_what_it_says(hidden):
    term = proposed_term(hidden + 0.1 * NOISE, VARIABLES, folds=FOLDS)
    assert term is not None
    assert effect_force(term.formula, term.coefficients) == pytest.approx(term.values, rel=1e-9, abs=1e-9)
    assert np.sqrt(np.mean((term.values - hidden) ** 2)) < 0.15 * np.sqrt(np.mean(hidden**2))
    assert len(term.coefficients) <= (2 if hidden is HIDDEN["two"] else 1)


def test_a_term_is_finite_at_rest_without_pressure_and_after_a_long_time():
    hidden = HIDDEN["settling"] + 2e-4 * PRESSURE * CONTRACTION
    term = proposed_term(hidden + 0.1 * NOISE, VARIABLES, folds=FOLDS)
    assert term is not None
    assert "t/" in term.formula
    places = {"P": 0.0, "kappa": 0.0, "v": 0.0, "sign": np.sign, "abs": abs, "exp": np.exp}
    last, later = (eval(term.formula, {**places, **term.coefficients, "t": t}) for t in (1e4, 1e9))
    assert np.isfinite(last)
    assert later == pytest.approx(last, rel=1e-9)


@pytest.mark.parametrize("periods", [3.0, 5.0, 10.0])
def test_a_ripple_gets_no_formula(periods):
    hidden = 6.0 * np.sin(2.0 * np.pi * periods * CONTRACTION / 0.2 + 0.7)
    assert proposed_term(hidden + 0.3 * NOISE, VARIABLES, folds=FOLDS) is None


def test_a_bump_at_one_place_gets_no_formula():
    hidden = 25.0 * np.exp(-(((CONTRACTION - 0.09) / 0.02) ** 2))
    assert proposed_term(hidden + 0.3 * NOISE, VARIABLES, folds=FOLDS) is None


def test_what_recurs_in_no_group_left_out_gets_no_formula():
    """A force of its own at each pressure, as after mounting the muscle anew: no other pressure tells it."""
    hidden = np.repeat([4.0, -5.0, 6.0, -4.0, 5.0, -6.0], ROWS // 6)
    assert proposed_term(hidden + 0.3 * NOISE, VARIABLES, folds=FOLDS) is None


def test_less_than_half_gets_no_formula():
    """A force as large as the noise lowers the error to 1 / sqrt(2) at best."""
    hidden = np.sqrt(2.0) * np.where(DIRECTION > 0, 1.0, -1.0)
    assert proposed_term(hidden / np.sqrt(2.0) + NOISE, VARIABLES, folds=FOLDS) is None
    twice = proposed_term(4.0 * hidden + NOISE, VARIABLES, folds=FOLDS)
    assert twice is not None
    assert twice.left_out < TERM.halved


def test_noise_and_nothing_have_no_term():
    assert proposed_term(NOISE, VARIABLES, folds=FOLDS) is None
    assert proposed_term(np.zeros(ROWS), VARIABLES, folds=FOLDS) is None


def test_without_a_variable_that_a_term_may_have_there_is_none():
    assert proposed_term(NOISE, {"load": PRESSURE}, folds=FOLDS) is None


def test_without_a_fold_to_leave_out_there_is_none():
    hidden = 4e-5 * DIRECTION * PRESSURE
    assert proposed_term(hidden, VARIABLES, folds=(np.zeros(ROWS, int),)) is None


def test_what_the_model_can_take_up_is_not_proposed():
    basis = np.column_stack([CONTRACTION, np.ones(ROWS), np.zeros(ROWS)])
    hidden = 4e-5 * DIRECTION * PRESSURE
    own = 100.0 * CONTRACTION - 3.0
    term = proposed_term(own + hidden + 0.2 * NOISE, VARIABLES, folds=FOLDS, basis=basis)
    assert term is not None
    assert term.formula == "c1*P*sign(v)"
    assert term.coefficients["c1"] == pytest.approx(4e-5, rel=0.01)
    assert proposed_term(own + NOISE, VARIABLES, folds=FOLDS, basis=basis) is None


def test_the_folds_left_out_are_predicted_as_by_fits_to_the_others():
    """The error told for a term, against one fit per fold."""
    hidden = HIDDEN["two"]
    residual = hidden + 2.0 * NOISE
    basis = np.column_stack([CONTRACTION, np.ones(ROWS)])
    term = proposed_term(residual, VARIABLES, folds=FOLDS, basis=basis)
    assert term is not None
    columns = np.column_stack([effect_force(term.formula, {
        other: float(other == name) for other in term.coefficients
    }) for name in term.coefficients])  # fmt: skip
    columns /= np.linalg.norm(columns, axis=0)
    ratios = []
    for labels in FOLDS:
        errors = []
        for design in (basis, np.column_stack([basis, columns])):
            left = np.zeros(ROWS)
            for label in np.unique(labels):
                out = labels == label
                numbers = np.linalg.lstsq(design[~out], residual[~out], rcond=None)[0]
                left[out] = residual[out] - design[out] @ numbers
            errors.append(np.sqrt(np.mean(left**2)))
        ratios.append(errors[1] / errors[0])
    assert term.left_out == pytest.approx(max(ratios), rel=1e-6)


def test_at_most_three_terms():
    hidden = (
        60.0 * CONTRACTION**2 * DIRECTION - 2e-5 * PRESSURE + 3.0 * DIRECTION + 9e2 * CONTRACTION**3
        + 5e-10 * CONTRACTION * PRESSURE**2
    )  # fmt: skip
    term = proposed_term(hidden + 0.1 * NOISE, VARIABLES, folds=FOLDS)
    assert term is not None
    assert len(term.coefficients) == TERM.terms


def test_a_muscle_that_moves_at_few_rows_only_gives_no_warning():
    pressure = np.linspace(1e5, 6e5, ROWS)
    velocity = np.where(pressure < 1.1e5, 0.02, 0.0)
    folds = (np.repeat(np.arange(6), ROWS // 6),)
    with np.errstate(all="raise", under="ignore"):
        term = proposed_term(
            2e-5 * pressure + 0.3 * NOISE,
            {"pressure": pressure, "velocity": velocity},
            folds=folds,
            basis=np.zeros((ROWS, 1)),
        )
    assert term is not None
    assert term.formula == "c1*P"


def test_a_rest_without_a_short_formula_is_described_by_a_smooth_one() -> None:
    """A bump over the contraction that grows with the pressure: no three products halve it."""
    kappa = VARIABLES["contraction"]
    middle, width = float(np.mean(kappa)), 0.22 * float(np.ptp(kappa))
    hidden = 30.0 * np.exp(-(((kappa - middle) / width) ** 2)) * PRESSURE / float(np.max(PRESSURE))
    residual = hidden + 0.5 * NOISE
    assert proposed_term(residual, VARIABLES, folds=FOLDS) is None
    term = proposed_term(residual, VARIABLES, folds=FOLDS, smooth=True)
    assert term is not None
    assert term.smooth
    assert term.left_out <= TERM.smooth
    assert term.share > 0.95
    # Typed as a custom term it means what it says, and says nothing far outside the measured range.
    effect = custom_effect(term.formula, term.coefficients)
    assert len(term.formula) <= 500
    assert effect.id == "custom"
    far = sum(
        value * np.exp(-(((0.6 - float(text.split("kappa - ")[1].split(")")[0])) / 0.03) ** 2)) * 6e5
        for value, text in zip(term.coefficients.values(), term.formula.split(" + "), strict=True)
    )
    assert abs(far) < 1e-6 * 30.0
    left = float(np.sqrt(np.mean((residual - term.values) ** 2)))
    # What it leaves in groups that its fit has not seen is more than what it leaves within.
    assert left < term.band < float(np.sqrt(np.mean(residual**2)))
    assert proposed_term(NOISE, VARIABLES, folds=FOLDS, smooth=True) is None
