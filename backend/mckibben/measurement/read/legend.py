"""Legends of short heads: ``p = muscle pressure in mbar, F = pull in N, s = stroke in mm``."""

from __future__ import annotations

import re
from collections.abc import Sequence

from mckibben.measurement.read.blocks import Table
from mckibben.measurement.read.head_text import taken_apart
from mckibben.measurement.read.recognise import recognise
from mckibben.measurement.read.unit_words import dimension_of, unit_of
from mckibben.measurement.read.vocabulary import channel_of_word, words_of

Texts = Sequence[tuple[str, str]]

_SHORT = 4  # characters of a head that needs a legend
_FEWEST = 2  # heads that a text explains
_DIGIT = re.compile(r"[0-9]")


def told_units(
    headers: Sequence[str], units: Sequence[str | None], texts: Texts
) -> tuple[dict[int, str], list[str]]:
    """(column -> unit, messages) that sentences tell of heads without one: "pressure in bar, length in mm".

    It counts only where no head and no row gives a unit; a name is told by its words, at the beginning of a
    clause, with at most two words before "in".
    """
    bare = [taken_apart(name, unit) for name, unit in zip(headers, units, strict=True)]
    if any(head.unit is not None for head in bare):
        return {}, []
    found: dict[int, str] = {}
    said: list[str] = []
    for text, where in texts:
        for clause in re.split(r"[,;:.(](?:\s|$)|\)|\s+(?:and|und|et|e|y)\s+", text):
            match = _TOLD.fullmatch(clause.strip(" #-*"))
            unit = None if match is None else unit_of(match["unit"]) or unit_of(match["unit"].rstrip("s"))
            if match is None or unit is None or not dimension_of(unit.unit):
                continue
            words = words_of(match["name"])
            named = [
                i for i, head in enumerate(bare) if i not in found and _is_meant(words_of(head.name), words)
            ]
            if len(named) == 1:
                mark = {True: "(a)", False: "(g)", None: ""}[unit.absolute]
                found[named[0]] = f"{unit.unit}{mark}"
                said.append(f"'{headers[named[0]]}' is in {unit.unit} ({where})")
    if len(found) < _FEWEST:
        return {}, []
    return found, said


def _is_meant(head: Sequence[str], words: Sequence[str]) -> bool:
    """Whether a clause is of a head: it has its words, or both name the same one channel."""
    if head and set(head) <= set(words):
        return True
    one, other = ({c for word in side if (c := channel_of_word(word))} for side in (head, words))
    return len(one) == 1 and one == other


_TOLD = re.compile(r"(?P<name>[^\d=]{1,50}?)\s+(?:in|en|em|im|w|v|i|as)\s+(?P<unit>\S{1,20})")


def explain_heads(table: Table) -> None:
    """Give short heads without a unit the words and the unit that one text of the file says of them.

    The text has to explain two of them, each with a unit and without a number, as a value is no legend.
    """
    if any(table.units) or any(taken_apart(name).unit for name in table.names if name):
        return
    short = [i for i, name in enumerate(table.names) if name and len(name) <= _SHORT and name.isalnum()]
    for text, where in table.rest:
        found: dict[int, str] = {}
        for index in short:
            name = re.escape(table.names[index])
            match = re.search(rf"(?<!\w){name}\s*(?:[=:]|\bis\b|-)\s*([^,;|=]+?)\s*(?:[,;|]|\.?$)", text)
            if match is None or _DIGIT.search(match[1]):
                continue
            head = f"{table.names[index]} {match[1]}"
            known = recognise(head)
            if known.unit is not None and known.channel is not None:
                found[index] = head
        if len(found) >= _FEWEST:
            for index, head in found.items():
                table.names[index] = head
            table.messages.append(f"the heads are explained by {where}: '{text[:80]}'")
            return
