"""Measurements from TDMS files (LabVIEW): channels with a unit, of one group or of several alike.

The unit is the property ``unit_string``; without a time channel the waveform's ``wf_increment`` gives the
time. Several groups with the same channels are runs of one measurement. Properties are conditions.
"""

from __future__ import annotations

import io
import logging
import re
import struct
from dataclasses import replace
from typing import Any

import numpy as np

from mckibben.measurement.read.conditions import CONDITION_UNITS, TEXT_CONDITIONS, Note, key_of
from mckibben.measurement.read.containers import NamedTable, stacked
from mckibben.measurement.read.correction import Correction
from mckibben.measurement.read.header import map_headers
from mckibben.measurement.read.limits import WORD, Allowance, check_variables, size_of
from mckibben.measurement.read.source import RawTable, array_source
from mckibben.measurement.read.stated import in_known_words, statements
from mckibben.measurement.read.vectors import sorted_out, time_axis
from mckibben.physics.errors import InputError, did_you_mean

_NOUN = "channel"
_MAX_GROUPS = 1000
_MAX_SEGMENTS = 200_000
_MAX_DIRECTORY = 16_000_000  # bytes of the directories of all segments
_MAX_OBJECTS = 2_000_000  # channels of all segments together
_MAX_PIECES = 8_000_000  # of the values of all channels; each takes microseconds
_MAX_SCALES = 8  # of a channel; each may double the work
_LEAD_IN = 28  # bytes before each segment: mark, flags, version, length, length of its directory
_BIG_ENDIAN = 1 << 6  # among the flags
_TIME = "time [s]"
_KEYS = (*CONDITION_UNITS, *TEXT_CONDITIONS, "kind", "bad_rows")


def open_tdms(data: bytes, name: str, correction: Correction | None = None) -> RawTable:
    """The table of a TDMS file.

    Raises:
        InputError: damaged, without channels that are named like ours, or without the group of the user.
    """
    groups, properties = _loaded(data, name)
    wanted = correction.sheet if correction else None
    notes = _notes(properties, name)
    tables: list[NamedTable] = []
    problem: InputError | None = None
    for title, (values, own) in groups.items():
        place = f"{name}, group '{title}'"
        try:
            columns, _, messages = sorted_out(values, place=place, noun=_NOUN)
        except InputError as error:
            problem = problem or error
            continue
        if columns:
            tables.append(
                NamedTable(title, columns, _notes(own, place, every=True), _texts(own, place), messages)
            )
    if wanted is not None:
        chosen = [table for table in tables if table.title == wanted]
        if tables and not chosen:
            hint = did_you_mean(wanted, [table.title for table in tables])
            raise InputError(f"{name}: there is no group '{wanted}' with channels", field="sheet", hint=hint)
        tables = chosen
    if not tables:
        raise problem or InputError(
            f"{name}: no channel holds numbers",
            field="channels",
            hint="e.g. channels 'pressure' and 'length'",
        )
    best = max(tables, key=NamedTable.known)
    most = best.known()
    if problem is not None and not most:
        raise problem
    alike = [table for table in tables if list(table.columns) == list(best.columns)]
    place = f"{name}, group '{best.title}'"
    others = [title for title in groups if title not in [table.title for table in alike]]
    if len(alike) > 1:
        best = stacked(alike, "")
        best.messages[-1] = f"{len(alike)} groups with the same channels are read as runs"
        place = name
    messages = [*best.messages, *(f"group '{title}' is not used" for title in others)]
    rivals = [table for table in tables if table not in alike and most >= 2 and table.known() >= most]
    own_notes = [note for note in best.notes if key_of(note.key)[0] in _KEYS]
    rest = [*_texts(properties, name), *best.rest]
    known = {note.key for note in (*notes, *own_notes)}
    stated = [note for note in statements(rest, name) if note.key not in known]
    source = array_source(
        best.columns,
        place=place,
        format="tdms",
        noun=_NOUN,
        notes=[*notes, *own_notes, *stated],
        messages=messages,
    )
    others_unread = tuple(
        (f"{title}/{head}", "it is in another group") for title in others for head in groups[title][0]
    )
    read = {table.title for table in alike}
    source = replace(
        source,
        unread=others_unread,
        tables=tuple((title, title in read) for title, (values, _) in groups.items() if values),
    )
    if rivals and wanted is None:
        choices = tuple((table.title, ", ".join(table.columns)[:80]) for table in (alike[0], *rivals))
        source = replace(source, choices=choices)
    return source


def _loaded(data: bytes, name: str) -> tuple[dict[str, tuple[dict[str, Any], dict]], dict]:
    """(group -> (channel with unit -> values, properties), properties of the file)."""
    _check_segments(data, name)
    from nptdms import TdmsFile
    from nptdms.log import log_manager

    log_manager.set_level(logging.ERROR)  # what matters is said in the refusal
    try:
        _check_pieces(data, name)
        with TdmsFile.open(io.BytesIO(data)) as file:
            channels = [channel for group in file.groups() for channel in group.channels()]
            # Every value takes at least a byte of the file: more of them are a lie of its directory.
            if sum(len(channel) for channel in channels) > len(data):
                raise ValueError("it declares more values than it holds")
            _check_size(file, name, len(data))
            groups = {}
            for group in file.groups()[:_MAX_GROUPS]:
                values = {_header(channel): _values(channel) for channel in group.channels()}
                _add_time(values, group.channels(), f"{name}, group '{group.name}'")
                groups[str(group.name)] = values, dict(group.properties)
            return groups, dict(file.properties)
    except (InputError, MemoryError):
        raise
    except Exception as error:  # npTDMS raises whatever a damaged segment leads to
        raise InputError(
            f"{name}: no channel can be read: the TDMS file is damaged "
            f"({type(error).__name__}: {str(error)[:100]})",
            field="file", hint="export it again, or save it as CSV",
        ) from error  # fmt: skip


