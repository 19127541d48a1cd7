"""From the table of a file to a Measurement: headers, conditions, rows, channels."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.kind import FORCE_KINDS, lifts_fast, starts_of_lifts, weights_of_runs
from mckibben.measurement.measurement import (
    CHANNEL_UNITS,
    REFERENCE,
    STROKES,
    UNIT_OF,
    Measurement,
    StatedValue,
    build,
)
from mckibben.measurement.order import FROM_ROWS, order_of_rows
from mckibben.measurement.question import Question
from mckibben.measurement.read.air import air_questions, column_of_air
from mckibben.measurement.read.cells import CellTable, Skip
from mckibben.measurement.read.channels import ChannelReading, read_channels
from mckibben.measurement.read.checks import questions_of
from mckibben.measurement.read.conditions import key_of, read_conditions, unwanted_columns
from mckibben.measurement.read.constants import notes_with_constants, with_constants
from mckibben.measurement.read.contradictions import condition_questions, numbers_in_words
from mckibben.measurement.read.correction import Correction
from mckibben.measurement.read.evidence import Evidence, is_numeric
from mckibben.measurement.read.hangers import add_hanger
from mckibben.measurement.read.head_text import channel_number, without_paths
from mckibben.measurement.read.header import Meaning, map_headers
from mckibben.measurement.read.held_by_text import hold_pressure, hold_stroke
from mckibben.measurement.read.left_out import UNKNOWN, UNWANTED, Reason
from mckibben.measurement.read.plain_head import TEXT_COLUMNS, HeaderColumn
from mckibben.measurement.read.propose import with_clock, with_proposed_stroke
from mckibben.measurement.read.questions import refusal
from mckibben.measurement.read.recognise import recognise
from mckibben.measurement.read.reversed_strokes import reverse_strokes
from mckibben.measurement.read.signs import FORCE_SIGN, STROKE_SIGN
from mckibben.measurement.read.source import RawTable
from mckibben.measurement.read.stated import KIND_SAID, REFERENCE_OF
from mckibben.measurement.read.tares import notes_of_tares, subtract_tare, zero_questions
from mckibben.measurement.read.valve_pressure import with_valve_pressure
from mckibben.physics.errors import InputError

_FEWEST_TO_TURN = 3  # rows
_LOADS = {"load_mass", "load_force"}
_DISORDERED = 1.0 / 3.0  # share of steps back in time from which rows are in no order; a half by chance
_RUN_CHANGES = (
    0.1  # share of rows that begin another run, above which the runs do not follow each other in time
)
_LOOKED_AT = 20_000  # readings from which questions are asked


class Read(NamedTuple):
    """A table read: its measurement, and how it was found."""

    measurement: Measurement
    columns: list[HeaderColumn]
    skipped: dict[str, Skip]
    questions: list[Question]


def meaning_of(source: RawTable, correction: Correction, *, collect: bool = False) -> Meaning:
    """What the columns of a source are; a stroke that no head names is proposed where the numbers show it."""
    unwanted = dict.fromkeys(name for name in unwanted_columns(source.notes) if name in source.headers)
    meaning = map_headers(
        source.headers,
        place=source.place,
        row=source.header_row,
        noun=source.noun,
        chosen={**unwanted, **correction.columns},
        collect=collect,
        units=source.units, stood=source.stood,
    )  # fmt: skip
    own = {
        place: UNWANTED
        for place in meaning.dismissed
        if source.headers[place] in unwanted and source.headers[place] not in correction.columns
    }
    meaning = meaning._replace(reasons={**meaning.reasons, **own})
    meaning = with_valve_pressure(source, with_constants(source, with_clock(source, meaning)))
    return with_proposed_stroke(source, meaning, correction.conditions)


def conditions_of(
    source: RawTable, meaning: Meaning, correction: Correction, messages: list[str]
) -> dict[str, float | str]:
    """Conditions of the file, the user's over them."""
    try:
        conditions = read_conditions(notes_with_constants(source, meaning, messages), messages)
    except InputError as error:
        if error.message.startswith(source.place):
            raise
        message = f"{source.place}, {error.message}"  # of a column: its place is the column alone
        raise InputError(message, field=error.field, hint=error.hint, code=error.code) from error
    numbers = {channel_number(header) for header in source.headers}
    for key in [key for key in conditions if key.startswith(REFERENCE_OF)]:
        if key.removeprefix(REFERENCE_OF) not in numbers:  # the columns have no such numbers
            conditions.setdefault("pressure", conditions.pop(key))
    for key, value in correction.conditions.items():
        if value is None:
            conditions.pop(key, None)
        else:
            conditions[key] = value
    return conditions


