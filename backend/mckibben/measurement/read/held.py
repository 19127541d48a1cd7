"""Quantities that a head or a title names with their value: ``"F @ 3 bar"``, ``"L = 280 mm"``."""

from __future__ import annotations

import re
from typing import NamedTuple

from mckibben.measurement.measurement import STROKES
from mckibben.measurement.read.left_out import Reason
from mckibben.measurement.read.unit_words import DIMENSIONS, dimension_of, reference_of
from mckibben.measurement.read.vocabulary import (
    LETTERS,
    LOADLESS,
    REMARK_WORDS,
    channel_of_word,
    folded,
    other_quantity,
    reference_among,
    words_of,
)

_NUMBER = r"[0-9]+(?:[.,][0-9]+)?"
_HELD = re.compile(
    rf"(?i)(?:(?:\b(?:bei|at|à|a|con|für|for|mit|avec|with|of|von)\b|@|\b[a-zκ]\s*[=:])\s*)?"
    rf"(?<![\d.,…–-])(?P<number>{_NUMBER})\s*(?P<unit>mbar|bar|kPa|MPa|hPa|Pa|psi)(?:\s*\(?(?P<mark>abs|a|g|ü|rel)\b\.?\)?)?(?![\w/]|\s+(?:per|pro|je|par|por)\s)"
)


_HELD_OTHER = re.compile(
    rf"(?:(?P<word>[^\W\d_]+0?)\s*[=:]?\s*)?(?<![\w.,-])(?P<number>{_NUMBER})\s*(?P<unit>mm|cm|m|%|kg|kN|N)(?![\w/]|\s+(?:per|pro|je|par|por)\s)"
)
#: A scale or a range of a sensor is nothing held: "100 % = 10 bar", "1 V = 2 bar", "0-10 bar".
_SCALE = re.compile(
    rf"(?i){_NUMBER}\s*(?:%(?:\s*FS)?|m?V(?:/V)?|m?A|counts?|digits?|ticks?)\s*(?:=|≙|≈|:|->|→|for|per|to|is|entspr\w*)"
    rf"\s*{_NUMBER}|{_NUMBER}\s*(?:m?bar|[kMh]?Pa|psi|k?N|mm|cm)\s*(?:=|≙|≈|->|→|@|at)\s*{_NUMBER}\s*(?:%|m?V|m?A|counts?|digits?)"
)
_NOT_HELD = (Reason.SUPPLY, Reason.AIR, Reason.PRELOAD, Reason.DEVIATION)
_BARE_LENGTH = 80.0  # mm; a title that says less without a word names a stroke, not a length


class HeldQuantity(NamedTuple):
    """A quantity that a head or a title names: channel, value, unit, reference, the words themselves.

    ``named``: a word beside it says what it is, and it is no condition of the whole test; ``worded``: a word
    or letter stands before it.
    """

    channel: str
    value: float
    unit: str
    absolute: bool | None
    text: str
    named: bool = False
    worded: bool = False


def held_pressure(text: str) -> HeldQuantity | None:
    """The one pressure that a text names: ``"p = 2,5 bar"``, ``"F @ 3 bar"``; None = none, or several."""
    if _SCALE.search(text):
        return None
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
    if _SCALE.search(text):
        return []
    pressure = held_pressure(text)
    found = {} if pressure is None else {"pressure": pressure}
    at_rest = any(other_quantity(word, "length") is not None for word in words_of(text))
    for match in _HELD_OTHER.finditer(text.replace("_", " ")):
        number, unit = float(match["number"].replace(",", ".")), match["unit"]
        word = folded(match["word"] or "")
        channel = _channel_of_held(word, number, unit)
        if channel is not None and not (at_rest and channel in STROKES):
            if channel in found:
                return []
            worded = channel_of_word(word) is not None or word in LETTERS or word in REMARK_WORDS["load"]
            found[channel] = HeldQuantity(channel, number, unit, None, match[0].strip(), worded=worded)
    return list(found.values())


def _channel_of_held(word: str, number: float, unit: str) -> str | None:
    if other_quantity(word, "length") or word in LOADLESS:
        return None
    dimension = dimension_of(unit)
    named = channel_of_word(word) or LETTERS.get(word) if word else None
    if named is not None:
        return proper(named) if dimension in DIMENSIONS[named] else None
    if dimension == "a length":
        return (
            "length" if number * {"mm": 1.0, "cm": 10.0, "m": 1e3}[unit] >= _BARE_LENGTH else "displacement"
        )
    return {"a plain number or a share": "contraction", "a mass": "force"}.get(dimension)


def proper(channel: str) -> str:
    """The channel itself: an extension is a displacement counted the other way."""
    return "displacement" if channel == "extension" else channel


def without_pressure(text: str) -> str:
    """A text without the pressures that it names."""
    return _HELD.sub(" ", text.replace("_", " "))
