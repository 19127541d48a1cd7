"""Transients of the truth generator: conservation of gas and energy, flow by closed forms, valves."""

from __future__ import annotations

from math import pi, radians, sqrt

import numpy as np
import pytest

from tests.truth import valves
from tests.truth.air import eckersten, iso_flow, nozzle_flow
from tests.truth.commands import STEPS, command_at
from tests.truth.drive import STEP, run
from tests.truth.muscle import GRAVITY, Muscle
from tests.truth.plant import Plant, Trace

MUSCLE = Muscle(0.3, 0.0218, radians(26.5), 0.0018, 0.02)
PLANT = Plant(
    MUSCLE.nominal, MUSCLE.thread, MUSCLE.turns, damping=150.0, mass=30.0, weight=30.0 * GRAVITY, fill=2e-9,
    vent=2e-9,
)  # fmt: skip
START = 30.0 * GRAVITY / float(MUSCLE.area(np.array(0.28)))


def ran(plant: Plant, *, opening: float | None = None, seconds: float = 1.0, start: float = START) -> Trace:
    """A run with the usual steps, or a constant opening."""
    every, rows = 20, round(seconds / (20 * STEP)) + 1
    grid = np.arange(2 * every * (rows - 1) + 1) * 0.5 * STEP
    command = command_at(grid, STEPS) if opening is None else np.full_like(grid, opening)
    return run(plant, rows=rows, every=every, opening=command, start_gauge=start)


def test_choked_flow_is_conductance_times_density_times_pressure():
    assert iso_flow(7e5, 1e5, 1e-8, 0.3, 293.15) == pytest.approx(8.295e-3, rel=1e-12)
    assert nozzle_flow(7e5, 1e5, 1e-8, 293.15) == pytest.approx(8.295e-3, rel=1e-12)
    assert iso_flow(4e5, 4e5, 1e-8, 0.3, 293.15) == 0.0


def test_nozzle_is_choked_below_the_ratio_of_air():
    edge = 0.528282
    choked = nozzle_flow(5e5, 1e5, 1e-8, 293.15)
    assert nozzle_flow(5e5, 5e5 * (edge - 1e-3), 1e-8, 293.15) == pytest.approx(choked, rel=1e-9)
    assert nozzle_flow(5e5, 5e5 * (edge + 0.05), 1e-8, 293.15) < 0.999 * choked


def test_tube_conductance_has_the_published_value():
    # 4 mm by 1 m: 1.20 l/(s bar)
    assert eckersten(4e-3, 1.0)[0] == pytest.approx(1.20e-8, rel=5e-3)


def test_a_load_at_rest_stays_at_rest_with_the_valve_closed():
    trace = ran(PLANT, opening=0.0)
    assert np.ptp(trace.stroke) < 1e-9
    assert trace.stroke[0] == pytest.approx(0.02, abs=1e-8)


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"leak_laminar": 1e-16, "heat": 30.0, "wall_capacity": 50.0},
        {"tube_length": 2.0, "tube_bore": 4e-3, "tube_lumped": 0.0, "tube_loss": 10.0},
        {"extra_dead": 2e-5, "dead_give": 2e-7, "orifice": 1.0},
    ],
    ids=["plain", "leak and heat", "tube", "dead volume"],
)
def test_gas_is_neither_made_nor_lost(changes: dict[str, float]):
    plant = PLANT._replace(**changes)
    trace = ran(plant, seconds=2.0)
    first, last, tube_last, tube_first = trace.gas_mass
    if not plant.tube_length:
        tube_last = tube_first = 0.0
    came = trace.entered[-1] - trace.leaked[-1]
    assert last + tube_last - first - tube_first == pytest.approx(came, abs=1e-12)
    assert np.max(trace.entered) > 1e-4


def test_a_closed_muscle_follows_the_polytrope():
    # A muscle let go above its rest pressure swings; p V^n stays.
    plant = PLANT._replace(damping=0.0, load_factor=1.0)
    trace = run(
        plant._replace(shake=60.0, shake_frequency=2.0),
        rows=1001,
        every=20,
        opening=np.zeros(40_001),
        start_gauge=START,
    )
    volume = MUSCLE.volume(MUSCLE.nominal - trace.stroke)
    constant = trace.pressure * volume**1.2
    assert np.ptp(trace.stroke) > 1e-3
    assert constant == pytest.approx(np.full_like(constant, constant[0]), rel=1e-7)


def test_a_muscle_without_heat_transfer_is_isentropic():
    plant = PLANT._replace(heat=1e-9, shake=60.0, shake_frequency=2.0)
    trace = run(plant, rows=1001, every=20, opening=np.zeros(40_001), start_gauge=START)
    constant = trace.pressure * MUSCLE.volume(MUSCLE.nominal - trace.stroke) ** 1.4
    assert constant == pytest.approx(np.full_like(constant, constant[0]), rel=1e-6)


def test_a_muscle_with_much_heat_transfer_is_isothermal():
    plant = PLANT._replace(heat=1e4, wall_capacity=1e9, shake=60.0, shake_frequency=1.0)
    trace = run(plant, rows=1001, every=20, opening=np.zeros(40_001), start_gauge=START)
    product = trace.pressure * MUSCLE.volume(MUSCLE.nominal - trace.stroke)
    assert product == pytest.approx(np.full_like(product, product[0]), rel=2e-3)


