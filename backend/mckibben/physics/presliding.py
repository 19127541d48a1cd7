"""Dahl's law of friction that builds up after a reversal, for any driving quantity."""

from __future__ import annotations

from mckibben.physics import ops
from mckibben.physics.ops import Value

_ROUNDING = 1e-3  # share of full friction; rounds the power where its slope would be infinite


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
