"""What a file would be read as: columns, units, rows, kind and conditions, before anything is kept."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from mckibben.facts.result import result_class
from mckibben.measurement.measurement import CHANNEL_UNITS, Measurement, StatedValue
from mckibben.measurement.question import Question
from mckibben.measurement.reading.answers import refusal
from mckibben.measurement.reading.assemble import (
    decided,
    looked_at,
    measurement_of,
    says_reference,
    stated_of,
    unread_of,
)
from mckibben.measurement.reading.correction import Correction
from mckibben.measurement.reading.evidence import OWN_FORM
from mckibben.measurement.reading.model import FILE, Skip, Table, Use
from mckibben.measurement.reading.questions import Reading, questions_of
from mckibben.measurement.reading.raw import RawRows
from mckibben.physics.errors import InputError

_POINTS = 400  # most values of a channel in the picture of a preview
_SAMPLE = 8  # rows


@result_class
class PreviewColumn:
    """One column of the file; ``channel`` None = not used, ``unit`` None = SI; ``why``: what is wrong.

    ``unit_origin``: who says the unit, ``file``, ``you``, ``assumed`` or ``proposed`` from the numbers, None
    without a channel; ``unit_where``: where the file says it, apart from the header; ``sign`` -1: the file
    counts it the other way; ``unread``: why nothing is read from it; ``place``: its cell in the rows of the
    file, None where it stands in none.
    """

    header: str
    """Header of the file; the key of a mapping."""
    channel: str | None
    """The proposed or chosen channel; None = not used."""
    unit: str | None
    """The proposed, stated or chosen unit; None = not used."""
    absolute: bool | None
    """An absolute pressure; None = not stated, gauge is assumed."""
    minimum: float | None
    """Smallest value of the channel, SI."""
    maximum: float | None
    """Largest value of the channel, SI."""
    why: str | None
    """Why the column cannot be used as its header states."""
    unit_origin: str | None = None
    """Who says the unit: file, you, proposed from the range, or assumed; None = not used."""
    unit_where: str | None = None
    """Where the unit stands, apart from the header."""
    sign: int = 1
    """-1: the file counts it the other way."""
    unread: str | None = None
    """Why nothing is read from the column; None = it is used."""
    place: int | None = None
    """Its cell in the rows of 'raw', from 0; None = it stands in none."""
    evidence: tuple[str, ...] = ()
    """What says so, and where it stands: its quantity, unit, sign, reference, scale; or why it is none."""


@result_class
class MissingCondition:
    """A condition that the kind needs and the file does not say; one of ``alternatives`` does as well."""

    key: str
    """Name of the condition."""
    unit: str
    """Its SI unit."""
    why: str
    """What it is needed for."""
    example: str
    """An example value."""
    alternatives: tuple[str, ...] = ()
    """Conditions that replace it."""


@dataclass(frozen=True)
class Preview:
    """What a file would be read as.

    Attributes:
        format: ``csv``, ``json``, ``xlsx``, ``mat``, ``hdf5`` or ``tdms``.
        columns: all columns of the file, in its order.
        sample: the first rows as texts, one per column.
        rows, valid: rows of the file below the header, and those that can be read.
        skipped: reason -> rows that cannot, and where the first is.
        measurement: as it would be kept; None while ``problem`` stands in the way.
        conditions: found in the file or given, SI.
        missing: what to ask for.
        problem: why the file cannot be used as it is.
        refused: it cannot only because of bad rows, which the user may leave out.
        messages: what was assumed.
        questions: what the file leaves open; ``problem`` is their refusal where they stop the reading.
        unread: all columns that nothing is read from, and why.
        stated: the conditions with their origin.
        tables: all tables of the file that a name picks, and whether each is read.
        raw: the first rows as they stand in the file; None where the format has none.
        head_row: row of the names; None where the format has none.
        points: channel -> SI values at evenly chosen rows, for a picture, also while questions are open.
    """

    name: str
    format: str
    columns: tuple[PreviewColumn, ...]
    sample: tuple[tuple[str, ...], ...]
    rows: int
    valid: int
    skipped: Mapping[str, Skip]
    measurement: Measurement | None
    conditions: Mapping[str, float | str]
    missing: tuple[MissingCondition, ...]
    problem: InputError | None
    refused: bool
    messages: tuple[str, ...]
    questions: tuple[Question, ...] = ()
    unread: tuple[tuple[str, str], ...] = ()
    stated: tuple[StatedValue, ...] = ()
    tables: tuple[tuple[str, bool], ...] = ()
    raw: RawRows | None = None
    head_row: int | None = None
    points: Mapping[str, NDArray[np.float64]] = field(default_factory=dict)


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
        columns=_columns(table, reading, measurement, asked),
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


def missing_conditions(
    kind: str | None, columns: Mapping[str, np.ndarray], conditions: Mapping[str, float | str]
) -> tuple[MissingCondition, ...]:
    """The conditions a comparison of this kind needs and does not have."""
    missing = []
    loaded = "load_mass" in conditions or "load_force" in conditions
    if kind in ("isotonic", "transient") and not loaded and not (kind == "isotonic" and "force" in columns):
        why = "the load decides how far the muscle shortens"
        missing.append(MissingCondition("load_mass", "kg", why, "6 kg", ("load_force",)))
    if kind == "transient" and "command" in columns and "supply_pressure" not in conditions:
        why = "the valve fills the muscle from the supply"
        missing.append(MissingCondition("supply_pressure", "Pa", why, "6 bar"))
    return tuple(missing)


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
    written = dict(table.raw)
    for r in range(min(_SAMPLE, table.rows)):
        row = written.get(int(table.lines[r]), ())
        cells = []
        for column in table.columns:
            if 0 <= column.place < len(row):
                cells.append(row[column.place])
                continue
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
    return RawRows(table.raw, places, table.unit_row, table.head_row is not None, table.also)


def _columns(
    table: Table, reading: Reading | None, measurement: Measurement | None, asked: Sequence[Question]
) -> tuple[PreviewColumn, ...]:
    wrong = {q.column: q.text for q in reversed(asked) if q.stops and q.column}
    used = (
        {}
        if reading is None
        else {i: (c, u) for c, (i, u) in reading.decision.uses.items() if c in reading.rows.channels}
    )
    labels = {} if reading is None else {i: use for use, i in reading.rows.labels.items()}
    ranges = {} if measurement is None else {c.name: c for c in measurement.channels}
    unread = {} if reading is None else dict(unread_of(reading))
    said_reference = reading is not None and "pressure" in reading.decision.uses and says_reference(reading)
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
                absolute=use.absolute if use and channel == "pressure" and said_reference else None,
                minimum=span.minimum if span else None,
                maximum=span.maximum if span else None,
                why=wrong.get(column.head) or wrong.get(column.title),
                unit_origin=origin,
                unit_where=table.unit_where if column.unit and table.unit_where and channel else None,
                sign=use.sign if use is not None else 1,
                unread=None if channel else unread.get(column.title),
                place=column.place if column.place >= 0 else None,
                evidence=() if reading is None else _evidence(reading, i, use),
            )
        )
    return tuple(found)


def _evidence(reading: Reading, i: int, use: Use | None) -> tuple[str, ...]:
    """The strongest claim for each thing that is read of a column; of one that is not read, for what it is
    instead.
    """
    choice = reading.known.chosen.get(i)
    if i in reading.known.chosen and i not in reading.known.dismissed and not (choice and choice.assumed):
        return ("you say what it is",)
    wanted: list[tuple[str, str, object]] = []
    if use is None:
        roles = reading.roles(i)
        if roles:
            wanted.append(("role", "", max(roles, key=lambda role: roles[role])))
    else:
        wanted += [("channel", use.channel, use.channel), ("unit", use.unit, use.unit)]
        if use.channel == "pressure":
            wanted.append(("absolute", "absolute" if use.absolute else "gauge", use.absolute))
        elif use.channel in ("force", "displacement", "contraction"):
            facet = "sign_force" if use.channel == "force" else "sign_stroke"
            wanted.append((facet, "sign reversed" if use.sign < 0 else "sign as it stands", use.sign))
        wanted += [("scale", "scale", None), (f"zero:{use.channel}", "zero", None)]
    lines = []
    for facet, what, value in wanted:
        found = [
            e
            for e in reading.evidence
            if e.facet == facet
            and e.target in (i, FILE)
            and (value is None or e.value == value)
            and e.rule != OWN_FORM
        ]
        if found:
            best = max(found, key=lambda e: e.weight)
            said = what or str(best.value)
            lines.append(f"{said}: '{best.span.text[:80]}' ({best.span.where})")
    return tuple(lines)