def rows_of(
    source: RawTable, columns: list[HeaderColumn], *, skip: bool, beside: Sequence[int] = ()
) -> CellTable:
    """The rows of the columns that are used; ``beside``: other columns of numbers that are needed."""
    numeric = [*(c.place for c in columns if c.use not in TEXT_COLUMNS), *beside]
    text = [c.place for c in columns if c.use in TEXT_COLUMNS]
    return source.read(numeric, text, skip)


def rows_of_needed(
    source: RawTable, columns: list[HeaderColumn], *, skip: bool, beside: Sequence[int] = ()
) -> tuple[CellTable, list[HeaderColumn], list[str]]:
    """(rows, columns that are read, what was left out): a column that no row needs costs none.

    A temperature, a speed, or a second stroke with cells that hold no reading is left out, not those rows.
    """
    optional = _optional(columns)
    try:
        table = rows_of(source, columns, skip=skip, beside=beside)
        if not optional or not table.skipped:
            return table, columns, []
    except InputError:
        if not optional:
            raise
    said = []
    for column in optional:
        if column not in _optional(columns):
            continue
        without = [c for c in columns if c is not column]
        kept = len(rows_of(source, without, skip=True).lines)
        try:
            lost = kept - len(rows_of(source, columns, skip=True).lines)
        except InputError:
            lost = kept
        if lost > 0:
            columns = without
            said.append(f"{source.noun} '{column.header}' is not used: it holds no number in {lost} rows")
    return rows_of(source, columns, skip=skip, beside=beside), columns, said


def _optional(columns: list[HeaderColumn]) -> list[HeaderColumn]:
    """Columns that the reading can do without, given the others."""
    strokes = [column for column in columns if column.use in STROKES]
    again = strokes if len(strokes) > 1 else []
    beside = ("temperature", "velocity", *(("diameter",) if strokes else ()))
    return [c for c in columns if c.origin != "you" and (c.use in beside or c in again)]


