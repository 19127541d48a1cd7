"""Measurements from JSON and JSON lines: records of readings, vectors by name, signals, structs."""

from __future__ import annotations

import json
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from itertools import islice
from typing import Any

import numpy as np

from mckibben.measurement.read.cells import Cell
from mckibben.measurement.read.conditions import Note
from mckibben.measurement.read.correction import Correction
from mckibben.measurement.read.described_rows import with_described_rows
from mckibben.measurement.read.limits import MAX_COLUMNS, check_columns, check_rows
from mckibben.measurement.read.many_records import plain_columns
from mckibben.measurement.read.mat import choose as choose_vectors
from mckibben.measurement.read.quantities import with_quantities
from mckibben.measurement.read.recognise import recognise
from mckibben.measurement.read.reshape import regular
from mckibben.measurement.read.reshape.rows import RowsGrid
from mckibben.measurement.read.source import RawTable
from mckibben.measurement.read.stated import in_known_words, statements
from mckibben.measurement.read.table_source import source_of
from mckibben.measurement.read.tables import choose, tables_of_grid
from mckibben.measurement.read.unit_lists import names_units
from mckibben.measurement.read.unit_words import unit_of
from mckibben.physics.errors import InputError

MAX_VALUES = 4_000_000  # numbers, texts and names; each takes some 60 bytes and more
_MAX_BRACKETS = 1_000_000  # lists and objects
_DEEPEST = 40
_FEWEST = 3  # records that make a table
_MAX_RECORDS_OF_NOTES = 200

Record = Mapping[str, Any]


def is_json(text: str) -> bool:
    """Whether a text begins as a JSON object or list, or as lines of them."""
    begin = text[:200].lstrip("\ufeff \t\r\n")
    return begin[:1] == "{" or (begin[:1] == "[" and begin[1:].lstrip()[:1] in ("{", "[", '"', ""))


def open_json(text: str, name: str, correction: Correction | None = None) -> RawTable | None:
    """The table of a JSON text, or of lines of JSON; None = the text is no JSON.

    Raises:
        InputError: more values than are read, or nothing that is a table.
    """
    correction = correction or Correction()
    if text.count(",") + text.count(":") > MAX_VALUES or text.count("[") + text.count("{") > _MAX_BRACKETS:
        raise InputError(
            f"{name}: the JSON text has too many values to be read (more than {MAX_VALUES}, or more than "
            f"{_MAX_BRACKETS} lists and objects)",
            field="file", hint="save it as CSV, or keep every second reading",
        )  # fmt: skip
    try:
        lines, document = _parsed(text)
    except RecursionError as error:
        raise InputError(
            f"{name}: the JSON text is nested too deeply", field="file", hint="one object per reading"
        ) from error
    except (ValueError, TypeError):
        return None
    return open_document(document, name, correction, lines=lines)


def open_document(
    document: Any, name: str, correction: Correction | None = None, *,
    lines: list[tuple[int, Record]] | None = None,
) -> RawTable:  # fmt: skip
    """The table of a document of objects, lists, numbers and texts, whatever it was written in.

    ``lines``: objects of the lines of a text, instead of the document.

    Raises:
        InputError: nothing that is a table.
    """
    correction = correction or Correction()
    document = with_described_rows(document)
    found = list(islice(_records(document, 0), 2)) if lines is None else []
    records = lines if lines is not None else next(iter(found), None)
    if records is not None and not _are_of_tests(document, found):
        return _of_records(records, document, name, correction)
    values = _values(document, 0)
    if not isinstance(values, dict):
        values = {"data": values}
    try:
        return replace(choose_vectors(values, name, correction), format="json")
    except InputError as error:
        hint = 'records such as {"pressure_bar": 1.0, "length_mm": 300.0}, or a list of numbers for each name'
        raise (
            error
            if error.hint and "e.g." not in error.hint
            else InputError(error.message, field=error.field, hint=hint)
        ) from error


