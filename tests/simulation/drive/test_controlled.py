"""The controlled loop in the kernel is the loop in Python, and can be left early."""

from __future__ import annotations

from dataclasses import replace
from math import radians

import numpy as np
import pytest

from mckibben.documents.drive_reading import drive_of, preset_document
from mckibben.physics.muscle import Muscle
from mckibben.simulation.command.pid import PidController
from mckibben.simulation.command.signals import Signal, signal_from
from mckibben.simulation.drive import controlled
from mckibben.simulation.drive.controlled import loop_in_python, simulate_controlled
from mckibben.simulation.drive.parts import Drive, Load, Regulator, Tube, Valve
from mckibben.simulation.drive.transient import Run
from mckibben.simulation.outcome import Outcome, Watch
from mckibben.simulation.statics.model import StaticModel
from tests.shipped import shipped_studio

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
    "pair": drive(
        pair=True, precontraction=0.1, load=Load(mass=2.0), min_contraction=0.0, max_contraction=0.2,
        reference=shape("m", shape="sine", amplitude="5 mm", frequency="2 Hz"),
    ),
}  # fmt: skip


def both(case: Drive, monkeypatch: pytest.MonkeyPatch, **options) -> tuple[Run, Run]:
    quick = simulate_controlled(case, **options)
    monkeypatch.setattr(controlled, "loop_in_kernel", lambda loop: loop_in_python(loop, "rodas"))
    return quick, simulate_controlled(case, **options)


def assert_same(quick: Run, slow: Run) -> None:
    assert quick.outcome is slow.outcome is Outcome.COMPLETED
    assert quick.steps == slow.steps
    for name, values in (slow.states | slow.outputs).items():
        found = (quick.states | quick.outputs)[name]
        assert found == pytest.approx(values, rel=1e-12, abs=1e-12 * np.max(np.abs(values))), name
    assert quick.command.times == pytest.approx(slow.command.times, abs=0.0)
    assert quick.command.start_values == pytest.approx(slow.command.start_values, rel=1e-12, abs=1e-15)


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


def test_without_the_kernel_the_motion_is_the_same():
    case = replace(CASES["valve"], duration=0.1)
    quick, slow = simulate_controlled(case, points=51), simulate_controlled(case, points=51, engine="lsoda")
    assert (quick.engine, slow.engine) == ("rodas", "lsoda")
    assert slow.states["stroke"] == pytest.approx(quick.states["stroke"], abs=1e-5)


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
