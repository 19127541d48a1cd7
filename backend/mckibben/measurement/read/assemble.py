"""From the table of a file to a Measurement: headers, conditions, rows, channels."""

from __future__ import annotations

from typing import NamedTuple

from mckibben.measurement.measurement import CHANNEL_UNITS, Measurement, build
from mckibben.measurement.read.cells import CellTable, Skip
from mckibben.measurement.read.channels import ChannelReading, read_channels
from mckibben.measurement.read.conditions import read_conditions
from mckibben.measurement.read.correction import Correction
from mckibben.measurement.read.header import TEXT_COLUMNS, HeaderColumn, Meaning, map_headers
from mckibben.measurement.read.source import RawTable


class Read(NamedTuple):
    """A table read: its measurement, and how it was come by."""

    measurement: Measurement
    columns: list[HeaderColumn]
    skipped: dict[str, Skip]


def meaning_of(source: RawTable, correction: Correction, *, collect: bool = False) -> Meaning:
    """What the columns of a source are."""
    return map_headers(
        source.headers,
        place=source.place,
        row=source.header_row,
        noun=source.noun,
        chosen=correction.columns,
        collect=collect,
    )


def conditions_of(source: RawTable, correction: Correction, messages: list[str]) -> dict[str, float | str]:
    """Conditions of the file, the user's over them."""
    conditions = read_conditions(source.notes, messages)
    for key, value in correction.conditions.items():
        if value is None:
            conditions.pop(key, None)
        else:
            conditions[key] = value
    return conditions


def rows_of(source: RawTable, columns: list[HeaderColumn], *, skip: bool) -> CellTable:
    """The rows of the columns that are used."""
    numeric = [c.place for c in columns if c.use not in TEXT_COLUMNS]
    text = [c.place for c in columns if c.use in TEXT_COLUMNS]
    return source.read(numeric, text, skip)


def assemble(
    source: RawTable, *, name: str, id: str, correction: Correction, meaning: Meaning | None = None
) -> Read:
    """The measurement of a table.

    Raises:
        InputError: whatever is wrong with it, naming file, row, column or key, and the remedy.
    """
    messages = list(source.messages)
    conditions = conditions_of(source, correction, messages)
    meaning = meaning or meaning_of(source, correction)
    messages += meaning.messages
    skip = correction.skip_bad_rows or str(conditions.get("bad_rows", "")).lower() == "skip"
    table = rows_of(source, meaning.columns, skip=skip)
    reading = ChannelReading(
        source.place, source.noun, table, conditions, messages, list(meaning.ignored), skip
    )
    columns, by_use, slack = read_channels(meaning.columns, reading)
    skipped = dict(reading.table.skipped)
    for reason, left_out in skipped.items():
        messages.append(f"{left_out.rows} rows left out: {reason} (first: {left_out.first})")
    kind = conditions.pop("kind", None) if correction.kind is None else correction.kind
    conditions.pop("kind", None)
    order = {header: index for index, header in reversed(list(enumerate(source.headers)))}
    measurement = build(
        columns,
        name=name,
        id=id,
        kind=None if kind is None else str(kind).lower(),
        origins={c: (by_use[c].header, by_use[c].unit or CHANNEL_UNITS[c]) for c in columns},
        ignored=sorted(reading.ignored, key=lambda header: order.get(header, len(order))),
        conditions=conditions,
        marked_slack=slack,
        messages=messages,
        skipped={reason: left_out.rows for reason, left_out in skipped.items()},
    )
    return Read(measurement, list(by_use.values()), skipped)
