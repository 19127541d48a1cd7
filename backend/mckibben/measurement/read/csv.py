"""Measurements from delimited text (CSV): bytes to a Measurement in SI.

UTF-8 with or without BOM, UTF-16 with BOM; ``,`` ``;`` or tab; decimal point or comma; ``# key: value`` above
the header.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from mckibben.measurement.read.cells import CellTable
from mckibben.measurement.read.conditions import Note, note_of_line
from mckibben.measurement.read.correction import Correction
from mckibben.measurement.read.encodings import decoded_otherwise
from mckibben.measurement.read.grid import split_line
from mckibben.measurement.read.header import HEADER_EXAMPLE
from mckibben.measurement.read.held import held_pressure
from mckibben.measurement.read.json_file import is_json, open_json
from mckibben.measurement.read.lines import located_text
from mckibben.measurement.read.plain_head import plainly_known
from mckibben.measurement.read.raw import RawRows, shown_rows
from mckibben.measurement.read.recognise import recognise
from mckibben.measurement.read.source import SAMPLE_ROWS, RawTable
from mckibben.measurement.read.stated import in_known_words, statements
from mckibben.measurement.read.table import first_rows, read_table, split_header
from mckibben.measurement.read.values import CLOCK, GAP, NUMBER, TEXT, kind_of
from mckibben.measurement.read.vocabulary import STATISTICS, words_of
from mckibben.physics.errors import InputError

_CONTROL = re.compile(rb"[\x00-\x08\x0b\x0e-\x1f\x7f]")
_PIECE = 1_000_000  # bytes
_HEADER_WITHIN = 10_000  # lines
_FOOTER_LINES = 100
_LONGEST_COMMENT = 2000  # characters
_SHORT_TABLE = 3_000_000  # characters
_LONGEST_LINE = 10_000  # characters
#: Double precision as Fortran writes it: "0.300D+03".
_FORTRAN = re.compile(r"(?<![\w.])([+-]?\d*\.\d+)D([+-]\d{2,3})(?!\w)")
_THOUSANDS = re.compile(r"(?<![\d.,])\d{1,3}(?:\.\d{3})+,\d|(?<![\d.,])\d{1,3}(?:,\d{3})+\.\d")
_QUOTED_THOUSANDS = re.compile(r'"\s*[+-]?\d{1,3}(?:,\d{3})+\.\d*\s*"')
_BLANK_THOUSANDS = re.compile(r"(?<![\d.,])\d{1,3}(?:['’\u00a0\u202f]\d{3})+(?![\d])")


def open_csv(data: bytes, name: str, correction: Correction | None = None) -> RawTable:
    """The table of a delimited text.

    A text whose first line names channels the plain way (``pressure_bar``) and goes on with numbers is read
    from there; in any other the table is looked for.

    Raises:
        InputError: not a text, empty, or a header that cannot be read.
    """
    correction = correction or Correction()
    messages: list[str] = []
    text = _decoded(data, name, messages)
    if is_json(text) and (found := open_json(text, name, correction)) is not None:
        found.messages[:0] = messages
        return found
    refusal: InputError | None = None
    plain: RawTable | None = None
    try:
        plain, sure = _plain(text, name, messages)
    except InputError as error:
        refusal, sure = error, False
    if plain is not None and sure and correction.head is None:
        return plain
    located = located_text(text, name, correction, messages)
    if located is not None:
        same_row = refusal is not None and refusal.field == f"row {located.header_row}"
        if refusal is not None and same_row and "never closed" in refusal.message:
            raise refusal
        return located
    if plain is None:
        raise refusal or InputError(f"{name}: no table", field="file", hint=HEADER_EXAMPLE)
    return plain


def _plain(text: str, name: str, messages: list[str]) -> tuple[RawTable, bool]:
    """The table below the first line that is no comment, and whether it is one beyond doubt."""
    notes, comments, separator, header_line, row, body = _split(text, name)
    headers = split_header(header_line, separator, name=name, row=row)
    body, below = without_footer(body, separator, row + 1)
    sample = first_rows(body, separator, SAMPLE_ROWS)
    known = plainly_known(headers)
    first = list(sample[0]) if sample else []
    words = [i for i in known if i < len(first) and kind_of(first[i]) in (TEXT, CLOCK)]
    words += [
        i
        for i, name in enumerate(headers[: len(first)])
        if kind_of(first[i]) == CLOCK and (not name or recognise(name).channel == "time")
    ]
    pressures = {(held.value, held.unit) for header in headers if (held := held_pressure(header)) is not None}
    gaps = [
        i for i in known if len(sample) > 2 and all(i < len(r) and kind_of(r[i]) == GAP for r in sample[1:3])
    ]
    sure = (
        bool(known)
        and len(first) in (0, len(headers))
        and not words
        and not gaps
        and not _may_be_tall(headers, first, known)
        and len(pressures) < 2
        and "\n#" not in body  # titles of blocks
        and not _has_thousands(body, separator)
        and not _has_remarks(body, sample, separator)
    )

    def read(numeric: Sequence[int], words: Sequence[int], skip: bool) -> CellTable:
        return read_table(
            body, separator, headers, numeric=numeric, text=words, name=name, first_line=row + 1, skip=skip
        )

    source = RawTable(
        place=name,
        format="csv",
        headers=headers,
        read=read,
        sample=sample,
        notes=_with_texts(in_known_words(notes), comments, name),
        messages=messages + below,
        header_row=row,
        rest=tuple(comments),
        raw=RawRows(shown_rows(_lines_of(text, separator), row), tuple(range(len(headers)))),
    )
    return source, sure


def _may_be_tall(headers: Sequence[str], first: Sequence[str], known: Sequence[int]) -> bool:
    """Whether no head names a reading and words stand beside the numbers: perhaps one value per line."""
    named = {recognise(headers[index]).channel for index in known}
    return named <= {"time", "group", "direction"} and any(kind_of(cell) == TEXT for cell in first)


def _lines_of(text: str, separator: str) -> Iterator[tuple[int, list[str]]]:
    """Number and cells of the lines, one after the other."""
    position, number = 0, 0
    while position < len(text):
        end = text.find("\n", position)
        end = len(text) if end < 0 else end
        number += 1
        yield number, split_line(text[position:end][:_LONGEST_LINE], separator)
        position = end + 1


def _with_texts(notes: list[Note], texts: Sequence[tuple[str, str]], name: str) -> list[Note]:
    """The conditions of a file, and those that the sentences of its comments and its name say."""
    known = {note.key for note in notes}
    return notes + [note for note in statements(texts, name) if note.key not in known]


def _has_remarks(body: str, sample: Sequence[Sequence[str]], separator: str) -> bool:
    """Whether a few lines of a short table hold words and empty cells: events between the readings."""
    if len(body) > _SHORT_TABLE or any(kind_of(cell) == TEXT for cell in (sample[0] if sample else ())):
        return False
    return re.search(rf"(?m)^.*[^\W\d_]{{4,}}.*{separator}\s*(?:{separator}\s*)*$", body) is not None


def _has_thousands(body: str, separator: str) -> bool:
    """Whether numbers are written with marks between their thousands."""
    if separator == ",":
        return '"' in body and _QUOTED_THOUSANDS.search(body) is not None
    marked = "." in body and "," in body and _THOUSANDS.search(body)
    if marked:
        return True
    return any(mark in body for mark in "'’\u00a0\u202f") and _BLANK_THOUSANDS.search(body) is not None


def without_footer(body: str, separator: str, first_line: int) -> tuple[str, list[str]]:
    """The lines without those below the table that begin with a word where it has numbers, and a message.

    Statistics ("Mean", "Max") and remarks of a program are no readings.
    """
    first = body[:_LONGEST_LINE].lstrip("\n").partition("\n")[0].split(separator)[0].strip(' "')
    if kind_of(first) not in (NUMBER, CLOCK):
        return body, []
    end = len(body.rstrip())
    lines: list[str] = []
    gap = False  # an empty line above the first of them
    while end > 0 and len(lines) < _FOOTER_LINES:
        begin = body.rfind("\n", 0, end) + 1
        line = body[begin:end].strip()
        if line.strip(separator + " ") and kind_of(line.split(separator)[0].strip(' "')) != TEXT:
            break
        gap = not line.strip(separator + " ")
        if not gap:
            lines.append(line)
        end = begin - 1
    counted = any(_is_statistic(line, separator) for line in lines)
    titled = len(lines) > 1 and kind_of(lines[-1].strip(separator + ' "')) == TEXT
    titled = titled and separator not in lines[-1].strip(separator + " ")
    if (
        not lines
        or end <= 0
        or not (gap or counted or titled or all(_is_no_reading(line, separator) for line in lines))
    ):
        return body, []
    kept = body[:end]
    row = first_line + kept.count("\n") + 1
    shown = ", ".join(f"'{line[:40]}'" for line in lines[::-1][:4])
    return kept, [f"the text below the table, from row {row} on, is not read: {shown}"]


def _is_no_reading(line: str, separator: str) -> bool:
    """Whether a line that begins with a word holds no number, or is a line of statistics."""
    return _is_statistic(line, separator) or not any(
        kind_of(cell) == NUMBER for cell in line.split(separator)
    )


def _is_statistic(line: str, separator: str) -> bool:
    words = words_of(line.split(separator)[0])
    return bool(words) and words[0] in STATISTICS


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
        text, encoding = decoded_otherwise(data)
        messages.append(f"the file is not UTF-8: read as {encoding}")
    if not text.strip():
        raise InputError(
            f"{name}, row 1: the file is empty",
            field="row 1",
            hint="it needs a header and one line per reading",
        )
    if "D+" in text or "D-" in text:
        text = _FORTRAN.sub(r"\1E\2", text)
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


def _split(text: str, name: str) -> tuple[list[Note], list[tuple[str, str]], str, str, int, str]:
    """(conditions, comments and where they stand, separator, header line, its row, text below it)."""
    notes: list[Note] = []
    comments: list[tuple[str, str]] = []
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
            comment = bare.strip(';,\t "')
            note = note_of_line(comment, f"{name}, row {row}")
            if note is not None:
                notes.append(note)
            comments.append((comment.lstrip("# ")[:_LONGEST_COMMENT], f"line {row}"))
        elif re.fullmatch(r"sep=[,;\t]", bare):  # a spreadsheet's own hint
            separator = bare[-1]
        elif bare.strip(",;\t "):
            separator = separator or next((s for s in "\t;," if s in line), ",")
            return notes, comments, separator, line, row, text[position:]
    raise InputError(
        f"{name}, row {row}: the header names no column", field=f"row {row}", hint=HEADER_EXAMPLE
    )
