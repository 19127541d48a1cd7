"""Columns computed from those of a file: seconds and nanoseconds as one time, volts by a stated scale."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.read.calibrations import calibration_of, is_raw_share, says_zero_of_bridge
from mckibben.measurement.read.cells import CellTable
from mckibben.measurement.read.counters import time_of_count, valve_states_of
from mckibben.measurement.read.head_text import CHANNEL_NUMBER, taken_apart
from mckibben.measurement.read.positions import falls_with_shortening
from mckibben.measurement.read.recognise import recognise
from mckibben.measurement.read.scales import (
    Scale,
    said_scale,
    says_zero,
    scale_in,
    scale_of,
    valve_scale_of,
    zero_in,
)
from mckibben.measurement.read.source import RawTable
from mckibben.measurement.read.unit_words import (
    BRIDGE,
    COUNT,
    FULL_SCALE,
    RAW_DIMENSIONS,
    dimension_of,
    unit_of,
)
from mckibben.measurement.read.vocabulary import channel_of_word, proper_channel, words_of
from mckibben.physics.units import convert

_PARTS = {"ms": 1e3, "us": 1e6, "µs": 1e6, "ns": 1e9}  # of a second, and how many it has
_FRACTION = re.compile(r":[0-9]{2}:[0-9]{2}[.,:][0-9]+\s*$")  # of a second
_MOST_SCALED = 40  # columns
_NUMBERED = re.compile(rf"(?<![^\W_]){CHANNEL_NUMBER.pattern.removeprefix('(?i)')}", re.IGNORECASE)


@dataclass(frozen=True)
class _Derived:
    """A column: the one of the file, times ``factor`` plus ``offset``, plus the other one times its share.

    ``from_first``: its first value counts as 0.
    """

    place: int
    factor: float = 1.0
    offset: float = 0.0
    fraction: int | None = None
    share: float = 0.0
    from_first: bool = False

    def of(self, numbers: dict[int, NDArray[np.float64]]) -> NDArray[np.float64]:
        """The values; seconds count from the first one, as sums of large and small numbers lose digits."""
        values = numbers[self.place]
        if self.fraction is not None:
            return (values - values[0]) + numbers[self.fraction] * self.share
        if self.from_first:
            return (values - values[0]) * self.factor
        return values if self.factor == 1.0 and not self.offset else values * self.factor + self.offset


def with_derived(
    source: RawTable,
    scales: Mapping[str, str] = MappingProxyType({}),
    named: Collection[str] = (),
) -> RawTable:
    """The table with computed columns in the place of those that they are computed from.

    Args:
        source: the table.
        scales: name of a column -> its scale, as the user says it.
        named: columns whose channel the user says; what a text says of a position does not change them.
    """
    columns = [_Derived(index) for index in range(len(source.headers))]
    headers, units = (
        list(source.headers),
        [*source.units, *[None] * (len(source.headers) - len(source.units))],
    )
    stood = [
        f"{header} [{unit}]" if unit and taken_apart(header).unit is None else header
        for header, unit in zip(headers, units, strict=True)
    ]
    said: list[str] = []
    unzeroed: set[int] = set()
    pair = _seconds_and_parts(source)
    if pair is not None:
        whole, part, share = pair
        columns[whole] = _Derived(whole, fraction=part, share=1.0 / share)
        names = f"{headers[whole]} and {headers[part]}"
        said.append(
            f"time is the sum of '{headers[whole]}' and '{headers[part]}': it counts from the first row"
        )
        headers[whole], units[whole] = f"time from {names} [s]", None
        del columns[part], headers[part], units[part], stood[part]
    for index, column in enumerate(columns[:_MOST_SCALED]):
        own = _own_scale(headers[index], index, scales)
        if own is not None:
            columns[index] = replace(column, factor=own.factor, offset=own.offset)
            said.append(f"{source.noun} '{headers[index]}' is read by the scale that you stated, {own.text}")
            headers[index], units[index] = _bare(headers[index]), own.unit
            continue
        scale = (
            None
            if column.fraction is not None
            else _scale(source, columns[index].place, headers[index], units[index])
        )
        names = {headers[index], _bare(headers[index]), f"column {index + 1}"}
        if scale is not None and dimension_of(scale.raw) == "a length" and names & set(named):
            continue
        if scale is not None:
            bare = scale.raw == BRIDGE and not scale.offset and not says_zero_of_bridge(source.rest)
            unzeroed |= {index} if bare or not scale.zeroed else set()
            columns[index] = replace(column, factor=scale.factor, offset=scale.offset)
            said.append(
                f"{source.noun} '{headers[index]}' is read by its scale, {scale.text} ({scale.where})"
            )
            name = _bare(headers[index])
            headers[index] = name if name == scale.name else f"{name}: {scale.name}"
            units[index] = scale.unit
    said += _counted(source, columns, headers, units)
    if not said:
        return source
    messages = [*source.messages, *said]
    return replace(
        _mapped(source, columns), headers=headers, units=tuple(units), messages=messages,
        unzeroed=frozenset(unzeroed), stood=tuple(stood),
    )  # fmt: skip


def _counted(
    source: RawTable, columns: list[_Derived], headers: list[str], units: list[str | None]
) -> list[str]:
    """Give columns of counts the meaning that a text states: a time, the share of opening of a valve."""
    known = [recognise(header, unit) for header, unit in zip(headers, units, strict=True)]
    channels = {one.channel for one in known} | {"time" for index in source.clocks if index < len(headers)}
    said: list[str] = []
    texts = [*source.rest, *((f"{note.key}: {note.value}", note.where) for note in source.notes)]
    for index, header in enumerate(headers[:_MOST_SCALED]):
        column, head = columns[index], taken_apart(header, units[index])
        if known[index].channel not in (None, "command") or column != _Derived(column.place):
            continue
        counted = None
        stated = known[index].channel == "command"
        if "time" not in channels and head.unit is None and not stated:
            shown = _numbers(source, column.place)
            rising = len(shown) > 1 and all(b > a for a, b in pairwise(shown))
            by_one = rising and all(b - a == 1.0 for a, b in pairwise(shown))
            counted = time_of_count(head.name, texts, by_one=by_one) if rising else None
        if counted is not None:
            columns[index] = _Derived(column.place, counted.factor, from_first=True)
            headers[index], units[index] = f"{header} (time)", "s"
            said.append(
                f"{source.noun} '{header}' is read as time, {counted.text} ({counted.where}); it counts from "
                "the first row"
            )
            channels.add("time")
        elif (stated or "command" not in channels) and (
            valve := valve_states_of(head.name, head.unit, texts)
        ) is not None:
            columns[index] = _Derived(column.place, valve.factor, valve.offset)
            headers[index], units[index] = f"{head.name}: {valve.name}", valve.unit
            said.append(
                f"{source.noun} '{header}' is read as the command of the valve, {valve.text} ({valve.where})"
            )
            channels.add("command")
    return said


def _own_scale(header: str, index: int, scales: Mapping[str, str]) -> Scale | None:
    text = next((scales[n] for n in (header, _bare(header), f"column {index + 1}") if n in scales), None)
    return None if text is None else said_scale(text)


def _bare(header: str) -> str:
    return taken_apart(header).name or header


def _mapped(source: RawTable, columns: Sequence[_Derived]) -> RawTable:
    """The table with other columns."""

    def read(numeric: Sequence[int], text: Sequence[int], skip: bool) -> CellTable:
        wanted = [columns[index] for index in numeric]
        needed = dict.fromkeys(
            [c.place for c in wanted] + [c.fraction for c in wanted if c.fraction is not None]
        )
        words = {index: columns[index].place for index in text}
        table = source.read(list(needed), list(words.values()), skip)
        return table._replace(
            numbers={index: columns[index].of(table.numbers) for index in numeric},
            labels={index: table.labels[place] for index, place in words.items()},
        )

    places = [column.place for column in columns]
    raw = source.raw
    if raw is not None:
        kept = tuple(raw.places[place] if place < len(raw.places) else None for place in places)
        raw = replace(raw, places=kept)
    sample = [[row[place] if place < len(row) else "" for place in places] for row in source.sample]
    clocks = frozenset(index for index, place in enumerate(places) if place in source.clocks)
    return replace(source, read=read, sample=sample, raw=raw, clocks=clocks)


def _seconds_and_parts(source: RawTable) -> tuple[int, int, float] | None:
    """(column of seconds, column of the rest, parts of a second) where two columns of one name are a time."""
    found: dict[tuple[str, ...], list[tuple[int, str]]] = {}
    for index, header in enumerate(source.headers):
        head = taken_apart(header, source.units[index] if index < len(source.units) else None)
        words = words_of(head.name)
        unit = unit_of(words[-1]) if words and head.unit is None else None
        name, kind = (words[:-1], unit.unit) if unit is not None else (words, head.unit or "")
        if kind == "s" or kind in _PARTS:
            found.setdefault(
                tuple(word for word in name if word not in ("nano", "micro", "milli")), []
            ).append((index, kind))
    for pair in found.values():
        kinds = [kind for _, kind in pair]
        if len(pair) != 2 or kinds.count("s") != 1:
            continue
        (whole,) = (index for index, kind in pair if kind == "s")
        ((part, kind),) = ((index, kind) for index, kind in pair if kind != "s")
        shown = _numbers(source, part)
        steady = _numbers(source, whole)
        if shown and steady and max(shown) < _PARTS[kind] and all(value == int(value) for value in steady):
            return whole, part, _PARTS[kind]
    return _clock_and_parts(source)


def _clock_and_parts(source: RawTable) -> tuple[int, int, float] | None:
    """The same for a column of dates or times without fractions and one beside it, named ``ms``."""
    for part, header in enumerate(source.headers):
        unit = unit_of(header)
        beside = [index for index in (part - 1, part + 1) if index in source.clocks]
        if unit is None or unit.unit not in _PARTS or len(beside) != 1:
            continue
        (whole,) = beside
        times = [row[whole] for row in source.sample if whole < len(row)]
        shown = _numbers(source, part)
        if shown and max(shown) < _PARTS[unit.unit] and not any(map(_FRACTION.search, times)):
            return whole, part, _PARTS[unit.unit]
    return None


def _numbers(source: RawTable, index: int) -> list[float]:
    try:
        return [float(row[index]) for row in source.sample if index < len(row) and row[index]]
    except ValueError:
        return []


def _scale(source: RawTable, index: int, header: str, unit: str | None) -> Scale | None:
    """The scale that the texts of the file state for a column of a signal, by its name or by what it is."""
    texts = [*source.rest, *((f"{note.key}: {note.value}", note.where) for note in source.notes)]
    named = _named_scale(source, index, header, unit)
    if named is not None:
        return _with_zero(named, texts)
    heads = [
        (head, source.units[i] if i < len(source.units) else None) for i, head in enumerate(source.headers)
    ]
    found = calibration_of(header, unit, heads, texts)
    return None if found is None else _with_zero(found, texts)


def _with_zero(scale: Scale, texts: Sequence[tuple[str, str]]) -> Scale | None:
    """The scale with the zero of its signal that another text states; None = it is open whether to add it.

    It counts where that text names the same quantity.
    """
    if scale.offset:
        return scale
    if dimension_of(scale.unit) == "a length" and falls_with_shortening(scale.text, scale.where, texts):
        return scale._replace(factor=-scale.factor)
    channel = proper_channel(recognise(scale.name, scale.unit).channel)
    for text, where in texts:
        if where == scale.where or channel is None:
            continue
        named = {proper_channel(c) for word in words_of(text) if (c := channel_of_word(word)) is not None}
        if channel not in named:
            continue
        zero = zero_in(text, scale.raw)
        if zero is not None:
            return scale._replace(offset=-scale.factor * zero, text=f"{scale.text} and '{text[:60]}'")
        if says_zero(text, scale.unit):
            return None
    return scale


def _named_scale(source: RawTable, index: int, header: str, unit: str | None) -> Scale | None:
    """The scale that a text states for a column that it names."""
    head = taken_apart(header, unit)
    share = is_raw_share(head.name, head.unit) or (
        head.unit == "%" and recognise(head.name).channel == "displacement"
    )
    if head.unit is None or not (dimension_of(head.unit) in RAW_DIMENSIONS or share):
        return None
    measured = dimension_of(FULL_SCALE if share else head.unit)
    for text, where in _by_channels(source.rest):
        found = scale_of(text, head.name, where)
        named = found is not None
        if found is None and _names_only(text, index, source.headers):
            found = scale_in(text, where)
        if found is None or not found.zeroed or dimension_of(found.raw) != measured:
            continue
        plain = share or head.unit in (COUNT, BRIDGE, FULL_SCALE)
        per = 1.0 if plain else float(convert([1.0], head.unit, found.raw)[0])
        known = recognise(found.name, found.unit) if named else recognise(head.name)
        name = found.name if named and known.channel is not None else head.name
        return found._replace(factor=found.factor * per, name=name)
    if not any(channel_of_word(word) == "command" for word in words_of(head.name)):
        return None
    for text, where in source.rest:
        found = valve_scale_of(text, where)
        if found is not None and dimension_of(found.raw) == dimension_of(head.unit):
            return found._replace(factor=found.factor * float(convert([1.0], head.unit, found.raw)[0]))
    return None


def _by_channels(texts: Sequence[tuple[str, str]]) -> Iterator[tuple[str, str]]:
    """Each text; of one that states scales of several channels what it says of each: "CH1: .. CH2: ..".

    >>> [text for text, _ in _by_channels([("Scale CH1: 2 bar/V CH2: 50 N/V", "line 2")])]
    ['CH1: 2 bar/V', 'CH2: 50 N/V']
    """
    for text, where in texts:
        begins = [match.start() for match in _NUMBERED.finditer(text)]
        parts = [text[a:b].strip(" ,;|") for a, b in pairwise([*begins, len(text)])]
        scaled = len(parts) > 1 and sum(scale_in(part, where) is not None for part in parts) > 1
        yield from ((part, where) for part in parts) if scaled else ((text, where),)


def _names_only(text: str, index: int, headers: Sequence[str]) -> bool:
    """Whether a text names this column and no other one, by its name or by the number of its channel."""
    named = [place for place, header in enumerate(headers) if _is_named(text, header)]
    return named == [index]


def _is_named(text: str, header: str) -> bool:
    name = _bare(header)
    number = CHANNEL_NUMBER.match(name)
    names = [name] if number is None else [number[0].strip(), name[number.end() :].strip()]
    return any(
        len(one) > 1 and re.search(rf"(?i)(?<!\w){re.escape(one)}(?!\w)", text) is not None for one in names
    )
