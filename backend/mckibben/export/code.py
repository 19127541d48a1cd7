"""Straight-line code from symbolic expressions, in the words of a language.

symengine's own C printer is not used: it rounds constants to 15 digits, and the order of its operands and
of its common subexpressions changes with what the process has computed before. Here equal expressions give
equal text.
"""

from __future__ import annotations

import math
import textwrap
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import symengine as se

from mckibben.export.language import Language
from mckibben.export.nodes import Node, Nodes
from mckibben.physics.errors import InputError

_COMPARISONS = {"StrictLessThan": "<", "LessThan": "<=", "Equality": "==", "Unequality": "!="}
_WIDTH = 96  # characters of a line; functions and blocks indent it
_MOST_FACTORS = 8  # largest integer exponent that is written as a product
# Binding of the operators of a text, weakest first.
_CONDITION, _SUM, _PRODUCT, _ATOM = range(4)
Text = tuple[str, int]


class Code:
    """Writes the statements that compute some results.

    Args:
        language: words of the language.
        operands: symbol -> its text in the language.

    Attributes:
        variables: names of the variables in the lines so far -> "Real" or "Boolean", for languages that
            declare them elsewhere.
    """

    def __init__(self, language: Language, operands: Mapping[Any, str]) -> None:
        self._language, self._operands = language, operands
        self._nodes = Nodes()
        self._uses: Counter[Node] = Counter()
        self._locals: dict[Node, str] = {}
        self._lines: list[str] = []
        self.variables: dict[str, str] = {}

    def lines(self, results: Sequence[tuple[str, Any]]) -> list[str]:
        """Statements for results, pairs (what is assigned, expression).

        Raises:
            InputError: an expression that the language cannot state.
        """
        wanted = [(target, self._nodes.of(se.sympify(expression))) for target, expression in results]
        self._count([node for _, node in wanted])
        for target, node in wanted:
            self._emit(self._language.assigned(target, self._text(node)[0]))
        return self._lines

    def _emit(self, statement: str) -> None:
        language = self._language
        if language.brackets and len(statement) > _WIDTH:
            head, equals, text = statement.partition(" = ")
            if not equals:
                head, equals, text = statement.partition(" ")
            statement = f"{head}{equals}({text})"
        self._lines += wrapped(statement, language.continued)

    def _count(self, results: list[Node]) -> None:
        """How often each node is a result or an operand of another one."""
        self._uses.update(results)
        seen: set[Node] = set()
        while results:
            node = results.pop()
            if node not in seen:
                seen.add(node)
                self._uses.update(node.operands)
                results += node.operands

    def _text(self, node: Node) -> Text:
        """The node; one that occurs several times is first assigned to a variable."""
        if node.kind == "Symbol":
            return self._operands[node.symbol], _ATOM
        if node.kind == "Number":
            return repr(node.value), _ATOM if node.value >= 0.0 else _PRODUCT
        if node.kind == "Truth":
            return self._language.truth(bool(node.value)), _ATOM
        if node in self._locals:
            return self._locals[node], _ATOM
        text = self._composed(node)
        return self._local(node, text[0]) if self._uses[node] > 1 and not _is_negated(node) else text

    def _local(self, node: Node, text: str) -> Text:
        name = self._locals[node] = f"t{len(self._locals)}"
        self.variables[name] = "Boolean" if node.boolean else "Real"
        self._emit(self._language.declared(name, text, boolean=node.boolean))
        return name, _ATOM

    def _composed(self, node: Node) -> Text:
        match node.kind:
            case "Add":
                return self._sum(node), _SUM
            case "Mul":
                return self._product(node)
            case "Pow":
                return self._power(*node.operands)
            case "Piecewise":
                return self._choice(node), _ATOM
            case "And" | "Or" | "Not":
                return self._language.logic(
                    node.kind, [self._inside(part, _SUM) for part in node.operands]
                ), _ATOM
            case kind if kind in _COMPARISONS:
                a, b = (self._inside(part, _SUM) for part in node.operands)
                return f"{a} {_COMPARISONS[kind]} {b}", _CONDITION
        function = self._language.functions.get(node.kind)
        if function is None:
            raise InputError(
                f"the model contains {node.kind}, which cannot be written in {self._language.name}"
            )
        return f"{function}({self._text(node.operands[0])[0]})", _ATOM

    def _inside(self, node: Node, binding: int) -> str:
        """The node as an operand: in brackets if it binds no stronger than its surroundings."""
        text, own = self._text(node)
        return text if own > binding or own == _ATOM else f"({text})"

    def _sum(self, node: Node) -> str:
        text = ""
        for term in sorted(node.operands, key=lambda term: term.kind == "Number"):
            part, binding = self._text(term)
            if binding < _PRODUCT:
                part = f"({part})"
            if not text:
                text = part
            elif part.startswith("-"):
                text += f" - {part[1:]}"
            else:
                text += f" + {part}"
        return text

    def _product(self, node: Node) -> Text:
        """A product with at most one division."""
        above: list[str] = []
        below: list[str] = []
        negative = False
        for factor in node.operands:
            if factor.value == -1.0:
                negative = True
            elif self._uses[factor] == 1 and _is_reciprocal(factor):
                base, exponent = factor.operands
                below.append(self._inside(self._nodes.power(base, -exponent.value), _PRODUCT))
            else:
                above.append(self._inside(factor, _PRODUCT if above else _SUM))
        text = " * ".join(above) or "1.0"
        if below:
            text = f"{text} / {below[0] if len(below) == 1 else '(' + ' * '.join(below) + ')'}"
        if negative:
            text = f"-({text})" if text.startswith("-") else f"-{text}"
        return text, _PRODUCT

    def _power(self, base: Node, exponent: Node) -> Text:
        functions = self._language.functions
        if base.value == math.e:
            return f"{functions['exp']}({self._text(exponent)[0]})", _ATOM
        power = exponent.value
        if power < 0.0:
            return f"1.0 / {self._inside(self._nodes.power(base, -power), _PRODUCT)}", _PRODUCT
        if power == 0.5:
            return f"{functions['sqrt']}({self._text(base)[0]})", _ATOM
        if power % 0.5 == 0.0 and power <= _MOST_FACTORS:
            factor = self._variable(base)
            factors = [factor] * int(power)
            if power % 1.0:
                factors.append(f"{functions['sqrt']}({factor})")
            return " * ".join(factors), _PRODUCT
        return self._language.power(self._text(base)[0], self._text(exponent)[0]), _ATOM

    def _variable(self, node: Node) -> str:
        """The node as a name, for a text that repeats it."""
        text, _ = self._text(node)
        return text if node.kind == "Symbol" or node in self._locals else self._local(node, text)[0]

    def _choice(self, node: Node) -> str:
        *branches, (last, otherwise) = zip(node.operands[0::2], node.operands[1::2], strict=True)
        if otherwise.kind != "Truth":
            raise InputError("the model contains a choice without a last case")
        text = self._text(last)[0]
        for value, condition in reversed(branches):
            text = self._language.choice(self._text(condition)[0], self._text(value)[0], text)
        return text


