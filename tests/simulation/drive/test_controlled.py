"""The controlled loop in the kernel is the loop in Python, and can be left early."""

from __future__ import annotations

from dataclasses import replace
from math import radians

import numpy as np
import pytest

from mckibben.documents.drive_reading import drive_of, preset_document
from mckibben.physics.muscle import Muscle
from mckibben.simulation.command.pid import PidController
from mckibben.simulation.command.pwm import PulseWidth
from mckibben.simulation.command.signals import Signal, signal_from
from mckibben.simulation.drive import controlled
from mckibben.simulation.drive.controlled import simulate_controlled
from mckibben.simulation.drive.parts import Drive, Load, Regulator, StiffnessControl, Tube, Valve
from mckibben.simulation.drive.transient import Run
from mckibben.simulation.outcome import Outcome, Watch
from mckibben.simulation.statics.model import StaticModel
from tests.shipped import shipped_studio
from tests.simulation.drive.sampled import run_in_python

STUDIO = shipped_studio()
MUSCLE = Muscle(0.3, 0.0218, radians(25.5), 0.0018, 0.02)


def shape(unit: str = "1", **parts) -> Signal:
    return signal_from(parts, unit=unit, field="reference", rest=0.0)


def drive(**changes) -> Drive:
    effects = {"bladder_elasticity": {}, "prestress": {}, "viscous_damping": {"coefficient": 80.0}}
    parts = {
        "model": StaticModel(MUSCLE, effects),
        "valve": Valve(1e-8, 1e-8),
        "load": Load(mass=10.0),
        "command": shape(shape="step", at="0 s", level=0.0),
        "duration": 0.8,
        "supply_pressure": 6e5,
        "controller": PidController(kp=20.0, ki=40.0, kd=0.2, sample_time=2e-3),
        "reference": shape("m", shape="square", period="0.5 s", level=0.03, initial=0.01),
    }
    return Drive(**{**parts, **changes})


def delayed(opening: float, closing: float) -> StaticModel:
    times = {"opening_time": opening, "closing_time": closing}
    return StaticModel(MUSCLE, {"viscous_damping": {"coefficient": 80.0}, "valve_delay": times})


PUSHES = shape("N", shape="triangle", amplitude="30 N", period="0.0777 s")
PAIR = {
    "pair": True, "precontraction": 0.1, "load": Load(mass=2.0), "min_contraction": 0.0,
    "max_contraction": 0.2, "reference": shape("m", shape="sine", amplitude="5 mm", frequency="2 Hz"),
}  # fmt: skip
STIFF = StiffnessControl(
    kp=0.2, ki=2.0, reference=shape("N*m/rad", shape="step", at="0.3 s", initial=15.0, level=20.0)
)
CASES = {
    "valve": drive(),
    "regulator": drive(
        regulator=Regulator(6e5, 0.02),
        controller=PidController(kp=5.0, ki=40.0, output_min=0.0, sample_time=2e-3),
    ),
    "dead times longer than a sample": drive(model=delayed(0.0071, 0.0112)),
    "closing overtakes opening": drive(model=delayed(0.0112, 0.0031)),
    "dead times of whole samples": drive(model=delayed(0.004, 0.002)),
    "external force and tube": drive(load=Load(mass=10.0, force=PUSHES), tube=Tube(0.004, 0.5)),
    "lever": drive(load=Load(mass=10.0, lever_ratio=0.5)),
    "last sample cut": drive(duration=0.1234),
    "pair": drive(**PAIR),
    "pulses of a carrier slower than the samples": drive(pwm=PulseWidth(97.0, min_on=1e-3), duration=0.4),
    "one valve and a carrier faster than the samples": drive(pwm=PulseWidth(1310.0, "one"), duration=0.1),
    "pulses of a pair with dead times": drive(
        **PAIR, pwm=PulseWidth(97.0), model=delayed(0.0071, 0.0112), duration=0.4
    ),
    "stiffness of a joint by valves": drive(**PAIR, pulley_radius=0.03, stiffness=STIFF),
    "stiffness of a joint by regulators": drive(
        **PAIR, pulley_radius=0.03, stiffness=STIFF, regulator=Regulator(6e5, 0.02),
        controller=PidController(kp=2.0, ki=10.0, output_min=-0.5, output_max=0.5, sample_time=2e-3),
    ),
}  # fmt: skip


