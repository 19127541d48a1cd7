"""What of a measurement file is read at most, whatever it says of itself, and the refusal of anything else.

A small file may unpack to any size. What one file becomes is counted before memory is taken for it, over
all its parts, with 8 bytes for a number however short it is written; reading a file takes at most four times
`MAX_UNPACKED`. What the readers do not foresee ends at `seconds_for` its size or `MOST_MEMORY`,
see `process.py`.
"""

from __future__ import annotations

import zlib
from collections.abc import Iterator

from mckibben.physics.errors import InputError

_LEAST_SECONDS, _SECONDS_PER_MB, MOST_SECONDS = 10, 4, 240  # of processor time; files take below 1 s a MB
MOST_MEMORY = 2_000_000_000  # bytes beside what the program has taken before
MAX_UNPACKED = 256_000_000  # bytes
MAX_ROWS = 6_000_000
MAX_COLUMNS = 1000
MAX_ROW_LENGTH = 200_000  # characters of a row of a text
MAX_VARIABLES = 2000
MAX_BYTES = 200_000_000  # of a file
MAX_CELLS = 24_000_000
MAX_SHEETS = 300
MAX_TEXT = 1000  # characters of a remark
MAX_TEXTS = 2000  # remarks that are searched for what they say of the test
MAX_DEPTH = 8  # of names within names
MAX_NODES = 100_000  # of a tree
WORD = 64  # bytes that a short text takes
_PIECE = 1_000_000  # bytes
SPLIT = "split the file, or keep every second row"


def seconds_for(size: int) -> int:
    """Processor time that reading a file of so many bytes may take [s]."""
    return min(MOST_SECONDS, _LEAST_SECONDS + int(_SECONDS_PER_MB * size / 1e6))


def size_of(size: int) -> str:
    """A number of bytes for people: ``0.9 MB``."""
    return f"{size / 1e6:.3g} MB" if size < 1e9 else f"{size / 1e9:.3g} GB"


class Allowance:
    """What a file may still become in memory.

    Args:
        name: file name, for the refusal.
        size: of the file [bytes].
    """

    def __init__(self, name: str, size: int) -> None:
        self._name = name
        self._size = size
        self._taken = 0

    def take(self, size: int, part: str) -> None:
        """Count what a part of the file becomes [bytes]; ``part`` names it.

        Raises:
            InputError: it is too much, together with the parts before it.
        """
        self._taken += size
        if self._taken > MAX_UNPACKED:
            raise InputError(
                f"{self._name}, {part}: the file of {size_of(self._size)} unpacks to at least "
                f"{size_of(self._taken)}, at most {size_of(MAX_UNPACKED)} are read",
                field=part,
                hint=f"{SPLIT}; save only what belongs to the measurement",
            )


def check_columns(columns: int, place: str, field: str) -> None:
    """Refuse a table of too many columns."""
    if columns > MAX_COLUMNS:
        raise InputError(
            f"{place}: the table has {columns} columns, at most {MAX_COLUMNS} columns are read",
            field=field,
            hint="keep the columns of the measurement; check the separator",
        )


def check_variables(count: int, name: str) -> None:
    """Refuse a file of too many variables."""
    if count > MAX_VARIABLES:
        raise InputError(
            f"{name}: the file has more than {MAX_VARIABLES} variables, more than can be read",
            field="variables",
            hint="save only those of the measurement",
        )


def inflated(data: memoryview) -> Iterator[bytes]:
    """The content of a zlib stream in pieces; bytes behind its end are passed over.

    Raises:
        zlib.error: damaged, or not complete.
    """
    unpacker = zlib.decompressobj()
    for begin in range(0, len(data), _PIECE):
        packed = bytes(data[begin : begin + _PIECE])
        while packed and not unpacker.eof:
            if piece := unpacker.decompress(packed, _PIECE):
                yield piece
            packed = unpacker.unconsumed_tail
        if unpacker.eof:
            return
    # What is left after all input was taken comes without any.
    while piece := unpacker.decompress(b"", _PIECE):
        yield piece
    if not unpacker.eof:
        raise zlib.error("the stream is not complete")
