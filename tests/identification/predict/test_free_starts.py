"""The start of a run as a part of the fit: found where it is off, of each run its own, refused elsewhere."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mckibben.identification.fit.comparison import compared
from mckibben.identification.predict import driven_by_pressure, predictor_of
from mckibben.identification.predict.fit_model import START_SPEED, START_STROKE, FitModel
from mckibben.identification.predict.specimens import SpecimenData, SpecimensPredictor
from mckibben.measurement.measurement import Measurement, build
from mckibben.physics.errors import InputError
from mckibben.simulation.drive.records import motion_of_record
from mckibben.simulation.statics.model import StaticModel
from tests.identification.predict.test_moving import drive, fit_model, measured
from tests.identification.synthetic import CATALOGUE, MUSCLE, force_map

NOISE = 5e-5
TIME = np.arange(0.0, 4.0, 0.01)
BEGIN = 7  # row at which the record of a swinging load begins
WEAK = {"viscous_damping": {"coefficient": 5.0}}


def swinging(count: int = 1) -> tuple[Measurement, float, float]:
    """A record that begins in the middle of a swing that hardly damps, the true stroke and speed there."""
    pressure = np.full(len(TIME), 3e5)

    def recorded(stroke: np.ndarray, rows: slice) -> Measurement:
        clock = np.tile(TIME[rows] - TIME[rows][0], count)
        columns = {
            "time": clock,
            "pressure": np.tile(pressure[rows], count),
            "displacement": np.tile(stroke[rows], count),
        }
        noise = np.random.default_rng(3).normal(0.0, NOISE, len(clock))
        columns["displacement"] = columns["displacement"] + noise
        return build(
            columns, name="made", id="0" * 64, kind="transient", conditions={"load_mass": 12.0},
            excluded_rows={},
        )  # fmt: skip

    plain = recorded(1e-7 * pressure, slice(None))
    of = replace(driven_by_pressure(plain, MUSCLE), model=StaticModel(MUSCLE, WEAK))
    run = motion_of_record(of, time=TIME, pressure=pressure, stroke=0.09)
    part = recorded(run["stroke_reading"], slice(BEGIN, None))
    return part, float(run["stroke"][BEGIN]), float(run["speed"][BEGIN])


def start_model() -> FitModel:
    return fit_model({"viscous_damping": {"coefficient": 20.0}})


def test_a_start_in_the_middle_of_a_swing_is_found_and_frees_the_constants_of_its_error() -> None:
    measurement, stroke, speed = swinging()
    predictor = predictor_of(measurement, MUSCLE)
    rows = measurement.rows
    resting = compared(predictor, start_model(), rows=rows, fit=True)
    freed = compared(predictor, start_model(), rows=rows, fit=True, geometry=predictor.free_starts())
    assert resting.rmse > 20.0 * NOISE
    assert freed.rmse == pytest.approx(NOISE, rel=0.1)
    assert freed.fit is not None
    found = {each.name: each for each in freed.fit.parameters}
    first = float(measurement.columns["displacement"][0])
    for name, truth in ((START_STROKE, stroke - first), (START_SPEED, speed)):
        assert found[name].stderr is not None
        assert abs(found[name].value - truth) < 4.0 * found[name].stderr
    damping = found["viscous_damping.coefficient"]
    assert damping.value == pytest.approx(5.0, abs=4.0 * (damping.stderr or 0.0))
    assert freed.parameters["geometry"][START_SPEED].unit == "m/s"


def test_without_a_fit_the_start_alone_is_found() -> None:
    """It belongs to the run, not to the model, whose values stay as they are."""
    measurement, stroke, speed = swinging()
    predictor = predictor_of(measurement, MUSCLE)
    shown = compared(
        predictor, fit_model(WEAK), rows=measurement.rows, geometry=predictor.free_starts()
    )  # with the true damping
    assert shown.rmse == pytest.approx(NOISE, rel=0.1)
    assert shown.fit_model.values == fit_model(WEAK).values
    assert not any("no fit was requested" in message for message in shown.messages)
    assert shown.fit is not None
    found = {each.name: each for each in shown.fit.parameters}
    first = float(measurement.columns["displacement"][0])
    for name, truth in ((START_STROKE, stroke - first), (START_SPEED, speed)):
        assert found[name].stderr is not None
        assert abs(found[name].value - truth) < 4.0 * found[name].stderr


def test_each_run_has_a_start_of_its_own() -> None:
    measurement, _, speed = swinging(count=2)
    predictor = predictor_of(measurement, MUSCLE)
    starts = predictor.free_starts()
    assert [free.name for free in starts] == [
        f"{name}_{run}" for run in (1, 2) for name in (START_STROKE, START_SPEED)
    ]
    model = fit_model(WEAK)
    moved = model.with_numbers([f"{START_SPEED}_2"], [speed])
    before, after = predictor.predict(model), predictor.predict(moved)
    half = len(before) // 2
    assert np.array_equal(before[:half], after[:half])
    assert np.max(np.abs(before[half:] - after[half:])) > 1e-3
    one, _, _ = swinging()
    parts = [SpecimenData(str(n), predictor_of(one, MUSCLE), MUSCLE) for n in range(2)]
    several = SpecimensPredictor(parts, reference=MUSCLE)
    assert [free.name for free in several.free_starts()] == [free.name for free in starts]
    change = np.abs(several.predict(moved) - several.predict(model))
    assert np.max(change[several.specimen == 0]) == 0.0
    assert np.max(change[several.specimen == 1]) > 1e-3


def test_without_a_speed_or_an_offset_a_run_is_as_before() -> None:
    predictor = predictor_of(swinging()[0], MUSCLE)
    model = fit_model(WEAK)
    zero = model.with_numbers([START_STROKE, START_SPEED], [0.0, 0.0])
    assert np.array_equal(predictor.predict(model), predictor.predict(zero))


def test_a_start_slides_against_dry_friction_in_either_direction() -> None:
    """Decelerated by friction on its way up and on its way down: it comes less far than without."""
    measurement, _, _ = swinging()
    predictor = predictor_of(measurement, MUSCLE)
    free = FitModel(MUSCLE)
    rubbing = free.adding(CATALOGUE["guide_friction"])
    for speed in (0.2, -0.2):
        far, short = (
            (found := predictor.predict(model.with_numbers([START_SPEED], [speed])))[3] - found[0]
            for model in (free, rubbing)
        )
        assert abs(short) > 0.0
        assert np.sign(far - short) == np.sign(speed)


def test_a_start_is_refused_where_there_is_none_to_be_free() -> None:
    for predictor in (
        predictor_of(measured(drive()), MUSCLE, drive({})),  # a command: at rest at its first pressure
        predictor_of(force_map(), MUSCLE),
    ):
        with pytest.raises(InputError, match="records of a stroke over time"):
            predictor.free_starts()
