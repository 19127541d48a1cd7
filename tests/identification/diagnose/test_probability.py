"""Weights of models against sums written here, and the calibrated probability of an effect."""

from __future__ import annotations

from dataclasses import replace
from math import exp, log, sqrt
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from mckibben.identification.diagnose.probability import (
    Evidence,
    Loss,
    entries_right,
    known_beside,
    log_preference,
    log_weight,
    loss,
    model_weights,
    none_likely,
)
from mckibben.identification.diagnose.score import score
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.predict.fit_model import FitModel, Free
from mckibben.identification.thresholds import PROBABILITY
from mckibben.physics.effect import Prior
from tests.identification.synthetic import CATALOGUE, MUSCLE

ROWS = 60.0


def fitted(size: float, *effects: str, shares: dict[str, float] | None = None) -> FittedModel:
    """A model whose residual alternates between plus and minus ``size``."""
    priors = {name: (shares or {}).get(name, 0.5) for name in effects}
    chosen = tuple(replace(CATALOGUE[name], prior=Prior(share, "-")) for name, share in priors.items())
    values = {name: CATALOGUE[name].defaults for name in effects}
    residual = size * np.where(np.arange(60) % 2, 1.0, -1.0)
    folds = (np.repeat(np.arange(6), 10),)
    return FittedModel(FitModel(MUSCLE, chosen, values), (), frozenset(), residual, np.empty((60, 0)), folds)


def test_weights_are_prior_odds_times_evidence() -> None:
    root = fitted(3.0)
    first = fitted(1.0, "prestress", shares={"prestress": 0.8})
    second = fitted(1.1, "force_offset", shares={"force_offset": 0.2})
    both = fitted(1.0, "prestress", "force_offset", shares={"prestress": 0.8, "force_offset": 0.2})
    weights = model_weights([first, second, both], root, rows=ROWS, noise=1.0)
    # Without free parameters S = n ln h, but for the 0.01 per step that ties go by; so exp(-S/2) = h^(-n/2).
    h = {"root": 9.0, "first": 1.0, "second": 1.21, "both": 1.0}
    odds = {"root": 1.0, "first": 4.0, "second": 0.25, "both": 1.0}
    raw = {name: odds[name] * h[name] ** (-ROWS / 2.0) for name in h}
    share = (raw["first"] + raw["both"]) / sum(raw.values())
    assert weights.share(["prestress"]) == pytest.approx(share, rel=0.02)
    assert weights.share(["prestress", "force_offset"]) == pytest.approx(1.0)
    assert weights.share(["creep"]) == 0.0


def test_of_models_that_differ_in_freed_constants_the_best_counts() -> None:
    root, good = fitted(2.0), fitted(1.0, "prestress")
    worse = replace(fitted(1.5, "prestress"), freed=frozenset({"prestress.force"}))
    alone = model_weights([good], root, rows=ROWS, noise=1.0)
    together = model_weights([worse, good, worse], root, rows=ROWS, noise=1.0)
    assert together.weights == pytest.approx(alone.weights)


def test_between_models_that_fit_alike_one_group_left_out_does_not_decide_alone() -> None:
    """The first is better on every reading, the second on the groups left out: half of the evidence each."""
    better = fitted(1.0, "prestress")
    other = fitted(1.1, "force_offset")
    lost = np.full(6, 1.0)
    lost[3] = 4.0
    better.__dict__["fold_squares"] = (lost,)
    here, there = (log_weight(model, rows=ROWS, noise=1.0) for model in (better, other))
    # ln h is ln(4)/6 on average beside ln(1.21)
    assert here - there == pytest.approx(ROWS / 2.0 * (log(1.21) - log(4.0) / 6.0), abs=0.02)
    assert here < there
    here, there = (log_preference(model, rows=ROWS, noise=1.0) for model in (better, other))
    assert here - there == pytest.approx(ROWS / 4.0 * (2.0 * log(1.21) - log(4.0) / 6.0), abs=0.02)
    assert here > there


def test_models_without_the_effects_of_the_start_do_not_count() -> None:
    root, less = fitted(2.0, "creep"), fitted(0.1)
    weights = model_weights([less, fitted(1.0, "creep", "prestress")], root, rows=ROWS, noise=1.0)
    assert weights.share(["prestress"]) == pytest.approx(1.0)
    assert score(less, rows=ROWS, noise=1.0) < score(root, rows=ROWS, noise=1.0)


def test_a_loss_is_measured_in_noise_and_as_a_part_of_what_is_explained() -> None:
    found = loss(fitted(1.0, "prestress", "creep"), fitted(3.0, "creep"), fitted(5.0), noise=2.0)
    assert found.size == pytest.approx(sqrt(9.0 - 1.0) / 2.0)
    assert found.part == pytest.approx(sqrt((9.0 - 1.0) / (25.0 - 1.0)))
    none = loss(fitted(1.0), fitted(0.9), fitted(1.0), noise=1.0)
    assert none.size == 0.0
    assert none.probability < 1e-6