def assemble(
    source: RawTable, *, name: str, id: str, correction: Correction, meaning: Meaning | None = None,
    asked: list[Question] | None = None,
) -> Read:  # fmt: skip
    """The measurement of a table.

    Args:
        source: the table.
        name: file name.
        id: of the measurement.
        correction: what the user says beyond the file.
        meaning: of the columns, if it is known already.
        asked: takes the questions, instead of a refusal where some have no answer.

    Raises:
        InputError: whatever is wrong with it, naming file, row, column or key, and the remedy; questions
            without an answer.
    """
    messages = [*source.messages, *numbers_in_words(source.rest)]
    meaning = meaning or meaning_of(source, correction)
    conditions = conditions_of(source, meaning, correction, messages)
    messages += meaning.messages
    skip = correction.skip_bad_rows or str(conditions.get("bad_rows", "")).lower() == "skip"
    air = column_of_air(meaning.constants, meaning.columns, conditions)
    table, used, said = rows_of_needed(
        source, meaning.columns, skip=skip, beside=() if air is None else (air.place,)
    )
    messages += said
    ignored = [*meaning.ignored, *(c.header for c in meaning.columns if c not in used)]
    reading = ChannelReading(
        source.place, source.noun, table, conditions, messages, ignored, skip, source.clocks, source.rest, air
    )
    columns, by_use, slack = read_channels(used, reading)
    slack = _oldest_first(columns, by_use, slack, source, messages)
    hold_pressure(columns, by_use, name, source, conditions, messages)
    hold_stroke(columns, by_use, source, name, conditions, messages, correction)
    reversed_strokes = reverse_strokes(columns, by_use, reading)
    tare = subtract_tare(columns, by_use, [*source.rest, *notes_of_tares(source.notes)], conditions, messages)
    tare += add_hanger(
        columns, by_use, source.rest, conditions, messages,
        answered="force_zero" in conditions or "load_mass" in correction.conditions,
    )  # fmt: skip
    skipped = dict(reading.table.skipped)
    for reason, left_out in skipped.items():
        rows = "1 row" if left_out.rows == 1 else f"{left_out.rows} rows"
        messages.append(f"{rows} left out: {reason} (first: {left_out.first})")
    weights = weights_of_runs(columns)
    questions = questions_of(
        _evidence(source, meaning, reading, by_use, columns, correction, weighed=weights is not None)
    )
    if weights is not None and np.ptp(weights) > 0.0 and not _LOADS & set(correction.conditions):
        for key in _LOADS & set(conditions):  # of the first run, in its title
            del conditions[key]
    if not tare and weights is None:  # a weight that is stated has no zero
        tare += zero_questions(columns, by_use, source.unzeroed, conditions)
    tare += air_questions(conditions, by_use, source.notes)
    weighed = {*correction.conditions, *(column.key for column in meaning.constants)}
    questions += reversed_strokes + tare
    questions += condition_questions(source.rest, source.notes, conditions, columns, weighed)
    questions.sort(key=lambda question: not question.stops)
    if asked is not None:
        asked += questions
    elif (open_questions := refusal(name, questions, strict=correction.strict)) is not None:
        raise open_questions
    messages += [f"{question.text} ({question.option})" for question in questions if not question.stops]
    kind = conditions.pop("kind", None) if correction.kind is None else correction.kind
    conditions.pop("kind", None)
    kind_said = str(conditions.pop(KIND_SAID, ""))
    fast = kind_said == "isotonic" and lifts_fast(columns)  # of loads in titles: the readings say how fast
    if kind is None and kind_said and not fast and _suits(kind_said, columns):
        kind = kind_said
        messages.append(f"kind {kind_said}: a text of the file says so")
    rows_order = None if "time" in columns else order_of_rows(columns)
    if rows_order is not None and "direction" not in columns:
        columns["direction"] = rows_order.direction
        messages.append(
            "no time, but the rows go there and back step by step: their order is taken as that of the test, "
            "and the direction of each row from it"
        )
    order = {header: index for index, header in reversed(list(enumerate(source.headers)))}
    for key in [key for key in conditions if key.startswith((FORCE_SIGN, STROKE_SIGN, REFERENCE_OF))]:
        del conditions[key]
    measurement = build(
        columns,
        name=name,
        id=id,
        kind=None if kind is None else str(kind).lower(),
        origins={
            c: (by_use[c].header, by_use[c].unit or CHANNEL_UNITS[c]) if c in by_use else (FROM_ROWS, "1")
            for c in columns
        },
        ignored=sorted(reading.ignored, key=lambda header: order.get(header, len(order))),
        conditions=conditions,
        marked_slack=slack,
        messages=messages,
        skipped={reason: left_out.rows for reason, left_out in skipped.items()},
        starts=rows_order.starts if rows_order is not None else _starts(columns, weights),
    )
    measurement = replace(
        measurement,
        by_rows=rows_order is not None,
        unread=unread_columns(source, meaning, reading.ignored),
        undecided=_undecided(source, meaning),
        stated=stated_values(source, meaning, conditions, correction),
        in_words=frozenset(
            {
                *(use for use, column in by_use.items() if column.unit_origin in ("file", "you")),
                *([REFERENCE] if (read := by_use.get("pressure")) and read.absolute is not None else []),
            }
        ),
        questions=tuple(questions),
    )
    return Read(measurement, list(by_use.values()), skipped, questions)


def _oldest_first(
    columns: dict[str, NDArray], by_use: Mapping[str, HeaderColumn], slack: NDArray | None, source: RawTable,
    messages: list[str],
) -> NDArray | None:  # fmt: skip
    """Turn or sort the rows of a file whose time does not run forwards; the marks of slack, turned too."""
    time = columns.get("time")
    if time is None or len(time) < _FEWEST_TO_TURN or time.min() == time.max():
        return slack
    if (np.diff(time) <= 0.0).all():
        order = np.arange(len(time))[::-1]
        said = "the rows run backwards in time: they are read from the last to the first"
    elif (sorted_rows := _order_of(time, columns.get("group"))) is not None:
        order, said = sorted_rows, "the rows are in no order of time: they are sorted by it"
    else:
        return slack
    for channel, values in columns.items():
        columns[channel] = values[order].copy()
    if by_use["time"].place in source.clocks:
        columns["time"] -= columns["time"][0]
    messages.append(said)
    return slack if slack is None else slack[order].copy()


def _order_of(time: NDArray, group: NDArray | None) -> NDArray[np.intp] | None:
    """Rows in order of time where they are in no order; None where they are, or several runs begin at 0."""
    if np.mean(np.diff(time) < 0.0) < _DISORDERED:
        return None
    labels = np.zeros(len(time)) if group is None else group
    if len(np.unique(np.column_stack([labels, time]), axis=0)) < len(time):
        return None
    order = np.argsort(time)
    if np.mean(np.diff(labels[order]) != 0) < _RUN_CHANGES:
        return order
    return np.lexsort((time, labels))  # each run has a time of its own


