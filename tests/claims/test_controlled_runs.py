"""What is said of a controlled run: each sentence is held against the trace, by other means than its own."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import mckibben as mk

STEP = {"shape": "step", "at": "0.5 s", "level": "22 mm", "initial": "5 mm"}


def run(load: dict[str, Any], kp: float, ki: float, **more: Any) -> mk.door.run.Run:
    drive = {"muscle": "DMSP-20:300mm", "valve": "MPYE-5-M5", "supply": "6 bar", "duration": "5 s", **more}
    return mk.Drive(**drive, load=load, controller={"kp": kp, "ki": ki, "reference": STEP}).run()


@pytest.mark.parametrize("gain", [0.5, 2.0])
def test_one_muscle_cannot_push_a_horizontal_load_back(gain: float) -> None:
    """Nothing pulls it: once beyond the reference it stays there, whatever the controller does."""
    found = run({"mass": "5 kg", "arrangement": "horizontal"}, gain, gain)
    assert found.position[-1] > 0.022 + 0.002
    assert found.velocity[-1] == pytest.approx(0.0, abs=1e-6)
    assert found.pressure[-1] < 0.01 * np.max(found.pressure)
    assert found.tracking.state == "cannot_return"
    assert "second muscle" in (found.tracking.advice or "")


def test_a_limit_cycle_is_no_settling() -> None:
    found = run({"mass": "20 kg"}, 20.0, 50.0)
    late = found.time > 2.5
    swing = found.position[late] - np.mean(found.position[late])
    assert np.ptp(swing) > 0.1 * 0.017
    power = np.abs(np.fft.rfft(swing * np.hanning(len(swing)), 16 * len(swing)))
    frequency = np.fft.rfftfreq(16 * len(swing), found.time[1] - found.time[0])[np.argmax(power)]
    step = found.tracking.steps[-1]
    assert found.tracking.state == step.state == "swings"
    assert step.settling_time is None
    assert step.swing_frequency == pytest.approx(frequency, rel=0.02)
    assert step.swing_amplitude == pytest.approx(0.5 * np.ptp(swing), rel=0.05)


def test_too_little_supply_is_said_to_be_too_little() -> None:
    found = run({"mass": "20 kg"}, 2.0, 5.0, supply="1 bar")
    assert found.position[-1] < 0.01
    assert found.pressure[-1] == pytest.approx(1e5, rel=0.01)
    assert found.tracking.state == "saturates"


def test_what_settles_stays_within_its_band() -> None:
    found = mk.Drive.preset("paper-pid-pulse").run()
    assert found.tracking.state == "settles"
    for step in found.tracking.steps:
        assert step.settling_time is not None
        rows = (found.time >= step.time + step.settling_time + 2e-3) & (found.time < step.time + 0.999)
        level = found.reference[np.searchsorted(found.time, step.time)]
        assert np.all(np.abs(found.position[rows] - level) <= 0.0201 * abs(step.size))


def test_a_limit_cycle_about_a_moving_reference_is_no_lack_of_gain() -> None:
    """A regulator's delay and an integral part: the loop swings by itself, much faster than the reference."""
    found = mk.Drive(
        muscle="DMSP-20:300mm", valve="VPPM-6", supply="6 bar", load={"mass": "20 kg"}, duration="10 s",
        controller={"kp": 1.0, "ki": 20.0, "reference": {"shape": "sine", "offset": "20 mm",
                    "amplitude": "8 mm", "period": "10 s"}},
    ).run()  # fmt: skip
    late = found.time > 5.0
    error = (found.reference - found.position)[late]
    power = np.abs(np.fft.rfft((error - error.mean()) * np.hanning(len(error)), 16 * len(error)))
    frequency = np.fft.rfftfreq(16 * len(error), found.time[1] - found.time[0])[np.argmax(power)]
    assert frequency > 1.0
    assert found.tracking.state in ("swings", "unstable")
    assert float(found.tracking.verdict.split(" at ")[1].split(" Hz")[0]) == pytest.approx(
        frequency, rel=0.05
    )
    assert "lower the gains" in (found.tracking.advice or "")


@pytest.mark.parametrize(("level", "state"), [("45 mm", "on_stop"), ("29 mm", "settles")])
def test_a_reference_behind_a_stop_is_no_lack_of_supply(level: str, state: str) -> None:
    """The stop is at 30 mm: no muscle, valve or supply brings the load to 45 mm."""
    run = mk.Drive(
        muscle="DMSP-20:300mm", valve="VPPM-6", load={"mass": "5 kg"}, stops={"max_contraction": "10 %"},
        controller={"kp": 1.0, "ki": 5.0, "reference": {"shape": "step", "at": "0.5 s", "level": level}},
        duration="4 s",
    ).run()  # fmt: skip
    assert run.tracking is not None
    assert run.tracking.state == state
    assert run.verdict.state == ("off_target" if state == "on_stop" else state)
    assert state == "settles" or "end stops" in (run.tracking.advice or "")
