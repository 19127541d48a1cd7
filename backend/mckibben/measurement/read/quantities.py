"""Numbers of a document with their units: ``{"value": 280, "unit": "mm"}``, ``{"L0": 2, "L0_unit": "m"}``."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from mckibben.measurement.read.unit_words import unit_of

_DEEPEST = 40


def with_quantities(value: Any, depth: int) -> Any:
    """Objects of a number and its unit as one text: ``{"value": 280, "unit": "mm"}`` is "280 mm"."""
    if not isinstance(value, dict) or depth > _DEEPEST:
        return value
    value = _with_units_beside(value)
    numbers = [v for v in value.values() if isinstance(v, (int, float)) and not isinstance(v, bool)]
    units = [v for k, v in value.items() if isinstance(v, str) and (len(value) == 2 or "unit" in k.lower())]
    if (
        len(numbers) == len(units) == 1
        and unit_of(units[0]) is not None
        and all(isinstance(v, (str, int, float)) for v in value.values())
    ):
        return f"{numbers[0]:.10g} {units[0]}"
    return {key: with_quantities(item, depth + 1) for key, item in value.items()}


def _with_units_beside(value: Mapping[str, Any]) -> dict[str, Any]:
    """Numbers with the unit under a key of its own: ``{"L": 250, "LUnit": "mm"}`` is ``{"L": "250 mm"}``."""
    result = dict(value)
    for key, number in value.items():
        if isinstance(number, bool) or not isinstance(number, (int, float)):
            continue
        for suffix in ("Unit", "_unit", "Units", "_units", "-unit", " unit", "unit"):
            unit = value.get(f"{key}{suffix}")
            if isinstance(unit, str) and unit_of(unit) is not None:
                result[key] = f"{number:.10g} {unit}"
                del result[f"{key}{suffix}"]
                break
    return result
