"""The closed form against the static model, design by design, and against formulas of the ideal muscle."""

from __future__ import annotations

from math import cos, pi, radians, sin, tan

import numpy as np
import pytest

from mckibben.documents.studio import Studio
from mckibben.physics import gas
from mckibben.physics.sliding import sliding_effects
from mckibben.physics.units import GRAVITY
from mckibben.simulation.statics import inverse
from mckibben.simulation.statics.model import StaticModel
from mckibben.sizing import MusclePart, Task
from mckibben.sizing.design_table import sheet_of
from mckibben.sizing.statics import AMPLE, at_rest, least_time, margins, outputs
from mckibben.sizing.trial import Trial
from tests.sizing.conftest import LIFT, understood

LENGTHS = np.array([0.25, 0.4, 0.9])
PRESSURES = np.array([2e5, 4.5e5, 6e5])
CONTRACTIONS = np.array([0.02, 0.11, 0.2])


def filling_model(part: MusclePart, length: float) -> StaticModel:
    """The static model of one length, with friction built up where a direction is asked for."""
    effects = {effect.id: effect for effect in sliding_effects(effects=part.effects)}
    return StaticModel(part.muscle._replace(nominal_length=length), part.values, catalogue=effects)


@pytest.mark.parametrize("muscle", ["DMSP-10", "DMSP-20", "DMSP-40"])
def test_arrays_of_lengths_are_the_static_model_at_each_length(studio: Studio, muscle: str) -> None:
    _, catalogue = understood({**LIFT, "catalogue": {"muscles": [muscle]}}, studio)
    part = catalogue.muscles[0]
    found = outputs(part, length=LENGTHS, contraction=CONTRACTIONS, pressure=PRESSURES)
    for index, length in enumerate(LENGTHS):
        model = filling_model(part, length)
        state = {"length": length * (1.0 - CONTRACTIONS[index]), "pressure": PRESSURES[index]}
        single = model.outputs(**state, direction=-1.0)
        for name in ("force", "force_by_length", "volume", "outer_diameter"):
            assert found[name][index] == pytest.approx(single[name][0], rel=1e-12)


def ideal_area(contraction: float) -> float:
    """Force of the muscle of the paper per pressure: 10 mm at 25 degrees."""
    angle = radians(25.0)
    return pi / 4.0 * 0.01**2 * (3.0 * (1.0 - contraction) ** 2 / tan(angle) ** 2 - 1.0 / sin(angle) ** 2)


def paper_muscle(studio: Studio, **load: object):
    document = {
        "load": load, "stroke": "20 mm", "catalogue": {"muscles": ["paper"]}, "limits": {"max_parallel": 2},
    }  # fmt: skip
    task, catalogue = understood(document, studio)
    return task, catalogue.muscles[0]


def test_capacity_of_an_ideal_muscle(studio: Studio) -> None:
    task, part = paper_muscle(studio, mass="5 kg")
    rest = at_rest(part, task.duties()[0], task, np.array([0.2]), np.array([5e5]), np.array([2.0]))
    # The load is the same everywhere, so the end of the stroke decides.
    assert rest.capacity[0] == pytest.approx(2.0 * 5e5 * ideal_area(0.1) / (5.0 * GRAVITY), rel=1e-9)
    assert rest.needed[0] == pytest.approx(5.0 * GRAVITY / (2.0 * ideal_area(0.1)), rel=1e-9)
    # dF/dL = 6 p (pi/4) D0^2 (1 - k)/(L0 tan^2 theta0)
    slope = 6.0 * 5e5 * pi / 4.0 * 0.01**2 * 0.9 / (0.2 * tan(radians(25.0)) ** 2)
    assert rest.stiffness[0] == pytest.approx(2.0 * slope, rel=1e-9)
    wide = 0.01 * (1.0 - 0.81 * cos(radians(25.0)) ** 2) ** 0.5 / sin(radians(25.0))
    assert rest.outer_diameter[0] == pytest.approx(wide, rel=1e-9)


def test_a_lever_changes_stroke_and_force(studio: Studio) -> None:
    task, part = paper_muscle(studio, mass="5 kg", lever_ratio=0.5)
    rest = at_rest(part, task.duties()[0], task, np.array([0.2]), np.array([5e5]), np.array([1.0]))
    assert rest.contraction[0] == pytest.approx(0.05)
    assert rest.tension[0] == pytest.approx(2.0 * 5.0 * GRAVITY, rel=1e-12)
    assert rest.load[0] == pytest.approx(2.0 * 5.0 * GRAVITY, rel=1e-12)
    assert rest.capacity[0] == pytest.approx(5e5 * ideal_area(0.05) / (2.0 * 5.0 * GRAVITY), rel=1e-9)


