"""Small files that become large: built by hand, for no library writes them."""

from __future__ import annotations

import io
import re
import struct
import zipfile
import zlib
from collections.abc import Callable, Iterator, Sequence
from functools import cache
from typing import NamedTuple

import h5py
import numpy as np

from tests.robustness import files

MATLAB = b"MATLAB 5.0 MAT-file".ljust(124) + b"\x00\x01IM"
DOUBLE, UINT8, CHAR, CELL, STRUCT = 6, 9, 4, 1, 2  # classes of a matrix
_SHEET = "xl/worksheets/sheet2.xml"
_STRINGS = "xl/sharedStrings.xml"
_OOXML = "application/vnd.openxmlformats-officedocument.spreadsheetml"


class Hostile(NamedTuple):
    """A file that must be refused, and words of the refusal; without words it may be read as well."""

    name: str
    content: bytes
    words: tuple[str, ...]


@cache
def hostile() -> list[Hostile]:
    """All of them; made when first asked for, which takes some seconds."""
    return [Hostile(*made) for part in _parts() for made in part()]


def one_of_each_format() -> list[Hostile]:
    """The first of each format, made in no time."""
    return [Hostile(*next(part())) for part in _parts()]


def _parts() -> tuple[Callable[[], _Files], ...]:
    return _mat5, _mat73, _workbooks, _tdms, _csv


def element(kind: int, data: bytes) -> bytes:
    """An element of a MATLAB file."""
    return struct.pack("<II", kind, len(data)) + data + b"\0" * (-len(data) % 8)


def matrix(name: bytes, kind: int, content: bytes, shape: Sequence[int]) -> bytes:
    """A variable; ``content``: the elements behind its name."""
    head = element(6, struct.pack("<II", kind, 0)) + element(5, struct.pack(f"<{len(shape)}i", *shape))
    return element(14, head + element(1, name) + content)


def packed(variable: bytes, level: int = 9) -> bytes:
    """A variable as save -v7 writes it."""
    content = zlib.compress(variable, level)
    return struct.pack("<II", 15, len(content)) + content


def doubles(name: bytes, values: np.ndarray, level: int = 1) -> bytes:
    """A packed vector."""
    return packed(matrix(name, DOUBLE, element(9, values.astype("<f8").tobytes()), (len(values), 1)), level)


_Files = Iterator[tuple[str, bytes, tuple[str, ...]]]


def _mat5() -> _Files:
    zeros = packed(matrix(b"x", DOUBLE, element(9, b"\0" * 30_000_000), (3_750_000, 1)))
    yield (
        "bomb.mat", MATLAB + zeros * 30,
        ("variables 1 to 30", "0.877 MB", "at least 900 MB", "at most 256 MB", "every second row"),
    )  # fmt: skip
    text = packed(matrix(b"t", CHAR, element(2, b"a" * 100_000_000), (1, 100_000_000)))
    yield "texts.mat", MATLAB + text * 3, ("variables 1 to 3", "300 MB", "256 MB")
    yield "text.mat", MATLAB + text, ("no array of numbers",)
    short = packed(matrix(b"pressure_bar", UINT8, element(2, b"\1" * 40_000_000), (40_000_000, 1)))
    yield "short.mat", MATLAB + short, ("variable 'pressure_bar'", "320 MB", "256 MB")
    words = packed(matrix(b"direction", CHAR, element(16, b"ab" * 5_000_000), (5_000_000, 2)))
    yield "words.mat", MATLAB + words, ("variable 'direction'", "360 MB", "256 MB")
    small = matrix(b"x", DOUBLE, element(9, b"\0" * 80), (10, 1))
    large = matrix(b"x", DOUBLE, element(9, b"\0" * 80_000_000), (10_000_000, 1))
    lie = packed(small[:4] + struct.pack("<I", 96) + large[8:])
    yield "lie.mat", MATLAB + lie, ("variable 1 unpacks to more than the 104 bytes it says",)
    tail = zlib.compress(small + b"\0" * 80_000_000, 9)
    behind = struct.pack("<II", 15, len(tail)) + tail
    yield "behind.mat", MATLAB + behind, ("variable 1 unpacks to more than the 144 bytes it says",)
    promise = packed(struct.pack("<II", 14, 250_000_000) + small[8:])
    yield "promise.mat", MATLAB + promise, ("variable 1 is not complete",)
    shape = struct.pack("<i", 2) * 20_000_000
    sizes = element(14, element(6, struct.pack("<II", 6, 0)) + element(5, shape) + small[40:])
    yield "sizes.mat", MATLAB + packed(sizes), ("variable 1 has the size 2x2x2x2",)
    name = matrix(b"n" * 30_000_000, DOUBLE, element(9, b"\0" * 80), (10, 1))
    yield "name.mat", MATLAB + packed(name), ("a name has 30000000 characters",)
    yield "variables.mat", MATLAB + packed(small) * 3000, ("more than 2000 variables",)
    names = b"".join(b"%07d\0" % number for number in range(500_000))
    fields = element(5, struct.pack("<i", 8)) + element(1, names) + struct.pack("<II", 14, 0) * 500_000
    yield "fields.mat", MATLAB + packed(matrix(b"s", STRUCT, fields, (1, 1))), ("more than 2000 variables",)
    rows = [doubles(name, np.ones(7_000_000)) for name in (b"pressure_bar", b"length_mm", b"force_N")]
    yield "rows.mat", MATLAB + b"".join(rows), ("7000000 rows, at most 6000000", "every second row")


