"""Names of a map: what runs down its first column, across its first row, and what its cells hold."""

from __future__ import annotations

import re
from collections.abc import Sequence

from mckibben.measurement.measurement import STROKES
from mckibben.measurement.read.recognise import recognise
from mckibben.measurement.read.unit_words import dimension_of, unit_of

_DOWN = (
    r"(?:rows?|down(?:wards)?|vertical(?:ly)?|zeilen?|senkrecht|lignes?|righe|filas|linhas|wiersze|řádky|"
    r"строки|satırlar|rijen|rader|rækker|行方向|縦)"
)
_ACROSS = (
    r"(?:col(?:umn)?s?|across|horizontal(?:ly)?|spalten?|waagerecht|colonn[ae]s?|columnas|colunas|kolumny|"
    r"sloupce|столбцы|sütunlar|kolommen|kolumner|kolonner|列方向|横)"
)
_NAME = r"(?P<name>[^\W\d][^,;:=()\[\]]{0,40}?\s*[\[(][^\])]{1,20}[\])])"
_PARTED = re.compile(r"\\|\||/(?![^\[(]*[\])])| vs\.? | x |×|→|↓")


def axes_of_map(
    corner: str, column: int, head: Sequence[str], titles: Sequence[tuple[int, int, str]]
) -> list[str]:
    """(what runs down, what runs across); fewer names where the texts do not say both.

    The corner says it, "contraction [%] \\ pressure [bar]", the names above the first column and above the
    values, or a sentence: "rows: contraction [%], columns: pressure [bar]".

    Args:
        corner: the cell above the first column of numbers.
        column: of that cell.
        head: the row of names above.
        titles: (row, column, text) of what else stands above.
    """
    parts = [as_load(part.strip()) for part in _PARTED.split(corner) if part.strip()]
    if len(parts) == 2:
        return parts
    texts = [text for _, _, text in titles]
    said = [_said(texts, word) for word in (_DOWN, _ACROSS)]
    if said[0] and said[1]:
        return said
    above = [*texts, *(name for name in head if name)]
    if parts and recognise(parts[0]).channel != "force":
        across = [text for text in above if _is_axis(text) and _differs(text, parts[0])]
        return [parts[0], *across[:1]]
    beside = [(c, name) for c, name in enumerate(head)] + [(c, text) for _, c, text in titles]
    down = next((name for c, name in beside if c <= column and _is_axis(name)), "")
    across = [name for c, name in beside if c > column and _is_axis(name) and _differs(name, down)]
    return [down, *across[:1]] if down else []


def as_load(name: str) -> str:
    """A mass as the load that it is: ``"m [kg]"`` -> ``"load m [kg]"``; any other name as it is."""
    known = recognise(name)
    if known.channel is None and dimension_of(known.unit) == "a mass":
        return f"load {name}"
    return name


def value_of_map(above: Sequence[str], channels: Sequence[str | None]) -> str | None:
    """``"Static force [N] of DMSP-20"`` -> ``"Static force [N]"``."""
    for text in above:
        for found in re.finditer(r"([^\[(\])]*?)\s*[\[(]([^\])]*)[\])]", text):
            unit = unit_of(found[2])
            if unit is None or not dimension_of(unit.unit):
                continue
            name = f"{found[1].strip()} [{found[2]}]".strip()
            if recognise(name).channel not in (None, *channels):
                return name
    for clause in (part for text in above for part in re.split(r"[,;:(.]\s*", text)):
        found = re.match(r"(.{3,40}?)\s+(?:in|en|em|w|v|i)\s+(\S+)(?:\s|$)", clause.strip())
        if found is not None and (unit := unit_of(found[2])) is not None and dimension_of(unit.unit):
            name = f"{found[1].strip()} [{found[2]}]"
            if recognise(name).channel not in (None, *channels):
                return name
    for text in above:
        known = recognise(text)
        if known.unit is not None and known.channel == "force" and known.channel not in channels:
            return text
    return None


def _said(texts: Sequence[str], word: str) -> str:
    """The quantity that a sentence puts beside a word: "rows: contraction [%]", "pressure [bar] across"."""
    for pattern in (
        rf"(?i)(?<!\w){word}\s*(?:[:=–-]|\bis\b|\bare\b)?\s*{_NAME}",
        rf"(?i){_NAME}\s*{word}(?!\w)",
    ):
        for text in texts:
            if (found := re.search(pattern, text)) is not None and _is_axis(found["name"].strip()):
                return found["name"].strip()
    return ""


def _is_axis(text: str) -> bool:
    """Whether a text names a stroke or a pressure with its unit."""
    known = recognise(as_load(text)) if text else None
    return known is not None and known.unit is not None and known.channel in (*STROKES, "pressure", "force")


def _differs(one: str, other: str) -> bool:
    return recognise(one).channel != recognise(other).channel
