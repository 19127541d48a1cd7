"""Calibrations that a text writes as a formula: ``F [N] = 203.4 * (U_F - 0.012)``, ``p = 2.5 bar/V * U``."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from mckibben.measurement.read.head_text import taken_apart
from mckibben.measurement.read.unit_words import RAW_DIMENSIONS, dimension_of, unit_of

_NUMBER = r"[0-9]+(?:[.,][0-9]+)?(?:[eE][+-]?[0-9]{1,3})?"
_TOKEN = re.compile(
    rf"\s*(?:(?P<number>{_NUMBER})|(?P<name>[^\W\d]\w*(?:\s*[\[(]\s*[^\W\d]\w{{0,5}}\s*[\])])?)|"
    r"(?P<sign>[-+*/()×·−⋅]))"
)
_COMPOUND = re.compile(r"\s*([^\W\d_]+[2²]?)\s*/\s*([^\W\d_]+)(?![\w(])")
_UNIT = re.compile(r"\s*[\[(]?([^\W\d_%]+[2²]?|%)[\])]?(?!\w)")
_LEFT = re.compile(r"([^\W\d][^=;:|]{0,40}?)\s*$")
_GOES_ON = re.compile(r"\s*(?:[-+*/×·^²³⋅]|\((?!\s*[^\W\d_]+\s*[),;]))")
_LONGEST = 120  # characters of a formula


class Formula(NamedTuple):
    """``name [unit] = factor * symbol + offset``."""

    name: str
    unit: str
    symbol: str
    factor: float
    offset: float
    text: str


class _Line(NamedTuple):
    """A term: ``factor * symbol + offset``; ``unit`` of its numbers, "" where none stands behind them."""

    factor: float
    offset: float


def formulas_in(text: str) -> Iterator[Formula]:
    """The straight lines that a text states, each of one symbol and with the unit of its result.

    >>> next(formulas_in("load cell: F [N] = 200*(U_F - 0.5)"))[:5]
    ('F', 'N', 'U_F', 200.0, -100.0)
    """
    for sign in re.finditer(r"(?<![=<>!])=(?!=)", text):
        left = _LEFT.search(re.split(r"[;|]|:\s|,\s", text[: sign.start()])[-1])
        if left is None:
            continue
        parser = _Parser(text[sign.end() : sign.end() + _LONGEST])
        line = parser.whole()
        if line is None or not line.factor or parser.symbol is None or not parser.operations:
            continue
        if _GOES_ON.match(parser.rest):
            continue  # with a second signal, a power, or what is not understood
        head = taken_apart(left[1])
        behind = _UNIT.match(parser.rest)
        after = unit_of(behind[1]) if behind else None
        unit = head.unit or (after.unit if after and _measures(after.unit) else None) or parser.unit
        if unit is None or not _measures(unit):
            continue
        shown = f"{left[1].strip()} ={text[sign.end() : sign.end() + parser.at]}".strip()
        yield Formula(head.name or left[1].strip(), unit, parser.symbol, line.factor, line.offset, shown)


def _measures(unit: str) -> bool:
    return dimension_of(unit) not in ("", *RAW_DIMENSIONS)


class _Parser:
    """The longest straight line at the beginning of a text.

    Attributes:
        at: where it ends.
        symbol: its variable; ``unit``: of its result, where its numbers say it; ``operations``: their number.
    """

    def __init__(self, text: str) -> None:
        self._text = text
        self.at = 0
        self.symbol: str | None = None
        self.unit: str | None = None
        self.operations = 0

    @property
    def rest(self) -> str:
        """What stands behind the line."""
        return self._text[self.at :]

    def whole(self) -> _Line | None:
        """The sum at the beginning of the text; None = there is none."""
        try:
            return self._sum()
        except ValueError:
            return None

    def _sign(self, wanted: str) -> str:
        """The sign that comes next, if it is a wanted one; "" else."""
        found = _TOKEN.match(self._text, self.at)
        sign = (found["sign"] or "") if found else ""
        sign = {"×": "*", "·": "*", "⋅": "*", "−": "-"}.get(sign, sign)
        if not sign or sign not in wanted or found is None:
            return ""
        self.at = found.end()
        return sign

    def _sum(self) -> _Line:
        negative = self._sign("+-") == "-"
        total = self._product()
        total = _Line(-total.factor, -total.offset) if negative else total
        while True:
            begin = self.at
            sign = self._sign("+-")
            if not sign:
                return total
            try:
                more = self._product()
            except ValueError:
                self.at = begin
                return total
            self.operations += 1
            turn = -1.0 if sign == "-" else 1.0
            total = _Line(total.factor + turn * more.factor, total.offset + turn * more.offset)

    def _product(self) -> _Line:
        total = self._factor()
        while True:
            begin = self.at
            sign = self._sign("*/")
            if not sign and (found := _TOKEN.match(self._text, self.at)) is not None:
                implied = (found["name"] and self.symbol is None and not total.factor) or found["sign"] == "("
                sign = "*" if implied else ""
            if not sign:
                return total
            try:
                other = self._factor()
            except ValueError:
                self.at = begin
                return total
            self.operations += 1
            if sign == "/":
                if other.factor or not other.offset:
                    raise ValueError("no straight line")
                total = _Line(total.factor / other.offset, total.offset / other.offset)
            elif total.factor and other.factor:
                raise ValueError("no straight line")
            else:
                total = _Line(
                    total.factor * other.offset + total.offset * other.factor, total.offset * other.offset
                )

    def _factor(self) -> _Line:
        found = _TOKEN.match(self._text, self.at)
        if found is None:
            raise ValueError("no number")
        if found["number"]:
            self.at = found.end()
            self._take_unit()
            return _Line(0.0, float(found["number"].replace(",", ".")))
        if found["name"]:
            name, _, inside = re.sub(r"\s*[\[(]\s*", "[", found["name"]).partition("[")
            if self.symbol not in (None, name):
                raise ValueError("two symbols")
            unit = unit_of(inside.strip(" )]")) if inside else None
            own = unit is None or not _measures(unit.unit)  # the unit of the result stands behind the formula
            self.symbol, self.at = name, found.end() if own else found.start("name") + len(name)
            return _Line(1.0, 0.0)
        if found["sign"] in ("(",):
            self.at = found.end()
            inner = self._sum()
            if not self._sign(")"):
                raise ValueError("a bracket that is not closed")
            return inner
        if found["sign"] in ("-", "−"):
            self.at = found.end()
            inner = self._factor()
            return _Line(-inner.factor, -inner.offset)
        raise ValueError("no number")

    def _take_unit(self) -> None:
        """Take the unit behind a number: "200 N/V" is of N, "0.012 V" of the symbol."""
        compound = _COMPOUND.match(self._text, self.at)
        if compound is not None:
            over, under = unit_of(compound[1]), unit_of(compound[2])
            if over and under and dimension_of(under.unit) in RAW_DIMENSIONS and _measures(over.unit):
                self.unit, self.at = over.unit, compound.end()
                return
        found = _UNIT.match(self._text, self.at)
        unit = unit_of(found[1]) if found and found[1] != "x" else None
        if found is None or unit is None or not dimension_of(unit.unit):
            return
        if dimension_of(unit.unit) in RAW_DIMENSIONS and self.symbol is None:
            following = re.match(r"\s*[-+)]", self._text[found.end() :])
            if following is None:
                return  # "200 V" may be 200 times the column V
        if _measures(unit.unit):
            self.unit = self.unit or unit.unit
        self.at = found.end()
