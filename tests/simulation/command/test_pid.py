"""PID: closed forms, an independent discrete simulation, limits, anti-windup, documents."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numba import njit
from scipy import signal

from mckibben.physics.errors import InputError
from mckibben.simulation.command.pid import (
    PidController,
    PidState,
    controller_from,
    pid_step,
)

WIDE = {"output_min": -1e9, "output_max": 1e9}


def first_order(controller: PidController, *, gain: float, tau: float, reference: float, duration: float):
    """Position of gain/(tau s + 1) under the controller: exact between samples of a held command."""
    h = controller.sample_time
    decay = np.exp(-h / tau)
    y, state, out = 0.0, controller.start(measurement=0.0), []
    for _ in range(round(duration / h)):
        out.append(y)
        command, state = controller.step(reference, y, state)
        y = decay * y + (1.0 - decay) * gain * command
    return h * np.arange(len(out)), np.array(out)


def test_proportional_loop_on_a_first_order_plant():
    controller = PidController(kp=4.0, sample_time=1e-5, **WIDE)
    t, y = first_order(controller, gain=1.0, tau=0.1, reference=1.0, duration=0.2)
    assert y == pytest.approx(0.8 * (1.0 - np.exp(-5.0 * t / 0.1)), abs=2e-4)


def test_pi_loop_that_cancels_the_pole():
    # ki = kp / tau leaves kp/(tau s): closed loop 1 - exp(-kp t / tau).
    controller = PidController(kp=2.0, ki=20.0, sample_time=1e-5, **WIDE)
    t, y = first_order(controller, gain=1.0, tau=0.1, reference=0.5, duration=0.3)
    assert y == pytest.approx(0.5 * (1.0 - np.exp(-2.0 * t / 0.1)), abs=2e-4)


def test_the_gains_of_the_example_document_are_critically_damped_at_one_metre_per_second():
    controller = controller_from({"type": "pid", "kp": 2.0, "ki": 10.0, "sample_time": 1e-4})
    h, y, v = controller.sample_time, 0.0, []
    state = controller.start(measurement=0.0)
    for _ in range(10_000):
        v.append(y)
        command, state = controller.step(0.02, y, state)
        y += h * command
    t = h * np.arange(len(v))
    # s^2 + 20 s + 100 with the zero of the PI: 1 - (1 - 10 t) exp(-10 t)
    assert np.array(v) == pytest.approx(0.02 * (1.0 - (1.0 - 10.0 * t) * np.exp(-10.0 * t)), abs=5e-5)


@pytest.mark.parametrize("filter_time", [0.0, 0.004])
def test_against_scipy_discrete_simulation(filter_time):
    kp, ki, kd, h, ff = 3.0, 7.0, 0.2, 0.001, 0.5
    controller = PidController(
        kp=kp, ki=ki, kd=kd, derivative_filter=filter_time, sample_time=h, feed_forward=ff, **WIDE
    )
    generator = np.random.default_rng(3)
    reference, measured = generator.normal(size=(2, 400))
    measured[0] = 0.0
    state, commands = controller.start(measurement=0.0), []
    for r, y in zip(reference, measured, strict=True):
        command, state = controller.step(r, y, state)
        commands.append(command)
    error = reference - measured
    integral = signal.dlsim(signal.dlti([ki * h, 0.0], [1.0, -1.0], dt=h), error)[1].ravel()
    derivative = signal.dlti([kd, -kd], [filter_time + h, -filter_time], dt=h)
    rate = signal.dlsim(derivative, measured)[1].ravel()
    assert commands == pytest.approx(kp * error + integral - rate + ff * reference, abs=1e-9)


def test_derivative_acts_on_the_measurement_only():
    controller = PidController(kp=0.0, kd=1.0, sample_time=0.001, **WIDE)
    state = controller.start(measurement=0.2)
    command, state = controller.step(5.0, 0.2, state)
    assert command == 0.0
    command, _ = controller.step(5.0, 0.201, state)
    assert command == pytest.approx(-0.001 / (0.005 + 0.001))


def test_no_windup_behind_a_limit():
    limited = PidController(kp=1.0, ki=10.0, sample_time=0.001, output_min=-1.0, output_max=1.0)
    state = limited.start(measurement=0.0)
    for _ in range(5000):  # 5 s against the limit: an unprotected integral would be 500
        command, state = limited.step(10.0, 0.0, state)
        assert command == 1.0
    assert abs(state.integral) <= 1.0
    command, _ = limited.step(-0.5, 0.0, state)
    assert command < 0.0, "leaves the limit with the first sample of the other sign"


def test_windup_protection_shortens_the_overshoot():
    options = {"gain": 1.0, "tau": 0.2, "reference": 0.9, "duration": 4.0}
    limits = {"output_min": 0.0, "output_max": 1.0}
    _, y = first_order(PidController(kp=5.0, ki=25.0, sample_time=0.001, **limits), **options)
    assert y.max() < 0.9 * 1.02
    assert y[-1] == pytest.approx(0.9, abs=1e-4)


@given(
    st.lists(st.tuples(st.floats(-1e3, 1e3), st.floats(-1e3, 1e3)), min_size=1, max_size=30),
    st.floats(0.0, 1e4),
    st.floats(0.0, 1e4),
    st.floats(0.0, 10.0),
)
def test_command_stays_within_its_limits(samples, kp, ki, kd):
    controller = PidController(kp=kp + 1e-6, ki=ki, kd=kd, output_min=-0.3, output_max=0.7)
    state = controller.start(measurement=0.0)
    for reference, measured in samples:
        command, state = controller.step(reference, measured, state)
        assert -0.3 <= command <= 0.7
        assert np.isfinite(state).all()


def test_takes_over_without_a_bump():
    controller = PidController(kp=20.0, ki=100.0, kd=0.1, feed_forward=2.0, sample_time=0.001)
    state = controller.start(measurement=0.05, reference=0.06, command=0.37)
    command, _ = controller.step(0.06, 0.05, state)
    assert command == pytest.approx(0.37 + 100.0 * 0.001 * 0.01)


def test_changing_ki_does_not_move_the_command():
    before = PidController(kp=1.0, ki=5.0, sample_time=0.001)
    state = before.start(measurement=0.0)
    for _ in range(50):
        command, state = before.step(0.1, 0.0, state)
    after, _ = PidController(kp=1.0, ki=50.0, sample_time=0.001).step(0.1, 0.0, state)
    assert after == pytest.approx(command, abs=50.0 * 0.001 * 0.1 + 1e-12)


def test_compiled_step_is_the_python_step():
    compiled = njit(pid_step, error_model="numpy")
    controller = PidController(kp=3.0, ki=9.0, kd=0.1)
    generator = np.random.default_rng(5)
    plain = quick = (0.0, 0.0)
    last = 0.0
    for reference, measured in generator.normal(scale=0.2, size=(200, 2)):
        a = pid_step(reference, measured, *plain, last, *controller.constants)
        b = compiled(reference, measured, *quick, last, *controller.constants)
        assert b == pytest.approx(a, rel=1e-12, abs=1e-15)
        plain, quick, last = a[1:], b[1:], measured


def test_numba_is_not_loaded_before_it_is_needed():
    code = (
        "import sys; from mckibben.simulation.command.pid import PidController, PidState\n"
        "PidController(kp=1.0).step(1.0, 0.0, PidState(0.0, 0.0, 0.0)); sys.exit('numba' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_gains_of_a_document_are_percent_per_millimetre_or_have_units():
    plain = controller_from({"type": "pid", "kp": 2.0, "ki": 10.0, "kd": 0.01, "reference": {}})
    units = controller_from({"kp": "2 %/mm", "ki": "10 %/(mm*s)", "kd": "0.01 %*s/mm"})
    si = controller_from({"kp": "20 1/m", "ki": "100 1/(m*s)", "kd": "0.1 s/m"})
    assert (plain.kp, plain.ki, plain.kd) == pytest.approx((20.0, 100.0, 0.1))
    for other in (units, si):
        assert (other.kp, other.ki, other.kd) == pytest.approx((20.0, 100.0, 0.1))
    assert plain.output_min == -1.0
    assert controller_from({"kp": 1}, output_min=0.0).output_min == 0.0


@pytest.mark.parametrize(
    ("document", "field"),
    [
        ({"type": "lqr", "kp": 1}, "controller.type"),
        ({"type": "pid"}, "controller.kp"),
        ({"kp": -1}, "controller.kp"),
        ({"kp": 0}, "controller.kp"),
        ({"kp": "2 mm"}, "controller.kp"),
        ({"kp": 1, "kii": 2}, "controller.kii"),
        ({"kp": 1, "ki": float("nan")}, "controller.ki"),
        ({"kp": 1, "sample_time": 0}, "controller.sample_time"),
        ({"kp": 1, "sample_time": "1 h"}, "controller.sample_time"),
        ({"kp": 1, "derivative_filter": -1}, "controller.derivative_filter"),
        ({"kp": 1, "output_min": 1, "output_max": 1}, "controller.output_max"),
        ([], "controller"),
    ],
)
def test_impossible_controllers_are_refused(document, field):
    with pytest.raises(InputError) as caught:
        controller_from(document)
    assert caught.value.field == field


def test_state_is_plain_numbers():
    assert PidController(kp=1.0).start(measurement=0.1) == PidState(0.0, 0.0, 0.1)
