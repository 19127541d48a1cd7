"""Frequency responses, poles, zeros, margins: against scipy, textbook figures and nonlinear runs."""

from __future__ import annotations

import warnings
from dataclasses import replace
from math import atan, degrees, sqrt

import numpy as np
import pytest
from numpy.typing import ArrayLike
from scipy import signal

from mckibben.simulation.command.pid import PidController
from mckibben.simulation.command.shapes import Step
from mckibben.simulation.linear.linearise import linearise
from mckibben.simulation.linear.loop import margins, sampled
from mckibben.simulation.linear.model import LinearModel
from mckibben.simulation.linear.nonlinear import controlled_from
from mckibben.simulation.linear.response import (
    bandwidth,
    frequencies_for,
    frequency_response,
    phase_of,
    poles_of,
    static_gain,
    zeros,
)
from tests.simulation.linear.drives import drive
from tests.simulation.linear.steps import closed_loop_step, step_response


def state_space(model: LinearModel, source: str, out: str) -> signal.StateSpace:
    a, b, c, d = model.channel(source, out)
    scale = model.scales[0]
    return signal.StateSpace(a * scale / scale[:, None], (b / scale)[:, None], (c * scale)[None], [[d]])


@pytest.mark.parametrize(("source", "out"), [("command", "position"), ("load_force", "pressure")])
def test_response_and_step_are_those_of_scipy(source: str, out: str) -> None:
    model = linearise(drive("regulator")).models[0]
    frequency = frequencies_for(model)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", signal.BadCoefficients)  # of its way over polynomials
        _, expected = signal.freqresp(state_space(model, source, out), 2.0 * np.pi * frequency)
    found = frequency_response(model, source, out, frequency)
    assert found == pytest.approx(expected, rel=1e-4, abs=1e-6 * abs(expected).max())
    time = np.linspace(0.0, 1.0, 101)
    _, shape = signal.step(state_space(model, source, out), T=time)
    assert step_response(model, source, out, time, 1.0) == pytest.approx(shape, abs=1e-6 * abs(shape).max())


def test_an_undamped_pole_takes_half_a_turn() -> None:
    model = linearise(drive("propneu-20")).primary
    frequency = frequencies_for(model)
    for axis in (frequency, frequency[::9]):
        response = frequency_response(model, "command", "position", axis)
        phase = phase_of(model, "command", "position", axis, response)
        assert np.exp(1j * phase) == pytest.approx(response / np.abs(response), abs=1e-9)
        # An integrator and an oscillation: -90 and then -270 degrees, and the dead time.
        late = 2.0 * np.pi * axis * model.dead_time
        assert np.degrees(phase + late)[[0, -1]] == pytest.approx([-90.0, -270.0], abs=1.0)
        assert (np.diff(phase + late) < 1e-6).all()


def test_each_integrator_has_taken_a_quarter_of_a_turn_however_high_the_axis_begins() -> None:
    """A muscle behind a valve: a quarter for the air, a half above its oscillation of 5.8 Hz."""
    model = linearise(drive("valve")).models[0]
    assert model.name == "filling"
    axis = np.geomspace(20.0, 80.0, 30)
    response = frequency_response(model, "command", "position", axis)
    phase = phase_of(model, "command", "position", axis, response)
    assert np.exp(1j * phase) == pytest.approx(response / abs(response), abs=1e-9)
    assert model.dead_time == 0.0
    assert degrees(phase[0]) == pytest.approx(-270.0, abs=10.0)
    assert (np.diff(phase) < 0.0).all()


def test_zeros_are_those_of_the_transfer_function() -> None:
    model = linearise(drive("regulator")).models[0]
    a, b, c, d = model.channel("load_force", "position")
    scale = model.scales[0]
    a, b, c = a * scale / scale[:, None], b / scale, c * scale
    # At a zero the response vanishes, and so it is no eigenvalue of A alone.
    size = max(abs(c @ np.linalg.solve(1j * w * np.eye(len(a)) - a, b) + d) for w in (1.0, 10.0))
    found = zeros(model, "load_force", "position")
    own = [zero for zero in found if abs(np.linalg.eigvals(a) - zero).min() > 1e-3]
    assert own
    for zero in own:
        response = c @ np.linalg.solve(zero * np.eye(len(a)) - a, b) + d
        assert abs(response) < 1e-6 * size


def test_the_supply_of_a_closed_valve_acts_on_nothing() -> None:
    """No pole shows, and the gain is 0: it was said to integrate, because the valve does."""
    model = linearise(drive("propneu-20")).primary
    poles, zeros_of = poles_of(model, "supply_pressure", "pressure")
    assert poles
    assert all(pole.cancelled for pole in poles)
    assert zeros_of == []
    assert static_gain(model, "supply_pressure", "pressure") == 0.0
    assert static_gain(model, "command", "pressure") is None


def test_poles_are_named() -> None:
    valve = linearise(drive("valve")).primary
    poles = poles_of(valve, "command", "position")[0]
    assert [pole.kind for pole in poles] == ["integrator", "real", "oscillation"]
    assert [pole.oscillation_frequency for pole in poles[:2]] == [None, None]
    swinging = poles[2]
    # f_d = f_0 sqrt(1 - z^2)
    damped = swinging.frequency * sqrt(1.0 - (swinging.damping or 0.0) ** 2)
    assert swinging.oscillation_frequency == pytest.approx(damped, rel=1e-9)
    assert bandwidth(valve, "command", "position")[0] is None
    assert static_gain(valve, "command", "position") is None
    regulated = linearise(drive("regulator")).primary
    width, why = bandwidth(regulated, "command", "position")
    assert why is None
    gain = static_gain(regulated, "command", "position")
    at = frequency_response(regulated, "command", "position", np.array([width]))
    assert abs(at[0]) == pytest.approx(gain / sqrt(2.0), rel=1e-2)


