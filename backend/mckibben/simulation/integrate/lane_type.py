"""A numba type for a row of lanes: LLVM's vector of doubles, so that a variable is a register.

Rows lie in aligned arrays, one after the other; they are addressed by the address of the array and the number
of the row.
"""

from __future__ import annotations

import operator
from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.typing import templates
from numba.core.typing.templates import ConcreteTemplate, signature
from numba.extending import intrinsic, lower_builtin, models, register_model

from mckibben.simulation.integrate.lane_writer import has_blend, lanes_of_machine

LANES = lanes_of_machine()
_REAL = ir.DoubleType()
_ROW = ir.VectorType(_REAL, LANES)
_ALIGNMENT = 8 * LANES


class Lanes(types.Type):
    """A row of lanes."""

    def __init__(self) -> None:
        super().__init__(name=f"Lanes{LANES}")


lanes_type = Lanes()


@register_model(Lanes)
class _Model(models.PrimitiveModel):
    def __init__(self, dmm: Any, fe_type: Any) -> None:
        super().__init__(dmm, fe_type, _ROW)


def _splatted(builder: Any, value: Any) -> Any:
    undefined = ir.Constant(_ROW, ir.Undefined)
    first = builder.insert_element(undefined, value, ir.Constant(ir.IntType(32), 0))
    mask = ir.Constant(ir.VectorType(ir.IntType(32), LANES), [0] * LANES)
    return builder.shuffle_vector(first, undefined, mask)


def _register_operator(function: Any, instruction: str) -> None:
    pairs = [(lanes_type, lanes_type), (types.float64, lanes_type), (lanes_type, types.float64)]

    class Template(ConcreteTemplate):
        cases = [signature(lanes_type, *pair) for pair in pairs]  # noqa: RUF012 - as numba wants it

    register: Any = templates.infer_global
    register(function)(Template)

    def lower(_context: Any, builder: Any, sig: Any, args: Any) -> Any:
        rows = [
            value if kind == lanes_type else _splatted(builder, value)
            for value, kind in zip(args, sig.args, strict=True)
        ]
        return getattr(builder, instruction)(*rows, flags=("contract",))

    for pair in pairs:
        lower_builtin(function, *pair)(lower)


for _function, _instruction in (
    (operator.add, "fadd"),
    (operator.sub, "fsub"),
    (operator.mul, "fmul"),
    (operator.truediv, "fdiv"),
):
    _register_operator(_function, _instruction)


def _place(context: Any, builder: Any, given: Any, kind: Any) -> Any:
    """Pointer to a row, from address and number."""
    index = context.cast(builder, given[1], kind, types.int64)
    return builder.gep(builder.inttoptr(given[0], _ROW.as_pointer()), [index])


