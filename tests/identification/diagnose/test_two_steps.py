"""Two steps at once: their first-order gain within bounds, and a wall that no single step finds."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.identification.diagnose.two_steps import _left, _Step, two_steps_ahead
from mckibben.identification.fit.effort import diagnosis_effort
from mckibben.identification.fit.fitter import Fitter
from mckibben.identification.predict import predictor_of
from mckibben.identification.predict.fit_model import FitModel
from tests.identification.synthetic import CATALOGUE, MUSCLE, force_map

HIDDEN = {"bladder_elasticity", "prestress"}


def step(column: list[float], low: float = -np.inf, high: float = np.inf) -> _Step:
    bounds = (np.array([end]) for end in (low, high))
    return _Step(CATALOGUE["prestress"], True, np.array([column]).T, *bounds)


def test_what_a_pair_leaves_obeys_the_bounds() -> None:
    """Of r = (3, -4, 12) the columns e1 and e2 leave 12^2; where e2 may only rise 12^2 + 4^2."""
    residual = np.array([3.0, -4.0, 12.0])
    first, second = step([1.0, 0.0, 0.0]), step([0.0, 1.0, 0.0])
    assert _left([first], residual) == pytest.approx(160.0)
    assert _left([first, second], residual) == pytest.approx(144.0)
    assert _left([first, step([0.0, 1.0, 0.0], low=0.0)], residual) == pytest.approx(160.0)
    assert _left([step([1.0, 0.0, 0.0], high=1.0), second], residual) == pytest.approx(148.0)


def test_two_steps_lead_to_what_is_hidden() -> None:
    """A bladder that pulls cancels most of what its wall takes: each alone explains little of the map."""
    predictor = predictor_of(force_map(noise=1.0, c10=0.4e6, prestress=-200.0), MUSCLE)
    others = ("effectiveness", "contraction_factor", "length_offset")
    candidates = tuple(CATALOGUE[name] for name in (*others, *sorted(HIDDEN)))
    fitter = Fitter(
        predictor=predictor.prepared(FitModel(MUSCLE), candidates), geometry=(), candidates=candidates,
        noise=1.0, load=None, effort=diagnosis_effort(simulated=False),
    )  # fmt: skip
    root = fitter.fit(FitModel(MUSCLE))
    assert all(fitter.adding(root, CATALOGUE[name]).rmse > 0.7 * root.rmse for name in HIDDEN)
    found = min(two_steps_ahead(fitter, [root]), key=lambda model: model.rmse)
    assert set(found.fit_model.ids) == HIDDEN
    assert found.fit_model.number("bladder_elasticity.shear_modulus") == pytest.approx(0.4e6, rel=0.02)
    assert found.fit_model.number("prestress.force") == pytest.approx(-200.0, rel=0.02)
