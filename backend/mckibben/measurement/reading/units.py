"""Units as people write them: other spellings, brackets, marks of the reference of a pressure."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from mckibben.measurement.measurement import CHANNEL_UNITS
from mckibben.measurement.reading.lexicon import REFERENCES, UNIT_SPELLINGS, folded
from mckibben.measurement.reading.model import Array
from mckibben.physics.units import convert, is_unit, meaning

CLOCK = "clock"  # times of day or dates, as seconds
COUNT = "count"  # of a converter
BRIDGE = "mV/V"  # output of a bridge of strain gauges over its supply
FULL_SCALE = "%FS"  # share of the range of a sensor
_OWN = {
    CLOCK: "time",
    COUNT: "count",
    BRIDGE: "bridge",
    FULL_SCALE: "share of range",
    "1": "ratio",
    "-": "ratio",
}
#: What a unit may measure, in the words of the unit library -> here.
_DIMENSIONS = {
    "a pressure": "pressure", "a force": "force", "a length": "length", "a time": "time", "a mass": "mass",
    "a speed": "speed", "a temperature": "temperature", "a voltage": "voltage", "a current": "current",
    "a plain number or a share": "ratio", "a frequency": "frequency", "a rate": "frequency",
    "a volume": "volume", "a damping coefficient": "mass flow",
    "a volume flow": "flow", "an angle": "angle", "a power": "power", "an energy or a torque": "torque",
    "a mass per length": "density", "a stiffness": "stiffness", "an acceleration": "acceleration",
    "an area": "area",
}  # fmt: skip
#: What a signal is in before it has a scale.
RAW = ("voltage", "current", "count", "bridge", "share of range")
#: Channel -> what its unit may measure; a mass stands for its weight, a share of the rest length for a
#: stroke.
FITTING = {
    "time": ("time",), "pressure": ("pressure",), "force": ("force", "mass"), "length": ("length",),
    "displacement": ("length",), "contraction": ("ratio",), "diameter": ("length",), "velocity": ("speed",),
    "command": ("ratio",), "temperature": ("temperature",), "group": ("", "ratio"),
    "direction": ("", "ratio"), "angle": ("angle",), "torque": ("torque",), "lever": ("length",),
    "counter_pressure": ("pressure",),
}  # fmt: skip
#: Unit of a mass -> that of its weight.
WEIGHTS = {"kg": "kgf", "g": "gf", "lb": "lbf", "oz": "ozf"}
_NO_UNITS = frozenset(
    ("a", "A", "t", "T", "D", "at", "h0", "L", "l", "F", "p", "P", "x", "X", "i", "n", "No", "no", "mass")
)  # names rather than units
_CLOCKS = re.compile(r"(?i)h{1,2}\s?:\s?m{1,2}(?:\s?:\s?s{1,2})?[.,:msfz0]{0,6}|clock|iso ?8601|hms")
_DEGREES = re.compile(r"(?i)(?:deg(?:rees?)?\.?|°|º)\s?([CF])")
_COUNTS = frozenset(["count", "counts", "cts", "digit", "digits", "lsb", "bit", "bits", "raw", "adc", "inc"])
_BRIDGES = re.compile(r"(?:mV|µV|uV)\s?/\s?V")
_SHARES = re.compile(
    r"(?i)%\s?(?:of\s)?(?:f\.?\s?s\.?o?\.?|full[ -]?scale|(?:the\s|full\s)?range|span|v\.?\s?e\.?|"
    r"(?:vom\s)?endwert(?:es)?|(?:vom\s)?messbereichs?|p\.?\s?e\.?|e\.?\s?m\.?|f\.?\s?e\.?|nennwert)"
)
_PSI = re.compile(r"(?i)(psi)([ag])")
_GLUED = re.compile(r"(?i)([mhk]?bar|[mhk]?pa)(\(?[agü]\)?)")
_BEHIND = re.compile(r"(.{1,20}?)[\s,_(\[]{1,3}([^\s,_()\[\]]{1,16})\.?[)\]]{0,2}")
_BRACKETS = {"(": ")", "[": "]", "{": "}", "<": ">"}
#: One letter alone says it only behind a unit of pressure, or alone in a head of one.
_LETTERS = {"ü": False, "ue": False, "r": False, "g": False, "a": True}


class Unit(NamedTuple):
    """A unit in the spelling of the library, what it measures, and whether it says absolute or gauge."""

    name: str
    dimension: str
    absolute: bool | None = None


def reference_of(text: str) -> bool | None:
    """Absolute (True) or gauge (False), where a short text is that word: ``"Ü"``, ``"abs."``."""
    word = _bare(text.strip()).strip(". ").lower()
    return _LETTERS.get(word, REFERENCES.get(folded(word)))


@lru_cache(maxsize=8192)
def unit_of(text: str) -> Unit | None:
    """The unit that a text is, brackets around it or not; None = it is no unit.

    >>> unit_of("[bar(g)]")
    Unit(name='bar', dimension='pressure', absolute=False)
    """
    bare = _bare(text.strip())
    if not bare or len(bare) > 40 or (bare[0].isdigit() and bare != "1" and not bare.startswith("1/")):
        return None
    if any(character >= "\u3000" for character in bare):
        bare = unicodedata.normalize("NFKC", bare)
    if bare in _NO_UNITS:
        return None
    if _CLOCKS.fullmatch(bare):
        return Unit(CLOCK, "time")
    if bare.lower() in _COUNTS:
        return Unit(COUNT, "count")
    if _BRIDGES.fullmatch(bare):
        return Unit(BRIDGE, "bridge")
    if _SHARES.fullmatch(bare):
        return Unit(FULL_SCALE, "share of range")
    if bare in ("-", "–", "—", "1"):
        return Unit("1", "ratio")
    if degrees := _DEGREES.fullmatch(bare):
        return Unit(f"deg{degrees[1].upper()}", "temperature")
    if (plain := _plain(bare)) is not None:
        return plain
    for pattern in (_PSI, _GLUED, _BEHIND):
        if found := pattern.fullmatch(bare):
            mark = reference_of(found[2])
            inner = _plain(found[1].strip(" ,.")) if mark is not None else None
            if inner is not None and inner.dimension == "pressure":
                return inner._replace(absolute=mark)
    return None


@lru_cache(maxsize=8192)
def _plain(text: str) -> Unit | None:
    """A unit without a mark."""
    if re.fullmatch(r"[^\W\d_]+1", text):
        return None  # "FT1" is a name; nobody writes a unit to the power of one
    unit = UNIT_SPELLINGS.get(text.lower()) or UNIT_SPELLINGS.get(text) or text
    # "mPa" is a thousandth of a pascal; "Mpa" and "mpa" are written for MPa.
    for spelling in ("MPa",) if unit in ("Mpa", "mpa") else dict.fromkeys((unit, unit.lower())):
        dimension = dimension_of(spelling) if is_unit(spelling) else ""
        if dimension:
            return Unit(spelling, dimension)
    return None


@lru_cache(maxsize=4096)
def dimension_of(unit: str) -> str:
    """What a unit measures; "" for one that no laboratory uses here."""
    return _OWN.get(unit) or _DIMENSIONS.get(meaning(unit) or "", "")


def in_si(values: Array, unit: str, channel: str) -> Array:
    """Readings in the SI unit of a channel; a mass becomes its weight, times of day are seconds."""
    if unit in (CLOCK, "", "1", "-"):
        return np.array(values, float)
    return convert(
        values, WEIGHTS.get(unit, unit) if channel == "force" else unit, CHANNEL_UNITS.get(channel, "1")
    )


def quantity_si(value: float, unit: str, si: str) -> float:
    """One value in SI."""
    return float(convert([value], unit, si)[0])


def _bare(text: str) -> str:
    """``"(kN)"`` -> ``"kN"``; brackets that do not enclose the whole text stay."""
    while len(text) > 1 and _BRACKETS.get(text[0]) == text[-1] and _encloses(text):
        text = text[1:-1].strip()
    return text


def _encloses(text: str) -> bool:
    depth = 0
    for position, character in enumerate(text):
        depth += (character in "([{<") - (character in ")]}>")
        if depth == 0:
            return position == len(text) - 1
    return False


NUMBER = r"[-+−]?\d{1,12}(?:[.,]\d{1,9})?(?:[eEdD][-+]?\d{1,3}(?![^\W_]))?"
_QUANTITY = re.compile(
    rf"(?<![^\W_])(?<![.,])(?P<number>{NUMBER})\s{{0,3}}(?P<unit>(?:[^\W\d_]|[°%\"'½]){{1,12}}(?:/[^\W\d_]{{1,4}}[2²]?)?"
    r"(?:\s?\((?:a|g|abs|ü|gauge|rel)\)|\s(?:abs|gauge|rel|absolute)\b)?)(?![^\W_]|[.,]\d)"
)
_UNIT_FIRST = re.compile(
    rf"[\[(]\s?(?P<unit>[^\[\]()]{{1,12}})\s?[\])]\s?[:=;]?\s{{0,3}}(?P<number>{NUMBER})(?![\w.,]|\s[A-Za-z])"
)
_UNIT_IN_NAME = re.compile(rf"_(?P<unit>[^\W\d_]{{1,6}})\s?[:=]\s{{0,2}}(?P<number>{NUMBER})(?![\w.,])")
_UNIT_BEFORE = re.compile(
    rf"[:;,\s](?P<unit>mm|cm|kg|m?bar|[kMh]Pa|psi|kN|lbf|inch)\s?[:=;,]\s{{0,2}}(?P<number>{NUMBER})(?![\w.,])"
)
_GLUED_SYMBOL = re.compile(
    r"(?<![^\W_])[^\W\d_]{1,12}0?=?(?P<number>\d{1,5}(?:[.,p]\d{1,3})?)(?P<unit>[^\W\d_]{1,4})(?![^\W_])"
)


class Quantity(NamedTuple):
    """A number with its unit in a text: where it begins and ends, the value as written, the unit."""

    begin: int
    end: int
    value: float
    unit: Unit
    text: str


def number_of(text: str) -> float:
    """A number as it stands in a sentence, with a decimal comma or point."""
    return float(re.sub("[dD]", "e", text).replace(",", ".").replace("−", "-"))


@lru_cache(maxsize=8192)
def quantities(text: str) -> tuple[Quantity, ...]:
    """All quantities of a text, in their order; none overlaps another one."""
    found: list[Quantity] = []
    taken = bytearray(len(text))
    for pattern in (_UNIT_FIRST, _QUANTITY, _UNIT_IN_NAME, _UNIT_BEFORE, _GLUED_SYMBOL):
        new = [q for q in _of_pattern(pattern, text) if not any(taken[q.begin : q.end])]
        for q in new:
            taken[q.begin : q.end] = b"x" * (q.end - q.begin)
        found += new
    return tuple(sorted(found))


def _of_pattern(pattern: re.Pattern[str], text: str) -> Iterator[Quantity]:
    for match in pattern.finditer(text):
        unit = unit_of(match["unit"]) or unit_of(match["unit"].partition("(")[0])
        if unit is not None and unit.dimension != "count" and match["unit"] not in ("at", "a", "A"):
            number = match["number"].replace("p", ".") if pattern is _GLUED_SYMBOL else match["number"]
            yield Quantity(
                match.start("number"), match.end(), number_of(number), unit, match[0].strip(" :;,=")
            )