def _parsed(text: str) -> tuple[list[tuple[int, Record]] | None, Any]:
    """(number and object of each line, None) of JSON lines, or (None, the document); raises ValueError."""
    try:
        return None, json.loads(text)
    except json.JSONDecodeError:
        pass
    filled = [
        (n, bare) for n, line in enumerate(text.split("\n"), start=1) if (bare := line.strip().rstrip(","))
    ]
    if len(filled) < 2:
        raise ValueError("no lines of JSON")
    json.loads(filled[0][1])
    try:  # all at once is four times as fast
        values = json.loads(f"[{','.join(bare for _, bare in filled)}]")
    except json.JSONDecodeError:
        values = []
    if len(values) != len(filled):
        values = [json.loads(bare) for _, bare in filled]
    if not all(isinstance(value, dict) for value in values):
        raise TypeError("a line of JSON that is no object")
    return [(number, value) for (number, _), value in zip(filled, values, strict=True)], None


def _records(value: Any, depth: int) -> Iterator[list[tuple[int, Record]]]:
    """Lists of objects that hold single numbers, the outermost first; or of lists below a list of names."""
    if depth > _DEEPEST:
        return
    objects = isinstance(value, list) and len(value) >= _FEWEST and all(isinstance(v, dict) for v in value)
    if objects and _holds_numbers(value[:20]):
        yield list(enumerate(value, start=1))
        return
    if isinstance(value, dict):
        names = next((v for k, v in value.items() if _is_names(v)), None)
        for item in value.values():
            rows = item if isinstance(item, list) else []
            if (
                names
                and len(rows) >= _FEWEST
                and all(isinstance(r, list) and len(r) == len(names) for r in rows)
            ):
                yield [(n, dict(zip(names, row, strict=True))) for n, row in enumerate(rows, start=1)]
                return
        for item in value.values():
            yield from _records(item, depth + 1)
    elif isinstance(value, list):
        head: list[str] = value[0] if value and _is_names(value[0]) else []
        if head and len(value) > _FEWEST and all(isinstance(r, list) and len(r) == len(head) for r in value):
            yield [(n, dict(zip(head, row, strict=True))) for n, row in enumerate(value[1:], start=2)]
            return
        for item in value[:1000]:
            yield from _records(item, depth + 1)


def _are_of_tests(document: Any, found: Sequence[list[tuple[int, Record]]]) -> bool:
    """Whether readings stand within the entries of a list, or in several objects, with conditions each."""
    if len(found) > 1:
        return set(found[0][0][1]) == set(found[1][0][1])
    return bool(found) and next(_records(_without_lists_of_objects(document), 0), None) is None


def _without_lists_of_objects(value: Any, depth: int = 0) -> Any:
    """A document without what stands further in than an entry of a list of objects."""
    if depth > _DEEPEST:
        return None
    if isinstance(value, dict):
        return {key: _without_lists_of_objects(item, depth + 1) for key, item in value.items()}
    if isinstance(value, list) and value and all(isinstance(item, dict) for item in value):
        within = any(isinstance(inner, list) for item in value[:20] for inner in _flat(item).values())
        return None if within else value
    return value


def _is_names(value: Any) -> bool:
    return (
        isinstance(value, list) and 2 <= len(value) <= MAX_COLUMNS and all(isinstance(v, str) for v in value)
    )


def _holds_numbers(records: Sequence[Record]) -> bool:
    """Whether most records hold two numbers, or one beside texts, and no lists."""
    good = 0
    for record in records:
        flat = _flat(record)
        numbers = sum(isinstance(v, (int, float)) and not isinstance(v, bool) for v in flat.values())
        texts = sum(isinstance(v, str) for v in flat.values())
        good += numbers >= 2 or (numbers == 1 and texts >= 1)
        if any(isinstance(v, list) for v in flat.values()):
            return False
    return 2 * good > len(records)


