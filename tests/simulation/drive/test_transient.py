"""The engine against closed forms, conservation laws and an independent integrator."""

from __future__ import annotations

from math import cos, pi, radians, sqrt, tan

import numpy as np
import pytest

from mckibben.physics import gas
from mckibben.physics.muscle import Muscle
from mckibben.physics.units import GRAVITY
from mckibben.simulation.command.signals import signal_from
from mckibben.simulation.drive.parts import Drive, Load, Tube, Valve
from mckibben.simulation.drive.transient import simulate
from mckibben.simulation.statics.model import StaticModel
from tests.simulation.event_radau import strokes
from tests.simulation.lsoda import simulated

MUSCLE = Muscle(0.8, 0.0218, radians(26.5), 0.0018, 0.02)
EFFECTS = {"bladder_elasticity": {}, "prestress": {"force": 25.0}}
ATMOSPHERE = 101325.0
SHUT = Valve(0.0, 0.0)


def command(**shape):
    return signal_from(shape, unit="1", field="command")


def drive(**changes) -> Drive:
    parts = {
        "model": StaticModel(MUSCLE, EFFECTS),
        "valve": Valve(2e-8, 3e-8),
        "load": Load(mass=8.0),
        "command": command(shape="pulse", on="0 s", off="2 s", level=1.0, initial=-1.0),
        "duration": 4.0,
        "supply_pressure": 6e5,
    }
    return Drive(**{**parts, **changes})


def braid_volume(length):
    b = MUSCLE.nominal_length / cos(MUSCLE.braid_angle)
    n = MUSCLE.nominal_length * tan(MUSCLE.braid_angle) / (pi * MUSCLE.braid_diameter)
    return length * (b**2 - length**2) / (4 * pi * n**2)


def oscillation(exponent: float, *, shut: bool) -> tuple[float, float]:
    """Angular frequency of a small oscillation around equilibrium, and the one expected of sqrt(k/M)."""
    model = StaticModel(MUSCLE)
    mass, pressure = 30.0, 3e5
    start = drive(
        model=model,
        valve=SHUT if shut else Valve(1e-3, 1e-3),
        load=Load(mass=mass),
        supply_pressure=pressure,
        start_pressure=pressure,
        command=command(shape="step", at="0 s", level=0.0 if shut else 1.0, initial=0.0 if shut else 1.0),
        polytropic_exponent=exponent,
        duration=2.0,
    )
    # A short extra force lets it swing.
    kick = signal_from(
        {"shape": "pulse", "on": "0 s", "off": "0.02 s", "level": "2 N"}, unit="N", field="load.force"
    )
    start = drive(**{**start.__dict__, "load": Load(mass=mass, force=kick)})
    run = simulate(start, points=8001, tolerance=1e-9)
    stroke = run.states["stroke"]
    middle = 0.5 * (stroke[run.time > 0.1].max() + stroke[run.time > 0.1].min())
    signal = stroke - middle
    late = run.time > 0.1
    t, y = run.time[late], signal[late]
    up = np.flatnonzero((y[:-1] < 0) & (y[1:] >= 0))
    crossings = t[up] - y[up] * (t[up + 1] - t[up]) / (y[up + 1] - y[up])
    frequency = 2 * pi / np.mean(np.diff(crossings))
    length = MUSCLE.nominal_length - middle
    curves = model.curves(
        np.array([float(np.mean(run.pressure[late]))]), np.array([length]), polytropic_exponent=exponent
    )
    stiffness = curves.stiffness_closed[0, 0] if shut else curves.stiffness[0, 0]
    return frequency, sqrt(stiffness / mass)


@pytest.mark.parametrize("exponent", [1.0, 1.4])
def test_small_oscillation_of_a_closed_muscle(exponent):
    found, expected = oscillation(exponent, shut=True)
    assert found == pytest.approx(expected, rel=1e-3)


def test_small_oscillation_at_constant_pressure():
    found, expected = oscillation(1.0, shut=False)
    assert found == pytest.approx(expected, rel=1e-3)