def _hdf5(fill: Callable[[h5py.File], None]) -> bytes:
    stream = io.BytesIO()
    with h5py.File(stream, "w", userblock_size=512) as file:
        for name, values in files.COLUMNS.items():
            file.create_dataset(name, data=values[None, :])
        fill(file)
    return stream.getvalue()


def _mat73() -> _Files:
    def shape(file: h5py.File) -> None:
        file.create_dataset("x", (1, 10**9), "f8", chunks=(1, 100_000), compression="gzip")

    yield "shape.mat", _hdf5(shape), ("variable 'x'", "8 GB", "256 MB")

    def short(file: h5py.File) -> None:
        file.create_dataset("x", (1, 40_000_000), "u1", chunks=(1, 100_000), compression="gzip")

    yield "short73.mat", _hdf5(short), ("variable 'x'", "320 MB", "256 MB")

    def inflated(file: h5py.File) -> None:
        data = file.create_dataset("x", (1, 40), "f8", compression="gzip", chunks=(1, 40))
        data.id.write_direct_chunk((0, 0), zlib.compress(b"\0" * 200_000_000))

    yield (
        "inflated.mat",
        _hdf5(inflated),
        ("variable 'x' has a piece that unpacks to more than its 320 bytes",),
    )

    def twice(file: h5py.File) -> None:
        plan = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
        plan.set_chunk((1, 40))
        plan.set_deflate(9)
        plan.set_deflate(9)
        space = h5py.h5s.create_simple((1, 40))
        data = h5py.h5d.create(file.id, b"x", h5py.h5t.IEEE_F64LE, space, dcpl=plan)
        data.write_direct_chunk((0, 0), zlib.compress(zlib.compress(b"\0" * 100_000_000)))

    yield "twice.mat", _hdf5(twice), ("variable 'x' is not kept in the file in a known way",)

    def wide(file: h5py.File) -> None:
        data = file.create_dataset(
            "x", (1, 40), "f8", chunks=(1, 10**8), maxshape=(1, None), compression="gzip"
        )
        data.id.write_direct_chunk((0, 0), zlib.compress(b"\0" * 8000))

    yield "wide.mat", _hdf5(wide), ("variable 'x' is kept in pieces of 800000000 bytes, at most 32000000",)

    def scattered(file: h5py.File) -> None:
        file.create_dataset("x", data=np.arange(60_000.0)[None, :], chunks=(1, 1))

    yield "scattered.mat", _hdf5(scattered), ("variable 'x' is kept in 60000 pieces, at most 50000",)

    def cells(file: h5py.File) -> None:
        word = file.create_dataset("#refs#/a", data=np.frombuffer("up".encode("utf-16-le"), np.uint16))
        word.attrs["MATLAB_class"] = np.bytes_("char")
        references = np.full((1, 300_000), word.ref, dtype=h5py.ref_dtype)
        file.create_dataset("direction", data=references, dtype=h5py.ref_dtype, compression="gzip")

    yield "words73.mat", _hdf5(cells), ("variable 'direction' holds 300000 texts, at most 200000",)


