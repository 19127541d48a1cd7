"""Results as JSON text: dataclasses, numpy arrays and enums, by the names of their fields."""

from __future__ import annotations

import numpy as np
import orjson

_OPTIONS = orjson.OPT_SERIALIZE_NUMPY


def _unusual(value: object) -> object:
    """What orjson does not take by itself: arrays that are not contiguous, numpy scalars."""
    if isinstance(value, np.ndarray):
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    raise TypeError(f"{type(value).__name__} has no JSON form")


def to_json(content: object) -> bytes:
    """JSON text of a result or of plain values; NaN and infinity become null."""
    return orjson.dumps(content, option=_OPTIONS, default=_unusual)
