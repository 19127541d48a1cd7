"""An Excel workbook, opened only when nothing in it takes more memory than a workbook of its size can need.

A workbook is a ZIP archive of XML parts. openpyxl keeps a row (or a shared string) as a tree while it reads
it, and everything outside of rows for good, at a hundred bytes and more for an element of four. So every
part that it may open is walked first, without keeping anything; the others are hidden from it.
"""

from __future__ import annotations

import io
import zipfile
from collections.abc import Iterable
from pathlib import PurePosixPath
from typing import Any
from xml.parsers import expat

from mckibben.measurement.read.limits import Allowance, size_of
from mckibben.physics.errors import InputError

_MAX_RATIO = 200  # of one part; number tables reach about 20
_RATIO_FROM = 1_000_000  # bytes; smaller parts may be as dense as they like
_MAX_PARTS = 10_000
MAX_ROWS = 1_048_576  # of a sheet, as in Excel
_IN_A_ROW = 70_000  # elements: 16 384 cells with a value each, and their formulas
_OUTSIDE = 200_000  # elements outside of rows and strings, of all parts
_STRINGS = 5_000_000  # elements of the shared strings
_STRINGS_SIZE = 64_000_000  # bytes
_LONGEST = 16_000_000  # bytes of one tag
_LONGEST_TEXT = 1_000_000  # characters; Excel's own cells end at 32 767
_TEXT_FROM = 32_000_000  # bytes; of smaller parts the texts do not matter
_BLOCK = 262_144  # bytes
#: What is never needed for the values of cells.
_HIDDEN = frozenset({
    "activeX", "calcChain", "charts", "chartsheets", "comments", "ctrlProps", "customXml", "diagrams",
    "dialogsheets", "drawings", "embeddings", "externalLinks", "media", "metadata", "persons", "pivotCache",
    "pivotTables", "printerSettings", "queryTables", "revisions", "richData", "slicerCaches", "slicers",
    "tables", "theme", "threadedComments",
})  # fmt: skip
_MAIN = "http://schemas.openxmlformats.org/spreadsheetml/2006/main"
_ROW, _STRING = f"{_MAIN} row", f"{_MAIN} si"
_WHOLE = frozenset({"[Content_Types].xml", "xl/styles.xml", "docProps/core.xml", "docProps/custom.xml"})


def open_book(data: bytes, name: str) -> Any:
    """The workbook as openpyxl reads it row by row, with the values its formulas had when it was saved.

    Raises:
        InputError: not a workbook, protected, damaged, or larger than is read; names the part.
    """
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            _check_parts(archive.infolist(), name, len(data))
            visible = [part for part in archive.namelist() if _is_needed(part)]
            return _opened(archive, visible, data, name)
    except InputError:
        raise
    except (zipfile.BadZipFile, EOFError, NotImplementedError, OSError) as error:
        raise _refused(name, "the workbook is damaged and cannot be unpacked", "save it again") from error


def _refused(name: str, why: str, hint: str) -> InputError:
    return InputError(f"{name}: no column can be read: {why}", field="file", hint=hint)


def _check_parts(parts: list[zipfile.ZipInfo], name: str, size: int) -> None:
    """Refuse what is no workbook, or says of itself that it unpacks to more than its size can mean."""
    names = {part.filename for part in parts}
    if "xl/workbook.xml" not in names:
        if any(part.endswith(".bin") and part.startswith("xl/") for part in names):
            raise _refused(name, "it is a binary workbook (.xlsb)", "save it as .xlsx or CSV")
        shown = ", ".join(sorted(names)[:3])
        why = f"a ZIP archive without a workbook in it (it holds {shown[:100]})"
        raise _refused(name, why, "unpack it first")
    if len(parts) > _MAX_PARTS:
        raise _refused(name, f"the workbook has {len(parts)} parts, at most {_MAX_PARTS} are read", "use CSV")
    Allowance(name, size).take(sum(part.file_size for part in parts), "all parts of the workbook")
    for part in parts:
        shown = part.filename[:80]
        if part.flag_bits & 1:
            raise _refused(name, "the workbook is protected by a password", "save it without a password")
        if part.file_size > max(_RATIO_FROM, _MAX_RATIO * part.compress_size):
            why = (
                f"its part '{shown}' is compressed too far, {size_of(part.compress_size)} that unpack to "
                f"{size_of(part.file_size)}; at most {_MAX_RATIO} times are read"
            )
            raise _refused(name, why, "save it as CSV")


def _is_needed(part: str) -> bool:
    path = PurePosixPath(part)
    if path.suffix == ".rels":
        return "worksheets" not in path.parts
    return path.suffix == ".xml" and not _HIDDEN & {*path.parts[:-1], path.stem.rstrip("0123456789")}


