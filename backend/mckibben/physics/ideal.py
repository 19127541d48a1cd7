r"""Closed forms of the ideal muscle: inextensible thread, thin wall, cylindrical ends, no losses.

All follow from virtual work, :math:`F = -P\,dV/dL`, and are written in (b, n). With
:math:`a = 3/\tan^2\theta_0`, :math:`c_b = 1/\sin^2\theta_0`, :math:`\lambda = L/L_0` the same force reads
:math:`F = P A_0 (a\lambda^2 - c_b)`, :math:`A_0 = \pi D_0^2/4`. The printed formulas of the source paper that
differ from these are listed in ``PAPER.md`` beside this file.

P is gauge pressure; only the gas term of the closed-valve stiffness takes the absolute one.

The model of a muscle with effects (`mckibben.physics.model`) derives its force and stiffness from the volume.
`stiffness_closed`, `blocked_force` and `max_work` are its reference values without effects.
"""

from __future__ import annotations

from mckibben.physics import ops
from mckibben.physics.braid import Braid, volume
from mckibben.physics.ops import Value
from mckibben.physics.units import STANDARD_ATMOSPHERE

ATMOSPHERE = STANDARD_ATMOSPHERE  # Pa


def area(*, braid: Braid, length: Value) -> Value:
    """Force per unit pressure -dV/dL = (3 L^2 - b^2)/(4 pi n^2) [m^2]; negative below `zero_force_length`."""
    return (3.0 * length**2 - braid.thread_length**2) / (4.0 * ops.pi * braid.turns**2)


def force(*, braid: Braid, pressure: Value, length: Value) -> Value:
    """Tension F = P b^2/(4 pi n^2) (3 L^2/b^2 - 1) [N]; negative (pushing) below `zero_force_length`."""
    return pressure * area(braid=braid, length=length)


def stiffness(*, braid: Braid, pressure: Value, length: Value) -> Value:
    """Stiffness at constant pressure dF/dL = 3 L P/(2 pi n^2) [N/m]; regular at `zero_force_length`."""
    return 3.0 * length * pressure / (2.0 * ops.pi * braid.turns**2)


def stiffness_from_force(*, braid: Braid, force: Value, length: Value) -> Value:
    """Stiffness at constant pressure of the ideal muscle that pulls with a force, 6 L F/(3 L^2 - b^2) [N/m].

    Equation (20) of the source paper: the pressure of `stiffness` is replaced by that which the force needs
    at this length. Undefined (0/0) at `zero_force_length`; the limit there is `stiffness`.
    """
    return 6.0 * length * force / (3.0 * length**2 - braid.thread_length**2)


def stiffness_secant(*, force: Value, length: Value, shortest: Value, shortest_force: Value = 0.0) -> Value:
    """Stiffness of the straight line from the shortest length, (F - F_min)/(L - L_min) [N/m].

    Equation (25) of the source paper, its "linear stiffness"; undefined (0/0) at the shortest length, where
    its limit is the tangent dF/dL.

    Args:
        force, length: of the muscle [N], [m].
        shortest, shortest_force: L_min and F_min, the length without force and the force there: 0.
    """
    return (force - shortest_force) / (length - shortest)


def stiffness_closed(
    *,
    braid: Braid,
    pressure: Value,
    length: Value,
    polytropic_exponent: Value = 1.4,
    dead_volume: Value = 0.0,
    atmosphere: Value = ATMOSPHERE,
) -> Value:
    """Stiffness with a closed valve (constant gas mass) [N/m].

    k_c = 3 L P/(2 pi n^2) + gamma p (3 L^2 - b^2)^2/(16 pi^2 n^4 (V + V_d)): gauge P in the geometric term,
    absolute p = P + atmosphere in the gas term. Equals `stiffness` at `zero_force_length`.
    """
    gas = polytropic_exponent * (pressure + atmosphere) * area(braid=braid, length=length) ** 2
    return stiffness(braid=braid, pressure=pressure, length=length) + gas / (
        volume(braid=braid, length=length) + dead_volume
    )


def zero_force_length(*, braid: Braid) -> Value:
    """Length without force L_min = b/sqrt(3) [m], braid angle 54.7356 degrees."""
    return braid.thread_length / 3.0**0.5


def max_contraction(*, braid_angle: Value) -> Value:
    """Contraction ratio without force, 1 - 1/(sqrt(3) cos theta0) [-].

    >>> from math import radians
    >>> round(float(max_contraction(braid_angle=radians(25))), 7)
    0.3629645
    """
    return 1.0 - 1.0 / (3.0**0.5 * ops.cos(braid_angle))


def blocked_force(*, diameter: Value, braid_angle: Value, pressure: Value) -> Value:
    """Tension at the nominal length, F_0 = P A_0 (2/sin^2(theta0) - 3) [N].

    >>> from math import radians
    >>> round(float(blocked_force(diameter=0.01, braid_angle=radians(25), pressure=1e5)), 4)
    64.3855
    """
    return pressure * ops.pi * diameter**2 / 4.0 * (2.0 / ops.sin(braid_angle) ** 2 - 3.0)


def lock_force(*, braid: Braid, pressure: Value) -> Value:
    """Tension at the braid lock L -> b (threads parallel to the axis), P b^2/(2 pi n^2) [N]."""
    return pressure * braid.thread_length**2 / (2.0 * ops.pi * braid.turns**2)


def max_work(*, braid: Braid, pressure: Value, length: Value) -> Value:
    """Isobaric work P (V_max - V(L)) [J] from a length down to `zero_force_length`."""
    shortest = zero_force_length(braid=braid)
    return pressure * (volume(braid=braid, length=shortest) - volume(braid=braid, length=length))


def thread_tension(*, braid: Braid, pressure: Value, length: Value, threads: Value = 1.0) -> Value:
    """Tension of each of N threads, P b L/(2 pi n^2 N) [N]; satisfies axial and hoop equilibrium."""
    return pressure * braid.thread_length * length / (2.0 * ops.pi * braid.turns**2 * threads)
