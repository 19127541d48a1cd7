"""Fast lifts whose weights stand in a column or in the titles: each run has its own load and beginning."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.identification.predict import TransientPredictor, predictor_of
from mckibben.measurement.measurement import Measurement
from tests.identification.synthetic import MUSCLE, G, csv

MASSES = (6.0, 12.0)  # kg
STEPS = np.arange(120)
RAMP = np.clip(STEPS / 50.0, 0.0, 1.0)


def column(*, every: float = 0.01, pause: float = 60.0) -> Measurement:
    """Two lifts on one clock, with a pause in which the weight was changed; kgf as balances show it."""
    rows = [
        f"{number * (120 * every + pause) + step * every:.3f};{mass:g};{4.0 * RAMP[step]:.4f};"
        f"{(60.0 - mass) * RAMP[step] + 0.01 * (step % 3):.3f}"
        for number, mass in enumerate(MASSES)
        for step in STEPS
    ]
    return csv(rows, "time [s];weight [kgf];pressure [bar];stroke [mm]", "rest length 300 mm")


def test_runs_on_one_clock_end_where_it_pauses() -> None:
    found = column()
    assert found.kind == "transient"
    assert found.starts == (0, 120)
    predictor = predictor_of(found, MUSCLE)
    assert isinstance(predictor, TransientPredictor)
    assert [each.load.mass for each in predictor.drives] == pytest.approx(MASSES)
    assert [channel.name for channel in predictor.channels] == ["displacement"]
    assert not any("offset of the sensor" in message for message in found.messages)


def test_the_same_lifts_in_two_minutes_are_slow() -> None:
    found = column(every=1.0, pause=600.0)
    assert found.kind == "isotonic"
    assert np.unique(found.columns["force"]) == pytest.approx(np.multiply(MASSES, G))


def test_titles_say_the_load_of_their_run() -> None:
    lines = ["rest length 300 mm"]
    for mass in MASSES:
        lines += ["", f"load: {mass:g} kg", "time [s];pressure [bar];stroke [mm]"]
        lines += [f"{s / 100:.2f};{4.0 * RAMP[s]:.4f};{(60.0 - mass) * RAMP[s]:.3f}" for s in STEPS]
    found = csv(lines[1:], lines[0])
    assert found.kind == "transient"
    assert "load_mass" not in found.conditions  # the first title is not that of all
    predictor = predictor_of(found, MUSCLE)
    assert isinstance(predictor, TransientPredictor)
    assert [each.load.mass for each in predictor.drives] == pytest.approx(MASSES)
