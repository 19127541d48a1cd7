"""Summary of a measurement as it was read, and preview of a file before reading."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import field, fields
from typing import ClassVar

from mckibben.facts.result import Column, Number, Series, result_class
from mckibben.measurement.experiment import Origin
from mckibben.measurement.measurement import CHANNEL_UNITS, KINDS, Measurement, StatedValue
from mckibben.measurement.preparation import rows_of_file
from mckibben.measurement.question import Question
from mckibben.measurement.reading.answers import DISMISSED, columns_said
from mckibben.measurement.reading.preview import MissingCondition, Preview, PreviewColumn, missing_conditions

#: Units offered by a form for each channel.
_SHOWN_UNREAD = 8  # columns in one sentence
_USUAL_UNITS = {
    "time": ("s", "ms", "min"), "pressure": ("bar", "kPa", "MPa", "mbar", "psi", "Pa"),
    "force": ("N", "kN", "lbf"), "length": ("mm", "m", "cm", "in"), "contraction": ("%", "1"),
    "displacement": ("mm", "m", "cm", "in"), "diameter": ("mm", "m", "in"), "velocity": ("m/s", "mm/s"),
    "command": ("1", "%"), "temperature": ("degC", "K", "degF"),
    "angle": ("deg", "rad"), "torque": ("N*m",), "lever": ("mm", "cm", "m", "in"),
    "counter_pressure": ("bar", "kPa", "MPa", "mbar", "psi", "Pa"),
}  # fmt: skip


@result_class
class FormField:
    """A field of a form; see `mckibben.measurement.experiment.ExperimentField` and ``ExperimentValue``."""

    CORRECTING: ClassVar = ("option",)

    field: str
    """Name: the key of 'experiment' in a request. 'accuracy_length' and the like are parts of its 'accuracy'.
    """
    title: str
    """In words."""
    value: float | str | None
    """In SI, or a text; None = nobody states it."""
    unit: str
    """SI unit; "" of a text."""
    units: tuple[str, ...]
    """Units for a form."""
    origin: Origin | None
    """Who says it; None with value."""
    where: str
    """Place in the file, or the preset."""
    required: bool
    """This kind of test needs it."""
    unanswered: bool
    """Required, and neither the file nor the user says it: ask before the first diagnosis. With origin
    'assumed' a diagnosis goes on with the value; with value None it does not.
    """
    question: str
    """The question of the field."""
    why: str
    """What it is needed for."""
    proposed: float | str | None
    """A value that the data suggest, SI; never used unasked."""
    least: float | None
    """Smallest allowed value, SI."""
    most: float | None
    """Largest allowed value, SI."""
    choices: tuple[str, ...]
    """Allowed texts, or proposals of texts; empty = any."""
    closed: bool
    """Only the choices are allowed."""
    example: str
    """A valid value, as a text."""
    option: str
    """What says it, in the words of the door."""


@result_class
class ChannelSummary:
    """A channel: its name, column and unit in the file, SI unit, extremes in SI."""

    name: str
    """Name of the channel."""
    column: str
    """Header of the file."""
    unit: str
    """Unit in the file."""
    si_unit: str
    """SI unit of minimum, maximum and the columns."""
    minimum: Number
    """Smallest value, SI."""
    maximum: Number
    """Largest value, SI."""


@result_class
class SweepSummary:
    """Sweeps: their signal, number of sweeps and cycles, held rows, speeds."""

    signal: str | None
    """The channel that defines the sweeps."""
    sweeps: int
    """Number of sweeps."""
    cycles: int
    """Number of cycles."""
    held_rows: int
    """Rows in which nothing moves."""
    speeds: list[Number]
    """Mean speed of each level, ascending, in the SI unit of the signal per second; empty without time."""


@result_class
class UnreadColumn:
    """A column that nothing is read from, and why."""

    column: str
    """Header of the file."""
    why: str
    """Why nothing is read from it."""


@result_class
class StatedCondition:
    """A condition of the test in SI or text: who says it, ``file`` or ``you``, and where in the file."""

    key: str
    """Name of the condition."""
    value: float | str
    """In SI, or a text."""
    origin: str
    """file or you; assumed: a unit that was taken as proposed."""
    where: str
    """Line or cell of the file; empty for the user's own."""


