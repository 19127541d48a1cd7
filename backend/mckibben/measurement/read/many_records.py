"""Thousands of records of numbers and times as columns, without a walk through tables of cells."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.read.conditions import Note
from mckibben.measurement.read.source import RawTable, array_source
from mckibben.measurement.read.values import CLOCK, Clock, is_elapsed, is_falling, kind_of

_FROM = 5000  # records
_LOOKED_AT = 2000  # times from which the way of writing them is told


@dataclass(frozen=True)
class PlainColumns:
    """Columns of equal length in the order of their heads; ``clocks``: those of times, as seconds."""

    columns: list[NDArray[np.float64]]
    clocks: frozenset[int]

    def source(
        self, heads: list[str], name: str, notes: list[Note], messages: list[str],
        texts: list[tuple[str, str]],
    ) -> RawTable:  # fmt: skip
        """The table of the columns under these heads."""
        named = dict(zip(heads, self.columns, strict=True))
        found = array_source(named, place=name, format="json", noun="column", notes=notes, messages=messages)
        return replace(found, clocks=self.clocks, rest=tuple(texts))


def plain_columns(heads: Sequence[str], records: Sequence[Mapping[str, Any]]) -> PlainColumns | None:
    """The columns of many records; None = they are few, or hold words, lists or other names."""
    if len(records) < _FROM or len(set(heads)) < len(heads):
        return None
    columns: list[NDArray[np.float64]] = []
    clocks: set[int] = set()
    for index, head in enumerate(heads):
        values = [record.get(head) for record in records]
        kinds = set(map(type, values)) - {type(None)}
        if kinds <= {int, float} and kinds:
            try:
                columns.append(np.array(values, dtype=np.float64))
            except OverflowError:
                return None
        elif kinds == {str} and all(kind_of(value) == CLOCK for value in values):
            shown = values[:_LOOKED_AT]
            clock = Clock(elapsed=is_elapsed(shown), falling=is_falling(shown))
            columns.append(np.array([clock.seconds(value) for value in values], dtype=np.float64))
            clocks.add(index)
        else:
            return None
    return PlainColumns(columns, frozenset(clocks))
