"""Dry friction sticks: beside an integration written on its own (`sticking.DryRig`), closed forms, energy."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import atan, pi, sqrt

import numpy as np
import pytest
from scipy.optimize import brentq

from mckibben.documents.drive_reading import drive_of, read_document
from mckibben.physics import ops
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError
from mckibben.simulation.command.shapes import Ramp, Step
from mckibben.simulation.drive.controlled import simulate_controlled
from mckibben.simulation.drive.many_runs import readings_of_many
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import Run, held_interval, segments_of, simulate
from mckibben.simulation.statics.model import StaticModel
from tests.shipped import shipped_studio
from tests.simulation.drive.sticking import DryRig, HuntingRig
from tests.simulation.lsoda import simulated

STUDIO = shipped_studio()
POSITION = 1e-5  # m


def drive(document: dict) -> Drive:
    return drive_of(read_document(document, "the drive"), STUDIO).drive


def held(**changed) -> dict:
    """A load that is pulled down by 100 N from 10 s on and let go until 14 s."""
    document = {
        "muscle": {"preset": "DMSP-20", "nominal_length": "300 mm"},
        "effects": {"bladder_elasticity": {}, "coulomb_friction": {"force": "50 N"}},
        "supply": {"pressure": "4 bar"},
        "valve": {"sonic_conductance": "1 l/(s*bar)"},
        "load": {
            "mass": "20 kg", "arrangement": "hanging",
            "force": {"shape": "table", "times": [0, 10, 12, 14], "values": [0, 0, 100, 0]},
        },
        "command": {"shape": "step", "at": "0 s"},
        "duration": "110 s",
    }  # fmt: skip
    document["load"]["force"]["interpolation"] = "linear"
    document["effects"] |= changed.pop("effects", {})
    return {**document, **changed}


RIGS = {
    "held": DryRig(
        mass=20.0, spring=3000.0, drag=60.0, supply=4e5, fill=4e-9, kinetic=50.0, end=100.0,
        course=((0.0, 10.0, 12.0, 14.0), (0.0, 0.0, 200.0, 0.0)),
    ),
    "breaking away above the kinetic friction, which grows with pressure": DryRig(
        mass=20.0, spring=3000.0, drag=60.0, supply=4e5, fill=4e-9, kinetic=30.0, excess=0.5,
        per_pressure=4e-5, course=((0.0, 4.0, 6.0, 8.0, 10.0), (0.0, 0.0, 150.0, -100.0, 0.0)), end=10.0,
    ),
    "rebounding": DryRig(
        mass=20.0, spring=3000.0, drag=20.0, supply=4e5, kinetic=50.0, restitution=0.5, highest=0.15, end=4.0,
        course=((0.0, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0), (0.0, 0.0, 300.0, -250.0, 300.0, 0.0, 0.0)),
    ),
    "vented in parts": DryRig(
        mass=20.0, spring=3000.0, drag=60.0, supply=4e5, fill=4e-9, kinetic=20.0, excess=0.3, end=12.0,
        commands=((0.0, 1.0), (1.0, 0.0), (4.0, -0.2), (4.3, 0.0), (8.0, 0.3), (8.3, 0.0)),
    ),
}  # fmt: skip
STATES = {"slides_up": "up", "slides_down": "down"}


@pytest.mark.parametrize("name", ["held", "rebounding"])
def test_sticking_is_that_of_an_integration_written_on_its_own(name: str) -> None:
    rig = replace(RIGS[name], changes=[], hits=[])
    run = simulate(drive(rig.document), points=2001)
    start = [float(run.states[state][0]) for state in ("stroke", "speed", "pressure", "gas_mass")]
    rows = rig.followed(run.time, np.array(start), rtol=1e-9)
    assert np.max(np.abs(run.states["stroke"] - rows[:, 0])) <= POSITION
    # Near the edge of its range a load creeps with the temperature of the gas, at instants that mean little.
    begins = [(at, state) for at, state in rig.changes if state in ("up", "down") and at > 10.0]
    assert name != "held" or len(begins) == 2
    for at, state in begins:
        assert any(
            STATES.get(event.switch) == state and event.begins and abs(event.time - at) < 5e-3
            for event in run.events
        ), (at, state)


@pytest.mark.examination("test_sticking_is_that_of_an_integration_written_on_its_own")
@pytest.mark.parametrize("name", [name for name in RIGS if name not in ("held", "rebounding")])
def test_more_sticking_is_that_of_an_integration_written_on_its_own(name: str) -> None:
    test_sticking_is_that_of_an_integration_written_on_its_own(name)


@pytest.mark.parametrize("integrator", [simulate, simulated], ids=["rodas", "lsoda"])
def test_a_held_load_stays(integrator: Callable[..., Run]) -> None:
    run = integrator(drive(held()), points=11001)
    model, stroke = run.drive.model, run.states["stroke"]
    # Up to 12 s the load is pulled to where 4 bar carry 20 kg and 100 N less the friction, and at 14 s let go
    # to where they carry 20 kg and the friction: to the same place.
    carried = 20.0 * 9.80665 + 50.0

    def missing(stroke: float) -> float:
        return float(model.force(length=0.3 - stroke, pressure=4e5)[0]) - carried

    at_rest = float(brentq(missing, 0.02, 0.07))
    assert stroke[[1200, 1400, -1]] == pytest.approx(at_rest, abs=5e-5)
    assert stroke[-1] == pytest.approx(48.76e-3, abs=1e-5)
    late = stroke[run.time >= 14.2]
    assert np.ptp(late) < 1e-9
    assert run.outputs["friction"][-1] == pytest.approx(-50.0, abs=0.2)
    assert run.outputs["friction_share"][-1] == pytest.approx(1.0, abs=0.005)
    # The muscle carries what hangs on it, whatever its friction takes.
    stuck = (run.time > 1.0) & (run.time < 10.0)
    assert run.outputs["force"][stuck] == pytest.approx(20.0 * 9.80665, abs=1e-9)


def test_laws_add_up_to_one_range() -> None:
    """The pull at which a load breaks away downwards lies the sum of both ranges above the one upwards."""
    effects = {"pressure_friction": {"area": "4 N/bar"}}
    force = {
        "shape": "table",
        "times": [0, 10, 40, 70],
        "values": [0, 0, 300, -100],
        "interpolation": "linear",
    }
    document = held(effects=effects, duration="70 s")
    document["load"]["force"] = force
    run = simulate(drive(document), points=7001)
    pull = [float(np.interp(event.time, *(force["times"], force["values"]))) for event in run.events]
    reversal = [
        each for each, event in zip(pull, run.events, strict=True) if event.begins and event.time > 40.0
    ]
    # 50 N and 4 N/bar at 4 bar, on both sides; the ramp stops where it was at 300 N.
    assert 300.0 - reversal[0] == pytest.approx(2.0 * (50.0 + 16.0), abs=0.5)


def test_a_pair_that_is_pulled_and_let_go_stays() -> None:
    force = {"shape": "table", "times": [0, 10, 11, 12], "values": [0, 0, 60, 0], "interpolation": "linear"}
    document = {
        "muscle": {"preset": "DMSP-20", "nominal_length": "300 mm"},
        "effects": {
            "bladder_elasticity": {}, "coulomb_friction": {"force": "15 N"},
            "pressure_friction": {"area": "2 N/bar"}, "viscous_damping": {"coefficient": "60 N*s/m"},
        },
        "supply": {"pressure": "4 bar"}, "valve": {"preset": "VPPM-6"},
        "load": {"mass": "4 kg", "arrangement": "antagonist", "pulley_radius": "20 mm", "force": force},
        "command": {"shape": "step", "at": "0 s", "level": 0.3, "initial": 0.3}, "duration": "60 s",
    }  # fmt: skip
    run = simulate(drive(document), points=6001)
    assert np.ptp(run.states["stroke"][run.time >= 13.0]) < 1e-9
    assert np.ptp(run.states["stroke"]) > 1e-4
    assert run.events[-1].switch.startswith("slides")
    assert not run.events[-1].begins


def work(run: Run, force: np.ndarray) -> float:
    """Work of a force along the stroke [J]."""
    steps = np.diff(run.states["stroke"])
    return float(np.sum(0.5 * (force[1:] + force[:-1]) * steps))


def test_friction_only_takes_energy() -> None:
    document = held(duration="20 s", effects={"viscous_damping": {"coefficient": "60 N*s/m"}})
    run = simulate(drive(document), grid=np.linspace(0.0, 20.0, 400_001), tolerance=1e-8)
    taken = work(run, run.outputs["friction"])
    assert taken < -1.0
    power = run.outputs["friction"] * run.states["speed"]
    assert np.max(power) <= 1e-9
    # The tension of the muscle contains its friction: its work is that of lift, external force and motion.
    lifted = 20.0 * 9.80665 * (run.states["stroke"][-1] - run.states["stroke"][0])
    external = work(run, run.outputs["external_force"])
    moving = 0.5 * (20.0 + run.drive.own_mass) * run.states["speed"][-1] ** 2
    assert work(run, run.outputs["force"]) == pytest.approx(lifted + external + moving, abs=2e-3)


def dry_guide(**values: float) -> tuple[Effect, dict[str, float]]:
    """A guide with a static friction above the kinetic one and nothing between: a textbook's law."""
    plain = default_catalogue()["guide_friction"]

    def guide(*, direction, speed, force, static_share):
        excess = ops.where(ops.greater(ops.absolute(speed), 0.0), 0.0, static_share)
        return force * (1.0 + excess) * direction

    own = tuple(each for each in plain.parameters if each.name in ("force", "static_share"))
    effect = replace(plain, slots={"guide": guide}, parameters=own, states=(), id="dry_guide")
    return effect, {**effect.defaults, **values}


