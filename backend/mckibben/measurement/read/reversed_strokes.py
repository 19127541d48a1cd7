"""Strokes that grow as the muscle becomes longer, where nothing leaves a doubt: turned, and said."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.question import Question
from mckibben.measurement.read.channels import ChannelReading
from mckibben.measurement.read.directions import direction_of
from mckibben.measurement.read.evidence import bare_name
from mckibben.measurement.read.physical_checks import KEEP, REVERSE, mostly_negative, runs_against
from mckibben.measurement.read.plain_head import HeaderColumn
from mckibben.measurement.read.plausible import ENOUGH, is_plausible
from mckibben.measurement.read.questions import column_option
from mckibben.measurement.read.signs import SHORTENING_POSITIVE, STROKE_SIGN

_LOOKED_AT = 20_000  # readings that show a sign


def reverse_strokes(
    columns: dict[str, NDArray], by_use: dict[str, HeaderColumn], reading: ChannelReading
) -> list[Question]:
    """Turn each stroke that is negative and certainly counts the other way; what is to be said of it.

    It is certain where pressure and force show it, or the name of the column says it and they do not
    contradict. A column that the user has chosen and one whose sign a text states stay as they are.
    """
    said = []
    for channel in ("displacement", "contraction"):
        column, stroke = by_use.get(channel), columns.get(channel)
        if column is None or stroke is None or not _is_reversed(channel, by_use, columns, reading.conditions):
            continue
        columns[channel] = 0.0 - stroke
        by_use[channel] = column._replace(sign=-column.sign, extends=False)
        said.append(_question(channel, column, reading.noun))
    if said and "direction" in columns:  # words such as "load" were read by the stroke as it had been
        reading.messages[:] = [text for text in reading.messages if not text.startswith("direction read: ")]
        labels = reading.table.labels[by_use["direction"].place]
        if (direction := direction_of(labels, columns, reading.messages)) is not None:
            columns["direction"] = direction
    return said


def _is_reversed(
    channel: str, by_use: Mapping[str, HeaderColumn], columns: Mapping[str, NDArray],
    conditions: Mapping[str, object],
) -> bool:  # fmt: skip
    stroke, column = columns[channel], by_use[channel]
    if len(stroke) < ENOUGH or not mostly_negative(stroke) or not is_plausible(channel, np.abs(stroke)):
        return False
    if column.origin not in ("file", "assumed") or column.sign < 0:
        return False
    if conditions.get(STROKE_SIGN) == SHORTENING_POSITIVE:
        return False
    step = max(1, len(stroke) // _LOOKED_AT)
    pressure, force = (None if (v := columns.get(c)) is None else v[::step] for c in ("pressure", "force"))
    chosen = "force" in by_use and by_use["force"].origin == "you"
    if force is not None and not chosen and mostly_negative(force):
        force = -force  # a muscle pulls; whether its sign is another one is asked
    with np.errstate(all="ignore"):
        against = runs_against(stroke[::step], pressure, force)
    return against is True or (column.extends and against is None)


def _question(channel: str, column: HeaderColumn, noun: str) -> Question:
    turned, kept = (column_option(channel, bare_name(column), sign=sign) for sign in (-1, 1))
    return Question(
        f"sign of {channel}",
        f"{noun} '{column.header}' falls as the muscle shortens: read with its sign reversed; confirm that "
        "or keep its sign",
        f"{turned} or {kept}",
        column.header,
        REVERSE,
        (REVERSE, KEEP),
        stops=False,
    )
