"""Named values of a container file (.mat, .tdms) sorted into columns, conditions and the rest."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.read.conditions import Note
from mckibben.measurement.read.header import map_headers
from mckibben.measurement.read.limits import check_columns
from mckibben.measurement.read.source import HeaderColumn
from mckibben.physics.errors import InputError

Named = Mapping[str, Any]  # name -> array of numbers, list of words, text, or a mapping of these


def as_column(value: Any) -> HeaderColumn | None:
    """A vector as floats, or as words; None = something else (a matrix, a struct, complex numbers)."""
    if isinstance(value, list):
        return value if value and all(isinstance(word, str) for word in value) else None
    if not isinstance(value, np.ndarray) or value.ndim == 0:
        return None
    flat = value.reshape(-1) if max(value.shape, default=0) == value.size else None
    if flat is None:
        return None
    if flat.dtype.kind in "US":
        return [str(word) for word in flat]
    if flat.dtype.kind in "biuf":
        with np.errstate(over="ignore"):
            return flat.astype(np.float64, copy=False)
    return None


def scalar_note(name: str, value: Any, where: str) -> Note | None:
    """A single number or a text as a condition; None = neither."""
    if isinstance(value, str):
        return Note(where, name, value.strip()[:200]) if value.strip() else None
    if isinstance(value, np.ndarray) and value.size == 1 and value.dtype.kind in "biufUS":
        value = value.reshape(-1)[0]
    if isinstance(value, (bool, int, float, np.bool_, np.integer, np.floating)):
        return Note(where, name, float(value))
    return Note(where, name, str(value)) if isinstance(value, np.str_) else None


def sorted_out(
    values: Named, *, place: str, noun: str
) -> tuple[dict[str, HeaderColumn], list[Note], list[str]]:
    """(columns, conditions, messages) of named values.

    The columns are the vectors of the length that most known channels have; a vector of another length is
    refused when it is named like a channel, and said otherwise.
    """
    columns: dict[str, HeaderColumn] = {}
    notes: list[Note] = []
    messages: list[str] = []
    for name, value in values.items():
        column = as_column(value)
        if column is not None and len(column) > 1:
            columns[name] = column
            check_columns(len(columns), place, f"{noun} {name}")
        elif (note := scalar_note(name, value, f"{place}, {noun} '{name}'")) is not None:
            notes.append(note)
        else:
            messages.append(f"{noun} '{name}' is not used: it is not a vector of numbers")
    if not columns:
        return {}, notes, messages
    meaning = map_headers(list(columns), place=place, noun=noun, collect=True)
    known = {column.header for column in meaning.columns}
    lengths = [len(columns[name]) for name in (known or columns)]
    rows = max(set(lengths), key=lambda length: (lengths.count(length), length))
    for name in [name for name in columns if len(columns[name]) != rows]:
        if name in known:
            raise InputError(
                f"{place}, {noun} '{name}': {len(columns[name])} rows, the others have {rows}",
                field=f"{noun} {name}",
                hint=f"{noun}s of one measurement are equally long",
            )
        messages.append(f"{noun} '{name}' is not used: {len(columns[name])} rows, the others have {rows}")
        del columns[name]
    return columns, notes, messages


def known_columns(columns: Mapping[str, HeaderColumn], *, place: str, noun: str) -> int:
    """How many of the columns are named like a channel."""
    return len(map_headers(list(columns), place=place, noun=noun, collect=True).columns) if columns else 0


def time_axis(start: float, step: float, rows: int) -> NDArray[np.float64]:
    """Evenly spaced times [s]."""
    return start + step * np.arange(rows, dtype=np.float64)