def test_an_undamped_swing_keeps_its_energy():
    # Let go from a place that is not its rest: with the pressure held, a muscle is a spring of the volume.
    pressure = np.full(40_001, START + 101_325.0 + 2e4)
    plant = PLANT._replace(damping=0.0, driven=1.0)
    trace = run(plant, rows=1001, every=20, opening=np.zeros(40_001), start_gauge=START, pressure=pressure)
    gauge = START + 2e4
    energy = (
        0.5 * plant.mass * trace.speed**2
        + plant.weight * trace.stroke
        - gauge * MUSCLE.volume(MUSCLE.nominal - trace.stroke)
    )
    assert np.max(np.abs(trace.speed)) > 0.01
    assert np.ptp(energy) < 1e-6 * plant.mass * np.max(trace.speed) ** 2


@pytest.mark.parametrize(
    "changes",
    [
        {"drag": 200.0, "drag_power": 0.8, "drag_ratio": 0.7},
        {"rub": 20.0, "rub_way": 2e-4},
        {"guide": 20.0, "guide_way": 2e-4},
    ],
    ids=["drag", "rub", "guide"],
)
def test_friction_never_gives_energy(changes: dict[str, float]):
    pressure = np.full(40_001, START + 101_325.0 + 2e4)
    plant = PLANT._replace(damping=0.0, driven=1.0, **changes)
    trace = run(plant, rows=1001, every=20, opening=np.zeros(40_001), start_gauge=START, pressure=pressure)
    energy = (
        0.5 * plant.mass * trace.speed**2
        + plant.weight * trace.stroke
        - (START + 2e4) * MUSCLE.volume(MUSCLE.nominal - trace.stroke)
    )
    bristle = max(plant.rub * plant.rub_way, plant.guide * plant.guide_way)  # what the bristles may store
    assert energy[-1] < energy[0] - 0.01
    assert np.all(np.maximum.accumulate(energy) - energy[0] <= bristle)


def test_a_closed_end_rings_at_a_quarter_wave():
    # A tube that ends in a large muscle is open there; the valve's end is closed: f = c/(4 l).
    length = 10.0
    plant = PLANT._replace(
        tube_length=length,
        tube_bore=8e-3,
        tube_lumped=0.0,
        fill=5e-9,
        dead=5e-3,
        mass=1e6,
        weight=PLANT.weight,
    )
    every, rows = 10, 2001
    grid = np.arange(2 * every * (rows - 1) + 1) * 0.5 * STEP
    opening = np.where(grid < 0.01, 1.0, 0.0)
    trace = run(plant, rows=rows, every=every, opening=opening, start_gauge=START)
    signal = np.diff(trace.pressure[60:])
    spectrum = np.abs(np.fft.rfft((signal - signal.mean()) * np.hanning(len(signal)), 8 * len(signal)))
    found = np.fft.rfftfreq(8 * len(signal), every * STEP)[np.argmax(spectrum)]
    isothermal = sqrt(287.05 * 293.15)
    assert found == pytest.approx(isothermal / (4.0 * length), rel=0.1)


def test_a_spool_follows_and_is_slewed():
    time = np.arange(20_001) * 2.5e-5
    command = np.where(time > 0.05, 1.0, 0.0)
    free = valves.spool(command, 2.5e-5, 20.0, 0.9, 1e9)
    slewed = valves.spool(command, 2.5e-5, 20.0, 0.9, 10.0)
    assert free[-1] == pytest.approx(1.0, abs=1e-3)
    assert np.max(np.diff(slewed)) <= 10.0 * 2.5e-5 * (1 + 1e-9)


def test_dead_time_moves_edges_by_their_own_times():
    time = np.arange(40_001) * 2.5e-5
    command = np.where((time > 0.2) & (time < 0.6), 1.0, 0.0)
    late = valves.dead_time(time, command, 0.010, 0.016, 2.5e-5)
    assert time[np.argmax(late > 0.5)] == pytest.approx(0.210, abs=1e-4)
    assert time[len(late) - 1 - np.argmax(late[::-1] > 0.5)] == pytest.approx(0.616, abs=1e-4)


def test_relays_lag_behind_by_half_their_width():
    up = np.linspace(-0.8, 0.8, 4001)
    path = np.concatenate([np.linspace(0.0, -0.8, 2000), up, up[::-1]])
    loop = valves.preisach(path, 0.06)
    rising, falling = loop[2000:6001], loop[6001:][::-1]
    gap = (falling - rising)[1000:3000]
    assert gap == pytest.approx(np.full(2000, 0.06), abs=0.012)


def test_overlap_passes_nothing_in_the_middle_and_all_at_the_end():
    opening = valves.overlap(np.array([-1.0, -0.02, 0.0, 0.02, 1.0]), 0.08, 0.01)
    assert opening[[0, 2, 4]] == pytest.approx([-1.0, 0.0, 1.0])
    assert np.max(np.abs(opening[[1, 3]])) < 1e-4


def test_extra_mass_lowers_the_frequency_of_the_swing():
    pressure = np.full(160_001, START + 101_325.0 + 5e3)
    periods = []
    for extra in (0.0, 90.0):
        plant = PLANT._replace(damping=0.0, driven=1.0, extra_mass=extra)
        trace = run(
            plant, rows=4001, every=20, opening=np.zeros(160_001), start_gauge=START, pressure=pressure
        )
        rest = 0.5 * (trace.stroke.max() + trace.stroke.min())
        crossings = trace.time[1:][np.diff(np.sign(trace.stroke - rest)) > 0]
        periods.append(np.mean(np.diff(crossings)))
    # four times the mass: twice the period
    assert periods[1] / periods[0] == pytest.approx(2.0, rel=0.02)
    stiffness = 3.0 * 0.28 * START / (2.0 * pi * MUSCLE.turns**2)
    assert periods[0] == pytest.approx(2.0 * pi * sqrt(30.0 / stiffness), rel=0.03)
