"""Signals among named values: structs of one vector with a text for the name, perhaps one for the unit."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from mckibben.measurement.read.packed import packed_values
from mckibben.measurement.read.recognise import recognise
from mckibben.measurement.read.unit_lists import names_units
from mckibben.measurement.read.unit_words import reference_of, unit_of
from mckibben.measurement.read.vectors import as_column

_NAME = re.compile(r"(?i)(signal_?)?(name|label|title|bezeichnung|channel)")
_DIMENSION = "dim"  # what recorders of signals write for "unit"
_SETTINGS = 4  # most numbers of a setting beside a signal
_MOST_ENTRIES = 8  # of a signal that is named by its key


def signals_of(key: str, value: Any) -> dict[str, Any] | None:
    """Head -> vector of a signal or an array of signals; None = it is neither.

    A single one may be named by the key under which it stands: ``{"p": {"unit": "bar", "values": [...]}}``.
    """
    structs = value if isinstance(value, list) else [value]
    if not structs or not all(isinstance(struct, dict) for struct in structs):
        return None
    found: dict[str, Any] = {}
    for struct in structs:
        vectors = [v for v in struct.values() if is_vector(v)]
        if len(vectors) > 1:  # beside the readings a few settings, "plotStyle = [0 1]"
            vectors = [v for v in vectors if v.size > _SETTINGS] or vectors
        text = next(
            (v.strip() for k, v in struct.items() if isinstance(v, str) and _NAME.fullmatch(k) and v.strip()),
            "",
        )
        single = structs is not value and any(
            isinstance(v, str) and _is_unit_name(k) for k, v in struct.items()
        )
        text = text or (key if single and len(struct) <= _MOST_ENTRIES else "")
        if len(vectors) != 1 or not text:
            return None
        unit = next((v.strip() for k, v in struct.items() if isinstance(v, str) and _is_unit_name(k)), "")
        head = (
            f"{text} [{unit}]"
            if unit and unit_of(unit) is not None and recognise(text).unit is None
            else text
        )
        if reference_of(unit) is None and (unit_of(unit) is not None or recognise(head).unit is not None):
            marks = {
                word
                for k, v in struct.items()
                if isinstance(v, str) and k != "unit" and v.strip() != text
                for word in (v, *re.split(r"[\s,;/]+", v))
                if reference_of(word) is not None
            }
            head = f"{head} ({marks.pop()})" if len(marks) == 1 else head
        while head in found:
            head += "'"
        found[head] = packed_values(vectors[0], struct)
    return found


def is_vector(value: Any) -> bool:
    """Whether a value is an array of several numbers in one direction."""
    return (
        isinstance(value, np.ndarray)
        and value.dtype.kind in "biuf"
        and value.size > 1
        and as_column(value) is not None
    )


def _is_unit_name(key: str) -> bool:
    return key.lower() == _DIMENSION or names_units(key)


def texts_of_signals(value: Any, where: str) -> list[tuple[str, str]]:
    """The texts of a signal or an array of signals that are no name and no unit, with their place."""
    structs = value if isinstance(value, list) else [value]
    return [
        (text, where)
        for struct in structs
        for key, text in struct.items()
        if isinstance(text, str) and text.strip() and not _NAME.fullmatch(key) and not _is_unit_name(key)
    ]
