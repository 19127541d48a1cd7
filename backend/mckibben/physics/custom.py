r"""A term of the tension that the user types, e.g. ``-c*sign(v)*P``: parsed by a whitelist, never evaluated.

Symbols: P gauge pressure [Pa], kappa contraction ratio, L length [m], v = dL/dt [m/s], t time [s], pi.
Functions: abs, sign, exp, sqrt, sin, cos, tanh. Operators: + - * / **. Any other name is a parameter in SI.
sign(v) is the direction of the motion, 0 at rest.
"""

from __future__ import annotations

import ast
import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import lru_cache
from inspect import Parameter as Argument
from inspect import Signature as CallSignature
from typing import Any

from mckibben.physics import ops
from mckibben.physics.effect import Effect, Example, Signature, StateVariable
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source
from mckibben.physics.slots import SLOTS
from mckibben.physics.term_check import (
    TermFunction,
    check_derivatives,
    check_written_out,
    errors_of_term,
    finite,
    refused,
    shown,
)

CUSTOM = "custom"
TERM = "term"
SYMBOLS = {
    "P": "gauge pressure [Pa]", "kappa": "contraction ratio", "L": "length [m]", "v": "dL/dt [m/s]",
    "t": "time [s]", "pi": "3.14159...",
}  # fmt: skip
FUNCTIONS: Mapping[str, Callable[[Value], Value]] = {
    # The argument occurs twice, not three times as in ops.absolute, and never negated: symengine would
    # expand a negated copy again at every level of nesting.
    "abs": lambda x: x * ops.where(ops.greater(x, 0.0), 1.0, -1.0),
    "exp": ops.exp, "sqrt": ops.sqrt, "sin": ops.sin, "cos": ops.cos,
    "tanh": lambda x: 1.0 - 2.0 / (ops.exp(2.0 * x) + 1.0),
}  # fmt: skip
_LONGEST = 500
_DEEPEST = 40
_LONGEST_NAME = 64
_USABLE = re.compile(r"[A-Za-z0-9_+\-*/^().,\s]*")
_QUOTES = {"'": "a single quote", '"': "a double quote"}
# Names with another meaning: arguments of the effect's functions, its state, and the term itself.
_TAKEN = {*SLOTS["friction"].context, "elapsed", TERM}
_LARGEST = 1e12  # SI; bound of a parameter without a stated value
_REACH = 1e3  # bound of a parameter as a multiple of its stated value

_ALLOWED = f"numbers, + - * / **, {', '.join((*SYMBOLS, 'sign', *FUNCTIONS))} and parameters"


@dataclass(frozen=True, eq=False)
class TypedEffect(Effect):
    """The effect of a typed term, with the original text."""

    term: str = ""


def custom_effect(term: str, stated: Mapping[str, float] | None = None) -> Effect:
    """The effect of a typed term.

    Args:
        term: the tension it adds [N].
        stated: values of its parameters; 1 for the rest. Bounds are a thousand times the value either way.

    Raises:
        InputError: names what in the term cannot be used; field "effects.custom.term".
    """
    tree, evaluate, names = _parsed(term)
    parameters = [name for name in names if name not in SYMBOLS]
    for name in parameters:
        if name in _TAKEN or name.startswith("_") or len(name) > _LONGEST_NAME:
            raise refused(f"'{name[:80]}' cannot be the name of a parameter", hint="e.g. c, c1, stiffness")
    timed = "t" in names
    if not parameters:
        raise refused("the term has no parameter that could be fitted", hint="e.g. c*sign(v)*P")
    check_written_out(tree=tree, term=term)
    check_derivatives(evaluate=evaluate, names=names, term=term)
    unknown = [name for name in stated or {} if name not in parameters]
    if unknown:
        raise InputError(
            f"the term has no parameter '{unknown[0]}'",
            field=f"effects.{CUSTOM}.{unknown[0]}",
            hint=did_you_mean(unknown[0], parameters),
        )

    def tension(**known: Any) -> Value:
        muscle: Muscle = known["muscle"]
        values = {
            "P": known["pressure"],
            "kappa": muscle.contraction(known["length"]),
            "L": known["length"],
            "v": known["velocity"],
            "direction": known["direction"],
            "t": known.get("elapsed", 0.0),
            "pi": math.pi,
        }
        with errors_of_term(term=term):
            return evaluate({**values, **{name: known[name] for name in parameters}})

    def rates(**_: Any) -> tuple[Value, ...]:
        return (1.0,)

    wanted = ["muscle", "length", "pressure", "velocity", "direction", *parameters]
    _declare(tension, [*wanted, *(["elapsed"] if timed else [])])
    slots: dict[str, Callable[..., Value]] = {"friction": tension}
    states: tuple[StateVariable, ...] = ()
    if timed:
        _declare(rates, ["pressure"])
        slots["rates"] = rates
        states = (StateVariable("elapsed", "t", "s", 1.0, "Time since the record began."),)
    user = Source("typed by the user", "user")
    return TypedEffect(
        term=term,
        title="Custom term",
        family="friction",
        type="static",
        cause=f"A term that was typed or proposed from data: {term}. Its cause is unknown.",
        equation=r"F_{custom} = \mathtt{" + term.replace("_", r"\_").replace("**", "^") + "}",
        parameters=tuple(_parameter(name, (stated or {}).get(name, 1.0), user) for name in parameters),
        slots=slots,
        states=states,
        kinds=frozenset({"isobaric", "isometric", "isotonic", "static", "transient"}),
        signature=Signature(f"the typed term {term}", None, None, (), "lumped"),
        confused_with=(),
        references=(user,),
        examples=(Example("force_change", 0.0, 1.0, user, {}, {}, {}),),
    ).named(CUSTOM)


