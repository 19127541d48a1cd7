"""Bytes of any format -> sheets: which format it is shows in the first bytes; all others are refused with
what to do.
"""

from __future__ import annotations

import io
import json
import re
import zipfile
import zlib
from collections.abc import Callable
from dataclasses import replace
from datetime import date, datetime, time, timedelta
from pathlib import PurePath, PurePosixPath
from typing import Any

import numpy as np

from mckibben.measurement.reading.compound import has_sound_chains
from mckibben.measurement.reading.encodings import decoded
from mckibben.measurement.reading.lexicon import word_set, words_of
from mckibben.measurement.reading.limits import MAX_BYTES, MAX_CELLS, MAX_COLUMNS, MAX_SHEETS, SPLIT
from mckibben.measurement.reading.model import Cell, Sheet, Span
from mckibben.measurement.reading.numbers import narrow, style_of
from mckibben.measurement.reading.text import sheet_of_text, text_sheets
from mckibben.measurement.reading.tree import sheets_of_tree
from mckibben.physics.errors import InputError

_HDF5 = b"\x89HDF\r\n\x1a\n"
_UNPACKED = 256_000_000  # bytes that an archive may become
_RATIO, _RATIO_FROM = 200, 1_000_000  # of one part; number tables reach about 20
_PARTS = 1000
_TEXTS = (".csv", ".txt", ".tsv", ".dat", ".asc", ".prn", ".log", ".md", ".lvm")
_TABLES = (".xlsx", ".xls", ".xlsb", ".ods", ".mat", ".h5", ".hdf5", ".json", ".tdms", ".jsonl", ".parquet")
_MERGED = 50_000  # cells that merged ones may become
#: First bytes -> (what the file is, what to do instead).
_REFUSED = {
    b"TDSh": ("a TDMS index, without the data", "send the .tdms file beside it"),
    b"%PDF": ("a PDF document", "send the table itself, as CSV or .xlsx"),
    b"7z\xbc\xaf": ("a 7z archive", "unpack it first"),
    b"Rar!": ("a RAR archive", "unpack it first"),
    b"MATLAB 4": ("a MATLAB 4 file", "save it with -v7"),
    b"SQLite format 3\0": ("an SQLite database", "save the table as CSV or XLSX"),
    b"\x93NUMPY": ("an array of numpy", "save it as CSV or XLSX, with the names of its columns"),
}
#: Endings of texts that hold values and no table -> what the file is.
_NO_TABLE = {
    ".yaml": "a YAML text", ".yml": "a YAML text", ".toml": "a TOML text", ".xml": "an XML text",
    ".html": "a web page", ".htm": "a web page", ".tex": "a LaTeX text",
    ".m": "a script", ".py": "a script", ".r": "a script",
}  # fmt: skip
_BINARY = {
    ".h5": "an HDF5 file", ".hdf5": "an HDF5 file", ".xlsx": "an Excel workbook", ".mat": "a MATLAB file",
    ".tdms": "a TDMS file", ".xls": "an Excel workbook", ".parquet": "a Parquet file",
}  # fmt: skip
_MARKUP = re.compile(rb"(?i)(?:\xef\xbb\xbf)?\s{0,200}<(?:(\?xml)|!doctype html|html|table)\b")
_CONTROL = re.compile(rb"[\x00-\x08\x0e-\x1f]")


def sheets_of(data: bytes, name: str, *, packed: bool = False) -> list[Sheet]:
    """The sheets of a file.

    Raises:
        InputError: a format that is not read, a damaged file, or one that is too large.
    """
    if len(data) > MAX_BYTES:
        raise InputError(
            f"{name}: it has {len(data)} bytes, at most {MAX_BYTES} are read", field="file", hint=SPLIT
        )
    for first, (what, remedy) in _REFUSED.items():
        if data.startswith(first):
            raise _refusal(name, f"the file is {what}", remedy)
    if data.startswith((b"PK\x03\x04", b"PK\x05\x06", b"PK")) or data.startswith(b"\x1f\x8b"):
        return _packed(data, name, packed=packed)
    if data.startswith(b"\xd0\xcf\x11\xe0"):
        if not has_sound_chains(data):
            raise _refusal(
                name, "the workbook is damaged: its parts do not end", "save it again as .xlsx, or as CSV"
            )
        return _workbook(data, name)
    if data.startswith(b"TDSm"):
        return _guarded(_tdms, data, name, "the TDMS file is damaged", "export it again, or save it as CSV")
    if data.startswith(b"PAR1"):
        return _guarded(_parquet, data, name, "the Parquet file is damaged", "save it as CSV")
    if any(data[offset : offset + 8] == _HDF5 for offset in (0, 512, 1024, 2048)):
        return _guarded(_hdf5, data, name, "the MATLAB 7.3 or HDF5 file is damaged", "save it again with -v7")
    if data[:6] == b"MATLAB" or data[124:128] in (b"\x00\x01IM", b"\x01\x00MI"):
        return _mat5(data, name)
    return _of_text(data, name)


