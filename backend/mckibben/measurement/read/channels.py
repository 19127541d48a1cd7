"""Columns of a table to channels in SI, and the rows whose values cannot be."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.measurement import CHANNEL_UNITS
from mckibben.measurement.read.air import AIR, Air, air_of_rows, ambient_of
from mckibben.measurement.read.cells import CellTable, Labels, no_rows
from mckibben.measurement.read.conditions import Constant
from mckibben.measurement.read.correction import SAMPLE, SLACK
from mckibben.measurement.read.directions import direction_of
from mckibben.measurement.read.head_text import channel_number
from mckibben.measurement.read.plain_head import TEXT_COLUMNS, HeaderColumn
from mckibben.measurement.read.plausible import ENOUGH, proposal
from mckibben.measurement.read.sentinels import sentinels_in
from mckibben.measurement.read.signs import (
    COMPRESSION_POSITIVE,
    EXTENSION_POSITIVE,
    FORCE_SIGN,
    STROKE_SIGN,
)
from mckibben.measurement.read.stated import REFERENCE_OF
from mckibben.measurement.read.unit_words import CLOCK
from mckibben.physics.errors import InputError
from mckibben.physics.units import convert

LARGEST = 1e100  # no physical value is; keeps sums and ranges of a column finite
_NO_NUMBER = (9e36, 1.1e38)  # what instruments send for "overflow" and "no number"
_SENTINELS = (-9999.0, -999.0, -99999.0, -999.25, -9999.99, 9999.0, 99999.0, 999999.0)
_FAR = 3.0  # times all other numbers of the column
_SERIAL = (32_000.0, 62_000.0)  # days; the years 1987 to 2069
_LONGEST_TEST = 30.0  # days
_EPOCH = 1e8  # s; a later time counts from 1970, not from the beginning of the test
_ZERO_CELSIUS = 150.0  # a temperature without unit below it is in °C


@dataclass
class ChannelReading:
    """What the conversion of columns reads and adds to."""

    place: str
    noun: str
    table: CellTable
    conditions: dict[str, float | str]
    messages: list[str]
    ignored: list[str]
    skip: bool = False
    clocks: frozenset[int] = frozenset()
    texts: Sequence[tuple[str, str]] = ()
    air: Constant | None = None

    @property
    def ambient(self) -> Air:
        """Pressure of the surrounding air [Pa]: one per row where a column holds it, else one for all."""
        return ambient_of(self.conditions) if self.air is None else air_of_rows(self.table, self.air)

    def drop(self, column: HeaderColumn, why: str) -> None:
        """Do not use a column."""
        self.ignored.append(column.header)
        self.messages.append(f"{self.noun} '{column.header}' is not used: {why}")


class _Values(NamedTuple):
    """A column in SI; ``bad`` rows cannot be, because ``what``; ``hint`` says what would be right."""

    si: NDArray[np.float64]
    bad: NDArray[np.bool_]
    what: str
    hint: str


def read_channels(
    columns: list[HeaderColumn], reading: ChannelReading
) -> tuple[dict[str, NDArray], dict[str, HeaderColumn], NDArray[np.bool_] | None]:
    """(channel -> values in SI, channel -> its column, rows marked as slack).

    Raises:
        InputError: a value that no physical quantity has, naming its row and column (unless such rows are
            skipped).
    """
    units: dict[str, HeaderColumn] = {}
    for column in [c for c in columns if c.use not in TEXT_COLUMNS]:
        _without_sentinels(column, reading)
        known = _with_known_unit(column, reading)
        if known is None:
            continue
        values = _values(known, reading)
        if values.bad.any():
            if not reading.skip:
                raise _value_error(reading, known, values)
            first = f"row {int(reading.table.lines[int(np.argmax(values.bad))])}"
            where = f"{first}, {reading.noun} '{column.header}'"
            reading.table = reading.table.only(~values.bad, values.what, where)
            if not len(reading.table.lines):
                raise no_rows(reading.place, reading.table.skipped)
        units[column.use] = known
    channels: dict[str, NDArray] = {}
    for use, column in units.items():  # once no further row goes
        channels[use] = _values(column, reading).si
    for use, column in units.items():
        if use == "pressure":
            _say_reference(column, reading)
    by_use = {column.use: column for column in columns}
    slack = _read_labels(by_use, channels, reading)
    return channels, by_use | units, slack


def _without_sentinels(column: HeaderColumn, reading: ChannelReading) -> None:
    """Leave out rows with a number that stands for none: 9.9E37 of instruments, -9999 far from all others."""
    raw = reading.table.numbers[column.place]
    odd = (np.abs(raw) >= _NO_NUMBER[0]) & (np.abs(raw) <= _NO_NUMBER[1])
    if column.use != "time":
        for value in _SENTINELS:
            same = raw == value
            if (
                same.any()
                and not same.all()
                and _FAR * float(np.max(np.abs(raw[~(same | odd)]), initial=0.0)) < abs(value)
            ):
                odd |= same
    if column.use != "time":
        for value in sentinels_in(reading.texts, column.use):
            odd |= np.abs(raw - value) <= 1e-9 * abs(value)
    if not odd.any() or 2 * int(np.count_nonzero(odd)) > len(raw):
        return
    first = int(np.argmax(odd))
    where = f"row {int(reading.table.lines[first])}, {reading.noun} '{column.header}'"
    reading.table = reading.table.only(~odd, f"{raw[first]:g} means no reading", where)


def _with_known_unit(column: HeaderColumn, reading: ChannelReading) -> HeaderColumn | None:
    """The column with a unit, guessed from its numbers where none is given; None = no such channel."""
    raw = reading.table.numbers[column.place]
    use, unit, origin = column.use, column.unit, column.unit_origin
    if use == "time" and (unit == CLOCK or column.place in reading.clocks):
        unit = "s"
        reading.messages.append(
            f"{reading.noun} '{column.header}' holds times: they count from the first row"
        )
    if use == "time" and unit is None and (since := _since_1970(raw)) is not None:
        unit = since
        reading.messages.append(f"{reading.noun} '{column.header}' counts {unit} since 1970")
    if use == "time" and unit is None and _are_serial_days(raw):
        unit = "day"
        reading.messages.append(f"{reading.noun} '{column.header}' counts days as spreadsheets do")
    if unit is None:
        unit, origin = CHANNEL_UNITS[use], "proposed"
        largest = float(np.max(np.abs(raw)))
        if use == "contraction" and largest > 1.5:
            unit = "%"
        elif use == "temperature" and largest < _ZERO_CELSIUS:
            unit = "degC"
        elif len(raw) >= ENOUGH and use not in ("command", "temperature"):
            unit = proposal(use, raw).unit
        if use != "command":
            reading.messages.append(f"{reading.noun} '{column.header}' has no unit: read as {unit}")
    if use == "time" and float(raw[0]) * convert([1.0], unit, "s")[0] > _EPOCH:
        reading.messages.append(f"{reading.noun} '{column.header}' counts from 1970: its first row is 0 s")
    label = f"{reading.place}, {reading.noun} '{column.header}'"
    values = convert(raw, unit, CHANNEL_UNITS[use], field=label)
    if use == "command" and np.max(np.abs(values)) > 1.001:
        reading.drop(column, "a command is the share of valve opening, -1 to 1")
        return None
    if use == "pressure":
        column = column._replace(absolute=_absolute(column, reading.conditions))
    if use in ("force", "displacement", "contraction"):
        column = _signed(column, reading)
    return column._replace(unit=unit, unit_origin=origin)


def _since_1970(raw: NDArray[np.float64]) -> str | None:
    """The unit of times that can only count from 1970: dates of 2001 to 2096; None = they do not."""
    for unit, size in (("ms", 1e12), ("µs", 1e15), ("ns", 1e18)):
        if len(raw) and size <= float(np.min(raw)) and float(np.max(raw)) <= 4.0 * size:
            return unit
    return None


def _are_serial_days(raw: NDArray[np.float64]) -> bool:
    """Whether times are dates as spreadsheets keep them: days since 1900 with fractions."""
    if not len(raw) or not (_SERIAL[0] <= float(np.min(raw)) and float(np.max(raw)) <= _SERIAL[1]):
        return False
    return bool(np.ptp(raw) < _LONGEST_TEST and np.any(raw != np.round(raw)))


def _signed(column: HeaderColumn, reading: ChannelReading) -> HeaderColumn:
    """A force or stroke, turned where the file says that it counts the other way."""
    said = COMPRESSION_POSITIVE if column.use == "force" else EXTENSION_POSITIVE
    key = FORCE_SIGN if column.use == "force" else STROKE_SIGN
    if column.origin == "you" or reading.conditions.get(key) != said:
        return column
    why = f"the file says that {said.replace(' ', ' is ')}"
    message = f"{reading.noun} '{column.header}' has its sign reversed: {why}"
    if message not in reading.messages:
        reading.messages.append(message)
    return column._replace(sign=-1, extends=False)


def _absolute(column: HeaderColumn, conditions: Mapping[str, float | str]) -> bool | None:
    if column.absolute is not None:
        return column.absolute
    own = conditions.get(f"{REFERENCE_OF}{channel_number(column.header)}")
    said = str(own or conditions.get("pressure", "")).lower()
    return True if said.startswith("abs") else False if said.startswith(("gauge", "rel")) else None


def _values(column: HeaderColumn, reading: ChannelReading) -> _Values:
    """One numeric column in SI, and which of its rows cannot be."""
    raw = reading.table.numbers[column.place]
    use = column.use
    unit = column.unit or CHANNEL_UNITS[use]
    values = convert(raw, unit, CHANNEL_UNITS[use])
    huge = ~(np.abs(values) < LARGEST)
    if huge.any():
        return _Values(values, huge, "is too large", "a number of physical size")
    if column.sign < 0:
        np.negative(values, out=values)
    if use == "time" and len(values) and values[0] > _EPOCH:
        values -= values[0]
    if use == "pressure":
        if column.absolute:
            values -= reading.ambient
        hint = "write 'pressure_abs_bar' or '# pressure: absolute' if it is absolute; gauge is assumed"
        return _Values(values, values < -reading.ambient, "is a negative absolute pressure", hint)
    if use in ("length", "diameter", "temperature"):
        return _Values(values, values <= 0.0, f"is not a {use}", f"a {use} above 0")
    if use == "contraction":
        hint = "contraction is (L0 - L)/L0 < 1; percent is 'contraction_pct'"
        return _Values(values, values >= 1.0, "is not possible", hint)
    return _Values(values, np.zeros(len(values), bool), "", "")


def _say_reference(column: HeaderColumn, reading: ChannelReading) -> None:
    label = f"{reading.noun} '{column.header}'"
    if column.absolute and reading.air is not None:
        reading.messages.append(
            f"{label} is absolute pressure: the pressure of the surrounding air is subtracted row by row, "
            f"{', '.join(reading.air.values[:2])} ..."
        )
    elif column.absolute:
        stated = AIR in reading.conditions and reading.ambient == reading.conditions[AIR]
        whose = "the surrounding air that the file states" if stated else "the standard atmosphere"
        reading.messages.append(f"{label} is absolute pressure: {reading.ambient:.0f} Pa subtracted, {whose}")
    elif column.absolute is None:
        reading.messages.append(f"{label} read as gauge pressure")


def _value_error(reading: ChannelReading, column: HeaderColumn, values: _Values) -> InputError:
    first, count = int(np.argmax(values.bad)), int(np.count_nonzero(values.bad))
    line, value = int(reading.table.lines[first]), reading.table.numbers[column.place][first]
    more = f" (and {count - 1} more such rows)" if count > 1 else ""
    unit = f" {column.unit}" if column.unit else ""
    return InputError(
        f"{reading.place}, row {line}, {reading.noun} '{column.header}': {value:g}{unit} {values.what}{more}",
        field=f"row {line}, {reading.noun} {column.header}", hint=values.hint,
    )  # fmt: skip


def _read_labels(
    by_use: Mapping[str, HeaderColumn], columns: dict[str, NDArray], reading: ChannelReading
) -> NDArray[np.bool_] | None:
    """Add direction, group and sample; returns the rows marked as slack."""
    labels = {use: reading.table.labels[c.place] for use, c in by_use.items() if use in TEXT_COLUMNS}
    if "group" in labels:
        columns["group"] = _group(labels["group"])
    if "direction" in labels:
        direction = direction_of(labels["direction"], columns, reading.messages)
        if direction is None:
            reading.drop(by_use["direction"], "its words are not known, e.g. 'filling' and 'venting'")
        else:
            columns["direction"] = direction
    if SAMPLE in labels:
        words = labels[SAMPLE].words
        if len(words) == 1 and words[0]:
            reading.conditions.setdefault("sample", words[0][:200])
        else:
            reading.drop(by_use[SAMPLE], "it names several muscles")
    if SLACK not in labels:
        return None
    marks = {"0": False, "0.0": False, "false": False, "1": True, "1.0": True, "true": True}
    words = [word.lower() for word in labels[SLACK].words]
    if "force" not in columns or any(word not in marks for word in words):
        reading.drop(by_use[SLACK], "slack is marked by 0 and 1, and needs a force column")
        return None
    return np.array([marks[word] for word in words])[labels[SLACK].codes]


def _group(labels: Labels) -> NDArray[np.int64]:
    """Integer labels as they are, other words numbered from 0 in order of appearance."""
    whole = [int(word) if re.fullmatch(r"[+-]?[0-9]{1,9}", word) else None for word in labels.words]
    numbers = [n for n in whole if n is not None]
    chosen = numbers if len(set(numbers)) == len(labels.words) else range(len(labels.words))
    return np.array(chosen, dtype=np.int64)[labels.codes]
