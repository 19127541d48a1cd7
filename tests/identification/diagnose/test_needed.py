"""An effect is needed where it is likelier than noise that is correlated from row to row."""

from __future__ import annotations

from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from mckibben.identification.diagnose.needed import needed, pruned
from mckibben.identification.diagnose.superfluous import superfluous
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.fitter import Fitter
from mckibben.identification.predict.fit_model import FitModel, Free
from tests.identification.synthetic import CATALOGUE, MUSCLE

ROWS = 300
COURSE = np.sin(np.linspace(0.0, 3.0, ROWS))


def model(residual: np.ndarray, *effects: str, columns: np.ndarray | None = None) -> FittedModel:
    """One whose residual is this, with a number for each effect."""
    chosen = tuple(CATALOGUE[name] for name in effects)
    columns = np.tile(COURSE[:, None], len(effects)) if columns is None else columns
    free = tuple(Free(f"{name}.x", 1.0, -1e3, 1e3, "1") for name in effects)
    fit_model = FitModel(MUSCLE, chosen, {effect.id: effect.defaults for effect in chosen})
    lines = [[[np.arange(ROWS)]]]
    return FittedModel(
        fit_model, free, frozenset(), residual, columns, (np.arange(ROWS) // 60,), noise_lines=lines
    )


def noise(rho: float, seed: int) -> np.ndarray:
    drawn = np.random.default_rng(seed).standard_normal(ROWS)
    for row in range(1, ROWS):
        drawn[row] = rho * drawn[row - 1] + np.sqrt(1.0 - rho**2) * drawn[row]
    return drawn


def fitted(values: np.ndarray) -> np.ndarray:
    """What a fit of the course leaves."""
    return values - COURSE * (COURSE @ values) / (COURSE @ COURSE)


def test_a_course_in_white_noise_is_needed_and_one_in_lasting_noise_is_not() -> None:
    white = noise(0.0, 1)
    assert needed(model(fitted(white + 2.0 * COURSE), "creep"), model(white + 2.0 * COURSE)) > 0.95
    chances = []
    for seed in range(8):
        lasting = noise(0.98, seed)
        chances.append(needed(model(fitted(lasting), "creep"), model(lasting)))
    assert np.median(chances) < 0.3


def test_a_rare_effect_has_to_show_more() -> None:
    values = noise(0.0, 1) + 0.35 * COURSE
    common, rare = (
        needed(model(fitted(values), name), model(values)) for name in ("creep", "thread_extensibility")
    )
    assert CATALOGUE["creep"].prior.share > CATALOGUE["thread_extensibility"].prior.share
    assert rare < common


def test_what_noise_explains_as_well_is_left_out_one_after_the_other() -> None:
    values = noise(0.0, 1) + 3.0 * COURSE
    left = fitted(values)
    models = {
        frozenset(): model(values), frozenset({"creep"}): model(left, "creep"),
        frozenset({"leak"}): model(left, "leak"), frozenset({"creep", "leak"}): model(left, "creep", "leak"),
    }  # fmt: skip

    def dropping(one: FittedModel, name: str) -> FittedModel:
        return models[frozenset(one.fit_model.ids) - {name}]

    predictor = SimpleNamespace(sweeps=[np.arange(ROWS)], folds=(np.arange(ROWS) // 60,))
    fitter = cast(Fitter, SimpleNamespace(dropping=dropping, predictor=predictor, noise=1.0))
    both = models[frozenset({"creep", "leak"})]
    assert len(pruned(fitter, both, models[frozenset()]).fit_model.ids) == 1
    # The same of a start model that has both: either one can go, and then the other is needed.
    found = superfluous(fitter, both, both)
    assert len(found) == 1
    assert found[0].rmse == pytest.approx(float(np.sqrt(np.mean(left**2))))
