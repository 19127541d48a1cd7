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


@pytest.mark.parametrize(("every", "kind"), [(0.05, "transient"), (0.2, "isotonic")])
def test_stairs_under_a_load_in_a_column_are_slow_where_no_row_shows_inertia(every: float, kind: str) -> None:
    """Quick steps with long holds: between rows 0.2 s apart a mass has come to rest."""
    levels = np.repeat([0.0, 0.3, 0.6, 0.9, 0.6, 0.3], round(5.0 / every))
    rows = [f"{n * every:.2f};{1.0 + 3.0 * x:.3f};{290 - 50 * x:.1f};14" for n, x in enumerate(levels)]
    found = csv(rows, "time_s;pressure_bar;length_mm;load_kg", "rest length: 300 mm", "load: 14 kg")
    assert found.kind == kind


@pytest.mark.parametrize(
    ("swing", "rate", "kind"), [(0.0, 1.0, "isotonic"), (2.0, 1.5, "transient"), (5.0, 4.0, "transient")]
)
def test_even_waves_under_a_weight_are_slow_unless_it_swings(swing: float, rate: float, kind: str) -> None:
    """14 mm at 0.53 Hz are 1.6 % of gravity at most; 2 mm at 1.5 Hz on top of them add 1.8 %.

    A swing of 4 Hz is back after 0.25 s, over which accelerations are told.
    """
    time = np.arange(500) * 0.08
    wave = 14.0 * np.sin(2.0 * np.pi * 0.53 * time)
    length = 270.0 + wave + swing * np.sin(2.0 * np.pi * rate * time)
    rows = [f"{t:.2f},{3.0 - 0.05 * w:.4f},{x:.3f}" for t, w, x in zip(time, wave, length, strict=True)]
    found = csv(rows, "time_s,pressure_bar,length_mm", "rest length: 300 mm", "load: 4 kg")
    assert found.kind == kind


def test_a_pressure_whose_noise_reaches_far_now_and_then_is_constant() -> None:
    """0.35 % of noise: of 700 readings one or two lie beyond 1 % to either side."""
    draw, way = np.random.default_rng(7), np.abs(np.linspace(-1.0, 1.0, 700))
    pressures = 2.0 + 0.007 * draw.standard_normal(700)
    assert np.ptp(pressures) > 0.02 * np.max(pressures)
    rows = [
        f"{0.1 * n:.1f},{p:.4f},{270 + 30 * x:.3f},{60 * x:.2f}"
        for n, (p, x) in enumerate(zip(pressures, way, strict=True))
    ]
    assert csv(rows, "time_s,pressure_bar,length_mm,force_N", "rest length: 300 mm").kind == "isobaric"
