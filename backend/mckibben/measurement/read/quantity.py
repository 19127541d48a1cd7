"""A number and its unit in one cell: ``12,3 mm``, ``1.086 kN``, ``0.05 sec``."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import NamedTuple

from mckibben.measurement.read.unit_words import COUNT, dimension_of, unit_of

_CELL = re.compile(
    r"([+-]?[0-9][0-9.,'’]*(?:[eE][+-]?[0-9]+)?)\s*([^\s0-9.,;:()\[\]+-][^\s;:]{0,11}(?:\s?\([a-z]{1,4}\))?)"
)


class QuantityText(NamedTuple):
    """The number as it is written, and its unit."""

    number: str
    unit: str
    absolute: bool | None


@lru_cache(maxsize=65536)
def quantity_of(text: str) -> QuantityText | None:
    """The quantity that a text is; None = it is none, or its unit is not known.

    >>> quantity_of("3,00 bar")
    QuantityText(number='3,00', unit='bar', absolute=None)
    """
    found = _CELL.fullmatch(text.strip()) if len(text) < 40 else None
    unit = unit_of(found[2]) if found else None
    if found is None or unit is None or unit.unit == COUNT or not dimension_of(unit.unit):
        return None
    return QuantityText(found[1], unit.unit, unit.absolute)
