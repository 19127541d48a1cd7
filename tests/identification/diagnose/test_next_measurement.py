"""Experiments that would separate models: what the catalogue says, and what simulated rigs would see."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.identification.diagnose.next_measurement import (
    SeparatingExperiment,
    declared,
    protocols,
    separation,
)
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.quasistatic import QuasistaticPredictor
from tests.identification.synthetic import CATALOGUE, MUSCLE

TESTS = protocols(FitModel(MUSCLE), largest_pressure=6e5)


def fit_model(**values: dict[str, float]) -> FitModel:
    chosen = tuple(CATALOGUE[name] for name in values)
    return FitModel(MUSCLE, chosen, {e.id: e.defaults | values[e.id] for e in chosen})


def test_the_catalogue_says_it_from_either_side():
    words = declared(CATALOGUE["prestress"], CATALOGUE["force_offset"])
    assert "muscle removed" in words
    assert declared(CATALOGUE["force_offset"], CATALOGUE["prestress"])
    assert declared(CATALOGUE["prestress"], CATALOGUE["valve_delay"]) == ""


@pytest.mark.parametrize("number", range(len(TESTS)))
def test_protocols_can_be_made(number):
    task = TESTS[number].task
    assert TESTS[number].words
    assert task.time is not None
    pressure, length = task.state["pressure"], task.state["length"]
    assert np.min(pressure) >= 0.0
    assert np.max(pressure) <= 6e5
    assert np.max(length) < 0.9999 * float(MUSCLE.braid.thread_length)
    for label in np.unique(task.records):
        rows = task.records == label
        assert np.all(np.diff(task.time[rows]) > 0.0)
        # dL/dt as stated is that of the lengths.
        slope = np.gradient(length[rows], task.time[rows])
        assert task.state["velocity"][rows] == pytest.approx(slope)
    assert np.all(np.isfinite(QuasistaticPredictor(task).predict(FitModel(MUSCLE))))


def test_a_constant_force_is_never_told_from_another():
    words, apart = separation(
        fit_model(prestress={"force": 40.0}), fit_model(force_offset={}), TESTS, noise=1.0
    )
    assert apart < 0.5
    text = SeparatingExperiment(
        "prestress", "force_offset", "remove the muscle", words or "any", apart
    ).sentence({})
    assert "a force measurement alone is not enough" in text
    text = SeparatingExperiment("prestress", "force_offset", "", words or "any", apart).sentence({})
    assert "no simulated force measurement separates them, and no other experiment is known" in text


def test_friction_and_damping_differ_over_speed():
    """Two decades of speed: 15 N of friction against a damping that could only match one of them."""
    truth, other = fit_model(coulomb_friction={"force": 15.0}), fit_model(viscous_damping={})
    words, apart = separation(truth, other, TESTS, noise=1.0)
    # Fitted to F_c sign(v) at speeds far apart, c v leaves nearly all of 15 N.
    assert 10.0 < apart < 15.1
    assert words in {protocol.words for protocol in TESTS}
    half = separation(truth, other, TESTS, noise=2.0)[1]
    assert half == pytest.approx(apart / 2.0, rel=1e-6)


def test_a_model_is_not_apart_from_itself():
    same = fit_model(coulomb_friction={"force": 15.0})
    assert separation(same, same, TESTS, noise=1.0)[1] < 1e-4


def test_a_proposal_in_words():
    proposal = SeparatingExperiment("a", "b", "pull it slowly", "loops", 4.26)
    assert proposal.sentence({"a": "Alpha", "b": "Beta"}) == (
        "Alpha or Beta: pull it slowly; simulated best: loops (4.3 sigma apart)"
    )
    assert SeparatingExperiment("a", "b", "", "", 0.0).sentence({}) == "a or b"
