"""A pressure whose name names the valve: ``p_valve [MPa]`` beside a control voltage ``U_valve [V]``."""

from __future__ import annotations

import re
from collections.abc import Iterator

import numpy as np

from mckibben.measurement.measurement import STROKES
from mckibben.measurement.read.evidence import is_numeric
from mckibben.measurement.read.head_text import taken_apart
from mckibben.measurement.read.header import Meaning
from mckibben.measurement.read.left_out import Reason
from mckibben.measurement.read.plain_head import HeaderColumn
from mckibben.measurement.read.scatter import is_sensed
from mckibben.measurement.read.source import RawTable
from mckibben.measurement.read.unit_words import RAW_DIMENSIONS, dimension_of
from mckibben.measurement.read.vocabulary import (
    MEASURED_WORDS,
    channel_of_word,
    has_word,
    other_quantity,
    words_of,
)
from mckibben.physics.errors import InputError

_NAMED_AFTER_VALVE = (Reason.UNFIT, Reason.SEVERAL)
_CLAUSE = re.compile(r"[,;|]|[.:](?!\d)\s")
_SAME = 1e-4  # of its range: a column that follows the command so closely was computed from it


def with_valve_pressure(source: RawTable, meaning: Meaning) -> Meaning:
    """The meaning with a pressure that is named after the valve, where nothing else can be the pressure.

    It has to be the only column in a unit of pressure, and a text says that it was measured, or the command
    is another column, of which it is no multiple, or it scatters as the readings of a sensor do. A word for a
    set point keeps it a command.
    """
    if any(column.use == "pressure" for column in meaning.columns) or meaning.rivals:
        return meaning
    heads = [taken_apart(name, unit) for name, unit in _heads(source)]
    pressures = [
        index
        for index, head in enumerate(heads)
        if dimension_of(head.unit) == "a pressure" and index not in meaning.dismissed
    ]
    if len(pressures) != 1 or not is_numeric(source.sample, pressures[0]):
        return meaning
    index = pressures[0]
    head, words = heads[index], words_of(heads[index].name)
    left_out = meaning.reasons.get(index)
    if (
        left_out is None
        or left_out.reason not in _NAMED_AFTER_VALVE
        or not any(channel_of_word(word) == "command" for word in words)
        or any(_is_set(word) for word in words)
    ):
        return meaning
    clauses = [(clause, where) for text, where in source.rest for clause in _pressure_clauses(text)]
    if any(_is_set(word) for clause, _ in clauses for word in words_of(clause)):
        return meaning
    header = source.headers[index].strip()
    said = next((each for each in clauses if has_word(words_of(each[0]), MEASURED_WORDS)), None)
    command = _command(source, meaning, [each.unit for each in heads])
    if command is not None and _is_multiple(source, index, command):
        return meaning
    if said is not None:
        why = f"{said[1]} says '{said[0].strip()}'"
    elif command is not None:
        why = f"the command is '{source.headers[command].strip()}'"
    elif _is_sensed(source, meaning, index):
        why = (
            "its readings scatter from row to row, in motion as at rest, as those of a sensor do and no set "
            "point does"
        )
    else:
        return meaning
    column = HeaderColumn(index, header, "pressure", head.unit, head.absolute)
    return meaning._replace(
        columns=sorted([*meaning.columns, column], key=lambda each: each.place),
        ignored=[name for name in meaning.ignored if name != header],
        messages=[
            *meaning.messages,
            f"{source.noun} '{header}' is read as pressure: it is the only one in a unit of pressure, "
            f"and {why}",
        ],
        reasons={place: reason for place, reason in meaning.reasons.items() if place != index},
    )


def is_command(name: str, unit: str | None) -> bool:
    """Whether a head names the signal of a valve, also in volts: ``U_valve [V]``."""
    fits = unit is None or dimension_of(unit) in (*RAW_DIMENSIONS, "a plain number or a share")
    return fits and any(channel_of_word(word) == "command" for word in words_of(name))


def _heads(source: RawTable) -> Iterator[tuple[str, str | None]]:
    apart = [*source.units, *[None] * (len(source.headers) - len(source.units))]
    yield from zip((header.strip() for header in source.headers), apart, strict=False)


def _command(source: RawTable, meaning: Meaning, units: list[str | None]) -> int | None:
    """The column of the command, read or in volts; None without one."""
    used = next((column.place for column in meaning.columns if column.use == "command"), None)
    if used is not None:
        return used
    names = [taken_apart(name, unit).name for name, unit in _heads(source)]
    return next(
        (
            index
            for index, name in enumerate(names)
            if dimension_of(units[index]) in RAW_DIMENSIONS
            and is_command(name, units[index])
            and is_numeric(source.sample, index)
        ),
        None,
    )


def _is_set(word: str) -> bool:
    return other_quantity(word, "pressure") is Reason.SET_VALUE


def _pressure_clauses(text: str) -> Iterator[str]:
    """The clauses of a text that speak of the muscle's pressure: not of the supply, the air outside."""
    for clause in _CLAUSE.split(text):
        words = words_of(clause)
        others = {other_quantity(word, "pressure") for word in words} - {None, Reason.SET_VALUE}
        if any(channel_of_word(word) == "pressure" for word in words) and not others:
            yield clause


def _is_sensed(source: RawTable, meaning: Meaning, pressure: int) -> bool:
    """Whether the readings of a column scatter by themselves, in step with no other column that is read."""
    beside = [column.place for column in meaning.columns if column.use in ("force", *STROKES)]
    try:
        numbers = source.read([pressure, *beside], [], True).numbers
    except InputError:
        return False
    values, *others = (numbers[place].astype(np.float64) for place in (pressure, *beside))
    with np.errstate(all="ignore"):  # numbers near the largest there are
        return is_sensed(values, others)


def _is_multiple(source: RawTable, pressure: int, command: int) -> bool:
    """Whether the pressure is the command in another unit, to the last digits."""
    try:
        numbers = source.read([pressure, command], [], True).numbers
    except InputError:
        return False
    values, signal = (numbers[place].astype(np.float64) for place in (pressure, command))
    if not (np.ptp(values) > 0.0 and np.ptp(signal) > 0.0):
        return False
    line = np.polynomial.Polynomial.fit(signal, values, 1)
    return bool(np.max(np.abs(values - line(signal))) <= _SAME * np.ptp(values))
