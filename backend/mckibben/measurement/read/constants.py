"""Columns that hold a condition of the test in every row: a rest length, a load, a supply pressure."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from mckibben.measurement.question import Question
from mckibben.measurement.read.air import AIR
from mckibben.measurement.read.conditions import CONDITION_UNITS, Constant, Note, condition_value, key_of
from mckibben.measurement.read.correction import SAMPLE
from mckibben.measurement.read.evidence import Evidence, is_numeric
from mckibben.measurement.read.head_text import taken_apart
from mckibben.measurement.read.header import Meaning
from mckibben.measurement.read.left_out import LeftOut, Reason
from mckibben.measurement.read.order_codes import notes_of_code
from mckibben.measurement.read.plain_head import WEIGHTS, HeaderColumn
from mckibben.measurement.read.recognise import BY_WORDS
from mckibben.measurement.read.source import RawTable
from mckibben.measurement.read.stated import NAME, in_known_words
from mckibben.physics.errors import InputError

_MOST_VALUES = 12  # different ones of a condition that changes from test to test; more are readings
_SHOWN = 4
#: Conditions that have one value in a measurement -> (their name, the option that sets it).
_SINGLE = {"nominal_length": ("rest length", "--rest-length"), "load_mass": ("load", "--load")}


def with_constants(source: RawTable, meaning: Meaning) -> Meaning:
    """The meaning with the columns that hold conditions; those of one value are no longer ignored."""
    meaning = _without_hung_mass(source, meaning)
    found = _constants(source, meaning)
    found, loads = _loads_apart(source, meaning, found)
    if loads is not None:
        meaning = meaning._replace(
            columns=sorted([*meaning.columns, loads], key=lambda column: column.place),
            ignored=[header for header in meaning.ignored if header != loads.header],
            messages=[
                *meaning.messages,
                f"{source.noun} '{loads.header}' is the load of each row: it is the force",
            ],
        )
    if not found:
        return meaning
    held = {
        c.place: LeftOut(Reason.CONDITION, f"it is a condition, {c.key} {', '.join(c.values[:_SHOWN])}")
        for c in found
    }
    headers = {source.headers[c.place] for c in found if len(c.values) == 1}
    return meaning._replace(
        constants=tuple(found),
        ignored=[header for header in meaning.ignored if header not in headers],
        reasons={**meaning.reasons, **held},
    )


def _without_hung_mass(source: RawTable, meaning: Meaning) -> Meaning:
    """The meaning without a force that is the mass of the load, the same in all rows: a condition."""
    for column in meaning.columns:
        if column.use != "force" or column.origin != "file" or key_of(column.header)[0] != "load_mass":
            continue
        try:
            values = source.read([column.place], [], True).numbers[column.place]
        except InputError:
            continue
        if len(values) and (values == values[0]).all():
            weighed = f"{source.noun} '{column.header}' is a mass"
            return meaning._replace(
                columns=[c for c in meaning.columns if c is not column],
                messages=[message for message in meaning.messages if not message.startswith(weighed)],
            )
    return meaning


def _loads_apart(
    source: RawTable, meaning: Meaning, found: list[Constant]
) -> tuple[list[Constant], HeaderColumn | None]:
    """The columns of conditions without the one of several loads, which is a force where no other is read."""
    loads = [c for c in found if c.key in ("load_mass", "load_force") and len(c.values) > 1]
    if len(loads) != 1 or any(column.use == "force" for column in meaning.columns):
        return found, None
    (load,) = loads
    header = source.headers[load.place]
    unit = taken_apart(header, source.units[load.place] if load.place < len(source.units) else None).unit
    unit = unit or key_of(header)[1] or CONDITION_UNITS[load.key]
    column = HeaderColumn(load.place, header, "force", WEIGHTS.get(unit, unit), penalty=BY_WORDS)
    return [c for c in found if c is not load], column


def _constants(source: RawTable, meaning: Meaning) -> list[Constant]:
    taken = {column.place for column in meaning.columns} | meaning.dismissed
    found = []
    for index, header in enumerate(source.headers):
        if index in taken or not header or not is_numeric(source.sample, index):
            continue
        apart = source.units[index] if index < len(source.units) else None
        name = f"{taken_apart(header).name} [{apart}]" if apart else header
        if _condition(name, 1.0) is None:
            continue
        try:
            values = np.unique(source.read([index], [], True).numbers[index])
        except InputError:
            continue
        notes = [note for value in values[: _MOST_VALUES + 1] if (note := _condition(name, float(value)))]
        if notes and (len(values) <= _MOST_VALUES or notes[0].key == AIR):
            found.append(Constant(index, notes[0].key, tuple(str(note.value) for note in notes)))
    return found


def _condition(name: str, value: float) -> Note | None:
    """The value of a column as a condition with its unit; None = it is none."""
    note = next(iter(in_known_words([Note("", name, f"{value:.10g}")])))
    key, unit = key_of(note.key)
    if key not in CONDITION_UNITS or key == "temperature":
        return None
    return Note("", key, f"{note.value} {unit}" if unit else note.value)


def notes_with_constants(source: RawTable, meaning: Meaning, messages: list[str] | None = None) -> list[Note]:
    """The conditions that a file states, those that its columns hold among them.

    Where the file says another value elsewhere the column counts, as it belongs to the rows, and a message
    says so; the name of the file says less than either. The order code in a column of one muscle comes last.
    """
    said = {key_of(note.key)[0]: note for note in source.notes}
    for column in meaning.constants:
        if len(column.values) != 1:
            continue
        where = f"{source.noun} '{source.headers[column.place]}'"
        before = said.get(column.key)
        if before is not None and before.where != NAME and not _same(before, column) and messages is not None:
            messages.append(
                f"{where} says {column.key} {column.values[0]}, {before.where} says {before.value}: "
                f"the value of the {source.noun} is used"
            )
        said[column.key] = Note(where, column.key, column.values[0])
    for column in meaning.columns:
        if column.use == SAMPLE and len(words := _words(source, column.place)) == 1:
            for note in notes_of_code(Note(f"{source.noun} '{column.header}'", SAMPLE, words[0])):
                if note.key not in said or said[note.key].where == NAME:
                    said[note.key] = note
    return list(said.values())


def _words(source: RawTable, place: int) -> list[str]:
    try:
        return source.read([], [place], True).labels[place].words
    except InputError:
        return []


def _same(note: Note, column: Constant) -> bool:
    try:
        one, other = (
            condition_value(column.key, value, where=note.where, field=column.key)
            for value in (note.value, column.values[0])
        )
    except InputError:
        return False
    return isinstance(one, float) and isinstance(other, float) and math.isclose(one, other, rel_tol=1e-6)


def constant_questions(evidence: Evidence, columns: Sequence[Constant]) -> list[Question]:
    """A question for each rest length or load that changes within the file and that nobody has set."""
    asked = []
    for column in columns:
        if len(column.values) < 2 or column.key in evidence.conditions or column.key not in _SINGLE:
            continue
        header = evidence.headers[column.place]
        name, option = _SINGLE[column.key]
        shown = ", ".join(column.values[:_SHOWN]) + (" ..." if len(column.values) > _SHOWN else "")
        asked.append(
            Question(
                name,
                f"{evidence.noun} '{header}' holds {len(column.values)} values, {shown}, but a measurement "
                f"has one {name}; split the file by it, or state which one holds for all rows",
                f'{option} "{column.values[0]}"',
                header,
                column.values[0],
                column.values,
            )
        )
    return asked
