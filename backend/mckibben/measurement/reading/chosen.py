"""What a user says of the columns: which of them is meant, what the words of one stand for, ``I = 1 bar, II =
2 bar``, and what no column holds because it was held throughout, ``3 bar``.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from mckibben.measurement.reading.correction import MOST_LEVELS, Choice, levels_of
from mckibben.measurement.reading.heads import taken_apart
from mckibben.measurement.reading.model import Column, Gap, Table
from mckibben.measurement.reading.units import FITTING, Quantity, quantities
from mckibben.physics.errors import InputError, did_you_mean

#: Channels that a test can hold at one value.
HOLDABLE = ("pressure", "length", "contraction", "displacement")


def with_levels(table: Table, columns: Mapping[str, Choice | None]) -> Table:
    """The table with the values that a user says of the words of columns.

    Raises:
        InputError: a column of numbers has no words, or a word of it gets no value.
    """
    made = list(table.columns)
    for name, choice in columns.items():
        levels = None if choice is None or choice.scale is None else levels_of(choice.scale)
        if levels is not None:
            for i in places(name, table)[:1]:
                made[i] = _valued(table, made[i], levels.values)
    return replace(table, columns=tuple(made))


def _valued(table: Table, column: Column, levels: Mapping[str, float]) -> Column:
    label = f"{table.noun} '{column.title}'"
    if column.words is None:
        raise InputError(
            f"{table.where}: {label} holds numbers, and no words that stand for a value",
            field=f"{table.noun} {column.title}",
            hint="the scale of a signal is said as '[0 to 10 V = 0 to 10 bar]'",
        )
    words = [word.strip() for word in column.words]
    if missing := [word for word in dict.fromkeys(words) if word and word not in levels]:
        raise InputError(
            f"{table.where}: no value is said for '{missing[0][:40]}' of {label}",
            field=f"{table.noun} {column.title}",
            hint=f"say one for each of {', '.join(missing[:MOST_LEVELS])}",
        )
    values = np.array([levels.get(word, np.nan) for word in words])
    gaps = {row: Gap("empty", "") for row, word in enumerate(words) if not word}
    return replace(column, values=values, words=None, gaps=gaps)


def words_of_levels(column: Column) -> list[str]:
    """The different words of a column that can stand for levels, in their order; [] = it holds none."""
    words = list(dict.fromkeys(word.strip() for word in column.words or () if word.strip()))
    return words if 1 < len(words) <= MOST_LEVELS else []


def _quantity(name: str, channel: str) -> Quantity | None:
    """The quantity that a name is, ``3 bar``, where a test can hold the channel at it."""
    found = quantities(name)
    if channel not in HOLDABLE or len(found) != 1 or found[0].text != name.strip():
        return None
    return found[0] if found[0].unit.dimension in FITTING[channel] else None


def places(name: str, table: Table) -> list[int]:
    """The columns that a user means by a name: the head, with or without its unit, or "column 3"."""
    wanted = " ".join(name.split())
    heads = [" ".join(c.head.split()) for c in table.columns]
    for names in (
        [c.title for c in table.columns],
        heads,
        [
            f"{h} [{c.unit.strip('[]() ')}]" if c.unit else h
            for h, c in zip(heads, table.columns, strict=True)
        ],
        [taken_apart(h, c.unit).name for h, c in zip(heads, table.columns, strict=True)],
        [h.casefold() for h in heads],
        [_square(h) for h in heads],
        _numbered_names(table),
    ):
        found = [
            i
            for i, one in enumerate(names)
            if one == wanted or one == wanted.casefold() or one == _square(wanted)
        ]
        if found:
            return found
    if (number := re.fullmatch(r"(?i)column (\d{1,4})", wanted)) is not None:
        place = int(number[1]) - 1
        at = [i for i, c in enumerate(table.columns) if c.place == place]
        return at or ([place] if 0 <= place < len(heads) else [])
    return []


def _square(name: str) -> str:
    """A name with its unit in square brackets."""
    return name.replace("(", "[").replace(")", "]")


def _numbered_names(table: Table) -> list[str]:
    """Names without their units, numbered where several are alike: "Kraft", "Kraft #2"."""
    names = [taken_apart(" ".join(c.head.split()), c.unit).name for c in table.columns]
    return [n if (k := names[: i + 1].count(n)) == 1 else f"{n} #{k}" for i, n in enumerate(names)]


def chosen(
    table: Table, columns: Mapping[str, Choice | None], name: str
) -> tuple[dict[int, Choice | None], dict[str, Quantity]]:
    """Column -> what the user says it is; channel -> what was held, where a name is no column but a quantity.

    Raises:
        InputError: there is no such column, or several are called so.
    """
    chosen: dict[int, Choice | None] = {}
    held: dict[str, Quantity] = {}
    for said, choice in columns.items():
        found = places(said, table)
        if not found and choice is not None and (quantity := _quantity(said, choice.channel)) is not None:
            held[choice.channel] = quantity
            continue
        if not found and choice is None and any(said == name for name, _ in table.dropped):
            continue
        if not found:
            names = [c.title for c in table.columns]
            raise InputError(
                f"{name}: there is no {table.noun} '{said[:80]}'",
                field=f"{table.noun} {said[:80]}",
                hint=did_you_mean(said, names),
            )
        if len(found) > 1:
            raise InputError(
                f"{name}: several {table.noun}s are called '{said[:80]}'",
                field=f"{table.noun} {said[:80]}",
                hint=f"say its place, 'column {found[0] + 1}'",
            )
        before = [i for i, c in chosen.items() if c is not None and choice and c.channel == choice.channel]
        if before and found[0] not in before:
            pair = f"'{table.columns[before[0]].title}' and '{table.columns[found[0]].title}'"
            raise InputError(
                f"{name}: {table.noun}s {pair} are both said to be the {choice.channel if choice else ''}",
                field=f"{table.noun} {said[:80]}",
                hint="say one of them, and leave the other out",
            )
        chosen[found[0]] = choice
    return chosen, held