def _is_reciprocal(node: Node) -> bool:
    return node.kind == "Pow" and node.operands[1].value < 0.0


def _is_negated(node: Node) -> bool:
    """A symbol with a minus sign: needs no variable of its own."""
    return (
        node.kind == "Mul"
        and len(node.operands) == 2
        and node.operands[0].value == -1.0
        and node.operands[1].kind == "Symbol"
    )


def wrapped(statement: str, continued: str) -> list[str]:
    """A statement on lines of at most `_WIDTH` characters, broken at spaces.

    Args:
        statement: on one line, without spaces in quotes; its indentation is kept.
        continued: what ends a line that continues.
    """
    if len(statement) <= _WIDTH:
        return [statement]
    indent = statement[: len(statement) - len(statement.lstrip())]
    lines = textwrap.wrap(
        statement.strip(),
        _WIDTH - len(indent) - 4 - len(continued),
        break_long_words=False,
        break_on_hyphens=False,
    )
    return [
        f"{indent}{'' if number == 0 else '    '}{line}{continued if number < len(lines) - 1 else ''}"
        for number, line in enumerate(lines)
    ]


def indented(lines: Sequence[str], spaces: int) -> Iterator[str]:
    """Lines of a body."""
    return (f"{' ' * spaces}{line}" if line else line for line in lines)
