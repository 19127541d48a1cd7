"""Friction and hysteresis: bristles, yielding springs, play; each integrated along the record."""

from __future__ import annotations

from math import pi

import numpy as np
from numba import njit

from tests.truth.composition import Hidden, Record, accept
from tests.truth.muscle import Array, Muscle


@njit(cache=True)
def _lugre(length: Array, level: Array, rise: float, stribeck: float, time: Array, way: float) -> Array:
    """Average bristle deflection as a share; ``level`` is the sliding force at each row."""
    z = 0.0
    out = np.zeros(len(length))
    for row in range(1, len(length)):
        moved = length[row] - length[row - 1]
        speed = abs(moved) / (time[row] - time[row - 1])
        bound = 1.0 + rise * np.exp(-((speed / stribeck) ** 2))
        if moved != 0.0:
            side = 1.0 if moved > 0.0 else -1.0
            # Exact over a step of constant velocity: dz = (1 - z side/bound) dL/way
            z = side * bound + (z - side * bound) * np.exp(-abs(moved) / (way * bound))
        out[row] = z * level[row]
    return out


def bristles(force: float, way: float, *ids: str, rise: float = 0.12, stribeck: float = 2e-3) -> Hidden:
    """LuGre with a Stribeck rise at low speed; ``way`` is the break-away distance [m]."""

    def tension(record: Record) -> Array:
        level = np.full_like(record.time, force)
        return _lugre(record.length, level, rise, stribeck, record.time, way)

    return Hidden("LuGre friction", accept(*ids), memory=tension, slip=lambda p, x: np.full_like(p, force))


def crossings(muscle: Muscle, coefficient: float, way: float, *ids: str) -> Hidden:
    """Threads that turn on each other at their crossings: (4/3) pi mu eta P D r_c cot(theta)."""

    def level(pressure: Array, length: Array) -> Array:
        cosine = length / muscle.thread
        cotangent = cosine / np.sqrt(1.0 - cosine**2)
        return coefficient * 4.0 / 3.0 * pi * pressure * muscle.diameter_at(length) * cotangent

    def tension(record: Record) -> Array:
        band = level(record.pressure, record.length)
        return _lugre(record.length, band, 0.0, 1e-3, record.time, way)

    return Hidden("crossing friction", accept(*ids), memory=tension, slip=level)


def rubbing(muscle: Muscle, low: float, high: float, speed: float, *ids: str) -> Hidden:
    """Strand on strand over their touching area, f = f_high + (f_low - f_high)/(1 + (v/v_s)^2).

    The area is counted from the rhombi: each crossing touches over w^2/sin(2 theta).
    """

    def tension(record: Record) -> Array:
        angle = np.arccos(record.length / muscle.thread)
        area = pi * muscle.diameter * muscle.nominal * np.sin(2 * muscle.angle) / np.sin(2 * angle)
        velocity = np.abs(record.velocity())
        factor = high + (low - high) / (1.0 + (velocity / speed) ** 2)
        return _lugre(record.length, factor * record.pressure * area, 0.0, 1e-3, record.time, 5e-5)

    return Hidden("contact-area friction", accept(*ids), memory=tension)


@njit(cache=True)
def _yielding(length: Array, way: float, exponent: float) -> Array:
    z = 0.0
    out = np.zeros(len(length))
    for row in range(1, len(length)):
        parts = 1 + int(abs(length[row] - length[row - 1]) / (0.05 * way))
        step = (length[row] - length[row - 1]) / parts / way
        for _ in range(parts):
            side = 1.0 if step > 0.0 else -1.0
            z += step * max(1.0 - z * side, 0.0) ** exponent
        out[row] = z
    return out


def yielding(force: float, way: float, exponent: float, *ids: str) -> Hidden:
    """Dahl's law with the exponent i of his paper, dz/dx = (1 - z sgn v)^i."""
    return Hidden(
        "Dahl with exponent",
        accept(*ids),
        memory=lambda record: force * _yielding(record.length, way, exponent),
        slip=lambda p, x: np.full_like(p, force),
    )


@njit(cache=True)
def _bouc(length: Array, way: float, n: float, beta: float, gamma: float, ageing: float) -> Array:
    z, work = 0.0, 0.0
    out = np.zeros(len(length))
    for row in range(1, len(length)):
        parts = 1 + int(abs(length[row] - length[row - 1]) / (0.02 * way))
        step = (length[row] - length[row - 1]) / parts / way
        for _ in range(parts):
            eta = 1.0 + ageing * work
            bent = beta * abs(step) * abs(z) ** (n - 1.0) * z + gamma * step * abs(z) ** n
            change = (step - bent) / eta
            z += change
            work += abs(z * step)
        out[row] = z
    return out


def degrading_bouc(force: float, way: float, n: float, gamma: float, *ids: str) -> Hidden:
    """Baber-Noori: a Bouc-Wen loop whose stiffness falls with the work done; beta + gamma = 1."""
    return Hidden(
        "Baber-Noori hysteresis",
        accept(*ids),
        memory=lambda record: force * _bouc(record.length, way, n, 1.0 - gamma, gamma, 2e-4),
    )


@njit(cache=True)
def _iwan(path: Array, limits: Array, weights: Array) -> Array:
    held = np.zeros(len(limits))
    out = np.zeros(len(path))
    for row in range(1, len(path)):
        moved = path[row] - path[row - 1]
        for cell in range(len(limits)):
            held[cell] = min(max(held[cell] + moved, -limits[cell]), limits[cell])
            out[row] += weights[cell] * held[cell]
    return out


def iwan(force: float, way: float, *ids: str) -> Hidden:
    """Iwan's continuous spectrum of stick-slip cells, 40 of them, uniform in the slip way up to ``way``."""
    limits = (np.arange(40) + 0.5) / 40 * way
    weights = np.full(40, force / limits.sum())
    return Hidden("Iwan cells", accept(*ids), memory=lambda record: _iwan(record.length, limits, weights))


def pressure_play(force: float, way: float, *ids: str) -> Hidden:
    """Threads that micro-slip when the gas strains them: a Prandtl-Ishlinskii operator of the pressure."""
    limits = way * (np.arange(1, 9) / 8.0) ** 1.5
    weights = force / limits / len(limits)
    return Hidden(
        "pressure play", accept(*ids), memory=lambda record: -_iwan(record.pressure, limits, weights)
    )


def power_viscous(coefficient: float, exponent: float, per_pressure: float, ratio: float) -> Hidden:
    """c (1 + c_p P) sgn(v)|v|^m, other on lengthening than on shortening (Reynolds)."""

    def tension(record: Record) -> Array:
        velocity = record.velocity()
        side = np.where(velocity > 0.0, ratio, 1.0)
        size = coefficient * (1.0 + per_pressure * record.pressure) * side
        return size * np.sign(velocity) * np.abs(velocity) ** exponent

    return Hidden("power-law damping", accept("viscous_damping"), memory=tension)


def play_path(low: Array, high: Array, start: float) -> Array:
    """The play operator between two moving limits: a value that only moves when it is pushed."""
    out = np.empty_like(low)
    value = start
    for row, (least, most) in enumerate(zip(low, high, strict=True)):
        value = min(max(value, least), most)
        out[row] = value
    return out