def typed_formula(text: str, symbols: Mapping[str, str], *, field: str) -> TermFunction:
    """A formula of given symbols and numbers, in the language of typed terms: a function of known values.

    Args:
        text: as it was typed, "0.03 - 0.005*angle**2".
        symbols: name -> meaning of what it may contain, besides pi and the functions.
        field: where it stands, for errors.

    Raises:
        InputError: names what in the formula cannot be used; at the field.
    """
    known = {**symbols, "pi": SYMBOLS["pi"]}
    try:
        tree, evaluate, names = _parsed(text)
        other = [name for name in names if name not in known]
        if other:
            listed = ", ".join(f"{name} ({meaning})" for name, meaning in symbols.items())
            raise refused(f"'{other[0][:80]}' is not known in this formula", hint=f"{listed}, pi and numbers")
        if any(isinstance(part, ast.Name) and part.id == "v" for part in ast.walk(tree)):
            raise refused("this formula has no velocity v", hint=f"of {', '.join(symbols)}")
        check_written_out(tree=tree, term=text)
    except InputError as error:
        message = error.message.replace("the term", "the formula").replace("a term", "a formula")
        hint = None if error.hint is None else error.hint.replace("-c*sign(v)*P", "0.03 - 0.005*angle**2")
        raise InputError(message, field=field, hint=hint) from error

    def value(values: Mapping[str, Value]) -> Value:
        try:
            with errors_of_term(term=text):
                return evaluate({**values, "pi": math.pi})
        except InputError as error:
            raise error.at(field) from error

    return value


def _parsed(term: str) -> tuple[ast.expr, TermFunction, dict[str, None]]:
    """The tree of a typed text, a function of its names, and the names in their order.

    Raises:
        InputError: names what in it cannot be used.
    """
    if not isinstance(term, str) or not term.strip():
        raise refused("the term is empty", hint="e.g. -c*sign(v)*P")
    if len(term) > _LONGEST:
        raise refused(f"the term has {len(term)} characters, at most {_LONGEST}")
    if odd := term[_USABLE.match(term).end() :]:  # type: ignore - it matches the empty text
        raise refused(f"{_character_name(odd[0])} cannot be part of a term", hint=_ALLOWED)
    try:
        tree = ast.parse(term.strip().replace("^", "**"), mode="eval")
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        raise refused(f"'{shown(part=term)}' is not a formula", hint="e.g. -c*sign(v)*P") from error
    names: dict[str, None] = {}
    with errors_of_term(term=term):
        evaluate = _node(tree.body, names, 0)
    return tree.body, evaluate, names


def typed_effect(document: Mapping[str, float | str]) -> tuple[Effect, str]:
    """The effect of a request or document, {"term": text, parameter: value}, and its term.

    Raises:
        InputError: as `custom_effect`; or no term, or a value that is not a number.
    """
    values: dict[str, float] = {}
    for name, value in document.items():
        if name == TERM:
            continue
        try:
            values[name] = float(value)
        except ValueError as error:
            where = f"effects.{CUSTOM}.{name}"
            raise InputError(f"'{str(value)[:40]}' is not a number", field=where, hint="in SI") from error
        if not abs(values[name]) <= _LARGEST:
            where = f"effects.{CUSTOM}.{name}"
            raise InputError(f"{name} is {values[name]:g}, beyond {_LARGEST:g}", field=where, hint="in SI")
    term = document.get(TERM)
    if not isinstance(term, str):
        raise refused("a custom effect needs its term as a text", hint="e.g. c*sign(v)*P")
    return _cached_effect(term, tuple(sorted(values.items()))), term


