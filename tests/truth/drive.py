"""The run of a drive: Runge-Kutta with a fixed step; muscle, gas with or without heat, tube, frictions."""

from __future__ import annotations

import numpy as np
from numba import njit

from tests.truth.air import KAPPA, R, eckersten, through, tube_rates
from tests.truth.muscle import ATMOSPHERE, Array
from tests.truth.plant import CELLS, Plant, Trace

STEP = 5e-5  # s
_CV = R / (KAPPA - 1.0)
_CP = KAPPA * _CV
# places in the state
_X, _V, _P, _M, _TW, _Z, _ZG, _PS, _PE, _IN, _LEAK, _TUBE = range(12)
SIZE = _TUBE + 2 * CELLS


@njit(cache=True)
def _area(plant: Plant, length: float) -> float:
    return (3.0 * length**2 - plant.thread**2) / (4.0 * np.pi * plant.turns**2)


@njit(cache=True)
def _volume(plant: Plant, length: float) -> float:
    return length * (plant.thread**2 - length**2) / (4.0 * np.pi * plant.turns**2)


@njit(cache=True)
def _dead(plant: Plant, gauge: float) -> float:
    return plant.dead + plant.extra_dead * (1.0 + plant.dead_give * (gauge - 1e5))


@njit(cache=True)
def _look_up(table: Array, low: float, high: float, x: float) -> float:
    place = (min(max(x, low), high) - low) / (high - low) * (len(table) - 1)
    index = min(int(place), len(table) - 2)
    return table[index] + (place - index) * (table[index + 1] - table[index])


@njit(cache=True)
def tension(plant: Plant, y: Array, wall: Array, low: float, high: float, pressure: float) -> float:
    """Tension of the muscle [N], never negative."""
    length, speed = plant.nominal - y[_X], -y[_V]
    gauge = pressure - plant.ambient
    force = gauge * _area(plant, length) + _look_up(wall, low, high, length) + plant.damping * speed
    if plant.drag > 0.0:
        side = plant.drag_ratio if speed > 0.0 else 1.0
        size = plant.drag * side * (1.0 + plant.drag_pressure * gauge)
        force += size * np.sign(speed) * abs(speed) ** plant.drag_power
    force += (plant.rub + plant.rub_pressure * max(gauge, 0.0)) * y[_Z]
    return max(force, 0.0)


