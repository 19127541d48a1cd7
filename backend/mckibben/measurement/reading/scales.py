"""Scales of raw signals in texts and answers: ``0.5 bar/V``, ``0-10 V = 0-10 bar``, ``p = 1.25*U - 0.62
bar``.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

from mckibben.measurement.reading.heads import taken_apart
from mckibben.measurement.reading.lexicon import pattern_of, rules, word_set, words_of
from mckibben.measurement.reading.units import RAW, Unit, dimension_of, number_of, unit_of

_NUMBER = r"[-+]?\d{1,9}(?:[.,]\d{1,9})?"
_ANSWER_RANGE = re.compile(
    rf"(?P<low>{_NUMBER})\s?(?P<rawfirst>[^\W\d_]{{1,7}}|%FS|%)?\s?(?:-|–|to|bis|\.{{2,3}}|…)\s?(?P<high>{_NUMBER})\s?(?P<raw>[^\W\d_]{{0,7}}(?:/V)?|%FS|%)"
    rf"\s?(?:=|->|→|≙)\s?(?P<from>{_NUMBER})\s?(?P<unitfirst>[^\W\d_]{{1,7}})?\s?(?:-|–|to|bis|\.{{2,3}}|…)\s?(?P<value>{_NUMBER})\s?(?P<unit>\S{{1,12}})"
)
_ANSWER_ONE = re.compile(
    rf"(?P<high>{_NUMBER})\s?(?P<raw>[^\W\d_]{{1,7}}(?:/V)?|%FS|%)\s?(?:=|->|→|≙)\s?(?P<value>{_NUMBER})\s?(?P<unit>\S{{1,12}})"
)
_ANSWER_PER = re.compile(
    rf"(?P<value>{_NUMBER})\s?(?P<unit>[^\s/\d]{{1,8}})\s?/\s?(?P<raw>[^\W\d_]{{1,7}}(?:/V)?)"
)


class Scale(NamedTuple):
    """value [unit] = factor * (reading - offset); ``raw``: unit of the reading, empty = not said."""

    factor: float
    offset: float
    unit: str
    raw: str = ""
    rule: str = ""
    weight: float = 6.0
    text: str = ""
    absolute: bool | None = None
    name: str = ""


@lru_cache(maxsize=4096)
def scales_in(text: str) -> tuple[tuple[Scale, str], ...]:
    """(scale, words around it) of every calibration in a text."""
    if not any(character.isdigit() for character in text):
        return ()
    found: list[tuple[Scale, str]] = []
    states = valve_scale(text)
    if states is not None:
        found.append((states, text))
    points = _points(text)
    taken = bytearray(len(text))
    if points is not None:
        for _, (begin, end) in points:
            taken[begin:end] = b"x" * (end - begin)
        if (scale := _through(points)) is not None:
            found.append((scale, f"{_before(text, points[0][1][0])} {text}"))
    slopes: list[tuple[Scale, re.Match[str]]] = []
    for rule in sorted((r for r in rules("text") if "scale" in r.claims), key=lambda r: -r.weight):
        for match in pattern_of(rule).finditer(text):
            begin, end = match.span()
            scale = None if any(taken[begin:end]) else _of_match(match, rule.id, rule.weight)
            if scale is not None:
                taken[begin:end] = b"x" * (end - begin)
                slopes.append((scale, match))
    if slopes:
        zeros = [m for m in _POINT.finditer(text) if number_of(m["y"]) == 0.0 and number_of(m["x"]) != 0.0]
        offsets = list(_OFFSET.finditer(text))
        at_zero = _zero_reading(text, taken)
        for scale, match in slopes:
            near = [o for o in offsets if len(slopes) == 1 or 0 <= o.start() - match.end() < _NEAR]
            scale = _shifted(scale, match, zeros, near)
            is_length = dimension_of(scale.unit) == "length"
            if at_zero is not None and (
                (is_length and at_zero.at_rest) or (len(slopes) == 1 and not scale.offset)
            ):
                scale = _from_zero(scale, at_zero)
            found.append((scale, f"{_before(text, match.start())} {match[0]}"))
    return tuple(found)


def _before(text: str, begin: int) -> str:
    """The words before a calibration, since the last comma."""
    return re.split(r"[;,](?!\d)", text[:begin])[-1]


def _shifted(
    scale: Scale, match: re.Match[str], zeros: Sequence[re.Match[str]], offsets: Sequence[re.Match[str]]
) -> Scale:
    """A slope with the reading that belongs to 0: taken off, stated, or by what is added behind it."""
    text, end = match.string, match.end()
    if scale.offset or scale.rule == _FORMULA:
        return scale
    shift = _SHIFTED.search(text, end)
    if shift is not None and shift.start() - end < _NEAR:
        return scale._replace(offset=number_of(shift["number"]) * (1.0 if shift["sign"] != "+" else -1.0))
    if scale.rule in ("calibration_per_volt", "calibration_point"):
        for zero in zeros:
            unit, own = unit_of(zero["unit"]), unit_of(scale.unit)
            if unit is not None and own is not None and unit.dimension == own.dimension:
                return scale._replace(offset=number_of(zero["x"]))
    if (added := _ADDED.match(text, end)) is not None:
        more = number_of(f"{added['sign'].replace('−', '-')}{added['number']}")
        return scale._replace(offset=-more / scale.factor)
    return scale._replace(offset=number_of(offsets[0]["number"])) if offsets else scale


class _ZeroReading(NamedTuple):
    """What a sensor shows without load, or at the rest length."""

    number: float
    raw: str
    at_rest: bool


_RAW_READING = re.compile(
    r"(?i)(?<![\w.,])(?P<number>[-+−]?\d{1,7}(?:[.,]\d{1,6})?)\s?(?P<raw>m?V|m?A|counts?|digits?|%)(?![\w/])"
)


def _zero_reading(text: str, taken: bytearray) -> _ZeroReading | None:
    """The only reading of a text, beside its calibrations, whose clause says that nothing pulls: "reads
    -0.035 V unloaded", "4 mA at the rest length".
    """
    found = []
    for match in _RAW_READING.finditer(text):
        if any(taken[match.start() : match.end()]):
            continue
        begin = max(text.rfind(sign, 0, match.start()) for sign in (", ", "; ", ". ", "("))
        ends = [i for sign in (", ", "; ", ". ", ")") if (i := text.find(sign, match.end())) >= 0]
        words = words_of(text[begin + 1 : min(ends, default=len(text))])
        rests = word_set("at_rest").among(words)
        free = word_set("without").among(words) and word_set("load").among(words)
        if rests or free or word_set("zero_offset").among(words):
            found.append(_ZeroReading(number_of(match["number"]), match["raw"], rests))
    return found[0] if len(found) == 1 else None


def _from_zero(scale: Scale, reading: _ZeroReading) -> Scale:
    """The scale that is 0 at a reading; one in millivolts of a signal in volts is converted."""
    own, raw = unit_of(reading.raw), unit_of(scale.raw) if scale.raw else None
    factor = 1.0
    if own is not None and raw is not None and own.name != raw.name:
        if {own.name, raw.name} != {"mV", "V"}:
            return scale
        factor = 1e-3 if own.name == "mV" else 1e3
    return scale._replace(offset=factor * reading.number)


_NEAR = 4  # characters behind a slope, in which its shift begins
#: The reading that is taken off: "(U - 1 V)".
_SHIFTED = re.compile(
    r"\(\s?[^\W\d]\w{0,20}\s?(?P<sign>[-−–+])\s?(?P<number>\d{1,7}(?:[.,]\d{1,6})?)\s?(?:V|mV|mA|counts?)?\s?\)"
)
_FORMULA = "calibration_formula"  # the rule in which a signal has its name
#: What is added behind the slope: "2.5 bar/V * U_p - 1.25 bar".
_ADDED = re.compile(
    r"\s?[*·x×]\s?[^\W\d]\w{0,20}\s?(?P<sign>[-−+])\s?(?P<number>\d{1,7}(?:[.,]\d{1,6})?)(?!\s?(?:m?V|mA|counts?)(?!\w))"
)
#: The reading at zero, in its own unit: "offset 0.12 V".
_OFFSET = re.compile(
    r"(?i)(?<![^\W\d_])(?:zero|offset|null(?:punkt|wert)?|bias|d[ée]calage|nulpunt)\s?(?:=|:|of|bei|at|de)?\s?"
    r"(?P<number>[-+]?\d{1,7}(?:[.,]\d{1,6})?)\s?(?:m?V|mA|counts?|digits?)(?![\w/])"
)
_STATE = re.compile(
    r"(?P<before>[^\W\d_]+)?\s?(?P<link>[=:@(]|\b(?:at|bei|à|a|bij|vid|ved)\b)?\s?(?<![\d.,])(?P<number>-?\d{1,4}(?:[.,]\d{1,4})?)\s?(?P<raw>mV|V|mA|A|%|)(?!\w|[.,]\d)\)?"
    r"(?=(?:\s?(?:=|≙|:|->|→|is)?\s?(?P<behind>[^\W\d_]+(?:\s[^\W\d_]+){0,3}))?)"
)
_POINT = re.compile(
    r"(?<![\d.,-])(?P<x>-?\d{1,7}(?:[.,]\d{1,6})?)\s?(?P<raw>mV/V|mV|V|mA|counts?|digits?)\s?(?:=|->|→|≙|:|at|bei)\s?"
    r"(?P<y>-?\d{1,7}(?:[.,]\d{1,6})?)\s?(?P<unit>[^\W\d_]{1,5}(?:\s?\((?:g|a|abs|gauge)\))?|%)(?![\w/])"
)
#: The same the other way round: "0 bar = 0.5 V".
_POINT_REVERSED = re.compile(
    r"(?<![\d.,-])(?P<y>-?\d{1,7}(?:[.,]\d{1,6})?)\s?(?P<unit>[^\W\d_]{1,5}(?:\s?\((?:g|a|abs|gauge)\))?|%)\s?(?:=|->|→|≙|:|at|bei)\s?"
    r"(?P<x>-?\d{1,7}(?:[.,]\d{1,6})?)\s?(?P<raw>mV/V|mV|V|mA|counts?|digits?)(?![\w/])"
)
_STRAIGHT = 0.005  # of the range, that points of one line may be off


def _points(text: str) -> list[tuple[tuple[float, float, str, Unit], tuple[int, int]]] | None:
    """The points ``0.5 V = 0 bar, 4.5 V = 10 bar`` of a text that has two or more in one pair of units."""
    found = []
    ways = [list(point.finditer(text)) for point in (_POINT, _POINT_REVERSED)]
    for match in max(ways, key=len):
        unit = unit_of(match["unit"])
        if unit is not None and unit.dimension not in ("", *RAW):
            found.append(((number_of(match["x"]), number_of(match["y"]), match["raw"], unit), match.span()))
    return found if len({f[0][0] for f in found}) > 1 and len({f[0][2:] for f in found}) == 1 else None


def _through(points: list[tuple[tuple[float, float, str, Unit], tuple[int, int]]]) -> Scale | None:
    """The line through points; None = they lie on none."""
    distinct = sorted({(x, y) for (x, y, _, _), _ in points})
    (x0, y0), (x1, y1) = distinct[0], distinct[-1]
    slope = (y1 - y0) / (x1 - x0) if x1 != x0 else 0.0
    if not slope or any(abs(y0 + slope * (x - x0) - y) > _STRAIGHT * abs(y1 - y0) for x, y in distinct):
        return None
    raw, unit = unit_of(points[0][0][2]), points[0][0][3]
    return Scale(
        slope,
        x0 - y0 / slope,
        unit.name,
        "" if raw is None else raw.name,
        "points",
        6.6,
        "points",
        unit.absolute,
    )


def valve_scale(text: str) -> Scale | None:
    """The scale of a valve's signal by its states: ``0 V = exhaust, 5 V = closed, 10 V = fill``.

    The share of opening is 0 where the valve is closed, +1 where it fills, -1 where it exhausts.
    """
    states: dict[str, set[tuple[float, str]]] = {}
    for found in _STATE.finditer(text):
        sides = (found["before"], found["behind"]) if found["link"] else (found["behind"], found["before"])
        state = next(filter(None, (state_of(side or "") for side in sides)), None)
        if state is not None:
            states.setdefault(state, set()).add((number_of(found["number"]), found["raw"]))
    signals = {raw for values in states.values() for number, raw in values if raw or number} or {""}
    if len(signals) != 1 or not {"closed", "open"} <= set(states) or any(len(v) > 1 for v in states.values()):
        return None
    level = {state: next(iter(values))[0] for state, values in states.items()}
    span = level["open"] - level["closed"]
    exhaust = level.get("exhaust", level["closed"] - span)
    if span == 0.0 or abs(exhaust - (level["closed"] - span)) > 0.01 * abs(span):
        return None
    signal = signals.pop()
    if not signal and len(states) < 3:
        return None
    return Scale(1.0 / span, level["closed"], "1", signal, "valve states", 6.0, text[:80])


def state_of(text: str) -> str | None:
    """The state of a valve in words: "closed", "open" (it fills), "exhaust"; None = none, or several."""
    words = words_of(text)
    known = {
        "closed": "valve_closed",
        "open": "valve_open|way_shortening",
        "exhaust": "valve_exhaust|way_lengthening",
    }
    found = [state for state, names in known.items() if word_set(names).among(words)]
    if found == ["open", "exhaust"]:
        return "exhaust"  # "fully open to exhaust"
    return found[0] if len(found) == 1 else None


def answered_scale(text: str) -> Scale | None:
    """The scale that a user says: ``0-10 V = 0-10 bar``, ``1 V = 2 bar``, ``0.5 bar/V``; None = it is
    none.
    """
    bare = text.strip()
    for pattern in (_ANSWER_RANGE, _ANSWER_ONE, _ANSWER_PER):
        match = pattern.fullmatch(bare)
        if match is not None and (scale := _of_match(match, "you", 20.0)) is not None:
            return scale
    return None


_TOKEN = re.compile(
    r"\s*(?:(?P<number>\d{1,9}(?:[.,]\d{1,9})?(?:[eE][-+]?\d{1,2})?)|(?P<name>[^\W\d]\w{0,30})"
    r"|(?P<sign>[-+*/()−·×]))"
)
_SIGNS = {"−": "-", "·": "*", "×": "*"}


class _Linear:
    """A formula ``slope * reading + constant``, read from left to right by its grammar."""

    def __init__(self, text: str) -> None:
        self.text, self.end, self.symbol = re.sub(r"(?<=[\d)]) ?x ?(?=[\w(])", " * ", text), 0, ""

    def _next(self) -> tuple[str, str]:
        found = _TOKEN.match(self.text, self.end)
        if found is None or found.lastgroup is None:
            return "", ""
        return found.lastgroup, _SIGNS.get(found[found.lastgroup], found[found.lastgroup])

    def _take(self) -> tuple[str, str]:
        token = self._next()
        self.end = found.end() if (found := _TOKEN.match(self.text, self.end)) else self.end
        return token

    def sum(self, depth: int = 0) -> tuple[float, float]:
        """(slope, constant) of terms.

        Raises:
            ValueError: it is no linear formula of one reading.
        """
        slope, constant = self._product(depth)
        while self._next()[1] in ("+", "-"):
            sign = 1.0 if self._take()[1] == "+" else -1.0
            more = self._product(depth)
            slope, constant = slope + sign * more[0], constant + sign * more[1]
        return slope, constant

    def _product(self, depth: int) -> tuple[float, float]:
        slope, constant = self._factor(depth)
        while self._next()[1] in ("*", "/"):
            by = self._take()[1] == "/"
            a, b = self._factor(depth)
            if (a and (slope or by)) or (by and not b):
                raise ValueError("not linear")
            if a:
                slope, constant = constant * a, constant * b
            else:
                slope, constant = (slope / b, constant / b) if by else (slope * b, constant * b)
        return slope, constant

    def _factor(self, depth: int) -> tuple[float, float]:
        kind, text = self._take()
        if kind == "number":
            return 0.0, number_of(text)
        if kind == "name" and self.symbol in ("", text):
            self.symbol = text
            return 1.0, 0.0
        if text == "-":
            slope, constant = self._factor(depth)
            return -slope, -constant
        if text != "(" or depth > 8:
            raise ValueError("no formula")
        inner = self.sum(depth + 1)
        if self._take()[1] != ")":
            raise ValueError("no formula")
        return inner


def _of_formula(match: re.Match[str], weight: float) -> Scale | None:
    """The scale that a formula says: ``p = 1.25*U_p - 0.62 bar``, ``stroke_mm = (adc1 - 102) / 40.98``."""
    formula = _Linear(match["formula"])
    try:
        slope, constant = formula.sum()
    except ValueError:
        return None
    head = taken_apart(match["name"])
    behind = re.match(r"\s?[\[(]?([^\W\d_]{1,5}|%)[\])]?(?![^\W_])", formula.text[formula.end :])
    unit = (
        unit_of(match["unit"] or match["unitin"] or "")
        or head.unit
        or (unit_of(behind[1]) if behind else None)
    )
    if not slope or not formula.symbol or unit is None or not unit.dimension:
        return None
    text = match[0][: match.start("formula") - match.start() + formula.end]
    return Scale(
        slope,
        -constant / slope,
        unit.name,
        formula.symbol,
        _FORMULA,
        weight,
        text,
        unit.absolute,
        match["name"],
    )


_MEASURED = ("pressure", "force", "length", "mass")  # what a signal per unit is of


def _of_match(match: re.Match[str], rule: str, weight: float) -> Scale | None:
    if rule == _FORMULA:
        return _of_formula(match, weight)
    groups = match.groupdict()
    unit = unit_of(groups.get("unit") or "")
    if unit is None or unit.dimension in ("", *RAW):
        return None
    if groups.get("divisor"):
        divisor = number_of(groups["divisor"])
        if divisor == 0.0 or (rule == "calibration_inverse" and unit.dimension not in _MEASURED):
            return None
        value = 1.0 / divisor
    else:
        value = number_of(groups["value"])
    raw = unit_of(groups.get("raw") or "")
    raw_name = "" if raw is None else raw.name
    if groups.get("high"):
        low, high = number_of(groups.get("low") or "0"), number_of(groups["high"])
        begin = number_of(groups.get("from") or "0")
        if high == low or value == begin:
            return None
        factor = (value - begin) / (high - low)
        return Scale(factor, low - begin / factor, unit.name, raw_name, rule, weight, match[0], unit.absolute)
    if value == 0.0:
        return None
    return Scale(
        value, 0.0, unit.name, raw_name or (groups.get("raw") or ""), rule, weight, match[0], unit.absolute
    )