def test_beside_an_unknown_effect_what_is_named_is_less_sure() -> None:
    """Over a noise of 1: of 10 above it 6 are left, or 1."""
    alone = Evidence("creep", ("creep",), 1.0, Loss(20.0, 0.9))
    assert replace(alone, known=0.6).probability == pytest.approx(0.6 * alone.probability)
    root = fitted(np.sqrt(101.0))
    for left, known in ((6.0, 0.4**2), (1.0, 0.9**2), (0.0, 1.0)):
        assert known_beside(fitted(np.sqrt(left**2 + 1.0)), root, noise=1.0) == pytest.approx(known, rel=1e-6)


def test_a_wrong_entry_makes_the_effects_unlikely_that_its_correction_does_without() -> None:
    def found(confidence: float, *effects: str, **said: bool) -> Any:
        more: dict[str, Any] = {"stands": True, "kept": False, "entry": SimpleNamespace(prior=0.2), **said}
        return SimpleNamespace(confidence=confidence, effects=effects, instead_of=("creep", "leak"), **more)

    assert entries_right([], ["creep"]) == 1.0
    assert entries_right([found(0.98, "prestress")], ["creep"]) == pytest.approx(0.02)
    # One of two is wrong: odds of 49 and of 4 to 1.
    assert entries_right([found(0.98, "prestress"), found(0.8)], ["creep"]) == pytest.approx(1.0 / 54.0)
    # What is only as good as the effects has the odds of such a mistake; what is ruled out has none.
    assert entries_right([found(0.98, "prestress", stands=False)], ["creep"]) == pytest.approx(1.0 / 1.2)
    assert entries_right([found(0.98, "prestress", kept=True)], ["creep"]) == 1.0
    # It says nothing of an effect that it does not do without.
    assert entries_right([found(0.98, "dahl")], ["bouc_wen"]) == 1.0
    assert entries_right([found(0.98, "prestress")], ["leak", "prestress"]) == 1.0
    alone = Evidence("creep", ("creep",), 1.0, Loss(20.0, 0.9))
    doubted = replace(alone, entries_right=0.02)
    assert doubted.probability == pytest.approx(0.02 * alone.probability)


def test_a_large_effect_is_likely_and_a_small_correction_is_not() -> None:
    """Sizes as they occur in `tests.truth`: an effect of 20 times the noise, and 3 % of it at the noise."""
    assert Loss(20.0, 1.0).probability > 0.99
    assert Loss(0.6, 0.03).probability < PROBABILITY.likely
    sizes = np.geomspace(0.1, 10.0, 9)
    assert np.all(np.diff([Loss(size, 0.1).probability for size in sizes]) > 0.0)
    assert np.all(np.diff([Loss(2.0, part).probability for part in sizes / 10.0]) > 0.0)


def test_a_group_shares_one_probability() -> None:
    found = Evidence("prestress", ("prestress", "force_offset"), 0.9, Loss(20.0, 1.0))
    assert found.probability == pytest.approx(0.9 * Loss(20.0, 1.0).probability)


def test_the_weight_of_evidence_is_half_the_score() -> None:
    root, one = fitted(1.0), fitted(exp(-0.05), "prestress")
    weights = model_weights([one], root, rows=ROWS, noise=0.1)
    share = weights.share(["prestress"])
    assert log(share / (1.0 - share)) == pytest.approx(0.05 * ROWS, abs=0.02)


def test_models_less_plausible_than_the_best_do_not_count() -> None:
    """A better fit with a parameter at its bound is none that a search would choose."""
    free = Free("force_offset.offset", 100.0, 0.0, 100.0, "N", off=0.0)
    wild = replace(fitted(0.5, "force_offset"), free=(free,), jacobian=np.ones((60, 1)))
    assert wild.implausible == 1
    root, best = fitted(3.0), fitted(1.0, "prestress")
    weights = model_weights([wild, best], root, rows=ROWS, noise=0.1, implausible=0)
    assert weights.share(["prestress"]) == pytest.approx(1.0)
    assert weights.share(["force_offset"]) == 0.0


def test_none_is_likely_where_none_of_the_named_is_likelier_there_than_not() -> None:
    likely, even, unlikely = (Evidence("creep", ("creep",), p, Loss(1e6, 1.0)) for p in (0.9, 0.45, 0.25))
    assert unlikely.probability < even.probability < 0.5 < likely.probability
    assert none_likely([unlikely])
    assert none_likely([even])
    # One of two that each may be it is there: 1 - 0.55^2.
    assert not none_likely([even, even])
    assert none_likely([unlikely, unlikely])
    assert not none_likely([unlikely, likely])
    assert not none_likely([replace(unlikely, read=True)])
    assert not none_likely([])
