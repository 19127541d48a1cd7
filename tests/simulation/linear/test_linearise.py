"""Matrices of the linear view against differences, a closed form and nonlinear runs; where it refuses."""

from __future__ import annotations

from dataclasses import replace
from math import cos, pi, sqrt, tan

import numpy as np
import pytest

from mckibben.documents.drive_reading import drive_of, preset_document, read_document
from mckibben.physics.errors import InputError
from mckibben.simulation.command.shapes import Step
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import dead_times
from mckibben.simulation.linear.corner import corners_of
from mckibben.simulation.linear.linearise import Linearisation, linearise
from mckibben.simulation.linear.nonlinear import run_from
from mckibben.simulation.linear.point import Condition
from mckibben.simulation.linear.response import eigenvalues, static_gain
from tests.simulation.linear.differences import differences, of_model, side_of
from tests.simulation.linear.drives import DOCUMENTS, SMOOTH, STUDIO, drive
from tests.simulation.linear.steps import step_response


@pytest.mark.parametrize("name", [*SMOOTH, "pair"])
def test_the_matrices_are_those_of_central_differences(name: str) -> None:
    linear = linearise(drive(name))
    (model,) = linear.models
    a, b, exact_a, exact_b = of_model(linear, model)
    assert np.abs(a - exact_a) == pytest.approx(0.0, abs=1e-6 * np.abs(exact_a).max())
    assert np.abs(b - exact_b) == pytest.approx(0.0, abs=1e-6 * max(np.abs(exact_b).max(), 1.0))
    held = np.abs(exact_a) > 1e-3
    assert a[held] == pytest.approx(exact_a[held], rel=1e-6, abs=1e-6)


@pytest.mark.parametrize(
    "name", ["joint-20", "regulator with hysteresis", "valve", "valve and tube", "valve with dead band"]
)
def test_the_matrices_of_a_side_are_those_of_one_sided_differences(name: str) -> None:
    linear = linearise(drive(name))
    sides = [model for model in linear.models if side_of(model) and "sliding" not in model.name]
    assert {side_of(model) for model in sides} == {1, -1}
    for model in sides:
        a, b, exact_a, exact_b = of_model(linear, model)
        assert np.abs(a - exact_a).max() < 1e-6 * np.abs(exact_a).max(), model.name
        assert np.abs(b - exact_b).max() < 1e-6 * max(np.abs(exact_b).max(), 1.0), model.name


@pytest.mark.parametrize("name", ["regulator", "regulator, tube, lever", "pair", "joint-20"])
def test_a_regulator_at_rest_is_a_corner_with_two_slopes(name: str) -> None:
    """Both are one-sided differences of the rates, in the ratio of the flows; the answer says so."""
    linear = linearise(drive(name))
    point = linear.point
    bound = point.bound
    regulators = [bound.names[place] for place in bound.places("regulator_pressure")]
    outlets = [bound.names[place] for place in bound.places("tube_pressure") or bound.places("pressure")]
    names = [bound.names[place] for place in bound.independent]
    slopes = {}
    for side in (1, -1):
        a, _ = differences(point, names, ["command"], (bound.scales, np.ones(1)), side=side, offset=0.0)
        for outlet, source, sense in zip(outlets, regulators, (1, -1), strict=False):
            ways = {1: "filling", -1: "venting"}
            row, column = names.index(outlet), names.index(source)
            scale = bound.scales[row] / bound.scales[column]
            slopes[outlet, ways[side * sense]] = a[row, column] * scale
    said = next(text for text in linear.lost if text.startswith("corner"))
    for outlet, corner in zip(outlets, corners_of(point), strict=True):
        assert corner.filling == pytest.approx(slopes[outlet, "filling"], rel=1e-6)
        assert corner.venting == pytest.approx(slopes[outlet, "venting"], rel=1e-6)
        for slope in corner:
            assert f"{slope:.4g}/s" in said
    if name == "regulator":
        # By hand: C = 6.01 l/(s bar), b = 0.3 both ways; 6 bar gauge in front, ambient behind.
        supply, own, ambient = 701_325.0, point.pressure + 101_325.0, 101_325.0

        def flow(upstream: float, downstream: float) -> float:
            return upstream * sqrt(1.0 - (max(downstream / upstream - 0.3, 0.0) / 0.7) ** 2)

        (corner,) = corners_of(point)
        ratio = flow(supply, own) / flow(own, ambient)
        assert corner.filling / corner.venting == pytest.approx(ratio, rel=1e-6)


