"""An antagonist joint: angle and stiffness as two set points, by regulators and by valves."""

from __future__ import annotations

from math import pi, radians, tan
from typing import Any

import numpy as np
import pytest

from mckibben.application.run.simulate import SimulationQuestion, SimulationResult, simulate
from mckibben.documents.drive_reading import drive_of, preset_document, read_document
from mckibben.physics.drive_terms import COUNTER
from mckibben.physics.errors import InputError
from mckibben.simulation.command.joint import common_command
from mckibben.simulation.drive.controlled import simulate_controlled
from mckibben.simulation.drive.joint import JointStiffness
from mckibben.simulation.timing.evaluation import timing_of, trace_of
from tests.shipped import shipped_studio

STUDIO = shipped_studio()
RADIUS = 0.03
JOINT: dict[str, Any] = {
    "muscle": {"inside_diameter": "20 mm", "braid_angle": "25 deg", "nominal_length": "300 mm"},
    "effects": {"viscous_damping": {"coefficient": "150 N*s/m"}},
    "supply": {"pressure": "6 bar"},
    "valve": {"preset": "VPPM-6"},
    "load": {"mass": "4 kg", "arrangement": "antagonist", "pulley_radius": RADIUS},
    "controller": {
        "kp": 2.5, "ki": 15, "kd": 0.03, "sample_time": "2 ms",
        "angle": {"shape": "step", "at": "1 s", "initial": "0 deg", "level": "12 deg"},
        "stiffness": {
            "reference": {"shape": "step", "at": "3 s", "initial": "18 N*m/rad", "level": "24 N*m/rad"}
        },
    },
    "start_pressure": "3 bar",
    "duration": "5 s",
}  # fmt: skip
VALVES = {
    **JOINT,
    "valve": {"preset": "MPYE-5-1/8-LF"},
    "controller": {**JOINT["controller"], "kp": 4, "ki": 1, "kd": 0.06},
}


def changed(document: dict[str, Any], **controller: Any) -> dict[str, Any]:
    given = {**document["controller"], **controller}
    return {**document, "controller": {key: value for key, value in given.items() if value is not None}}


def run(document: dict[str, Any]) -> SimulationResult:
    annotated = drive_of(read_document(document, "joint"), STUDIO)
    return simulate(SimulationQuestion(annotated, points=501))


def test_the_stiffness_of_a_joint_of_ideal_muscles_is_its_closed_form() -> None:
    drive = drive_of(read_document(JOINT, "joint"), STUDIO).drive
    joint = JointStiffness(drive)
    rest, angle = 0.3, radians(25.0)
    turns = rest * tan(angle) / (pi * 0.02)
    stroke, first, second = 0.01, 4e5, 2.5e5
    # k = 3 L P/(2 pi n^2) of each muscle, at 270 mm minus and plus the stroke.
    each = [3.0 * (0.27 - s * stroke) * p / (2.0 * pi * turns**2) for s, p in ((1, first), (-1, second))]
    assert joint.value(stroke, first, second) == pytest.approx(RADIUS**2 * sum(each), rel=1e-6)
    mean = joint.common_pressure(20.0, stroke)
    assert joint.value(stroke, mean, mean) == pytest.approx(20.0, rel=1e-9)


def test_the_difference_leaves_a_command_for_both() -> None:
    """Whatever stiffness is wanted, neither muscle is commanded more than there is."""
    for regulated, lowest in ((1.0, 0.0), (0.0, -1.0)):
        for difference in (-0.5, -0.2, 0.0, 0.3, 0.5):
            for wanted in (0.0, 20.0, 1e4):
                common, integral = common_command(
                    difference,
                    wanted,
                    3e5,
                    2e5,
                    0.05,
                    0.05,
                    100.0,
                    0.1,
                    RADIUS,
                    6e5,
                    0.05,
                    2.0,
                    0.01,
                    regulated,
                )
                assert lowest - 1e-12 <= common - abs(difference) <= common + abs(difference) <= 1.0 + 1e-12
                assert integral == 0.1 or lowest < common < 1.0


@pytest.mark.parametrize("document", [JOINT, VALVES], ids=["regulators", "valves"])
def test_angle_and_stiffness_reach_their_set_points_and_leave_each_other_alone(document: dict) -> None:
    result = run(document)
    joint, time = result.joint, np.asarray(result.time)
    assert joint is not None
    assert joint.stiffness_reference is not None
    angle, stiffness = np.degrees(joint.angle), np.asarray(joint.stiffness)
    assert joint.stiffness_range == (stiffness.min(), stiffness.max())
    for at, expected, wanted in ((0.99, 0.0, 18.0), (2.99, 12.0, 18.0), (5.0, 12.0, 24.0)):
        row = int(np.argmin(np.abs(time - at)))
        assert angle[row] == pytest.approx(expected, abs=0.5)
        assert stiffness[row] == pytest.approx(wanted, rel=0.02)
    # A third more stiffness turns the joint by little, and comes back.
    after = (time >= 3.0) & (time <= 5.0)
    assert np.abs(angle[after] - 12.0).max() < 2.0
    square = (stiffness - joint.stiffness_reference) ** 2
    error = np.sqrt(np.trapezoid(square, time) / (time[-1] - time[0]))
    assert joint.stiffness_error == pytest.approx(
        error, rel=0.1
    )  # over all steps, not the rows that are shown


