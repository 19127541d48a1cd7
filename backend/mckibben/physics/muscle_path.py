r"""The path of a muscle along a joint: its length and its lever over the angle, by virtual work.

A muscle of the tension F that shortens while the angle grows turns the joint by the torque

.. math:: \tau = r(\varphi)\,F, \qquad r(\varphi) = -\frac{dL}{d\varphi},

because :math:`\tau\,d\varphi = -F\,dL` for every small turn. Length and lever are therefore one statement:
a path is given by one of them, and by the length at the angle 0 where it is given by its lever,

.. math:: L(\varphi) = L(0) - \int_0^\varphi r\,d\varphi .

The lever is positive where the muscle turns the joint to greater angles; of two muscles against each other
one has a negative lever. Every function is plain Python on numbers, arrays and symbols alike.

Source: virtual work of a tendon, An, Takahashi, Harrigan & Chao, J. Biomech. Eng. 106 (1984) 280, doi
10.1115/1.3138494.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from math import hypot, inf

import numpy as np
import symengine as se
from numpy.typing import NDArray

from mckibben.physics import ops
from mckibben.physics.custom import typed_formula
from mckibben.physics.errors import InputError
from mckibben.physics.ops import Value
from mckibben.physics.pieces import monotone, spline
from mckibben.physics.units import si

Array = NDArray[np.float64]
Function = Callable[[Value], Value]

_NODES = 32  # of Gauss-Legendre: exact for polynomials of degree 63, and for waves over a turn to rounding
_INEXACT = 1e-9  # of the lever times the range; a formula with a kink is not integrated by few nodes
_SAMPLES = 721
_SHORTEST = 1e-3  # m; a lever below it hardly turns anything


@dataclass(frozen=True, slots=True)
class Disagreement:
    """By how much stated lengths and levers of one path contradict the virtual work.

    Attributes:
        rms, largest: of the stated length minus that of the levers, its mean taken away [m].
        angle: where the largest one is [rad].
        lever_factor: by which all levers have to be multiplied to fit the lengths best; NaN where they do not
            change.
        rest: what is left then, rms [m].
    """

    rms: float
    largest: float
    angle: float
    lever_factor: float
    rest: float

    @property
    def sentence(self) -> str:
        """What it says, for people."""
        factor = ""
        if np.isfinite(self.lever_factor) and abs(self.lever_factor - 1.0) > 1e-3:
            factor = f"; levers {self.lever_factor:.3g} times as large would leave {1e3 * self.rest:.2g} mm"
        return (
            f"lengths and levers of the path disagree: by virtual work (lever = -dL/d angle) the stated "
            f"length is off by {1e3 * self.rms:.2g} mm rms, by {1e3 * self.largest:+.2g} mm at "
            f"{np.degrees(self.angle):.4g} deg{factor}; the levers are used"
        )


@dataclass(frozen=True, slots=True, eq=False)
class MusclePath:
    """Length and lever of a muscle over the angle of its joint.

    Attributes:
        length: of the muscle [m], of an angle [rad].
        lever: -dL/d angle [m].
        lever_slope: d lever/d angle [m/rad].
        low, high: angles between which the path is known [rad].
        disagreement: of stated lengths and levers; None where one of the two is stated.
    """

    length: Function
    lever: Function
    lever_slope: Function
    low: float = -inf
    high: float = inf
    disagreement: Disagreement | None = None

    def reversed(self) -> MusclePath:
        """The path of the other sense: the muscle turns to smaller angles, with the length at the angle 0."""
        middle = self.length(0.0)
        length, lever, slope = self.length, self.lever, self.lever_slope
        return replace(
            self,
            length=lambda angle: 2.0 * middle - length(angle),
            lever=lambda angle: -lever(angle),
            lever_slope=lambda angle: -slope(angle),
        )

    def checked(self, low: float, high: float) -> MusclePath:
        """The path, if it can be used between two angles [rad].

        Raises:
            InputError: it is not known there, the lever or length is no number, or the length not above 0.
        """
        if low < self.low - 1e-9 or high > self.high + 1e-9:
            raise InputError(
                f"the path is stated from {np.degrees(self.low):.4g} to {np.degrees(self.high):.4g} deg, and "
                f"the joint turns from {np.degrees(low):.4g} to {np.degrees(high):.4g} deg",
                field="stops",
                hint="narrower stops, or more of the path",
            )
        angle = np.linspace(max(low, self.low), min(high, self.high), _SAMPLES)
        with np.errstate(all="ignore"):
            length, lever = (np.broadcast_to(of(angle), angle.shape) for of in (self.length, self.lever))
        for name, values, right in (("lever", lever, np.isfinite(lever)), ("length", length, length > 0.0)):
            if not np.all(right):
                place = int(np.argmin(right))
                raise InputError(
                    f"the {name} at {np.degrees(angle[place]):.4g} deg is {values[place]:.4g} m",
                    field=name,
                    hint="formulas are in m, of the angle in rad",
                )
        return self


def constant_lever(*, lever: float, length: float) -> MusclePath:
    r"""A pulley: :math:`r` constant, :math:`L = L_0 - r\varphi`.

    Args:
        lever: radius, negative for a muscle that turns to smaller angles [m].
        length: of the muscle at the angle 0 [m].
    """
    return MusclePath(
        length=lambda angle: length - lever * angle,
        lever=lambda angle: lever + 0.0 * angle,
        lever_slope=lambda angle: 0.0 * angle,
    )


def path_of_lever(*, lever: Function, length: float, low: float, high: float) -> MusclePath:
    """A cam by its lever over the angle; the length follows by Gauss-Legendre's rule.

    Args:
        lever: [m] of an angle [rad], smooth.
        length: of the muscle at the angle 0 [m].
        low, high: between which it is used [rad].

    Raises:
        InputError: the lever has kinks or jumps, so that its length is not exact to 1e-9. Field "lever".
    """
    rules = [np.polynomial.legendre.leggauss(n) for n in (_NODES, _NODES + 9)]

    def turned(angle: Value, rule: tuple[Array, Array] = rules[0]) -> Value:
        at, weight = rule
        half = 0.5 * angle
        return sum(
            (half * float(w) * lever(half * (1.0 + float(x))) for x, w in zip(at, weight, strict=True)), 0.0
        )

    path = MusclePath(
        length=lambda angle: length - turned(angle),
        lever=lambda angle: lever(angle) + 0.0 * angle,
        lever_slope=_derivative(lever),
        low=low,
        high=high,
    )
    ends = np.linspace(low, high, 33)
    with np.errstate(all="ignore"):
        rough, fine = (np.asarray(turned(ends, rule), float) for rule in rules)
        size = max(float(np.max(np.abs(path.lever(ends)))), _SHORTEST) * max(high - low, 1.0)
        smooth = bool(np.nanmax(np.abs(rough - fine), initial=0.0) <= _INEXACT * size)
    if not smooth:
        raise InputError(
            "the lever is not smooth over the angle, so its length is not known to 1e-9",
            field="lever",
            hint="a formula without kinks, or a table of angle and lever",
        )
    return path


def path_of_length(*, length: Function, low: float, high: float) -> MusclePath:
    """A path by its length [m] over the angle [rad]; lever and slope are its exact derivatives."""

    lever = _negative(_derivative(length))
    return MusclePath(
        length=lambda angle: length(angle) + 0.0 * angle,
        lever=lever,
        lever_slope=_derivative(lever),
        low=low,
        high=high,
    )


def two_points(
    *, origin: tuple[float, float], insertion: tuple[float, float], tendon: float = 0.0
) -> MusclePath:
    r"""A muscle between a point of the frame and one of the link, seen from the pivot.

    With the insertion turned by the angle, and the points' distance d from it and angle
    :math:`\beta = \varphi + \beta_i - \beta_o` between their directions,

    .. math:: L = \sqrt{o^2 + i^2 - 2 o i\cos\beta} - t, \qquad r = -\frac{o\,i\sin\beta}{L + t} .

    Args:
        origin: on the frame [m].
        insertion: on the link at the angle 0 [m].
        tendon: length of cord and fittings between the points that is not muscle [m].

    Raises:
        InputError: a point lies on the pivot, where it has no lever.
    """
    o, i = hypot(*origin), hypot(*insertion)
    for name, distance in (("origin", o), ("insertion", i)):
        if distance == 0.0:
            raise InputError(f"the {name} lies on the pivot: there is no lever", field=f"points.{name}")
    between = float(np.arctan2(insertion[1], insertion[0]) - np.arctan2(origin[1], origin[0]))

    def distance(angle: Value) -> Value:
        return ops.sqrt(o * o + i * i - 2.0 * o * i * ops.cos(angle + between))

    def lever(angle: Value) -> Value:
        return -o * i * ops.sin(angle + between) / distance(angle)

    def slope(angle: Value) -> Value:
        # d = distance: r = -o i sin b / d, d' = -r.
        return (lever(angle) ** 2 - o * i * ops.cos(angle + between)) / distance(angle)

    return MusclePath(length=lambda angle: distance(angle) - tendon, lever=lever, lever_slope=slope)


def path_of_table(
    *,
    angle: Array,
    lever: Array | None = None,
    length: Array | None = None,
    length_at_zero: float | None = None,
) -> MusclePath:
    """A path by rows of angle [rad], lever and length [m].

    Levers are joined by monotone cubics (no lever between two rows is outside of them), whose exact integral
    the length is; lengths alone by a cubic spline, whose exact derivative the lever is. Where both are given
    the levers count, at the mean of the stated lengths, and `Disagreement` says what the lengths say else.
    Levers without a sign are customary: where none is negative and the stated lengths grow with the angle,
    the muscle turns to smaller angles and the levers are negative.

    Args:
        angle: distinct, in any order.
        lever, length: of the same rows; at least one of them.
        length_at_zero: length at the angle 0, of levers without lengths.

    Raises:
        InputError: fewer than two rows, a repeated angle, or levers without any length; names the field.
    """
    order = np.argsort(angle, kind="stable")
    angle = np.asarray(angle, float)[order]
    if len(angle) < 2:
        raise InputError(f"{len(angle)} row is no table", field="table.angle", hint="at least 2 angles")
    if np.any(np.diff(angle) <= 0.0):
        twice = float(angle[int(np.argmin(np.diff(angle)))])
        raise InputError(
            f"the angle {np.degrees(twice):.4g} deg occurs twice", field="table.angle", hint="one row each"
        )
    low, high = float(angle[0]), float(angle[-1])
    lever = None if lever is None else np.asarray(lever, float)[order]
    length = None if length is None else np.asarray(length, float)[order]
    if lever is None:
        if length is None:
            raise InputError("a table has levers or lengths", field="table.lever", hint="e.g. ['30 mm', ...]")
        along = spline(x=angle, y=length)
        lever_of = along.derivative().negative()
        return MusclePath(along, lever_of, lever_of.derivative(), low, high)
    levers = monotone(x=angle, y=lever)
    if length is not None and np.all(lever >= 0.0) and float(np.polyfit(angle, length, 1)[0]) > 0.0:
        levers = levers.negative()
    turned = levers.integral()
    disagreement = None
    if length is not None:
        constant = float(np.mean(length + turned(angle)))
        disagreement = _disagreement(angle, length, np.asarray(turned(angle)))
    elif length_at_zero is not None:
        constant = length_at_zero + float(turned(0.0))
    else:
        raise InputError(
            "levers alone do not say how long the muscle is", field="length", hint="e.g. '300 mm' at 0 deg"
        )
    return MusclePath(lambda at: constant - turned(at), levers, levers.derivative(), low, high, disagreement)


def _disagreement(angle: Array, length: Array, turned: Array) -> Disagreement:
    off = length + turned
    off = off - np.mean(off)
    way, own = turned - np.mean(turned), length - np.mean(length)
    square = float(way @ way)
    factor = -float(own @ way) / square if square > 0.0 else float("nan")
    rest = own + (factor if np.isfinite(factor) else 0.0) * way
    worst = int(np.argmax(np.abs(off)))
    return Disagreement(
        rms=float(np.sqrt(np.mean(off**2))),
        largest=float(off[worst]),
        angle=float(angle[worst]),
        lever_factor=factor,
        rest=float(np.sqrt(np.mean(rest**2))),
    )


_QUANTITY = re.compile(r"\s*[-+]?[\d.,]+(?:[eE][-+]?\d+)?\s*[^\d\s(*+/-]*\s*")  # rather than a formula
#: What a formula of a lever or a length may contain.
ANGLE_SYMBOLS = {"angle": "of the joint [rad]"}


def quantity_or_formula(*, value: float | str | None, field: str) -> float | Function:
    """A length [m] from a number or quantity, or a function of the angle from a formula in m and rad.

    Raises:
        InputError: it is neither; at the field.
    """
    if not isinstance(value, str):
        return float(value or 0.0)
    try:
        return float(si(value, "m"))
    except InputError as error:
        if _QUANTITY.fullmatch(value):
            raise error.at(field) from error
    formula = typed_formula(value, ANGLE_SYMBOLS, field=field)
    return lambda angle: formula({"angle": angle})


def path_on_lever(*, lever: str, length: float, low: float, high: float) -> MusclePath:
    """The path of a lever as a text: "30 mm", or a formula "0.03 - 0.005*angle**2".

    Args:
        lever: see above.
        length: of the muscle at the angle 0 [m].
        low, high: angles between which it is used [rad].

    Raises:
        InputError: the text is neither; a lever that is not smooth, a length that is not above 0.
    """
    given = quantity_or_formula(value=lever, field="lever")
    if callable(given):
        path = path_of_lever(lever=given, length=length, low=min(low, 0.0), high=max(high, 0.0))
    else:
        path = constant_lever(lever=given, length=length)
    return path.checked(low, high)


def _derivative(of: Function) -> Function:
    """The exact derivative, from that of the function on a symbol."""
    symbol = se.Symbol("angle")
    slope = se.sympify(of(symbol)).diff(symbol)
    compiled = se.Lambdify([symbol], [slope])

    def at(angle: Value) -> Value:
        if ops.is_symbolic(angle):
            return slope.subs({symbol: angle})
        values = np.asarray(angle, float)
        return compiled(values.reshape(-1, 1)).reshape(values.shape)

    return at


def _negative(of: Function) -> Function:
    return lambda angle: -of(angle)