@result_class
class ColumnAnswer:
    """What an answer to a question says of a column."""

    column: str
    """The column, by its header with or without its unit."""
    channel: str | None
    """What it is; None: it is left out."""
    unit: str | None
    """The unit of its readings; None: as in the file."""
    turned: bool
    """Its readings have the other sign."""


@result_class
class OpenQuestion:
    """What a file leaves open: see :class:`mckibben.measurement.question.Question`."""

    CORRECTING: ClassVar = ("option",)

    about: str
    """What it is about."""
    text: str
    """The question."""
    option: str
    """What answers it, in the words of the door."""
    column: str | None
    """The column concerned."""
    proposed: str | None
    """The likeliest answer."""
    choices: list[str]
    """Possible answers."""
    answers: list[ColumnAnswer]
    """Answers that say what a column is, as a mapping takes them."""
    stops: bool
    """Without an answer the file is not read."""


@result_class
class Preparation:
    """A step that prepared a measurement."""

    step: str
    """As it is written."""
    done: str
    """What it did, in words."""
    rows_before: int
    """Number of rows before it."""
    rows_after: int
    """Number of rows after it."""


def preparations(measurement: Measurement) -> list[Preparation]:
    """The steps that prepared a measurement."""
    return [Preparation(*step) for step in measurement.prepared]


@result_class
class MeasurementSummary:
    """A measurement as it was read."""

    CORRECTING: ClassVar = ("messages",)

    id: str
    """SHA-256 of the file's content (and of the mapping, if there is one)."""
    name: str
    """Name of the file."""
    kind: str
    """isobaric, isometric, isotonic, diameter, transient or static."""
    kind_detected: bool
    """Detected from the data, not stated in the file."""
    kind_reason: str
    """Why this kind was detected; empty when it was stated."""
    rows: int
    """Number of rows that were read."""
    usable_rows: int
    """Rows with a usable measurement."""
    excluded: dict[str, int]
    """Reason why rows are not usable -> number of rows."""
    skipped: dict[str, int]
    """Reason why rows could not be read -> number of rows."""
    channels: list[ChannelSummary]
    """The used columns."""
    ignored: list[str]
    """Columns that are not used."""
    conditions: Mapping[str, float | str]
    """Conditions of the test, SI."""
    missing: list[MissingCondition]
    """Conditions that a comparison needs and the file does not state."""
    groups: int
    """Number of sweeps or cycles of the rows."""
    segments: SweepSummary
    """How the rows are divided into sweeps."""
    messages: list[str]
    """Remarks on the file."""
    unread: list[UnreadColumn]
    """All columns that nothing is read from, and why."""
    stated: list[StatedCondition]
    """The conditions with their origin."""
    questions: list[OpenQuestion]
    """What the file leaves open."""
    prepared: list[Preparation]
    """The steps that prepared it, in their order."""


@result_class
class MeasurementDetails(MeasurementSummary):
    """A measurement with its columns in SI."""

    columns: dict[str, Column] = field(default_factory=dict)
    """Channel -> values in SI; 'slack' marks rows without pulling force, 'usable' those with a usable
    measurement, 'sweep' and 'cycle' number them, 'motion' is -1 shortening, +1 lengthening, 0 at rest;
    'row' is that of the file, from 1, where steps have prepared the measurement.
    """


@result_class
class TableOption:
    """A sheet, group or struct that ``sheet`` of a correction picks, and whether it is among those read."""

    name: str
    """Its name."""
    is_read: bool
    """It is read now, alone or with others of the same columns."""


@result_class
class RawRow:
    """A row of a file as it stands in it: its number from 1, its cells."""

    row: int
    """Its number in the file, from 1."""
    cells: list[str]
    """Its cells as written."""


@result_class
class RawTable:
    """First rows of a file, rows of names and units; ``head_moves``: a correction may name another head.

    ``also``: cells that hold the same columns again, beside the first ones.
    """

    rows: list[RawRow]
    """The rows, in the order of the file."""
    head: int | None
    """The row of the column names."""
    units: int | None
    """The row of the units, where they stand apart."""
    head_moves: bool
    """'head' of a mapping may name another row."""
    also: list[int]
    """Cells, from 0, that hold the same columns again beside the first ones."""


