"""What stays the same throughout a run is taken out of the equations, to be computed once."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import symengine as se

# symengine's relations have no ``func`` to build them anew with.
_BUILT = {
    "StrictLessThan": se.Lt,
    "LessThan": se.Le,
    "Equality": se.Eq,
    "Unequality": se.Ne,
    "And": se.And,
    "Or": se.Or,
    "Not": se.Not,
}


class Invariants:
    """Rewrites expressions: each largest part that holds nothing but constants becomes a symbol of its own.

    Args:
        constants: symbols that do not change during a run.

    Attributes:
        values: part -> its symbol, of all expressions rewritten so far; a constant alone is a part too.
    """

    def __init__(self, constants: Iterable[Any]) -> None:
        self.values: dict[Any, Any] = {}
        self._constants = frozenset(constants)
        self._known: dict[Any, tuple[Any, bool]] = {}

    def without(self, expressions: Sequence[Any]) -> list[Any]:
        """The expressions on what varies and on symbols of `values`."""
        return [self._symbol(*self._rewritten(se.sympify(expression))) for expression in expressions]

    def _symbol(self, expression: Any, constant: bool = True) -> Any:
        """The symbol of a constant part; numbers stay, and so does what varies."""
        if not constant or not expression.free_symbols:
            return expression
        build = _BUILT.get(type(expression).__name__)
        if build is not None:  # a condition is no number and stays
            return build(*(self._symbol(part) for part in expression.args))
        return self.values.setdefault(expression, se.Symbol(f"c_{len(self.values)}"))

    def _rewritten(self, expression: Any) -> tuple[Any, bool]:
        """The expression with its constant parts replaced, or as it is, and whether it is constant itself."""
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
