r"""Geometry of the braid in three interchangeable forms.

A thread of length :math:`b` makes :math:`n` turns around the muscle, so with the braid angle :math:`\theta`
between thread and axis

.. math:: L = b\cos\theta, \qquad D = \frac{b\sin\theta}{n\pi} .

The same braid is given by diameter, angle and length at rest (:math:`D_0, \theta_0, L_0`), by
(:math:`b, n`), or by its lattice of rhombi with side :math:`\ell`, :math:`n_L` of them along the muscle and
:math:`n_C` around it: :math:`b = 2 n_L\ell`, :math:`n = n_L/n_C`.
"""

from __future__ import annotations

from typing import NamedTuple

from mckibben.physics import ops
from mckibben.physics.errors import InputError
from mckibben.physics.ops import Value


class Braid(NamedTuple):
    """Thread length b [m] and number of turns n [-] of an inextensible braid."""

    thread_length: Value
    turns: Value


class Rhombus(NamedTuple):
    """Side l of one rhombus [m], rhombi along the muscle n_L [-] and around it n_C [-]."""

    side: Value
    along: Value
    around: Value


def braid_from_diameter(*, diameter: Value, braid_angle: Value, length: Value) -> Braid:
    """b = L0/cos(theta0), n = L0 tan(theta0)/(pi D0).

    >>> b, n = braid_from_diameter(diameter=0.010, braid_angle=0.4363323129985824, length=0.100)
    >>> round(float(b), 7), round(float(n), 7)
    (0.1103378, 1.4843034)
    """
    return Braid(length / ops.cos(braid_angle), length * ops.tan(braid_angle) / (ops.pi * diameter))


def braid_from_rhombus(*, side: Value, along: Value, around: Value) -> Braid:
    """b = 2 n_L l, n = n_L/n_C (the paper's eqs. 11 and 12 lack the side l)."""
    return Braid(2.0 * along * side, along / around)


def rhombus_of(*, braid: Braid, side: Value) -> Rhombus:
    """n_L = b/(2 l), n_C = n_L/n: the lattice of this side; the inverse of `braid_from_rhombus`."""
    along = braid.thread_length / (2.0 * side)
    return Rhombus(side, along, along / braid.turns)


def angle(*, braid: Braid, length: Value) -> Value:
    """Braid angle theta = arccos(L/b) [rad]; 0 at and beyond the braid lock L = b."""
    return ops.arccos(ops.minimum(length / braid.thread_length, 1.0))


def diameter(*, braid: Braid, length: Value) -> Value:
    """Braid diameter D = sqrt(b^2 - L^2)/(n pi) [m].

    At and beyond the braid lock L = b it stays at 1e-6 b/(n pi) instead of 0, so that quotients and
    derivatives stay finite.
    """
    squared = braid.thread_length**2
    inside = ops.maximum(squared - length**2, 1e-12 * squared)
    return ops.sqrt(inside) / (braid.turns * ops.pi)


def volume(*, braid: Braid, length: Value) -> Value:
    """Enclosed volume of the cylinder V = L (b^2 - L^2)/(4 pi n^2) [m^3]."""
    return length * (braid.thread_length**2 - length**2) / (4.0 * ops.pi * braid.turns**2)


def rest_diameter_and_angle(*, braid: Braid, length: float) -> tuple[float, float]:
    """(D0, theta0) of a braid whose rest length is given [m]; the inverse of `braid_from_diameter`.

    Raises:
        InputError: the thread is not longer than the muscle, so no angle exists.
    """
    if not length < braid.thread_length:
        raise InputError(
            f"the thread ({braid.thread_length * 1e3:.4g} mm) is not longer than the muscle "
            f"({length * 1e3:.4g} mm)",
            field="thread_length",
            hint="a thread of length b at braid angle theta gives L = b cos(theta), so b > L",
        )
    return float(diameter(braid=braid, length=length)), float(angle(braid=braid, length=length))