def _check_segments(data: bytes, name: str) -> None:
    """Refuse a file that ends within a segment; npTDMS would read as far as it comes and say nothing."""
    position, number, directory = 0, 0, 0
    while position < len(data):
        number += 1
        lead = data[position : position + _LEAD_IN]
        if len(lead) < _LEAD_IN or lead[:4] != b"TDSm":
            raise _incomplete(name, number)
        order = ">" if lead[4] & _BIG_ENDIAN else "<"
        after, own = struct.unpack_from(f"{order}QQ", lead, 12)
        if position + _LEAD_IN + after > len(data):
            raise _incomplete(name, number)
        position += _LEAD_IN + after
        directory += own
        if number > _MAX_SEGMENTS or directory > _MAX_DIRECTORY:
            raise _in_pieces(
                name,
                f"it has more than {_MAX_SEGMENTS} segments, or {size_of(_MAX_DIRECTORY)} of directories",
            )


def _incomplete(name: str, number: int) -> InputError:
    return InputError(
        f"{name}: not every channel can be read: the TDMS file ends within segment {number}",
        field="file",
        hint="export it again, or save it as CSV",
    )


def _in_pieces(name: str, why: str) -> InputError:
    return InputError(
        f"{name}: no channel can be read: the values lie in too many pieces: {why}",
        field="file",
        hint="defragment it (LabVIEW's 'TDMS Defragment'), or save it as CSV",
    )


def _check_pieces(data: bytes, name: str) -> None:
    """Refuse a file whose values lie in more pieces than can be put together in reasonable time."""
    from nptdms.reader import TdmsReader

    objects = pieces = 0

    class Counting(TdmsReader):
        def _update_object_metadata(self, segment: Any) -> None:  # once for each segment
            nonlocal objects, pieces
            objects += len(segment.ordered_objects)
            if segment.num_chunks:
                pieces += segment.num_chunks * sum(bool(each.has_data) for each in segment.ordered_objects)
            if objects > _MAX_OBJECTS or pieces > _MAX_PIECES:
                raise _in_pieces(name, f"more than {_MAX_PIECES}, or {_MAX_OBJECTS} channels of segments")
            super()._update_object_metadata(segment)

    Counting(io.BytesIO(data)).read_metadata()


def _check_size(file: Any, name: str, size: int) -> None:
    """Refuse values that take more memory than is read, and scales whose count is no count."""
    allowance = Allowance(name, size)
    check_variables(sum(len(group.channels()) for group in file.groups()), name)
    for owner in (file, *(part for group in file.groups() for part in (group, *group.channels()))):
        scales = [
            int(number) for key in owner.properties for number in re.findall(r"^NI_Scale\[(\d+)\]", str(key))
        ]
        said = owner.properties.get("NI_Number_Of_Scales", 0)
        if max([0, int(said) - 1, *scales]) >= _MAX_SCALES:
            raise ValueError(f"it has more than {_MAX_SCALES} scales for a channel")
    for channel in (channel for group in file.groups() for channel in group.channels()):
        word = channel.dtype.kind not in "biuf"
        allowance.take((WORD if word else 8) * len(channel), f"channel '{channel.name}'")


def _header(channel: Any) -> str:
    """The channel's name, with its unit unless the name has one already."""
    name, unit = str(channel.name), str(channel.properties.get("unit_string") or "").strip()
    if not unit:
        return name
    meaning = map_headers([name or "?"], place="", collect=True)
    given = meaning.problems or (meaning.columns and meaning.columns[0].unit)
    return name if given else f"{name} [{unit}]"


def _values(channel: Any) -> Any:
    values = channel[:]
    if not isinstance(values, np.ndarray):
        return [str(value) for value in values]
    if values.dtype.kind == "M":  # time stamps count from the first
        return (values - values[0]) / np.timedelta64(1, "s") if len(values) else None
    if values.dtype == object:
        return [str(value) for value in values]
    return values


def _add_time(values: dict[str, Any], channels: list[Any], place: str) -> None:
    """A time axis from the waveform properties, where no channel is one."""
    if any(column.use == "time" for column in map_headers([*values, "?"], place=place, collect=True).columns):
        return
    for channel in channels:
        step, start = channel.properties.get("wf_increment"), channel.properties.get("wf_start_offset", 0.0)
        if isinstance(step, (int, float)) and np.isfinite(step) and step > 0.0 and len(channel) > 1:
            offset = float(start) if isinstance(start, (int, float)) and np.isfinite(start) else 0.0
            values[_TIME] = time_axis(offset, float(step), len(channel))
            return


def _notes(properties: dict, place: str, *, every: bool = False) -> list[Note]:
    """The properties that are conditions; LabVIEW adds many others, which ``every`` keeps."""
    found = [
        Note(f"{place}, property '{key}'", str(key), value if isinstance(value, (int, float)) else str(value))
        for key, value in properties.items()
        if not isinstance(value, bool)
    ]
    return [note for note in in_known_words(found) if every or key_of(note.key)[0] in _KEYS]


def _texts(properties: dict, place: str) -> list[tuple[str, str]]:
    """The properties that are texts, as what stands beside the channels."""
    return [
        (value, f"{place}, property '{key}'")
        for key, value in properties.items()
        if isinstance(value, str) and value.strip()
    ]
