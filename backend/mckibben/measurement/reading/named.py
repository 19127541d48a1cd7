"""The length at which a muscle was held, in the names of files: ``sine_L380mm.dat``, ``iso_138.txt``."""

from __future__ import annotations

import re
from collections.abc import Sequence
from itertools import pairwise
from pathlib import PurePath
from typing import NamedTuple

from mckibben.measurement.reading.evidence import known_muscles
from mckibben.measurement.reading.heads import counts_runs, head_claims
from mckibben.measurement.reading.lexicon import words_of
from mckibben.measurement.reading.units import quantities, quantity_si, unit_of

_SHORTEST, _LONGEST = 0.60, 1.06  # of the rest length, at which a muscle can be held
_NUMBER = re.compile(r"(?<![0-9.,])[0-9]+(?:[.,][0-9]+)?(?![0-9])")
_CODE = re.compile(r"(?<![A-Za-z0-9])([A-Za-z]{2,6})[-_ ]?([0-9]{1,3})(?:-([0-9]{2,4})(?![0-9]))?")
_YEARS = range(1900, 2100)
_BEHIND_A_WORD = re.compile(r"([^\W\d_]+)[\s_#.-]*$")
_OTHER_LENGTHS = frozenset([
    "stroke", "hub", "corsa", "course", "travel", "hose", "tube", "schlauch", "tuyau", "cable",
    "diameter", "durchmesser", "wire",
])  # fmt: skip


class NamedLength(NamedTuple):
    """A length [m] that the name of a file says, as it stands there, and how it was found."""

    value: float
    text: str
    why: str = ""


def is_isometric(name: str) -> bool:
    """Whether a name says that the test is isometric: ``iso_138``, ``isometric_L380mm``."""
    return any(word == "iso" or word.startswith("isometr") for word in words_of(PurePath(name).stem))


def number_of_name(name: str) -> str:
    """The one number of a name that can be a length; "" = none, or several.

    >>> number_of_name("iso_138.txt"), number_of_name("sine_L380mm.dat"), number_of_name("run_007.csv")
    ('138', 'L380mm', '')
    """
    stem = PurePath(name).stem
    said = [q.text for q in quantities(_without_codes(stem)) if q.unit.dimension == "length"]
    said = said or [found[0] for found in _numbers(stem) if _can_stand_alone(stem, found)]
    return said[0] if len(said) == 1 else ""


def length_of_name(
    name: str, rest: float, *, isometric: bool, others: Sequence[str] = ()
) -> NamedLength | None:
    """The length at which a name says that the muscle was held; None = it says none, or several.

    A length with its unit says so itself. A bare number counts millimetres where the test is isometric: the
    one number
    that differs among the names of the test, or in a single name one of three or four digits.

    Args:
        name: of the file.
        rest: length of the muscle at rest [m]; who else says it than this name.
        isometric: whether a text or the name says that the length was held.
        others: names of the other files of the test.
    """
    stem = PurePath(name).stem
    isometric = isometric or is_isometric(name)
    said = {}
    for quantity in quantities(re.sub(r"(?<=\d)_(?=[A-Za-zµ])", " ", _without_codes(stem))):
        metres = (
            quantity_si(quantity.value, quantity.unit.name, "m")
            if quantity.unit.dimension == "length"
            else 0.0
        )
        before = words_of(re.split(r"\d", stem[: quantity.begin])[-1])
        if (
            _can_be_held(1e3 * metres, rest)
            and not set(before) & _OTHER_LENGTHS
            and (isometric or before[-1:] in (("l",), ("length",)))
        ):
            said[metres] = quantity.text
    if said:
        return NamedLength(*next(iter(said.items()))) if len(said) == 1 else None
    if not isometric:
        return None
    return _which_differs(stem, rest, others) or _alone(stem, rest)


def _can_be_held(millimetres: float, rest: float) -> bool:
    return _SHORTEST * rest <= 1e-3 * millimetres <= _LONGEST * rest


def _without_codes(text: str) -> str:
    """A text, as long, in which the digits of order codes are blanks: they are no measured number."""

    def blanked(found: re.Match[str]) -> str:
        known = f"{found[1]}-{found[2]}".upper() in known_muscles()
        return re.sub(r"[0-9]", " ", found[0]) if known else found[0]

    return _CODE.sub(blanked, text)


def _numbers(stem: str) -> list[re.Match[str]]:
    """The bare numbers of a name: not those of "3bar" or of an order code, but that of "L138"."""
    return [
        found
        for found in _NUMBER.finditer(_without_codes(stem))
        if not _has_unit(stem[found.end() :])
        and (not (before := re.search(r"[^\W\d_]+$", stem[: found.start()])) or _is_length(before[0]))
    ]


def _has_unit(behind: str) -> bool:
    found = re.match(r"([\s_]{0,3})([^\W\d_]+)", behind)
    return found is not None and (not found[1] or (len(found[2]) > 1 and unit_of(found[2]) is not None))


def _is_length(word: str) -> bool:
    return word.lower() == "l" or any(
        c.facet == "channel" and c.value == "length" for c in head_claims(word[:40])
    )


def _value(found: re.Match[str]) -> float:
    return float(found[0].replace(",", "."))


def _counts(stem: str, found: re.Match[str]) -> bool:
    """Whether a number is a year or counts runs: "2024", "007", "run_130"."""
    if found[0].startswith("0") or _value(found) in _YEARS:
        return True
    word = _BEHIND_A_WORD.search(stem[: found.start()])
    return word is not None and counts_runs(word[1])


def _can_stand_alone(stem: str, found: re.Match[str]) -> bool:
    return len(found[0]) in (3, 4) and found[0].isdigit() and not _counts(stem, found)


def _which_differs(stem: str, rest: float, others: Sequence[str]) -> NamedLength | None:
    """The one number that differs among the names of a test, and can be a length in all of them."""
    alike = [(stem, _numbers(stem))]
    for other in others:
        numbers = _numbers(PurePath(other).stem)
        if len(numbers) == len(alike[0][1]):
            alike.append((PurePath(other).stem, numbers))
    found = []
    for place, own in enumerate(alike[0][1]):
        values = sorted({_value(numbers[place]) for _, numbers in alike})
        steps = {round(high - low, 9) for low, high in pairwise(values)}
        if (
            len(values) > 1
            and steps != {1.0}  # they may count the runs
            and all(_can_be_held(value, rest) for value in values)
            and not any(_counts(one, numbers[place]) for one, numbers in alike)
        ):
            found.append(NamedLength(1e-3 * _value(own), own[0], _why(own, rest, "differs among the files")))
    return found[0] if len(found) == 1 else None


def _alone(stem: str, rest: float) -> NamedLength | None:
    found = [
        each for each in _numbers(stem) if _can_stand_alone(stem, each) and _can_be_held(_value(each), rest)
    ]
    if len(found) != 1:
        return None
    return NamedLength(
        1e-3 * _value(found[0]), found[0][0], _why(found[0], rest, "no other number can be it")
    )


def _why(found: re.Match[str], rest: float, reason: str) -> str:
    return f"read as mm, {0.1 * _value(found) / rest:.0f} % of the rest length; {reason}"
