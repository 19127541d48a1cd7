"""Mathematical operations on numbers, numpy arrays and symengine symbols.

Physics is written once against these names. Numbers and arrays go to numpy, symbols to symengine; an
expression may mix both. Maximum, minimum, sign and absolute value become ``Piecewise`` on symbols, because
symengine's machine-code back end cannot differentiate ``Abs``, ``Max``, ``Min`` or ``sign``.
"""

from __future__ import annotations

from collections.abc import Callable
from contextvars import ContextVar
from typing import Any

import numpy as np
import symengine as se

# A number, a numpy array or a symengine expression: argument and result of every physics function.
Value = Any

pi = float(np.pi)

_COMPLEX_STEP = 1e-30
_inside: ContextVar[int] = ContextVar("derivatives that are being taken", default=0)


def is_symbolic(x: Value) -> bool:
    """Whether x is a symengine expression (numbers wrapped by symengine included)."""
    return isinstance(x, se.Basic)


def exp(x: Value) -> Value:
    """The exponential."""
    return se.exp(x) if is_symbolic(x) else np.exp(x)


def log(x: Value) -> Value:
    """The natural logarithm."""
    return se.log(x) if is_symbolic(x) else np.log(x)


def sqrt(x: Value) -> Value:
    """The square root; NaN for a negative real number."""
    return se.sqrt(x) if is_symbolic(x) else np.sqrt(x)


def sin(x: Value) -> Value:
    """The sine of an angle in radians."""
    return se.sin(x) if is_symbolic(x) else np.sin(x)


def cos(x: Value) -> Value:
    """The cosine of an angle in radians."""
    return se.cos(x) if is_symbolic(x) else np.cos(x)


def tan(x: Value) -> Value:
    """The tangent of an angle in radians."""
    return se.tan(x) if is_symbolic(x) else np.tan(x)


def arccos(x: Value) -> Value:
    """The inverse cosine, in radians."""
    return se.acos(x) if is_symbolic(x) else np.arccos(x)


def arcsin(x: Value) -> Value:
    """The inverse sine, in radians."""
    return se.asin(x) if is_symbolic(x) else np.arcsin(x)


def greater(a: Value, b: Value) -> Value:
    """The condition a > b, for `where`; complex numbers (complex-step derivatives) compare by real part."""
    if isinstance(a, float) and isinstance(b, float):
        return a > b
    if is_symbolic(a) or is_symbolic(b):
        return se.sympify(a) > se.sympify(b)
    return np.real(a) > np.real(b)


def where(condition: Value, a: Value, b: Value) -> Value:
    """``a`` where the condition holds, ``b`` elsewhere."""
    if isinstance(a, float) and isinstance(b, float) and isinstance(condition, bool | np.bool_):
        return np.float64(a if condition else b)  # what numpy would give, in a tenth of the time
    if isinstance(condition, se.Basic):
        a, b = se.sympify(a), se.sympify(b)
        return a if a == b else se.Piecewise((a, condition), (b, True))
    if is_symbolic(a) or is_symbolic(b):
        return a if bool(condition) else b
    return np.where(condition, a, b)


def maximum(a: Value, b: Value) -> Value:
    """The larger of the two."""
    return where(greater(a, b), a, b)


def minimum(a: Value, b: Value) -> Value:
    """The smaller of the two."""
    return where(greater(b, a), a, b)


def positive_part(x: Value) -> Value:
    """The Macaulay bracket max(x, 0)."""
    return where(greater(x, 0.0), x, 0.0 * x)


def absolute(x: Value) -> Value:
    """The absolute value; the derivative at 0 is taken from the left."""
    return where(greater(x, 0.0), x, -x)


def sign(x: Value) -> Value:
    """1, -1, or 0 at 0."""
    return where(greater(x, 0.0), 1.0, where(greater(0.0, x), -1.0, 0.0))


def derivative(function: Callable[[Value], Value], at: Value) -> Value:
    """The exact derivative df/dx of ``function`` at ``at``.

    On symbols it is symbolic differentiation, on numbers and arrays a complex step of 1e-30, which is exact
    to rounding for every operation of this namespace. The function must be elementwise in its argument.
    """
    if is_symbolic(at):
        depth = _inside.get()
        # Not se.Dummy: its running number orders the terms, and with them the last digits.
        x = se.Symbol(f"derivative:{depth}")
        token = _inside.set(depth + 1)
        try:
            return function(x).diff(x).subs({x: at})
        finally:
            _inside.reset(token)
    return np.imag(function(at + 1j * _COMPLEX_STEP)) / _COMPLEX_STEP
