"""Results as JSON text: dataclasses by the names of their fields, numpy arrays, enums.

A dataclass may declare ``JSON_KEYS``, field -> keys, for a key that cannot be the name of a field ("from"),
or for an older name of a field that is kept for one version.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from functools import cache

import numpy as np
import orjson

_OPTIONS = orjson.OPT_SERIALIZE_NUMPY | orjson.OPT_PASSTHROUGH_DATACLASS


@cache
def _keys(kind: type) -> tuple[tuple[str, str], ...]:
    """Key and field of each entry of a dataclass."""
    renamed: Mapping[str, tuple[str, ...]] = getattr(kind, "JSON_KEYS", {})
    names = [field.name for field in fields(kind)]
    return tuple((key, name) for name in names for key in renamed.get(name, (name,)))


def _plain(value: object) -> object:
    """Conversion of values that orjson does not support."""
    if is_dataclass(value):
        return {key: getattr(value, name) for key, name in _keys(type(value))}
    if isinstance(value, np.ndarray):  # not contiguous
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, Mapping):
        return dict(value)
    raise TypeError(f"{type(value).__name__} has no JSON form")


def to_json(content: object) -> bytes:
    """JSON text of a result or of plain values; NaN and infinity become null."""
    return orjson.dumps(content, option=_OPTIONS, default=_plain)