def deviation(linear: Linearisation, given: Drive, source: str, size: float, seconds: float) -> float:
    """Largest difference of the linear and the nonlinear position, over the largest deviation."""
    point, model = linear.point, linear.models[0]
    time = np.linspace(0.0, seconds, 301)
    level = point.command + (size if source == "command" else 0.0)
    changed = replace(given, duration=seconds, command=Step(at=0.0, level=level, initial=point.command))
    if source == "load_force":
        changed = replace(changed, load=replace(given.load, force=point.bound.load_force + size))
    if source == "supply_pressure":
        changed = replace(changed, supply_pressure=given.supply_pressure + size)
    run = run_from(point, changed, grid=time, tolerance=1e-8)
    moved = run.states["stroke"] / given.load.lever_ratio - point.position
    expected = step_response(model, source, "position", time, size)
    assert np.abs(moved).max() > 1e-7
    return float(np.abs(moved - expected).max() / np.abs(moved).max())


@pytest.mark.parametrize("name", SMOOTH)
def test_a_step_of_one_percent_is_that_of_the_nonlinear_run(name: str) -> None:
    given = drive(name)
    linear = linearise(given)
    assert linear.smooth
    plain = "smooth" if given.regulator is None else "mean of both sides"
    assert [model.name for model in linear.models] == [plain]
    seconds = 0.3 if given.regulator is not None else 0.15  # a valve integrates: it leaves the point
    assert deviation(linear, given, "command", 0.01, seconds) < 0.02
    assert deviation(linear, given, "load_force", 0.01 * linear.point.force, seconds) < 0.02
    if given.regulator is None:  # behind a regulator the supply changes nothing
        assert deviation(linear, given, "supply_pressure", 0.01 * given.supply_pressure, seconds) < 0.02


def test_a_lift_by_a_valve_is_its_closed_form() -> None:
    r"""Ideal braid, polytropic air, closed valve: s (M s^2 + c s + k + n p A^2/V) x = n R T K A/V u."""
    rest, angle, bore, mass, damping, exponent = 0.3, 0.4363323129985824, 0.02, 10.0, 150.0, 1.2
    document = {
        "muscle": {"inside_diameter": bore, "braid_angle": angle, "nominal_length": rest},
        "effects": {"viscous_damping": {"coefficient": damping}},
        "supply": {"pressure": 6e5},
        "valve": {
            "sonic_conductance": 4e-8, "exhaust_conductance": 5e-8, "critical_pressure_ratio": 0.25,
        },
        "load": {"mass": mass},
        "gas": {"polytropic_exponent": exponent, "dead_volume": 5e-5},
        "command": {"shape": "step"},
    }  # fmt: skip
    position = 0.04
    linear = linearise(
        drive_of(read_document(document, "lift"), STUDIO).drive, Condition("position", position)
    )
    # By hand: thread length and turns of the braid, then F = -p dV/dL, V = L (b^2 - L^2)/(4 pi n^2).
    thread, turns = rest / cos(angle), rest * tan(angle) / (pi * bore)
    length = rest - position
    area = (3.0 * length**2 - thread**2) / (4.0 * pi * turns**2)
    pressure = mass * 9.80665 / area
    absolute = pressure + 101_325.0
    stiffness = pressure * 6.0 * length / (4.0 * pi * turns**2)
    volume = length * (thread**2 - length**2) / (4.0 * pi * turns**2) + 5e-5
    assert linear.point.pressure == pytest.approx(pressure, rel=1e-9)

    def flow(conductance: float, upstream: float, downstream: float) -> float:
        bent = max(downstream / upstream - 0.25, 0.0) / 0.75
        return conductance * 1.185 * upstream * sqrt(1.0 - bent**2)

    gains = {"filling": flow(4e-8, 701_325.0, absolute), "venting": flow(5e-8, absolute, 101_325.0)}
    back = exponent * absolute * area**2 / volume
    poles = np.roots([mass, damping, stiffness + back, 0.0])
    names = [model.name for model in linear.models]
    assert names == ["filling", "venting", "mean of filling and venting"]
    for model in linear.models[:2]:
        found = eigenvalues(model)
        assert np.sort_complex(found) == pytest.approx(np.sort_complex(poles), abs=1e-6 * abs(poles).max())
        steady = exponent * 287.05 * 293.15 * gains[model.name] * area / volume / (stiffness + back)
        time = np.linspace(0.0, 4.0, 401)
        rate = np.diff(step_response(model, "command", "position", time, 1.0))[-1] / (time[1] - time[0])
        assert rate == pytest.approx(steady, rel=1e-6)


