"""Words of a column for the way of the muscle (``gonflage``, ``loading``, ``Druckabbau``) as directions."""

from __future__ import annotations

import re
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.measurement import STROKES
from mckibben.measurement.read.cells import Labels
from mckibben.measurement.read.vocabulary import HOLDS, MOVES, is_part, is_unparted, words_of

_UNKNOWN = {"", "-", "unknown", "none", "nan", "na", "n/a"}
_SURE = {"shortening": -1.0, "lengthening": 1.0}
#: Ways of the test; what they do to the muscle is told by the readings: +1, -1 of a pair.
_OF_TEST = {"pressure rises": 1.0, "pressure falls": -1.0, "one way": 1.0, "other way": -1.0}
#: The way there and the way back, as keys of `MOVES`.
PAIRS = (("shortening", "lengthening"), ("pressure rises", "pressure falls"), ("one way", "other way"))
_STEM = 6  # letters from which a word counts as the beginning of its other forms
_MOST = 40  # different words
_CLEAR = 0.2  # of the range of a channel, from which its change on the way shows a direction


def direction_of(
    labels: Labels, columns: Mapping[str, NDArray], messages: list[str]
) -> NDArray[np.float64] | None:
    """-1 shortening, +1 lengthening, 0 unknown; None when a word is not understood.

    "load" alone says too little (a weight lengthens, air shortens), nor does "rising": there the stroke, else
    the pressure, of neighbouring rows decides.
    """
    if len(labels.words) > _MOST:
        return None
    ways = [way for word in labels.words if (way := way_of_word(word)) is not None]
    if len(ways) < len(labels.words):
        return None
    sides = np.array([_OF_TEST.get(way, 0.0) for way in ways])
    sign = _sign_of_sides(sides[labels.codes], columns) if sides.any() else 0.0
    values: list[float] = [
        float(way) if re.fullmatch(r"-?[01]", way) else _SURE.get(way, float(side * sign))
        for way, side in zip(ways, sides, strict=True)
    ]
    meaning = {-1.0: "shortening", 1.0: "lengthening", 0.0: "unknown"}
    read = ", ".join(f"'{w}' as {meaning[v + 0.0]}" for w, v in zip(labels.words, values, strict=True))
    messages.append(f"direction read: {read}")
    return np.array(values)[labels.codes] + 0.0


def way_of_word(word: str) -> str | None:
    """The way that a word says: a key of `MOVES`, ``"0"``, ``"1"`` or ``"-1"``; None = not understood."""
    low = word.strip().lower()
    if low in _UNKNOWN:
        return "0"
    if re.fullmatch(r"[+-]?[01](\.0*)?", low):
        return str(int(float(low)))
    parts = words_of(word)
    found = {way for part in parts for way, known in MOVES.items() if _is_among(part, known)}
    for pair in PAIRS:
        if len(both := found & set(pair)) == 1:
            return both.pop()
        if both:
            return None
    return "0" if any(_is_among(part, HOLDS) for part in parts) else None


def _is_among(part: str, known: frozenset[str]) -> bool:
    return part in known or any(
        is_part(part, stem) for stem in known if is_unparted(stem) or len(stem) >= _STEM
    )


def _sign_of_sides(side: NDArray[np.float64], columns: Mapping[str, NDArray]) -> float:
    """Direction of the rows of the first side: the sign of the summed change of length along them.

    A channel that hardly changes along the rows (the length of an isometric test) shows nothing.
    """
    same = (side[1:] == side[:-1]) * side[1:]
    blocks = 1 + int(np.count_nonzero(side[1:] != side[:-1]))
    for channel in (*STROKES, "pressure"):
        if channel not in columns or not np.ptp(columns[channel]) > 0.0:
            continue
        change = float(np.sum(np.diff(columns[channel]) * same))
        if abs(change) > _CLEAR * blocks * float(np.ptp(columns[channel])):
            return float(np.sign(change)) * (1.0 if channel == "length" else -1.0)
    return 0.0
