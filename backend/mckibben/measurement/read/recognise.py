"""What a head of a table means, in the words of any laboratory: a channel, its unit, or why it is none.

It comes after the plain way (``pressure_bar``) and never overrules it.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from mckibben.measurement.measurement import CHANNEL_UNITS, STROKES
from mckibben.measurement.read.unit_words import (
    CLOCK,
    COUNT,
    UnitText,
    dimension_of,
    reference_of,
    unit_of,
)
from mckibben.measurement.read.vocabulary import (
    CHANNEL_WORDS,
    LESS_WANTED,
    LETTERS,
    LOADLESS,
    NO_CHANNEL,
    STATISTICS,
    channel_of_word,
    folded,
    other_quantity,
    reference_among,
    words_of,
)

#: Channel -> what its unit measures; a weight may stand for a force, a share or a stroke for a contraction.
DIMENSIONS = {
    "time": ("a time",), "pressure": ("a pressure",), "force": ("a force", "a mass"),
    "length": ("a length",), "displacement": ("a length", "a plain number or a share"),
    "extension": ("a length", "a plain number or a share"),
    "contraction": ("a plain number or a share", "a length"), "diameter": ("a length",),
    "velocity": ("a speed",), "command": ("a plain number or a share",), "temperature": ("a temperature",),
    "group": ("a plain number or a share",),
}  # fmt: skip
BY_WORDS, BY_UNIT = 10, 60  # how much less such a column is wanted than one named the plain way
_CHANGES = frozenset(("change", "delta", "anderung", "variation", "difference"))
_ALSO_VOLTAGE = frozenset(("tension", "tensione", "tensao"))  # a voltage in other languages
_STROKES_FROM_REST = frozenset(("displacement", "contraction", "extension"))  # "shortening from rest length"
_RAW = 3  # of LESS_WANTED: a raw column
_NUMBER = r"[0-9]+(?:[.,][0-9]+)?"
_HELD = re.compile(
    rf"(?i)(?:(?:\b(?:bei|at|à|a|con|für|for|mit|avec|with|of|von)\b|@|\b[a-zκ]\s*[=:])\s*)?"
    rf"(?<![\d.,…–-])(?P<number>{_NUMBER})\s*(?P<unit>mbar|bar|kPa|MPa|hPa|Pa|psi)(?:\s*\(?(?P<mark>abs|a|g|ü|rel)\b\.?\)?)?(?![\w/])"
)


_HELD_OTHER = re.compile(
    rf"(?:(?P<word>[^\W\d_]+0?)\s*[=:]?\s*)?(?<![\w.,-])(?P<number>{_NUMBER})\s*(?P<unit>mm|cm|m|%|kg|kN|N)(?![\w/])"
)
_NOT_HELD = ("the supply", "the surrounding air", "a preload", "a deviation")
_BARE_LENGTH = 80.0  # mm; a title that says less without a word names a stroke, not a length


class HeldQuantity(NamedTuple):
    """A quantity that a head or a title names: channel, value, unit, reference, the words themselves.

    ``named``: a word beside it says what it is.
    """

    channel: str
    value: float
    unit: str
    absolute: bool | None
    text: str
    named: bool = False


class Head(NamedTuple):
    """A head taken apart: its name, unit and reference, the pressure it names."""

    name: str
    unit: str | None
    absolute: bool | None
    held: HeldQuantity | None


class Recognised(NamedTuple):
    """What a head means. ``channel`` None = none, because ``why``; ``sign`` -1 = counted the other way."""

    channel: str | None
    unit: str | None
    absolute: bool | None
    penalty: int
    why: str
    extends: bool = False


def held_pressure(text: str) -> HeldQuantity | None:
    """The one pressure that a text names: ``"p = 2,5 bar"``, ``"F @ 3 bar"``; None = none, or several."""
    found = list(_HELD.finditer(text.replace("_", " ")))
    if len(found) != 1:
        return None
    match = found[0]
    words = words_of(text)
    if any(word in LOADLESS or other_quantity(word, "pressure") in _NOT_HELD for word in words):
        return None
    number = float(match["number"].replace(",", "."))
    absolute = None if not match["mark"] else reference_of(match["mark"])
    if absolute is None:
        absolute = reference_among(words)
    unit = next(
        u for u in ("mbar", "bar", "kPa", "MPa", "hPa", "Pa", "psi") if u.lower() == match["unit"].lower()
    )
    named = any(channel_of_word(word) == "pressure" or word == "p" for word in words)
    return HeldQuantity("pressure", number, unit, absolute, match[0].strip(), named)


def held_quantities(text: str) -> list[HeldQuantity]:
    """The pressure, stroke and load that a title names, at most one each: ``"L = 280 mm"``, ``"10 %"``."""
    pressure = held_pressure(text)
    found = {} if pressure is None else {"pressure": pressure}
    at_rest = any(other_quantity(word, "length") is not None for word in words_of(text))
    for match in _HELD_OTHER.finditer(text.replace("_", " ")):
        number, unit = float(match["number"].replace(",", ".")), match["unit"]
        channel = _channel_of_held(folded(match["word"] or ""), number, unit)
        if channel is not None and not (at_rest and channel in STROKES):
            if channel in found:
                return []
            found[channel] = HeldQuantity(channel, number, unit, None, match[0].strip())
    return list(found.values())


def _channel_of_held(word: str, number: float, unit: str) -> str | None:
    if other_quantity(word, "length") or word in LOADLESS:
        return None
    dimension = dimension_of(unit)
    named = channel_of_word(word) or LETTERS.get(word) if word else None
    if named is not None:
        return _proper(named) if dimension in DIMENSIONS[named] else None
    if dimension == "a length":
        return (
            "length" if number * {"mm": 1.0, "cm": 10.0, "m": 1e3}[unit] >= _BARE_LENGTH else "displacement"
        )
    return {"a plain number or a share": "contraction", "a mass": "force"}.get(dimension)


def taken_apart(header: str, unit_below: str | None = None) -> Head:
    """A head into name, unit and reference.

    Units stand in brackets, at the end or before words such as a direction or a run, behind ``/`` or ``,``,
    behind ``_`` or a blank, or in a row of their own.
    """
    text = " ".join(header.split())
    held = held_pressure(text)
    unit: UnitText | None = None
    absolute: bool | None = None
    while (
        found := re.fullmatch(r"(.*?)\s*[\[({<]([^\[\](){}<>]*(?:\([^()]*\))?)[\])}>]\s*", text)
    ) is not None:
        inside = found[2].strip()
        mark = reference_of(inside)
        if mark is not None:
            absolute = mark
        elif (inner := unit_of(inside)) is not None and unit is None:
            unit = inner
        elif inside:
            text = f"{found[1]} {inside}".strip()
            continue
        text = found[1]
    if unit is None:
        text, unit = _unit_within(text)
    if unit is None:
        text, unit = _unit_behind(text)
    if unit is None and unit_below is not None:
        unit = unit_of(unit_below)
    if unit is not None and unit.absolute is not None:
        absolute = unit.absolute
    if absolute is None:
        absolute = reference_among(words_of(text))
    return Head(text.strip(" _"), None if unit is None else unit.unit, absolute, held)


_SURE_UNITS = frozenset(
    [
        "mm",
        "cm",
        "bar",
        "mbar",
        "kPa",
        "MPa",
        "hPa",
        "mmHg",
        "inHg",
        "psi",
        "kN",
        "daN",
        "cN",
        "mN",
        "lbf",
        "ozf",
        "kgf",
        "gf",
        "ms",
        "mV",
        "kg",
    ]
)  # no name ends like them
_WITHIN = re.compile(r"[\[({<]([^\[\](){}<>]*(?:\([^()]*\))?)[\])}>](?=[\s,;:.]|$)")
_WORDS_TOO = ("in",)  # in brackets within a name rather the inlet than inches
_RUN_WORDS = frozenset({"run", "trial", "test", "series", "messung", *CHANNEL_WORDS["group"]})
_RUN = re.compile(
    r"(?P<name>.*?[^\W\d_].*?)[\s_,;:-]+(?P<word>[^\W\d_]+)[\s_]*(?:#|n[or]\.?)?[\s_]*(?P<number>[0-9]{1,3})"
    r"(?:\s*(?P<unit>[\[(][^\[\]()]*[\])]))?",
    re.IGNORECASE,
)
_NEWTONS = {"n": UnitText("N")}  # behind a name of a force only; alone it counts
_PATH = re.compile(r"/?(?P<first>[A-Za-z_]\w*)[./](?:[A-Za-z_]\w*[./])*(?P<name>[A-Za-z_]\w*)")


def without_paths(names: Sequence[str]) -> list[str]:
    """Names without the path that most of them share the beginning of; a unit behind ``/`` is no name.

    >>> without_paths(["/rig/t", "/rig/run", "p/bar"])
    ['t', 'run', 'p/bar']
    """
    found = [_PATH.fullmatch(name) for name in names]
    firsts = [match["first"] for match in found if match]
    common = max(set(firsts), key=firsts.count, default="")
    count = firsts.count(common)
    if count < 2 or 2 * count < sum(map(bool, names)):
        return list(names)
    parts = [match["name"] if match and match["first"] == common else None for match in found]
    if all(
        part is None or (unit_of(part) and not name.startswith("/"))
        for name, part in zip(names, parts, strict=True)
    ):
        return list(names)
    return [part or name for name, part in zip(names, parts, strict=True)]


def recognise(header: str, unit_below: str | None = None) -> Recognised:
    """What a head means.

    >>> recognise("Kraftaufnehmer U10M [kN]")[:2]
    ('force', 'kN')
    >>> recognise("Solldruck [bar]").why
    'it is a set value'
    """
    head = taken_apart(header, unit_below)
    dimension = dimension_of(head.unit)
    base = _HELD.sub(" ", head.name.replace("_", " ")) if head.held is not None else head.name
    words = words_of(without_run(base)[0])
    if head.unit == COUNT:
        return Recognised(None, head.unit, None, 0, "it holds counts of a converter, not a physical value")
    if dimension in ("a voltage", "a current"):
        return Recognised(None, head.unit, None, 0, f"'{head.unit}' is {dimension}, no calibrated value")
    meant = _without_statistic(words, dimension)
    named = [channel for word in meant if (channel := channel_of_word(word)) is not None]
    for word in words:
        reason = other_quantity(word, named[-1] if named else None)
        if reason == "a length at rest" and set(named) & _STROKES_FROM_REST:
            named = [channel for channel in named if channel != "length"]
            continue
        if reason == "a set value" and named[-1:] == ["command"]:
            continue  # what a valve is set to is its command
        if reason is not None and (named or dimension):
            return Recognised(None, head.unit, None, 0, f"it is {reason}")
    distinct = set(named)
    if len(distinct) > 1 and ("command" in distinct or not dimension):
        return Recognised(None, head.unit, None, 0, f"its name says {' and '.join(sorted(distinct))}")
    penalty = BY_WORDS + sum(LESS_WANTED.get(word, 0) for word in words)
    channel = _of_names(named, dimension) or _of_letter(words, dimension)
    if channel == "length" and set(words) & _CHANGES:
        channel = "extension"
    if channel is not None and (not dimension or dimension in DIMENSIONS[channel]):
        ambiguous = set(words) & {"last", "charge", "carga", "load"} and len(words) > 2
        if channel == "force" and not dimension and (ambiguous or set(words) & _ALSO_VOLTAGE):
            return Recognised(None, None, None, 0, "its name is not known")
        return Recognised(
            _proper(channel), head.unit, head.absolute, penalty, "by its name", channel == "extension"
        )
    if channel is not None and dimension:
        return Recognised(None, head.unit, None, 0, f"its name says {channel}, '{head.unit}' is {dimension}")
    if not dimension or dimension == "a plain number or a share":
        no_channel = next((NO_CHANNEL[word] for word in words if word in NO_CHANNEL), None)
        return Recognised(
            None, head.unit, None, 0, f"it is {no_channel}" if no_channel else "its name is not known"
        )
    by_unit = {"a force": "force", "a pressure": "pressure", "a time": "time"}.get(dimension)
    if by_unit is None:
        return Recognised(None, head.unit, None, 0, "its name is not known")
    return Recognised(
        by_unit, head.unit, head.absolute, penalty + BY_UNIT, f"by its unit '{head.unit}' alone"
    )


def _without_statistic(words: list[str], dimension: str) -> list[str]:
    """Words without the statistic behind them; "Last" is one where the unit is none of a load."""
    while len(words) > 1 and (words[-1] in STATISTICS or (words[-1] == "last" and _no_load(dimension))):
        words = words[:-1]
    return words


def _no_load(dimension: str) -> bool:
    return bool(dimension) and dimension not in DIMENSIONS["force"]


def is_raw(header: str) -> bool:
    """Whether a head says that its values are raw: counts, volts before calibration."""
    return any(LESS_WANTED.get(word, 0) >= _RAW for word in words_of(header))


def _proper(channel: str) -> str:
    return "displacement" if channel == "extension" else channel


def _of_names(named: list[str], dimension: str) -> str | None:
    """The one channel that the words name; of several the one that the unit fits, else the last."""
    if not named:
        return None
    fitting = [channel for channel in named if not dimension or dimension in DIMENSIONS[channel]]
    distinct = list(dict.fromkeys(fitting or named))
    return distinct[-1]


def _of_letter(words: list[str], dimension: str) -> str | None:
    """A letter with its unit: "F1 [N]", "s / mm"."""
    if not dimension:
        return None
    for word in words:
        letter = re.fullmatch(r"([a-z])[0-9]{0,2}", word)
        channel = LETTERS.get(letter[1]) if letter else None
        if channel is not None and dimension in DIMENSIONS[channel]:
            return channel
        if letter and letter[1] in ("l", "s", "x") and dimension == "a length":
            return "length" if letter[1] == "l" else "displacement"
    return None


def _unit_within(text: str) -> tuple[str, UnitText | None]:
    """The one unit in brackets before other words, and the text without it: "Length (mm) inflating"."""
    found = [
        (match, unit)
        for match in _WITHIN.finditer(text)
        if (unit := unit_of(match[1])) is not None
        and dimension_of(unit.unit)
        and reference_of(match[1]) is None
        and match[1].strip().lower() not in _WORDS_TOO
        and not match[1].strip().isdigit()
    ]
    if len({unit.unit for _, unit in found}) != 1:
        return text, None
    match, unit = found[0]
    return " ".join(f"{text[: match.start()]} {text[match.end() :]}".split()), unit


def without_run(name: str) -> tuple[str, str]:
    """A name without the number of the run behind it, and that number ("" = it has none).

    >>> without_run("Pressure (kPa) Run #2")
    ('Pressure (kPa)', '2')
    """
    found = _RUN.fullmatch(name.strip())
    if found is None or folded(found["word"]) not in _RUN_WORDS:
        return name, ""
    return f"{found['name'].strip(' _,;:-')} {found['unit'] or ''}".strip(), found["number"]


def _unit_behind(text: str) -> tuple[str, UnitText | None]:
    """The unit behind ``/``, a comma, ``in``, ``_`` or a blank, and the text before it."""
    for pattern in (r"(.+?)\s*/\s*([^/]+)", r"(.+?)\s*,\s*([^,]+)", r"(.+?)\s+in\s+(\S+)"):
        found = None if text.startswith("/") else re.fullmatch(pattern, text)  # a path
        unit = unit_of(found[2]) if found else None
        if found and unit is not None:
            return found[1], unit
    found = re.fullmatch(r"(.+?)[_\s]+([^\s_]+)_?", text.strip("_ ") + ("_" if text.endswith("_") else ""))
    unit = (unit_of(found[2]) or _NEWTONS.get(found[2])) if found else None
    if found and unit is not None and _sure(found[1], found[2], unit):
        return found[1], unit
    return text, None


def _sure(name: str, text: str, unit: UnitText) -> bool:
    """Whether a last word is a unit: "Force_N" is, "Sensor A" and "p at" are not."""
    dimension = dimension_of(unit.unit)
    named = [channel for word in words_of(name) if (channel := channel_of_word(word)) is not None]
    letter = _of_letter(words_of(name), dimension)
    if any(dimension in DIMENSIONS[channel] for channel in named) or letter is not None:
        return True
    if named and text in ("V", "mV", "mA"):
        return True
    return text in _SURE_UNITS


def fits_channel(unit: str, channel: str) -> bool:
    """Whether a unit can be that of a channel."""
    if unit == CLOCK:
        return channel == "time"
    return channel in DIMENSIONS and (
        dimension_of(unit) in DIMENSIONS[channel] or unit == CHANNEL_UNITS.get(channel)
    )
