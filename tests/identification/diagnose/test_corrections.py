"""Effects that only correct the form of another: which of them are left out, and what is said of it."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from mckibben.identification.diagnose.corrections import Correction, refined, without_corrections
from mckibben.identification.diagnose.probability import Loss
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.thresholds import PROBABILITY
from mckibben.physics.effect import Effect
from tests.identification.diagnose.test_diagnosis import diagnosis
from tests.identification.diagnose.test_probability import fitted
from tests.identification.synthetic import cycles


class Dropping:
    """Stands for a fitter: the models without each effect are given."""

    def __init__(self, **without: object) -> None:
        self.without = without

    def dropping(self, model: object, effect: str) -> object:
        return self.without[f"{effect}_of_{len(model.fit_model.ids)}"]  # type: ignore[attr-defined]


def test_the_least_likely_goes_first_and_what_remains_is_judged_again() -> None:
    root = fitted(20.0)
    best = fitted(1.0, "prestress", "creep", "mullins")
    without_creep = fitted(1.1, "prestress", "mullins")
    fitter = Dropping(
        creep_of_3=without_creep,
        prestress_of_3=fitted(1.3, "creep", "mullins"),
        mullins_of_3=fitted(1.2, "prestress", "creep"),
        # Without creep the other two are needed.
        prestress_of_2=fitted(9.0, "mullins"),
        mullins_of_2=fitted(8.0, "prestress"),
    )
    kept, corrections = without_corrections(fitter, best, root, 1.0)  # type: ignore[arg-type]
    assert kept is without_creep
    assert [item.effect for item in corrections] == ["creep"]
    assert (corrections[0].before, corrections[0].after) == pytest.approx((1.1, 1.0))


def test_a_single_effect_is_never_a_correction() -> None:
    best = fitted(1.0, "prestress")
    assert without_corrections(Dropping(), best, fitted(1.01), 1.0) == (best, ())  # type: ignore[arg-type]


class Adding:
    """Stands for a fitter: the models with each effect are given."""

    noise = 1.0

    def __init__(self, *, simulated: bool = False, **with_effect: FittedModel) -> None:
        self.with_effect = with_effect
        model = next(iter(with_effect.values()))
        self.predictor = SimpleNamespace(
            simulated=simulated, sweeps=[np.arange(len(model.residual))], folds=model.folds
        )

    def adding(self, model: FittedModel, effect: Effect) -> FittedModel:
        return self.with_effect[effect.id]


def kept_of(fitter: Adding, lean: FittedModel, searched: FittedModel, effect: str) -> list[str]:
    correction = Correction(effect, lean.rmse, searched.rmse, Loss(0.5, 0.01))
    steps, told = refined(fitter, lean, searched, [correction])  # type: ignore[arg-type]
    assert [name for name, _ in steps] == [item.effect for item in told if item.kept]
    assert (told[0].before, told[0].after) == pytest.approx((lean.rmse, searched.rmse))
    return [name for name, _ in steps]


def test_a_correction_is_kept_where_the_model_predicts_better_with_it() -> None:
    lean = fitted(1.3, "prestress")
    helps = fitted(1.0, "prestress", "linear_elasticity")
    assert kept_of(Adding(linear_elasticity=helps), lean, helps, "linear_elasticity") == ["linear_elasticity"]
    idle = fitted(1.29, "prestress", "linear_elasticity")
    assert kept_of(Adding(linear_elasticity=idle), lean, idle, "linear_elasticity") == []


def test_a_correction_brings_no_dependence_on_time_into_a_model_without_one() -> None:
    lean, searched = fitted(1.3, "prestress"), fitted(1.0, "prestress", "creep")
    assert kept_of(Adding(creep=searched), lean, searched, "creep") == []
    # A simulated run depends on time anyway.
    assert kept_of(Adding(creep=searched, simulated=True), lean, searched, "creep") == ["creep"]
    damped, both = fitted(1.3, "viscous_damping"), fitted(1.0, "viscous_damping", "creep")
    assert kept_of(Adding(creep=both), damped, both, "creep") == ["creep"]


def test_what_is_left_out_is_said_and_the_error_stays_near_the_noise() -> None:
    found = diagnosis(cycles(noise=1.0, each=30, prestress=40.0))
    assert found.best.rmse < 1.2
    for item in found.corrections:
        assert item.effect not in found.added
        assert item.before > item.after
        assert 0.0 <= found.probability_of(item.effect) < PROBABILITY.likely
    assert found.probability_of(found.added[0]) > 0.9
    assert all(0.0 <= found.probability_of(c.effect.id) <= 1.0 for c in found.candidates)
    assert np.isclose(found.probability_of("prestress"), found.probability_of("force_offset"))
