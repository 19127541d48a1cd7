"""A measurement as the canonical CSV: channels in SI, conditions, and where each comes from."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mckibben.measurement.measurement import Measurement
from mckibben.measurement.reading.conditions import CONDITION_UNITS, TEXT_CONDITIONS

#: Channel -> header; the numbers are SI, so that they are exactly those that were read.
CHANNEL_HEADERS = {
    "time": "time_s", "pressure": "pressure_Pa", "force": "force_N", "length": "length_m",
    "contraction": "contraction_1", "displacement": "displacement_m", "diameter": "diameter_m",
    "velocity": "velocity_m/s", "command": "command_1", "temperature": "temperature_K",
    "angle": "angle_rad", "torque": "torque_N*m", "lever": "lever_m",
    "counter_pressure": "counter_pressure_Pa", "direction": "direction", "group": "group",
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class ConvertedFile:
    """The canonical file.

    Attributes:
        text: its content.
        rows: number of rows.
        messages: what was assumed while reading, and columns that are not read.
    """

    text: str
    rows: int
    messages: list[str]


def converted(measurement: Measurement) -> ConvertedFile:
    """The canonical file of a measurement; read again it gives the same channels.

    Rows that could not be read are not in it. Lines that begin with ``#`` hold the conditions, and for every
    channel the column and unit it was read from.
    """
    columns = [name for name in CHANNEL_HEADERS if name in measurement.columns]
    origins = {channel.name: channel for channel in measurement.channels}
    if "group" not in origins:
        columns.remove("group")  # found from the values, again when the file is read
    lines = [
        *_comments(measurement),
        ",".join([*(CHANNEL_HEADERS[name] for name in columns), *_slack_header(measurement)]),
    ]
    values = [measurement.columns[name].tolist() for name in columns]
    if _slack_header(measurement):
        values.append(measurement.slack.astype(int).tolist())
    lines += [",".join(_shown(value) for value in row) for row in zip(*values, strict=True)]
    unread = [f"column '{column}' is not read: {why}" for column, why in measurement.unread]
    return ConvertedFile("\n".join(lines) + "\n", measurement.rows, [*measurement.messages, *unread])


def _comments(measurement: Measurement) -> Iterator[str]:
    yield f"# kind: {measurement.kind}"
    yield "# pressure: gauge"
    for key, value in measurement.conditions.items():
        if key == "pressure" or (not isinstance(value, (int, float)) and not _plain(str(value))):
            continue
        unit = CONDITION_UNITS.get(key)
        yield f"# {key}: {value!r} {unit}" if unit and isinstance(value, float) else f"# {key}: {value}"
    yield f"# read from {_plain(measurement.name)} (SHA-256 {measurement.id})"
    for channel in measurement.channels:
        yield f"# {channel.name} is read from '{_plain(channel.column)}' in {channel.source_unit}"
    for stated in measurement.stated:
        if stated.key in CONDITION_UNITS or stated.key in TEXT_CONDITIONS:
            where = f" at {_plain(stated.where)}" if stated.where else ""
            yield f"# {stated.key} is said by {'the file' if stated.origin == 'file' else 'the user'}{where}"
    for column, why in measurement.unread:
        yield f"# column '{_plain(column)}' is not read, {_plain(why)}"
    for reason, rows in measurement.skipped.items():
        yield f"# {rows} rows could not be read, {_plain(reason)}"


def _plain(text: str) -> str:
    """A text on one line and without a colon, which would make a condition of it."""
    return " ".join(text.replace(":", " ").split())


def _slack_header(measurement: Measurement) -> list[str]:
    """A column for the rows that the source marks as slack, where the values alone do not show them."""
    if not measurement.slack.any() or "force" not in measurement.columns:
        return []
    zero = measurement.columns["force"] == 0.0
    shown = zero if np.count_nonzero(zero) >= 2 else np.zeros_like(zero)
    return [] if np.array_equal(shown, measurement.slack) else ["slack"]


def _shown(value: float) -> str:
    return str(value) if isinstance(value, int) else repr(value)
