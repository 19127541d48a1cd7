"""What a file would be read as: columns, units, rows, kind and conditions, before anything is kept."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from mckibben.facts.result import result_class
from mckibben.measurement.measurement import CHANNEL_UNITS, Measurement, StatedValue
from mckibben.measurement.question import Question
from mckibben.measurement.read.assemble import (
    Read,
    assemble,
    conditions_of,
    meaning_of,
    rows_of,
    stated_values,
    unread_columns,
)
from mckibben.measurement.read.cells import Skip
from mckibben.measurement.read.correction import Correction
from mckibben.measurement.read.formats import open_source
from mckibben.measurement.read.header import Meaning
from mckibben.measurement.read.plain_head import TEXT_COLUMNS, HeaderColumn
from mckibben.measurement.read.questions import refusal
from mckibben.measurement.read.raw import RawRows
from mckibben.measurement.read.source import RawTable
from mckibben.physics.errors import InputError

_POINTS = 400  # most values of a channel in the picture of a preview


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
    """What a file would be read as, found in this process: see `mckibben.measurement.read.preview`.

    Raises:
        InputError: no table can be found in the file at all, or the correction names what is not there.
    """
    correction = correction or Correction()
    source = open_source(data, name, correction)
    meaning = meaning_of(source, correction, collect=True)
    problem: InputError | None = next(iter(meaning.problems.values()), None)
    conditions: dict[str, float | str] = {}
    messages = list(source.messages)
    try:
        conditions = conditions_of(source, meaning, correction, messages)
    except InputError as error:
        problem = problem or error
    tolerant = replace(correction, skip_bad_rows=True)
    identity = correction.identity(data)
    read: Read | None = None
    skipped: Mapping[str, Skip] = {}
    valid = 0
    asked: list[Question] = []
    try:
        if not meaning.columns:
            meaning_of(source, correction)  # says why no column is known
        read = assemble(source, name=name, id=identity, correction=tolerant, meaning=meaning, asked=asked)
        skipped, valid = read.skipped, read.measurement.rows
        conditions = dict(read.measurement.conditions)
        messages = list(read.measurement.messages)
    except InputError as error:
        problem = problem or error
        skipped, valid = _counted(source, meaning)
        messages += meaning.messages
    refused = False
    if problem is None and skipped:
        try:
            assemble(source, name=name, id=identity, correction=correction, meaning=meaning, asked=[])
        except InputError as error:
            problem, refused = error, True
    problem = (
        problem
        if problem is not None and not refused
        else refusal(name, asked, strict=correction.strict) or problem
    )
    refused = refused and not any(question.stops or correction.strict for question in asked)
    measurement = None if read is None or (problem is not None and not refused) else read.measurement
    kind = None if measurement is None else measurement.kind
    return Preview(
        name=name,
        format=source.format,
        columns=_columns(source, meaning, read),
        sample=tuple(tuple(row) for row in source.sample),
        rows=valid + sum(skip.rows for skip in skipped.values()),
        valid=valid,
        skipped=skipped,
        measurement=measurement,
        conditions=conditions,
        missing=missing_conditions(kind, {} if measurement is None else measurement.columns, conditions),
        problem=problem,
        refused=refused,
        messages=tuple(messages),
        questions=tuple(asked),
        unread=unread_columns(source, meaning, ()) if read is None else read.measurement.unread,
        stated=stated_values(source, meaning, conditions, correction)
        if read is None
        else read.measurement.stated,
        tables=source.tables,
        raw=source.raw,
        head_row=source.header_row,
        points={} if read is None else _points(read.measurement),
    )


def _points(measurement: Measurement) -> dict[str, NDArray[np.float64]]:
    step = -(-measurement.rows // _POINTS)
    return {
        name: np.asarray(values)[:: max(step, 1)].astype(np.float64)
        for name, values in measurement.columns.items()
        if name in CHANNEL_UNITS
    }


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


def _counted(source: RawTable, meaning: Meaning) -> tuple[Mapping[str, Skip], int]:
    """(rows that cannot be read, number of those that can) where the rest of the file says too little."""
    try:
        table = rows_of(source, meaning.columns, skip=True)
    except InputError:
        return {}, 0
    return table.skipped, len(table.lines)


def _columns(source: RawTable, meaning: Meaning, read: Read | None) -> tuple[PreviewColumn, ...]:
    guessed = {column.place: column for column in meaning.columns}
    used = {column.place: column for column in (read.columns if read else ())}
    ranges = {} if read is None else {c.name: c for c in read.measurement.channels}
    result = []
    places = () if source.raw is None else source.raw.places
    unread = dict(read.measurement.unread if read else unread_columns(source, meaning, ()))
    for index, header in enumerate(source.headers):
        apart = source.units[index] if index < len(source.units) else None
        column: HeaderColumn | None = used.get(index, guessed.get(index))
        problem = meaning.problems.get(index)
        if (
            read is not None
            and column is not None
            and column.use in CHANNEL_UNITS
            and column.use not in ranges
        ):
            column = None  # its numbers show that it is not what its name says
        span = ranges.get(column.use) if column else None
        result.append(
            PreviewColumn(
                header=header.strip() or f"column {index + 1}",
                channel=column.use if column else None,
                unit=column.unit if column else None,
                absolute=column.absolute if column else None,
                minimum=span.minimum if span else None,
                maximum=span.maximum if span else None,
                why=problem.message if problem else None,
                unit_origin=_unit_origin(column),
                unit_where=source.unit_where if column is not None and apart and source.unit_where else None,
                sign=column.sign if column else 1,
                unread=None if column is not None else unread.get(header.strip() or f"column {index + 1}"),
                place=places[index] if index < len(places) else None,
            )
        )
    return tuple(result)


def _unit_origin(column: HeaderColumn | None) -> str | None:
    """Who says the unit of a column; None where it has none, as a text."""
    if column is None or column.use not in CHANNEL_UNITS or column.use in TEXT_COLUMNS:
        return None
    return column.unit_origin if column.unit else "proposed"