def both(case: Drive, monkeypatch: pytest.MonkeyPatch, **options) -> tuple[Run, Run]:
    quick = simulate_controlled(case, **options)
    monkeypatch.setattr(controlled, "run_loop", run_in_python)
    return quick, simulate_controlled(case, **options)


def assert_same(quick: Run, slow: Run) -> None:
    assert quick.outcome is slow.outcome is Outcome.COMPLETED
    assert quick.steps == slow.steps
    for name, values in (slow.states | slow.outputs).items():
        found = (quick.states | quick.outputs)[name]
        # The laws of the joint are written in another order there.
        close = 1e-8 if slow.drive.stiffness else 1e-12
        assert found == pytest.approx(values, rel=close, abs=close * np.max(np.abs(values))), name
    assert quick.command.times == pytest.approx(slow.command.times, abs=0.0)
    assert quick.command.start_values == pytest.approx(slow.command.start_values, rel=close, abs=1e-3 * close)
    if quick.counter_command is not None and slow.counter_command is not None:
        other = slow.counter_command.start_values
        assert quick.counter_command.start_values == pytest.approx(other, rel=close, abs=1e-3 * close)


@pytest.mark.parametrize("name", CASES)
def test_the_kernel_does_what_the_loop_in_python_does(name, monkeypatch):
    quick, slow = both(CASES[name], monkeypatch, points=333)
    assert np.ptp(quick.states["stroke"]) > 1e-3
    assert len(quick.time) == 333
    assert_same(quick, slow)


def test_rows_at_any_time(monkeypatch):
    random = np.random.default_rng(4)
    grid = np.sort(np.r_[random.uniform(0.1, 0.7, 40), 0.2, 0.204, 0.7])
    quick, slow = both(CASES["valve"], monkeypatch, grid=grid)
    assert quick.time == pytest.approx(grid, abs=0.0)
    assert_same(quick, slow)


def test_a_scenario_of_the_paper(monkeypatch):
    case = drive_of(preset_document("paper-pid-pulse", STUDIO), STUDIO).drive
    quick, slow = both(replace(case, duration=1.5), monkeypatch, points=301)
    assert_same(quick, slow)


def test_it_goes_on_from_one_call_of_the_kernel_to_the_next(monkeypatch):
    whole = simulate_controlled(CASES["closing overtakes opening"])
    monkeypatch.setattr(controlled, "_SAMPLES_AT_ONCE", 7)
    parts = simulate_controlled(CASES["closing overtakes opening"])
    assert np.array_equal(parts.states["stroke"], whole.states["stroke"])
    assert np.array_equal(parts.command.times, whole.command.times)
    assert parts.steps == whole.steps


def test_the_caller_can_end_it_and_hears_how_far_it_is(monkeypatch):
    monkeypatch.setattr(controlled, "_SAMPLES_AT_ONCE", 50)
    asked: list[int] = []

    def cancelled() -> bool:
        asked.append(len(asked))
        return len(asked) > 3

    run = simulate_controlled(CASES["valve"], points=801, watch=Watch(cancelled=cancelled))
    assert run.outcome is Outcome.CANCELLED
    assert run.time[-1] == pytest.approx(3 * 50 * 2e-3, abs=1.1e-3)
    assert np.isfinite(run.states["stroke"]).all()

    monkeypatch.setattr("mckibben.simulation.outcome._PROGRESS_EVERY", -1.0)
    shares: list[float] = []
    simulate_controlled(CASES["valve"], watch=Watch(progress=shares.append))
    assert shares == pytest.approx(np.arange(8) * 50 / 400)


def test_a_run_that_takes_too_long_is_ended():
    run = simulate_controlled(CASES["valve"], watch=Watch(time_limit=-1.0))
    assert run.outcome is Outcome.TIMED_OUT
    assert len(run.time) == 0