def _opened(archive: zipfile.ZipFile, visible: list[str], data: bytes, name: str) -> Any:
    from openpyxl.reader.excel import ExcelReader
    from openpyxl.xml.constants import SHARED_STRINGS, XLSM, XLSX, XLTM, XLTX

    check = _Check(archive, name)
    check.part("[Content_Types].xml", None)
    reader = ExcelReader(io.BytesIO(data), read_only=True, data_only=True, keep_links=False)
    for part in set(reader.archive.NameToInfo).difference(visible):
        del reader.archive.NameToInfo[part]
    reader.valid_files = visible
    reader.read_manifest()
    strings = _part(reader.package, (SHARED_STRINGS,))
    whole = _WHOLE | {"xl/workbook.xml", _part(reader.package, (XLTM, XLTX, XLSM, XLSX))}
    for part in visible:
        if part == strings:
            check.part(part, _STRING)
        elif part != "[Content_Types].xml":
            check.part(part, None if part in whole or part.endswith(".rels") else _ROW)
    reader.read()
    return reader.wb


def _part(package: Any, kinds: Iterable[str]) -> str | None:
    """The part of one of these types; None when there is none."""
    found = (package.find(kind) for kind in kinds)
    return next((str(part.PartName)[1:] for part in found if part is not None), None)


class _EnoughError(Exception):
    """Why a part is refused."""


class _Check:
    """Walks parts and counts their elements."""

    def __init__(self, archive: zipfile.ZipFile, name: str) -> None:
        self._archive = archive
        self._name = name
        self._outside = 0  # elements outside of units, of all parts
        self._begin(None)

    def part(self, part: str, unit: str | None) -> None:
        """Refuse a part that would take too much; ``unit``: the tag of its rows or strings, if it has any."""
        info = self._archive.getinfo(part)
        self._begin(unit)
        try:
            if unit == _STRING and info.file_size > _STRINGS_SIZE:
                raise _EnoughError(
                    f"holds {size_of(info.file_size)} of texts, at most {size_of(_STRINGS_SIZE)} are read"
                )
            self._walk(info)
        except _EnoughError as error:
            raise _refused(self._name, f"its part '{part[:80]}' {error}", "save it as CSV") from error

    def _begin(self, unit: str | None) -> None:
        self._unit = unit  # the tag that openpyxl forgets when it has read it
        self._units = 0
        self._depth = self._inside = 0  # in the unit that is walked
        self._kept = 0  # elements of shared strings
        self._text = 0  # characters since the last tag

    def _walk(self, info: zipfile.ZipInfo) -> None:
        parser = expat.ParserCreate(namespace_separator=" ")
        parser.StartElementHandler, parser.EndElementHandler = self._start, self._end
        parser.StartDoctypeDeclHandler = _refuse_entities
        if info.file_size > _TEXT_FROM:
            parser.CharacterDataHandler = self._characters
        fed = 0
        with self._archive.open(info) as stream:
            while block := stream.read(_BLOCK):
                fed += len(block)
                try:
                    parser.Parse(block)
                except expat.ExpatError:
                    return  # openpyxl, which comes no further, says so if it needs the part
                if fed - parser.CurrentByteIndex > _LONGEST:
                    raise _EnoughError(f"has a tag of more than {size_of(_LONGEST)}")

    def _start(self, tag: str, attributes: dict[str, str]) -> None:
        self._text = 0
        if self._depth:
            self._depth += 1
            self._inside += 1
            if self._inside > _IN_A_ROW:
                raise _EnoughError(f"has a row or text of more than {_IN_A_ROW} elements")
        elif tag == self._unit:
            self._units += 1
            self._kept += self._inside + 1
            self._depth, self._inside = 1, 0
            if tag == _ROW and self._units > MAX_ROWS:
                raise _EnoughError(f"has more than {MAX_ROWS} rows")
            if tag == _STRING and self._kept > _STRINGS:
                raise _EnoughError(f"has texts of more than {_STRINGS} elements")
        else:
            self._outside += 1
            if self._outside > _OUTSIDE:
                raise _EnoughError(f"brings the elements outside of rows to more than {_OUTSIDE}")

    def _end(self, tag: str) -> None:
        self._text = 0
        if self._depth:
            self._depth -= 1

    def _characters(self, text: str) -> None:
        self._text += len(text)
        if self._text > _LONGEST_TEXT:
            raise _EnoughError(f"has a text of more than {_LONGEST_TEXT} characters")


def _refuse_entities(*_: object) -> None:
    raise _EnoughError("declares entities")
