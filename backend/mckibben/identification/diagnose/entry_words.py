"""What a changed entry would explain, in words."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from mckibben.identification.diagnose.wrong_entry import WrongEntry

_ERROR = "the squared error above the noise"


def shown(value: float, unit: str) -> str:
    """A value of an entry with its unit, for sentences."""
    if unit == "rad":
        return f"{np.degrees(value):.1f}°"
    if unit == "Pa":
        return f"{1e-5 * value:.3g} bar"
    return f"{1e3 * value:.4g} mm" if unit == "m" else f"{value:.4g} {unit}"


def sentence_of(found: WrongEntry, titles: Mapping[str, str]) -> str:
    """What a changed entry would explain, without a full stop."""
    entry = found.entry
    if found.value is not None and entry.stated is not None:
        what = f"{entry.title[4:].capitalize()} {shown(found.value, entry.unit)} instead of "
        what += shown(entry.stated, entry.unit)
    else:
        assert entry.reading is not None  # noqa: S101 - an entry is one of the two
        what = f"{entry.title[4:].capitalize()} {entry.reading.words}"
    if entry.free is not None and entry.free.fixes:
        what += ", of usual rubber,"
    *first, last = [titles.get(name, name) for name in found.effects] or [""]
    also = f"{', '.join(first)} and {last}" if first else last
    share = 100.0 * found.explains
    if not also:
        return f"{what} explains {share:.0f} % of {_ERROR}"
    alone = f"; alone it explains {share:.0f} % of {_ERROR}" if share >= 1.0 else ""
    return f"{what} explains the error together with {also}{alone}"
