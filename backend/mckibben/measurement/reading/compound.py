"""Compound files (OLE2), in which .xls workbooks are: their chains of sectors are checked before a library
follows them, because one that leads back into itself would take all memory.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

_FREE, _LAST = 0xFFFFFFFA, 0xFFFFFFFE  # numbers from which a sector is none; the end of a chain
_HEADER, _ENTRY, _SMALL = (
    512,
    128,
    4096,
)  # bytes of the header, of an entry of the directory, of a stream in sectors
_STREAM, _ROOT = 2, 5  # kinds of entries
_IN_HEADER = 109  # sectors of the table that the header names


def has_sound_chains(data: bytes) -> bool:
    """Whether each chain of a compound file ends, and no two of them meet; each sector is looked at once."""
    shift = int.from_bytes(data[30:32], "little")
    if len(data) < 2 * _HEADER or shift not in (9, 12):
        return False
    words = 1 << (shift - 2)
    body = data[1 << shift :]
    sectors = np.frombuffer(body[: len(body) - len(body) % (4 * words)], "<u4").reshape(-1, words)
    head = np.frombuffer(data[:_HEADER], "<u4")
    table = _table(head, sectors)
    if table is None:
        return False
    seen = np.zeros(max(len(table), len(sectors)), bool)
    directory = _chain(int(head[12]), table, seen)
    if directory is None or any(sector >= len(sectors) for sector in directory):
        return False
    entries = sectors[directory].reshape(-1, _ENTRY // 4)
    kinds = (entries[:, 16] >> 16) & 0xFF
    large = ((kinds == _STREAM) & (entries[:, 30] >= _SMALL)) | (kinds == _ROOT)
    starts = [int(head[15]), *(int(start) for start in entries[large, 29])]
    return all(_chain(start, table, seen) is not None for start in starts)


def _table(head: NDArray[np.uint32], sectors: NDArray[np.uint32]) -> NDArray[np.uint32] | None:
    """Sector -> the next one of its chain; None = the table cannot be put together."""
    places = [int(place) for place in head[19 : 19 + _IN_HEADER] if place < _FREE]
    following, seen = int(head[17]), set[int]()
    while following < _FREE:
        if following in seen or following >= len(sectors):
            return None
        seen.add(following)
        places += [int(place) for place in sectors[following][:-1] if place < _FREE]
        following = int(sectors[following][-1])
    if len(set(places)) < len(places) or any(place >= len(sectors) for place in places):
        return None
    return sectors[places].ravel() if places else None


def _chain(start: int, table: NDArray[np.uint32], seen: NDArray[np.bool_]) -> list[int] | None:
    """The sectors of a chain; None = it leads out of the file, or to a sector that was seen before."""
    found: list[int] = []
    place = start
    while place < _FREE:
        if place >= len(table) or seen[place]:
            return None
        seen[place] = True
        found.append(place)
        place = int(table[place])
    return found if place == _LAST or not found else None
