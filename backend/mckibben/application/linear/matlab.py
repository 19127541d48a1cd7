"""Linear models as a MATLAB file (``.mat``, version 5)."""

from __future__ import annotations

import io
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np

from mckibben.application.linear.result import ModelResult, PointResult

_HEAD = 116  # bytes of text at the begin of a file
_WRITER = b"MATLAB 5.0 MAT-file, written by mckibben"


def matrices_of(model: ModelResult) -> dict[str, Any]:
    """A, B, C and D of a model with names, dead time [s] and the values at its operating point, SI."""
    return {
        "A": model.a,
        "B": model.b,
        "C": model.c,
        "D": model.d,
        **{kind: _cells(port.name for port in getattr(model, kind)) for kind in _KINDS},
        "dead_time": model.dead_time,
        **{f"{kind[:-1]}_0": np.array([port.value for port in getattr(model, kind)]) for kind in _KINDS},
        "state_units": _cells(port.unit for port in model.states),
        "input_units": _cells(port.unit for port in model.inputs),
        "output_units": _cells(port.unit for port in model.outputs),
    }


_KINDS = ("states", "inputs", "outputs")


def point_fields(point: PointResult, models: Iterable[ModelResult], lost: Iterable[str]) -> dict[str, Any]:
    """An operating point with all its models and what they do not contain."""
    return {
        "position": point.position,
        "contraction": point.contraction,
        "pressure": point.pressure,
        "command": point.command,
        "force": point.force,
        "models": structures(
            {"name": each.name, "text": each.text, "primary": each.primary, **matrices_of(each)}
            for each in models
        ),
        "lost": _cells(lost),
    }


def structures(rows: Iterable[Mapping[str, Any]]) -> np.ndarray:
    """An array of structures with the same fields."""
    listed = [dict(row) for row in rows]
    found = np.empty(len(listed), dtype=[(name, object) for name in listed[0]])
    for place, row in enumerate(listed):
        found[place] = tuple(row.values())
    return found


def _cells(texts: Iterable[str]) -> np.ndarray:
    return np.array(list(texts), dtype=object)


def mat_file(variables: Mapping[str, Any]) -> bytes:
    """The file; the same variables give the same bytes."""
    from scipy.io import savemat

    content = io.BytesIO()
    savemat(content, dict(variables), oned_as="column", long_field_names=True)
    # scipy writes the date there.
    return _WRITER.ljust(_HEAD) + content.getvalue()[_HEAD:]
