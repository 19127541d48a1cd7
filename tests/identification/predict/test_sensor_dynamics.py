"""Late channels: a filter by closed forms, equal to the integrated record."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.identification.predict.comparable_rows import comparable_rows
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.sensor_dynamics import as_read, late
from mckibben.simulation.drive.records import force_of_record
from mckibben.simulation.statics.model import StaticModel
from tests.identification.synthetic import CATALOGUE, MUSCLE, cycles

TAU = 0.2


def fit_model(**values: dict[str, float]) -> FitModel:
    chosen = tuple(CATALOGUE[name] for name in values)
    return FitModel(MUSCLE, chosen, {e.id: e.defaults | values[e.id] for e in chosen})


def jittered(rows: int) -> np.ndarray:
    return np.cumsum(np.random.default_rng(3).uniform(0.005, 0.04, rows))


def test_a_ramp_is_shown_late_by_the_time_constant():
    """y = t - tau (1 - exp(-t/tau)) for r = t from rest."""
    time = jittered(400)
    time -= time[0]
    shown = as_read(
        fit_model(sensor_lag={"force_time": TAU}), time=time, records=[np.arange(400)], values=3.0 * time
    )
    assert shown == pytest.approx(3.0 * (time - TAU * (1.0 - np.exp(-time / TAU))), abs=1e-12)


def test_two_equal_stages_show_a_ramp_critically_damped():
    """y = t - 2 tau + (t + 2 tau) exp(-t/tau) for r = t behind 1/(1 + tau p)^2."""
    time = jittered(400)
    time -= time[0]
    model = fit_model(sensor_lag={"force_time": TAU, "second_share": 1.0})
    shown = as_read(model, time=time, records=[np.arange(400)], values=3.0 * time)
    expected = 3.0 * (time - 2.0 * TAU + (time + 2.0 * TAU) * np.exp(-time / TAU))
    assert shown == pytest.approx(expected, abs=1e-5)


def test_two_stages_rise_as_the_sum_of_two_lags():
    """Step response 1 - (T e^(-t/T) - S e^(-t/S)) / (T - S)."""
    time = np.concatenate([[0.0, 1e-6], np.linspace(0.01, 2.0, 300)])
    signal = np.where(time > 0.0, 1.0, 0.0)
    model = fit_model(sensor_lag={"force_time": TAU, "second_share": 0.3})
    shown = as_read(model, time=time, records=[np.arange(len(time))], values=signal)
    short = 0.3 * TAU
    rest = (TAU * np.exp(-time / TAU) - short * np.exp(-time / short)) / (TAU - short)
    assert shown[2:] == pytest.approx(1.0 - rest[2:], abs=1e-5)


def test_every_record_starts_at_rest_and_columns_go_through_alike():
    time = np.concatenate([jittered(50), jittered(60)])
    records = [np.arange(50), np.arange(50, 110)]
    signal = np.column_stack([slope * np.maximum(time - 0.3, 0.0) for slope in (1.0, -2.0, 5.0)])
    model = fit_model(sensor_lag={"force_time": 0.05}, time_skew={"delay": 0.01})
    shown = as_read(model, time=time, records=records, values=signal)
    assert shown[[0, 50]] == pytest.approx(signal[[0, 50]])
    for column in range(3):
        alone = as_read(model, time=time, records=records, values=signal[:, column])
        assert shown[:, column] == pytest.approx(alone, abs=1e-12)


def test_a_lag_does_not_average_the_noise_of_the_inputs():
    """A ramp 3 t with a step of 2 and noise of 0.02 from its pressure: its closed form, and all the noise."""
    time = np.linspace(0.0, 4.0, 801)
    noise = 0.02 * np.random.default_rng(5).standard_normal(801)
    signal = 3.0 * time + np.where(time >= 2.0, 2.0, 0.0)
    model = fit_model(sensor_lag={"force_time": TAU})
    shown = as_read(model, time=time, records=[np.arange(801)], values=signal + noise)
    clean = as_read(model, time=time, records=[np.arange(801)], values=signal)
    ramp = 3.0 * (time - TAU * (1.0 - np.exp(-time / TAU)))
    assert clean[:400] == pytest.approx(ramp[:400], abs=1e-12)
    assert np.std(shown - clean - noise) < 0.3 * 0.02
    # The lag itself would leave the root of dt/(2 tau) of it, 11 %.
    assert np.std(shown - clean) > 0.85 * 0.02


def test_without_a_time_constant_nothing_is_late():
    time, signal = jittered(50), np.arange(50.0)
    model = fit_model(sensor_lag={"force_time": 0.0}, bladder_elasticity={})
    assert as_read(model, time=time, records=[np.arange(50)], values=signal) == pytest.approx(signal)
    assert [effect.id for effect in model.effects if late(effect)] == ["sensor_lag"]


def test_it_is_what_the_integrated_record_shows():
    task = comparable_rows(cycles(each=200), MUSCLE)
    assert task.time is not None
    model = fit_model(sensor_lag={"force_time": TAU}, bladder_elasticity={})
    compiled = StaticModel.of(MUSCLE, model.effects, model.values)
    state = {"time": task.time, "pressure": task.state["pressure"], "length": task.state["length"]}
    expected = force_of_record(compiled, **state)
    prompt = StaticModel.of(MUSCLE, model.effects[1:], model.values)
    at_once = force_of_record(prompt, **state)
    shown = as_read(model, time=task.time, records=[np.arange(len(at_once))], values=at_once)
    apart = np.max(np.abs(at_once - expected))
    # Between rows the force is a line here and follows the model there.
    assert np.max(np.abs(shown - expected)) < 0.01 * apart
