"""Hanging loads with memory: predictions from pressure and load alone."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from mckibben.identification.fit.effort import final_effort
from mckibben.identification.fit.misfit import Misfit
from mckibben.identification.predict import QuasistaticPredictor, predictor_of
from mckibben.identification.predict.fit_model import FitModel, free_numbers
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.muscle import Muscle
from tests.identification.synthetic import csv

CATALOGUE = default_catalogue()
MUSCLE = Muscle(nominal_length=0.3, braid_diameter=0.02, braid_angle=math.radians(25.0))
THREAD = 0.3 / math.cos(math.radians(25.0))
TURNS = THREAD * math.sin(math.radians(25.0)) / (math.pi * 0.02)
WEIGHT, FRICTION, WAY = 120.0, 9.0, 1.5e-3  # N, N, m
NOISE = 1e-4  # m


def followed(pressure: np.ndarray) -> np.ndarray:
    """Lengths of the ideal muscle with Dahl's friction, by bisection of the balance row by row."""
    lengths, share, before = [], 0.0, 0.0
    for row, p in enumerate(pressure):
        low, high = 0.2, 0.329
        for _ in range(60):
            middle = 0.5 * (low + high)
            moved = middle - before if row else 0.0
            end = math.copysign(1.0, moved)
            z = end - (end - share) * math.exp(-abs(moved) / WAY)
            force = p * (3.0 * middle**2 - THREAD**2) / (4.0 * math.pi * TURNS**2) + FRICTION * z
            low, high = (low, middle) if force > WEIGHT else (middle, high)
        share, before = z, middle
        lengths.append(middle)
    return np.array(lengths)


def record(seed: int) -> QuasistaticPredictor:
    draw = np.random.default_rng(seed)
    time = np.linspace(0.0, 60.0, 481)
    pressure = 3e5 - 1.6e5 * np.cos(0.32 * time) - 0.5e5 * np.cos(1.3 * time)
    length = followed(pressure) + NOISE * draw.normal(size=len(time))
    read = pressure + 300.0 * draw.normal(size=len(time))
    rows = [f"{t},{p / 1e5},{1e3 * x}" for t, p, x in zip(time, read, length, strict=True)]
    made = csv(rows, "time_s,pressure_bar,length_mm", "kind: isotonic", f"load_force: {WEIGHT} N")
    predictor = predictor_of(made, MUSCLE)
    assert isinstance(predictor, QuasistaticPredictor)
    return predictor


def test_noise_of_the_measured_length_does_not_hide_the_way_of_friction():
    predictor = record(0)
    start = FitModel(MUSCLE).adding(CATALOGUE["dahl"])
    misfit = Misfit(predictor, start, free_numbers(start, freed={"dahl.break_strain"}))
    found = {
        each.name: each.value for each in misfit.report(misfit.fit(final_effort(simulated=False))).parameters
    }
    assert found["dahl.force"] == pytest.approx(FRICTION, rel=0.03)
    assert found["dahl.break_strain"] * 0.3 == pytest.approx(WAY, rel=0.1)


def test_a_prediction_does_not_follow_the_measured_length():
    predictor = record(1)
    model = FitModel(MUSCLE).adding(CATALOGUE["dahl"], {"force": FRICTION, "break_strain": WAY / 0.3})
    there = predictor.predict(model)
    assert np.sqrt(np.mean((there - predictor.measured) ** 2)) < 1.15 * NOISE
    same, other = (
        QuasistaticPredictor(replace(predictor.task, measured=predictor.task.measured + longer))
        for longer in (0.0, 5e-3)
    )
    assert other.predict(model) == pytest.approx(same.predict(model), abs=1e-12)


@pytest.mark.parametrize("answers", [False, True])
def test_noise_of_the_pressure_is_averaged_and_said_unless_the_length_answers_to_it(answers: bool) -> None:
    draw = np.random.default_rng(2)
    time = np.linspace(0.0, 60.0, 301)
    slow = np.interp(time, [0.0, 30.0, 60.0], [2e5, 5e5, 2e5])
    read = slow + 1000.0 * draw.normal(size=len(time))
    length = 0.29 - 1e-7 * (read if answers else slow) + 2e-5 * draw.normal(size=len(time))
    rows = [f"{t},{p / 1e5},{1e3 * x}" for t, p, x in zip(time, read, length, strict=True)]
    made = csv(rows, "time_s,pressure_bar,length_mm", "kind: isotonic", f"load_force: {WEIGHT} N")
    predictor = predictor_of(made, MUSCLE)
    told = [message for message in predictor.messages if "noise of the pressure readings" in message]
    assert bool(told) is not answers
    pressure = predictor.task.state["pressure"]
    away = float(np.sqrt(np.mean((pressure - slow) ** 2)))
    assert (away > 900.0) if answers else (away < 400.0)