def archive(parts: dict[str, bytes]) -> bytes:
    """A ZIP archive."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as file:
        for name, content in parts.items():
            file.writestr(name, content)
    return stream.getvalue()


def parts_of(content: bytes) -> dict[str, bytes]:
    """The parts of a ZIP archive."""
    with zipfile.ZipFile(io.BytesIO(content)) as file:
        return {name: file.read(name) for name in file.namelist()}


def workbook() -> dict[str, bytes]:
    """The parts of the good workbook with shared strings, without the size its sheet says it has."""
    parts = parts_of(files.xlsx())
    parts[_SHEET] = re.sub(rb"<dimension[^>]*>", b"", parts[_SHEET])
    parts[_STRINGS] = b'<sst xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"></sst>'
    kind = f'<Override PartName="/{_STRINGS}" ContentType="{_OOXML}.sharedStrings+xml"/></Types>'
    types = parts["[Content_Types].xml"]
    parts["[Content_Types].xml"] = types.replace(b"</Types>", kind.encode())
    return parts


def filled(content: bytes) -> bytes:
    """XML with so much noise in a comment that it is not packed beyond measure."""
    noise = np.random.default_rng(1).integers(ord("a"), ord("q"), len(content) // 90, np.uint8)
    return content + b"<!--" + noise.tobytes() + b"-->"


def _workbooks() -> _Files:
    parts = workbook()

    def made(part: str, before: bytes, content: bytes) -> bytes:
        return archive({**parts, part: parts[part].replace(before, content + before)})

    end = b"</sheetData>"
    far = b'<row r="4000000000"><c r="A4000000000"><v>1</v></c></row>'
    yield "far.xlsx", made(_SHEET, end, far), ("sheet2.xml", "spans 4000000000 rows")
    junk = filled(b"<x/>" * 8_000_000)
    yield "junk.xlsx", made(_SHEET, end, junk), ()
    row = b'<row r="43">' + filled(b"<c/>" * 8_000_000) + b"</row>"
    yield "row.xlsx", made(_SHEET, end, row), ()
    rows = filled(b'<row><c r="KN1"><v>1</v></c></row>' * 300_000)
    yield "cells.xlsx", made(_SHEET, end, rows), ()
    yield "rows.xlsx", made(_SHEET, end, filled(b"<row/>" * 1_100_000)), ()
    column = b'<row r="43"><c r="XFD43"><v>1</v></c></row>'
    yield "column.xlsx", made(_SHEET, end, column), ()
    style = filled(b"<x/>" * 2_000_000)
    yield "styles.xlsx", made("xl/styles.xml", b"</styleSheet>", style), ()
    merged = b"<mergeCells>" + b'<mergeCell ref="A1"/>' * 300_000 + b"</mergeCells>"
    sheet = parts[_SHEET].replace(end, end + filled(merged))
    yield "merged.xlsx", archive({**parts, _SHEET: sheet}), ()
    strings = filled(b"<si><t>a</t></si>" * 4_000_000)
    yield "strings.xlsx", made(_STRINGS, b"</sst>", strings), ()
    tag = b'<x y="' + b"a" * 20_000_000 + b'"/>'
    yield "tag.xlsx", made(_SHEET, end, filled(tag)), ()
    cell = b'<row><c t="str"><v>' + b"a" * 40_000_000 + b"</v></c></row>"
    yield (
        "cell.xlsx",
        made(_SHEET, end, filled(cell)),
        (),
    )
    many = {**parts, "xl/media/a.xml": filled(b"<x/>" * 65_000_000)}
    yield "parts.xlsx", archive(many), ("unpacks to more than 256000000 bytes",)


def _word(text: str) -> bytes:
    return struct.pack("<I", len(text)) + text.encode()


def tdms_object(path: str, values: tuple[int, int] | None = None, properties: bytes = b"", count: int = 0):
    """An object of a segment's directory; ``values``: type and number of its values in each piece."""
    index = b"\xff" * 4 if values is None else struct.pack("<IIIQ", 20, values[0], 1, values[1])
    return _word(path) + index + struct.pack("<I", count) + properties


