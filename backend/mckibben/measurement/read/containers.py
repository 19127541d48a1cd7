"""Tables among the named values of a MATLAB file: vectors, structs, arrays of structs, signals, matrices.

A signal is a struct of one vector with a text for its name, and perhaps one for its unit, as recorders write
it. Nothing depends on how variables or fields are called, except that a field is the name of a signal.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mckibben.measurement.measurement import CHANNEL_UNITS, STROKES
from mckibben.measurement.read.conditions import CONDITION_UNITS, Note, key_of
from mckibben.measurement.read.header import map_headers
from mckibben.measurement.read.matrix_maps import maps_apart
from mckibben.measurement.read.recognise import recognise
from mckibben.measurement.read.signals import is_vector, signals_of, texts_of_signals
from mckibben.measurement.read.source import HeaderColumn
from mckibben.measurement.read.stated import in_known_words
from mckibben.measurement.read.unit_lists import names_units, unit_said, units_in_text, units_of_columns
from mckibben.measurement.read.unit_words import dimension_of, unit_of
from mckibben.measurement.read.vectors import sorted_out
from mckibben.measurement.read.vocabulary import UNIT_WORDS, words_of
from mckibben.physics.errors import InputError

_MAX_COLUMNS = 60  # of a matrix that is taken apart
_DEEPEST = 4
_HELD = ("pressure", "force", *STROKES)  # what a test may hold
_FEWEST_ROWS = 4  # of a matrix that can be readings
RUN = "group"

Units = Mapping[str, str]  # name of a variable, or of what says its unit -> unit


@dataclass
class NamedTable:
    """Columns of named values, and what stands beside them.

    Attributes:
        title: variable or struct, "" for the variables of the file themselves.
        columns: head -> numbers or words.
        notes: single values beside the columns.
        rest: texts beside them, and where they stand.
        problem: why the columns cannot be used.
        numbered: the column of the parts is not of the file.
    """

    title: str
    columns: dict[str, HeaderColumn]
    notes: list[Note] = field(default_factory=list)
    rest: list[tuple[str, str]] = field(default_factory=list)
    messages: list[str] = field(default_factory=list)
    problem: InputError | None = None
    numbered: bool = False

    def known(self) -> int:
        """Number of channels that the heads name."""
        return len(known_uses(list(self.columns)))


def known_uses(heads: list[str]) -> set[str]:
    """The channels that heads name."""
    if not heads:
        return set()
    meaning = map_headers([*heads, "?"], place="", collect=True)
    return {column.use for column in meaning.columns if column.use in CHANNEL_UNITS} - {"group", "direction"}


def named_tables(values: Mapping[str, Any], *, name: str, noun: str) -> list[NamedTable]:
    """All tables of the values of a file, the outermost first."""
    return list(_tables(values, "", name, noun, 0, {}))


def matrix_tables(values: Mapping[str, Any], *, prefix: str = "") -> list[NamedTable]:
    """The matrices of a file whose columns nothing names, as columns ``M(:,1)``."""
    found = []
    for key, value in values.items():
        where = f"{prefix}{key}"
        if isinstance(value, dict):
            found += matrix_tables(value, prefix=f"{where}.")
        elif isinstance(value, np.ndarray) and value.ndim == 2 and value.dtype.kind in "biuf":
            columns = value if value.shape[0] >= value.shape[1] else value.T
            if columns.shape[0] > _FEWEST_ROWS and 1 < columns.shape[1] <= _MAX_COLUMNS:
                heads = [f"{where}(:,{number})" for number in range(1, columns.shape[1] + 1)]
                named = {h: columns[:, n].astype(np.float64) for n, h in enumerate(heads)}
                found.append(NamedTable(where, dict(named)))
    return found


def _with_units(values: dict[str, Any], inner: list[tuple[str, Any]], outer: Units) -> dict[str, Any]:
    """Vectors with the unit that stands beside them: ``Kraft_unit = 'N'``, ``units.Kraft = 'N'``.

    A text or list of all units counts too, and what is said of the name further out.
    """
    structs = [value for _, value in inner if isinstance(value, dict)]
    vectors = [key for key, value in values.items() if is_vector(value)]
    beside = units_of_columns(vectors, {k: v for k, v in values.items() if isinstance(v, str)})
    listed = dict(zip(vectors, beside, strict=True))
    result = {}
    for key, value in values.items():
        unit = listed.get(key) or next((s[key] for s in structs if isinstance(s.get(key), str)), None)
        unit = unit or outer.get(key) or unit_said(key, outer)
        if key in listed and unit is not None and unit_of(unit) is not None and recognise(key).unit is None:
            result[f"{key} [{unit}]"] = value
        else:
            result[key] = value
    return result


def _units_beside(values: Mapping[str, Any]) -> Units:
    """Units that values say for names further in: ``units.p``, ``p_unit``, ``"p: bar, t: s"``."""
    found: dict[str, str] = {}
    for key, value in values.items():
        if isinstance(value, dict) and names_units(key):
            found |= {k: v for k, v in value.items() if isinstance(v, str)}
        elif isinstance(value, str) and any(word in UNIT_WORDS for word in words_of(key)):
            found[key] = value
            found |= units_in_text(value)
    return found


def _tables(
    values: Mapping[str, Any], path: str, name: str, noun: str, depth: int, units: Units
) -> Iterator[NamedTable]:
    place = f"{name}, struct '{path}'" if path else name
    own: dict[str, Any] = {}
    table = NamedTable(path, {})
    inner: list[tuple[str, Any]] = []
    for key, value in values.items():
        signals = signals_of(key, value)
        if signals is not None:
            own |= signals
            table.rest += texts_of_signals(value, f"{noun} '{f'{path}.' if path else ''}{key}'")
        elif isinstance(value, dict) or (isinstance(value, list) and value and isinstance(value[0], dict)):
            inner.append((key, value))
        else:
            own[key] = value
    own = _with_units(_matrices_apart(own), inner, units)
    units = {**units, **_units_beside(values)}
    inner = _alike_together(inner)
    try:
        own, said = maps_apart(own, place=place, noun=noun)
        table.columns, table.notes, table.messages = sorted_out(own, place=place, noun=noun)
        table.messages[:0] = said
    except InputError as error:
        table.problem = error
    table.rest += [
        (text, f"{noun} '{key}'") for key, text in own.items() if isinstance(text, str) and text.strip()
    ]
    yield table
    if depth >= _DEEPEST:
        return
    for key, value in inner:
        where = f"{path}.{key}" if path else key
        if isinstance(value, dict) and names_units(key):
            continue  # they are in the names of the columns
        if isinstance(value, dict):
            yield from _tables(value, where, name, noun, depth + 1, units)
        else:
            yield from _parts(value, where, name, noun, depth, units)


def _alike_together(inner: list[tuple[str, Any]]) -> list[tuple[str, Any]]:
    """Structs of the same fields, ``run_01``, ``run_02``, as an array of structs."""
    fields = [frozenset(value) for _, value in inner if isinstance(value, dict)]
    if len(inner) < 2 or len(fields) < len(inner) or len(set(fields)) > 1 or not _holds_vector(inner[0][1]):
        return inner
    return [(f"{inner[0][0]} to {inner[-1][0]}", [value for _, value in inner])]


def _holds_vector(value: Any, depth: int = 0) -> bool:
    """Whether a value is a vector, or holds one at any depth."""
    if isinstance(value, dict) and depth < _DEEPEST:
        return any(_holds_vector(item, depth + 1) for item in value.values())
    if isinstance(value, list) and value and isinstance(value[0], dict):
        return _holds_vector(value[0], depth + 1)
    return is_vector(value)


def _parts(
    structs: list[Any], path: str, name: str, noun: str, depth: int, units: Units
) -> Iterator[NamedTable]:
    """The table of an array of structs of the same fields, one part below the other; else each for itself."""
    tables = []
    for number, struct in enumerate(structs, start=1):
        if isinstance(struct, dict):
            found = list(_tables(struct, f"{path}({number})", name, noun, depth + 1, units))
            first = _one_of(found)
            if first is not None:
                tables.append(first)
    if not tables:
        return
    heads = set(tables[0].columns)
    if all(set(table.columns) == heads for table in tables):
        yield stacked(tables, path) if len(tables) > 1 else _with_held(tables[0])
    else:
        yield from tables


def _with_held(table: NamedTable) -> NamedTable:
    """The table of a single test with the channels that its single values name: its length, its pressure."""
    used = known_uses(list(table.columns))
    rows = len(next(iter(table.columns.values())))
    for head, value in _constants(table).items():
        channel = recognise(head).channel
        if channel in _HELD and not _is_known(channel, used):
            table.columns[head] = np.full(rows, value)
            table.notes = [note for note in table.notes if note.key != head]
            table.messages.append(f"'{head}' is the same in all rows: {value:g}")
    return table


def _is_known(channel: str, used: set[str]) -> bool:
    """Whether columns hold a channel; a length beside a stroke is that of the muscle at rest."""
    return channel in used or (channel in STROKES and bool(used & set(STROKES)))


def _one_of(found: list[NamedTable]) -> NamedTable | None:
    """The table of one struct, with what stands around its vectors in it; None = it holds none.

    Vectors may stand further in, ``test.data.p``, beside the conditions, ``test.conditions.length``.
    """
    filled = [table for table in found if table.columns and table.problem is None]
    best = max(filled, key=NamedTable.known, default=None)  # the outermost of equal ones
    if best is None:
        return None
    around = [table for table in found if not table.columns and table.problem is None]
    own = {note.key for note in best.notes}
    best.notes += [note for table in around for note in table.notes if note.key not in own]
    best.rest = [*(text for table in around for text in table.rest), *best.rest]
    left = [f"'{table.title}'" for table in filled if table is not best]
    if left:
        verb = "is" if len(left) == 1 else "are"
        best.messages.append(
            f"{', '.join(left[:6])} {verb} not read: the readings are taken from '{best.title}'"
        )
    return best


def stacked(tables: list[NamedTable], title: str) -> NamedTable:
    """Tables of the same columns one below the other; single values that name a channel become columns."""
    rows = [len(next(iter(table.columns.values()))) for table in tables]
    columns: dict[str, HeaderColumn] = {}
    for head in tables[0].columns:
        pieces = [table.columns[head] for table in tables]
        if any(isinstance(piece, list) for piece in pieces):
            columns[head] = [str(word) for piece in pieces for word in piece]
        else:
            columns[head] = np.concatenate([np.asarray(piece) for piece in pieces])
    if all(table.numbered for table in tables):  # parts of parts: each has its own number
        counts = np.cumsum([0, *(np.max(np.asarray(table.columns[RUN])) + 1 for table in tables[:-1])])
        columns[RUN] = np.concatenate(
            [np.asarray(table.columns[RUN]) + count for table, count in zip(tables, counts, strict=True)]
        )
    used = known_uses(list(columns))
    constants = [_constants(table) for table in tables]
    taken: set[str] = set()
    for head in dict.fromkeys(head for found in constants for head in found):
        channel = _channel_of_constant(head)
        if channel is None or _is_known(channel, used) or not all(head in found for found in constants):
            continue
        used.add(channel)
        taken.add(head)
        text = head if recognise(head).channel == channel else f"{channel} [{recognise(head).unit}]"
        columns[text] = np.repeat([found[head] for found in constants], rows)
    apart = [
        note.key
        for note in tables[0].notes
        if note.key not in taken and len({str(_said(table, note.key)) for table in tables}) > 1
    ]
    for key in apart:  # a load of each run; whoever reads the columns says what several values mean
        values = [found.get(key) for found in constants]
        if _is_condition(key) and None not in values:
            columns[key] = np.repeat(np.array(values, dtype=float), rows)
    numbered = all(table.numbered for table in tables)
    if RUN not in columns and not any(recognise(head).channel == "group" for head in columns):
        numbered = True
        columns[RUN] = np.repeat(np.arange(len(tables), dtype=float), rows)
    message = f"{len(tables)} parts with the same columns are read one after another"
    return NamedTable(
        title, columns,
        [note for note in tables[0].notes if note.key not in taken and note.key not in apart],
        [text for table in tables for text in table.rest],
        [*tables[0].messages, message], numbered=numbered,
    )  # fmt: skip


def _said(table: NamedTable, key: str) -> str | float | None:
    return next((note.value for note in table.notes if note.key == key), None)


def _is_condition(key: str) -> bool:
    """Whether a name is that of a condition with a unit."""
    return key_of(in_known_words([Note("", key, "1")])[0].key)[0] in CONDITION_UNITS


def _constants(table: NamedTable) -> dict[str, float]:
    return {note.key: float(note.value) for note in table.notes if isinstance(note.value, (int, float))}


def _channel_of_constant(head: str) -> str | None:
    """The channel of a value that is held in a part: the pressure of a run, also when it is a set value."""
    known = recognise(head)
    if known.channel is not None and known.channel not in ("group", "time"):
        return known.channel
    return "pressure" if known.unit is not None and dimension_of(known.unit) == "a pressure" else None


def _matrices_apart(values: Mapping[str, Any]) -> dict[str, Any]:
    """Matrices as columns, named by the list of as many texts beside them."""
    result: dict[str, Any] = {}
    lists = [
        v for v in values.values() if isinstance(v, list) and v and all(isinstance(word, str) for word in v)
    ]
    for key, value in values.items():
        if isinstance(value, np.ndarray) and value.ndim == 2 and value.dtype.kind in "biuf":
            if value.shape[1] > value.shape[0] and any(len(names) == value.shape[0] for names in lists):
                value = value.T
            rows, width = value.shape
            names = next((names for names in lists if len(names) == width), None)
            if names is not None and rows > 1 and 1 < width <= _MAX_COLUMNS and len(set(names)) == width:
                result |= {head: value[:, column] for column, head in enumerate(names)}
                continue
        result[key] = value
    if len(result) > len(values):
        for key, value in list(result.items()):
            if isinstance(value, list) and value in lists:
                del result[key]
    return result
