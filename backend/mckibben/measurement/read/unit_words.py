"""Units as people write them into heads of tables: other spellings, brackets, marks of the reference."""

from __future__ import annotations

import re
import unicodedata
from functools import lru_cache
from typing import NamedTuple

from mckibben.measurement.read.marks import split_mark
from mckibben.measurement.read.vocabulary import REFERENCE_WORDS, folded, word_set
from mckibben.measurement.read.words import UNITS
from mckibben.physics.units import factor, is_unit, meaning

#: Spellings that the unit library lacks, lower case.
_SPELLINGS = {spelling: unit for unit, text in UNITS.items() for spelling in text.split()}
#: What a column of a laboratory is measured in; other meanings of a short text are not its unit.
_MEANINGS = frozenset({
    "a pressure", "a force", "a length", "a time", "a mass", "a speed", "a temperature", "a voltage",
    "a current", "a plain number or a share", "a frequency", "a rate", "a volume", "a volume flow",
    "an angle", "a power", "an energy or a torque",
})  # fmt: skip
_CLOCK = re.compile(r"(?i)h{1,2}\s*:\s*m{1,2}(\s*:\s*s{1,2})?([.,:]\s*(m|ms|f|s|z|0)+)?|clock|iso ?8601")
_DEGREES = re.compile(r"(?i)(?:deg(?:rees?)?\.?|°|º)\s*([CF])")
_COUNTS = word_set("count counts cts digit digits lsb bit bits raw adc inc")
#: On its own in a head it is a reference as well, "Innendruck (Ü)".
_OVERPRESSURE = {"ü": False, "ue": False, "r": False, "a": True, "g": False}
#: Channel -> what its unit measures; a weight may stand for a force, a share or a stroke for a contraction.
DIMENSIONS = {
    "time": ("a time",), "pressure": ("a pressure",), "force": ("a force", "a mass"),
    "length": ("a length",), "displacement": ("a length", "a plain number or a share"),
    "extension": ("a length", "a plain number or a share"),
    "contraction": ("a plain number or a share", "a length"), "diameter": ("a length",),
    "velocity": ("a speed",), "command": ("a plain number or a share",), "temperature": ("a temperature",),
    "group": ("a plain number or a share",), "direction": ("a plain number or a share",),
}  # fmt: skip
CLOCK = "clock"  # times of day or dates; they count from the first row
COUNT = "count"  # of a converter: no physical unit
BRIDGE = "mV/V"  # output of a strain gauge bridge over its supply
FULL_SCALE = "%FS"  # of the range of a sensor
#: What a signal is measured in before it has a scale.
RAW_DIMENSIONS = ("a voltage", "a current", "a count", "the output of a bridge", "a share of a range")
_BRIDGES = re.compile(r"(?:mV|µV|uV)\s?/\s?V")
_FULL_SCALES = re.compile(
    r"(?i)%\s*(?:of\s+)?(?:f\.?\s?s\.?o?\.?|full[ -]?scale(?:\s+output)?|(?:the\s+|full\s+)?range|span|"
    r"v\.?\s?e\.?|(?:vom\s+)?endwert(?:es)?|(?:vom\s+)?messbereich(?:s|es)?|p\.?\s?e\.?|e\.?\s?m\.?|"
    r"f\.?\s?e\.?|nennwert)"
)


class UnitText(NamedTuple):
    """A unit in the spelling of the library, and whether it says "absolute" (True) or "gauge" (False)."""

    unit: str
    absolute: bool | None = None


@lru_cache(maxsize=4096)
def unit_of(text: str) -> UnitText | None:
    """The unit that a text is, brackets around it or not; None = the text is no unit.

    >>> unit_of("[bar(g)]")
    UnitText(unit='bar', absolute=False)
    >>> unit_of("Kraft") is None
    True
    """
    bare = _without_brackets(text.strip())
    if not bare or len(bare) > 40:
        return None
    if any(character >= "\u3000" for character in bare):  # "ｋＰａ", "㎜"
        bare = unicodedata.normalize("NFKC", bare)
    if _CLOCK.fullmatch(bare):
        return UnitText(CLOCK)
    if bare.lower() in _COUNTS:
        return UnitText(COUNT)
    if _BRIDGES.fullmatch(bare):
        return UnitText(BRIDGE)
    if _FULL_SCALES.fullmatch(bare):
        return UnitText(FULL_SCALE)
    if degrees := _DEGREES.fullmatch(bare):
        return UnitText(f"deg{degrees[1].upper()}")
    plain, absolute = split_mark(bare)
    if absolute is None:
        plain, absolute = _reference_in(bare)
    plain = _without_brackets(plain.strip(" ,."))
    if re.fullmatch(r"[^\W\d_]+1", plain):
        return None  # "FT1" is a name; nobody writes a unit to the power of one
    unit = _SPELLINGS.get(plain.lower(), plain)
    # "mPa" is a thousandth of a pascal; "Mpa" and "mpa" are written for MPa.
    spellings = ("MPa",) if unit in ("Mpa", "mpa") else (unit, unit.lower())
    for spelling in spellings:
        if is_unit(spelling) and (meaning(spelling) in _MEANINGS or spelling in ("-", "1")):
            return UnitText(spelling, absolute)
    if bare in ("-", "–", "—"):
        return UnitText("1")
    return None


def fits(unit: str, si_unit: str) -> bool:
    """Whether a unit measures the same as an SI unit."""
    try:
        factor(unit, si_unit)
    except ValueError:
        return False
    return True


def reference_of(text: str) -> bool | None:
    """Absolute (True) or gauge (False), where a short text says so: ``"Ü"``, ``"abs."``, ``"relative"``."""
    word = _without_brackets(text.strip()).strip(". ").lower()
    return _OVERPRESSURE.get(word, REFERENCE_WORDS.get(folded(word)))


def dimension_of(unit: str | None) -> str:
    """What a unit measures, "" where it is none: ``"a force"``."""
    if unit is None or unit in _OWN:
        return _OWN.get(unit or "", "")
    return meaning(unit) or ""


_OWN = {
    CLOCK: "a time",
    COUNT: "a count",
    BRIDGE: "the output of a bridge",
    FULL_SCALE: "a share of a range",
}


def _reference_in(text: str) -> tuple[str, bool | None]:
    """A unit text without the word of the reference behind it: ``"mbar rel."``, ``"bar (Ü)"``, ``"psig"``."""
    if found := re.fullmatch(r"(?i)(psi)(a|g)", text):
        return found[1].lower(), found[2].lower() == "a"
    found = re.fullmatch(r"(.*?)[\s,_(\[]+([^\s,_()\[\]]+?)\.?[)\]]*", text)
    if found:
        word = found[2].lower()
        mark = _OVERPRESSURE.get(word, REFERENCE_WORDS.get(folded(word)))
        if mark is not None:
            return found[1], mark
    if found := re.fullmatch(r"((?:m|h|k|M)?(?:bar|Pa))ü", text):
        return found[1], False
    return text, None


def _without_brackets(text: str) -> str:
    """``"(kN)"`` -> ``"kN"``; brackets that do not enclose the whole text stay."""
    while len(text) > 1 and text[0] in "([{<" and text[-1] == dict(zip("([{<", ")]}>", strict=True))[text[0]]:
        depth = 0
        for position, character in enumerate(text):
            depth += (character in "([{<") - (character in ")]}>")
            if depth == 0 and position < len(text) - 1:
                return text
        text = text[1:-1].strip()
    return text
