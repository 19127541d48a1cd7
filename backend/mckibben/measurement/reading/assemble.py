"""A file -> a measurement: the steps one after the other, and what is said about them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from mckibben.measurement.kind import FORCE_KINDS, explain_kind, lifts_fast, starts_of_lifts, weights_of_runs
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
from mckibben.measurement.reading.answers import DISMISSED, refusal
from mckibben.measurement.reading.chosen import with_levels
from mckibben.measurement.reading.containers import sheets_of
from mckibben.measurement.reading.correction import Correction
from mckibben.measurement.reading.decide import SLOTS, decide, roles_of
from mckibben.measurement.reading.derived import with_derived, without_stated_marks
from mckibben.measurement.reading.evidence import OWN_FORM, evidence_of
from mckibben.measurement.reading.facts import Known, known_of
from mckibben.measurement.reading.heads import head_claims
from mckibben.measurement.reading.layout import table_of
from mckibben.measurement.reading.lexicon import words_of
from mckibben.measurement.reading.model import FILE, Array, Column, Evidence, Span, Table
from mckibben.measurement.reading.numbers import TEXT, kind_of
from mckibben.measurement.reading.questions import (
    MOTION,
    SCALABLE,
    Reading,
    antagonists,
    questions_of,
    scale_question,
    though_at_the_valve,
)
from mckibben.measurement.reading.rig import heads_of, rig_texts
from mckibben.measurement.reading.rows import rows_of
from mckibben.measurement.reading.units import RAW, dimension_of
from mckibben.measurement.reading.zeros import stated_zeros
from mckibben.physics.errors import InputError, did_you_mean

_SIGNALS = {
    "voltage": "a voltage", "current": "a current", "count": "a count", "bridge": "the output of a bridge",
    "share of range": "a share of a range",
}  # fmt: skip
_MOST_OTHERS = 6  # columns of other tables that are named in messages
_NAMED = 4  # columns in a message
_LOADS = ("load_mass", "load_force")
_BY_UNIT = ("unit", "ticks_of_milliseconds", "ticks_of_microseconds")  # rules of heads that are only a unit
_BY_NUMBERS = ("unit", "even steps")  # rules that need no word of a name
UNKNOWN = "its name is not known"
#: Role of a column -> what it is.
_ROLES = {
    "air": "the surrounding air", "supply": "the supply", "at rest": "a length at rest",
    "raw": "a raw signal", "slack": "clipped, or a mark of slack",
    "a value": "the name of a value", "another axis": "an axis of something else than time",
    "ignored": "a column that the file leaves out",
}  # fmt: skip


def looked_at(data: bytes, name: str, correction: Correction) -> tuple[Table, tuple[Evidence, ...], Known]:
    """The table of a file, the claims about it, and what is known beside its columns."""
    sheets = sheets_of(data, name)
    table = table_of(sheets, name, wanted=correction.sheet, head=correction.head)
    table = replace(table, texts=(*table.texts, *(Span(*note) for note in correction.notes)))
    table = without_stated_marks(with_derived(with_levels(table, correction.columns)))
    evidence = tuple(evidence_of(table, name))
    known = known_of(table, evidence, name, correction)
    stated = {f"zero:{key.removesuffix('_zero')}" for key in known.conditions if key.endswith("_zero")}
    return table, tuple(e for e in evidence if e.facet not in stated), known


def reading_of(data: bytes, name: str, correction: Correction) -> Reading:
    """All that is known of a file once it is decided.

    Raises:
        InputError: nothing can be read from it, with the reason and what to do.
    """
    table, evidence, known = looked_at(data, name, correction)
    return decided(name, table, evidence, known, correction)


def decided(
    name: str, table: Table, evidence: tuple[Evidence, ...], known: Known, correction: Correction
) -> Reading:
    """The decision about a table, and its rows."""
    if not table.rows:
        raise _nothing(name, table, evidence)
    decision = decide(table, evidence, known.facts(table))
    nothing = not set(decision.uses) - {"time", "temperature"}
    if nothing and table.headless:
        raise _nothing(name, table, evidence)
    try:
        rows = rows_of(table, decision, known, evidence, correction)
    except InputError as error:
        raise (_nothing(name, table, evidence) if nothing else error) from None
    reading = Reading(name, table, evidence, known, decision, rows, correction)
    if nothing and not any(question.stops for question in questions_of(reading)):
        raise _nothing(name, table, evidence)
    return reading


def _nothing(name: str, table: Table, evidence: tuple[Evidence, ...]) -> InputError:
    """The refusal of a table in which no column is a channel."""
    heads = ", ".join(f"'{c.title}'" for c in table.columns[:12])
    if table.headless:
        why = (
            f"{name}: the file has no heads: say what its columns are; the first numbers are "
            f"{_first_numbers(table)}"
        )
        return InputError(
            why, field="columns", hint='--column "pressure=column 1 [bar]" --column "length=column 2 [mm]"'
        )
    raw: dict[str, Question] = {}
    for i in dict.fromkeys(e.target for e in evidence if e.facet == "role" and e.value == "raw"):
        column, own = table.columns[i], [e for e in evidence if e.target == i]
        claimed = {e.value for e in own if e.facet == "channel"} or {"pressure"}
        unit = next((e.value for e in own if e.facet == "unit"), None)
        if (wanted := next((c for c in SCALABLE if c in claimed), None)) is not None:
            label = f"{table.noun} '{column.title}'"
            raw.setdefault(wanted, scale_question(label, column, (wanted,), unit))
    if (asked := refusal(name, list(raw.values()))) is not None:
        return asked
    worded = [
        (c, next((w for w in c.words if kind_of(w) == TEXT), ""))
        for c in table.columns
        if c.words is not None
        and any(e.facet == "channel" and e.value in SLOTS for e in head_claims(c.head[:200], c.unit))
    ]
    if worded:
        column, word = worded[0]
        why = f"{name}, {table.noun} '{column.title}': it holds words, '{word[:40]}', and hardly a number"
        return InputError(why, field=f"{table.noun} {column.title}", hint="a number in each row")
    where = name if table.head_row is None else f"{name}, row {table.head_row}"
    near = (did_you_mean(word, CHANNEL_UNITS) or "" for c in table.columns for word in words_of(c.head)[:3])
    meant = next((hint for hint in near if hint.startswith("Did")), None)
    return InputError(
        f"{where}: no known channel among the {table.noun}s {heads}",
        field=f"{table.noun}s",
        hint=meant or "e.g. a header 'pressure_bar,length_mm,force_N'",
    )


def _first_numbers(table: Table) -> str:
    return ", ".join(f"{c.values[0]:g}" for c in table.columns[:8] if len(c.values))


def measurement_of(reading: Reading, questions: list[Question], id: str) -> Measurement:
    """The measurement of a reading; its questions have been answered or can wait.

    Raises:
        InputError: its channels fit no kind of measurement.
    """
    rows, table, known = reading.rows, reading.table, reading.known
    channels: dict[str, Any] = dict(rows.channels)
    conditions = dict(known.conditions)
    weights = weights_of_runs(channels)
    by_runs = "force" in rows.held or (weights is not None and np.ptp(weights) > 0.0)
    if by_runs and not set(_LOADS) & set(reading.correction.conditions):
        for key in _LOADS:  # of the first run, in its title
            conditions.pop(key, None)
    stated_kind = conditions.pop("kind", None)
    kind = reading.correction.kind or (None if stated_kind is None else str(stated_kind).lower())
    messages = [*table.messages, *known.messages, *said(reading), *rows.messages]
    messages += [
        f"{_rows(s.rows)} left out: {reason} (first: {s.first})" for reason, s in rows.skipped.items()
    ]
    messages += [f"{q.text} ({q.option})" for q in questions if not q.stops]
    fast = known.kind == "isotonic" and lifts_fast(channels)
    if kind is None and known.kind and not fast and _suits(known.kind, channels):
        kind = known.kind
        messages.append(f"kind {kind}: a text of the file says so")
    if kind is None and (more := _kind_by_more(reading, channels, conditions)) is not None:
        kind, why = more
        messages.append(f"kind {kind}: {why}")
    order = None if "time" in channels else order_of_rows(channels)
    if order is not None and "direction" not in channels:
        channels["direction"] = order.direction
        messages.append(
            "no time, but the rows go there and back step by step: their order is taken as that of the "
            "test, and the direction of "
            "each row from it"
        )
    if "group" in channels:
        channels["group"] = channels["group"].astype(np.int64)
    unread = unread_of(reading)
    messages += [
        f"{table.noun} '{title}' is not used: {why}"
        for title, why in unread
        if why != DISMISSED
        and any(
            c.title == title
            and (
                i in rows.dropped
                or any(e.facet == "channel" and e.rule not in _BY_NUMBERS for e in reading.own(i))
                or "a value" in reading.roles(i)
            )
            for i, c in enumerate(table.columns)
        )
    ]
    aside = (*table.dropped, *table.others)
    messages += [f"'{title}' is not read: {why}" for title, why in aside[:_MOST_OTHERS]]
    measurement = _built(
        unread,
        {c: channels[c] for c in CHANNEL_UNITS if c in channels},
        name=reading.name,
        id=id,
        kind=kind,
        origins={c: _origin(reading, c) for c in channels},
        ignored=[head for head, _ in unread],
        conditions=conditions,
        marked_slack=rows.slack,
        messages=messages,
        skipped={reason: s.rows for reason, s in rows.skipped.items()},
        starts=order.starts if order is not None else _starts(channels, weights),
    )
    return replace(
        measurement,
        by_rows=order is not None,
        unread=unread,
        undecided=_undecided(reading),
        stated=stated_of(reading, conditions),
        in_words=_in_words(reading),
        questions=tuple(questions),
        heads=heads_of(table),
        rig=rig_texts(table, reading.evidence),
    )


def _kind_by_more(
    reading: Reading, channels: Mapping[str, Any], conditions: Mapping[str, float | str]
) -> tuple[str, str] | None:
    """(kind, why) of readings over time that their channels do not tell: by a signal of the valve without a
    scale, or by the loads of the blocks.
    """
    moving = {"time", "pressure", "force"} <= set(channels) and bool(set(channels) & set(STROKES))
    if not moving or explain_kind(channels, conditions)[0] != "static":
        return None
    loaded = bool(set(_LOADS) & {*conditions, *reading.known.held})  # without one a transient says nothing
    for i, column in enumerate(reading.table.columns if loaded else ()):
        named = any(e.facet == "channel" and e.value == "command" for e in reading.own(i))
        if named and column.words is None and np.nanmax(column.values) > np.nanmin(column.values):
            return "transient", f"{reading.label(column)} is a command of the valve over time"
    load = reading.known.held.get("load_mass")
    if load is None:
        return None
    kind, why = explain_kind(channels, {**conditions, "load_mass": float(load.values[0])})
    return None if kind == "static" else (kind, why)


def _built(unread: Sequence[tuple[str, str]], columns: Mapping[str, Any], **said: Any) -> Measurement:
    """The measurement of columns; where they fit no kind, the columns that are not read are named."""
    try:
        return build(columns, **said)
    except InputError as error:
        if not unread:
            raise
        left = ", ".join(f"'{title}' ({why})" for title, why in unread[:_NAMED])
        raise InputError(f"{error.message}; not read: {left}", field=error.field, hint=error.hint) from error


def _rows(count: int) -> str:
    return "1 row" if count == 1 else f"{count} rows"


def _suits(kind: str, channels: Mapping[str, Array]) -> bool:
    """Whether the channels that a kind needs are there."""
    if kind == "transient" and "time" not in channels:
        return False
    needed = {"pressure", "force"} if kind in FORCE_KINDS else {"pressure"}
    return needed <= set(channels) and bool(set(channels) & set(STROKES))


def _starts(channels: Mapping[str, Array], weights: Array | None) -> tuple[int, ...]:
    """Rows at which a new part of the file begins: the group changes, and the time goes back."""
    if weights is not None and lifts_fast(channels):
        return starts_of_lifts(channels)
    if "group" not in channels or "time" not in channels:
        return (0,)
    apart = (np.diff(channels["group"]) != 0) & (np.diff(channels["time"]) < 0.0)
    return (0, *(int(row) + 1 for row in np.flatnonzero(apart)))


def _origin(reading: Reading, channel: str) -> tuple[str, str]:
    if channel in reading.rows.held:
        held = reading.rows.held[channel]
        return held.where, held.unit
    if channel in reading.decision.uses:
        i, use = reading.decision.uses[channel]
        return reading.table.columns[i].title, use.unit or CHANNEL_UNITS[channel]
    if channel in reading.rows.labels:
        return reading.table.columns[reading.rows.labels[channel]].title, CHANNEL_UNITS[channel]
    return FROM_ROWS, CHANNEL_UNITS.get(channel, "1")


def said(reading: Reading) -> list[str]:
    """What was decided for each channel, by the evidence that won, with its words and place."""
    lines = [f"{e.value}, which is not read" for e in reading.evidence if e.facet == "unread"]
    for channel, i, use, column in reading.uses():
        label = f"{reading.table.noun} '{column.title}'"
        if not reading.said_unit(channel) and not column.clock and channel != "command":
            lines.append(f"{label} has no unit: read as {use.unit}")
        units = [e for e in reading.own(i) if e.facet in ("unit", "unit_word") and e.value == use.unit]
        if units and i not in reading.known.chosen:
            best = max(units, key=lambda e: e.weight)
            if best.span.where != column.where:
                why = f", explained by {best.span.where}: '{best.span.text[:80]}'"
                lines.append(f"{label} is the {channel} in {use.unit}{why}")
            elif best.facet == "unit_word":
                lines.append(f"{label} is the {channel} in {use.unit}")
        raw = reading.unit(i)
        is_raw = raw not in (None, use.unit) and dimension_of(raw) in RAW
        if use.scale != 1.0 or use.offset or is_raw or any(e.facet == "scale" for e in reading.own(i)):
            first = ", and counts from its first row" if channel == "time" else ""
            lines.append(f"{label} is scaled: {_reason(reading, i, 'scale', None)}{first}")
        if use.sign == -1:
            facet = "sign_force" if channel == "force" else "sign_stroke"
            lines.append(f"{label} has its sign reversed: {_reason(reading, i, facet, -1)}")
        if channel == "pressure":
            air = reading.known.facts(reading.table).ambient
            if use.absolute:
                whose = (
                    "the standard atmosphere"
                    if isinstance(air, float) and air == 101_325.0
                    else "the surrounding air that the file states"
                )
                amount = (
                    f"{air:.0f} Pa subtracted"
                    if isinstance(air, float)
                    else "the pressure of the surrounding air is subtracted row by row"
                )
                lines.append(
                    f"{label} is absolute pressure: {amount}, {whose}; "
                    f"{_reason(reading, i, 'absolute', True)}"
                )
            elif not any(
                e.facet == "absolute" and e.target in (i, FILE) and e.rule != OWN_FORM
                for e in reading.evidence
            ):
                lines.append(f"{label} read as gauge pressure")
        if channel == "force" and (
            dimension_of(use.unit) == "mass" or (reading.by_user(channel) and use.unit in ("kgf", "gf"))
        ):
            lines.append(f"{label} is a mass: its weight is the force")
        if channel == "time" and all(e.rule in _BY_UNIT for e in reading.claims(i, channel)):
            lines.append(f"{label} is read as time by its unit")
        if channel == "pressure" and (because := though_at_the_valve(reading)):
            lines.append(f"{label} is read as pressure though it is named after the valve: {because}")
        if use.zero:
            reason = _reason(reading, i, f"zero:{channel}", None)
            done = "subtracted from" if use.zero > 0.0 else "added to"
            lines.append(f"{abs(use.zero):g} {CHANNEL_UNITS[channel]} is {done} the {channel}: {reason}")
    if "counter_pressure" in reading.decision.uses:
        title = reading.table.columns[reading.decision.uses["counter_pressure"][0]].title
        lines.append(f"'{title}' is read as the pressure of the second muscle of the joint")
    lines += [
        f"'{other}' runs against the pressure you took: in a joint of two muscles the force is that of both"
        for other in antagonists(reading)
    ]
    lines += [
        f"what the sensor of the {z.channel} shows at zero is already subtracted from the {z.channel}: "
        f"'{z.span.text[:80]}' ({z.span.where})"
        for z in stated_zeros(reading.table)
        if z.contained is False and z.channel in reading.rows.channels
    ]
    return lines


def _reason(reading: Reading, i: int, facet: str, value: object) -> str:
    """The words that decided, and where they stand; without any, what the readings show."""
    choice = reading.known.chosen.get(i)
    if choice is not None and (facet.startswith("sign") or getattr(choice, facet, None) is not None):
        return "you say so"
    found = [
        e
        for e in reading.evidence
        if e.facet == facet and e.target in (i, FILE) and (value is None or e.value == value)
    ]
    if not found:
        shown = [t for t, v in reading.decision.terms if t in MOTION and v > 0.0]
        of_stroke = f"so {shown[0]}" if shown else "its readings behave so"
        return f"no words say it, but {'a muscle pulls' if facet == 'sign_force' else of_stroke}"
    best = max(found, key=lambda e: e.weight)
    return f"'{best.span.text[:80]}' ({best.span.where})"


def unread_of(reading: Reading) -> tuple[tuple[str, str], ...]:
    """All columns that nothing is read from, and why."""
    used = {i for c, (i, _) in reading.decision.uses.items() if c in reading.rows.channels} | set(
        reading.rows.labels.values()
    )
    used |= {i for i, values in reading.known.columns.values() if len(values) == 1}
    found = [
        (column.title, _why_unread(reading, i, column))
        for i, column in enumerate(reading.table.columns)
        if i not in used
    ]
    return (*found, *reading.table.dropped, *reading.table.others)


def _why_unread(reading: Reading, i: int, column: Column) -> str:
    if i in reading.rows.dropped:
        return reading.rows.dropped[i]
    if i in reading.known.chosen:
        if reading.known.chosen[i] is not None:
            return "it cannot be read as you say"
        return DISMISSED if i in reading.known.dismissed else "you do not want it"
    own = reading.own(i)
    roles = _roles(reading, i)
    unit = next((e.value for e in own if e.facet == "unit"), None)
    if "raw" in roles and unit is not None and dimension_of(unit) in _SIGNALS:
        named = next((e.value for e in own if e.facet == "channel" and e.rule != "unit"), "calibrated value")
        return f"'{unit}' is {_SIGNALS[dimension_of(unit)]}, not a {named}"
    if roles:
        role = max(roles, key=lambda r: roles[r])
        return f"it is {_ROLES.get(role) or f'a {role}'}"
    if column.words is not None:
        return "it holds words"
    if roles_of(own).get("at the valve") and unit is not None and dimension_of(unit) == "pressure":
        return "it is the pressure at the valve"
    claimed = [e.value for e in own if e.facet == "channel" and e.rule not in _BY_NUMBERS]
    if claimed:
        taken = next((c for c in claimed if c in reading.decision.uses), None)
        if taken is not None:
            return f"{taken} is read from '{reading.table.columns[reading.decision.uses[taken][0]].title}'"
        return "its unit or its values do not fit its name"
    return UNKNOWN


def _undecided(reading: Reading) -> tuple[str, ...]:
    """Columns of numbers that nothing is read from because neither their name nor their unit tells what they
    are.
    """
    unread = {title for title, _ in unread_of(reading)}
    return tuple(
        column.title
        for i, column in enumerate(reading.table.columns)
        if column.title in unread
        and column.words is None
        and i not in (*reading.known.chosen, *reading.rows.dropped)
        and set(_roles(reading, i)) <= {"raw"}
        and not any(e.facet == "channel" and e.rule not in _BY_NUMBERS for e in reading.own(i))
    )


def _roles(reading: Reading, i: int) -> dict[str, float]:
    """What a column is instead of a channel, and what is said for it."""
    aside = ("measured", "less wanted", "words", "at the valve")
    return {role: weight for role, weight in reading.roles(i).items() if role not in aside}


def stated_of(reading: Reading, conditions: Mapping[str, float | str]) -> tuple[StatedValue, ...]:
    """What the test was, each value with its origin; units that were assumed are ``unit of <channel>``."""
    found = []
    for key, value in conditions.items():
        where = reading.known.stated.get(key)
        by_you = (
            where is not None
            and where.where.where == "you"
            and reading.correction.conditions.get(key) is not None
        )
        found.append(
            StatedValue(key, value, "you", "")
            if by_you
            else StatedValue(
                key, value, "file", f"{reading.name}, {where.where.where}" if where else reading.name
            )
        )
    for channel, (i, use) in reading.decision.uses.items():
        choice = reading.known.chosen.get(i)
        if choice is not None and choice.assumed:
            found.append(
                StatedValue(
                    f"{UNIT_OF}{channel}",
                    use.unit,
                    "assumed",
                    f"{reading.table.noun} '{reading.table.columns[i].title}'",
                )
            )
    return tuple(found)


def says_reference(reading: Reading) -> bool:
    """Whether the file or the user says what the pressure counts from."""
    i = reading.decision.uses["pressure"][0]
    choice = reading.known.chosen.get(i)
    said = (e.facet == "absolute" and e.target in (i, FILE) and e.rule != OWN_FORM for e in reading.evidence)
    return any(said) or (choice is not None and choice.absolute is not None)


def _in_words(reading: Reading) -> frozenset[str]:
    """Channels whose unit the file or the user says, and whether one of them says what the pressure counts
    from.
    """
    words = {c for c in reading.decision.uses if c in reading.rows.channels and reading.said_unit(c)}
    if "pressure" in reading.decision.uses and says_reference(reading):
        words.add(REFERENCE)
    return frozenset(words)
