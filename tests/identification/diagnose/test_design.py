"""What an experiment can separate, against closed forms of a linear model."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.identification.diagnose.design import Designer
from mckibben.identification.diagnose.protocol import Rig, protocols
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.predict.fit_model import FitModel, free_numbers
from tests.identification.synthetic import CATALOGUE, MUSCLE

RIG = Rig(pressure=6e5, least=0.0, most=0.2, speed=0.05)
TESTS = protocols(RIG, FitModel(MUSCLE), channel="force")


def model(known: float = 0.0, **values: dict[str, float]) -> FittedModel:
    """A fitted model whose present data say ``known`` about each of its parameters."""
    chosen = tuple(CATALOGUE[name] for name in values)
    fit_model = FitModel(MUSCLE, chosen, {e.id: e.defaults | values[e.id] for e in chosen})
    free = tuple(free_numbers(fit_model, (), frozenset()))
    jacobian = known * np.ones((4, len(free)))
    return FittedModel(fit_model, free, frozenset(), np.zeros(4), jacobian, (np.arange(4),))


def test_two_constant_forces_are_not_separated_under_tension() -> None:
    """Between 4 and 6 bar and up to a contraction of 5 % no row is slack."""
    designer = Designer(TESTS, noise=1.0)
    one, two = model(prestress={"force": 40.0}), model(force_offset={"offset": -40.0})
    tight = protocols(Rig(6e5, 0.0, 0.05, 0.05), FitModel(MUSCLE), channel="force")[1:3]
    for test in tight:
        assert np.all(test.predictor.predict(one.fit_model) > 0.0)
        assert designer.separation(one, two, test) < 0.05


def test_a_slack_muscle_reads_the_zero_of_the_sensor() -> None:
    """Near vented, a prestress of 40 N leaves it slack, which reads 0; an offset of -40 N reads -40 N."""
    ramps = next(test for test in TESTS if test.words.endswith("from vented at five lengths"))
    one = model(known=1e3, prestress={"force": 40.0})
    two = model(known=1e3, force_offset={"offset": -40.0})
    ideal = ramps.predictor.predict(FitModel(MUSCLE))
    groups = ramps.predictor.groups
    # The one reads max(F - 40, 0), the other max(F, 0) - 40.
    apart = np.maximum(40.0 - ideal, 0.0)
    wanted = max(np.sqrt(np.mean(apart[groups == label] ** 2)) for label in np.unique(groups))
    assert Designer(TESTS, noise=1.0).separation(one, two, ramps) == pytest.approx(wanted, rel=1e-3)
    # Where all is slack a reader cannot know it: nothing is promised.
    vented = next(test for test in TESTS if test.words == "a loop of contraction without pressure")
    assert Designer(TESTS, noise=1.0).separation(one, two, vented) == 0.0


def test_friction_and_damping_differ_over_speed() -> None:
    """Two decades of speed: of 15 N of friction, c v can match only one speed, so nearly all remains."""
    designer = Designer(TESTS, noise=1.0)
    one = model(coulomb_friction={"force": 15.0})
    two = model(viscous_damping={"coefficient": 300.0})
    loops = TESTS[0]
    assert 10.0 < designer._apart(one, two, loops) < 15.1
    half = Designer(TESTS, noise=2.0)
    assert half._apart(one, two, loops) == pytest.approx(designer._apart(one, two, loops) / 2.0, rel=0.05)


def test_what_the_present_data_determine_cannot_adapt() -> None:
    """Two offsets of 40 and 50 N: free, one becomes the other; known to 0.1 N, 10 N remain."""
    loose, tight = model(prestress={"force": 40.0}), model(known=5.0, prestress={"force": 40.0})
    other = model(force_offset={"offset": -50.0})
    designer = Designer(TESTS, noise=1.0)
    assert designer._apart(other, loose, TESTS[0]) < 0.1
    # With n readings of the experiment and 4 x 25 of the data, the remaining share is 100 / (100 + n).
    count = int(np.count_nonzero(designer._predicted(tight, TESTS[0]).rows))  # type: ignore[union-attr]
    assert designer._apart(other, tight, TESTS[0]) == pytest.approx(10.0 * 100.0 / (100.0 + count), rel=0.05)


def test_the_experiment_that_splits_the_likely_pairs_is_chosen() -> None:
    models = {
        "coulomb_friction": model(coulomb_friction={"force": 15.0}),
        "viscous_damping": model(viscous_damping={"coefficient": 300.0}),
        "pressure_friction": model(pressure_friction={}),
    }
    weights = {name: CATALOGUE[name].prior.share for name in models}
    found = Designer(TESTS, noise=1.0).designs(list(models), models, weights)[0]
    assert found.words in {test.words for test in TESTS}
    assert found.between("viscous_damping", "coulomb_friction") == pytest.approx(
        found.between("coulomb_friction", "viscous_damping")
    )
    assert ("coulomb_friction", "viscous_damping") in found.decided()


def test_without_experiments_nothing_is_designed() -> None:
    models = {"prestress": model(prestress={}), "force_offset": model(force_offset={})}
    weights = dict.fromkeys(models, 0.5)
    assert Designer((), 1.0).designs(list(models), models, weights) == []