@result_class
class SkippedSummary:
    """Rows that could not be read: reason, number, the first one."""

    reason: str
    """Why they cannot be read."""
    rows: int
    """Number of these rows."""
    first: str
    """Where the first of them is."""


@result_class
class UnreadableFile:
    """Why a file cannot be read as a measurement."""

    CORRECTING: ClassVar = ("message", "hint")

    code: str
    """Machine-readable kind."""
    message: str
    """What is wrong, for people."""
    field: str | None
    """Path of the field in the request."""
    hint: str | None
    """What would be right."""


@result_class
class ChannelOption:
    """A possible channel of a column, its SI unit, and the units offered by a form."""

    name: str
    """Name of the channel."""
    si_unit: str
    """Its SI unit."""
    units: list[str]
    """Usual units; others are accepted too."""


@result_class
class PreviewResult:
    """Preview of a file."""

    CORRECTING: ClassVar = ("messages",)

    name: str
    """Name of the file."""
    format: str
    """csv, json, xlsx, mat, hdf5 or tdms."""
    columns: list[PreviewColumn]
    """All columns of the file, in its order."""
    sample: list[list[str]]
    """The first rows as written in the file, up to 8."""
    rows: int
    """Rows below the header."""
    valid_rows: int
    """Rows that can be read."""
    skipped: list[SkippedSummary]
    """Rows that cannot be read, by reason."""
    kind: str | None
    """The kind; None while the file cannot be used."""
    kind_detected: bool
    """Detected from the data, not stated in the file."""
    kind_reason: str
    """Why this kind was detected; empty when it was stated."""
    conditions: Mapping[str, float | str]
    """Conditions in the file or in the mapping, SI."""
    missing: list[MissingCondition]
    """Conditions to ask for."""
    measurement: MeasurementSummary | None
    """As it would be stored, without the skipped rows; None while the file cannot be used."""
    problem: UnreadableFile | None
    """The error with which an upload would refuse the file."""
    only_bad_rows: bool
    """The only problem are bad rows: the mapping {'bad_rows': 'skip'} leaves them out."""
    messages: list[str]
    """Assumptions made."""
    channel_choices: list[ChannelOption]
    """Channels to which a column can be mapped."""
    kind_choices: list[str]
    """Kinds that a mapping may state."""
    questions: list[OpenQuestion]
    """What the file leaves open; 'problem' refuses it while one of them stops the reading."""
    unread: list[UnreadColumn]
    """All columns that nothing is read from, and why."""
    stated: list[StatedCondition]
    """The conditions with their origin."""
    tables: list[TableOption]
    """All sheets, groups or structs that 'sheet' of a mapping picks; empty where none are."""
    raw: RawTable | None
    """The first rows as they stand in the file; None where the format has no rows."""
    points: dict[str, Series]
    """Channel -> SI values of evenly chosen rows, for a picture, also while questions are open."""
    experiment: list[FormField]
    """Every field of the experiment that matters for this kind of test; those 'unanswered' are asked before
    the first diagnosis.
    """


def summary_of(measurement: Measurement) -> MeasurementSummary:
    """Summary of a measurement."""
    sweeps = measurement.segments
    return MeasurementSummary(
        id=measurement.id,
        name=measurement.name,
        kind=measurement.kind,
        kind_detected=measurement.kind_detected,
        kind_reason=measurement.kind_reason,
        rows=measurement.rows,
        usable_rows=int(measurement.usable.sum()),
        excluded=dict(measurement.exclusions),
        skipped=dict(measurement.skipped),
        channels=[
            ChannelSummary(
                name=channel.name,
                column=channel.column,
                unit=channel.source_unit,
                si_unit=channel.unit,
                minimum=channel.minimum,
                maximum=channel.maximum,
            )
            for channel in measurement.channels
        ],
        ignored=list(measurement.ignored),
        conditions=dict(measurement.conditions),
        missing=list(missing_conditions(measurement.kind, measurement.columns, measurement.conditions)),
        groups=measurement.groups,
        segments=SweepSummary(
            signal=sweeps.signal,
            sweeps=sweeps.sweeps,
            cycles=sweeps.cycles,
            held_rows=sweeps.held_rows,
            speeds=list(sweeps.speeds),
        ),
        messages=list(measurement.messages),
        unread=_unread(measurement.unread),
        stated=_stated(measurement.stated),
        questions=_questions(measurement.questions),
        prepared=preparations(measurement),
    )


