"""Packed numbers: the value is a factor times the number plus an offset, both of which stand beside it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

#: Pairs of names (factor, offset); the first is that of the netCDF conventions, whose numbers are any.
_NAMES = (
    (("scale_factor",), ("add_offset",)),
    (
        ("scale", "gain", "slope", "factor", "scaling", "multiplier", "resolution", "lsb"),
        ("offset", "intercept", "bias"),
    ),
)  # fmt: skip


def packed_values(values: NDArray[Any], beside: Mapping[str, Any]) -> NDArray[Any]:
    """The values that are meant; those that are kept as they are come back unchanged.

    ``scale_factor`` and ``add_offset`` always count; a ``scale`` or ``gain`` with its ``offset`` only beside
    whole numbers, as what a logger keeps of its converter.
    """
    plain = {key.lower(): number for key, item in beside.items() if (number := _number(item)) is not None}
    if values.dtype.kind not in "iuf" or not values.size:
        return values
    whole = values.dtype.kind in "iu" or bool(np.all(np.floor(values) == values))
    for sure, (factors, offsets) in zip((True, False), _NAMES, strict=True):
        factor = next((plain[name] for name in factors if name in plain), None)
        offset = next((plain[name] for name in offsets if name in plain), None)
        if (factor is None and (offset is None or not sure)) or not (sure or whole):
            continue
        if factor in (None, 1.0) and offset in (None, 0.0):
            continue
        return values.astype(np.float64) * (1.0 if factor is None else factor) + (offset or 0.0)
    return values


def _number(item: Any) -> float | None:
    if isinstance(item, bool) or item is None:
        return None
    if isinstance(item, (int, float)):
        return float(item)
    if isinstance(item, np.ndarray) and item.size == 1 and item.dtype.kind in "iuf":
        return float(item.reshape(()))
    return None
