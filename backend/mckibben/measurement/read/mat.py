"""Measurements from MATLAB files v5 to v7: vectors by variable name, or one struct of vectors.

``pressure_bar = [...]`` is a column like that of a CSV; scalar and text variables are conditions. Nothing of
the file is ever executed; objects are not read.
"""

from __future__ import annotations

from typing import Any

from mckibben.measurement.read.mat5 import DamagedError, Foreign, read_variables
from mckibben.measurement.read.source import RawTable, array_source
from mckibben.measurement.read.vectors import known_columns, sorted_out
from mckibben.physics.errors import InputError

_NOUN = "variable"
TABLE_HINT = "save a table with: s = table2struct(T, 'ToScalar', true); save('test.mat', '-struct', 's')"


def open_mat(data: bytes, name: str) -> RawTable:
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
    return choose(values, name)


def choose(values: dict[str, Any], name: str) -> RawTable:
    """The source of a file's variables, or of the struct among them that holds most channels.

    Raises:
        InputError: vectors of different lengths, nothing that is a vector.
    """
    foreign = {key: value.kind for key, value in values.items() if isinstance(value, Foreign)}
    flat = {key: value for key, value in values.items() if not isinstance(value, (dict, Foreign))}
    candidates = [(name, flat)]
    for key, value in values.items():
        if isinstance(value, dict):
            candidates.append((f"{name}, struct '{key}'", value))
            inner = [(f"{name}, struct '{key}.{k}'", v) for k, v in value.items() if isinstance(v, dict)]
            candidates += inner
    best, most = None, -1
    problem: InputError | None = None
    for place, named in candidates:
        fields = {key: value for key, value in named.items() if not isinstance(value, (dict, Foreign))}
        try:
            columns, notes, messages = sorted_out(fields, place=place, noun=_NOUN)
        except InputError as error:
            problem = problem or error
            continue
        known = known_columns(columns, place=place, noun=_NOUN)
        if columns and known > most:
            best, most = (place, columns, notes, messages), known
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
    place, columns, notes, messages = best
    messages += [f"{_NOUN} '{key}' is not used: it is a {kind}" for key, kind in foreign.items()]
    if place != name:  # scalars beside a struct are conditions too
        notes = sorted_out(flat, place=name, noun=_NOUN)[1] + notes
    return array_source(columns, place=place, format="mat", noun=_NOUN, notes=notes, messages=messages)