def unread_sentence(measurement: Measurement) -> str:
    """Which columns nothing is read from, and why; "" = none that the messages do not name already."""
    said = [
        f"'{column}' ({why})"
        for column, why in measurement.unread
        if why != DISMISSED  # the file itself says so
        and not any(
            f"'{column}' is not {done}" in m for m in measurement.messages for done in ("used", "read")
        )
    ]
    if not said:
        return ""
    more = f" and {len(said) - _SHOWN_UNREAD} more" if len(said) > _SHOWN_UNREAD else ""
    return f"columns that are not read: {', '.join(said[:_SHOWN_UNREAD])}{more}"


def _unread(columns: Iterable[tuple[str, str]]) -> list[UnreadColumn]:
    return [UnreadColumn(column, why) for column, why in columns]


def _stated(values: Iterable[StatedValue]) -> list[StatedCondition]:
    return [StatedCondition(*value) for value in values]


def _questions(questions: Iterable[Question]) -> list[OpenQuestion]:
    return [
        OpenQuestion(
            question.about, question.text, question.option, question.column, question.proposed,
            list(question.choices), [ColumnAnswer(*said) for said in columns_said(question.option)],
            question.stops,
        )
        for question in questions
    ]  # fmt: skip


def details_of(measurement: Measurement) -> MeasurementDetails:
    """A measurement with its columns and the properties of each row."""
    summary, sweeps = summary_of(measurement), measurement.segments
    summary_fields = {item.name: getattr(summary, item.name) for item in fields(summary)}
    row_columns = {
        "slack": measurement.slack,
        "usable": measurement.usable,
        "sweep": sweeps.sweep,
        "cycle": sweeps.cycle,
        "motion": sweeps.direction,
    }
    if measurement.prepared:
        row_columns["row"] = rows_of_file(measurement) + 1
    return MeasurementDetails(**summary_fields, columns=dict(measurement.columns) | row_columns)


def preview_of(preview: Preview, experiment: list[FormField]) -> PreviewResult:
    """Preview of a file, with its experiment as a form."""
    measurement, problem = preview.measurement, preview.problem
    return PreviewResult(
        name=preview.name,
        format=preview.format,
        columns=list(preview.columns),
        sample=[list(row) for row in preview.sample],
        rows=preview.rows,
        valid_rows=preview.valid,
        skipped=[SkippedSummary(reason, skip.rows, skip.first) for reason, skip in preview.skipped.items()],
        kind=measurement.kind if measurement else None,
        kind_detected=measurement.kind_detected if measurement else False,
        kind_reason=measurement.kind_reason if measurement else "",
        conditions=dict(preview.conditions),
        missing=list(preview.missing),
        measurement=summary_of(measurement) if measurement else None,
        problem=None
        if problem is None
        else UnreadableFile(problem.code, problem.message, problem.field, problem.hint),
        only_bad_rows=preview.refused,
        messages=list(preview.messages),
        channel_choices=[
            ChannelOption(name, unit, list(_USUAL_UNITS.get(name, (unit,))))
            for name, unit in CHANNEL_UNITS.items()
        ],
        kind_choices=list(KINDS),
        questions=_questions(preview.questions),
        unread=_unread(preview.unread),
        stated=_stated(preview.stated),
        tables=[TableOption(name, is_read) for name, is_read in preview.tables],
        raw=_raw(preview),
        points=dict(preview.points),
        experiment=experiment,
    )


def _raw(preview: Preview) -> RawTable | None:
    raw = preview.raw
    if raw is None:
        return None
    rows = [RawRow(number, list(cells)) for number, cells in raw.rows]
    return RawTable(rows, preview.head_row, raw.units_row, raw.head_moves, list(raw.also))
