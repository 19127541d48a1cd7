"""A head taken apart: its name, its unit, what a pressure counts from, the number of the run."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from mckibben.measurement.read.held import HeldQuantity, held_pressure
from mckibben.measurement.read.unit_words import DIMENSIONS, UnitText, dimension_of, reference_of, unit_of
from mckibben.measurement.read.vocabulary import (
    CHANNEL_WORDS,
    LETTERS,
    channel_of_word,
    folded,
    reference_among,
    words_of,
)

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
        "deg",
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


#: The number of a channel before or instead of its name: "CH1", "AI 0", "Kanal 3".
CHANNEL_NUMBER = re.compile(
    r"(?i)(?:ch|chan|channel|kanal|canal|voie|ai|input|in|c)[ _-]?[0-9]{1,2}(?![^\W_])"
)


class Head(NamedTuple):
    """A head taken apart: its name, unit and reference, the pressure it names."""

    name: str
    unit: str | None
    absolute: bool | None
    held: HeldQuantity | None


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


def is_run_word(word: str) -> bool:
    """Whether a number behind a word counts runs: "run 12", "Versuch 3"."""
    return folded(word) in _RUN_WORDS


def channel_number(text: str) -> str:
    """The one number of a channel that a text names: "ch1" of "CH 1: pressure"; "" = none, or several.

    >>> channel_number("Note: Kanal 3 absolut"), channel_number("pressure")
    ('ch3', '')
    """
    found = {int(re.sub(r"[^0-9]", "", match[0])) for match in CHANNEL_NUMBER.finditer(text)}
    return f"ch{found.pop()}" if len(found) == 1 else ""


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


#: Letters of a share that are that of the contraction.
_SHARES = frozenset(["h", "k", "e", "ε", "κ", "eps", "epsilon", "kappa"])


def channel_of_letter(words: list[str], dimension: str) -> str | None:
    """A letter with its unit: "F1 [N]", "s / mm"."""
    if not dimension:
        return None
    for word in words:
        if dimension == "a plain number or a share" and word in _SHARES:
            return "contraction"
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


def is_voltage(name: str) -> bool:
    """Whether a name is the symbol of a voltage with what it stands for: "U_p", "U_F1", "V_press".

    >>> is_voltage("U_p"), is_voltage("U"), is_voltage("cup_p")
    (True, False, False)
    """
    words = words_of(name)
    return len(words) > 1 and words[0] in ("u", "v", "uout", "vout") and not words[1].isdigit()


def _sure(name: str, text: str, unit: UnitText) -> bool:
    """Whether a last word is a unit: "Force_N" is, "Sensor A" and "p at" are not."""
    dimension = dimension_of(unit.unit)
    named = [channel for word in words_of(name) if (channel := channel_of_word(word)) is not None]
    letter = channel_of_letter(words_of(name), dimension)
    if any(dimension in DIMENSIONS[channel] for channel in named) or letter is not None:
        return True
    if text in ("V", "mV", "mA") and (named or is_voltage(name)):
        return True
    return text in _SURE_UNITS
