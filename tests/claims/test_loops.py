"""What is said of a loop: an unstable one has no margins."""

from __future__ import annotations

import mckibben as mk
from mckibben.facts.linear import MARGINS


def test_an_unstable_loop_has_no_margins_and_swings() -> None:
    """The linear view and the run of the same gains agree."""
    reference = {"shape": "step", "at": "0.5 s", "level": "22 mm", "initial": "5 mm"}
    drive = mk.Drive(
        muscle="DMSP-20:300mm", valve="MPYE-5-M5", supply="6 bar", duration="5 s", load={"mass": "20 kg"},
        controller={"kp": 20.0, "ki": 50.0, "reference": reference},
    )  # fmt: skip
    found = drive.linearise(at="position 15 mm", amplitudes=()).loop.margins
    assert found is not None
    assert not found.stable
    assert [getattr(found, name) for name in MARGINS] == [None] * len(MARGINS)
    assert drive.run().tracking.state == "swings"
    slower = drive.changed(controller={"kp": 2.0, "ki": 2.0, "reference": reference})
    found = slower.linearise(at="position 15 mm", amplitudes=()).loop.margins
    assert found.stable
    assert found.modulus_margin > 0.1
    assert found.delay_margin > 0.0


def test_a_run_stands_beside_the_loop_and_the_difference_is_explained() -> None:
    """The loop of a small muscle is stable in the middle of its range; from its lower stop it swings."""
    reference = {"shape": "square", "level": "30 mm", "initial": "10 mm", "period": "3 s"}
    drive = mk.Drive(
        muscle="DMSP-10:250mm", valve="MPYE-5-1/8-HF", supply="6 bar", duration="6 s", load={"mass": "3 kg"},
        controller={"kp": 0.5, "ki": 1.0, "reference": reference},
    )  # fmt: skip
    loop, said = drive.linearise(amplitudes=()).loop, drive.run().verdict
    assert loop.margins.stable
    assert said.state in ("swings", "unstable")
    assert loop.run.startswith(said.sentence)
    assert "differs from the loop" in loop.run
    slower = drive.changed(controller={"kp": 0.1, "ki": 0.3, "reference": reference})
    loop = slower.linearise(amplitudes=()).loop
    assert loop.margins.stable
    assert loop.run == slower.run().verdict.sentence