def _refusal(name: str, why: str, hint: str) -> InputError:
    return InputError(f"{name}: no column can be read: {why}", field="file", hint=hint)


def _guarded(
    reader: Callable[[bytes, str], list[Sheet]], data: bytes, name: str, why: str, hint: str
) -> list[Sheet]:
    """What a library reads; whatever it raises on a damaged file is a refusal."""
    try:
        return reader(data, name)
    except (InputError, MemoryError):
        raise
    except Exception as error:
        raise _refusal(name, f"{why} ({type(error).__name__}: {str(error)[:100]})", hint) from error


def _of_text(data: bytes, name: str) -> list[Sheet]:
    suffix = PurePath(name).suffix.lower()
    if markup := _MARKUP.match(data[:4096]):
        raise _no_table(name, _NO_TABLE[".xml" if markup[1] else ".html"])
    if suffix in _NO_TABLE:
        raise _no_table(name, _NO_TABLE[suffix])
    expected = _BINARY.get(suffix)
    if expected is not None and (control := _CONTROL.search(data[:4096])):
        why = (
            f"the file does not begin as {expected} does (byte {control.start() + 1} is neither text "
            f"nor a known mark)"
        )
        raise _refusal(name, why, "export it again, or save it as CSV")
    text, messages = decoded(data, name)
    if expected is not None:
        messages = (*messages, f"the file is text, not {expected}: read as CSV")
    if text.lstrip()[:1] in ("{", "["):
        tree = _json(text, name)
        if tree is not None:
            return [*sheets_of_tree(tree, "json", "key")]
    return [sheet_of_text(text, name, messages)]


def _no_table(name: str, what: str) -> InputError:
    return _refusal(name, f"{what} is not a table that mckibben reads", "save it as CSV or XLSX")


def _json(text: str, name: str) -> Any:
    """The value of a JSON text, or of one with a value per line; None = it is none.

    Raises:
        InputError: it is nested too deeply, or begins as JSON and is damaged.
    """
    try:
        return json.loads(text)
    except RecursionError as error:
        raise InputError(
            f"{name}: the JSON is nested too deeply", field="file", hint="objects of lists"
        ) from error
    except ValueError as error:
        lines = [line for line in text.split("\n") if line.strip()]
        try:
            return [json.loads(line) for line in lines]
        except (ValueError, RecursionError):
            if re.match(r'\s*[{\[]\s*["{\[\]}]', text):
                raise InputError(
                    f"{name}: it is not valid JSON: {error}", field="file", hint="export it again"
                ) from error
            return None


def _packed(data: bytes, name: str, *, packed: bool) -> list[Sheet]:
    """A workbook, or what an archive holds: one table, or texts one after another."""
    if data.startswith(b"\x1f\x8b"):
        inner = name[:-3] if name.lower().endswith(".gz") else name
        return _inner(_unpacked(data, name), inner, name, packed=packed)
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            parts = [p for p in archive.infolist() if not p.is_dir() and "__MACOSX" not in p.filename]
            names = {part.filename for part in parts}
            if any(n.startswith("xl/") for n in names) or "content.xml" in names:
                _check_parts(parts, name)
                _check_extent(archive, parts, name)
                sheets = _workbook(data, name)
                pictures = any(n.startswith("xl/media/") for n in names)
                return [
                    replace(s, messages=(*s.messages, _PICTURE)) if pictures and s is sheets[0] else s
                    for s in sheets
                ]
            if names and all(n.endswith(".npy") for n in names):
                raise _no_table(name, "an archive of numpy's arrays (.npz)")
            wanted = [p for p in parts if PurePosixPath(p.filename).suffix.lower() in (*_TEXTS, *_TABLES)]
            if not wanted:
                held = ", ".join(part.filename[:60] for part in parts[:3]) or "nothing"
                raise _refusal(
                    name, f"the archive holds no table: {held}", "send the table itself, as CSV or .xlsx"
                )
            _check_parts(parts, name)
            return _of_archive(archive, wanted, name, packed=packed)
    except (zipfile.BadZipFile, EOFError, NotImplementedError, OSError, zlib.error) as error:
        raise _refusal(
            name, "the archive is damaged and cannot be unpacked", "create the archive again"
        ) from error


