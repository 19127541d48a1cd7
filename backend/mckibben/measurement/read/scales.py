"""Scales of sensors that a text states: ``1 V = 200 N``, ``4-20 mA = 0-10 bar``, ``20 mV/bar``."""

from __future__ import annotations

import re
from typing import NamedTuple

from mckibben.measurement.read.unit_words import (
    BRIDGE,
    CLOCK,
    COUNT,
    FULL_SCALE,
    RAW_DIMENSIONS,
    dimension_of,
    unit_of,
)
from mckibben.measurement.read.vocabulary import MOVES, VALVE_WORDS, has_word, reference_among, words_of

_NUMBER = r"[+-]?[0-9]+(?:[.,][0-9]+)?"
_COUNTED = r"counts?|cts|digits?|pulses?|incs?|increments?|inkremente|impulse?|ticks?|steps?|LSB"
_SHARE = r"%(?:\s*(?:FS|F\.S\.|full[ -]scale|of (?:full scale|range)|v\.\s?E\.))?"
_RAW = rf"(?P<raw>mV\s?/\s?V|mV|[Vv]olts?|V|mA|A|{_SHARE}|{_COUNTED})"
_UNIT = r"(?P<unit>[^\W\d_]+[0-9²]?(?:/[^\W\d_]+[2²]?)?(?:\s?\((?:a|g|abs|gauge)\))?|%)"
_TO = r"\s*(?:=|≙|≈|:|->|→|for|per|to|is|corresponds to|entspricht|entsprechen|pour|per|für)\s*"
_SPAN = rf"({_NUMBER})\s*(?:-|–|\.\.+|to|bis|\.{{2,3}}|…)\s*({_NUMBER})\s*"
_RANGES = re.compile(rf"{_SPAN}{_RAW}{_TO}{_SPAN}{_UNIT}")
_EQUAL = re.compile(rf"(?<![\d.,-])({_NUMBER})\s*{_RAW}{_TO}({_NUMBER})\s*{_UNIT}")
_MOVED = re.compile(rf"{_SPAN}(?P<raw>[^\W\d_]+){_TO}{_SPAN}(?P<unit>[^\W\d_]+)")
#: The value before the signal: "200 N = 1 V", "0-10 bar -> 4-20 mA", "range 0-10 bar (0-5 V)".
_VALUE_RANGE = re.compile(rf"{_SPAN}{_UNIT}(?:{_TO}|\s*[,/(]\s*){_SPAN}{_RAW}(?![\w/])")
_VALUE_EQUAL = re.compile(
    rf"(?<![\d.,-])({_NUMBER})\s*{_UNIT}(?:{_TO}|\s*(?:@|at|bei|à)\s*)({_NUMBER})\s*{_RAW}(?![\w/])"
)
_RATED = re.compile(
    rf"(?<![\d.,-])({_NUMBER})\s*(?P<raw>mV\s?/\s?V)\s*(?:@|at|bei|à|a|for|=)\s*({_NUMBER})\s*{_UNIT}"
)
_POINT = re.compile(
    rf"(?<![\w.,])({_NUMBER})\s*{_RAW}\s*(?:=|≙|≈|->|→|:|at|bei|for|corresponds to|entspricht)\s*"
    rf"({_NUMBER})\s*{_UNIT}(?![\w/])"
)
_POINT_BACK = re.compile(
    rf"(?<![\w.,])({_NUMBER})\s*{_UNIT}\s*(?:=|≙|≈|->|→|:|at|bei|for|@)\s*({_NUMBER})\s*{_RAW}(?![\w/])"
)
_PER = re.compile(rf"({_NUMBER})\s*{_UNIT}\s*(?:/|\bper\b|\bpro\b|\bje\b|\bpar\b|\bpor\b)\s*{_RAW}\b")
_SENSITIVITY = re.compile(rf"({_NUMBER})\s*{_RAW}\s*/\s*{_UNIT}")
_CLOSED = re.compile(
    rf"({_NUMBER})\s*{_RAW}\s*(?:=|:|is)?\s*(?:closed|shut|zu|geschlossen|neutral|middle|mitte)"
)
_OPEN = re.compile(rf"({_NUMBER})\s*{_RAW}\s*(?:=|:|is)?\s*(?:fully\s+)?(?:opens?|offen|auf)\b")