def belt(*, speed: float, stiffness: float, static: float, kinetic: float, duration: float) -> Drive:
    """A mass of 1 kg on a spring and a belt, in the coordinate of the belt: the spring's end moves."""
    document = held(duration=f"{duration} s")
    base = drive(document)
    effect, values = dry_guide(force=kinetic, static_share=static / kinetic - 1.0)
    model = StaticModel.of(base.muscle._replace(nominal_length=1.0), (effect,), {"dry_guide": values})
    ramp = Ramp(begin=0.0, end=-stiffness * speed * duration, start=0.0, duration=duration)
    load = replace(base.load, mass=1.0, inclination=0.0, spring=stiffness, force=ramp)
    return replace(
        base, model=model, load=load, command=Step(level=0.0, initial=0.0), own_mass=0.0, duration=duration
    )


@pytest.mark.parametrize("speed", [0.01, 0.02])
def test_the_textbook_mass_on_a_belt(speed: float) -> None:
    """Period of stick-slip in closed form: a sine while it slips, a ramp of the spring while it sticks."""
    stiffness, static, kinetic = 1000.0, 5.0, 3.0
    given = belt(speed=speed, stiffness=stiffness, static=static, kinetic=kinetic, duration=5.0)
    run = simulate(given, points=5001)
    omega, drop = sqrt(stiffness), static - kinetic
    slips = 2.0 / omega * (pi - atan(drop * omega / (stiffness * speed)))
    expected = slips + 2.0 * drop / (stiffness * speed)
    begins = np.array([event.time for event in run.events if event.switch == "slides_up" and event.begins])
    assert len(begins) > 5
    assert np.diff(begins)[1:] == pytest.approx(expected, rel=1e-3)


