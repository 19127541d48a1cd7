"""Errors in sentences: three significant digits, those that are zero as well."""

from __future__ import annotations

import math


def brief(value: float) -> str:
    """A number with three significant digits, so that 1.90 stands in a sentence as it does in a table.

    >>> brief(1.9), brief(239.4), brief(1529.0)
    ('1.90', '239', '1530')
    """
    if not math.isfinite(value) or value == 0.0:
        return f"{value:g}"
    rounded = float(f"{value:.2e}")
    size = math.floor(math.log10(abs(rounded)))
    return f"{rounded:.{max(2 - size, 0)}f}" if size > -4 else f"{rounded:.2e}"
