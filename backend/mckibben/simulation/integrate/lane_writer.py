"""LLVM text on rows of lanes: one instruction computes the same expression for several parameter sets.

exp, log and pow are polynomials written out here, relative error about 3e-15 (pow: plus 1.2e-16 |y log x|);
the C library would have to be called lane by lane. Other functions are.

Sources: Cody & Waite, Software Manual for the Elementary Functions (argument reduction of exp in two parts);
log after FreeBSD's e_log.c (its coefficients Lg1 to Lg7).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import cache
from typing import Any

from mckibben.simulation.integrate.machine_code import Writer, number

_LN2_HIGH, _LN2_LOW = 6.93147180369123816490e-01, 1.90821492927058770002e-10
# exp of less is 0, exp of more infinite.
_LEAST_EXPONENT, _MOST_EXPONENT = -745.2, 709.79
_ROUNDING = 6755399441055744.0  # 1.5 * 2^52: a sum with it is a whole number in its last bits
_ROUNDING_BITS = 0x4338000000000000
_ROOT_HALF_BITS = 0x3FE6A09E667F3BCD  # sqrt(1/2)
_LEAST_NORMAL, _SUBNORMAL_SHIFT = 2.2250738585072014e-308, 54
_EXP = tuple(1.0 / math.factorial(k) for k in range(14))
_LOG = (
    6.666666666666735130e-01, 3.999999999940941908e-01, 2.857142874366239149e-01, 2.222219843214978396e-01,
    1.818357216161805012e-01, 1.531383769920937332e-01, 1.479819860510658591e-01,
)  # fmt: skip
_INSTRUCTIONS = ("sqrt", "fabs", "rint")  # functions that are instructions of the processor


@cache
def lanes_of_machine() -> int:
    """Lanes of this machine: 4 with AVX2, else 2.

    Rows of 8 lanes in the registers of AVX-512 carry many sets 1.2 times as fast, but a single run, whose
    other lanes idle, takes 1.15 to 1.35 times as long (square roots and divisions do): most runs are single.
    """
    import llvmlite.binding as llvm

    return 4 if llvm.get_host_cpu_features().get("avx2") else 2


def has_blend(lanes: int) -> bool:
    """Whether rows of this many lanes are registers of AVX, which has a blending instruction."""
    return lanes == lanes_of_machine() == 4


def lane_writer(lanes: int) -> type[LaneWriter]:
    """A writer for rows of this many lanes."""
    kind = {"real": f"<{lanes} x double>", "truth": f"<{lanes} x i1>", "lanes": lanes}
    return type(f"LaneWriter{lanes}", (LaneWriter,), kind)


class LaneWriter(Writer):
    """Writes functions of rows of lanes; arguments and results are aligned arrays of rows."""

    def __init__(self, arguments: Sequence[Any], shared: Mapping[Any, Any]) -> None:
        super().__init__(arguments, shared)
        self._whole = f"<{self.lanes} x i64>"

    def _number(self, value: float) -> str:
        return f"splat (double {number(value)})"

    def _any_lane(self, condition: str) -> str:
        full = f"llvm.vector.reduce.or.v{self.lanes}i1"
        self.declared.add(f"declare i1 @{full}({self.truth})")
        return self._new(f"call i1 @{full}({self.truth} {condition})")

    def _truth(self, value: bool) -> str:
        return f"splat (i1 {'true' if value else 'false'})"

    def _call(self, function: str, *arguments: str) -> str:
        name = function.removeprefix("llvm.").removesuffix(".f64")
        if name == "exp":
            return self._exp(*arguments)
        if name == "log":
            return self._log(*arguments)
        if name == "pow":
            return self._pow(*arguments)
        if name in _INSTRUCTIONS:
            return self._instruction(name, *arguments)
        return self._by_lane(name, *arguments)

    def _instruction(self, name: str, argument: str) -> str:
        full = f"llvm.{name}.v{self.lanes}f64"
        self.declared.add(f"declare {self.real} @{full}({self.real})")
        return self._new(f"call {self.real} @{full}({self.real} {argument})")

    def _by_lane(self, name: str, *arguments: str) -> str:
        """A function of the C library, lane by lane."""
        self.declared.add(f"declare double @{name}({', '.join(['double'] * len(arguments))})")
        row = "poison"
        for lane in range(self.lanes):
            parts = [self._new(f"extractelement {self.real} {a}, i64 {lane}") for a in arguments]
            one = self._new(f"call double @{name}({', '.join(f'double {part}' for part in parts)})")
            row = self._new(f"insertelement {self.real} {row}, double {one}, i64 {lane}")
        return row

    def _plain(self, operation: str, a: str, b: str) -> str:
        """An operation that must not be fused with another: its rounding is intended."""
        return self._new(f"{operation} {self.real} {a}, {b}")

    def _bits(self, operation: str, a: str, value: int | str) -> str:
        other = f"splat (i64 {value})" if isinstance(value, int) else value
        return self._new(f"{operation} {self._whole} {a}, {other}")

    def _as_bits(self, value: str) -> str:
        return self._new(f"bitcast {self.real} {value} to {self._whole}")

    def _as_real(self, bits: str) -> str:
        return self._new(f"bitcast {self._whole} {bits} to {self.real}")

    def _times_plus(self, a: str, b: str, c: str) -> str:
        """A product and a sum, fused where the machine can."""
        return self._binary("fadd", self._binary("fmul", a, b), c)

    def _polynomial(self, x: str, coefficients: Sequence[float]) -> str:
        """By Estrin's scheme: pairs, then pairs of pairs."""
        level, power = [self._number(value) for value in coefficients], x
        while len(level) > 1:
            pairs = zip(level[0::2], level[1::2], strict=False)
            left = level[-1:] if len(level) % 2 else []
            level = [self._times_plus(high, power, low) for low, high in pairs] + left
            power = self._binary("fmul", power, power) if len(level) > 1 else power
        return level[0]

    def _exp(self, x: str) -> str:
        """2^k exp(r) with x = k log 2 + r."""
        most, least = self._number(_MOST_EXPONENT), self._number(_LEAST_EXPONENT)
        x = self._chosen(self._comparison("ogt", x, most), most, x)  # NaN stays NaN
        x = self._chosen(self._comparison("olt", x, least), least, x)
        rounded = self._plain(
            "fadd", self._plain("fmul", x, self._number(1.0 / math.log(2.0))), self._number(_ROUNDING)
        )
        k = self._plain("fsub", rounded, self._number(_ROUNDING))
        r = self._times_plus(k, self._number(-_LN2_HIGH), x)
        r = self._times_plus(k, self._number(-_LN2_LOW), r)
        value = self._polynomial(r, _EXP)
        # 2^k in two factors, so that subnormal results come out.
        exponent = self._bits("sub", self._as_bits(rounded), _ROUNDING_BITS)
        half = self._bits("ashr", exponent, 1)
        for part in (half, self._bits("sub", exponent, half)):
            power = self._as_real(self._bits("shl", self._bits("add", part, 1023), 52))
            value = self._plain("fmul", value, power)
        return value

    def _log(self, x: str) -> str:
        """K log 2 + log(1 + f) with x = 2^k (1 + f), 1 + f between sqrt(1/2) and sqrt(2)."""
        small = self._comparison("olt", x, self._number(_LEAST_NORMAL))
        scaled = self._plain("fmul", x, self._number(2.0**_SUBNORMAL_SHIFT))
        bits = self._as_bits(self._chosen(small, scaled, x))
        whole = self._bits("ashr", self._bits("sub", bits, _ROOT_HALF_BITS), 52)
        f = self._plain(
            "fadd",
            self._as_real(self._bits("sub", bits, self._bits("shl", whole, 52))),
            self._number(-1.0),
        )
        k = self._new(f"sitofp {self._whole} {whole} to {self.real}")
        k = self._chosen(small, self._plain("fadd", k, self._number(-float(_SUBNORMAL_SHIFT))), k)
        s = self._binary("fdiv", f, self._plain("fadd", f, self._number(2.0)))
        z = self._plain("fmul", s, s)
        rest = self._binary("fmul", z, self._polynomial(z, _LOG))
        square = self._plain("fmul", self._plain("fmul", f, self._number(0.5)), f)
        # k log 2 + f - (square - (s (square + rest) + k log 2's low part))
        low = self._times_plus(
            k, self._number(_LN2_LOW), self._plain("fmul", s, self._plain("fadd", square, rest))
        )
        inner = self._plain("fsub", self._plain("fsub", square, low), f)
        value = self._plain("fsub", self._plain("fmul", k, self._number(_LN2_HIGH)), inner)
        infinite = self._number(math.inf)
        outside = self._chosen(
            self._comparison("oeq", x, self._number(0.0)), self._number(-math.inf), self._number(math.nan)
        )
        value = self._chosen(self._comparison("ogt", x, self._number(0.0)), value, outside)
        return self._chosen(self._comparison("oeq", x, infinite), infinite, value)

    def _pow(self, x: str, y: str) -> str:
        """exp(y log|x|); of a negative x with the sign of x^y for a whole y, NaN for others."""
        value = self._exp(self._plain("fmul", y, self._log(self._instruction("fabs", x))))
        half = self._plain("fmul", y, self._number(0.5))
        whole = self._comparison("oeq", self._instruction("rint", y), y)
        even = self._comparison("oeq", self._instruction("rint", half), half)
        signed = self._chosen(even, value, self._new(f"fneg {self.real} {value}"))
        signed = self._chosen(whole, signed, self._number(math.nan))
        value = self._chosen(self._comparison("olt", x, self._number(0.0)), signed, value)
        return self._chosen(self._comparison("oeq", y, self._number(0.0)), self._number(1.0), value)
