"""Which column a sentence is about: "K2 carries the yoke as well: do not use", "ai1: load cell, 250 N/V".

A column is called by the last part of a path ("Dev1/ai1"), by a short first word with a number ("K2 U10M"),
by the channel that it is ("Analog 1"), or, before a colon, by the letter of that ("A"); by what only one is.
"""

from __future__ import annotations

import re
from collections import Counter
from functools import lru_cache
from typing import NamedTuple

from mckibben.measurement.reading.heads import taken_apart
from mckibben.measurement.reading.model import Table

_PATH = re.compile(r"[/\\.:]")
_SHORT = re.compile(r"[^\W\d_]{1,4}\d{1,3}")
_LETTERED = re.compile(r"(?i)(?:ch|chan|channel|kanal|canal|voie|input|analog|sensor)[ _-]?([a-h]|\d{1,2})")
_SENTENCE_BEGINS = re.compile(r"(?:^|[.;|]\s|\s[-–]\s)[\s#%/*>-]{0,6}$")
_LONGEST_NAME, _MOST_COLUMNS = 40, 64


class Piece(NamedTuple):
    """A part of a text, and the column that it is about; None = it names none."""

    column: int | None
    text: str


def pieces_of(text: str, table: Table) -> list[Piece]:
    """A text cut where sentences begin with the name of another column.

    A text that names one column somewhere, and no other, is about it as a whole.
    """
    names = _names(tuple((c.head.strip(), c.unit) for c in table.columns[:_MOST_COLUMNS]))
    if not names:
        return [Piece(None, text)]
    pattern = _pattern(tuple(names))
    found = [(m, names[_key(m["name"])]) for m in pattern.finditer(text) if _is_called(m, names)]
    begins = [
        (m, i)
        for m, i in found
        if _SENTENCE_BEGINS.search(text[: m.start()])
        or (m["colon"] and text[: m.start()].rstrip().endswith(","))
    ]
    if not begins:
        named = {i for _, i in found}
        return [Piece(named.pop() if len(named) == 1 else None, text)]
    pieces = [Piece(None, text[: begins[0][0].start()])]
    for k, (match, i) in enumerate(begins):
        upto = begins[k + 1][0].start() if k + 1 < len(begins) else len(text)
        pieces.append(Piece(i, text[match.end() : upto].lstrip(" :=-–")))
    return [piece for piece in pieces if piece.text.strip()]


def _key(name: str) -> str:
    return " ".join(name.casefold().split())


def _is_called(match: re.Match[str], names: dict[str, int]) -> bool:
    """Whether a name stands for its column: a single letter or number only before a colon."""
    name = _key(match["name"])
    return name in names and (len(name) > 2 or _SHORT.fullmatch(name) is not None or bool(match["colon"]))


@lru_cache(maxsize=64)
def _names(heads: tuple[tuple[str, str], ...]) -> dict[str, int]:
    """What only one of some columns is called -> its place."""
    called = [(name, i) for i, (head, unit) in enumerate(heads) for name in _called(head, unit)]
    counts = Counter(name for name, _ in set(called))
    return {name: i for name, i in called if counts[name] == 1}


def _called(head: str, unit: str) -> set[str]:
    whole = taken_apart(head, unit).name.strip()
    parts = [part.strip() for part in _PATH.split(whole) if part.strip()]
    first = whole.split()[0] if whole.split() else ""
    names = {whole} if _LETTERED.fullmatch(whole) else set()
    if len(parts) > 1 and _SHORT.fullmatch(parts[-1]):
        names.add(parts[-1])
    if first != whole and _SHORT.fullmatch(first):
        names.add(first)
    if (lettered := _LETTERED.fullmatch(whole)) is not None and lettered[1].isalpha():
        names.add(lettered[1])
    return {_key(name) for name in names if 0 < len(name) <= _LONGEST_NAME}


@lru_cache(maxsize=64)
def _pattern(names: tuple[str, ...]) -> re.Pattern[str]:
    said = "|".join(r"\s".join(map(re.escape, name.split())) for name in sorted(names, key=len, reverse=True))
    return re.compile(rf"(?i)(?<![^\W_])(?P<name>{said})(?![^\W_])(?P<colon>\s?[:=])?")
