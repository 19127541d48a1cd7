"""Design of the angle controller of a joint whose stiffness is controlled too."""

from __future__ import annotations

import pytest

from mckibben.documents.drive_reading import drive_of, read_document
from mckibben.physics.errors import InputError
from mckibben.simulation.linear.design import design
from mckibben.simulation.linear.linearise import linearise
from mckibben.simulation.linear.trials import Goals
from tests.simulation.drive.test_joint import JOINT, STUDIO, changed

SLOW = changed(JOINT, kp=0.3, ki=3, kd=0.0, angle="3 deg", stiffness={"reference": "18 N*m/rad"})


@pytest.mark.examination("test_a_stiffness_out_of_reach_is_said_with_the_range")
def test_before_and_after_on_a_joint_with_other_mass_and_supply() -> None:
    given = drive_of(read_document(SLOW, "joint"), STUDIO).drive
    linear = linearise(given)
    # Equal pressures on both sides of the middle; the set point is 3 degrees, the stiffness 18 N m/rad.
    assert linear.point.position == pytest.approx(0.03 * 0.05235988, rel=1e-6)
    assert linear.point.bound.drive.common is not None
    assert any(text.startswith("stiffness") for text in linear.lost)
    goals = Goals(overshoot=0.1, settling=0.8)
    found = design(linear, goals)
    own, refined = found.trials[0], found.refined
    assert own.name == "own"
    assert own.controller == given.controller
    assert own.figures.settling is None or own.figures.settling > goals.settling
    assert refined.figures.meets
    assert (refined.controller.output_min, refined.controller.output_max) == pytest.approx((-0.5, 0.5))
    assert len(found.robust) == 9
    for each in found.robust:
        assert each.figures.overshoot <= 0.12
        assert each.figures.settling is not None
        assert each.figures.settling < 1.2 * goals.settling


def test_a_stiffness_out_of_reach_is_said_with_the_range() -> None:
    with pytest.raises(InputError) as caught:
        linearise(
            drive_of(
                read_document(changed(SLOW, stiffness={"reference": "90 N*m/rad"}), "joint"), STUDIO
            ).drive
        )
    assert caught.value.field == "controller.stiffness.reference"
    assert "out of reach" in caught.value.message
