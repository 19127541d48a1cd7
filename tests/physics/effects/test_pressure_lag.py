"""The lag between sensor and muscle against the closed form of a linear lag and of a choked filling."""

import numpy as np
import pytest

from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.muscle import Muscle
from mckibben.simulation.drive.records import states_of_record
from mckibben.simulation.statics.model import StaticModel

LAG = default_catalogue()["pressure_lag"]
MUSCLE = Muscle(nominal_length=0.3, braid_diameter=0.02, braid_angle=np.radians(25.0))


def behind(clock, pressure, *, length=0.3, **values):
    """The state along a record at a held length [Pa]."""
    start = {p.name: p.default for p in LAG.parameters}
    model = StaticModel.of(MUSCLE, (LAG,), {LAG.id: start | values})
    states = states_of_record(model, time=clock, pressure=pressure, length=np.full(len(clock), length))
    return states["pressure_lag.behind"]


def test_a_small_ramp_through_a_capillary_is_behind_by_the_time_constant():
    """A ramp of 1 kPa/s at 3 bar: d = tau dP/dt in the end, and exp(-t/tau) before."""
    time = np.linspace(0.0, 1.0, 201)
    d = behind(time, 3e5 + 1e3 * time, time=0.1)
    assert d == pytest.approx(100.0 * (1.0 - np.exp(-time / 0.1)), abs=0.02 * 100.0)


def test_a_choked_orifice_fills_at_a_constant_rate():
    """Below r = b the flow does not know the muscle's pressure: d falls along a line."""
    time = np.concatenate([[0.0, 1e-4], np.linspace(2e-4, 0.05, 60)])
    pressure = np.where(time > 0.0, 8e5, 0.0)
    d = behind(time, pressure, time=0.02, index=0.5, critical_ratio=0.3)
    choked = d > 0.75 * 9.013e5
    slope = np.diff(d[choked][2:]) / np.diff(time[choked][2:])
    r = 401.325 / 411.325
    flow = 901.325e3 / (411.325e3 * np.sqrt(1.0 - ((r - 0.3) / 0.7) ** 2))
    assert slope == pytest.approx(np.full(len(slope), -1e4 / 0.02 * flow), rel=1e-3)


def test_a_laminar_tube_fills_along_a_hyperbolic_tangent():
    """dp/dt = K (p_u^2 - p^2) has the solution p_u tanh(K p_u t + artanh(p_0/p_u))."""
    time = np.concatenate([[0.0, 1e-5], np.linspace(1e-3, 0.1, 100)])
    pressure = np.where(time > 0.0, 5e5, 0.0)
    d = behind(time, pressure, time=0.02, index=1.0, critical_ratio=0.0, laminar=1.0)
    upstream, first, usual = 601_325.0, 101_325.0, 411_325.0
    k = 1e4 / 0.02 / (usual**2 - 401_325.0**2)
    filled = upstream * np.tanh(k * upstream * time + np.arctanh(first / upstream))
    assert filled[-1] > 0.95 * upstream
    assert upstream - d[1:] == pytest.approx(filled[1:], rel=2e-3)


def test_a_shorter_muscle_holds_more_and_follows_later():
    """Ramp through a capillary: the lag goes with V = L (b^2 - L^2)."""
    time = np.linspace(0.0, 3.0, 301)
    full, short = (behind(time, 3e5 + 1e3 * time, length=x, time=0.1)[-1] for x in (0.3, 0.24))
    thread = 0.3 / np.cos(np.radians(25.0))
    ratio = 0.24 * (thread**2 - 0.24**2) / (0.3 * (thread**2 - 0.3**2))
    assert short / full == pytest.approx(ratio, rel=5e-3)


def test_a_slow_sensor_is_undone():
    """What a lag of 20 ms shows of a slow sine is the sine again, to the second order in omega tau."""
    time = np.linspace(0.0, 4.0, 2001)
    omega = 2.0 * np.pi
    true = 3e5 + 1e5 * np.sin(omega * time)
    gain = 1.0 / (1.0 + 1j * omega * 0.02)
    shown = 3e5 + 1e5 * np.imag(gain * np.exp(1j * omega * time))
    d = behind(time, shown, time=-0.02)
    inside = LAG.call("pressure", {"pressure": shown, "behind": d, "muscle": MUSCLE}, {"time": -0.02})
    late = time > 0.5
    assert np.max(np.abs(shown - true)[late]) > 1.2e4
    assert np.max(np.abs(inside - true)[late]) < 500.0
