"""Maps among named values: two vectors and a matrix over them, as columns of equal length."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import permutations
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.measurement import STROKES
from mckibben.measurement.read.recognise import recognise
from mckibben.measurement.read.vectors import as_column
from mckibben.physics.errors import InputError

Array = NDArray[np.float64]


def maps_apart(values: Mapping[str, Any], *, place: str, noun: str) -> tuple[dict[str, Any], list[str]]:
    """The values with matrices over two vectors as columns, and what was done.

    A map needs one vector per side of the matrix, each named like a channel. Its cells are listed pressure by
    pressure; those without a number stay, to be left out and counted. Matrices of the same shape share their
    rows.

    Raises:
        InputError: the matrix is square, and either vector could belong to its rows.
    """
    matrices = {key: value for key, value in values.items() if _is_matrix(value) and _channel(key)}
    vectors = {
        key: column
        for key, value in values.items()
        if _channel(key) and isinstance(column := as_column(value), np.ndarray) and len(column) > 1
    }
    if not matrices or {np.shape(value) for value in matrices.values()} != {
        np.shape(next(iter(matrices.values())))
    }:
        return dict(values), []
    shape = np.shape(next(iter(matrices.values())))
    taken = {_kind(key) for key in matrices}
    pairs = [
        (down, across)
        for down, across in permutations(vectors, 2)
        if (len(vectors[down]), len(vectors[across])) == shape
        and _kind(down) != _kind(across)
        and not {_kind(down), _kind(across)} & taken
    ]
    kinds = {(_kind(down), _kind(across)) for down, across in pairs}
    if not kinds:
        return dict(values), []
    first = next(iter(matrices))
    if len(kinds) > 1:
        raise InputError(
            f"{place}, {noun} '{first}': a map of {shape[0]} x {shape[1]} cells over "
            f"{' and '.join(repr(key) for key in pairs[0])}, either of which could be its rows",
            field=f"{noun} {first}",
            hint="save its cells as vectors of equal length, e.g. [X, Y] = ndgrid(x, y); X = X(:); Y = Y(:)",
        )
    down, across = pairs[0]
    by_pressure = _kind(across) == "pressure"  # listed pressure by pressure
    columns: dict[str, Array] = {}
    for key, vector in vectors.items():
        if len(vector) == shape[0] and _kind(key) == _kind(down):
            columns[key] = np.tile(vector, shape[1]) if by_pressure else np.repeat(vector, shape[1])
        elif len(vector) == shape[1] and _kind(key) == _kind(across):
            columns[key] = np.repeat(vector, shape[0]) if by_pressure else np.tile(vector, shape[0])
    for key, matrix in matrices.items():
        cells = np.asarray(matrix, dtype=np.float64)
        columns[key] = (cells.T if by_pressure else cells).reshape(-1)
    names = " and ".join(f"'{key}'" for key in matrices)
    message = (
        f"{noun} {names}: a map of {shape[0]} x {shape[1]} cells, a row for each value of '{down}' and a "
        f"column for each of '{across}'"
    )
    return {key: columns.get(key, value) for key, value in values.items()}, [message]


def _is_matrix(value: Any) -> bool:
    return (
        isinstance(value, np.ndarray)
        and value.ndim == 2
        and min(value.shape) > 1
        and value.dtype.kind in "iuf"
    )


def _channel(key: str) -> str | None:
    """The channel of a name, also of a letter without its unit: ``F``, ``p``."""
    return recognise(key).channel or _LETTERS.get(key)


def _kind(key: str) -> str | None:
    channel = _channel(key)
    return "stroke" if channel in STROKES else channel


_LETTERS = {
    "p": "pressure",
    "P": "pressure",
    "F": "force",
    "L": "length",
    "x": "displacement",
    "kappa": "contraction",
}