def _check_parts(parts: list[zipfile.ZipInfo], name: str) -> None:
    """Refuse an archive that unpacks to more than is read, or is protected."""
    if len(parts) > _PARTS or sum(part.file_size for part in parts) > _UNPACKED:
        raise _refusal(
            name, f"the archive has {len(parts)} parts, or unpacks to more than {_UNPACKED} bytes", "split it"
        )
    for part in parts:
        if part.flag_bits & 1:
            raise _refusal(name, "the archive is protected by a password", "create it without a password")
        if part.file_size > max(_RATIO_FROM, _RATIO * part.compress_size):
            why = f"its part '{part.filename[:80]}' is compressed too far, more than {_RATIO} times"
            raise _refusal(name, why, "send the file itself")


_PICTURE = "the workbook holds a picture; what it shows is not read"
_CELL_AT = re.compile(rb"""\sr\s?=\s?["']([A-Za-z]{0,9})(\d{1,12})["']""")
_MOST_OF_A_SHEET = (
    12_000_000  # cells of the rectangle that a sheet spans; the library takes memory for all of them
)


def _check_extent(archive: zipfile.ZipFile, parts: list[zipfile.ZipInfo], name: str) -> None:
    """Refuse a workbook with a cell so far out that the rectangle to it takes too much memory, whatever lies
    within.
    """
    for part in parts:
        if not part.filename.startswith("xl/worksheets/") or not part.filename.endswith(".xml"):
            continue
        rows = columns = 0
        for match in _CELL_AT.finditer(archive.read(part)):
            rows = max(rows, int(match[2]))
            columns = max(columns, _column_number(match[1]))
        if rows * columns > _MOST_OF_A_SHEET:
            why = (
                f"'{part.filename}' spans {rows} rows and {columns} columns, more than {_MOST_OF_A_SHEET} "
                f"cells are not read"
            )
            raise _refusal(name, why, "delete what stands far from the table, or save the table as CSV")


def _column_number(letters: bytes) -> int:
    """1 of ``A``, 28 of ``AB``."""
    number = 0
    for letter in letters:
        number = 26 * number + (letter & 31)
    return number


def _of_archive(
    archive: zipfile.ZipFile, parts: list[zipfile.ZipInfo], name: str, *, packed: bool
) -> list[Sheet]:
    tables = [p for p in parts if PurePosixPath(p.filename).suffix.lower() in _TABLES]
    if tables and (
        len(tables) > 1 or (len(parts) > 1 and any(p.filename.lower().endswith(".csv") for p in parts))
    ):
        shown = ", ".join(f"'{part.filename[:40]}'" for part in parts[:6])
        raise _refusal(name, f"the archive holds several tables, {shown}", "send one of them, or texts only")
    if tables or len(parts) == 1:
        part = (tables or parts)[0]
        inner = f"{name}/{PurePosixPath(part.filename).name}"
        return _inner(archive.read(part), inner, part.filename, packed=packed)
    sheets = []
    for part in parts:
        stem = PurePosixPath(part.filename).stem.replace("_", " ")
        sheets += [_named(sheet, stem) for sheet in text_sheets(archive.read(part), part.filename)]
    return sheets


def _named(sheet: Sheet, name: str) -> Sheet:
    return replace(sheet, name=name, format="zip")


def _inner(data: bytes, name: str, shown: str, *, packed: bool) -> list[Sheet]:
    if packed:
        raise _refusal(name, "an archive in an archive", "unpack it first")
    sheets = sheets_of(data, name, packed=True)
    message = f"the file is packed: '{shown}' in it is read"
    return [replace(sheets[0], messages=(*sheets[0].messages, message)), *sheets[1:]]


def _unpacked(data: bytes, name: str) -> bytes:
    unpacker = zlib.decompressobj(wbits=31)
    try:
        content = unpacker.decompress(data, min(_UNPACKED, _RATIO * len(data) + _RATIO_FROM))
    except zlib.error as error:
        raise _refusal(name, f"the compressed file is damaged ({error})", "compress it again") from error
    if unpacker.unconsumed_tail or not unpacker.eof:
        why = "the compressed file is incomplete, or unpacks to more than can be read"
        raise _refusal(name, why, "unpack it first")
    return content