def _suits(kind: str, columns: Mapping[str, NDArray]) -> bool:
    """Whether the channels that a kind needs are there."""
    needed = {"pressure", "force"} if kind in FORCE_KINDS else {"pressure"}
    return needed <= set(columns) and bool(set(columns) & set(STROKES))


def _starts(columns: Mapping[str, NDArray], weights: NDArray | None) -> tuple[int, ...]:
    """Rows at which a new part of the file begins: the group changes, and the time goes back.

    Of fast lifts of stated weights each run is one: its load is another, and nothing was read between them.
    """
    if weights is not None and lifts_fast(columns):
        return starts_of_lifts(columns)
    if "group" not in columns or "time" not in columns:
        return (0,)
    apart = (np.diff(columns["group"]) != 0) & (np.diff(columns["time"]) < 0.0)
    return (0, *(int(row) + 1 for row in np.flatnonzero(apart)))


def unread_columns(source: RawTable, meaning: Meaning, dropped: Sequence[str]) -> tuple[tuple[str, str], ...]:
    """All columns that nothing is read from, and why; ``dropped`` are those whose numbers showed it."""
    ignored = set(dropped)
    taken = {column.place for column in meaning.columns if column.header not in ignored}
    taken |= {column.place for column in meaning.constants if len(column.values) == 1}
    found = [
        (header or f"column {index + 1}", _why_unread(meaning, index))
        for index, header in enumerate(source.headers)
        if index not in taken
    ]
    return (*found, *source.unread)


def _undecided(source: RawTable, meaning: Meaning) -> tuple[str, ...]:
    """Columns that nothing is read from because neither their name nor their unit tells what they are."""
    used = {column.place for column in meaning.columns} | {c.place for c in meaning.constants}
    used |= {other.place for _, other in meaning.rivals} | set(meaning.problems) | meaning.dismissed
    units = [*source.units, *[None] * (len(source.headers) - len(source.units))]
    names = without_paths([header.strip() for header in source.headers])
    return tuple(
        header or f"column {index + 1}"
        for index, header in enumerate(source.headers)
        if index not in used
        and (known := recognise(names[index], units[index]).left_out) is not None
        and known.reason in (Reason.UNKNOWN, Reason.RAW)
        and meaning.reasons.get(index, known) == known
    )


def _why_unread(meaning: Meaning, index: int) -> str:
    if index in meaning.reasons:
        return meaning.reasons[index].text
    if index in meaning.problems:
        return meaning.problems[index].message
    if any(column.place == index for column in meaning.columns):
        return "its cells do not fit its name"
    return UNKNOWN.text


def stated_values(
    source: RawTable, meaning: Meaning, conditions: Mapping[str, float | str], correction: Correction
) -> tuple[StatedValue, ...]:
    """What the test was, each value with its origin; units that were assumed are ``unit of <channel>``."""
    where = {key_of(note.key)[0]: note.where for note in notes_with_constants(source, meaning)}
    said = (
        StatedValue(key, value, "you", "")
        if correction.conditions.get(key) is not None
        else StatedValue(key, value, "file", where.get(key, ""))
        for key, value in conditions.items()
    )
    units = (
        StatedValue(f"{UNIT_OF}{column.use}", column.unit, "assumed", f"{source.noun} '{column.header}'")
        for column in meaning.columns
        if column.unit_origin == "assumed" and column.unit is not None
    )
    return (*said, *units)


def _evidence(
    source: RawTable, meaning: Meaning, reading: ChannelReading, by_use: Mapping[str, HeaderColumn],
    channels: Mapping[str, NDArray], correction: Correction, *, weighed: bool,
) -> Evidence:  # fmt: skip
    def numeric(index: int) -> bool:
        return is_numeric(source.sample, index)

    def pair(first: int, second: int) -> tuple[NDArray, NDArray] | None:
        try:
            table = source.read([first, second], [], True)
        except InputError:
            return None
        return table.numbers[first], table.numbers[second]

    rows = len(next(iter(channels.values()), ()))
    step = max(1, rows // _LOOKED_AT)  # what is asked of a million readings shows in some thousands of them
    thinned = {
        use: values[:_LOOKED_AT] if use == "time" else values[::step] for use, values in channels.items()
    }
    return Evidence(
        headers=source.headers, apart=source.units, meaning=meaning,
        used={use: column for use, column in by_use.items() if use in channels or use not in CHANNEL_UNITS},
        channels=thinned, numeric=numeric, pair=pair, labels=reading.table.labels,
        conditions=reading.conditions, choices=source.choices if correction.sheet is None else (),
        noun=source.noun, by_clock="time" in by_use and by_use["time"].place in source.clocks,
        weighed=weighed,
    )  # fmt: skip
