"""Friction and damping of the muscle presets: the slow loop they make, and that a load comes to rest."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mckibben.application.curves.curves import CurvesQuestion, curves
from mckibben.application.run.simulate import SimulationQuestion, SimulationResult, simulate
from mckibben.documents.drive import DriveDocument
from mckibben.documents.drive_reading import drive_of
from mckibben.documents.start_model import StatedMuscle
from mckibben.documents.studio import Studio
from tests.shipped import shipped_studio
from tests.truth.slow_loop import SlowMuscle

MUSCLES = Path(__file__).parents[1] / "presets" / "muscles"
LOADS = {"DMSP-5": 20.0, "DMSP-10": 62.0, "DMSP-20": 250.0, "DMSP-40": 1000.0, "hand-made": 30.0}
PRESSURES = [2e5, 3e5, 4e5]
# Filling and venting pressure [bar] at the same stroke [mm] of a DMSP-10-250 under about 62 N: test rig of
# GitHub tbazina/pam_lqi_pid.
MEASURED = (
    (5.04, 0.938, 0.789),
    (10.1, 1.858, 1.645),
    (15.1, 2.497, 2.303),
    (20.0, 3.056, 2.812),
    (25.1, 3.631, 3.447),
)


@pytest.fixture(scope="module")
def studio() -> Studio:
    return shipped_studio()


def catalogue_loop(name: str) -> float | None:
    data = json.loads((MUSCLES / f"{name}.json").read_text(encoding="utf-8"))["data"]
    return data["max_hysteresis"]["value"] / 100.0 if "max_hysteresis" in data else None


@pytest.mark.parametrize("name", LOADS)
def test_the_loop_of_the_curves_is_that_of_a_slow_triangle_integrated_elsewhere(
    studio: Studio, name: str
) -> None:
    muscle = SlowMuscle.read(MUSCLES / f"{name}.json")
    load, top = LOADS[name], 6e5
    slow = muscle.loop(load, top, PRESSURES, steps=300)
    start = studio.start_model(StatedMuscle(preset=name), None)
    over = curves(CurvesQuestion(start, pressures=(*PRESSURES, top), load=load), studio).over_pressure
    assert over is not None
    assert over.loop is not None
    assert over.loop.stroke[:3] == pytest.approx(slow, rel=0.02)
    assert over.loop.share[:3] == pytest.approx(np.array(slow) / muscle.length, rel=0.02)


@pytest.mark.parametrize("name", LOADS)
@pytest.mark.parametrize("loaded", [False, True])
def test_the_loop_stays_within_the_bound_of_the_catalogue(name: str, loaded: bool) -> None:
    muscle = SlowMuscle.read(MUSCLES / f"{name}.json")
    widths = muscle.loop(LOADS[name] if loaded else 0.0, 6e5, [1e5, 2e5, 3e5, 4e5], steps=300)
    bound = catalogue_loop(name)
    assert all(0.001 < width / muscle.length < (bound or 0.03) for width in widths)


def test_the_loop_of_a_dmsp_10_is_the_measured_one() -> None:
    """0.15 to 0.24 bar, mean 0.2; about 2 mm, 0.8 % of the length."""
    muscle = SlowMuscle.read(MUSCLES / "DMSP-10.json")
    grid = np.linspace(0.2e5, 4.2e5, 81)
    width = np.array(muscle.loop(62.0, 6e5, list(grid), steps=600))
    assert np.mean(width[grid > 1e5]) / 0.25 == pytest.approx(0.008, abs=0.002)
    mean = np.array([_rest(muscle, p) for p in grid])
    slope = -np.gradient(mean, grid)
    ours = []
    for _, up, down in MEASURED:
        at = int(np.argmin(np.abs(grid - 0.5e5 * (up + down))))
        ours.append(width[at] / slope[at] / 1e5)
    measured = [up - down for _, up, down in MEASURED]
    assert np.mean(ours) == pytest.approx(np.mean(measured), rel=0.15)
    assert 0.13 < min(ours) <= max(ours) < 0.26


def _rest(muscle: SlowMuscle, pressure: float) -> float:
    """Length without friction under 62 N [m]."""
    low, high = 0.6 * muscle.length, 1.09 * muscle.length
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if muscle.mean_force(pressure, middle) > 62.0 else (middle, high)
    return low


def lift(studio: Studio, muscle: str, length: str, mass: str, effects: Any) -> SimulationResult:
    """A hanging mass under a step of 5 bar through a proportional valve, for 10 s."""
    document = {
        "muscle": {"preset": muscle, "nominal_length": length},
        "effects": effects,
        "supply": {"pressure": "5 bar"},
        "valve": {"preset": "MPYE-5-1/8-LF"},
        "load": {"mass": mass, "arrangement": "hanging"},
        "command": {"shape": "step", "level": 1.0},
        "stops": {"min_contraction": -0.03},
        "duration": "10 s",
    }
    given = drive_of(DriveDocument.model_validate(document), studio)
    return simulate(SimulationQuestion(given, points=4001))


@pytest.mark.parametrize(
    ("muscle", "length", "mass"),
    [
        ("DMSP-5", "150 mm", "3 kg"),
        ("DMSP-10", "400 mm", "12 kg"),
        ("DMSP-20", "300 mm", "40 kg"),
        ("DMSP-40", "400 mm", "150 kg"),
        ("MAS-20", "800 mm", "40 kg"),
    ],
)
def test_a_load_is_at_rest_after_some_swings(studio: Studio, muscle: str, length: str, mass: str) -> None:
    run = lift(studio, muscle, length, mass, None)
    stroke = np.max(run.position) - run.position[0]
    assert np.ptp(run.position[run.time > 3.0]) < 0.02 * stroke
    assert np.ptp(run.position[run.time > 8.0]) < 1e-4


def test_an_ideal_muscle_has_neither_friction_nor_damping(studio: Studio) -> None:
    assert studio.start_model(StatedMuscle(preset="DMSP-10"), {}).effects == {}
    assert studio.start_model(StatedMuscle(preset="paper"), None).effects == {}
    start = studio.start_model(StatedMuscle(preset="DMSP-10"), {})
    over = curves(CurvesQuestion(start, pressures=(2e5, 4e5), load=62.0), studio).over_pressure
    assert over is not None
    assert over.loop is not None
    assert over.loop.stroke.tolist() == [0.0, 0.0]
