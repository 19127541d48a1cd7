"""Conditions that a file says twice with different values, or that its readings rule out."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping, Sequence

import numpy as np

from mckibben.measurement.question import Question
from mckibben.measurement.read.conditions import Note, condition_value, key_of
from mckibben.measurement.read.evidence import Array
from mckibben.measurement.read.stated import NAME, values_stated
from mckibben.measurement.read.words.cells import NUMBER_WORDS
from mckibben.physics.errors import InputError

_SAME = 2e-3  # relative; values that differ by less are the same one, rounded
#: Condition -> (its name, the option that sets it).
_ASKED = {
    "nominal_length": ("rest length", "--rest-length"), "load_mass": ("load", "--load"),
    "load_force": ("load", "--load"), "supply_pressure": ("supply pressure", "--supply"),
}  # fmt: skip
# L/L0 is cos(angle)/cos(angle at rest): with up to 37 degrees at rest at most 1.25, and at 54.7 degrees,
# where the braid locks, not below 0.58; the lower bound leaves room for lengths with fittings.
_LONGEST, _SHORTEST = 1.25, 0.4
# A braid of up to 30 degrees at rest locks when it is stretched by 15 %; _FEW: share of rows, for spikes.
_STRETCHED, _FEW = 0.15, 0.05
_NUMBERS = " ".join(NUMBER_WORDS.values()).split()
_IN_WORDS = re.compile(
    rf"(?i)(?<![^\W_])(?:{'|'.join(sorted(_NUMBERS, key=len, reverse=True))})\s+"
    r"(?:m?bar|[kM]?Pa|psi|kg|Newton|mm|cm|bars|kilos?|millimet(?:er|re)s?)(?![^\W_])"
)
_SHEET = re.compile(r"sheet '.*?'|")


def condition_questions(
    texts: Iterable[tuple[str, str]], notes: Sequence[Note], conditions: Mapping[str, float | str],
    channels: Mapping[str, Array], given: Iterable[str],
) -> list[Question]:  # fmt: skip
    """Questions about conditions that contradict each other or the readings.

    Args:
        texts: around the table, and where they stand.
        notes: the conditions as they are read, with their places.
        conditions: the same in SI.
        channels: the readings [SI].
        given: conditions that the user has set, or that columns hold.
    """
    given = set(given)
    asked = [q for q in _twice(list(texts), notes, channels) if q[0] not in given]
    found = [question for _, question in asked]
    if "nominal_length" not in given and not any(key == "nominal_length" for key, _ in asked):
        found += _impossible(notes, conditions, channels)
    return found


def numbers_in_words(texts: Iterable[tuple[str, str]]) -> list[str]:
    """Messages for quantities whose number is a word, "drei Bar": they are not read.

    >>> numbers_in_words([("bei drei Bar aufgenommen", "line 2")])
    ["'drei Bar' (line 2) is a number in words and is not read; write it in digits"]
    """
    return [
        f"'{found[0]}' ({where}) is a number in words and is not read; write it in digits"
        for text, where in texts
        for found in _IN_WORDS.finditer(text)
    ]


def _twice(
    texts: Sequence[tuple[str, str]], notes: Sequence[Note], channels: Mapping[str, Array]
) -> list[tuple[str, Question]]:
    read = {key_of(note.key)[0]: note for note in notes if note.where != NAME}
    found: dict[str, Question] = {}
    for key, value, where in values_stated(texts):
        note = read.get(key)
        if key not in _ASKED or note is None or key in found or not _is_needed(key, channels):
            continue
        if value[-1:].isdigit():  # without a unit it may be a number of anything
            continue
        if _sheet(note.where) != _sheet(where):
            continue
        one, other = _si(key, _with_unit(note), note.where), _si(key, value, where)
        if one is None or other is None or math.isclose(one, other, rel_tol=_SAME):
            continue
        name, option = _ASKED[key]
        first, second = str(_with_unit(note)), value
        found[key] = Question(
            name,
            f"the file states two values for the {name}, {first} ({_place(note.where)}) and {second} "
            f"({_place(where)}); which one is right",
            f'{option} "{first}" or {option} "{second}"',
            None,
            first,
            (first, second),
        )
    return list(found.items())


def _is_needed(key: str, channels: Mapping[str, Array]) -> bool:
    """Whether a condition decides anything: a load not beside a measured force, a supply with a valve."""
    if key == "supply_pressure":
        return "command" in channels
    return key == "nominal_length" or "force" not in channels


def _with_unit(note: Note) -> str | float:
    unit = key_of(note.key)[1]
    return f"{note.value} {unit}" if unit else note.value


def _si(key: str, value: str | float, where: str) -> float | None:
    try:
        number = condition_value(key, value, where=where, field=key)
    except InputError:
        return None
    return number if isinstance(number, float) else None


def _sheet(where: str) -> str:
    found = _SHEET.match(where)
    return found[0] if found else ""


def _place(where: str) -> str:
    """A place without the name of the file before it."""
    return re.sub(r"^.*?, (?=row [0-9])", "", where)


def _impossible(
    notes: Sequence[Note], conditions: Mapping[str, float | str], channels: Mapping[str, Array]
) -> list[Question]:
    """A rest length with which no reading is possible: its unit, or the length itself, is another."""
    rest = conditions.get("nominal_length")
    if not isinstance(rest, float) or rest <= 0.0:
        return []
    shown = _beyond(channels, rest)
    if not shown:
        return []
    note = next((n for n in notes if key_of(n.key)[0] == "nominal_length"), None)
    said = f"{rest * 1e3:.6g} mm" if note is None else str(_with_unit(note))
    place = "" if note is None else f" ({_place(note.where)})"
    stretched = "stretch" in shown
    return [
        Question(
            "rest length",
            f"the rest length is read as {said}{place}, {shown}, which is impossible for it; "
            + ("where is the stroke 0, or " if stretched else "")
            + "which rest length is right",
            '--rest-length "300 mm"'
            + (' or --column "length=NAME [0 to 72 mm = 228 to 300 mm]"' if stretched else ""),
        )
    ]


def _beyond(channels: Mapping[str, Array], rest: float) -> str:
    """What of the readings no muscle of a rest length [m] shows; "" = they are possible."""
    length, stroke = channels.get("length"), channels.get("displacement")
    if length is not None and len(length):
        low, high = float(np.min(length)), float(np.max(length))
        if low > _LONGEST * rest or high < _SHORTEST * rest:
            return f"the lengths measured are {low * 1e3:.4g} to {high * 1e3:.4g} mm"
    elif stroke is not None and len(stroke):
        low, high = float(np.min(stroke)), float(np.max(stroke))
        if float(np.median(np.abs(stroke))) > (1.0 - _SHORTEST) * rest:
            return f"the strokes measured are {low * 1e3:.4g} to {high * 1e3:.4g} mm"
        if float(np.quantile(stroke, _FEW)) < -_STRETCHED * rest:
            return (
                f"the strokes measured would stretch the muscle by up to {-low * 1e3:.4g} mm beyond its rest "
                f"length ({-100.0 * low / rest:.0f} %)"
            )
    return ""