def of_polynomials(model: LinearModel, above: ArrayLike, below: ArrayLike) -> LinearModel:
    """The plant above/below of polynomials of s, highest power first, in place of the position reading."""
    above, below = np.asarray(above, float), np.asarray(below, float)
    size = len(below) - 1
    states = model.states[:size]
    scale = replace(model, states=states).scales[0]
    a = np.diag(np.ones(size - 1), 1)
    a[-1] = -below[:0:-1] / below[0]
    b = np.zeros((size, len(model.inputs)))
    b[-1, 0] = 1.0 / below[0]
    c = np.zeros((len(model.outputs), size))
    reading = [port.name for port in model.outputs].index("position_reading")
    c[reading, : len(above)] = above[::-1]
    return replace(
        model, states=states, a=a * scale[:, None] / scale, b=b * scale[:, None], c=c / scale,
        d=np.zeros((len(c), b.shape[1])), dead_time=0.0,
    )  # fmt: skip


def test_margins_are_those_of_the_textbook() -> None:
    # 1/(s (s + 1) (s + 2))
    model = of_polynomials(linearise(drive("valve")).primary, [1.0], [1.0, 3.0, 2.0, 0.0])
    controller = PidController(kp=1.0, sample_time=1e-4)
    found = margins(model, controller, np.geomspace(0.01, 10.0, 50))
    assert found.stable
    # Phase -180 degrees at sqrt(2) rad/s, where the gain is 1/6.
    assert found.gain_margin == pytest.approx(6.0, rel=1e-3)
    assert found.gain_margin_at == pytest.approx(sqrt(2.0) / (2.0 * np.pi), rel=5e-3)
    crossover = 0.446_5  # root of w^2 (w^2 + 1) (w^2 + 4) = 1
    assert crossover**2 * (crossover**2 + 1.0) * (crossover**2 + 4.0) == pytest.approx(1.0, rel=5e-3)
    expected = 90.0 - degrees(atan(crossover)) - degrees(atan(0.5 * crossover))
    assert degrees(found.phase_margin or 0.0) == pytest.approx(expected, abs=0.3)
    assert not margins(model, replace(controller, kp=6.1), np.geomspace(0.01, 10.0, 50)).stable
    assert margins(model, replace(controller, kp=5.9), np.geomspace(0.01, 10.0, 50)).stable


def test_the_delay_margin_is_that_of_the_first_instability() -> None:
    """1/(s (s + 1)) beside a resonance at 20 rad/s, where the loop is the first to become unstable.

    The crossing with the least angle, 52 degrees, is another one, and has a second of time.
    """
    plant = np.polymul([1.0, 1.0, 0.0], [1.0, 0.8, 400.0])
    above = np.polyadd([1.0, 0.8, 400.0], np.polymul([1.6, 0.0], [1.0, 1.0, 0.0]))
    model = of_polynomials(linearise(drive("regulator")).primary, above, plant)
    controller = PidController(kp=1.0, sample_time=1e-4)
    axis = np.geomspace(0.01, 10.0, 50)
    found = margins(model, controller, axis)
    # |G| = 1 at the roots of |above|^2 - |plant|^2, polynomials of the square of the frequency.
    square = [np.polymul(each, each * (-1.0) ** np.arange(len(each))[::-1]) for each in (above, plant)]
    roots = np.roots(np.polysub(*square))
    at = np.sort([abs(root.imag) for root in roots if abs(root.real) < 1e-6 and root.imag > 0.0])
    loop = np.polyval(above, 1j * at) / np.polyval(plant, 1j * at)
    assert np.abs(loop) == pytest.approx(np.ones(3))
    angles = np.angle(-loop)
    times = (angles % (2.0 * np.pi)) / at
    assert int(np.argmin(np.abs(angles))) == 0
    assert found.crossover == pytest.approx(at[0] / (2.0 * np.pi), rel=1e-2)
    assert times.min() < 0.2 * times[0]
    assert found.delay_margin == pytest.approx(times.min(), rel=2e-2)
    for factor, stable in ((0.95, True), (1.05, False)):
        assert margins(replace(model, dead_time=factor * times.min()), controller, axis).stable is stable


@pytest.mark.parametrize("delay", [0.0, 0.004, 0.0043, 0.0007])
def test_the_sampled_plant_is_the_plant_at_its_samples(delay: float) -> None:
    model = replace(linearise(drive("regulator")).primary, dead_time=delay)
    phi, gamma, c, d = sampled(model, 0.002, "command", "position")
    state, rows = np.zeros(len(phi)), []
    for _ in range(150):
        rows.append(c @ state + d)
        state = phi @ state + gamma
    expected = step_response(model, "command", "position", 0.002 * np.arange(150), 1.0)
    assert np.array(rows) == pytest.approx(expected, abs=1e-9 * expected.max())


def test_the_closed_loop_is_that_of_the_nonlinear_run() -> None:
    given = drive("regulator")
    linear = linearise(given)
    controller = PidController(kp=2.0, ki=25.0, kd=0.1, sample_time=0.002, output_min=0.0)
    size, samples = 1e-4, 400
    grid = 0.002 * np.arange(samples + 1)
    start = linear.point.position
    run = controlled_from(
        linear.point, given, controller, Step(at=0.0, level=start + size, initial=start), grid=grid,
        tolerance=1e-8,
    )  # fmt: skip
    expected = closed_loop_step(linear.primary, controller, size, samples + 1)
    assert expected[-1] == pytest.approx(size, rel=0.1)
    moved = run.states["stroke"] / given.load.lever_ratio - start
    assert moved == pytest.approx(expected, abs=0.02 * size)
