"""Names of columns listed in a preamble: ``Spalte 1: p in bar``, ``Columns: t [s], p [bar]``."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from mckibben.measurement.read.grid import BLANKS, Grid, TextGrid
from mckibben.measurement.read.head_text import taken_apart
from mckibben.measurement.read.locate import names_channel, texts_of
from mckibben.measurement.read.recognise import recognise
from mckibben.measurement.read.unit_words import unit_of

_WITHIN = 300  # rows above the readings
_LONGEST = 2000  # characters of a row
_WORD = (
    r"(?:columns?|cols?|fields?|channels?|spalten?|feld|colonnes?|columnas?|colunas?|colonn[ae]|kolumn[ay]?|"
    r"kolomm?(?:en)?|kolonner?|kolonne|kolumner?|sloup(?:ec|ce)|stĺp(?:ec|ce)|stupac|stupci|stolp(?:ec|ci)|"
    r"столбец|столбцы|колонк[аи]|стовп(?:ець|ці)|s[üu]tun(?:lar)?|sarak(?:e|keet)|oszlop(?:ok)?|"
    r"coloan[aăe]|στήλ(?:η|ες)|列|열)"
)
_END = r"\s*(?:[:=)\]–-]|->|is\b)\s*"
_NUMBERED = re.compile(
    rf"(?i)(?:(?:{_WORD}|ch)\.?\s*(?:no\.?|nr\.?|#)?\s*([0-9]{{1,2}})|(?:第\s*)?([0-9]{{1,2}})\s*(?:列目?|열)|\$([0-9]{{1,2}}))"
    rf"(?:{_END}|\s+(?=[^\W\d]))"
)
_LINE = re.compile(rf"\s*[\[(]?([0-9]{{1,2}})(?:{_END}|\.\s+)(.+)")
_LIST = re.compile(rf"(?i)\s*{_WORD}(?:\s*\([^)]*\))?\s*[:=：]\s*(.+)")


class ColumnList(NamedTuple):
    """Names of all columns, and the row of the grid in which the list begins."""

    names: list[str]
    row: int


def listed_columns(grid: Grid, until: int, width: int) -> ColumnList | None:
    """The list of the columns above a row, where one names each of them; None = there is none.

    A list counts when it names every column by its number, or as many as there are, two channels at least.
    """
    if (told := _told_columns(grid, until, width)) is not None:
        return told
    numbered: dict[int, tuple[str, int]] = {}
    lines: dict[int, tuple[str, int]] = {}
    plain: ColumnList | None = None
    for index in range(max(0, until - _WITHIN), until):
        text = _text_of(grid, index)
        if not text or len(text) > _LONGEST:
            continue
        for number, name in _numbered(text):
            numbered.setdefault(number, (name, index))
        if (line := _LINE.fullmatch(text)) is not None:
            lines.setdefault(int(line[1]), (line[2].strip(), index))
        if plain is None and (found := _LIST.fullmatch(text)) is not None:
            names = _parted(found[1], width)
            plain = None if names is None else ColumnList(names, index)
    for entries in (numbered, lines):
        first = min(entries, default=1)
        if first in (0, 1) and set(entries) == set(range(first, first + width)) and width > 1:
            names = [entries[number][0] for number in range(first, first + width)]
            if _name_channels(names):
                return ColumnList(names, min(row for _, row in entries.values()))
    return plain if plain is not None and _name_channels(plain.names) else None


_SENTENCE = re.compile(
    rf"(?i)(?<!\w){_WORD}(?:\s+[^\W\d]+){{0,3}}?\s*(?:[:=]|\bare\b|\bis\b|\bsind\b|\bsont\b|\bson\b|\bsono\b|\bcontain\b|\bhold\b|\benthalten\b)\s*:?\s*(.+)"
)
_PARTS = re.compile(r"\s*[,;]\s*(?:and|und|et|e|y|dann|then)?\s+|\s+(?:and|und|et)\s+")
_IN = re.compile(r"(?:the\s+)?(.+?)\s+(?:in|en|em|im|w|v)\s+(\S+?)(?:\s+(.+))?")


def _told_columns(grid: Grid, until: int, width: int) -> ColumnList | None:
    """The columns that a sentence of the preamble tells: "the columns are time in seconds, force in newtons".

    The sentence may go on over several lines. It counts where it tells as many as there are, all with units.
    """
    first = max(0, until - _WITHIN)
    texts = [_text_of(grid, index) for index in range(first, until)]
    if sum(map(len, texts)) > 20 * _LONGEST:
        return None
    for number, text in enumerate(texts):
        if (begin := _SENTENCE.search(text)) is None:
            continue
        whole = re.split(r"[.](?:\s|$)", " ".join([begin[1], *texts[number + 1 : number + 6]]))[0]
        parts = [_IN.fullmatch(part.strip()) for part in _PARTS.split(whole)]
        if len(parts) != width or width < 2 or not all(parts):
            continue
        names = []
        for part in parts:
            unit = unit_of(part[2]) or unit_of(part[2].rstrip("s")) if part else None
            if part is None or unit is None:
                break
            names.append(f"{part[1]} [{unit.unit}]")
        if len(names) == width and _name_channels(names):
            return ColumnList(names, first + number)
    return None


def is_column_list(line: str) -> bool:
    """Whether a comment lists columns, which is no condition of the test."""
    return _LIST.fullmatch(line.strip().lstrip("#%/ ").strip()) is not None


def _text_of(grid: Grid, index: int) -> str:
    filled = [cell for cell in texts_of(grid.cells(index)) if cell]
    blanks = isinstance(grid, TextGrid) and grid.separator == BLANKS
    return (" " if blanks else ", ").join(filled).strip()


def _numbered(text: str) -> list[tuple[int, str]]:
    """(number, name) of the columns that a text lists: each goes on to the next one."""
    found = list(_NUMBERED.finditer(text))
    ends = [*(match.start() for match in found[1:]), len(text)][: len(found)]
    entries = [
        (int(match[1] or match[2] or match[3]), text[match.end() : end].strip(" ,;|/."))
        for match, end in zip(found, ends, strict=True)
    ]
    return [(number, re.split(r"[;|]", name)[0].strip()) for number, name in entries if name]


def _parted(text: str, width: int) -> list[str] | None:
    """The names of a list, parted by whatever gives as many as there are columns."""
    for pattern in (r"\s*[;|]\s*", r"\s*,\s*(?![^\[(]*[\])])", r"\t+", r"\s+(?![\[(])"):
        names = [name for name in re.split(pattern, text.strip(" .")) if name]
        if len(names) == width > 1:
            return names
    return None


def _name_channels(names: Sequence[str]) -> bool:
    known = {recognise(name).channel for name in names if names_channel(name) or taken_apart(name).unit}
    return len(known - {None}) > 1
