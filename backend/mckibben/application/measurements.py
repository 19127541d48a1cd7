"""Summary of a measurement as it was read, and preview of a file before reading."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, fields

from numpy.typing import NDArray

from mckibben.application.form_field import FormField
from mckibben.measurement.measurement import CHANNEL_UNITS, KINDS, Measurement, StatedValue
from mckibben.measurement.question import Question
from mckibben.measurement.read.preview import MissingCondition, Preview, PreviewColumn, missing_conditions

#: Units offered by a form for each channel.
_SHOWN_UNREAD = 8  # columns in one sentence
_USUAL_UNITS = {
    "time": ("s", "ms", "min"), "pressure": ("bar", "kPa", "MPa", "mbar", "psi", "Pa"),
    "force": ("N", "kN", "lbf"), "length": ("mm", "m", "cm", "in"), "contraction": ("%", "1"),
    "displacement": ("mm", "m", "cm", "in"), "diameter": ("mm", "m", "in"), "velocity": ("m/s", "mm/s"),
    "command": ("1", "%"), "temperature": ("degC", "K", "degF"),
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class ChannelSummary:
    """A channel: its name, column and unit in the file, SI unit, extremes in SI."""

    name: str
    column: str
    unit: str
    si_unit: str
    minimum: float
    maximum: float


@dataclass(frozen=True, slots=True)
class SweepSummary:
    """Sweeps: their signal, number of sweeps and cycles, held rows, speeds."""

    signal: str | None
    sweeps: int
    cycles: int
    held_rows: int
    speeds: list[float]


@dataclass(frozen=True, slots=True)
class UnreadColumn:
    """A column that nothing is read from, and why."""

    column: str
    why: str


@dataclass(frozen=True, slots=True)
class StatedCondition:
    """A condition of the test in SI or text: who says it, ``file`` or ``you``, and where in the file."""

    key: str
    value: float | str
    origin: str
    where: str


@dataclass(frozen=True, slots=True)
class OpenQuestion:
    """What a file leaves open: see :class:`mckibben.measurement.question.Question`."""

    about: str
    text: str
    option: str
    column: str | None
    proposed: str | None
    choices: list[str]
    stops: bool


@dataclass(frozen=True)
class MeasurementSummary:
    """A measurement as it was read.

    Attributes:
        id: SHA-256 of the content.
        kind: of the measurement.
        kind_detected, kind_reason: whether the kind was detected, and the reason.
        rows, usable_rows: number of rows read, and of comparable rows.
        excluded, skipped: reason -> number of rows that cannot be compared, and that could not be read.
        ignored: columns that are not used.
        conditions: of the test, SI.
        missing: conditions that a comparison needs and the file does not state.
        groups: number of groups of rows.
        messages: the assumptions.
        unread: columns that nothing is read from, and why.
        stated: the conditions with their origin.
        questions: what the file leaves open.
    """

    id: str
    name: str
    kind: str
    kind_detected: bool
    kind_reason: str
    rows: int
    usable_rows: int
    excluded: dict[str, int]
    skipped: dict[str, int]
    channels: list[ChannelSummary]
    ignored: list[str]
    conditions: Mapping[str, float | str]
    missing: list[MissingCondition]
    groups: int
    segments: SweepSummary
    messages: list[str]
    unread: list[UnreadColumn]
    stated: list[StatedCondition]
    questions: list[OpenQuestion]


@dataclass(frozen=True)
class MeasurementDetails(MeasurementSummary):
    """A measurement with its columns in SI."""

    columns: dict[str, NDArray] = field(default_factory=dict)


@dataclass(frozen=True, slots=True)
class TableOption:
    """A sheet, group or struct that ``sheet`` of a correction picks, and whether it is among those read."""

    name: str
    is_read: bool


@dataclass(frozen=True, slots=True)
class RawRow:
    """A row of a file as it stands in it: its number from 1, its cells."""

    row: int
    cells: list[str]


@dataclass(frozen=True, slots=True)
class RawTable:
    """First rows of a file, rows of names and units; ``head_moves``: a correction may name another head.

    ``also``: cells that hold the same columns again, beside the first ones.
    """

    rows: list[RawRow]
    head: int | None
    units: int | None
    head_moves: bool
    also: list[int]


@dataclass(frozen=True, slots=True)
class SkippedSummary:
    """Rows that could not be read: reason, number, the first one."""

    reason: str
    rows: int
    first: str


@dataclass(frozen=True, slots=True)
class UnreadableFile:
    """Why a file cannot be read as a measurement."""

    code: str
    message: str
    field: str | None
    hint: str | None


@dataclass(frozen=True, slots=True)
class ChannelOption:
    """A possible channel of a column, its SI unit, and the units offered by a form."""

    name: str
    si_unit: str
    units: list[str]


@dataclass(frozen=True, slots=True)
class PreviewResult:
    """Preview of a file.

    Attributes:
        columns: interpretation of each column.
        sample: first rows as in the file.
        rows, valid_rows, skipped: of the table.
        kind, kind_detected, kind_reason: as in a summary; kind is None for a file that cannot be read.
        conditions, missing: stated conditions of the test, and missing ones.
        measurement: the measurement, or None.
        problem: why the file cannot be read, or None.
        only_bad_rows: whether the file can be read without the bad rows.
        channel_choices, kind_choices: options for corrections by the user.
        questions, unread, stated: as in a summary, also for a file that cannot be read yet.
        experiment: fields of the experiment that matter for this kind of test, with values or questions.
        table_choices: names of the sheets, groups or structs that could be meant, where that is open.
        tables: sheets, groups or structs that the user may pick, and whether each is read.
        raw: the first rows as they stand in the file, or None.
        points: channel -> values in SI at evenly chosen rows, for a picture.
    """

    name: str
    format: str
    columns: list[PreviewColumn]
    sample: list[list[str]]
    rows: int
    valid_rows: int
    skipped: list[SkippedSummary]
    kind: str | None
    kind_detected: bool
    kind_reason: str
    conditions: Mapping[str, float | str]
    missing: list[MissingCondition]
    measurement: MeasurementSummary | None
    problem: UnreadableFile | None
    only_bad_rows: bool
    messages: list[str]
    channel_choices: list[ChannelOption]
    kind_choices: list[str]
    questions: list[OpenQuestion]
    unread: list[UnreadColumn]
    stated: list[StatedCondition]
    table_choices: list[str]
    tables: list[TableOption]
    raw: RawTable | None
    points: dict[str, NDArray]
    experiment: list[FormField]


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
    )


def unread_sentence(measurement: Measurement) -> str:
    """Which columns nothing is read from, and why; "" = none that the messages do not name already."""
    said = [
        f"'{column}' ({why})"
        for column, why in measurement.unread
        if not any(
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
            list(question.choices), question.stops,
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
        table_choices=list(preview.choices),
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