def test_needed_pressure_is_that_of_the_inverse_question(studio: Studio) -> None:
    task, catalogue = understood(LIFT, studio)
    part = catalogue.muscles[1]
    rest = at_rest(part, task.duties()[0], task, np.array([0.4]), np.array([6e5]), np.array([1.0]))
    model = filling_model(part, 0.4)
    answer = inverse.stroke_pressure(model, load=20.0 * GRAVITY, stroke=0.06)
    assert answer.value == pytest.approx(rest.needed[0], rel=1e-6)


def test_the_needed_pressure_carries_the_load_on_the_whole_stroke(studio: Studio) -> None:
    # The force falls faster than the muscle loses pull: what lifts the load decides, not what holds it.
    profile = {"strokes": [0.0, 0.02], "forces": [100.0, 10.0]}
    task, part = paper_muscle(studio, mass="1 kg", force_over_stroke=profile)
    rest = at_rest(part, task.duties()[0], task, np.array([0.2]), np.array([5e5]), np.array([1.0]))
    strokes = np.linspace(0.0, 0.02, 7)
    loads = GRAVITY + 100.0 - 90.0 * strokes / 0.02
    pressures = [load / ideal_area(stroke / 0.2) for load, stroke in zip(loads, strokes, strict=True)]
    assert rest.needed[0] == pytest.approx(max(pressures), rel=1e-9)
    assert rest.lifting[0] == pytest.approx(pressures[0], rel=1e-9)
    assert rest.holding[0] == pytest.approx(pressures[-1], rel=1e-9)
    assert rest.holding[0] < 0.5 * rest.needed[0]


def test_a_force_over_the_stroke_is_never_below_its_straight_line() -> None:
    profile = ((0.0, 0.02, 0.05, 0.06), (10.0, 60.0, 70.0, 40.0))
    duty = Task(stroke=0.06, force=5.0, spring=100.0, force_over_stroke=profile).duties()[0]
    start, slope = duty.straight()
    at = np.linspace(0.0, 0.06, 61)
    assert np.all(start + slope * at >= duty.load(at) - 1e-9)
    assert slope >= 0.0
    # The line through the two highest points has the least excess of those that do not fall.
    assert start + slope * 0.05 == pytest.approx(75.0 + 100.0 * 0.05)
    assert start + slope * 0.02 == pytest.approx(65.0 + 100.0 * 0.02)


def test_a_counterweight_takes_weight_and_adds_mass() -> None:
    duty = Task(stroke=0.1, mass=30.0, counterweight=12.0).duties()[0]
    assert duty.mass == 42.0
    assert duty.load(np.zeros(1))[0] == pytest.approx(18.0 * GRAVITY)


def test_the_least_time_is_below_every_simulated_time(studio: Studio) -> None:
    from mckibben.simulation.outcome import Watch
    from mckibben.sizing.batch import Bench
    from mckibben.sizing.catalogue import Group
    from mckibben.sizing.search import DesignCandidate

    task, catalogue = understood({**LIFT, "catalogue": {"muscles": ["DMSP-20"]}}, studio)
    duty, part, bench = task.duties()[0], catalogue.muscles[0], Bench(task, Watch())
    sheet = sheet_of(part, duty, task)
    ran: list[tuple[float, Trial | float]] = []
    for valve in catalogue.valves:
        group = Group(duty, part, 1, valve, catalogue.tubes[0])
        least = least_time(sheet.rest, duty, task, conductance=group.conductance)
        for index in sheet.sound(1)[::13]:
            figures = bench.run(DesignCandidate(group, sheet, sheet.sound(1)).design(int(index)))
            if figures.time is not None:
                ran.append((least[index], figures.time))
    assert len(ran) > 30
    assert all(bound <= taken for bound, taken in ran)


def test_air_is_the_mass_that_fills_the_volume(studio: Studio) -> None:
    task, part = paper_muscle(studio, mass="5 kg")
    rest = at_rest(part, task.duties()[0], task, np.array([0.2]), np.array([5e5]), np.array([1.0]))
    warm = gas.GAS_CONSTANT * 293.15
    mass = ((5e5 + 101_325.0) * rest.volume[0] - 101_325.0 * rest.volume_start[0]) / warm
    assert rest.air[0] == pytest.approx(mass / 1.185, rel=1e-9)


def test_a_pair_without_torque_is_never_too_strong_at_rest(studio: Studio) -> None:
    document = {"load": {"pair": {"angle": "40 deg"}}, "catalogue": {"muscles": ["DMSP-10"]}}
    task, catalogue = understood(document, studio)
    part, one = catalogue.muscles[0], np.array([1.0])
    rest = at_rest(part, task.duties()[0], task, 0.3 * one, 5e5 * one, one)
    left = margins(rest, part, task)["force_limit"]
    assert np.isfinite(left).all()
    assert left[0] > AMPLE
