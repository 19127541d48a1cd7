"""Absolute pressures in the texts of a drive document, relative to the ambient pressure it states."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from mckibben.physics.errors import InputError
from mckibben.physics.units import absolute_text, si

#: Gauge pressures of a drive document, by their path.
_GAUGE = (("supply", "pressure"), ("regulator", "range"), ("start_pressure",))


def with_gauge_pressures(document: Mapping[str, Any]) -> Mapping[str, Any]:
    """The document with its absolute pressures as gauge ones [Pa]; unchanged without an ambient pressure.

    What cannot be converted stays as it is, for the error at its field.
    """
    gas = document.get("gas")
    if not isinstance(gas, Mapping) or "ambient_pressure" not in gas:
        return document
    try:
        ambient = si(gas["ambient_pressure"], "Pa", reference="absolute")
    except InputError:
        return document
    changed = dict(document)
    for section, *rest in _GAUGE:
        holder: Any = document.get(section) if rest else document
        name = rest[0] if rest else section
        value = holder.get(name) if isinstance(holder, Mapping) else None
        if not absolute_text(value):
            continue
        try:
            gauge = si(value, "Pa", reference="gauge", ambient=ambient)
        except InputError:
            continue
        if rest:
            changed[section] = {**holder, name: gauge}
        else:
            changed[name] = gauge
    return changed
