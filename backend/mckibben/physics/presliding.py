"""Friction that builds up after a reversal, for any driving quantity: Dahl's law, and sliders in parallel."""

from __future__ import annotations

import math

from mckibben.physics import ops
from mckibben.physics.ops import Value

_LN2 = math.log(2.0)
_ROUNDING = 1e-3  # share of full friction; rounds the power where its slope would be infinite
_BAND = 0.1  # share of a slider's limit over which it goes from elastic to sliding
_LINEAR = 1e-6  # added to i - 1: the limit i = 1 of the power is an exponential
#: Pressure at which friction that a power of the pressure scales has its stated size [Pa].
REFERENCE_PRESSURE = 3e5
_VENTED = 1e3  # Pa; rounds the power where its slope would be infinite
_ENDED = 1e-9  # least share of the way left; below, all sliders slide
#: Limits of the sliders over the way x_b, and the bounds between them that share the distribution.
SLIDERS = (0.14, 0.42, 0.88, 1.65, 3.3)
_BETWEEN = (0.25, 0.6, 1.2, 2.2)


def build_up(*, rate: Value, share: Value, exponent: Value) -> Value:
    r"""Rate of the share z of full friction, times the way over which it builds up.

    .. math:: x_b\,\dot z = \dot x\,(1 - z\operatorname{sgn}\dot x)^i

    Exactly 0 at rest. With i = 1 the rest of the way is covered exponentially; a larger exponent has a long
    tail, as many contacts have that slip one after another.

    Source: Dahl, AIAA J. 14 (1976) 1675.
    """
    up, down = ops.positive_part(rate), ops.positive_part(-rate)
    rising = up * (1.0 - share) * _power(1.0 - share, exponent)
    falling = down * (1.0 + share) * _power(1.0 + share, exponent)
    return rising - falling


def _power(left: Value, exponent: Value) -> Value:
    """left^(i - 1), rounded; 1 for i = 1."""
    return ops.exp(0.5 * (exponent - 1.0) * ops.log(left**2 + _ROUNDING**2))


def slide(*, rate: Value, share: Value) -> Value:
    """Rate of the deflection z of a spring with a slider, times its limit.

    Elastic up to 0.9 of the limit, sliding at the limit, smooth between. Exactly 0 at rest.
    """
    along = ops.where(ops.greater(rate, 0.0), share, -share)
    t = ops.minimum(ops.positive_part((along - (1.0 - _BAND)) / _BAND), 1.0)
    return rate * (1.0 - t**2 * (3.0 - 2.0 * t))


def shares_of_sliders(*, exponent: Value) -> tuple[Value, ...]:
    r"""Forces of `SLIDERS` in parallel, sum 1, that build up after a reversal of a full motion as Dahl's law.

    With :math:`u = 1 - z` after the way x, in units of x_b, and the distribution of the limits
    :math:`w(r) = -2r\,\frac{d}{dr}\frac{u^i(2r)}{2}`, the share of those below r is

    .. math:: W(r) = 1 - \tfrac12 u(2r) - r\,u^i(2r), \quad u(x) = \left[2^{1-i} + (i-1)x\right]^{-1/(i-1)}

    Unlike Dahl's state, sliders close small loops within large ones (Masing).
    """
    q = exponent - 1.0 + _LINEAR
    below = []
    for limit in _BETWEEN:
        left = ops.maximum(1.0 + 2.0 * limit * q * ops.exp(q * _LN2), _ENDED)
        log_u = _LN2 - ops.log(left) / q
        below.append(1.0 - 0.5 * ops.exp(log_u) - limit * ops.exp(exponent * log_u))
    return tuple(b - a for a, b in zip((0.0, *below), (*below, 1.0), strict=True))


def pressed(*, pressure: Value, power: Value) -> Value:
    """(P/P_r)^q [-]: contacts that the gas presses together; rounded below 10 mbar."""
    above = ops.positive_part(pressure)
    return ops.exp(0.5 * power * ops.log((above**2 + _VENTED**2) / REFERENCE_PRESSURE**2))