@lru_cache(maxsize=64)
def _cached_effect(term: str, values: tuple[tuple[str, float], ...]) -> Effect:
    # The same object for the same term, so that its cached machine code is reused.
    return custom_effect(term, dict(values))


@contextmanager
def blamed_on_the_term(effects: Sequence[Effect]) -> Iterator[None]:
    """Turn errors in building and compiling a model with a typed term into an error of the term.

    Errors of a model without a typed term pass unchanged.

    Raises:
        InputError: names the term.
    """
    try:
        yield
    except InputError:
        raise
    except (ArithmeticError, RuntimeError, ValueError) as error:  # of symengine and LLVM
        terms = [effect.term for effect in effects if isinstance(effect, TypedEffect)]
        if not terms:
            raise
        raise refused(
            f"'{shown(part=terms[0])}' cannot be computed together with the rest of the model",
            hint="look for a division by zero, or for a root or power of a negative number",
        ) from error


def _parameter(name: str, value: float, source: Source) -> Parameter:
    reach = min(_REACH * abs(value), _LARGEST) or 1.0
    return Parameter(
        name,
        name,
        "SI",
        default=value,
        lower=-reach,
        upper=reach,
        source=source,
        description="Parameter of the typed term.",
        off=0.0,
    )


def _declare(function: Callable[..., Value], names: list[str]) -> None:
    # An effect's functions request their inputs by the names of their keyword-only arguments.
    arguments = [Argument(name, Argument.KEYWORD_ONLY) for name in names]
    function.__signature__ = CallSignature(arguments)  # type: ignore


def _node(node: ast.expr, names: dict[str, None], depth: int) -> TermFunction:
    """A function of the known values, from a permitted part of the formula; constants are evaluated."""
    part = _part(node, names, depth)

    def evaluate(known: Mapping[str, Value]) -> Value:
        return finite(part=node, evaluate=part, known=known)

    try:
        number = evaluate({"pi": math.pi})
    except KeyError:  # it has symbols or parameters
        return evaluate
    return lambda _: number


def _part(node: ast.expr, names: dict[str, None], depth: int) -> TermFunction:
    if depth > _DEEPEST:
        raise refused("the term is nested too deeply")
    if isinstance(node, ast.Constant) and type(node.value) in (int, float):
        written: Any = node.value
        return lambda _: float(written)
    if isinstance(node, ast.Name):
        name = node.id
        names.setdefault(name)
        if name in FUNCTIONS or name == "sign":
            raise refused(f"{name} is a function", hint=f"e.g. {name}(v)")
        return lambda known: known[name]
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, ast.USub | ast.UAdd):
        inner = _node(node.operand, names, depth + 1)
        return inner if isinstance(node.op, ast.UAdd) else lambda known: -inner(known)
    if isinstance(node, ast.BinOp) and type(node.op) in _OPERATORS:
        left, right = (_node(part, names, depth + 1) for part in (node.left, node.right))
        operate = _OPERATORS[type(node.op)]
        return lambda known: operate(left(known), right(known))
    if isinstance(node, ast.Call):
        return _call(node, names, depth)
    raise refused(f"'{shown(part=node)}' cannot be part of a term", hint=_ALLOWED)


def _call(node: ast.Call, names: dict[str, None], depth: int) -> TermFunction:
    name = node.func.id if isinstance(node.func, ast.Name) else shown(part=node.func)
    if name != "sign" and name not in FUNCTIONS:
        raise refused(f"there is no function '{name}'", hint=did_you_mean(name, ("sign", *FUNCTIONS)))
    if len(node.args) != 1 or node.keywords:
        raise refused(f"{name} takes one argument", hint=f"e.g. {name}(v)")
    if name == "sign":
        if isinstance(node.args[0], ast.Name) and node.args[0].id == "v":
            return lambda known: known["direction"]
        inner = _node(node.args[0], names, depth + 1)
        return lambda known: ops.sign(inner(known))
    inner, function = _node(node.args[0], names, depth + 1), FUNCTIONS[name]
    return lambda known: function(inner(known))


def _character_name(character: str) -> str:
    if not character.isprintable():
        return f"the character U+{ord(character):04X}"
    return _QUOTES.get(character, f"'{character}'")


_OPERATORS: Mapping[type[ast.operator], Callable[[Any, Any], Value]] = {
    ast.Add: lambda a, b: a + b,
    ast.Sub: lambda a, b: a - b,
    ast.Mult: lambda a, b: a * b,
    ast.Div: lambda a, b: a / b,
    ast.Pow: lambda a, b: a**b,
}
