"""What a file would be read as: columns, units, rows, kind and conditions, before anything is kept."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from mckibben.measurement.measurement import CHANNEL_UNITS, Measurement
from mckibben.measurement.question import Question
from mckibben.measurement.read.correction import Correction
from mckibben.measurement.read.preview import Preview, PreviewColumn, missing_conditions
from mckibben.measurement.read.questions import refusal
from mckibben.measurement.read.raw import RawRows
from mckibben.measurement.reading.assemble import decided, looked_at, measurement_of, stated_of, unread_of
from mckibben.measurement.reading.model import Table
from mckibben.measurement.reading.questions import Reading, questions_of
from mckibben.physics.errors import InputError

_POINTS = 400  # most values of a channel in the picture of a preview
_SAMPLE = 8  # rows


def preview_here(data: bytes, name: str, correction: Correction | None = None) -> Preview:
    """What a file would be read as, found in this process.

    Raises:
        InputError: no table can be found in the file at all, or the correction names what is not there.
    """
    correction = correction or Correction()
    table, evidence, known = looked_at(data, name, correction)
    reading: Reading | None = None
    measurement: Measurement | None = None
    asked: list[Question] = []
    problem: InputError | None = None
    refused = False
    try:
        reading = decided(name, table, evidence, known, replace(correction, skip_bad_rows=True))
        asked = questions_of(reading)
        measurement = measurement_of(reading, asked, correction.identity(data))
    except InputError as error:
        problem = error
    if (
        problem is None
        and reading is not None
        and reading.rows.first_bad is not None
        and not correction.skip_bad_rows
    ):
        problem, refused = reading.rows.first_bad, True
    if (open_questions := refusal(name, asked, strict=correction.strict)) is not None:
        problem, refused = open_questions, False
    conditions = (
        dict(measurement.conditions)
        if measurement is not None
        else {k: v for k, v in known.conditions.items() if k != "kind"}
    )
    kept = measurement if problem is None or refused else None
    valid = 0 if reading is None else len(reading.rows.lines)
    skipped = {} if reading is None else reading.rows.skipped
    return Preview(
        name=name,
        format=table.format,
        columns=_columns(table, reading, measurement),
        sample=_sample(table),
        rows=valid + sum(s.rows for s in skipped.values()),
        valid=valid,
        skipped=skipped,
        measurement=kept,
        conditions=conditions,
        missing=missing_conditions(
            None if kept is None else kept.kind, {} if kept is None else kept.columns, conditions
        ),
        problem=problem,
        refused=refused,
        messages=tuple(measurement.messages) if measurement is not None else table.messages,
        questions=tuple(asked),
        unread=unread_of(reading) if reading is not None else tuple((c.title, "") for c in table.columns),
        stated=stated_of(reading, conditions) if reading is not None else (),
        tables=table.tables,
        raw=_raw(table),
        head_row=table.head_row,
        points={} if measurement is None else _points(measurement),
    )


def _points(measurement: Measurement) -> Mapping[str, np.ndarray]:
    step = max(1, -(-measurement.rows // _POINTS))
    return {
        n: np.asarray(v)[::step].astype(np.float64)
        for n, v in measurement.columns.items()
        if n in CHANNEL_UNITS
    }


def _sample(table: Table) -> tuple[tuple[str, ...], ...]:
    """The first rows as texts."""
    shown = []
    for r in range(min(_SAMPLE, table.rows)):
        cells = []
        for column in table.columns:
            gap = column.gaps.get(r)
            cells.append(
                column.words[r]
                if column.words is not None
                else gap.text
                if gap is not None
                else f"{column.values[r]:.10g}"
            )
        shown.append(tuple(cells))
    return tuple(shown)


def _raw(table: Table) -> RawRows | None:
    """The first rows as they stand in the file; None where the format has none."""
    if not table.raw:
        return None
    places = tuple(c.place if c.place >= 0 else None for c in table.columns)
    return RawRows(table.raw, places, head_moves=table.head_row is not None)


def _columns(
    table: Table, reading: Reading | None, measurement: Measurement | None
) -> tuple[PreviewColumn, ...]:
    used = (
        {}
        if reading is None
        else {i: (c, u) for c, (i, u) in reading.decision.uses.items() if c in reading.rows.channels}
    )
    labels = {} if reading is None else {i: use for use, i in reading.rows.labels.items()}
    ranges = {} if measurement is None else {c.name: c for c in measurement.channels}
    unread = {} if reading is None else dict(unread_of(reading))
    found = []
    for i, column in enumerate(table.columns):
        channel, use = used.get(i, (labels.get(i), None))
        span = ranges.get(channel) if channel else None
        origin = None
        if use is not None and reading is not None and channel is not None:
            choice = reading.known.chosen.get(i)
            by_you = choice is not None and choice.unit is not None
            origin = (
                "assumed"
                if choice is not None and choice.assumed
                else "you"
                if by_you
                else "file"
                if reading.said_unit(channel)
                else "proposed"
            )
        found.append(
            PreviewColumn(
                header=column.title,
                channel=channel,
                unit=use.unit if use is not None else None,
                absolute=use.absolute if use is not None and channel == "pressure" else None,
                minimum=span.minimum if span else None,
                maximum=span.maximum if span else None,
                why=None,
                unit_origin=origin,
                unit_where=table.unit_where if column.unit and table.unit_where and channel else None,
                sign=use.sign if use is not None else 1,
                unread=None if channel else unread.get(column.title),
                place=column.place if column.place >= 0 else None,
            )
        )
    return tuple(found)
