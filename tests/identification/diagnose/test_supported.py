"""Which effects of the best model are called missing: not those that the visited models hardly hold."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, cast

import numpy as np

from mckibben.identification.diagnose.supported import Supported, supported
from mckibben.identification.diagnose.twins import Alternative
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.fitter import Fitter
from mckibben.identification.thresholds import PROBABILITY
from tests.identification.diagnose.test_probability import fitted
from tests.identification.synthetic import CATALOGUE


def asked(
    model: FittedModel, *others: FittedModel, alternatives: tuple[Alternative, ...] = (), **beside: Any
) -> Supported:
    """What of a model is called missing, among these visited ones."""
    visited = {frozenset(each.fit_model.ids): each for each in (model, *others)}

    def dropping(one: FittedModel, name: str) -> FittedModel:
        return visited[frozenset(one.fit_model.ids) - {name}]

    folds, sweeps = model.folds, [np.arange(60)]
    fits = SimpleNamespace(
        known=dict(enumerate(visited.values())),
        predictor=SimpleNamespace(sweeps=sweeps, folds=folds),
        noise=1.0,
        dropping=dropping,
        candidates=tuple(CATALOGUE.values()),
    )
    return supported(cast(Fitter, fits), model, visited[frozenset()], alternatives, noise=1.0, **beside)


def test_an_effect_that_the_visited_models_hardly_hold_is_kept_and_not_called_missing() -> None:
    creep, both = fitted(1.0, "creep"), fitted(0.995, "creep", "leak")
    found = asked(both, creep, fitted(10.0), fitted(9.0, "leak"))
    assert [item.effect for item in found.evidence] == ["creep"]
    assert found.firm is creep
    assert found.steps == (("leak", both),)
    (correction,) = found.corrections
    assert (correction.effect, correction.before, correction.after, correction.kept) == (
        "leak", creep.rmse, both.rmse, True,
    )  # fmt: skip
    assert correction.probability < PROBABILITY.likely < found.evidence[0].probability


def test_where_noise_may_be_all_nothing_is_called_missing_and_nothing_held() -> None:
    creep, bare = fitted(1.0, "creep"), fitted(10.0)
    found = asked(creep, bare).without_any(bare)
    assert (found.firm, found.evidence, found.steps) == (bare, (), ())
    (correction,) = found.corrections
    assert (correction.effect, correction.kept) == ("creep", False)
    assert correction.probability == asked(creep, bare).evidence[0].probability


def test_effects_that_are_needed_are_all_called_missing() -> None:
    both = fitted(1.0, "creep", "leak")
    found = asked(both, fitted(5.0, "creep"), fitted(9.0, "leak"), fitted(10.0))
    assert [item.effect for item in found.evidence] == ["creep", "leak"]
    assert (found.firm, found.steps, found.corrections) == (both, (), ())


def test_of_several_unlikely_effects_the_likeliest_comes_first_and_the_last_one_is_dropped_first() -> None:
    whole = fitted(0.99, "creep", "leak", "mullins")
    creep, with_leak = fitted(1.0, "creep"), fitted(0.992, "creep", "leak")
    with_mullins = fitted(0.999, "creep", "mullins")
    less = fitted(9.0, "leak", "mullins"), fitted(9.0, "leak"), fitted(9.0, "mullins"), fitted(10.0)
    found = asked(whole, creep, with_leak, with_mullins, *less)
    assert [name for name, _ in found.steps] == ["leak", "mullins"]
    assert [model for _, model in found.steps] == [with_leak, whole]
    assert [item.effect for item in found.corrections] == ["mullins", "leak"]
    assert found.firm is creep


def test_the_likeliest_stays_however_unlikely_it_is() -> None:
    """Something is missing; that no effect is likely is said of the whole."""
    leak = fitted(9.99, "leak")
    found = asked(leak, fitted(10.0), fitted(1.0, "creep"))
    assert [item.effect for item in found.evidence] == ["leak"]
    assert found.evidence[0].probability < PROBABILITY.likely
    assert not found.corrections


def test_what_the_data_cannot_tell_from_an_effect_speaks_for_it() -> None:
    """Most of the weight lies on models with the twin, which the group counts as its own."""
    both, creep = fitted(2.0, "creep", "leak"), fitted(6.0, "creep")
    better = fitted(0.5, "creep", "mullins")
    others = (creep, better, fitted(10.0), fitted(9.0, "leak"))
    alone = asked(both, *others)
    assert [item.effect for item in alone.evidence] == ["creep"]
    assert alone.corrections[0].share < 0.1
    group = asked(both, *others, alternatives=(Alternative("leak", "mullins", 0.1, better),))
    assert [item.effect for item in group.evidence] == ["creep", "leak"]
    assert group.evidence[1].group == ("leak", "mullins")
    assert group.evidence[1].share > 0.9


def test_other_laws_of_dry_friction_speak_for_the_one_of_the_model() -> None:
    """Two laws that repair each other weigh most; a damping instead of it would speak against it."""
    rubs, more = fitted(1.2, "coulomb_friction", "creep"), ("maxwell_slip", "pressure_friction", "creep")
    others = (fitted(10.0), fitted(6.0, "coulomb_friction"), fitted(6.0, "creep"))
    found = asked(rubs, *others, fitted(0.8, *more))
    assert {item.effect: item.share > 0.9 for item in found.evidence} == {
        "coulomb_friction": True, "creep": True,
    }  # fmt: skip
    damped = asked(rubs, *others, fitted(0.8, "viscous_damping", "creep"))
    assert [item.effect for item in damped.evidence] == ["creep"]
    # Beside a law that the model holds itself, the weight of that one is no support.
    both = fitted(1.2, "coulomb_friction", "dahl")
    beside = asked(both, fitted(10.0), fitted(6.0, "coulomb_friction"), fitted(0.8, "dahl"))
    assert [item.effect for item in beside.evidence] == ["dahl"]


def test_beside_a_rest_that_nothing_explains_an_effect_must_be_likelier_than_not() -> None:
    """Half of the error is left, so the effect that takes the other half may only imitate what acts there."""
    half = fitted(5.0, "creep")
    alone = asked(half, fitted(10.0))
    assert [item.effect for item in alone.evidence] == ["creep"]
    beside = asked(half, fitted(10.0), unknown=1.0, left=True, enough=False)
    assert beside.evidence == ()
    assert [item.effect for item in beside.corrections] == ["creep"]
    nearly_all = asked(fitted(1.2, "creep"), fitted(10.0), unknown=1.0, left=True, enough=False)
    assert [item.effect for item in nearly_all.evidence] == ["creep"]


def test_where_the_data_decide_nothing_no_effect_is_named_that_is_hardly_likely() -> None:
    small = fitted(9.99, "creep")
    assert [item.effect for item in asked(small, fitted(10.0)).evidence] == ["creep"]
    assert asked(small, fitted(10.0), enough=False).evidence == ()


def test_an_effect_that_a_free_surface_explains_as_well_is_not_called_missing() -> None:
    """Two effects reach the noise; beside a surface one of them adds nothing, the other one much."""
    both = fitted(1.0, "creep", "leak")
    visited = both, fitted(5.0, "creep"), fitted(9.0, "leak"), fitted(10.0)

    def likely(**worth: float) -> Supported:
        return asked(*visited, beside=lambda model: sum(worth[name] for name in model.fit_model.ids))

    assert [item.effect for item in likely(creep=10.0, leak=10.0).evidence] == ["creep", "leak"]
    one = likely(creep=10.0, leak=-10.0)
    assert [item.effect for item in one.evidence] == ["creep"]
    assert one.firm.fit_model.ids == ("creep",)
    assert [(item.effect, item.formula) for item in one.corrections] == [("leak", True)]
    assert one.steps == (("leak", both),)
    bare = one.without_corrections()
    assert (bare.firm, bare.steps, [item.kept for item in bare.corrections]) == (one.firm, (), [False])
    none = likely(creep=-10.0, leak=-10.0)
    assert (none.firm.fit_model.ids, none.evidence, none.steps) == ((), (), ())
