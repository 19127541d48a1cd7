"""Quotients and square roots of rows of lanes, half of them without the divider, on processors with AVX-512.

A processor divides 8 numbers in the time of 4 single divisions: what is bound by divisions would gain little
from lanes. Every second quotient or root therefore comes from the processor's estimates of 14 bits and a
series, while the divider is busy with the others. Relative error below 5e-16; exact for 0 and infinity; not
for divisors below 1e-307 or beyond 1e307.

Source: Intel 64 and IA-32 Architectures Software Developer's Manual, volume 2: VRCP14PD, VRSQRT14PD,
VFIXUPIMMPD.
"""

from __future__ import annotations

from collections.abc import Callable

from mckibben.simulation.integrate.machine_code import number

_ROW = "<8 x double>"
_FMA = "llvm.fma.v8f64"
_RECIPROCAL, _ROOT = "llvm.x86.avx512.rcp14.pd.512", "llvm.x86.avx512.rsqrt14.pd.512"
_EXACT_ROOT = "llvm.sqrt.v8f64"
_KIND = "llvm.x86.avx512.fpclass.pd.512"
_DECLARATIONS = {
    _FMA: f"declare {_ROW} @{_FMA}({_ROW}, {_ROW}, {_ROW})",
    _RECIPROCAL: f"declare {_ROW} @{_RECIPROCAL}({_ROW}, {_ROW}, i8)",
    _ROOT: f"declare {_ROW} @{_ROOT}({_ROW}, {_ROW}, i8)",
    _EXACT_ROOT: f"declare {_ROW} @{_EXACT_ROOT}({_ROW})",
    _KIND: f"declare <8 x i1> @{_KIND}({_ROW}, i32)",
}
# Kinds of arguments: 0, -0, infinity, -infinity, subnormal. The reciprocals of these are estimated exactly,
# or as infinity; and kinds that are their own roots.
_EXACT_RECIPROCAL = 0x02 | 0x04 | 0x08 | 0x10 | 0x20
_OWN_ROOT = 0x02 | 0x04 | 0x08
# 1 / sqrt(1 - r) = 1 + r (1/2 + r (3/8 + r 5/16)) + ...
_BINOMIAL = (0.5, 0.375, 0.3125)


class Quotients:
    """Writes quotients and roots as LLVM text.

    Args:
        new: appends an instruction, returns the name of its result.
        declare: takes a declaration that the text needs.
    """

    def __init__(self, new: Callable[[str], str], declare: Callable[[str], object]) -> None:
        self._new, self._declare = new, declare
        self._divides = True

    def quotient(self, a: str, b: str) -> str:
        """The quotient a / b."""
        self._divides = not self._divides
        return self._new(f"fdiv {_ROW} {a}, {b}") if self._divides else self.estimated_quotient(a, b)

    def root(self, x: str) -> str:
        """The square root of x."""
        self._divides = not self._divides
        return self._called(_EXACT_ROOT, f"{_ROW} {x}") if self._divides else self.estimated_root(x)

    def estimated_quotient(self, a: str, b: str) -> str:
        """a / b = a (r (1 + e) (1 + e^2)) with the estimate r of 1 / b and e = 1 - b r."""
        one = _number(1.0)
        value = self._called(_RECIPROCAL, f"{_ROW} {b}, {_ROW} zeroinitializer, i8 -1")
        rest, exact = self._less(one, b, value), self._is(_EXACT_RECIPROCAL, b)
        value = self._unless(exact, value, self._sum(value, rest, value))
        value = self._unless(exact, value, self._sum(value, self._product(rest, rest), value))
        return value if a == one else self._product(a, value)

    def estimated_root(self, x: str) -> str:
        """The square root of x, from an estimate of 1 / sqrt(x); 0 and infinity are their own roots."""
        own = self._is(_OWN_ROOT, x)
        others = self._new(f"xor <8 x i1> {own}, splat (i1 true)")
        mask = self._new(f"bitcast <8 x i1> {others} to i8")
        inverse = self._called(_ROOT, f"{_ROW} {x}, {_ROW} {_number(1.0)}, i8 {mask}")
        value = self._product(x, inverse)
        rest = self._less(_number(1.0), value, inverse)
        first, second, third = map(_number, _BINOMIAL)
        share = self._sum(self._sum(third, rest, second), rest, first)
        return self._unless(own, value, self._sum(self._product(value, rest), share, value))

    def _is(self, kinds: int, x: str) -> str:
        return self._called(_KIND, f"{_ROW} {x}, i32 {kinds}", "<8 x i1>")

    def _unless(self, condition: str, value: str, otherwise: str) -> str:
        return self._new(f"select <8 x i1> {condition}, {_ROW} {value}, {_ROW} {otherwise}")

    def _product(self, a: str, b: str) -> str:
        return self._new(f"fmul {_ROW} {a}, {b}")

    def _sum(self, a: str, b: str, c: str) -> str:
        """The sum a b + c, rounded once."""
        return self._called(_FMA, f"{_ROW} {a}, {_ROW} {b}, {_ROW} {c}")

    def _less(self, c: str, a: str, b: str) -> str:
        """The difference c - a b, rounded once."""
        return self._sum(self._new(f"fneg {_ROW} {a}"), b, c)

    def _called(self, name: str, given: str, result: str = _ROW) -> str:
        self._declare(_DECLARATIONS[name])
        return self._new(f"call {result} @{name}({given})")


def _number(value: float) -> str:
    return f"splat (double {number(value)})"