def test_each_side_of_a_valve_has_its_own_dead_time() -> None:
    given = drive("propneu-20")
    filling, venting, both = linearise(given).models
    opening, closing = dead_times(given)
    assert opening < closing
    assert (filling.dead_time, venting.dead_time, both.dead_time) == (opening, closing, closing)


def test_a_valve_with_a_dead_band_is_linearised_at_its_edges() -> None:
    linear = linearise(drive("valve with dead band"))
    plain = linearise(drive("valve"))
    assert linear.dead_band == pytest.approx((-0.04, 0.04), abs=1e-8)
    for own, other in zip(linear.models, plain.models, strict=True):
        assert own.name == other.name
        # The spool moves the flow over the rest of the span, 1 - 4 %.
        assert own.b[:, 0] == pytest.approx(other.b[:, 0] / 0.96, rel=1e-6)
        assert own.a == pytest.approx(other.a, rel=1e-6, abs=1e-7)
    assert any(text.startswith("dead band") for text in linear.lost)


def test_a_regulator_with_play_has_a_dead_band() -> None:
    linear = linearise(drive("regulator with hysteresis"))
    plain = linearise(drive("regulator")).models[0]
    assert linear.dead_band is not None
    low, high = linear.dead_band
    assert high - low == pytest.approx(0.01, abs=1e-6)
    pole = eigenvalues(plain)[1]  # of the mechanics and the air nothing changes
    for model in linear.models:
        assert np.abs(eigenvalues(model) - pole).min() == pytest.approx(0.0, abs=1e-6 * abs(pole))


def test_a_joint_with_play_is_linearised_where_both_muscles_react() -> None:
    document = preset_document("joint-20", STUDIO)
    annotated = drive_of(document, STUDIO)
    linear = linearise(annotated.drive)
    effects = {name: dict(own) for name, own in annotated.start.effects.items() if name != "valve_hysteresis"}
    without = linearise(drive_of(document.model_copy(update={"effects": effects}), STUDIO).drive)
    expected = static_gain(without.primary, "command", "position")
    assert linear.primary.name == "mean of filling and venting"
    assert expected is not None
    for model in linear.models:
        gain = static_gain(model, "command", "position")
        if "held" in model.name:  # by the presliding of both muscles
            assert gain is not None
            assert gain < 0.5 * expected
        else:
            assert gain == pytest.approx(expected, rel=0.05), model.name


def test_a_muscle_without_a_load_has_no_tension() -> None:
    free = drive("regulator")
    free = replace(free, load=replace(free.load, mass=0.0))
    with pytest.raises(InputError, match="hangs slack") as caught:
        linearise(free, Condition("position", 0.03))
    assert "a load that pulls" in (caught.value.hint or "")


def test_friction_holds_and_slides() -> None:
    linear = linearise(drive("friction"))
    held, shorter, longer, mean = linear.models
    assert [held.name, shorter.name, longer.name] == ["held", "sliding shorter", "sliding longer"]
    assert linear.primary is mean
    assert not linear.smooth
    # While it slides its friction is constant: like 10 N more, or less, on the load.
    for model, force in ((shorter, 10.0), (longer, -10.0)):
        plain = drive("regulator")
        plain = replace(plain, load=replace(plain.load, force=force))
        same = linearise(plain, Condition("position", linear.point.position)).models[0]
        assert model.states == same.states
        assert model.a == pytest.approx(same.a, rel=1e-6, abs=1e-9 * np.abs(same.a).max())
        assert model.b == pytest.approx(same.b, rel=1e-6, abs=1e-9)
    # 10 N more than the 98 N of the load, by F = p A at the same position.
    balance = (10.0 * 9.80665 + 10.0) / (10.0 * 9.80665)
    above, below = (model.point.pressure - linear.point.pressure for model in (shorter, longer))
    assert above == pytest.approx(-below, rel=1e-6)
    assert above / linear.point.pressure < balance - 1.0  # the bladder carries a share
    gains = [
        abs(step_response(m, "command", "position", np.linspace(0, 0.3, 31), 0.01)[-1])
        for m in (held, shorter)
    ]
    assert gains[0] == 0.0 < gains[1]
    assert "until the net force on it has grown by 10 N upwards or 10 N downwards" in held.text
    assert any(text.startswith("friction") for text in linear.lost)


