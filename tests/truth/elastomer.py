"""Walls of other rubbers: energies tabulated over the length and differentiated numerically."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numba import njit
from scipy.interpolate import CubicSpline, PchipInterpolator
from scipy.special import erf

from tests.truth.composition import Hidden, Record, accept
from tests.truth.muscle import ROOM, Array, Muscle, stretches

Energy = Callable[[Array, Array, Array], Array]  # per volume, from three stretches


def yeoh(c1: float, c2: float, c3: float) -> Energy:
    """W = c1 i + c2 i^2 + c3 i^3 with i = I1 - 3 (Yeoh 1993)."""

    def energy(a: Array, b: Array, c: Array) -> Array:
        i = a**2 + b**2 + c**2 - 3.0
        return c1 * i + c2 * i**2 + c3 * i**3

    return energy


def ogden(*terms: tuple[float, float]) -> Energy:
    """W = sum mu/alpha (l1^alpha + l2^alpha + l3^alpha - 3) (Ogden 1972)."""

    def energy(a: Array, b: Array, c: Array) -> Array:
        total = np.zeros_like(a)
        for mu, alpha in terms:
            total = total + mu / alpha * (a**alpha + b**alpha + c**alpha - 3.0)
        return total

    return energy


def arruda_boyce(mu: float, lock: float) -> Energy:
    """The eight-chain energy as a series of five terms; ``lock`` is the chain's locking stretch."""
    weights = (1 / 2, 1 / 20, 11 / 1050, 19 / 7000, 519 / 673750)

    def energy(a: Array, b: Array, c: Array) -> Array:
        i1 = a**2 + b**2 + c**2
        return mu * sum(w / lock ** (2 * k - 2) * (i1**k - 3.0**k) for k, w in enumerate(weights, start=1))  # type: ignore[return-value]

    return energy


def neo_hooke(c10: float) -> Energy:
    """W = C10 (I1 - 3): the wall that a user may know."""
    return lambda a, b, c: c10 * (a**2 + b**2 + c**2 - 3.0)


def stored(muscle: Muscle, energy: Energy) -> CubicSpline:
    """Stored energy [J] over the length [m]."""
    length = muscle.lengths()
    return CubicSpline(length, muscle.rubber * energy(*stretches(muscle, length)))


def bladder(muscle: Muscle, energy: Energy, *ids: str) -> Hidden:
    """Tension dW/dL of a wall."""
    slope = stored(muscle, energy).derivative()
    return Hidden(
        "bladder", accept("bladder_elasticity", *ids), elastic=lambda length, _: np.asarray(slope(length))
    )


def known_bladder(muscle: Muscle, c10: float) -> Hidden:
    """The neo-Hookean wall of a user's start model."""
    return bladder(muscle, neo_hooke(c10))


def exponential_bladder(muscle: Muscle, plateau: float, strain: float, rise: float) -> Hidden:
    """-plateau (1 - exp(-eps/strain)) - rise eps, the fit of catalogue curves; odd on stretching."""

    def tension(length: Array, _: Array) -> Array:
        contraction = 1.0 - length / muscle.nominal
        bent = np.sign(contraction) * -np.expm1(-np.abs(contraction) / strain)
        return -plateau * bent - rise * contraction

    return Hidden("exponential bladder", accept("bladder_elasticity"), elastic=tension)


def mapped_bladder(muscle: Muscle, scale: float) -> Hidden:
    """Offset of a measured size-20 map over the contraction, as a monotone spline, without its prestress.

    Martens & Boblan, Actuators 2017, 6(4):33: isometric lines met F = 0 at 43, 137, 180, 249, 374 kPa.
    """
    nodes = np.array([-0.05, 0.0, 0.047, 0.098, 0.155, 0.199, 0.34])
    offsets = np.array([-230.0, 0.0, 185.0, 194.0, 201.0, 200.0, 200.0])
    spline = PchipInterpolator(nodes, offsets)
    return Hidden(
        "mapped bladder",
        accept("bladder_elasticity"),
        elastic=lambda length, _: -scale * np.asarray(spline(1.0 - length / muscle.nominal)),
    )


def soft_spring(muscle: Muscle, stiffness: float) -> Hidden:
    """A slightly degressive spring -k x/(1 + 0.8 eps) of a helical insert."""

    def tension(length: Array, _: Array) -> Array:
        stroke = muscle.nominal - length
        return -stiffness * stroke / (1.0 + 0.8 * stroke / muscle.nominal)

    return Hidden("soft spring", accept("linear_elasticity"), elastic=tension)


