"""Measurements from delimited text (CSV): bytes to a Measurement in SI.

UTF-8 with or without BOM, UTF-16 with BOM; ``,`` ``;`` or tab; decimal point or comma; ``# key: value`` above
the header.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from mckibben.measurement.measurement import Measurement
from mckibben.measurement.read.assemble import assemble
from mckibben.measurement.read.cells import CellTable
from mckibben.measurement.read.conditions import Note, note_of_line
from mckibben.measurement.read.correction import Correction
from mckibben.measurement.read.header import HEADER_EXAMPLE
from mckibben.measurement.read.source import SAMPLE_ROWS, RawTable
from mckibben.measurement.read.table import first_rows, read_table, split_header
from mckibben.physics.errors import InputError

_CONTROL = re.compile(rb"[\x00-\x08\x0b\x0e-\x1f\x7f]")
_PIECE = 1_000_000  # bytes
_HEADER_WITHIN = 10_000  # lines


def read_csv(data: bytes, name: str, correction: Correction | None = None) -> Measurement:
    """The measurement in a delimited text.

    Args:
        data: the file's bytes.
        name: file name, for messages.
        correction: what the user says beyond the file.

    Raises:
        InputError: whatever is wrong with the file, naming file, row (1-based line), column, remedy.
    """
    correction = correction or Correction()
    source = open_csv(data, name)
    return assemble(source, name=name, id=correction.identity(data), correction=correction).measurement


def open_csv(data: bytes, name: str) -> RawTable:
    """The table of a delimited text.

    Raises:
        InputError: not a text, empty, or a header that cannot be read.
    """
    messages: list[str] = []
    text = _decoded(data, name, messages)
    notes, separator, header_line, row, body = _split(text, name)
    headers = split_header(header_line, separator, name=name, row=row)

    def read(numeric: Sequence[int], words: Sequence[int], skip: bool) -> CellTable:
        return read_table(
            body, separator, headers, numeric=numeric, text=words, name=name, first_line=row + 1, skip=skip
        )

    return RawTable(
        place=name,
        format="csv",
        headers=headers,
        read=read,
        sample=first_rows(body, separator, SAMPLE_ROWS),
        notes=notes,
        messages=messages,
        header_row=row,
    )


def _decoded(data: bytes, name: str, messages: list[str]) -> str:
    """The text with ``\\n`` line ends; refuses what is not text."""
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        data = _from_utf16(data, name)
    if control := _first_control(data):
        what = "NUL bytes" if control.group() == b"\0" else "control characters"
        line = data.count(b"\n", 0, control.start()) + 1
        raise InputError(
            f"{name}, row {line}: the file holds {what}, it is not a text table",
            field=f"row {line}", hint="save it as 'CSV UTF-8'",
        )  # fmt: skip
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text = data.decode("latin-1")
        messages.append("the file is not UTF-8: read as Latin-1")
    if not text.strip():
        raise InputError(
            f"{name}, row 1: the file is empty", field="row 1", hint="a header and one line per reading"
        )
    return text.replace("\r\n", "\n").replace("\r", "\n") if "\r" in text else text


def _first_control(data: bytes) -> re.Match[bytes] | None:
    """The first control character, looked for piece by piece: one search would hold the interpreter."""
    pieces = (_CONTROL.search(data, begin, begin + _PIECE) for begin in range(0, len(data), _PIECE))
    return next(filter(None, pieces), None)


def _from_utf16(data: bytes, name: str) -> bytes:
    """What spreadsheets call "Unicode text", as UTF-8."""
    try:
        return data.decode("utf-16").encode()
    except UnicodeError as error:
        codec = "utf-16-be" if data[:1] == b"\xfe" else "utf-16-le"
        line = data[2:].decode(codec, "ignore").count("\n") + 1
        raise InputError(
            f"{name}, row {line}: the UTF-16 text is damaged",
            field=f"row {line}",
            hint="save it as 'CSV UTF-8'",
        ) from error


def _split(text: str, name: str) -> tuple[list[Note], str, str, int, str]:
    """(conditions, separator, header line, row of the header, text below it)."""
    notes: list[Note] = []
    separator = None
    row, position = 0, 0
    while position < len(text):
        if row == _HEADER_WITHIN:
            raise InputError(
                f"{name}, row {row + 1}: no header among the first {row} lines",
                field=f"row {row + 1}", hint=HEADER_EXAMPLE,
            )  # fmt: skip
        end = text.find("\n", position)
        end = len(text) if end < 0 else end
        line = text[position:end]
        row, position = row + 1, end + 1
        bare = line.strip()
        if bare.lstrip('"').startswith("#"):
            note = note_of_line(bare.strip(';,\t "'), f"{name}, row {row}")
            if note is not None:
                notes.append(note)
        elif re.fullmatch(r"sep=[,;\t]", bare):  # a spreadsheet's own hint
            separator = bare[-1]
        elif bare.strip(",;\t "):
            separator = separator or next((s for s in "\t;," if s in line), ",")
            return notes, separator, line, row, text[position:]
    raise InputError(
        f"{name}, row {row}: the header names no column", field=f"row {row}", hint=HEADER_EXAMPLE
    )
