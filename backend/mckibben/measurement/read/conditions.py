"""Conditions of a test: ``# load_mass: 12 kg`` of a text, scalar variables, properties, the user's word."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable
from typing import NamedTuple

from mckibben.measurement.accuracy import read_accuracy
from mckibben.measurement.read.marks import split_mark
from mckibben.physics.errors import InputError
from mckibben.physics.units import is_unit, si

ATMOSPHERE = 101_325.0  # Pa, subtracted from an absolute pressure where the file states no ambient one

#: Command before the first row: the valve may have stood elsewhere than at rest.
COMMAND_BEFORE = "command_before"
#: Conditions that are physical values -> SI unit; the others stay text.
CONDITION_UNITS = {
    "load_mass": "kg", "load_force": "N", "supply_pressure": "Pa", "nominal_length": "m", "temperature": "K",
    "inclination": "rad", "force_zero": "N", "pressure_zero": "Pa", "ambient_pressure": "Pa",
    COMMAND_BEFORE: "1",
}  # fmt: skip
#: Conditions with a meaning that are text.
TEXT_CONDITIONS = (
    "muscle", "sample", "pressure", "accuracy", "valve", "tube", "stops", "fixed_end",
)  # fmt: skip
#: Key of the columns that a file says are not to be read.
IGNORE = "ignore"
_SIGNED = ("inclination", "force_zero", "pressure_zero", COMMAND_BEFORE)  # conditions that may be negative
_INCLINATIONS = {"vertical": "90 deg", "hanging": "90 deg", "horizontal": "0 deg"}
_MAX_TEXT = 200
_LINE = re.compile(r"#+\s*([A-Za-z][A-Za-z_ -]{0,30}?)\s*:\s*(.*)")
_PLAIN = re.compile(r"[+-]?[0-9.]+(?:[eE][+-]?[0-9]+)?")


class Note(NamedTuple):
    """One condition as a file says it: ``where`` in the file, a key, a value."""

    where: str
    key: str
    value: str | float


class Constant(NamedTuple):
    """A column that is named like a condition: where it stands, its key, its different values as texts."""

    place: int
    key: str
    values: tuple[str, ...]


def note_of_line(line: str, where: str) -> Note | None:
    """The condition in a comment line ``# key: value``; None = a plain comment."""
    found = _LINE.fullmatch(line)
    return Note(where, found[1], found[2].strip()) if found and found[2] else None


def key_of(name: str) -> tuple[str, str | None]:
    """(key, unit) of a name: ``"supply_pressure_bar"`` -> ``("supply_pressure", "bar")``; None = no unit."""
    text, unit = re.sub(r"[\s_-]+", "_", name.strip()), None
    if bracketed := re.fullmatch(r"(.*?)_?[\[(](.*)[\])]", text):
        text, unit = bracketed.groups()
    key = text.lower()
    for known in CONDITION_UNITS:
        rest = text[len(known) + 1 :]
        if key.startswith(f"{known}_") and is_unit(split_mark(rest)[0]):
            return known, rest
    return key, unit


def read_conditions(notes: Iterable[Note], messages: list[str]) -> dict[str, float | str]:
    """All conditions; the known physical ones in SI.

    Raises:
        InputError: a physical condition whose value cannot be used, naming where it stands.
    """
    conditions: dict[str, float | str] = {}
    for where, name, value in notes:
        key, unit = key_of(name)
        if key == IGNORE:
            continue
        if unit is not None and key in CONDITION_UNITS:
            value = f"{value} {unit}"
        conditions[key] = condition_value(key, value, where=f"{where}, {key}", field=key, messages=messages)
    return conditions


def unwanted_columns(notes: Iterable[Note]) -> list[str]:
    """Columns that the file itself says are not to be read: ``# ignore: load_position_m, air_flow_kg/s``."""
    found = [str(value).split(",") for _, name, value in notes if key_of(name)[0] == IGNORE]
    return [name.strip() for names in found for name in names]


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
        plain, absolute = split_mark(re.sub(r"^([+-]?[0-9]+),([0-9]+)", r"\1.\2", value))
        if _PLAIN.fullmatch(plain):
            if messages is not None:
                messages.append(f"{key}: no unit given, read as {plain} {unit}")
            plain = f"{plain} {unit}"
        if key == "temperature":
            plain = re.sub(r"(?<=[0-9.])\s*[°º]?\s*([CF])$", r" deg\1", plain)
        number = si(plain, unit, field=where)
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
