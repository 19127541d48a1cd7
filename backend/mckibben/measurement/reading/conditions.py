"""Conditions of a test: their keys, and a value of one, as text or in SI."""

from __future__ import annotations

import math
import re

from mckibben.measurement.accuracy import read_accuracy
from mckibben.measurement.reading.units import unit_of
from mckibben.physics.errors import InputError
from mckibben.physics.units import STANDARD_ATMOSPHERE, si

#: Subtracted from an absolute pressure where the file states no ambient one [Pa].
ATMOSPHERE = STANDARD_ATMOSPHERE

#: Command before the first row: the valve may have stood elsewhere than at rest.
COMMAND_BEFORE = "command_before"
#: Conditions that are physical values -> SI unit; the others stay text.
CONDITION_UNITS = {
    "load_mass": "kg", "load_force": "N", "supply_pressure": "Pa", "nominal_length": "m", "temperature": "K",
    "inclination": "rad", "force_zero": "N", "pressure_zero": "Pa", "ambient_pressure": "Pa",
    COMMAND_BEFORE: "1", "contraction_at_zero": "1",
}  # fmt: skip
#: Conditions with a meaning that are text.
TEXT_CONDITIONS = (
    "muscle", "sample", "pressure", "accuracy", "valve", "tube", "stops", "fixed_end", "lever",
)  # fmt: skip
#: Key of the columns that a file says are not to be read.
IGNORE = "ignore"
_SIGNED = (
    "inclination",
    "force_zero",
    "pressure_zero",
    COMMAND_BEFORE,
    "contraction_at_zero",
)  # conditions that may be negative
_INCLINATIONS = {"vertical": "90 deg", "hanging": "90 deg", "horizontal": "0 deg"}
_MAX_TEXT = 200
_QUANTITY = re.compile(r"([+-]?[0-9.]{1,40}(?:[eE][+-]?[0-9]{1,3})?)\s{0,8}(\D.{0,40})")
_PLAIN = re.compile(r"[+-]?[0-9.]+(?:[eE][+-]?[0-9]+)?")


def key_of(name: str) -> tuple[str, str | None]:
    """(key, unit) of a name: ``"supply_pressure_bar"`` -> ``("supply_pressure", "bar")``; None = no unit."""
    text, unit = re.sub(r"[\s_-]+", "_", name.strip()), None
    if bracketed := re.fullmatch(r"(.*?)_?[\[(](.*)[\])]", text):
        text, unit = bracketed.groups()
    key = text.lower()
    for known in CONDITION_UNITS:
        rest = text[len(known) + 1 :]
        if key.startswith(f"{known}_") and unit_of(rest) is not None:
            return known, rest
    return key, unit


def condition_value(
    key: str, value: str | float, *, where: str, field: str, messages: list[str] | None = None
) -> float | str:
    """One condition: text as it is, a physical value in SI (a bare number is SI, said in a message).

    Raises:
        InputError: a physical value that is no number, of another dimension, or negative.
    """
    if key == "accuracy":
        try:
            read_accuracy(str(value))
        except InputError as error:
            raise InputError(f"{where}: {error.message}", field=field, hint=error.hint) from error
    if key == "inclination" and isinstance(value, str):
        value = _INCLINATIONS.get(value.strip().lower(), value)
    if key not in CONDITION_UNITS:
        return str(value).strip()[:_MAX_TEXT]
    unit = CONDITION_UNITS[key]
    absolute = None
    if isinstance(value, str):
        plain, absolute = _without_mark(re.sub(r"^([+-]?[0-9]+),([0-9]+)", r"\1.\2", value))
        if _PLAIN.fullmatch(plain):
            if messages is not None:
                messages.append(f"{key}: no unit given, read as {plain} {unit}")
            plain = f"{plain} {unit}"
        if key == "temperature":
            plain = re.sub(r"(?<=[0-9.])\s*[°º]?\s*([CF])$", r" deg\1", plain)
        try:
            number = si(plain, unit, field=where)
        except InputError as error:
            raise InputError(error.message, field=field, hint=error.hint) from error
    else:
        number = float(value)
        if messages is not None:
            messages.append(f"{key}: no unit given, read as {number:g} {unit}")
    if not math.isfinite(number):
        raise InputError(f"{where}: '{value}' is not finite", field=field, hint="a finite value")
    number -= ATMOSPHERE if absolute and key != "ambient_pressure" else 0.0
    if number < 0.0 and key not in _SIGNED:
        raise InputError(f"{where}: '{value}' is negative", field=field, hint="a value of 0 or more")
    return number


def _without_mark(text: str) -> tuple[str, bool | None]:
    """A quantity without the mark of its reference: ``"6 bar(a)"`` -> ``("6 bar", True)``."""
    found = _QUANTITY.fullmatch(text.strip())
    unit = unit_of(found[2]) if found else None
    return (
        (text, None)
        if found is None or unit is None or unit.absolute is None
        else (f"{found[1]} {unit.name}", unit.absolute)
    )
