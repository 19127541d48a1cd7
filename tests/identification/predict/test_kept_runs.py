"""Simulated predictions are kept: the same model is run once."""

from __future__ import annotations

import pickle
from collections.abc import Sequence

import numpy as np

from mckibben.identification.predict import kept_runs
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.kept_runs import KeptRuns
from tests.identification.synthetic import CATALOGUE, MUSCLE

MODEL = FitModel(MUSCLE).adding(CATALOGUE["viscous_damping"])


def damped(*coefficients: float) -> list[FitModel]:
    return [MODEL.with_numbers(["viscous_damping.coefficient"], [value]) for value in coefficients]


class Runs:
    def __init__(self) -> None:
        self.kept, self.made = KeptRuns(), []

    def ask(self, *coefficients: float) -> list[float]:
        return [float(found[0]) for found in self.kept.of(damped(*coefficients), self.run)]

    def run(self, models: Sequence[FitModel]) -> list[np.ndarray]:
        self.made += [model.number("viscous_damping.coefficient") for model in models]
        return [np.full(4, model.number("viscous_damping.coefficient")) for model in models]


def test_a_model_is_run_once():
    runs = Runs()
    assert runs.ask(1.0, 2.0, 1.0) == [1.0, 2.0, 1.0]
    assert runs.ask(2.0, 3.0) == [2.0, 3.0]
    assert runs.made == [1.0, 2.0, 3.0]
    assert damped(3.0)[0] in runs.kept
    assert damped(4.0)[0] not in runs.kept


def test_what_was_asked_for_last_stays(monkeypatch):
    monkeypatch.setattr(kept_runs, "_NUMBERS", 8)  # two predictions of four numbers
    runs = Runs()
    assert runs.ask(1.0, 2.0) == [1.0, 2.0]
    runs.ask(1.0)
    runs.ask(3.0)
    runs.ask(1.0)
    assert runs.made == [1.0, 2.0, 3.0]
    runs.ask(2.0)
    assert runs.made == [1.0, 2.0, 3.0, 2.0]
    assert runs.ask(1.0, 2.0, 3.0, 4.0) == [1.0, 2.0, 3.0, 4.0], "more at once than are kept"


def test_geometry_supply_and_order_of_effects_count():
    runs, dead = KeptRuns(), CATALOGUE["dead_volume"]
    other = FitModel(MUSCLE).adding(dead).adding(CATALOGUE["viscous_damping"])
    wider = MODEL.with_numbers(["nominal_length"], [0.25])
    driven = MODEL.with_numbers(["supply_factor"], [0.9])
    made: list[FitModel] = []

    def run(models: Sequence[FitModel]) -> list[np.ndarray]:
        made.extend(models)
        return [np.zeros(1) for _ in models]

    runs.of([MODEL, wider, driven, other], run)
    runs.of([MODEL.adding(dead)], run)
    assert made == [MODEL, wider, driven, other], "the order of the effects changes nothing"


def test_copies_in_other_processes_begin_empty():
    runs = Runs()
    runs.ask(1.0)
    assert damped(1.0)[0] not in pickle.loads(pickle.dumps(runs.kept))
