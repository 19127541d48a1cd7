"""Measurements packed into an archive: texts or one table in a .zip, a .gz."""

from __future__ import annotations

import io
import zipfile
import zlib
from collections.abc import Callable
from pathlib import PurePosixPath

from mckibben.measurement.read.correction import Correction
from mckibben.measurement.read.encodings import decoded_otherwise
from mckibben.measurement.read.limits import MAX_UNPACKED, Allowance, no_table
from mckibben.measurement.read.source import RawTable
from mckibben.physics.errors import InputError

_MOST_PARTS = 1000
_MAX_RATIO = 200  # of one part; number tables reach about 20
_RATIO_FROM = 1_000_000  # bytes
_TEXTS = (".csv", ".txt", ".tsv", ".dat", ".asc", ".prn", ".log", ".md", ".lvm")
_TABLES = (".xlsx", ".mat", ".h5", ".hdf5", ".json", ".tdms", ".jsonl")


#: How a file of an archive is opened: content, name, correction.
OpenPart = Callable[[bytes, str, Correction | None], RawTable]


def open_archive(
    data: bytes, name: str, correction: Correction | None, open_part: OpenPart
) -> RawTable | None:
    """The table of an archive that is no Excel workbook; None = it is one, or holds nothing that is read.

    Args:
        data: the archive.
        name: of the file.
        correction: what the user says of it.
        open_part: opens a file of the archive.

    Raises:
        InputError: damaged, protected, compressed too far, or without a table.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            parts = [
                part for part in archive.infolist() if not part.is_dir() and "__MACOSX" not in part.filename
            ]
            names = {part.filename for part in parts}
            if "xl/workbook.xml" in names or any(one.startswith("xl/") for one in names):
                return None
            if "content.xml" in names and "mimetype" in names:
                raise no_table(name, "an OpenDocument file")
            if names and all(one.endswith(".npy") for one in names):
                raise no_table(name, "an archive of numpy's arrays (.npz)")
            wanted = [p for p in parts if PurePosixPath(p.filename).suffix.lower() in (*_TEXTS, *_TABLES)]
            if not wanted:
                return None
            _check(parts, name, len(data))
            return _of_parts(archive, wanted, name, correction, open_part)
    except (zipfile.BadZipFile, EOFError, NotImplementedError, OSError, zlib.error) as error:
        raise _refused(
            name, "the archive is damaged and cannot be unpacked", "create the archive again"
        ) from error


def _refused(name: str, why: str, hint: str) -> InputError:
    return InputError(f"{name}: no column can be read: {why}", field="file", hint=hint)


def _check(parts: list[zipfile.ZipInfo], name: str, size: int) -> None:
    """Refuse an archive that unpacks to more than is read, or is protected."""
    if len(parts) > _MOST_PARTS:
        raise _refused(
            name, f"the archive has {len(parts)} parts, at most {_MOST_PARTS} are read", "split it"
        )
    Allowance(name, size).take(sum(part.file_size for part in parts), "all parts of the archive")
    for part in parts:
        if part.flag_bits & 1:
            raise _refused(name, "the archive is protected by a password", "create it without a password")
        if part.file_size > max(_RATIO_FROM, _MAX_RATIO * part.compress_size):
            why = f"its part '{part.filename[:80]}' is compressed too far, more than {_MAX_RATIO} times"
            raise _refused(name, why, "send the file itself")


def _of_parts(
    archive: zipfile.ZipFile,
    parts: list[zipfile.ZipInfo],
    name: str,
    correction: Correction | None,
    open_part: OpenPart,
) -> RawTable:
    """One file of an archive, or several texts as blocks under their names."""
    tables = [p for p in parts if PurePosixPath(p.filename).suffix.lower() in _TABLES]
    texts = [p for p in parts if p not in tables]
    if tables and (len(tables) > 1 or any(PurePosixPath(p.filename).suffix.lower() == ".csv" for p in texts)):
        shown = ", ".join(f"'{part.filename[:40]}'" for part in parts[:6])
        raise _refused(name, f"the archive holds several tables, {shown}", "send one of them, or texts only")
    if tables or len(texts) == 1:
        (part,) = tables or texts
        source = open_part(archive.read(part), f"{name}/{PurePosixPath(part.filename).name}", correction)
        source.messages.append(f"'{part.filename}' in the archive is read")
        return source
    pieces = [(PurePosixPath(p.filename).stem, _decoded(archive.read(p))) for p in texts]
    numbered = [(stem, text) for stem, text in pieces if sum(c.isdigit() for c in text) > len(text) / 5]
    remarks = [text for stem, text in pieces if (stem, text) not in numbered]
    whole = "\n".join([*remarks, *(f"\n# {stem.replace('_', ' ')}\n{text}" for stem, text in numbered)])
    source = open_part(whole.encode(), f"{name}.txt", correction)
    shown = ", ".join(part.filename for part in texts[:6])
    source.messages.append(f"the texts of the archive are read one after another: {shown[:200]}")
    return source


def _decoded(data: bytes) -> str:
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return data.decode("utf-16", "replace")
    try:
        return data.decode("utf-8-sig").replace("\r\n", "\n")
    except UnicodeDecodeError:
        return decoded_otherwise(data)[0].replace("\r\n", "\n")


def unpacked_gzip(data: bytes, name: str) -> tuple[bytes, str]:
    """(content, its name) of a gzip-compressed file.

    Raises:
        InputError: damaged, or it unpacks to more than is read.
    """
    unpacker = zlib.decompressobj(wbits=31)
    try:
        content = unpacker.decompress(data, min(MAX_UNPACKED, _MAX_RATIO * len(data) + _RATIO_FROM))
    except zlib.error as error:
        raise _refused(name, f"the compressed file is damaged ({error})", "compress it again") from error
    if unpacker.unconsumed_tail or not unpacker.eof:
        why = "the compressed file is incomplete, or unpacks to more than can be read"
        raise _refused(name, why, "unpack it first")
    inside = name[:-3] if name.lower().endswith(".gz") else name
    return content, inside