@pytest.mark.parametrize("exponent", [1.0, 1.4])
def test_closed_chamber_keeps_p_v_to_the_n(exponent):
    pull = signal_from(
        {"shape": "sine", "amplitude": "60 N", "frequency": "1 Hz"}, unit="N", field="load.force"
    )
    shut = drive(
        valve=SHUT,
        command=command(shape="step", at="0 s", level=0.0),
        start_pressure=4e5,
        load=Load(mass=20.0, force=pull),
        polytropic_exponent=exponent,
    )
    run = simulate(shut, tolerance=1e-9)
    assert np.ptp(run.states["stroke"]) > 0.001
    product = run.states["pressure"] * run.outputs["volume"] ** exponent
    assert np.max(np.abs(product / product[0] - 1)) < 1e-6


def test_choked_filling_follows_the_closed_form():
    # Blocked muscle: dp/dt = n C rho0 ps R T / V, a straight line while choked.
    blocked = drive(
        model=StaticModel(MUSCLE),
        load=Load(mass=8.0, force=1e4),
        max_contraction=0.01,
        duration=0.05,
        polytropic_exponent=1.2,
    )
    run = simulate(blocked, points=501)
    rate = 1.2 * 2e-8 * gas.ANR_DENSITY * (6e5 + ATMOSPHERE) * gas.GAS_CONSTANT * 293.15
    rate /= braid_volume(0.8 - run.states["stroke"][0])
    assert np.max(run.outputs["fill_pressure_ratio"]) < 0.95
    choked = run.outputs["fill_pressure_ratio"] < 0.299
    expected = run.pressure[0] + rate * run.time
    assert run.pressure[choked] == pytest.approx(expected[choked], rel=2e-3, abs=50.0)


def test_choked_exhaust_decays_with_its_time_constant():
    blocked = drive(
        load=Load(mass=8.0, force=1e4),
        command=command(shape="step", at="0 s", level=-1.0, initial=-1.0),
        start_pressure=6e5,
        max_contraction=0.01,
        duration=0.2,
        polytropic_exponent=1.0,
    )
    run = simulate(blocked, points=401)
    volume = braid_volume(0.8 - run.states["stroke"][0])
    tau = volume / (3e-8 * gas.ANR_DENSITY * gas.GAS_CONSTANT * 293.15)
    choked = run.outputs["exhaust_pressure_ratio"] < 0.299
    expected = (6e5 + ATMOSPHERE) * np.exp(-run.time / tau)
    assert np.count_nonzero(choked) > 20
    assert run.states["pressure"][choked] == pytest.approx(expected[choked], rel=2e-3)


def test_a_slack_muscle_lets_the_load_fall_freely():
    run = simulate(drive(duration=3.0), points=6001)
    acceleration, contact = run.outputs["acceleration"], run.outputs["contact"]
    slack = (run.outputs["force"] == 0.0) & (contact == 0.0)
    assert np.count_nonzero(slack) > 100
    assert acceleration[slack] == pytest.approx(-GRAVITY, abs=1e-12)
    assert np.min(acceleration[contact == 0.0]) > -GRAVITY - 1e-9


def test_every_gram_of_air_is_accounted_for():
    run = simulate(drive(), points=40001, tolerance=1e-9)
    flow = run.outputs["mass_flow"]
    inflow = np.concatenate([[0.0], np.cumsum(0.5 * (flow[1:] + flow[:-1]) * np.diff(run.time))])
    balance = run.states["supplied"] - run.states["vented"]
    assert balance == pytest.approx(inflow, abs=1e-3 * np.max(run.states["supplied"]))


