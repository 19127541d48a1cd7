"""A log without time whose rows are counted: what is to be said of it."""

from __future__ import annotations

import numpy as np

from mckibben.measurement.measurement import CHANNEL_UNITS
from mckibben.measurement.question import Question
from mckibben.measurement.read.evidence import Evidence
from mckibben.measurement.read.head_text import taken_apart
from mckibben.measurement.read.questions import column_option

_FEWEST = 200  # rows that nobody writes down by hand


def counted_rows(evidence: Evidence) -> list[Question]:
    """Whether a counter beside many rows without time stands for one: a logger takes them evenly."""
    if "time" in evidence.channels or not set(evidence.channels) & set(evidence.used):
        return []
    used = {column.place for column in evidence.used.values() if column.use in CHANNEL_UNITS}
    used |= {column.place for column in evidence.meaning.constants} | evidence.meaning.dismissed
    for index, header in enumerate(evidence.headers):
        if index in used or not evidence.numeric(index):
            continue
        beside = next(column.place for use, column in evidence.used.items() if use in evidence.channels)
        both = evidence.pair(index, beside)
        if both is None or len(both[0]) < _FEWEST or not (np.diff(both[0]) == 1.0).all():
            continue
        name = taken_apart(header).name or header
        return [
            Question(
                "time",
                f"{evidence.noun} '{header}' counts the rows, and no time is read: creep, speed and lags "
                "cannot be found; if the rows were taken at an even rate, e.g. every 2 s, it is the time",
                column_option("time", name, "0 to 1 counts = 0 to 2 s"),
                header,
                stops=False,
            )
        ]
    return []
