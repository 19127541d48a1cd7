"""Measurements from MATLAB files v5 to v7: vectors by variable name, structs, arrays of structs, signals.

``pressure_bar = [...]`` is a column like that of a CSV; scalar and text variables are conditions. Nothing of
the file is ever executed; objects are not read.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from mckibben.measurement.measurement import STROKES
from mckibben.measurement.read.conditions import Note
from mckibben.measurement.read.containers import NamedTable, known_uses, matrix_tables, named_tables
from mckibben.measurement.read.correction import Correction
from mckibben.measurement.read.mat5 import DamagedError, Foreign, read_variables
from mckibben.measurement.read.recognise import BY_UNIT, recognise
from mckibben.measurement.read.source import HeaderColumn, RawTable, array_source
from mckibben.measurement.read.stated import in_known_words, statements
from mckibben.physics.errors import InputError, did_you_mean

_NOUN = "variable"
_LOOSE = "variables"  # the table of those in no struct
TABLE_HINT = "save a table with: s = table2struct(T, 'ToScalar', true); save('test.mat', '-struct', 's')"


def open_mat(data: bytes, name: str, correction: Correction | None = None) -> RawTable:
    """The table of a MATLAB file v5 to v7.

    Raises:
        InputError: damaged, or without vectors that are named like channels.
    """
    try:
        values = read_variables(data, name)
    except DamagedError as error:
        raise InputError(
            f"{name}: no variable can be read: the MATLAB file is damaged ({error})",
            field="file", hint="save it again with -v7",
        ) from error  # fmt: skip
    return choose(values, name, correction)


def choose(values: dict[str, Any], name: str, correction: Correction | None = None) -> RawTable:
    """The source of a file's variables, or of the struct (array of structs, matrix) with most channels.

    Raises:
        InputError: vectors of different lengths, nothing that is a vector, no such struct.
    """
    wanted = correction.sheet if correction else None
    foreign = {key: value.kind for key, value in values.items() if isinstance(value, Foreign)}
    tables = named_tables(without_foreign(values), name=name, noun=_NOUN)
    usable = [table for table in tables if table.columns and table.problem is None]
    problem = next((table.problem for table in tables if table.problem is not None), None)
    if wanted is not None:
        usable = [table for table in usable if (table.title or _LOOSE) == wanted]
        if not usable:
            titles = [table.title for table in tables if table.title]
            raise InputError(
                f"{name}: there is no struct '{wanted}' with vectors",
                field="sheet",
                hint=did_you_mean(wanted, titles),
            )
    if problem is None and not any(table.known() for table in usable) and not foreign:
        usable += matrix_tables(without_foreign(values))[:1] if not usable else []
    best = max(usable, key=NamedTable.known, default=None)
    most = best.known() if best is not None else -1
    if problem is not None and most <= 0:
        raise problem
    if foreign and most <= 0:
        key, kind = next(iter(foreign.items()))
        raise InputError(
            f"{name}: {_NOUN} '{key}' is a {kind}, which cannot be read",
            field=f"{_NOUN} {key}", hint=TABLE_HINT,
        )  # fmt: skip
    if best is None:
        raise InputError(
            f"{name}: no {_NOUN} is a vector of numbers (variables: {', '.join(values)[:100] or 'none'})",
            field=f"{_NOUN}s", hint="e.g. pressure_bar = [0; 1; 2], length_mm = [300; 290; 280]",
        )  # fmt: skip
    rivals = [t for t in usable if t is not best and most >= 2 and t.known() >= most]
    rest = [text for table in tables for text in table.rest]
    notes = _notes_beside(best, tables)
    known_notes = in_known_words(notes)
    known = {note.key for note in known_notes}
    known_notes += [note for note in statements(rest, name) if note.key not in known]
    messages = [
        *best.messages,
        *(f"{_NOUN} '{key}' is not used: it is a {kind}" for key, kind in foreign.items()),
    ]
    if problem is not None:
        messages.append(problem.message)
    place = f"{name}, struct '{best.title}'" if best.title else name
    columns = with_held_values(best.columns, known_notes, messages)
    source = array_source(
        columns, place=place, format="mat", noun=_NOUN, notes=known_notes, messages=messages
    )
    others = [table for table in usable if table is not best]
    heads = [f"{table.title}.{head}".lstrip(".") for table in others for head in table.columns]
    source = replace(
        source, rest=tuple(rest), unread=tuple((head, "it is in another struct") for head in heads)
    )
    named = [table for table in tables if table.columns and table.problem is None]
    source = replace(source, tables=tuple((t.title or _LOOSE, t is best) for t in named))
    if rivals and wanted is None:
        choices = tuple((t.title or _LOOSE, ", ".join(t.columns)[:80]) for t in (best, *rivals))
        source = replace(source, choices=choices)
    return source


def with_held_values(
    columns: Mapping[str, HeaderColumn], notes: Sequence[Note], messages: list[str]
) -> dict[str, HeaderColumn]:
    """The columns, and those of single values that were held: a pressure, or a length beside the one at rest.

    The name has to say the quantity and its unit; a message says each.
    """
    known = known_uses(list(columns))
    rows = len(next(iter(columns.values()), ()))
    result = dict(columns)
    at_rest = any(note.key == "nominal_length" for note in notes)
    if "force" not in known:
        return result
    for note in notes:
        head = recognise(note.key)
        held = head.channel in ("pressure", "length") and head.unit is not None and head.penalty < BY_UNIT
        if not held or head.channel in known or not isinstance(note.value, (int, float)):
            continue
        if head.channel == "length" and (not at_rest or known & set(STROKES)):
            continue
        result[note.key] = np.full(rows, float(note.value))
        known.add(str(head.channel))
        messages.append(f"{_NOUN} '{note.key}' is one value: it is held in all rows")
    return result


def _notes_beside(best: NamedTable, tables: Sequence[NamedTable]) -> list[Note]:
    """Single values that belong to a table: its own, then those of structs without vectors and of the file.

    What several such structs say differently belongs to none.
    """
    apart = [table for table in tables if table is not best and not table.columns]
    loose: dict[str, list[Note]] = {}
    for note in [note for table in apart for note in table.notes]:
        loose.setdefault(note.key, []).append(note)
    beside = [same[0] for same in loose.values() if len({str(note.value) for note in same}) == 1]
    own = {note.key for note in best.notes}
    said = [*(tables[0].notes if best is not tables[0] and best.title else []), *beside]
    return [*(note for note in dict.fromkeys(said) if note.key not in own), *best.notes]


def without_foreign(values: dict[str, Any]) -> dict[str, Any]:
    """The values without objects, at any depth."""
    result: dict[str, Any] = {}
    for key, value in values.items():
        if isinstance(value, dict):
            result[key] = _struct_array(without_foreign(value))
        elif isinstance(value, list):
            result[key] = [without_foreign(item) if isinstance(item, dict) else item for item in value]
        elif not isinstance(value, Foreign):
            result[key] = value
    return result


def _struct_array(fields: dict[str, Any]) -> Any:
    """An array of structs that is kept field by field, as v7.3 does, struct by struct."""
    lists = [value for value in fields.values() if isinstance(value, list)]
    if not lists or len(lists) != len(fields) or any(isinstance(v, str) for v in lists[0]):
        return fields
    count = len(lists[0])
    if count < 2 or any(len(value) != count for value in lists):
        return fields
    return [{key: value[number] for key, value in fields.items()} for number in range(count)]
