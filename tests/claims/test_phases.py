"""What is said of the phases of a switched drive, held against the trace."""

from __future__ import annotations

import numpy as np
import pytest

import mckibben as mk


def test_the_first_impact_is_no_arrival() -> None:
    """The load hits its stop at 60 mm and comes to rest 15 mm before it."""
    found = mk.Drive(
        muscle="DMSP-20:300mm", valve="MPYE-5-1/4", supply="2.6 bar", load={"mass": "10 kg"},
        command={"shape": "step", "at": 0, "level": 1}, duration="3 s", stops={"max_contraction": "20 %"},
        effects={"bladder_elasticity": {}, "viscous_damping": {"coefficient": 20.0}},
    ).run()  # fmt: skip
    fill = found.timing.extend
    assert np.max(found.position) == pytest.approx(0.06, abs=1e-4)
    assert found.position[-1] == pytest.approx(0.045, abs=1e-3)
    assert fill.state == "arrived_and_bounced"
    assert fill.positioning_time is None
    assert f"{1e3 * (0.06 - found.position[-1]):.3g} mm before" in (fill.motion or "")


def test_a_curve_fit_that_swings_says_so() -> None:
    """The fitted lift of size 20 swings between 184.7 and 199.9 mm until the vent."""
    found = mk.Drive.preset("propneu-20").run()
    fill = found.timing.extend
    vent = float(found.time[np.argmax(found.command < 1.0)])
    late = (found.time > vent - 0.6) & (found.time < vent)
    assert fill.state == "swings"
    assert fill.settling_time is None
    assert fill.swing_amplitude == pytest.approx(0.5 * np.ptp(found.position[late]), rel=0.02)
    tops = np.flatnonzero(np.diff(np.sign(found.velocity[late])) < 0)
    assert fill.swing_frequency == pytest.approx(1.0 / np.mean(np.diff(found.time[late][tops])), rel=0.02)
    physical = mk.Drive.preset("propneu-20-physical").run().timing.extend
    assert physical.state == "arrived_and_held"
    assert physical.settling_time is not None


@pytest.mark.parametrize("name", ["paper-hysteresis", "paper-pid-triangle"])
def test_figures_of_a_step_exist_for_steps(name: str) -> None:
    for phase in ("extend", "retract"):
        figures = getattr(mk.Drive.preset(name).run().timing, phase)
        assert figures.overshoot is figures.rise_time is figures.positioning_time is figures.state is None


def test_no_air_is_negative() -> None:
    for name in ("paper-ramp", "propneu-20", "joint-20"):
        timing = mk.Drive.preset(name).run().timing
        for phase in (timing.extend, timing.retract):
            for mass in (phase.supplied_mass, phase.vented_mass):
                assert mass is None or mass >= 0.0


def test_a_stop_beyond_the_demanded_stroke_is_no_arrival() -> None:
    """Demanded are 30 mm; the load goes on to its stop at 60 mm and stays there."""
    found = mk.Drive(
        muscle="DMSP-20:300mm", valve="MPYE-5-1/4", supply="6 bar", load={"mass": "10 kg"}, duration="2 s",
        stops={"max_contraction": "20 %"},
        controller={"kp": 50.0, "ki": 0.0, "output_min": 0.9, "output_max": 1.0,
                    "reference": {"shape": "step", "at": "0 s", "level": "30 mm"}},
    ).run()  # fmt: skip
    fill = found.timing.extend
    assert found.position[-1] == pytest.approx(0.06, abs=1e-4)
    assert fill.positioning_time is None
    assert fill.settling_time is None
    assert fill.state == "never_arrived"


@pytest.mark.parametrize("pause", [0.02, 0.1, 0.15, 0.3])
def test_a_load_that_swings_is_said_to_swing_wherever_its_phase_ends(pause: float) -> None:
    """The fitted lift of size 20 swings; the vent comes anywhere in the swing."""
    drive = mk.Drive.preset("propneu-20")
    found = drive.changed(command={"shape": "pulse", "on": 0.0, "off": 1.0 + pause}).run()
    fill, there = found.timing.extend, (found.time > 0.25) & (found.time < 1.0 + pause)
    turns = np.flatnonzero(np.diff(np.sign(found.velocity[there])))  # two in each period
    assert fill.state == "swings"
    assert fill.swing_frequency == pytest.approx(0.5 / np.mean(np.diff(found.time[there][turns])), rel=0.1)
    assert fill.positioning_time is fill.settling_time is None


def test_a_muscle_that_is_held_at_its_level_is_not_filled() -> None:
    """In the load ramp of the paper the valve is open before the run and stays open."""
    found = mk.Drive.preset("paper-ramp").run()
    assert found.verdict.state is found.verdict.met is None
    assert found.timing.extend.state is found.timing.retract.state is None


def test_a_step_from_a_level_to_a_higher_one_is_a_fill() -> None:
    """A regulator goes from 1 to 4 bar at 1 s: the lift begins there, not with the run."""
    found = mk.Drive(
        muscle="DMSP-20:300mm", valve="VPPM-6", load="20 kg", duration="4 s", start_pressure="1 bar",
        command={"shape": "step", "initial": 1 / 6, "at": "1 s", "level": 4 / 6},
    ).run()  # fmt: skip
    fill = found.timing.extend
    half = 0.5 * (found.position[0] + found.position[-1])
    passed = float(np.interp(half, found.position[:1000], found.time[:1000]))
    assert fill.stroke == pytest.approx(
        found.position[-1] - np.interp(1.0, found.time, found.position), rel=1e-3
    )
    assert fill.delay_time == pytest.approx(passed - 1.0, abs=2e-3)