def tight_wall(muscle: Muscle, force: float) -> Hidden:
    """A wall cut too long: a nearly constant push, 3 % weaker at 20 % contraction."""

    def tension(length: Array, _: Array) -> Array:
        return -force * (1.0 - 0.15 * (1.0 - length / muscle.nominal))

    return Hidden("tight wall", accept("prestress", "force_offset"), elastic=tension)


def softening(muscle: Muscle, energy: Energy, r: float, m: float) -> Hidden:
    """Ogden & Roxburgh 1999: eta = 1 - erf((W_max - W)/(m W_scale))/r, on the wall's own energy."""
    table, slope = stored(muscle, energy), stored(muscle, energy).derivative()
    scale = m * float(table(0.8 * muscle.nominal))

    def lost(record: Record) -> Array:
        now = np.asarray(table(record.length))
        highest = np.maximum.accumulate(now)
        return -np.asarray(slope(record.length)) * erf((highest - now) / scale) / r

    return Hidden("Ogden-Roxburgh softening", accept("mullins"), memory=lost)


def warming(muscle: Muscle, energy: Energy, first: float, second: float) -> Hidden:
    """The wall times a parabola of the temperature, as filled rubbers show."""
    slope = stored(muscle, energy).derivative()

    def change(length: Array, temperature: Array) -> Array:
        rise = temperature - ROOM
        return np.asarray(slope(length)) * (first * rise + second * rise**2)

    return Hidden("warming", accept("temperature"), elastic=change)


@njit(cache=True)
def _warmth(speed: Array, time: Array, wall: float, braid: float) -> Array:
    """Warmth of the wall over that of the braid around it, both heated by the motion; steps of the record."""
    inner, outer = 0.0, 0.0
    out = np.zeros(len(time))
    for row in range(1, len(time)):
        step = time[row] - time[row - 1]
        inner += step * (speed[row] - (inner - outer)) / wall
        outer += step * ((inner - outer) - 0.5 * outer) / braid
        out[row] = inner
    return out


def working_heat(muscle: Muscle, energy: Energy, loss: float, seconds: float) -> Hidden:
    """Work warms wall and braid in turn; the wall softens in proportion, E = E0/(1 + loss * warmth)."""
    slope = stored(muscle, energy).derivative()

    def lost(record: Record) -> Array:
        speed = np.abs(record.velocity()) / (0.05 * muscle.nominal)
        warm = _warmth(speed, record.time, seconds, 8.0 * seconds)
        return np.asarray(slope(record.length)) * (1.0 / (1.0 + loss * warm) - 1.0)

    return Hidden("heat of work", accept("self_heating"), memory=lost)


@njit(cache=True)
def _arms(length: Array, time: Array, times: Array, weights: Array) -> Array:
    extension = np.zeros(len(times))
    out = np.zeros(len(time))
    for row in range(1, len(time)):
        step, moved = time[row] - time[row - 1], length[row] - length[row - 1]
        for arm in range(len(times)):
            decay = np.exp(-step / times[arm])
            mean = times[arm] / step * (1.0 - decay)
            extension[arm] = extension[arm] * decay + moved * mean
            out[row] += weights[arm] * extension[arm]
    return out


def power_law_creep(stiffness: float, exponent: float) -> Hidden:
    """A relaxation t^-alpha (fractional element), as 14 arms from 10 ms to 1000 s that weigh tau^-alpha."""
    times = np.logspace(-2.0, 3.0, 14)
    weights = times**-exponent
    weights *= stiffness / weights[(times > 0.1) & (times < 100.0)].sum()
    return Hidden(
        "power-law creep",
        accept("creep"),
        memory=lambda record: _arms(record.length, record.time, times, weights),
    )


def settling(muscle: Muscle, share: float, exponent: float) -> Hidden:
    """The force of a share of every change of the pressure comes late, with a power of the time."""
    times = np.logspace(-2.0, 3.0, 14)
    weights = times**-exponent
    weights *= share / weights.sum()

    def late(record: Record) -> Array:
        area = (3.0 * record.length**2 - muscle.thread**2) / (4.0 * np.pi * muscle.turns**2)
        return -np.maximum(area, 0.0) * _arms(record.pressure, record.time, times, weights)

    return Hidden("late share of the pressure", accept("pressure_creep"), memory=late)
