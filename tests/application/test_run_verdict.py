"""One verdict of a run: of its phases the worst, of a controlled run that of its reference."""

from __future__ import annotations

import pytest

import mckibben as mk
from mckibben.application.run.verdict import verdict_of
from mckibben.simulation.outcome import Outcome
from mckibben.simulation.timing.table import TimingTable


def test_a_run_that_ended_early_is_not_judged() -> None:
    found = verdict_of(TimingTable(), None, Outcome.DIVERGED, "it diverged")
    assert (found.state, found.met, found.sentence, found.evidence) == (None, None, "it diverged", {})


@pytest.mark.parametrize(
    ("name", "state", "met"),
    [
        ("propneu-20", "swings", False),
        ("propneu-20-physical", "arrived_and_held", True),
        ("paper-pid-pulse", "settles", True),
        ("paper-hysteresis", None, None),
    ],
)
def test_the_state_is_that_of_its_worst_phase_or_of_its_reference(
    name: str, state: str | None, met: bool | None
) -> None:
    run = mk.Drive.preset(name).run()
    assert (run.verdict.state, run.verdict.met) == (state, met)
    if state is None:
        assert run.verdict.evidence == {}
    elif run.tracking is None:
        assert run.verdict.evidence["extend.stroke"] == run.timing.extend.stroke
        assert (run.timing.extend.motion or "") in run.verdict.sentence
    else:
        assert run.verdict.evidence["rms"] == run.tracking.rms


def test_a_load_away_from_its_reference_is_off_target() -> None:
    """A proportional controller holds a weight below its level."""
    found = mk.Drive(
        muscle="DMSP-20:300mm", valve="VPPM-6", supply="6 bar", load={"mass": "20 kg"}, duration="4 s",
        controller={"kp": 0.5, "ki": 0.0, "reference": {"shape": "step", "at": "0.5 s", "level": "20 mm"}},
    ).run()  # fmt: skip
    assert found.verdict.state == "off_target"
    assert found.verdict.met is False
    assert abs(found.verdict.evidence["step.steady_error"]) == pytest.approx(
        abs(0.02 - found.position[-1]), rel=0.1
    )
