"""The equations of a drive as source text, for integrators that do not take machine code."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import symengine as se

from mckibben.physics.drive import DriveModel


def translated(model: DriveModel, language: str) -> Callable[[Sequence[Any]], list[Any]]:
    """Packed states, parameters, inputs and switches -> rates, as Python or over CasADi's symbols."""
    switches = [switch.symbol for switch in model.switches]
    arguments = [*model.symbols.values(), *model.parameters.values(), *model.inputs.values(), *switches]
    plain = {symbol: se.Symbol(f"v{index}") for index, symbol in enumerate(arguments)}
    replacements, reduced = se.cse([rate.subs(plain) for rate in model.rates])
    lines = ["def rates(given):"]
    lines += [f"    {', '.join(f'v{index}' for index in range(len(arguments)))} = given"]
    lines += [f"    {symbol} = {_source(value)}" for symbol, value in replacements]
    lines += [f"    return [{', '.join(_source(value) for value in reduced)}]"]
    names = _casadi() if language == "casadi" else _python()
    exec("\n".join(lines), names)
    return names["rates"]


def _source(value: Any) -> str:
    """Source text of an expression; a condition becomes a function, so that both languages can take it."""
    return str(value).replace("Piecewise(", "piecewise(").replace("Ne(", "unequal(")


def _python() -> dict[str, Any]:
    def piecewise(*branches: tuple[float, bool]) -> float:
        return next(value for value, holds in branches if holds)

    return {
        "piecewise": piecewise,
        "And": lambda *parts: all(parts),
        "Or": lambda *parts: any(parts),
        "sqrt": math.sqrt,
        "exp": math.exp,
        "log": math.log,
        "sin": math.sin,
        "cos": math.cos,
        "tan": math.tan,
        "tanh": math.tanh,
        "atan": math.atan,
        "pi": math.pi,
    }


def _casadi() -> dict[str, Any]:
    import casadi

    def piecewise(*branches: tuple[Any, Any]) -> Any:
        (value, holds), *rest = branches
        return value if holds is True or not rest else casadi.if_else(holds, value, piecewise(*rest))

    names = ("sqrt", "exp", "log", "sin", "cos", "tan", "tanh", "atan", "pi")
    return {
        "piecewise": piecewise,
        "And": lambda *parts: casadi.logic_all(casadi.vertcat(*parts)),
        "Or": lambda *parts: casadi.logic_any(casadi.vertcat(*parts)),
        **{name: getattr(casadi, name) for name in names},
    }