def _flat(record: Record, prefix: str = "", depth: int = 0) -> dict[str, Any]:
    """An object with those in it laid open: ``{"d": {"p": 1}}`` is ``{"d.p": 1}``."""
    if not depth and dict not in map(type, record.values()):
        return dict(record)
    result: dict[str, Any] = {}
    for key, value in record.items():
        if isinstance(value, dict) and depth < _DEEPEST and value:
            result |= _flat(value, f"{prefix}{key}.", depth + 1)
        else:
            result[f"{prefix}{key}"] = value
    return result


def _of_records(
    records: list[tuple[int, Record]], document: Any, name: str, correction: Correction
) -> RawTable:
    """The table of records; others, and what stands beside the list, say what the test was."""
    check_rows(len(records), name)
    flat = [(number, _flat(record)) for number, record in records]
    kinds = Counter(tuple(record) for _, record in flat)
    common = set(max(kinds, key=lambda keys: kinds[keys] * len(keys)))
    good = {keys for keys in kinds if 2 * len(common & set(keys)) > len(common)}
    readings = [(n, record) for n, record in flat if tuple(record) in good]
    whole = dict(records)
    others = [(n, _flat(with_quantities(whole[n], 0))) for n, record in flat if tuple(record) not in good]
    heads = list(dict.fromkeys(key for keys in kinds if keys in good for key in keys))
    check_columns(len(heads), name, "columns")
    noun = "line" if document is None else "record"
    beside = [
        (f"{noun} {n}", key, value)
        for n, record in others[:_MAX_RECORDS_OF_NOTES]
        for key, value in record.items()
    ]
    beside += [("", key, value) for key, value in _beside(document)]
    units = {
        key.rpartition(".")[2]: str(value)
        for _, key, value in beside
        if "unit" in key.lower() and isinstance(value, str)
    }
    said = [f"{len(others)} {noun}s without readings are not read"] if others else []
    notes, texts = _notes_and_texts(beside, name)
    columns = plain_columns(heads, [record for _, record in readings])
    if columns is not None:
        return columns.source([_head(head, units) for head in heads], name, notes, said, texts)
    rows: list[list[Cell]] = [[_head(head, units) for head in heads]]
    rows += [[_cell(record.get(head)) for head in heads] for _, record in readings]
    numbers = [0, *(n for n, _ in readings)]
    grid = RowsGrid(_Lines(name, noun), rows, numbers, units={})
    reshaped = regular(grid)
    tables = tables_of_grid(reshaped.grid, head=None)
    if not tables:
        raise InputError(
            f"{name}: no numbers are found in the records of the JSON text (names: {', '.join(heads)[:100]})",
            field="file", hint='records such as {"pressure_bar": 1.0, "length_mm": 300.0}',
        )  # fmt: skip
    chosen = choose(tables, sheet=correction.sheet)
    table = chosen.table
    table.rest += texts
    table.unread = [*table.unread, *chosen.unread, *reshaped.unread]
    return source_of(
        table, format="json", notes=notes, messages=[*said, *reshaped.messages, *chosen.messages],
        shown=((i + 1, row) for i, row in enumerate(rows[:60])), rewritten=True,
    )  # fmt: skip


def _notes_and_texts(
    beside: Sequence[tuple[str, str, Any]], name: str
) -> tuple[list[Note], list[tuple[str, str]]]:
    """(conditions, texts with their places) of the values that stand beside the records."""
    notes: list[Note] = []
    texts: list[tuple[str, str]] = []
    for where, key, value in beside:
        if isinstance(value, (str, int, float)) and not isinstance(value, bool):
            place = where or f"'{key}'"
            notes.append(Note(f"{name}, {place}", key.rpartition(".")[2], value))
            texts += [(f"{key}: {value}", place)] if isinstance(value, str) else []
    found = [note for note in in_known_words(notes) if isinstance(note.value, str) or note.key in _KNOWN]
    known = {note.key for note in found}
    return [*found, *(note for note in statements(texts, name) if note.key not in known)], texts


_KNOWN = ("nominal_length", "load_mass", "load_force", "supply_pressure", "ambient_pressure", "inclination")


