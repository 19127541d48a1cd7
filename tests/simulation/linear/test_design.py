"""Controller design: the rule against its own definition, the refinement against its goals."""

from __future__ import annotations

from dataclasses import replace
from itertools import count

import numpy as np
import pytest

from mckibben.physics.errors import InputError
from mckibben.simulation.command.pid import PidController
from mckibben.simulation.linear.design import by_rule, design, ultimate_of
from mckibben.simulation.linear.linearise import linearise
from mckibben.simulation.linear.loop import closed_loop_eigenvalues
from mckibben.simulation.linear.point import Condition
from mckibben.simulation.linear.trials import Goals
from mckibben.simulation.outcome import Watch
from tests.simulation.linear.drives import drive

TEMPLATE = PidController(kp=1.0, output_min=0.0)


@pytest.mark.parametrize("name", ["regulator", "valve", "propneu-10"])
def test_at_the_ultimate_gain_the_loop_oscillates_for_ever(name: str) -> None:
    linear = linearise(drive(name))
    ultimate = ultimate_of(linear, TEMPLATE)
    assert ultimate is not None
    gain, period = ultimate
    values = closed_loop_eigenvalues(linear.primary, replace(TEMPLATE, kp=gain, ki=0.0, kd=0.0))
    critical = values[np.argmax(np.abs(values) * (np.abs(values.imag) > 1e-6))]
    assert abs(critical) == pytest.approx(1.0, abs=1e-3)
    assert abs(np.angle(critical)) / (2.0 * np.pi * TEMPLATE.sample_time) == pytest.approx(
        1.0 / period, rel=0.01
    )


def test_the_rule_is_that_of_tyreus_and_luyben() -> None:
    found = by_rule(TEMPLATE, 8.8, 0.63)
    assert (found.kp, found.ki, found.kd) == pytest.approx((4.0, 4.0 / (2.2 * 0.63), 0.4))


def test_a_regulated_lift_meets_its_goals_also_with_other_mass_and_supply() -> None:
    found = design(linearise(drive("regulator")), Goals(overshoot=0.05, settling=0.8))
    first, last = found.trials
    assert [first.name, last.name] == ["rule", "refined"]
    assert not first.figures.meets
    assert last.figures.meets
    assert last.figures.overshoot <= 0.05
    assert last.figures.settling is not None
    assert last.figures.settling <= 0.8
    assert last.margins.stable
    assert last.margins.modulus_margin >= 0.49
    # The figures are those of the run that is shown.
    rise = (last.position[(last.time > 0.8) & (last.time < 2.4)] - last.position[0]) / (
        last.reference.max() - last.reference.min()
    )
    assert rise.max() - 1.0 <= last.figures.overshoot + 1e-9
    corners = {(each.mass, each.supply) for each in found.robust}
    assert corners == {(m, s) for m in (0.8, 1.0, 1.2) for s in (0.8, 1.0, 1.2)}
    assert all(each.figures.meets for each in found.robust)


@pytest.mark.examination("test_a_regulated_lift_meets_its_goals_also_with_other_mass_and_supply")
def test_the_drives_own_controller_comes_first() -> None:
    names = [trial.name for trial in design(linearise(drive("paper-pid-pulse")), Goals(0.2, 2.0)).trials]
    assert names == ["own", "rule", "refined"]


def test_goals_that_another_mass_or_supply_misses_are_counted() -> None:
    tries = count()
    watch = Watch(cancelled=lambda: next(tries) > 25)
    found = design(linearise(drive("regulator")), Goals(overshoot=0.05, settling=0.45), watch)
    missed = [each for each in found.robust if not each.figures.meets]
    assert found.refined.figures.meets
    assert missed
    said = next(text for text in found.remarks if "combinations" in text)
    assert f"misses them in {len(missed)} of 9 combinations" in said
    assert f"settled in {max(each.figures.settling or 0.0 for each in missed):.3g} s" in said


def test_goals_that_cannot_be_met_are_said() -> None:
    found = design(linearise(drive("valve")), Goals(overshoot=0.0, settling=0.02))
    assert not found.refined.figures.meets
    assert found.remarks[0].startswith("no PID controller that was tried meets the goals")


def test_a_loop_that_is_unstable_is_not_said_to_be_near() -> None:
    """The undamped lift: no controller damps it, and its margins are those of an unstable loop."""
    found = design(linearise(drive("propneu-20")), Goals(0.05, 0.8), Watch(cancelled=lambda: True))
    assert not found.refined.margins.stable
    assert sum("is unstable" in text for text in found.remarks) == 1
    assert not any("of -1" in text for text in found.remarks)


def test_a_search_that_is_ended_gives_the_best_so_far() -> None:
    watch = Watch(cancelled=lambda: True)
    found = design(linearise(drive("regulator")), Goals(), watch)
    assert any("ended early" in text for text in found.remarks)


@pytest.mark.parametrize(
    ("condition", "goals", "message"),
    [
        (Condition("pressure", 1e3), Goals(), "rests on its end stop"),
        (None, Goals(step=0.2), "ends beyond the end stops"),
    ],
)
def test_what_cannot_be_designed_is_a_sentence(
    condition: Condition | None, goals: Goals, message: str
) -> None:
    with pytest.raises(InputError, match=message) as caught:
        design(linearise(drive("regulator"), condition), goals)
    assert caught.value.field == "design"