def test_sliding_at_a_stated_speed_has_the_slope_of_the_law_there() -> None:
    """Stribeck: F_c (1 + s exp(-v/v_s)) falls by F_c s/v_s exp(-v/v_s) per speed, against the damping."""
    document = read_document(DOCUMENTS["friction"], "the drive")
    coulomb = {"force": "10 N", "static_share": 0.5, "stribeck_speed": "5 mm/s"}
    effects = {**(document.effects or {}), "coulomb_friction": coulomb}
    given = drive_of(document.model_copy(update={"effects": effects}), STUDIO).drive
    damping = {}
    for speed in (1e-9, 2e-3, 1e-2, 0.3):
        linear = linearise(given, Condition("position", 0.02), sliding_speed=speed)
        model = next(each for each in linear.models if each.name.startswith("sliding shorter"))
        row = [state.name for state in model.states].index("speed")
        damping[speed] = -model.a[row, row] * (given.load.mass + given.own_mass)
        assert ("slopes at" in model.text) == (speed != 1e-9)
    for speed in (1e-9, 2e-3, 1e-2):
        falls = 10.0 * 0.5 / 5e-3 * np.exp(-speed / 5e-3)
        assert damping[0.3] - damping[speed] == pytest.approx(falls, rel=1e-6)
    with pytest.raises(InputError, match="sliding speed"):
        linearise(given, sliding_speed=0.0)


@pytest.mark.parametrize("effect", ["dahl", "bouc_wen", "maxwell_slip"])
def test_friction_with_memory_holds_like_a_spring(effect: str) -> None:
    given = drive(effect)
    linear = linearise(given)
    held = linear.models[0]
    assert held.name == "held"
    assert deviation(linear, given, "command", 1e-4, 0.6) < 0.02  # 0.8 %; a larger step slides a little
    gains = [static_gain(model, "command", "position") for model in (held, linear.primary)]
    assert gains[0] is not None
    assert gains[1] is not None
    assert gains[0] < 0.5 * gains[1]
    if effect == "dahl":  # F/x_b over the mass of 10 kg, with the way of 0.2 % of 300 mm
        names = [state.name for state in held.states]
        speed, share = names.index("speed"), names.index("dahl.presliding")
        force = next(each for each in given.model.effects if each.id == "dahl").parameters[0].default
        stiffness = -held.a[speed, share] * held.a[share, speed]
        assert stiffness == pytest.approx(force / 0.6e-3 / 10.0, rel=1e-6)


def test_what_is_lost_is_said() -> None:
    lost = " ".join(linearise(drive("propneu-20")).lost)
    for words in (
        "saturation",
        "end stops: 96.13 mm below",
        "another flow for filling",
        "38.1 ms off",
        "slack",
    ):
        assert words in lost


@pytest.mark.parametrize(
    ("name", "condition", "message"),
    [
        ("regulator", Condition("position", 0.2), "not between the ends"),
        ("regulator", Condition("pressure", 7e5), "not between 0 and the 6 bar"),
        ("regulator", Condition("command", 1.2), "not between 0 and 1"),
        ("valve", Condition("command", 0.1), "fills or vents without end"),
        ("paper-ramp", None, "does not move"),
    ],
)
def test_no_equilibrium_is_a_sentence(name: str, condition: Condition | None, message: str) -> None:
    with pytest.raises(InputError, match=message) as caught:
        linearise(drive(name), condition)
    assert caught.value.field == "at"


def test_a_load_too_heavy_says_what_can_be_held() -> None:
    heavy = drive("regulator")
    heavy = replace(heavy, load=replace(heavy.load, mass=90.0))
    with pytest.raises(InputError, match="the load pulls") as caught:
        linearise(heavy, Condition("position", 0.07))
    assert "can be held" in (caught.value.hint or "")


def test_on_its_stop_only_the_air_moves() -> None:
    linear = linearise(drive("regulator"), Condition("pressure", 0.2e5))
    (model,) = linear.models
    assert model.name == "on the stop"
    assert "speed" not in [state.name for state in model.states]
    assert "the load rests on one" in " ".join(linear.lost)


def test_every_drive_preset_is_linearised_or_says_why_not() -> None:
    for name in ("paper-hysteresis", "paper-step", "paper-step-mpye", "propneu-10", *DOCUMENTS):
        linear = linearise(drive(name))
        for model in linear.models:
            assert np.isfinite(model.a).all()
            assert np.isfinite(model.b).all()
            assert np.isfinite(model.c).all()
