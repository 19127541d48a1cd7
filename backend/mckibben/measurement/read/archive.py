"""Measurements packed into an archive: texts in a .zip, arrays in an .npz, a LibreOffice sheet, a .gz."""

from __future__ import annotations

import io
import math
import zipfile
import zlib
from collections.abc import Callable
from contextlib import suppress
from pathlib import PurePosixPath
from typing import Any
from xml.etree.ElementTree import Element, ParseError, XMLParser

import numpy as np

from mckibben.measurement.read.cells import Cell
from mckibben.measurement.read.correction import Correction
from mckibben.measurement.read.encodings import decoded_otherwise
from mckibben.measurement.read.limits import MAX_UNPACKED, Allowance
from mckibben.measurement.read.source import RawTable
from mckibben.physics.errors import InputError

_MOST_PARTS = 1000
_MAX_RATIO = 200  # of one part; number tables reach about 20
_RATIO_FROM = 1_000_000  # bytes
_TEXTS = (".csv", ".txt", ".tsv", ".dat", ".asc", ".prn", ".log", ".md", ".lvm")
_TABLES = (".xlsx", ".mat", ".h5", ".hdf5", ".json", ".tdms", ".xml", ".yaml", ".yml", ".jsonl", ".npz")
_MOST_REPEATED = 1000  # rows or columns of one kind
_MOST_CELLS = 4_000_000
_DIGITS = 10  # of a number of repetitions
_LONGEST_OFFICE = 40_000_000  # bytes
_OFFICE = "{urn:oasis:names:tc:opendocument:xmlns:office:1.0}"
_TABLE = "{urn:oasis:names:tc:opendocument:xmlns:table:1.0}"


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
                _check(parts, name, len(data))
                return _of_office(archive.read("content.xml"), name, correction)
            if names and all(one.endswith(".npy") for one in names):
                _check(parts, name, len(data))
                return _of_arrays(archive, parts, name, correction)
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


def _of_arrays(
    archive: zipfile.ZipFile, parts: list[zipfile.ZipInfo], name: str, correction: Correction | None
) -> RawTable:
    """The arrays of numpy's ``savez``; nothing that needs unpickling is read."""
    from mckibben.measurement.read.mat import choose

    values: dict[str, Any] = {}
    for part in parts:
        key = part.filename.removesuffix(".npy")
        try:
            array = _array_of(archive.read(part))
        except ValueError:
            continue
        if array.dtype.names:
            values |= {field: array[field] for field in array.dtype.names}
        elif array.dtype.kind in "US":
            values[key] = (
                str(array.reshape(-1)[0]) if array.size == 1 else [str(v) for v in array.reshape(-1)]
            )
        elif array.dtype.kind in "biuf":
            values[key] = array
    if not values:
        raise _refused(name, "its arrays hold no numbers", "save vectors of numbers")
    return choose(values, name, correction)


def _array_of(content: bytes) -> np.ndarray:
    """An array as numpy saves it, where its bytes are all there; raises ValueError."""
    stream = io.BytesIO(content)
    version = np.lib.format.read_magic(stream)
    read = np.lib.format.read_array_header_1_0 if version == (1, 0) else np.lib.format.read_array_header_2_0
    shape, _, kind = read(stream)
    if kind.hasobject or math.prod(shape) * max(kind.itemsize, 1) > len(content):
        raise ValueError("objects, or fewer bytes than its head says")
    return np.load(io.BytesIO(content), allow_pickle=False)


def _of_office(content: bytes, name: str, correction: Correction | None) -> RawTable:
    """The sheets of an OpenDocument spreadsheet."""
    from mckibben.measurement.read.xlsx import open_sheets

    if len(content) > _LONGEST_OFFICE:
        why = f"the document unpacks to more than {_LONGEST_OFFICE} bytes"
        raise _refused(name, why, "save it as .xlsx or CSV")
    if b"<!ENTITY" in content or b"<!DOCTYPE" in content:
        raise _refused(name, "the document defines entities of its own", "save it as .xlsx or CSV")
    try:
        parser = XMLParser()
        parser.feed(content)
        root = parser.close()
    except ParseError as error:
        raise _refused(name, f"the document is damaged ({error})", "save it as .xlsx or CSV") from error
    sheets = []
    left = [_MOST_CELLS]
    for table in root.iter(f"{_TABLE}table"):
        rows = _rows_of(table, left)
        if left[0] < 0:
            raise _refused(name, f"the document has more than {_MOST_CELLS} cells", "save it as CSV")
        if rows:
            sheets.append((str(table.get(f"{_TABLE}name") or "sheet")[:40], rows))
    if not sheets:
        raise _refused(name, "the document holds no sheet with rows", "save it as .xlsx or CSV")
    return open_sheets(sheets, name, correction)


def _rows_of(table: Element, left: list[int]) -> list[tuple[int, tuple[Cell, ...]]]:
    """Number and cells of the rows that are filled; ``left``: cells that may still be read."""
    rows: list[tuple[int, tuple[Cell, ...]]] = []
    number = 0
    for row in table.iter(f"{_TABLE}table-row"):
        cells: list[Cell] = []
        for cell in row:
            again = min(_times(cell.get(f"{_TABLE}number-columns-repeated")), _MOST_REPEATED)
            if len(cells) + again > left[0]:
                left[0] = -1
                return rows
            cells += [_cell(cell)] * again
        while cells and cells[-1] in (None, ""):
            cells.pop()
        times = _times(row.get(f"{_TABLE}number-rows-repeated"))
        left[0] -= len(cells) * min(times, _MOST_REPEATED)
        if left[0] < 0:
            return rows
        if cells:
            rows += [(number + k + 1, tuple(cells)) for k in range(min(times, _MOST_REPEATED))]
        number += times
    return rows


def _times(text: str | None) -> int:
    """How often a cell or row is repeated; once where that is no number."""
    return int(text) if text is not None and text.isdecimal() and len(text) < _DIGITS else 1


def _cell(cell: Element) -> Cell:
    """A number, or the text that is shown."""
    kind = cell.get(f"{_OFFICE}value-type")
    if kind in ("float", "percentage", "currency"):
        with suppress(ValueError):  # no number: what is shown then
            return float(cell.get(f"{_OFFICE}value") or "nan")
    if kind == "date":
        return cell.get(f"{_OFFICE}date-value")
    text = " ".join("".join(paragraph.itertext()) for paragraph in cell if paragraph.tag.endswith("}p"))
    return text or None


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
