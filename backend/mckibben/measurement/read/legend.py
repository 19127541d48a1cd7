"""Legends of short heads: ``p = muscle pressure in mbar, F = pull in N, s = stroke in mm``."""

from __future__ import annotations

import re

from mckibben.measurement.read.blocks import Table
from mckibben.measurement.read.head_text import taken_apart
from mckibben.measurement.read.recognise import recognise

_SHORT = 4  # characters of a head that needs a legend
_FEWEST = 2  # heads that a text explains
_DIGIT = re.compile(r"[0-9]")


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