#: At which reading the value is 0: "0 V at L0", "zero at rest length".
_ZERO = re.compile(
    rf"(?i)(?:\b0(?:[.,]0+)?\s*(?:{_COUNTED}|m?V|m?A)?|\bzero|\bnull)\s*(?:=|at|bei|à|a|en|when|for)\s"
)


#: The reading at the rest length: "4 mA at the rest length", "0 V bei Ruhelänge".
_AT_REST = re.compile(
    rf"(?i)(?<![\w.,])({_NUMBER})\s*(?:{_COUNTED}|m?V|m?A|%)\s*(?:=|at|bei|à|a|for|when|in)\s*(?:the\s+|der\s+|la\s+)?"
    r"(?:rest\w*|L_?0|ruhe\w*|unloaded|relaxed|initial|natural|longueur (?:au repos|initiale)|"
    r"riposo|reposo|repouso)"
)


class Scale(NamedTuple):
    """Value = factor times reading in ``raw`` plus offset, in ``unit``; ``name``: what it is of.

    ``zeroed``: it says at which reading the value is 0, or gives two points.
    """

    factor: float
    offset: float
    raw: str
    unit: str
    name: str
    text: str
    where: str
    zeroed: bool = True


def scale_of(text: str, column: str, where: str) -> Scale | None:
    """The scale that a text states for a column: what stands behind its name, up to a semicolon.

    The name may be its last word alone ("B" of "Channel B").
    """
    for name in dict.fromkeys((column, column.split()[-1] if column.split() else "")):
        if not name:
            continue
        pattern = rf"(?<![\w]){re.escape(name)}(?![\w])\s*(?:\([^)]*\))?\s*(?:[=:,–-]|is\b|->)\s*([^;|]+)"
        if (found := re.search(pattern, text)) is not None:
            said = _of_description(found[1], where)
            if said is not None:
                return said
    return None


def scale_in(text: str, where: str) -> Scale | None:
    """The one scale that a text states, whatever it is of; None = none, or several.

    >>> scale_in("CH1 gauge: 0...10 V = 0...8 bar", "line 2")[:4]
    (0.8, 0.0, 'V', 'bar(g)')
    """
    found = _of_description(text, where)
    if found is None or _of_points(text) is not None:
        return found
    spans = [*_RANGES.finditer(text), *_VALUE_RANGE.finditer(text)]
    rest = text.replace(spans[0][0], " ") if len(spans) == 1 else text
    most = 0 if len(spans) == 1 else 1
    if len(re.findall(rf"\d\s*{_RAW}(?![^\W\d_])", _ZERO.sub(" ", _AT_REST.sub(" ", rest)))) > most:
        return None
    if dimension_of(found.unit) == "a length" and (rest_at := _AT_REST.search(text)) is not None:
        found = found._replace(offset=-found.factor * _float(rest_at[1]), zeroed=True)
    reference = reference_among(words_of(text))
    if reference is not None and dimension_of(found.unit) == "a pressure":
        found = found._replace(unit=f"{found.unit}({'a' if reference else 'g'})")
    return found


_OF_PULLEY = re.compile(r"(?<=[0-9])\s*(?:deg(?:rees?)?\b|°|N\s*[*·.]?\s*m\b)")


def said_scale(text: str) -> Scale | None:
    """The scale that a user says: ``0-10 V = 0-10 bar``, ``4100 to 9300 counts = 0 to 80 mm``.

    Also where a position counts from, ``0 to 72 mm = 228 to 300 mm``, and what an angle or a torque on a
    pulley is on its rim: ``0 to 3 Nm = 0 to 100 N``.
    """
    moved = _MOVED.fullmatch(text.strip())
    if moved is not None:
        low, high, least, most = (_float(moved[n]) for n in (1, 2, 4, 5))
        raw, unit = unit_of(moved["raw"]), unit_of(moved["unit"])
        if raw and unit and dimension_of(raw.unit) == dimension_of(unit.unit) == "a length" and high != low:
            slope = (most - least) / (high - low)
            return Scale(slope, least - slope * low, raw.unit, unit.unit, "", f"'{text.strip()}'", "you")
    return scale_in(_OF_PULLEY.sub(" counts", text), "you")


