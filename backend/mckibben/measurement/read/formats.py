"""Which format a file has, by its first bytes; the name only helps to say what is wrong."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import PurePath

from mckibben.measurement.read.correction import Correction
from mckibben.measurement.read.csv import open_csv
from mckibben.measurement.read.derived import with_derived
from mckibben.measurement.read.legend import told_units
from mckibben.measurement.read.limits import MAX_REMARKS, no_table
from mckibben.measurement.read.source import RawTable
from mckibben.physics.errors import InputError

_HDF5 = b"\x89HDF\r\n\x1a\n"
_BINARY = {
    ".h5": "an HDF5 file",
    ".hdf5": "an HDF5 file",
    ".xlsx": "an Excel workbook",
    ".mat": "a MATLAB file",
    ".tdms": "a TDMS file",
}
_CONTROL = re.compile(rb"[\x00-\x08\x0e-\x1f]")

#: First bytes -> (what the file is, what to do instead).
_REFUSED = {
    b"\xd0\xcf\x11\xe0": ("an old Excel workbook (.xls)", "save it as .xlsx or CSV"),
    b"TDSh": ("a TDMS index, without the data", "send the .tdms file beside it"),
    b"%PDF": ("a PDF document", "send the table itself, as CSV or .xlsx"),
    b"7z\xbc\xaf": ("a 7z archive", "unpack it first"),
    b"MATLAB 4": ("a MATLAB 4 file", "save it with -v7"),
}

#: First bytes -> what the file is.
_OTHER_KINDS = {
    b"SQLite format 3\0": "an SQLite database",
    b"\x93NUMPY": "an array of numpy",
}
#: Endings of texts that hold values and no table -> what the file is.
_NO_TABLE = {
    ".yaml": "a YAML text", ".yml": "a YAML text", ".toml": "a TOML text", ".xml": "an XML text",
    ".html": "a web page", ".htm": "a web page", ".tex": "a LaTeX text",
    ".m": "a script", ".py": "a script", ".r": "a script",
}  # fmt: skip
_MARKUP = re.compile(rb"(?i)(?:\xef\xbb\xbf)?\s*<(?:(\?xml)|!doctype html|html|table)\b")


def open_source(data: bytes, name: str, correction: Correction | None = None) -> RawTable:
    """The table of a file, with the columns that are computed from others.

    Raises:
        InputError: a format that is not read, or a damaged file.
    """
    chosen = {} if correction is None else correction.columns
    scales = {name: choice.scale for name, choice in chosen.items() if choice is not None and choice.scale}
    source = _with_first_remarks(_opened(data, name, correction))
    named = {name for name, choice in chosen.items() if choice is not None}
    return with_derived(_with_told_units(source), scales, named)


def _with_first_remarks(source: RawTable) -> RawTable:
    """The table with as many remarks as are searched: each one takes about a millisecond."""
    if len(source.rest) <= MAX_REMARKS:
        return source
    said = (
        f"only the first {MAX_REMARKS} of {len(source.rest)} remarks are searched for conditions of the test"
    )
    return replace(source, rest=source.rest[:MAX_REMARKS], messages=[*source.messages, said])


def _with_told_units(source: RawTable) -> RawTable:
    """The table with the units that sentences of the file tell of its columns."""
    units = [*source.units, *[None] * (len(source.headers) - len(source.units))]
    found, said = told_units(source.headers, units, source.rest)
    if not found:
        return source
    units = [found.get(index, unit) for index, unit in enumerate(units)]
    return replace(source, units=tuple(units), messages=[*source.messages, *said])


def _open_inner(data: bytes, name: str, correction: Correction | None) -> RawTable:
    """The table of a file that was packed in another one; an archive in an archive is not read.

    Raises:
        InputError: a format that is not read, or a damaged file.
    """
    if data.startswith((b"PK", b"\x1f\x8b")) and not name.lower().endswith(".xlsx"):
        raise InputError(
            f"{name}: no column can be read: an archive in an archive", field="file", hint="unpack it first"
        )
    return _opened(data, name, correction)


def _opened(data: bytes, name: str, correction: Correction | None = None) -> RawTable:
    """The table of a file; the correction says which sheet and head the user wants.

    Raises:
        InputError: a format that is not read, or a damaged file.
    """
    for first, (what, remedy) in _REFUSED.items():
        if data.startswith(first):
            raise InputError(f"{name}: no column can be read: the file is {what}", field="file", hint=remedy)
    # Each reader is imported when its format comes: together they take half a second.
    if data.startswith(b"PK"):
        from mckibben.measurement.read.archive import open_archive
        from mckibben.measurement.read.xlsx import open_xlsx

        found = open_archive(data, name, correction, _open_inner)
        return open_xlsx(data, name, correction) if found is None else found
    if data.startswith(b"\x1f\x8b"):
        from mckibben.measurement.read.archive import unpacked_gzip

        inner, name_inside = unpacked_gzip(data, name)
        source = _open_inner(inner, name_inside, correction)
        source.messages.append(f"the file is gzip-compressed: '{name_inside}' in it is read")
        return source
    for first, what in _OTHER_KINDS.items():
        if data.startswith(first):
            raise no_table(name, what)
    if data.startswith(b"TDSm"):
        from mckibben.measurement.read.tdms import open_tdms

        return open_tdms(data, name, correction)
    if any(data[offset : offset + 8] == _HDF5 for offset in (0, 512, 1024, 2048)):
        from mckibben.measurement.read.mat73 import open_mat73

        return open_mat73(data, name, correction)
    if data[:6] == b"MATLAB" or data[124:128] in (b"\x00\x01IM", b"\x01\x00MI"):
        from mckibben.measurement.read.mat import open_mat

        return open_mat(data, name, correction)
    suffix = PurePath(name).suffix.lower()
    if markup := _MARKUP.match(data[:4096]):
        raise no_table(name, _NO_TABLE[".xml" if markup[1] else ".html"])
    if suffix in _NO_TABLE:
        raise no_table(name, _NO_TABLE[suffix])
    expected = _BINARY.get(suffix)
    if expected is not None and (control := _CONTROL.search(data[:4096])):
        raise InputError(
            f"{name}: no column can be read: the file does not begin as {expected} does "
            f"(byte {control.start() + 1} is neither text nor a known mark)",
            field="file",
            hint="export it again, or save it as CSV",
        )
    source = open_csv(data, name, correction)
    if expected is not None:
        source.messages.append(f"the file is text, not {expected}: read as CSV")
    return source
