"""A rival refitted to present data and an experiment, against closed forms; designs with verified promises.

The laws here only use the names of effects: a constant force, and one that comes with the travel.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
import pytest

from mckibben.identification.diagnose.adapting import further_constants, left_after_refit
from mckibben.identification.diagnose.design import APART, Designer
from mckibben.identification.diagnose.protocol import Protocol, Schedule
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.predict.fit_model import FitModel, free_numbers
from tests.identification.synthetic import CATALOGUE, MUSCLE, Plain

Law = Callable[[FitModel, np.ndarray], np.ndarray]


class Along(Plain):
    """Readings over a travel x, by a law of the model's constants."""

    def __init__(self, law: Law, x: np.ndarray, measured: np.ndarray | None = None) -> None:
        values = np.zeros(len(x)) if measured is None else measured
        super().__init__(values, np.empty((len(x), 0)), [np.arange(len(x)) // 10])
        self.groups = np.zeros(len(x), int)
        self.law, self.x = law, x

    def predict(self, fit_model: FitModel, *, clipped: bool = True) -> np.ndarray:
        return self.law(fit_model, self.x)


def force(model: FitModel, x: np.ndarray) -> np.ndarray:
    """Constant, or F (1 - exp(-x / b)), or c x."""
    total = np.zeros(len(x))
    if "coulomb_friction" in model.ids:
        total += model.number("coulomb_friction.force")
    if "dahl" in model.ids:
        total += model.number("dahl.force") * (1.0 - np.exp(-x / model.number("dahl.break_strain")))
    if "viscous_damping" in model.ids:
        total += model.number("viscous_damping.coefficient") * x
    return total


def model(name: str, present: Plain, *free: str, **values: float) -> FittedModel:
    """A model with one effect, as if fitted to the present data by the constants named."""
    effect = CATALOGUE[name]
    fit_model = FitModel(MUSCLE, (effect,), {name: effect.defaults | values})
    names = {f"{name}.{one}" for one in free}
    chosen = tuple(p for p in free_numbers(fit_model, (), names) if p.name in names)
    values_, slopes = present.linearised(fit_model, chosen)
    return FittedModel(fit_model, chosen, frozenset(), present.measured - values_, slopes, present.folds)


EVERY = np.ones(200, bool)


def test_a_mean_goes_to_where_all_readings_want_it() -> None:
    """20 readings of 4 N and 60 of 10 N: the mean is 8.5 N, which leaves 1.5 N, three sigma of 0.5 N."""
    present = Along(force, np.ones(20), np.full(20, 4.0))
    rival = model("coulomb_friction", present, "force", force=4.0)
    experiment = Along(force, np.ones(60), np.full(60, 10.0))
    left = left_after_refit(rival, present, experiment, EVERY[:60], 0.5)
    assert left == pytest.approx(np.full(60, 3.0), rel=1e-6)


def test_rows_that_do_not_count_are_not_adapted_to() -> None:
    present = Along(force, np.ones(20), np.full(20, 4.0))
    rival = model("coulomb_friction", present, "force", force=4.0)
    experiment = Along(force, np.ones(60), np.repeat([4.0, 90.0], 30))
    left = left_after_refit(rival, present, experiment, np.arange(60) < 30, 1.0)
    assert left == pytest.approx(np.zeros(60), abs=1e-6)


def test_a_constant_that_moves_far_leaves_less_than_its_slope_promises() -> None:
    """Beyond 0.3 of travel no break-away shows; nearer, one of 0.0044, not 0.04, fits what slopes miss."""
    present = Along(force, np.linspace(0.3, 1.0, 40), np.full(40, 15.0))
    rival = model("dahl", present, "force", "break_strain", force=15.0, break_strain=0.04)
    near = Along(force, np.linspace(0.02, 0.1, 40))
    wanted = 15.0 * (1.0 - np.exp(-near.x / 0.0044))
    values, slopes = near.linearised(rival.fit_model, rival.free)
    step = np.linalg.lstsq(np.vstack([slopes, rival.jacobian]), np.append(wanted - values, np.zeros(40)))[0]
    assert np.sqrt(np.mean((wanted - values - slopes @ step) ** 2)) > 1.0
    assert (
        np.sqrt(np.mean(left_after_refit(rival, present, near.reading(wanted), EVERY[:40], 1.0) ** 2)) < 0.05
    )


def test_further_constants_are_freed_unless_they_end_at_a_bound() -> None:
    """The break-away follows 8 N (1 - exp(-x / 0.01)); for a constant it would be 0, beyond its range."""
    present = Along(force, np.linspace(0.5, 1.0, 40), np.full(40, 8.0))
    rival = model("dahl", present, "force", force=8.0, break_strain=0.02)
    assert "dahl.break_strain" in {p.name for p in further_constants(rival)}
    near = Along(force, np.linspace(1e-4, 0.05, 200))
    inside = near.reading(8.0 * (1.0 - np.exp(-near.x / 0.01)))
    assert np.max(np.abs(left_after_refit(rival, present, inside, EVERY, 1.0))) < 0.05
    # With its force alone, by the closed form of one factor fitted to all readings.
    shape, old = 1.0 - np.exp(-near.x / 0.02), 1.0 - np.exp(-present.x / 0.02)
    factor = (8.0 * np.sum(shape) + 8.0 * np.sum(old)) / (np.sum(shape**2) + np.sum(old**2))
    beyond = near.reading(np.full(200, 8.0))
    left = left_after_refit(rival, present, beyond, EVERY, 1.0)
    assert left == pytest.approx(8.0 - factor * shape, abs=1e-3)


def protocol(words: str, x: np.ndarray) -> Protocol:
    return Protocol(words, Schedule(np.zeros(2, int), {"time": np.array([0.0, 30.0])}), Along(force, x))


def designed(tests: Sequence[Protocol], *, verified: bool) -> list[str]:
    """Words of the experiments for a constant force and one that comes with the travel."""
    present = Along(force, np.linspace(0.3, 1.0, 40), np.full(40, 15.0))
    models = {
        "coulomb_friction": model("coulomb_friction", present, "force", force=15.0),
        "dahl": model("dahl", present, "force", "break_strain", force=15.0, break_strain=0.03),
    }
    designer = Designer(tests, 1.0, present if verified else None)
    return [one.words for one in designer.designs(list(models), models, dict.fromkeys(models, 0.5))]


def test_what_a_rival_can_follow_is_not_promised() -> None:
    """Beyond 0.03 a quicker break-away reads the constant; below 0.001 none within the range does."""
    far, near = protocol("far", np.linspace(0.02, 0.04, 40)), protocol("near", np.linspace(1e-4, 1e-3, 40))
    assert designed([far, near], verified=True) == ["near"]
    present = Along(force, np.linspace(0.3, 1.0, 40), np.full(40, 15.0))
    constant = model("coulomb_friction", present, "force", force=15.0)
    coming = model("dahl", present, "force", "break_strain", force=15.0, break_strain=0.03)
    designer = Designer([far, near], 1.0, present)
    assert designer.verified(constant, coming, far) < APART < designer.separation(constant, coming, far)
    sigma, best = designer.farthest(constant, coming)
    assert best is near
    assert sigma > APART


def test_a_second_experiment_splits_what_the_first_one_leaves() -> None:
    """One test tells c x from both others at large x, and only one at small x tells those two apart."""
    present = Along(force, np.linspace(0.9, 1.1, 40), np.full(40, 15.0))
    models = {
        "coulomb_friction": model("coulomb_friction", present, "force", force=15.0),
        "dahl": model("dahl", present, "force", force=15.0, break_strain=0.005),
        "viscous_damping": model("viscous_damping", present, "coefficient", coefficient=15.0),
    }
    long, short = protocol("long", np.linspace(1.5, 2.0, 40)), protocol("short", np.linspace(1e-3, 2e-3, 40))
    designer = Designer([long, short], 1.0, present)
    alone = Designer([long], 1.0, present)
    weights = dict.fromkeys(models, 1 / 3)
    assert [d.words for d in alone.designs(list(models), models, weights)] == ["long"]
    told = {frozenset(pair) for d in designer.designs(list(models), models, weights) for pair in d.decided()}
    assert len(told) == 3