def _workbook(data: bytes, name: str) -> list[Sheet]:
    from python_calamine import CalamineWorkbook

    try:
        book = CalamineWorkbook.from_filelike(io.BytesIO(data))
        sheets, count = [], 0
        for title in book.sheet_names[:MAX_SHEETS]:
            sheet = book.get_sheet_by_name(title)
            count += sheet.total_height * sheet.total_width
            if count > MAX_CELLS:
                raise InputError(
                    f"{name}, sheet '{title}': more than {MAX_CELLS} cells", field="file", hint=SPLIT
                )
            rows: list[list[Cell]] = [
                [_cell(c) for c in row[:MAX_COLUMNS]] for row in sheet.to_python(skip_empty_area=False)
            ]
            merged = f"sheet '{title}': the value of merged cells counts for each of their rows"
            said = (merged,) if _carry_merged(rows, sheet) else ()
            style = style_of(cell for row in rows[:400] for cell in row)
            sheets.append(
                Sheet(
                    name=title,
                    rows=rows,
                    format="xlsx",
                    decimal=style.decimal,
                    thousands=style.thousands,
                    messages=said,
                )
            )
    except InputError:
        raise
    except (KeyboardInterrupt, SystemExit, MemoryError):
        raise
    except BaseException as error:  # a panic of the library is no Exception
        raise _refusal(
            name, f"the workbook cannot be opened ({str(error)[:100]})", "save it again as .xlsx, or as CSV"
        ) from None
    if not any(sheet.rows for sheet in sheets):
        raise _refusal(name, "the workbook is empty", "it needs a header and one row per reading")
    return sheets


def _cell(cell: Any) -> Cell:
    if isinstance(cell, bool):
        return str(cell)  # as in a text: among numbers it is none
    if isinstance(cell, (int, float)):
        return float(cell)
    if isinstance(cell, datetime):
        return cell
    if isinstance(cell, timedelta):
        return datetime(1900, 1, 1) + cell
    if isinstance(cell, time):
        return datetime.combine(date(1900, 1, 1), cell)
    if isinstance(cell, date):
        return datetime.combine(cell, time())
    return narrow(str(cell).strip())


def _carry_merged(rows: list[list[Cell]], sheet: Any) -> bool:
    """Carry the value of merged cells below each other to all of their rows; whether there are such."""
    done = 0
    carried = False
    for (top, left), (bottom, _) in getattr(sheet, "merged_cell_ranges", None) or ():
        for row in range(top + 1, bottom + 1):
            done += 1
            if done > _MERGED or row >= len(rows) or left >= len(rows[row]) or top >= len(rows):
                return carried
            if rows[row][left] == "" and isinstance(rows[top][left], (float, str)):
                rows[row][left] = rows[top][left]
                carried |= isinstance(rows[top][left], float)
    return carried


def _mat5(data: bytes, name: str) -> list[Sheet]:
    from mckibben.measurement.reading.mat5 import DamagedError, read_variables

    try:
        values = read_variables(data, name)
    except DamagedError as error:
        raise _refusal(name, f"the MATLAB file is damaged: {error}", "save it again with -v7") from error
    return _of_matlab(values, name, "mat")


def _hdf5(data: bytes, name: str) -> list[Sheet]:
    import h5py

    from mckibben.measurement.reading.hdf5 import Hdf5Reader, by_matlab

    with h5py.File(io.BytesIO(data), "r") as file:
        of_matlab = b"MATLAB" in data[:128] or by_matlab(file)
        values = Hdf5Reader(file, name, data, by_matlab=of_matlab).group(file)
    return _of_matlab(values, name, "mat" if of_matlab else "hdf5")


def _of_matlab(values: dict[str, Any], name: str, format: str) -> list[Sheet]:
    from mckibben.measurement.reading.mat5 import Foreign, without_foreign

    sheets = sheets_of_tree(without_foreign(values), format, "variable")
    foreign = [key for key, value in values.items() if isinstance(value, Foreign)]
    if foreign and not any(sheet.arrays for sheet in sheets):
        key = foreign[0]
        raise InputError(
            f"{name}, variable '{key}': it is a MATLAB {values[key].kind}, which is not read",
            field=f"variable {key}",
            hint=f"save its columns: s = table2struct({key}, 'ToScalar', true); save('file.mat', '-struct', "
            f"'s')",
        )
    return sheets


