"""Results as JSON text: dataclasses by the names of their fields, documents, numpy arrays, enums.

A dataclass may declare ``JSON_KEYS``, field -> key, for a key that cannot be the name of a field ("from").
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from functools import cache
from typing import cast

import numpy as np
import orjson

from mckibben.documents.json_document import HasDocument

_OPTIONS = orjson.OPT_SERIALIZE_NUMPY | orjson.OPT_PASSTHROUGH_DATACLASS
_AT_ONCE = 500_000  # numbers of an array; one call for more would hold the interpreter for too long


@cache
def _keys(kind: type) -> tuple[tuple[str, str], ...]:
    """Key and field of each entry of a dataclass."""
    renamed: Mapping[str, str] = getattr(kind, "JSON_KEYS", {})
    names = [field.name for field in fields(kind)]  # type: ignore
    return tuple((renamed.get(name, name), name) for name in names)


@cache
def _has_document(kind: type) -> bool:
    """Whether values of this type convert themselves; asking the protocol each time takes 10 us."""
    return issubclass(kind, HasDocument)


def _plain(value: object) -> object:
    """Conversion of values that orjson does not support."""
    if _has_document(type(value)):
        return cast(HasDocument, value).to_document()
    if is_dataclass(value):
        return {key: _in_pieces(getattr(value, name)) for key, name in _keys(type(value))}
    if isinstance(value, np.ndarray):  # not contiguous
        return value.tolist()
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, Mapping):
        return dict(value)
    raise TypeError(f"{type(value).__name__} has no JSON form")


def _in_pieces(value: object) -> object:
    """A long array, or a mapping with long arrays, as text written in pieces; other values unchanged."""
    if isinstance(value, dict):
        return {key: _in_pieces(item) for key, item in value.items()} if _long_inside(value) else value
    if not _is_long(value):
        return value
    array = np.ascontiguousarray(value)
    pieces = (array[begin : begin + _AT_ONCE] for begin in range(0, len(array), _AT_ONCE))
    return orjson.Fragment(b"[" + b",".join(to_json(piece)[1:-1] for piece in pieces) + b"]")


def _is_long(value: object) -> bool:
    return isinstance(value, np.ndarray) and value.size > _AT_ONCE


def _long_inside(values: Mapping[object, object]) -> bool:
    return any(map(_is_long, values.values()))


#: Of answers that leave the program by themselves; a higher one when a key loses its meaning.
ANSWER_SCHEMA = 1


def answer_json(answer: object) -> bytes:
    """JSON text of a result that stands by itself: an object that begins with its ``schema``."""
    text = to_json(answer)
    return b'{"schema":%d%s%s' % (ANSWER_SCHEMA, b"" if text == b"{}" else b",", text[1:])


def to_json(content: object) -> bytes:
    """JSON text of a result or of plain values; NaN and infinity become null."""
    return orjson.dumps(content, option=_OPTIONS, default=_plain)