def _beside(document: Any) -> Iterator[tuple[str, Any]]:
    """Single values and texts of a document outside of its records; quantities as one text."""
    if isinstance(document, dict):
        for key, value in _flat(with_quantities(document, 0)).items():
            if not isinstance(value, (list, dict)):
                yield key, value


class _Lines:
    """Where the records of a JSON text stand."""

    title = ""

    def __init__(self, place: str, noun: str) -> None:
        self.place, self._noun = place, noun

    def __len__(self) -> int:
        return 0

    def cells(self, index: int) -> Sequence[Cell]:
        """Of a text that has no cells."""
        return ()

    def line(self, index: int) -> int:
        """Number of the line or record."""
        return index

    def where(self, index: int, column: int | None = None) -> str:
        """Line or record, for people."""
        return f"{self._noun} {index}" if index else "the names"


def _head(head: str, units: Mapping[str, str]) -> str:
    """A name with the unit that another object gives: ``s`` and "mm shortening" -> ``s shortening [mm]``."""
    said = units.get(head.rpartition(".")[2])
    if said is None or recognise(head).unit is not None:
        return head
    if unit_of(said) is not None:
        return f"{head} [{said}]"
    first, _, words = said.partition(" ")
    return f"{head} {words} [{first}]" if unit_of(first) is not None else head


def _cell(value: Any) -> Cell:
    if value is None or isinstance(value, (str, int, float)):
        return int(value) if isinstance(value, bool) else value
    return str(value)[:80]


def _columns_of_records(records: Sequence[Record]) -> dict[str, Any]:
    """Records of readings as vectors: NaN where one lacks a number, words as texts."""
    flat = [_flat(record) for record in records]
    columns: dict[str, Any] = {}
    for head in dict.fromkeys(key for record in flat for key in record):
        cells = [record.get(head) for record in flat]
        if any(isinstance(cell, str) for cell in cells):
            columns[head] = ["" if cell is None else str(cell) for cell in cells]
        else:
            numbers = [float(c) if isinstance(c, (int, float)) else np.nan for c in cells]
            columns[head] = np.array(numbers)
    return columns


def _values(value: Any, depth: int) -> Any:
    """A document as the readers of containers take it: lists of numbers as arrays, with NaN for null."""
    if depth > _DEEPEST:
        return None
    if isinstance(value, dict):
        whole = with_quantities(value, _DEEPEST)
        if not isinstance(whole, dict):
            return whole
        found: dict[str, Any] = {}
        for key, item in value.items():
            text = with_quantities(item, 0)
            if isinstance(item, dict) and isinstance(text, str):
                number, _, unit = text.partition(" ")
                found[f"{key} [{unit}]"] = float(number)
            else:
                found[str(key)] = _values(item, depth + 1)
        # Single values of an object without vectors belong to the one around it.
        loose: dict[str, Any] = {}
        for key, item in list(found.items()):
            if (
                isinstance(item, dict)
                and item
                and not names_units(key)
                and not any(isinstance(v, (dict, list, np.ndarray)) for v in item.values())
            ):
                loose |= {k: v for k, v in item.items() if k not in found}
                del found[key]
        return {key: item for key, item in {**loose, **found}.items() if item is not None}
    if isinstance(value, list):
        if value and all(
            v is None or (isinstance(v, (int, float)) and not isinstance(v, bool)) for v in value
        ):
            return np.array([np.nan if v is None else float(v) for v in value])
        if (
            len(value) >= _FEWEST
            and all(isinstance(v, dict) for v in value)
            and _holds_numbers(value[:20])
            and depth > 0
        ):
            return _columns_of_records(value)
        if value and all(isinstance(v, list) and len(v) == len(value[0]) for v in value):
            inner = [_values(v, depth + 1) for v in value]
            return np.array(inner) if all(isinstance(v, np.ndarray) and v.ndim == 1 for v in inner) else None
        return [_values(item, depth + 1) for item in value]
    return float(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else value