def valve_scale_of(text: str, where: str) -> Scale | None:
    """The scale of a valve's signal by its states: ``0 V = exhaust, 5 V = closed, 10 V = fill``.

    The share of opening is 0 where the valve is closed, +1 where it fills, -1 where it exhausts.
    """
    states: dict[str, set[tuple[float, str]]] = {}
    shown: list[str] = []
    for found in _STATE.finditer(text):
        before, number, raw, behind = found["before"], found["number"], found["raw"], found["behind"]
        sides = (before, behind) if found["link"] else (behind, before)
        state = next(filter(None, (state_of(side or "") for side in sides)), None)
        if state is not None:
            states.setdefault(state, set()).add((_float(number), raw))
            shown.append(found[0].strip(" ,;"))
    signals = {raw for values in states.values() for _, raw in values}
    if len(signals) != 1 or not {"closed", "open"} <= set(states) or any(len(v) > 1 for v in states.values()):
        return None
    level = {state: next(iter(values))[0] for state, values in states.items()}
    span = level["open"] - level["closed"]
    if span == 0.0 or abs(
        level.get("exhaust", level["closed"] - span) - (level["closed"] - span)
    ) > 0.01 * abs(span):
        return None
    slope = 1.0 / span
    return Scale(slope, -level["closed"] * slope, signals.pop(), "1", "valve", f"'{', '.join(shown)}'", where)


_STATE = re.compile(
    rf"(?P<before>[^\W\d_]+)?\s*(?P<link>[=:@(]|\b(?:at|bei|à|a|bij|vid|ved)\b)?\s*(?<![\d.,])(?P<number>{_NUMBER})\s*(?P<raw>mV|V|mA|A)\b\)?"
    r"(?=(?:\s*(?:=|≙|:|->|→|is)?\s*(?P<behind>[^\W\d_]+(?:\s+[^\W\d_]+)?))?)"
)


def state_of(text: str) -> str | None:
    """The state of a valve in words: "closed", "open" (it fills), "exhaust"; None = none, or several."""
    words = words_of(text)
    known = {
        "closed": VALVE_WORDS["closed"],
        "open": VALVE_WORDS["open"] | MOVES["shortening"],
        "exhaust": VALVE_WORDS["exhaust"] | MOVES["lengthening"],
    }
    found = [state for state, among in known.items() if has_word(words, among)]
    return found[0] if len(found) == 1 else None


def _of_description(text: str, where: str) -> Scale | None:
    name = " ".join(word for word in re.findall(r"[^\W\d_]{2,}", text) if unit_of(word) is None)
    shut, opened = _CLOSED.search(text), _OPEN.search(text)
    if shut is not None and opened is not None and shut["raw"] == opened["raw"]:
        zero, one = _float(shut[1]), _float(opened[1])
        if zero != one:
            slope = 1.0 / (one - zero)
            shown = f"'{shut[0]}, {opened[0]}'"
            return Scale(slope, -zero * slope, shut["raw"], "1", f"valve {name}", shown, where)
    for pattern, places in ((_RANGES, (1, 2, 4, 5)), (_VALUE_RANGE, (4, 5, 1, 2))):
        found = pattern.search(text)
        if found is None or (unit := _unit(found["unit"])) is None:
            continue
        low, high, least, most = (_float(found[n]) for n in places)
        if high != low:
            slope = (most - least) / (high - low)
            return Scale(
                slope, least - slope * low, _raw_unit(found["raw"]), unit, name, f"'{found[0]}'", where
            )
    line = _of_points(text)
    if line is not None:
        slope, offset, raw, unit, shown = line
        return Scale(slope, offset, raw, unit, name, shown, where)
    for pattern, inverse in (
        (_RATED, False), (_EQUAL, False), (_VALUE_EQUAL, True), (_PER, False), (_SENSITIVITY, True),
    ):  # fmt: skip
        found = pattern.search(text)
        if found is None or (unit := _unit(found["unit"])) is None or not _float(found[1]):
            continue
        if pattern in (_RATED, _EQUAL, _VALUE_EQUAL):
            if not _float(found[3]):
                continue
            slope = _float(found[3]) / _float(found[1])
        else:
            slope = _float(found[1])
        slope = 1.0 / slope if inverse else slope
        raw = _raw_unit(found["raw"])
        zeroed = raw != COUNT or _ZERO.search(text) is not None
        zero = zero_in(text.replace(found[0], " "), raw)
        if zero is not None:
            return Scale(slope, -slope * zero, raw, unit, name, f"'{text.strip()[:80]}'", where)
        if says_zero(text.replace(found[0], " "), unit):
            zeroed = False
        return Scale(slope, 0.0, raw, unit, name, f"'{found[0]}'", where, zeroed)
    return None