@njit(cache=True)
def _rates(
    plant: Plant,
    y: Array,
    time: float,
    opening: float,
    given: float,
    wall: Array,
    low: float,
    high: float,
    tube_c: float,
    tube_b: float,
    late: float,
    dy: Array,
) -> float:
    dy[:] = 0.0
    pressure = given if plant.driven > 0.5 else y[_P]
    force = tension(plant, y, wall, low, high, pressure)
    x, v = y[_X], y[_V]
    inertia = plant.mass * plant.load_factor + plant.extra_mass * (1.0 + plant.extra_mass_slope * x)
    guide = 0.0
    if plant.guide > 0.0:
        bound = 1.0 + plant.guide_rise * np.exp(-((v / 0.01) ** 2))
        guide = plant.guide * y[_ZG]
        dy[_ZG] = (v - abs(v) * y[_ZG] / bound) / plant.guide_way
    if plant.rub > 0.0 or plant.rub_pressure > 0.0:
        dy[_Z] = (-v - abs(v) * y[_Z]) / plant.rub_way
    outside = plant.shake * np.sin(2.0 * np.pi * plant.shake_frequency * time) - plant.inertance * v * v
    dy[_X] = v
    dy[_V] = (force - plant.load_factor * plant.weight - plant.spring * x - guide + outside) / inertia
    if plant.driven > 0.5:
        return 0.0
    # the way of the air
    length = plant.nominal - x
    volume = _volume(plant, length) + _dead(plant, pressure - plant.ambient)
    give = plant.extra_dead * plant.dead_give
    warm = plant.room
    if plant.heat > 0.0:
        warm = pressure * volume / (y[_M] * R)
    supply = y[_PS] if plant.reservoir > 0.0 else plant.supply
    piped = plant.tube_length > 0.0
    node = y[_TUBE] if piped else pressure
    node_warm = plant.room if piped else warm
    fill_c, vent_c = plant.fill * plant.flow_factor, plant.vent * plant.flow_factor
    inflow, drawn = 0.0, 0.0
    if opening > 0.0:
        drawn = through(supply, node, fill_c * opening, plant.ratio, plant.orifice, plant.room, node_warm)
        inflow = drawn
    elif opening < 0.0:
        behind = y[_PE] if plant.silencer > 0.0 else plant.ambient
        out = through(node, behind, -vent_c * opening, plant.ratio, plant.orifice, node_warm, plant.room)
        inflow = -out
        if plant.silencer > 0.0:
            dy[_PE] += R * plant.room / 5e-6 * out
    if plant.silencer > 0.0:
        noisy = through(y[_PE], plant.ambient, plant.silencer, 0.5, 1.0, plant.room, plant.room)
        dy[_PE] -= R * plant.room / 5e-6 * noisy
    if plant.reservoir > 0.0:
        # A regulator that opens with the square root of the lack, the droop being that at 1 g/s.
        lack = max(plant.supply - supply, 0.0)
        feed = (
            1e-3 * np.sqrt(lack / (plant.droop * 1e-3))
            if lack > 500.0
            else lack / 500.0 * 1e-3 * np.sqrt(500.0 / (plant.droop * 1e-3))
        )
        dy[_PS] = R * plant.room / plant.reservoir * (feed - drawn)
    leaving = inflow
    if plant.travel > 0.0:
        inflow = late
    dy[_IN] = inflow
    entering = inflow
    if piped:
        if plant.tube_lumped > 0.5:
            entering = through(node, pressure, tube_c, tube_b, 0.0, plant.room, warm)
            store = np.pi / 4.0 * plant.tube_bore**2 * plant.tube_length
            dy[_TUBE] = plant.exponent * R * plant.room / store * (inflow - entering)
        else:
            cells = y[_TUBE : _TUBE + CELLS]
            flows = y[_TUBE + CELLS : _TUBE + 2 * CELLS]
            rates = dy[_TUBE : _TUBE + 2 * CELLS]
            tube_rates(
                cells, flows, inflow, pressure, plant.tube_length, plant.tube_bore, plant.tube_loss,
                plant.room, rates,
            )  # fmt: skip
            entering = flows[CELLS - 1]
    leak = plant.leak_laminar * (pressure**2 - plant.ambient**2)
    dy[_LEAK] = leak
    dy[_M] = entering - leak
    growth = _area(plant, length) * v
    if plant.heat > 0.0:
        diameter = np.sqrt(plant.thread**2 - length**2) / (plant.turns * np.pi)
        surface = np.pi * diameter * length
        # Free convection grows with the density; the wall warms and gives it on to the room.
        h = plant.heat * (pressure / 1e5) ** 0.5
        q = h * surface * (y[_TW] - warm)
        dy[_TW] = (-q + 12.0 * surface * (plant.room - y[_TW])) / plant.wall_capacity
        energy = q + _CP * (max(entering, 0.0) * plant.room - (max(-entering, 0.0) + leak) * warm)
        dy[_P] = ((KAPPA - 1.0) * energy - KAPPA * pressure * growth) / (volume + KAPPA * pressure * give)
    else:
        n = plant.exponent
        dy[_P] = (n * R * warm * (entering - leak) - n * pressure * growth) / (volume + n * pressure * give)
    return leaving


@njit(cache=True)
def _arrived(plant: Plant, sent: Array, now: float, step: float) -> float:
    """Flow that left the valve one travelling time ago, its front flattened over the spread."""
    total = 0.0
    for part in range(5):
        place = now - (plant.travel + plant.travel_spread * (part / 4.0 - 0.5)) / step
        index = int(np.floor(place))
        if index >= 0:
            total += sent[index] + (place - index) * (sent[index + 1] - sent[index])
    return total / 5.0