def _tdms(data: bytes, name: str) -> list[Sheet]:
    import logging

    from nptdms import TdmsFile
    from nptdms.log import log_manager

    from mckibben.measurement.reading.tdms import check_pieces, check_segments, check_size

    check_segments(data, name)
    log_manager.set_level(logging.ERROR)  # what matters is said in the refusal
    check_pieces(data, name)
    with TdmsFile.open(io.BytesIO(data)) as file:
        channels = [channel for group in file.groups() for channel in group.channels()]
        if sum(len(channel) for channel in channels) > len(data):
            raise ValueError("it declares more values than it holds")
        check_size(file, name, len(data))
        top = _properties(file.properties, "properties of the file")
        sheets = []
        for group in file.groups()[:MAX_SHEETS]:
            arrays: dict[str, Any] = {}
            units: dict[str, str] = {}
            for channel in group.channels()[:MAX_COLUMNS]:
                arrays[str(channel.name)] = _tdms_values(channel[:])
                units[str(channel.name)] = str(channel.properties.get("unit_string") or "").strip()
            _add_time(arrays, units, group.channels())
            sizes = [len(values) for values in arrays.values() if values is not None]
            size = max(set(sizes), key=lambda n: (sizes.count(n), n), default=0)
            own = (
                *_properties(group.properties, f"group '{group.name}'"),
                *(
                    Span(f"channel '{c.name}', '{key}'", f"{c.name}: {c.properties[key]}"[:1000])
                    for c in group.channels()
                    for key in ("description", "comment")
                    if c.properties.get(key)
                ),
            )
            kept = {k: v for k, v in arrays.items() if v is not None and len(v) == size}
            dropped = tuple(
                (k, f"it has {len(v)} values, and the others {size}")
                for k, v in arrays.items()
                if v is not None and len(v) != size
            )
            sheets.append(
                Sheet(
                    str(group.name),
                    noun="channel",
                    format="tdms",
                    arrays=kept,
                    dropped=dropped,
                    units=units,
                    texts=(*top, *own),
                )
            )
    return sheets


def _properties(properties: Any, where: str) -> tuple[Span, ...]:
    return tuple(
        Span(f"{where}, '{k}'", f"{k}: {v}"[:1000]) for k, v in properties.items() if not isinstance(v, bool)
    )


def _tdms_values(values: Any) -> Any:
    values = np.asarray(values)
    if values.dtype.kind == "M":  # time stamps count from the first
        return (values - values[0]) / np.timedelta64(1, "s") if len(values) else None
    return [str(v) for v in values] if values.dtype.kind not in "biuf" else values.astype(float)


def _add_time(arrays: dict[str, Any], units: dict[str, str], channels: Any) -> None:
    """A time axis from the properties of a waveform, where no channel is one."""
    from mckibben.measurement.reading.heads import head_claims

    if any(
        c.facet == "channel" and c.value == "time"
        for head in arrays
        for c in head_claims(head[:200], units.get(head, ""))
    ):
        return
    for channel in channels:
        step, start = channel.properties.get("wf_increment"), channel.properties.get("wf_start_offset", 0.0)
        if isinstance(step, (int, float)) and np.isfinite(step) and step > 0.0 and len(channel) > 1:
            offset = float(start) if isinstance(start, (int, float)) and np.isfinite(start) else 0.0
            arrays["time"], units["time"] = offset + np.arange(len(channel)) * float(step), "s"
            return


def _parquet(data: bytes, name: str) -> list[Sheet]:
    try:
        import pyarrow.parquet as parquet
    except ImportError:
        raise _refusal(
            name,
            "a Parquet file needs pyarrow, which is not installed",
            "pip install pyarrow, or save it as CSV",
        ) from None
    table = parquet.read_table(io.BytesIO(data))
    if table.num_rows * table.num_columns > MAX_CELLS:
        raise InputError(f"{name}: more than {MAX_CELLS} cells", field="file", hint=SPLIT)
    arrays: dict[str, Any] = {}
    for column in table.column_names[:MAX_COLUMNS]:
        values = table[column].to_numpy()
        arrays[column] = (
            (values - values[0]) / np.timedelta64(1, "s")
            if values.dtype.kind == "M"
            else values.astype(float)
            if values.dtype.kind in "biuf"
            else ["" if v is None else str(v) for v in values]
        )
    texts = [Span("metadata", f"{k}: {v}"[:1000]) for k, v in _of_arrow(table.schema.metadata)]
    units: dict[str, str] = {}
    for field in table.schema:
        for key, text in _of_arrow(field.metadata):
            if word_set("unit").among(words_of(key)):
                units[field.name] = text
            else:
                texts.append(Span(f"said of '{field.name}'", f"{field.name}: {text}"[:1000]))
    return [Sheet("", noun="column", format="parquet", arrays=arrays, units=units, texts=tuple(texts))]


def _of_arrow(metadata: dict[bytes, bytes] | None) -> list[tuple[str, str]]:
    """Keys and texts of the metadata of a table or of a field, but for what libraries keep there."""
    said = [(k.decode("utf-8", "replace"), v.decode("utf-8", "replace")) for k, v in (metadata or {}).items()]
    return [(k, v) for k, v in said if v and k != "pandas" and not k.startswith(("ARROW:", "PARQUET:"))]