def hunting(share: float, *, duration: float = 20.0) -> Run:
    document = {
        "muscle": {"preset": "DMSP-20", "nominal_length": "300 mm"},
        "effects": {
            "bladder_elasticity": {}, "viscous_damping": {"coefficient": "100 N*s/m"},
            "coulomb_friction": {"force": "30 N", "static_share": share, "stribeck_speed": "2 mm/s"},
        },
        "supply": {"pressure": "7 bar"}, "valve": {"sonic_conductance": "1 l/(s*bar)"},
        "regulator": {"range": "6 bar", "time": "30 ms"},
        "load": {"mass": "10 kg", "arrangement": "hanging"},
        "controller": {
            "type": "pid", "kp": 1.0, "ki": 5.0,
            "reference": {"shape": "step", "at": "0.5 s", "level": "20 mm"},
        },
        "duration": f"{duration} s",
    }  # fmt: skip
    return simulate_controlled(drive(document), grid=np.linspace(0.0, duration, 2001))


def test_a_controller_with_an_integral_hunts_where_static_friction_exceeds_the_kinetic() -> None:
    run = hunting(0.5)
    late = run.time > 10.0
    assert np.ptp(run.states["stroke"][late]) > 1e-3
    begins = [event.time for event in run.events if event.switch == "slides_up" and event.begins]
    period = np.diff([at for at in begins if at > 10.0])
    assert len(period) >= 3
    assert np.ptp(period) < 0.02 * np.mean(period)
    calm = hunting(0.0)
    assert np.ptp(calm.states["stroke"][late]) < 1e-5  # Coulomb's law alone does not hunt


@pytest.mark.examination("test_a_controller_with_an_integral_hunts_where_static_friction_exceeds_the_kinetic")
def test_hunting_is_that_of_a_controller_and_a_drive_written_on_their_own() -> None:
    rig = HuntingRig(
        mass=10.0, spring=3000.0, drag=100.0, supply=7e5, fill=1e-8, exhaust=1e-8, kinetic=30.0, excess=0.5,
        stribeck=2e-3, end=14.0, kp=2.0, ki=20.0,
    )  # fmt: skip
    strokes, breaks = rig.hunts(rig.end)
    grid = rig.sample * np.arange(len(strokes))
    run = simulate_controlled(drive(rig.document), grid=grid)
    begins = [event.time for event in run.events if event.switch == "slides_up" and event.begins]
    assert begins == pytest.approx(breaks, abs=1e-3)
    assert np.diff(begins)[2:] == pytest.approx(np.diff(breaks)[2:], rel=1e-3)
    assert np.max(np.abs(run.states["stroke"] - strokes)) <= POSITION
    assert np.ptp(strokes[grid > 7.0]) > 4e-3