@njit(cache=True)
def _march(
    plant: Plant,
    y: Array,
    opening: Array,
    given: Array,
    every: int,
    rows: int,
    wall: Array,
    low: float,
    high: float,
    tube_c: float,
    tube_b: float,
    step: float,
) -> Array:
    out = np.zeros((rows, 7))
    sent = np.zeros(rows * every + 1)  # flow that has left the valve, at every step
    size = len(y)
    k1, k2, k3, k4, trial = np.zeros(size), np.zeros(size), np.zeros(size), np.zeros(size), np.zeros(size)
    for row in range(rows):
        pressure = given[2 * row * every] if plant.driven > 0.5 else y[_P]
        out[row, 0], out[row, 1], out[row, 2] = y[_X], y[_V], pressure
        out[row, 3] = tension(plant, y, wall, low, high, pressure)
        out[row, 4], out[row, 5], out[row, 6] = y[_IN], y[_LEAK], y[_PS]
        if row == rows - 1:
            break
        for inner in range(every):
            count = row * every + inner
            at = 2 * count
            t = 0.5 * at * step
            late = np.zeros(3)
            if plant.travel > 0.0:
                for stage in range(3):
                    late[stage] = _arrived(plant, sent, count + 0.5 * stage, step)
            sent[count] = _rates(
                plant, y, t, opening[at], given[at], wall, low, high, tube_c, tube_b, late[0], k1
            )
            trial[:] = y + 0.5 * step * k1
            t += 0.5 * step
            half, open_half = given[at + 1], opening[at + 1]
            _rates(plant, trial, t, open_half, half, wall, low, high, tube_c, tube_b, late[1], k2)
            trial[:] = y + 0.5 * step * k2
            _rates(plant, trial, t, open_half, half, wall, low, high, tube_c, tube_b, late[1], k3)
            trial[:] = y + step * k3
            t += 0.5 * step
            _rates(
                plant, trial, t, opening[at + 2], given[at + 2], wall, low, high, tube_c, tube_b, late[2], k4
            )
            y[:] = y + step / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4)
    return out


def run(
    plant: Plant,
    *,
    rows: int,
    every: int,
    opening: Array,
    start_gauge: float,
    wall: tuple[Array, float, float] | None = None,
    pressure: Array | None = None,
) -> Trace:
    """Run a drive from rest.

    Args:
        plant: its numbers.
        rows: samples.
        every: steps of `STEP` between them.
        opening: of the valve on the grid of half steps, 2 every (rows - 1) + 1 values.
        start_gauge: pressure at rest, under which load and muscle balance [Pa].
        wall: table of an added tension over the length, with its lowest and highest length.
        pressure: absolute, on the same grid, of a driven run.
    """
    table, low, high = wall or (np.zeros(2), 0.5 * plant.nominal, plant.thread)
    conductance, ratio = eckersten(plant.tube_bore, plant.tube_length) if plant.tube_length else (1e-8, 0.5)
    y = np.zeros(SIZE)
    absolute = start_gauge + plant.ambient
    y[_X] = _rest(plant, table, low, high, absolute)
    y[_P], y[_PS], y[_PE], y[_TW] = absolute, plant.supply, plant.ambient, plant.room
    y[_M] = absolute * (_volume(plant, plant.nominal - y[_X]) + _dead(plant, start_gauge)) / (R * plant.room)
    y[_TUBE : _TUBE + CELLS] = absolute
    mass = y[_M]
    given = np.full_like(opening, absolute) if pressure is None else pressure
    out = _march(plant, y, opening, given, every, rows, table, low, high, conductance, ratio, STEP)
    time = np.arange(rows) * every * STEP
    return Trace(
        time, out[:, 0], out[:, 1], out[:, 2], out[:, 3],
        np.array([mass, y[_M], gas_in_tube(plant, y), gas_in_tube(plant, None, absolute)]),
        out[:, 4], out[:, 5], out[:, 6],
    )  # fmt: skip


def gas_in_tube(plant: Plant, y: Array | None, absolute: float = ATMOSPHERE) -> float:
    """Mass of the gas in a tube of finite volumes [kg]."""
    volume = np.pi / 4.0 * plant.tube_bore**2 * plant.tube_length
    mean = absolute if y is None else float(np.mean(y[_TUBE : _TUBE + CELLS]))
    return mean * volume / (R * plant.room)


def _rest(plant: Plant, table: Array, low: float, high: float, absolute: float) -> float:
    """Stroke at which muscle and load balance without motion [m]."""
    y = np.zeros(SIZE)
    least, most = 0.0, plant.nominal - 0.62 * plant.nominal
    for _ in range(60):
        y[_X] = 0.5 * (least + most)
        surplus = (
            tension(plant, y, table, low, high, absolute)
            - plant.load_factor * plant.weight
            - plant.spring * y[_X]
        )
        least, most = (y[_X], most) if surplus > 0.0 else (least, y[_X])
    return 0.5 * (least + most)