_ZERO_WORD = (
    r"(?i)(?<![^\W\d_])(?:zero|offset|null(?:punkt|wert)?|bias|d[ée]calage|intercept|zero[ -]?point|nulpunt)"
    r"(?:[ -](?:output|reading|signal|point|value|error|load|pressure|shift|force|balance))?"
)
_ZERO_AT = re.compile(
    rf"{_ZERO_WORD}\s*(?:at|bei|is|=|:|of|von|à|a)?\s*({_NUMBER})\s*(?P<unit>{_RAW}|[^\W\d_]+)(?![\w/])"
)
#: The reading that is taken off: "(U - 1 V)".
_SHIFTED = re.compile(rf"\(\s*[^\W\d]\w*\s*(?P<sign>[-−–+])\s*(?P<number>{_NUMBER})\s*{_RAW}\s*\)")


def zero_in(text: str, raw: str) -> float | None:
    """The reading without load that a text states, in the unit of the signal; None = none.

    >>> zero_in("gain 200 N/V, offset 0.12 V", "V")
    0.12
    >>> zero_in("0.5 bar/V * (U - 1 V)", "V"), zero_in("2 mm per volt, 2.5 V = 0 mm", "V")
    (1.0, 2.5)
    """
    for found in _SHIFTED.finditer(text):
        if _raw_unit(found["raw"]) == raw:
            return -_float(found["number"]) if found["sign"] == "+" else _float(found["number"])
    for found in _POINT.finditer(text):
        if _raw_unit(found["raw"]) == raw and not _float(found[3]) and _float(found[1]):
            return _float(found[1])
    for found in _ZERO_AT.finditer(text):
        if _raw_unit(found["unit"]) == raw:
            return _float(found[1])
    return None


def says_zero(text: str, unit: str) -> bool:
    """Whether a text states an offset in the unit of the result: whether it is added is not said."""
    bare = unit.removesuffix("(a)").removesuffix("(g)")
    return any(
        _float(found[1]) != 0.0 and (known := unit_of(found["unit"])) is not None
        and dimension_of(known.unit) == dimension_of(bare)
        for found in _ZERO_AT.finditer(text)
    )  # fmt: skip


def _of_points(text: str) -> tuple[float, float, str, str, str] | None:
    """(slope, offset, unit of the signal, unit, words) of two points: ``0.5 V = 0 bar, 4.5 V = 10 bar``.

    More points have to lie on one straight line.
    """
    points = [
        (_float(found[a]), _float(found[b]), _raw_unit(found["raw"]), unit, found[0])
        for pattern, a, b in ((_POINT, 1, 3), (_POINT_BACK, 3, 1))
        for found in pattern.finditer(text)
        if (unit := _unit(found["unit"])) is not None
    ]
    if len({raw for _, _, raw, _, _ in points}) != 1 or len({unit for *_, unit, _ in points}) != 1:
        return None
    distinct = sorted({(x, y) for x, y, *_ in points})
    if len({x for x, _ in distinct}) < 2:
        return None
    (x0, y0), (x1, y1) = distinct[0], distinct[-1]
    slope = (y1 - y0) / (x1 - x0)
    if not slope or any(abs(y0 + slope * (x - x0) - y) > 0.005 * abs(y1 - y0) for x, y in distinct):
        return None
    shown = "'" + ", ".join(found for *_, found in points) + "'"
    return slope, y0 - slope * x0, points[0][2], points[0][3], shown


def _raw_unit(text: str) -> str:
    bare = "".join(text.split())
    if bare.startswith("%"):
        return FULL_SCALE
    if re.fullmatch(_COUNTED, bare):
        return COUNT
    return BRIDGE if bare == "mV/V" else "V" if bare.lower().startswith("volt") else bare


def _float(text: str) -> float:
    return float(text.replace(",", "."))


def _unit(text: str) -> str | None:
    """A unit with its reference; None = it is none, or that of a raw signal."""
    unit = unit_of(text)
    if unit is None or unit.unit in (CLOCK, COUNT) or dimension_of(unit.unit) in ("", *RAW_DIMENSIONS):
        return None
    return f"{unit.unit}{ {True: '(a)', False: '(g)', None: ''}[unit.absolute] }"
