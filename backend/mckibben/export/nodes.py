"""Expressions in one form, whatever the process has computed before, and without what has no effect.

symengine orders operands by the names of temporary symbols, which depend on all that came before. Here they
are ordered by what they are, equal expressions are one node, and factors of one, terms of zero and choices
between equal values are left out. Nothing is multiplied out.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from hashlib import sha256
from typing import Any

import symengine as se

from mckibben.physics.errors import InputError

_UNORDERED = ("Add", "Mul", "And", "Or")


@dataclass(frozen=True, slots=True, eq=False)
class Node:
    """An expression.

    Attributes:
        kind: name of its class in symengine; "Number", "Symbol" and "Truth" have no operands.
        operands: in a fixed order.
        key: equal for equal expressions.
        value: of a number; 1 and 0 for true and false.
        symbol: of a symbol.
    """

    kind: str
    operands: tuple[Node, ...]
    key: str
    value: float = math.nan
    symbol: Any = None

    @property
    def boolean(self) -> bool:
        """Whether it is a condition."""
        return self.kind in (
            "StrictLessThan",
            "LessThan",
            "Equality",
            "Unequality",
            "And",
            "Or",
            "Not",
            "Truth",
        )


class Nodes:
    """Nodes of symengine's expressions; equal ones are the same object."""

    def __init__(self) -> None:
        self._of: dict[Any, Node] = {}
        self._by_key: dict[str, Node] = {}

    def of(self, expression: Any) -> Node:
        """The node of an expression.

        Raises:
            InputError: it contains a number that is not finite.
        """
        known = self._of.get(expression)
        if known is None:
            known = self._of[expression] = self._built(expression)
        return known

    def number(self, value: float) -> Node:
        """The node of a number."""
        if not math.isfinite(value):
            raise InputError(
                "the model contains a number that is not finite",
                hint="look for a division by zero in the term",
            )
        return self._kept(Node("Number", (), f"0{value!r}", value))

    def power(self, base: Node, exponent: float) -> Node:
        """A power of a node."""
        return base if exponent == 1.0 else self._composed("Pow", (base, self.number(exponent)))

    def _kept(self, node: Node) -> Node:
        return self._by_key.setdefault(node.key, node)

    def _composed(self, kind: str, operands: Iterable[Node]) -> Node:
        parts = tuple(operands)
        if kind in _UNORDERED:
            parts = tuple(sorted(parts, key=lambda part: part.key))
        key = "9" + sha256(":".join((kind, *(part.key for part in parts))).encode()).hexdigest()
        return self._kept(Node(kind, parts, key))

    def _built(self, expression: Any) -> Node:
        if expression.is_Symbol:
            return self._kept(Node("Symbol", (), f"5{expression}", symbol=expression))
        kind = type(expression).__name__
        if kind in ("BooleanTrue", "BooleanFalse"):
            return self._kept(Node("Truth", (), kind, float(kind == "BooleanTrue")))
        if expression.is_Number or not expression.args:
            return self.number(float(expression.n(53, real=True)))
        parts = [self.of(part) for part in expression.args]
        if kind == "Add":
            return self._sum(parts)
        if kind == "Mul":
            return self._product(parts)
        if kind == "Piecewise" and all(value is parts[0] for value in parts[0::2]):
            return parts[0]
        if kind == "Pow" and parts[0].value == 0.0 and parts[1].value > 0.0:
            return parts[0]
        return self._composed(kind, parts)

    def _sum(self, parts: Sequence[Node]) -> Node:
        terms = [part for part in parts if part.value != 0.0]
        if len(terms) < 2:
            return terms[0] if terms else self.number(0.0)
        return self._composed("Add", terms)

    def _product(self, parts: Sequence[Node]) -> Node:
        if any(part.value == 0.0 for part in parts):
            return self.number(0.0)
        coefficient = math.prod(part.value for part in parts if part.kind == "Number")
        factors = [part for part in parts if part.kind != "Number"]
        if coefficient != 1.0 or not factors:
            factors.append(self.number(coefficient))
        return factors[0] if len(factors) == 1 else self._composed("Mul", factors)


def ordered(expressions: Iterable[Any]) -> list[Any]:
    """symengine's expressions in an order that depends on nothing but them."""
    nodes = Nodes()
    return sorted(expressions, key=lambda expression: nodes.of(se.sympify(expression)).key)