def _load(_typing: Any, _address: Any, index: Any) -> Any:
    """``load(address, index)``: row of an aligned array."""

    def generate(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        return builder.load(_place(context, builder, args, sig.args[1]), align=_ALIGNMENT)

    return lanes_type(types.uintp, index), generate


def _store(_typing: Any, _address: Any, index: Any, _value: Any) -> Any:
    """``store(address, index, row)``."""

    def generate(context: Any, builder: Any, sig: Any, args: Any) -> Any:
        builder.store(args[2], _place(context, builder, args, sig.args[1]), align=_ALIGNMENT)
        return context.get_dummy_value()

    return types.void(types.uintp, index, lanes_type), generate


def _load_any(_typing: Any, _address: Any) -> Any:
    """``load_any(address)``: the numbers that follow any address."""

    def generate(_context: Any, builder: Any, _sig: Any, args: Any) -> Any:
        return builder.load(builder.inttoptr(args[0], _ROW.as_pointer()), align=8)

    return lanes_type(types.uintp), generate


def _store_any(_typing: Any, _address: Any, _value: Any) -> Any:
    """``store_any(address, row)``."""

    def generate(context: Any, builder: Any, _sig: Any, args: Any) -> Any:
        builder.store(args[1], builder.inttoptr(args[0], _ROW.as_pointer()), align=8)
        return context.get_dummy_value()

    return types.void(types.uintp, lanes_type), generate


def _stream(_typing: Any, _address: Any, _value: Any) -> Any:
    """``stream(address, row)``: store at an aligned address, past the cache."""

    def generate(context: Any, builder: Any, _sig: Any, args: Any) -> Any:
        stored = builder.store(args[1], builder.inttoptr(args[0], _ROW.as_pointer()), align=_ALIGNMENT)
        mark = builder.module.add_metadata([ir.Constant(ir.IntType(32), 1)])
        stored.set_metadata("nontemporal", mark)
        return context.get_dummy_value()

    return types.void(types.uintp, lanes_type), generate


def _splat(_typing: Any, _value: Any) -> Any:
    """``splat(number)``: the same number in every lane."""

    def generate(_context: Any, builder: Any, _sig: Any, args: Any) -> Any:
        return _splatted(builder, args[0])

    return lanes_type(types.float64), generate


def _of_row(name: str) -> Any:
    """An instruction of one row."""

    def typed(_typing: Any, _value: Any) -> Any:
        def generate(_context: Any, builder: Any, _sig: Any, args: Any) -> Any:
            kind = ir.FunctionType(_ROW, [_ROW])
            full = f"llvm.{name}.v{LANES}f64"
            return builder.call(cgutils.get_or_insert_function(builder.module, kind, full), args)

        return lanes_type(lanes_type), generate

    return typed


def _function(made: Any) -> Any:
    """A function of one row."""

    def typed(_typing: Any, _value: Any) -> Any:
        def generate(_context: Any, builder: Any, _sig: Any, args: Any) -> Any:
            return made(builder, args[0])

        return lanes_type(lanes_type), generate

    return typed


def _one_over(builder: Any, value: Any) -> Any:
    return builder.fdiv(ir.Constant(_ROW, [1.0] * LANES), value)


def _one_over_root(builder: Any, value: Any) -> Any:
    kind = ir.FunctionType(_ROW, [_ROW])
    function = cgutils.get_or_insert_function(builder.module, kind, f"llvm.sqrt.v{LANES}f64")
    return _one_over(builder, builder.call(function, [value]))


def _picked(comparison: str) -> Any:
    """The row that compares true, lane by lane; the second where a lane is NaN."""

    def typed(_typing: Any, _a: Any, _b: Any) -> Any:
        def generate(_context: Any, builder: Any, _sig: Any, args: Any) -> Any:
            return builder.select(builder.fcmp_ordered(comparison, *args), *args)

        return lanes_type(lanes_type, lanes_type), generate

    return typed


def _where_positive(_typing: Any, _mask: Any, _yes: Any, _no: Any) -> Any:
    """``where_positive(mask, yes, no)``: lane by lane ``yes`` where the mask is above zero."""

    def generate(_context: Any, builder: Any, _sig: Any, args: Any) -> Any:
        zero = ir.Constant(_ROW, [0.0] * LANES)
        return builder.select(builder.fcmp_ordered(">", args[0], zero), args[1], args[2])

    return lanes_type(lanes_type, lanes_type, lanes_type), generate


def _replaced(_typing: Any, _condition: Any, _yes: Any, _no: Any) -> Any:
    """``replaced(condition, yes, no)``: ``yes`` where a row of ones and zeros is 1, for a store over ``no``.

    LLVM makes a masked store of a choice that is stored where one side comes from. Without AVX-512 that takes
    AMD's processors ten times as long as the blending instruction, which is asked for by name here.
    """

    def generate(_context: Any, builder: Any, _sig: Any, args: Any) -> Any:
        condition, yes, no = args
        zero = ir.Constant(_ROW, [0.0] * LANES)
        if not has_blend(LANES):
            return builder.select(builder.fcmp_ordered(">", condition, zero), yes, no)
        kind = ir.FunctionType(_ROW, [_ROW] * 3)
        blend = cgutils.get_or_insert_function(builder.module, kind, "llvm.x86.avx.blendv.pd.256")
        return builder.call(blend, [no, yes, builder.fsub(zero, condition)])  # it goes by the sign

    return lanes_type(lanes_type, lanes_type, lanes_type), generate


def _positive_bits(_typing: Any, _mask: Any) -> Any:
    """``positive_bits(mask)``: a whole number with bit i set where lane i is above zero."""

    def generate(_context: Any, builder: Any, _sig: Any, args: Any) -> Any:
        bits = builder.fcmp_ordered(">", args[0], ir.Constant(_ROW, [0.0] * LANES))
        return builder.zext(builder.bitcast(bits, ir.IntType(LANES)), ir.IntType(64))

    return types.int64(lanes_type), generate


def _first_bit(_typing: Any, _bits: Any) -> Any:
    """``first_bit(bits)``: the number of the lowest bit set in a whole number that is not 0."""

    def generate(_context: Any, builder: Any, _sig: Any, args: Any) -> Any:
        return builder.cttz(args[0], ir.Constant(ir.IntType(1), 1))

    return types.int64(types.int64), generate


def _call_with_data(_typing: Any, _address: Any, _out: Any, _inputs: Any, _data: Any) -> Any:
    """Call ``void f(double* out, double* inputs, double* data)`` at an address."""

    def generate(context: Any, builder: Any, _sig: Any, args: Any) -> Any:
        double = _REAL.as_pointer()
        kind = ir.FunctionType(ir.VoidType(), [double] * 3)
        given = [builder.inttoptr(argument, double) for argument in args[1:]]
        builder.call(builder.inttoptr(args[0], kind.as_pointer()), given)
        return context.get_dummy_value()

    return types.void(types.int64, types.uintp, types.uintp, types.uintp), generate


load: Any = intrinsic(_load)
store: Any = intrinsic(_store)
load_any: Any = intrinsic(_load_any)
store_any: Any = intrinsic(_store_any)
stream: Any = intrinsic(_stream)
splat: Any = intrinsic(_splat)
magnitude: Any = intrinsic(_of_row("fabs"))
reciprocal: Any = intrinsic(_function(_one_over))
inverse_root: Any = intrinsic(_function(_one_over_root))  # of 1 / sqrt(x)
larger: Any = intrinsic(_picked(">"))
smaller: Any = intrinsic(_picked("<"))
where_positive: Any = intrinsic(_where_positive)
replaced: Any = intrinsic(_replaced)
first_bit: Any = intrinsic(_first_bit)
positive_bits: Any = intrinsic(_positive_bits)
call_with_data: Any = intrinsic(_call_with_data)