def test_both_muscles_are_in_the_answer() -> None:
    result = run(JOINT)
    joint = result.joint
    assert joint is not None
    # The first muscle is the shorter one: it is the wider one.
    assert result.diameter[-1] > joint.counter_diameter[-1]
    # What flows in is what is supplied minus what is vented.
    net = np.asarray(joint.counter_supply_flow) - np.asarray(joint.counter_exhaust_flow)
    assert np.asarray(joint.counter_mass_flow) == pytest.approx(net, abs=1e-9)
    # The regulators hold what they are commanded, up to half the play of 0.5 %.
    assert joint.counter_pressure[-1] == pytest.approx(joint.counter_command[-1] * 6e5, abs=0.003 * 6e5)


def test_a_stiffness_that_is_out_of_reach_does_not_take_the_angle() -> None:
    for document in (JOINT, VALVES):
        result = run(changed(document, stiffness={"reference": "200 N*m/rad"}))
        joint = result.joint
        assert joint is not None
        assert np.degrees(joint.angle[-1]) == pytest.approx(12.0, abs=1.0)
        assert joint.stiffness[-1] < 100.0


def test_a_pair_under_a_plain_controller_is_measured_from_its_middle() -> None:
    position = {"shape": "step", "at": "1 s", "initial": "0 mm", "level": "5 mm"}
    plain = changed(JOINT, angle=None, stiffness=None, reference=position, output_min=None)
    result = run(plain)
    assert result.position[-1] == pytest.approx(5e-3, abs=2e-4)


def test_the_preset_follows_both() -> None:
    annotated = drive_of(preset_document("joint-20", STUDIO), STUDIO)
    result = simulate(SimulationQuestion(annotated, points=401))
    joint = result.joint
    assert joint is not None
    assert joint.stiffness_error is not None
    assert joint.stiffness_error < 0.05 * 22.0
    assert result.tracking is not None
    assert result.tracking.rms < 0.5 * radians(15.0) * RADIUS


@pytest.mark.parametrize(
    ("document", "field"),
    [
        ({**JOINT, "load": {"mass": "4 kg"}}, "controller.angle"),
        (changed({**JOINT, "load": {"mass": "4 kg"}}, angle=None, reference={"shape": "step", "level": 0.01}),
         "controller.stiffness"),
        (changed(JOINT, reference={"shape": "step", "level": 0.01}), "controller.reference"),
        (changed(JOINT, angle=None), "controller.reference"),
        (changed(JOINT, output_max=0.9), "controller.output_max"),
        (changed(JOINT, stiffness={"reference": "20 N"}), "controller.stiffness.reference"),
        (changed(JOINT, stiffness={"reference": "20 N*m/rad", "ki": -1}), "controller.stiffness.ki"),
    ],
)  # fmt: skip
def test_what_cannot_be_is_refused_at_its_field(document: dict, field: str) -> None:
    with pytest.raises(InputError) as caught:
        drive_of(read_document(document, "joint"), STUDIO)
    assert caught.value.field == field


@pytest.mark.parametrize("document", [JOINT, VALVES], ids=["regulators", "valves"])
def test_the_air_of_both_muscles_is_in_both_phases(document: dict[str, Any]) -> None:
    """What is taken less what is let out stays in the muscles; while one vents, the other fills."""
    angle = {"shape": "pulse", "on": "1 s", "off": "2 s", "level": "10 deg"}
    stiffness = {"reference": {"shape": "step", "at": "0 s", "level": "18 N*m/rad"}}
    drive = drive_of(
        read_document(changed(document, angle=angle, stiffness=stiffness) | {"duration": "3 s"}, "joint"),
        STUDIO,
    ).drive
    done = simulate_controlled(drive, grid=np.linspace(0.0, 3.0, 6001))
    table = timing_of(drive, trace_of(done))
    mass = [
        done.states[f"pressure{side}"] * done.outputs[f"volume{side}"] / (287.05 * drive.temperature)
        if f"gas_mass{side}" not in done.states
        else done.states[f"gas_mass{side}"]
        for side in ("", COUNTER)
    ]
    for phase, (begin, end) in ((table.extend, (1.0, 2.0)), (table.retract, (2.0, 3.0))):
        gained = [float(np.interp(end, done.time, m) - np.interp(begin, done.time, m)) for m in mass]
        assert phase.supplied_mass is not None
        assert phase.vented_mass is not None
        assert phase.supplied_mass - phase.vented_mass == pytest.approx(sum(gained), abs=2e-3 * max(gained))
        assert phase.supplied_mass > 0.999 * max(gained) > 1e-6
        assert phase.vented_mass > -0.999 * min(gained) > 1e-6