def test_lanes_give_the_numbers_of_a_run_alone() -> None:
    drives = [
        drive(held(duration="16 s", effects={"coulomb_friction": {"force": f"{force} N"}}))
        for force in np.linspace(0.0, 80.0, 9)
    ]
    grid = np.linspace(0.0, 16.0, 161)
    many = readings_of_many(drives, [segments_of(each)[:2] for each in drives], grid=grid)
    for each, found in zip(drives, many, strict=True):
        alone = simulate(each, grid=grid)
        assert np.array_equal(found["stroke_reading"], alone.outputs["stroke_reading"])


def test_friction_without_force_changes_nothing_and_has_no_events() -> None:
    off = held(duration="16 s", effects={"coulomb_friction": {"force": "0 N"}})
    without = held(duration="16 s")
    del without["effects"]["coulomb_friction"]
    one, other = (simulate(drive(each), points=161, tolerance=1e-8) for each in (off, without))
    assert one.states["stroke"] == pytest.approx(other.states["stroke"], abs=1e-8)
    assert [event for event in one.events if event.switch.startswith("slides")][1:] == []


@pytest.mark.parametrize("pressure", [2e5, 4e5])
def test_the_start_is_an_interval_whose_ends_can_be_stated(pressure: float) -> None:
    """Its ends carry 20 kg and the friction, or 20 kg less the friction: static curves know both branches."""
    document = held(duration="1 s", start_pressure=pressure)
    document["command"] = {"shape": "step", "level": 0.0, "initial": 0.0}
    base = drive(document)

    def balance(direction: float) -> float:
        def missing(stroke: float) -> float:
            force = base.model.force(length=0.3 - stroke, pressure=pressure, direction=direction)
            return float(force[0]) - 20.0 * 9.80665

        return float(brentq(missing, 0.0, 0.075, xtol=1e-14))

    # A muscle that shortens pulls less: the load comes to rest lower.
    low, high = balance(-1.0), balance(1.0)
    assert held_interval(base) == pytest.approx((low, high), abs=1e-9)
    for reached, expected in (("from below", low), ("from above", high), (None, balance(0.0))):
        run = simulate(drive({**document, "start": {"reached": reached} if reached else {}}), points=11)
        assert run.states["stroke"] == pytest.approx(expected, abs=1e-9)
        assert len(run.events) == 0
        if reached:
            assert reached in run.start.why.value
    with pytest.raises(InputError, match="has not come to rest there"):
        drive({**document, "start": {"reached": "from below", "position": "10 mm"}})


@pytest.mark.parametrize("dwell", [2.0, 6.0])
def test_a_law_may_grow_with_the_time_at_rest(dwell: float) -> None:
    """Its age is a state of the effect: it grows while the load sticks, and the guard knows it."""
    kinetic, share, time = 10.0, 0.5, 3.0

    def guide(*, direction, age, force):
        return force * (1.0 + share * (1.0 - ops.exp(-age / time))) * direction

    def drive_rates(*, speed, age):
        return (1.0 - 1e3 * age * ops.absolute(speed),)

    plain = default_catalogue()["guide_friction"]
    age = replace(plain.states[0], name="age", unit="s", initial=0.0)
    own = tuple(each for each in plain.parameters if each.name == "force")
    slots = {"guide": guide, "drive_rates": drive_rates}
    effect = replace(plain, slots=slots, parameters=own, states=(age,), id="aging_guide")
    base = drive(held(duration=f"{dwell + 2.0} s"))
    model = StaticModel.of(base.muscle, (effect,), {"aging_guide": {"force": kinetic}})
    pull = Ramp(begin=0.0, end=-40.0, start=dwell, duration=2.0)
    given = replace(
        base, model=model, load=replace(base.load, inclination=0.0, force=pull),
        command=Step(level=0.0, initial=0.0), start_position=0.02,
    )  # fmt: skip
    run = simulate(given, points=101)
    (breaks,) = [event.time for event in run.events if event.switch == "slides_up" and event.begins]
    # 20 N/s pull until they reach the friction of that age.
    expected = brentq(
        lambda t: 20.0 * (t - dwell) - kinetic * (1.0 + share * (1.0 - np.exp(-t / time))), dwell, dwell + 2.0
    )
    assert breaks == pytest.approx(expected, abs=1e-4)