def test_energy_of_a_lift_is_the_work_of_the_gas():
    run = simulate(drive(duration=0.5), points=40001, tolerance=1e-9)
    free = (run.outputs["contact"] == 0.0) & (run.states["stroke"] < 0.2 - 1e-9)
    first = np.argmax(free & (run.states["stroke"] > 1e-5))
    pulling = run.outputs["force"] > 0.0
    last = first + np.argmin((free & pulling)[first:]) - 1  # before it goes slack or meets the stop
    rows = slice(first, last)
    stroke, speed = run.states["stroke"][rows], run.states["speed"][rows]
    volume, pressure = run.outputs["volume"][rows], run.pressure[rows]
    gas_work = np.sum(0.5 * (pressure[1:] + pressure[:-1]) * np.diff(volume))

    def wall(length):  # neo-Hookean energy and prestress, written on their own
        lam = length / 0.8
        hoop = 1 + (1 - lam**2) / tan(MUSCLE.braid_angle) ** 2
        invariant = lam**2 + hoop + 1 / (lam**2 * hoop) - 3
        return pi * 0.0218 * 0.0018 * 0.8 * 0.468e6 * invariant - 25.0 * length

    stored = wall(0.8 - stroke[-1]) - wall(0.8 - stroke[0])
    kinetic = 0.5 * 8.0 * (speed[-1] ** 2 - speed[0] ** 2)
    potential = 8.0 * GRAVITY * (stroke[-1] - stroke[0])
    assert kinetic > 5.0
    assert gas_work == pytest.approx(stored + kinetic + potential, rel=1e-4)


@pytest.mark.parametrize("tube", [None, Tube(0.004, 1.0)])
def test_against_radau(tube):
    case = drive(tube=tube, duration=2.6)
    run = simulate(case, points=521)
    assert np.max(np.abs(strokes(case, run.start, run.time) - run.states["stroke"])) < 1e-5


def test_another_integrator_gives_the_same_motion():
    case = drive(duration=2.6)
    fast = simulate(case, points=261)
    slow = simulated(case, points=261)
    assert slow.states["stroke"] == pytest.approx(fast.states["stroke"], abs=2e-4)
    assert slow.pressure == pytest.approx(fast.pressure, abs=0.02e5)


def test_a_dead_time_shifts_and_does_not_stretch():
    early = simulate(drive(), points=4001)
    late = simulate(
        drive(command=command(shape="pulse", on="0.1 s", off="2.1 s", level=1.0, initial=-1.0)),
        points=4001,
    )
    shift = 100  # rows of 1 ms
    moved = late.states["stroke"][shift:3000]
    assert moved == pytest.approx(early.states["stroke"][: 3000 - shift], abs=2e-5)


def test_lever_halves_the_force_and_doubles_the_way():
    # One to two: the muscle at 1/2 the load's way carries twice the load.
    direct = simulate(drive(load=Load(mass=32.0, lever_ratio=1.0)))
    geared = simulate(drive(load=Load(mass=8.0, lever_ratio=0.5)))
    # Reflected to the muscle: M/r^2 = 32 kg, but the weight is m g/r = 16 g instead of 32 g.
    assert geared.states["stroke"][-1] == pytest.approx(direct.states["stroke"][-1], abs=1e-4)
    assert np.max(geared.states["stroke"]) > np.max(direct.states["stroke"])


def test_a_rigid_adiabatic_vessel_is_filled_with_the_enthalpy_of_the_supply():
    # First law, m_1 c_v T_1 = m_0 c_v T_0 + (m_1 - m_0) c_p T_0, whatever the valve does on the way.
    rigid = drive(
        model=StaticModel(MUSCLE, {"heat_exchange": {"coefficient": 0.0}}),
        load=Load(mass=8.0, force=1e5),
        max_contraction=0.01,
        duration=1.0,
    )
    run = simulate(rigid, points=101, tolerance=1e-9)
    first, last = ATMOSPHERE, 6e5 + ATMOSPHERE
    expected = 1.4 * 293.15 * last / (last + 0.4 * first)
    assert run.pressure[-1] == pytest.approx(6e5, rel=1e-3)
    assert run.outputs["gas_temperature"][-1] == pytest.approx(expected, rel=1e-5)
