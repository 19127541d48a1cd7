"""Windows: how long they are, what a perfect model has in them, and what builds up only in the whole run."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mckibben.identification.predict import driven_by_pressure, predictor_of
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.windows import WindowErrors, window_errors
from mckibben.measurement.measurement import Measurement, build
from mckibben.simulation.command.signals import signal_from
from mckibben.simulation.drive.records import motion_of_record
from mckibben.simulation.statics.model import StaticModel
from tests.identification.predict.test_moving import HIDDEN, drive, fit_model, measured
from tests.identification.synthetic import MUSCLE

NOISE = 5e-5
PERIOD = 0.8
TIME = np.arange(0.0, 8.0, 0.01)
SINE = 3e5 + 1.5e5 * np.sin(2.0 * np.pi * TIME / PERIOD)
#: Trapped at a pressure: filled, then closed.
TRAPPED = {"shape": "pulse", "on": "0.2 s", "off": "0.6 s", "level": 1.0, "initial": 0.0}


def recorded(time: np.ndarray, pressure: np.ndarray, stroke: np.ndarray) -> Measurement:
    columns = {"time": time, "pressure": pressure, "displacement": stroke}
    conditions = {"load_mass": 12.0}
    return build(columns, name="made", id="0" * 64, kind="transient", conditions=conditions, excluded_rows={})


def moved(effects, pressure: np.ndarray = SINE, stroke: float = 0.05) -> np.ndarray:
    """The stroke of a load under a pressure, with noise."""
    plain = recorded(TIME, pressure, 1e-7 * pressure)
    of = replace(driven_by_pressure(plain, MUSCLE), model=StaticModel(MUSCLE, effects))
    run = motion_of_record(of, time=TIME, pressure=pressure, stroke=stroke)
    return run["stroke_reading"] + np.random.default_rng(3).normal(0.0, NOISE, len(TIME))


def errors(measurement: Measurement, model: FitModel, *, of=None, noise: float | None = None) -> WindowErrors:
    found = window_errors(predictor_of(measurement, MUSCLE, of), model, noise)
    assert isinstance(found, WindowErrors), found
    return found


def test_a_window_is_a_period_of_the_motion_and_a_true_model_reaches_what_a_perfect_one_does():
    found = errors(recorded(TIME, SINE, moved(HIDDEN)), fit_model(HIDDEN), noise=NOISE)
    assert found.length == pytest.approx(PERIOD, rel=0.1)
    assert found.count == int(TIME[-1] / found.length)
    assert found.of_run == pytest.approx(NOISE, rel=0.06)  # 800 rows: 2.5 % standard error
    assert found.noise == pytest.approx(NOISE, rel=0.06)
    assert found.rmse == pytest.approx(found.perfect, rel=0.15)
    assert NOISE < found.perfect < 1.3 * NOISE  # the start adds its own error, which the drive forgets


def test_an_error_of_shape_is_in_every_window():
    weak = {**HIDDEN, "viscous_damping": {"coefficient": 400.0}}
    found = errors(recorded(TIME, SINE, moved(weak)), fit_model(HIDDEN), noise=NOISE)
    assert found.of_run > 20.0 * NOISE
    assert found.rmse == pytest.approx(found.of_run, rel=0.1)


def test_a_start_that_is_off_is_in_the_run_alone_where_nothing_damps():
    still = np.full(len(TIME), 3e5)
    stroke = moved({}, still, stroke=0.09)
    begin = 7  # somewhere in the swing, where the load is not at rest, as a run takes it to be
    part = recorded(TIME[begin:] - TIME[begin], still[begin:], stroke[begin:])
    found = errors(part, fit_model({}), noise=NOISE)
    assert found.of_run > 30.0 * NOISE
    assert found.rmse < 0.1 * found.of_run
    assert found.rmse < 2.0 * found.perfect


def test_what_leaks_builds_up_over_the_run_and_not_over_windows():
    """An error that grows as a·t has the mean square a²T²/3 of a run, and a²(T/4)²/3 of its quarters."""
    leaking = {**HIDDEN, "leak": {"conductance": 2e-11, "critical_ratio": 0.3, "laminar_share": 0.0}}
    held = drive(leaking, command=signal_from(TRAPPED, unit="1", field="command"))
    of = replace(held, model=StaticModel(MUSCLE))
    found = errors(measured(held), fit_model(HIDDEN), of=of)
    assert found.count == 4
    assert found.rmse / found.of_run == pytest.approx(0.25, abs=0.07)
    true = errors(measured(held), fit_model(leaking), of=of)
    assert true.of_run < 1e-2 * found.of_run


@pytest.mark.parametrize("effects", [HIDDEN, {**HIDDEN, "coulomb_friction": {"force": 20.0}}])
def test_windows_of_a_commanded_drive_begin_at_the_measured_pressure(effects):
    noise = {"pressure": 300.0, "displacement": NOISE}
    found = errors(measured(drive(effects), noise=noise), fit_model(effects), of=drive({}))
    assert found.of_run == pytest.approx(1.0, rel=0.1)  # times the noise of each channel
    assert found.rmse == pytest.approx(found.perfect, rel=0.15)
    assert found.perfect < 1.2


def test_without_something_to_begin_from_there_are_no_windows():
    unread = measured(drive(), keep=("displacement",))
    assert "no pressure" in str(window_errors(predictor_of(unread, MUSCLE, drive({})), fit_model(HIDDEN)))
    unseen = measured(drive(), keep=("pressure",))
    assert "no stroke" in str(window_errors(predictor_of(unseen, MUSCLE, drive({})), fit_model(HIDDEN)))
    short = recorded(TIME[:30], SINE[:30], 1e-7 * SINE[:30])
    assert "too short" in str(window_errors(predictor_of(short, MUSCLE), fit_model(HIDDEN)))


def test_the_same_question_gives_the_same_digits():
    measurement = recorded(TIME, SINE, moved(HIDDEN))
    assert errors(measurement, fit_model(HIDDEN)) == errors(measurement, fit_model(HIDDEN))
