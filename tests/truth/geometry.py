"""Gas laws of other shapes: what ends, threads, walls and contact make of -P dV/dL."""

from __future__ import annotations

from collections.abc import Callable
from math import pi

import numpy as np
from scipy.interpolate import CubicSpline

from tests.truth.composition import GasLaw, Hidden, accept
from tests.truth.muscle import Array, Muscle

_SECTIONS = 200  # of a numerically integrated end


def of_volume(volume: Callable[[Array], Array], muscle: Muscle) -> Callable[[Array], Array]:
    """-dV/dL [m^2] of a tabulated volume."""
    length = muscle.lengths()
    slope = CubicSpline(length, volume(length)).derivative()
    return lambda x: -np.asarray(slope(x))


def _instead(muscle: Muscle, area: Callable[[Array], Array]) -> Callable[[GasLaw], GasLaw]:
    """The law that pulls with another area: the ideal share is exchanged, what else was in the law stays."""

    def turn(law: GasLaw) -> GasLaw:
        return lambda p, x: law(p, x) + p * (area(x) - muscle.area(x))

    return turn


def rounded_ends(muscle: Muscle, slenderness: float, *ids: str) -> Hidden:
    """Ellipsoidal ends, integrated section by section; each is slenderness (D - D_f)/2 long."""
    fitting = muscle.inside

    def volume(length: Array) -> Array:
        diameter = muscle.diameter_at(length)
        step = np.maximum(diameter - fitting, 0.0)
        end = slenderness * step / 2.0
        share = (np.arange(_SECTIONS) + 0.5) / _SECTIONS
        # quarter ellipse from the fitting's edge up to the full diameter
        profile = fitting + step[..., None] * np.sqrt(1.0 - (1.0 - share) ** 2)
        section = np.mean(pi / 4.0 * profile**2, axis=-1)
        return pi / 4.0 * diameter**2 * (length - 2.0 * end) + 2.0 * end * section

    return Hidden("ellipsoidal ends", accept(*ids), gas=_instead(muscle, of_volume(volume, muscle)))


def faster_middle(muscle: Muscle, rest: float, extra: float, scale: float, *ids: str) -> Hidden:
    """The middle contracts k(P) = rest + extra exp(-P/scale) times as much, as Kerscher found."""

    def turn(law: GasLaw) -> GasLaw:
        def force(p: Array, x: Array) -> Array:
            k = rest + extra * np.exp(-p / scale)
            return law(p, muscle.nominal - k * (muscle.nominal - x))

        return force

    return Hidden(
        "pressure-dependent contraction factor",
        accept(*ids),
        gas=turn,
        diameter=lambda p, x: muscle.diameter_at(
            muscle.nominal - (rest + extra * np.exp(-p / scale)) * (muscle.nominal - x)
        ),
    )


def thinning_wall(muscle: Muscle, thickness: float, exponent: float, *ids: str) -> Hidden:
    """A wall inside the braid that thins as (D0/D)^exponent; exponent 1 would keep the wall's section."""

    def volume(length: Array) -> Array:
        diameter = muscle.diameter_at(length)
        wall = thickness * (muscle.diameter / diameter) ** exponent
        return pi / 4.0 * (diameter - 2.0 * wall) ** 2 * length

    return Hidden("thinning wall", accept(*ids), gas=_instead(muscle, of_volume(volume, muscle)))


def stretching_threads(muscle: Muscle, compliance: float, stiffening: float, *ids: str) -> Hidden:
    """Fibres with T = (e + stiffening e^2)/compliance; the braid's equilibrium found by iteration.

    N threads carry N T = P b' L/(2 pi n^2).
    """

    def strain(pressure: Array, length: Array) -> Array:
        e = np.zeros_like(pressure)
        for _ in range(40):
            carried = pressure * muscle.thread * (1.0 + e) * length / (2.0 * pi * muscle.turns**2)
            e = (-1.0 + np.sqrt(1.0 + 4.0 * stiffening * compliance * carried)) / (2.0 * stiffening)
        return e

    def turn(law: GasLaw) -> GasLaw:
        def force(p: Array, x: Array) -> Array:
            longer = (muscle.thread * (1.0 + strain(p, x))) ** 2 - muscle.thread**2
            return law(p, x) - p * longer / (4.0 * pi * muscle.turns**2)

        return force

    def diameter(p: Array, x: Array) -> Array:
        return np.sqrt((muscle.thread * (1.0 + strain(p, x))) ** 2 - x**2) / (muscle.turns * pi)

    return Hidden("stiffening fibres", accept(*ids), gas=turn, diameter=diameter)


def late_contact(threshold: float, blur: float, *ids: str) -> Hidden:
    """The bladder meets the braid patch by patch.

    P_eff = blur [ln(1 + e^((P - P_th)/blur)) - ln(1 + e^(-P_th/blur))].
    """
    rest = blur * np.log1p(np.exp(-threshold / blur))

    def turn(law: GasLaw) -> GasLaw:
        return lambda p, x: law(blur * np.logaddexp(0.0, (p - threshold) / blur) - rest, x)

    return Hidden("patchy contact", accept(*ids), gas=turn)


def saturating(limit: float, share: float, scale: float, *ids: str) -> Hidden:
    """Effectiveness E(P) = limit (1 - share exp(-P/scale))."""

    def turn(law: GasLaw) -> GasLaw:
        return lambda p, x: limit * (1.0 - share * np.exp(-p / scale)) * law(p, x)

    return Hidden("saturating effectiveness", accept(*ids), gas=turn)


def taut_braid(muscle: Muscle, stiffness: float, onset: float, spread: float, *ids: str) -> Hidden:
    """Threads that come taut one after the other, their slack logistic about the onset (as a contraction)."""

    def tension(length: Array, _: Array) -> Array:
        beyond = (length - muscle.nominal * (1.0 - onset)) / (spread * muscle.nominal)
        return stiffness * spread * muscle.nominal * np.logaddexp(0.0, beyond)

    return Hidden("taut threads", accept(*ids), elastic=tension)


def jammed_braid(muscle: Muscle, stiffness: float, angle: float, *ids: str) -> Hidden:
    """Strands pressed flat beyond the lock angle, a push that grows with the power 1.3 of the way."""
    lock = muscle.thread * np.cos(angle)
    scale = 0.01 * muscle.nominal

    def tension(length: Array, _: Array) -> Array:
        return -stiffness * scale * (np.maximum(lock - length, 0.0) / scale) ** 1.3

    return Hidden("jammed strands", accept(*ids), elastic=tension)


def hardening_rig(compliance: float, force: float, *ids: str) -> Hidden:
    """Cord and frame that stiffen: they stretch by compliance f ln(1 + F/f)."""
    return Hidden(
        "hardening rig", accept(*ids), rig=lambda f: compliance * force * np.log1p(np.maximum(f, 0.0) / force)
    )