def tdms_segment(objects: Sequence[bytes] | None, raw: bytes = b"", *, new: bool = True) -> bytes:
    """A segment; without objects those of the segment before it."""
    directory = b"" if objects is None else struct.pack("<I", len(objects)) + b"".join(objects)
    flags = (0 if objects is None else 2 + 4 * new) + (8 if raw else 0)
    lead = struct.pack("<IIQQ", flags, 4713, len(directory) + len(raw), len(directory))
    return b"TDSm" + lead + directory + raw


def _tdms() -> _Files:
    paths = [f"/'run'/'{name}'" for name in ("pressure_bar", "length_mm", "force_N")]

    def run(kind: int, values: int, raw: bytes, properties: bytes = b"", count: int = 0) -> bytes:
        first = tdms_object(paths[0], (kind, values), properties, count)
        return tdms_segment([first, *(tdms_object(path, (kind, values)) for path in paths[1:])], raw)

    good = run(10, 40, np.ones(120).tobytes())
    yield "short.tdms", run(5, 12_000_000, b"\1" * 36_000_000), ("channel 'force_N'", "288 MB", "256 MB")
    yield "pieces.tdms", run(5, 1, b"\1\2\3" * 3_000_000), ("too many pieces", "Defragment")
    yield "segments.tdms", good + tdms_segment(None) * 300_000, ("too many pieces", "200000 segments")
    known = tdms_segment([tdms_object(f"/'run'/'c{number:05}'") for number in range(20_000)])
    more = [tdms_segment([tdms_object(f"/'run'/'d{number:05}'")], new=False) for number in range(2000)]
    yield "objects.tdms", known + b"".join(more), ("too many pieces", "2000000 channels")
    empty = _word("") + struct.pack("<I", 0x20) + _word("")
    directory = tdms_segment([tdms_object("/", None, empty * 2_000_000, 2_000_000)])
    yield "directory.tdms", directory, ("too many pieces", "16 MB of directories")
    scales = _word("NI_Number_Of_Scales") + struct.pack("<IQ", 8, 400_000_000)
    yield "scales.tdms", run(10, 40, np.ones(120).tobytes(), scales, 1), ("more than 8 scales",)
    scale = _word("NI_Scale[300000000]_Scale_Type") + struct.pack("<I", 0x20) + _word("Linear")
    yield "scale.tdms", run(10, 40, np.ones(120).tobytes(), scale, 1), ("more than 8 scales",)


def _csv() -> _Files:
    head, row = b"# kind: static\npressure_bar;length_mm;force_N\n", b"1;280;10\n"
    good = head + row * 100
    yield "row.csv", good + b"12;" * 10_000_000, ("row 103", "more than 200000 characters")
    yield "cell.csv", good + b"1;280;" + b"9" * 30_000_000 + b"\n", ("row 103", "more than 200000 characters")
    header = b";".join(b"c%d" % number for number in range(2_000_000)) + b"\n" + row * 100
    yield "header.csv", header, ("row 1", "more than 200000 characters")
    yield "word.csv", b"c" * 30_000_000 + b"\n" + row * 100, ("row 1", "more than 200000 characters")
    yield "gap.csv", good + b"\n" * 30_000_000 + row, ("lines, at most 6000000", "every second row")
    yield "rows.csv", head + b"1;2;3\n" * 7_000_000, ("7000003 lines, at most 6000000",)
    yield "notes.csv", b"# a: b\n" * 4_000_000 + good, ()
    quoted = good + b'"1\n' + b'2";"3\n' * 100_000
    yield "quoted.csv", quoted, ("row 103", "never closed")
    words = b"".join(b"1;280;10;w%d\n" % number for number in range(300_000))
    labels = b"# kind: static\npressure_bar;length_mm;force_N;direction\n" + words
    yield "words.csv", labels, ()
