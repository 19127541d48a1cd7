"""Takes subexpressions that are constant during a run out of the equations, to compute them once."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import symengine as se

# symengine's relations have no ``func`` to rebuild them with.
_BUILT = {
    "StrictLessThan": se.Lt,
    "LessThan": se.Le,
    "Equality": se.Eq,
    "Unequality": se.Ne,
    "And": se.And,
    "Or": se.Or,
    "Not": se.Not,
}


_PREFIX = "c_"


def is_invariant(expression: Any) -> bool:
    """Whether an expression is a symbol that `Invariants` has made."""
    return bool(expression.is_Symbol) and str(expression).startswith(_PREFIX)


class Invariants:
    """Rewrites expressions: each maximal subexpression of constants only is replaced by a new symbol.

    Args:
        constants: symbols that do not change during a run.

    Attributes:
        values: subexpression -> its symbol, of all expressions so far; single constants included.
    """

    def __init__(self, constants: Iterable[Any]) -> None:
        self.values: dict[Any, Any] = {}
        self._constants = frozenset(constants)
        self._known: dict[Any, tuple[Any, bool]] = {}

    def without(self, expressions: Sequence[Any]) -> list[Any]:
        """The expressions in terms of what varies and of the symbols of `values`."""
        return [self._symbol(*self._rewritten(se.sympify(expression))) for expression in expressions]

    def _symbol(self, expression: Any, constant: bool = True) -> Any:
        """The symbol of a constant subexpression; numbers and what varies stay as they are."""
        if not constant or not expression.free_symbols:
            return expression
        build = _BUILT.get(type(expression).__name__)
        if build is not None:  # a condition is not a number and stays
            return build(*(self._symbol(part) for part in expression.args))
        return self.values.setdefault(expression, se.Symbol(f"{_PREFIX}{len(self.values)}"))

    def _rewritten(self, expression: Any) -> tuple[Any, bool]:
        """The expression with its constant parts replaced, and whether the expression itself is constant."""
        known = self._known.get(expression)
        if known is None:
            known = self._known[expression] = self._walked(expression)
        return known

    def _walked(self, expression: Any) -> tuple[Any, bool]:
        if expression.is_Symbol:
            return expression, expression in self._constants
        if not expression.args:
            return expression, True
        parts = [self._rewritten(part) for part in expression.args]
        if all(constant for _, constant in parts):
            return expression, True
        if isinstance(expression, se.Add | se.Mul):
            build = se.Add if isinstance(expression, se.Add) else se.Mul
            varying = [part for part, constant in parts if not constant]
            fixed = [part for part, constant in parts if constant]
            return build(*([self._symbol(build(*fixed))] if fixed else []), *varying), False
        if isinstance(expression, se.Piecewise):
            new = [self._symbol(*part) for part in parts]
            return se.Piecewise(*zip(new[0::2], new[1::2], strict=True)), False
        build = _BUILT.get(type(expression).__name__) or expression.func
        return build(*(self._symbol(*part) for part in parts)), False
