"""Limits of TDMS files (LabVIEW), checked before their library takes time or memory on their word."""

from __future__ import annotations

import io
import re
import struct
from typing import Any

from mckibben.measurement.reading.limits import WORD, Allowance, check_variables, size_of
from mckibben.physics.errors import InputError

_MAX_SEGMENTS = 200_000
_MAX_DIRECTORY = 16_000_000  # bytes of the directories of all segments
_MAX_OBJECTS = 2_000_000  # channels of all segments together
_MAX_PIECES = 8_000_000  # of the values of all channels; each takes microseconds
_MAX_SCALES = 8  # of a channel; each may double the work
_LEAD_IN = 28  # bytes before each segment: mark, flags, version, length, length of its directory
_BIG_ENDIAN = 1 << 6  # among the flags


def check_segments(data: bytes, name: str) -> None:
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


def check_pieces(data: bytes, name: str) -> None:
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


def check_size(file: Any, name: str, size: int) -> None:
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
