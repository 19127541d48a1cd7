"""Columns that hold a condition of the test in every row: a rest length, a load, a supply pressure."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mckibben.measurement.question import Question
from mckibben.measurement.read.conditions import CONDITION_UNITS, Note, key_of
from mckibben.measurement.read.correction import SAMPLE
from mckibben.measurement.read.evidence import Evidence, is_numeric
from mckibben.measurement.read.header import Meaning
from mckibben.measurement.read.recognise import taken_apart
from mckibben.measurement.read.source import RawTable
from mckibben.measurement.read.stated import NAME, in_known_words
from mckibben.physics.errors import InputError

_MOST_VALUES = 12  # different ones of a condition that changes from test to test; more are readings
_SHOWN = 4
#: Condition -> the option that sets it.
_OPTIONS = {
    "nominal_length": "--rest-length", "load_mass": "--load", "load_force": "--load",
    "supply_pressure": "--supply",
}  # fmt: skip


class Constant:
    """A column that is named like a condition: where it stands, its key, its different values as texts."""

    def __init__(self, place: int, key: str, values: Sequence[str]) -> None:
        self.place, self.key, self.values = place, key, list(values)


def with_constants(source: RawTable, meaning: Meaning) -> RawTable:
    """The table with the conditions that columns hold in every row as its own; none of the file's is lost.

    Where the file says another value elsewhere, both are said and the column counts: it belongs to the rows.
    The file's name says less than either.
    """
    said = {key_of(note.key)[0]: note for note in source.notes}
    notes, messages, unread = list(source.notes), [], dict(source.unread)
    for column in constants_of(source, meaning):
        header = source.headers[column.place]
        if len(column.values) != 1:
            continue
        where = f"{source.noun} '{header}'"
        before = said.get(column.key)
        if before is not None:
            notes.remove(before)
            if before.where != NAME and str(before.value) != column.values[0]:
                messages.append(
                    f"{where} says {column.key} {column.values[0]}, {before.where} says {before.value}: "
                    f"that of the {source.noun} counts"
                )
        notes.append(said.setdefault(column.key, Note(where, column.key, column.values[0])))
    if notes == source.notes:
        return source
    return replace(source, notes=notes, messages=[*source.messages, *messages])


def constants_of(source: RawTable, meaning: Meaning) -> list[Constant]:
    """The columns that no channel is read from and that are named like a condition with a unit."""
    taken = {column.place for column in meaning.columns if column.use != SAMPLE} | meaning.dismissed
    found = []
    for index, header in enumerate(source.headers):
        if index in taken or not header or not is_numeric(source.sample, index):
            continue
        apart = source.units[index] if index < len(source.units) else None
        name = f"{taken_apart(header).name} [{apart}]" if apart else header
        if _key_of(name, 1.0) is None:
            continue
        try:
            values = np.unique(source.read([index], [], True).numbers[index])
        except InputError:
            continue
        texts = [note.value for value in values[: _MOST_VALUES + 1] if (note := _note(name, float(value)))]
        if texts and len(values) <= _MOST_VALUES and (key := _key_of(name, float(values[0]))):
            found.append(Constant(index, key, [str(text) for text in texts]))
    return found


def _note(name: str, value: float) -> Note | None:
    """The value of a column as a condition with its unit; None = it is none."""
    note = next(iter(in_known_words([Note("", name, value)])))
    key, unit = key_of(note.key)
    if key not in CONDITION_UNITS or key == "temperature":
        return None
    text = f"{note.value:.10g}" if isinstance(note.value, float) else str(note.value)
    return Note("", key, f"{text} {unit}" if unit else text)


def _key_of(name: str, value: float) -> str | None:
    note = _note(name, value)
    return None if note is None else note.key


def constant_questions(evidence: Evidence, varying: Sequence[Constant]) -> list[Question]:
    """A question for each condition that changes within the file and that nobody has set."""
    asked = []
    for column in varying:
        if len(column.values) < 2 or column.key in evidence.conditions:
            continue
        header = evidence.headers[column.place]
        shown = ", ".join(column.values[:_SHOWN]) + (" ..." if len(column.values) > _SHOWN else "")
        option = _OPTIONS.get(column.key)
        first = column.values[0]
        asked.append(
            Question(
                column.key.replace("nominal", "rest").replace("_", " "),
                f"{evidence.noun} '{header}' holds {len(column.values)} values, {shown}; a measurement has one "
                f"{column.key.replace('nominal', 'rest').replace('_', ' ')}: split the file, or say which counts",
                f'{option} "{first}"' if option else f'--experiment "{column.key}={first}"',
                header,
                first,
                tuple(column.values),
            )
        )
    return asked
