"""Delimited text, text between blanks and ``key:value`` lines as rows of cells."""

from __future__ import annotations

import csv
import re
from collections import Counter
from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from mckibben.measurement.reading.encodings import decoded
from mckibben.measurement.reading.limits import MAX_CELLS, MAX_ROW_LENGTH, MAX_ROWS, SPLIT, check_columns
from mckibben.measurement.reading.model import Cell, Sheet
from mckibben.measurement.reading.numbers import CLOCK, NUMBER, TEXT, kind_of, narrow, style_of
from mckibben.physics.errors import InputError

_FIRST, _MIDDLE = 150, 300  # lines from which the delimiter is told
_MOST_REMARKS = 100_000  # rows, from which remarks are passed over
_LONG, _HEAD_ROWS, _TAIL_ROWS = (
    20_000,
    3_000,
    2_000,
)  # lines: of a long table, and of its parts that are cells
_DELIMITERS = (";", "\t", ",", "|", None)  # None: blanks
_PREFERENCE = 0.03  # share of the score that each later delimiter must have more
_LONGEST = 20_000  # characters of a line that are looked at for the delimiter
_MOST_LINES_OF_A_CELL = 20  # a quoted cell of more is one whose quote is never closed
_COMMENT = re.compile(r'\s{0,20}"?(?:#|%|//|!|\*\*)')
_PAIR = re.compile(
    r"([^\W\d]\w{0,20}(?:\[[^\[\]]{1,10}\])?)\s?[:=]\s?([-+]?\d[\d.]{0,15}(?:[eE][-+]?\d{1,3})?)\s?([A-Za-z°%]{0,5})(?=$|[,;|\s])"
)
_PAIRED_SHARE = 0.3  # of the lines, above which they are read as pairs of key and value
_GAP = re.compile(r"\s{2,}|\t")
_SEPARATOR_HINT = re.compile(r"sep=([,;\t|])")
_NUMBER_AND_UNIT = re.compile(r"[-+]?\d{1,9}(?:[.,]\d{1,9})?\s?[^\W\d_%]{1,5}%?")
_TORN = re.compile(r"\d[;\t|]\d")  # numbers side by side in one cell: it is another sign that parts them
_STAMP = re.compile(r"\s{0,3}\[?(\d{1,2}:\d\d:\d\d(?:[.,]\d{1,6})?)\]?\s")
_MONITORED = re.compile(r"\s{0,3}\[?(?P<stamp>\d{1,2}:\d\d:\d\d(?:[.,]\d{1,6})?)(?:\]|\s?->|\s?→)\s?")
_ALL_MONITORED = 0.9  # of the lines that begin with a time, from which a monitor wrote it
_RECEIVED = "received"  # head of the times of a monitor
_RULE = re.compile(r"[|+\s]{0,4}[-=:_]{3,}[-=:|+\s]{0,2000}")  # a line drawn under a head


def text_sheets(data: bytes, name: str) -> list[Sheet]:
    """The cells of a text file.

    Raises:
        InputError: it is no text, or has more lines or cells than are read.
    """
    text, messages = decoded(data, name)
    return [sheet_of_text(text, name, messages)]


def sheet_of_text(text: str, name: str, messages: Sequence[str] = (), *, whole: bool = False) -> Sheet:
    """The cells of a decoded text; the middle of a long one as numbers, unless all rows are wanted as
    cells.
    """
    lines = narrow(text).split("\n")
    if len(lines) > MAX_ROWS:
        raise InputError(
            f"{name}: it has {len(lines)} lines, at most {MAX_ROWS} are read", field="file", hint=SPLIT
        )
    long = next((n for n, line in enumerate(lines, 1) if len(line) > MAX_ROW_LENGTH), None)
    if long is not None:
        raise InputError(
            f"{name}, row {long}: the row has more than {MAX_ROW_LENGTH} characters",
            field=f"row {long}",
            hint="one row of the table in each line; check how the lines end",
        )
    pairs = _paired(lines)
    if pairs is not None:
        rows, numbers = pairs
        return Sheet(rows=rows, noun="line", lines=tuple(numbers), messages=tuple(messages))
    stamps, lines = _without_stamps(lines)
    sample = _sample(lines)
    hint = next((m[1] for line in lines[:3] if (m := _SEPARATOR_HINT.fullmatch(line.strip()))), None)
    delimiter = hint or best_delimiter(sample)
    if (
        len(lines) > _LONG
        and not whole
        and not stamps
        and (sheet := _with_bulk(lines, delimiter, name, messages)) is not None
    ):
        return sheet
    rows, numbers = _split(lines, delimiter, name)
    usual = _usual_width(lines, delimiter)
    if stamps:
        rows = [
            row
            if len(row) != usual
            else [stamps[n - 1] if kind_of(row[0]) in (NUMBER, CLOCK) else _RECEIVED, *row]
            for n, row in zip(numbers, rows, strict=True)
        ]
        usual += 1
    chosen = [
        row for row in rows[:_FIRST] + rows[len(rows) // 2 : len(rows) // 2 + _MIDDLE] if len(row) == usual
    ]
    style = style_of(cell for row in chosen for cell in row)
    return Sheet(
        rows=rows,
        noun="line",
        decimal=style.decimal,
        thousands=style.thousands,
        lines=tuple(numbers),
        messages=tuple(messages),
    )


def _without_stamps(lines: list[str]) -> tuple[list[str], list[str]]:
    """The times of day that a monitor writes before each line, ``10:22:31.170 -> 3.4;180``, and the lines
    without them; no times where not all lines have one.
    """
    found = [_MONITORED.match(line) for line in lines]
    filled = sum(bool(line.strip()) for line in lines)
    if sum(map(bool, found)) < max(3, _ALL_MONITORED * filled):
        return [], lines
    return [m["stamp"] if m else "" for m in found], [
        line[m.end() :] if m else line for m, line in zip(found, lines, strict=True)
    ]


def _with_bulk(lines: list[str], delimiter: str | None, name: str, messages: Sequence[str]) -> Sheet | None:
    """A long table of plain numbers: its first and last rows as cells, those between as numbers; None = it is
    none.
    """
    first, last = lines[:_HEAD_ROWS], lines[-_TAIL_ROWS:]
    width = _usual_width(lines, delimiter)
    if width < 2 or delimiter == "|":
        return None
    rows, numbers = _split(first, delimiter, name)
    usual = [row for row in rows if len(row) == width]
    style = style_of(cell for row in usual[-_MIDDLE:] for cell in row)
    middle = lines[_HEAD_ROWS:-_TAIL_ROWS]
    if style.decimal == ",":
        if delimiter == ",":
            return None
        middle = [line.replace(",", ".") for line in middle]
    try:
        bulk = np.loadtxt(middle, delimiter=delimiter, comments=None, ndmin=2)
    except ValueError:
        return None
    if bulk.shape != (len(middle), width):
        return None
    below, later = _split(last, delimiter, name)
    offset = len(lines) - len(last)

    def whole() -> Sheet:
        return sheet_of_text("\n".join(lines), name, messages, whole=True)

    return Sheet(
        rows=[*rows, *below],
        noun="line",
        decimal=style.decimal,
        thousands=style.thousands,
        lines=(*numbers, *(n + offset for n in later)),
        messages=tuple(messages),
        bulk=(len(rows), bulk),
        whole=whole,
    )


def _sample(lines: Sequence[str]) -> list[str]:
    middle = max(_FIRST, len(lines) // 2 - _MIDDLE // 2)
    rows = [line for line in lines[:20_000] if line.strip() and not _COMMENT.match(line)][:_FIRST]
    chosen = [*lines[:_FIRST], *rows, *lines[middle : middle + _MIDDLE]]
    return [line[:_LONGEST] for line in chosen if line.strip()]


def best_delimiter(sample: Sequence[str]) -> str | None:
    """The delimiter with which most cells are numbers, fewest are texts, and rows are of one width."""
    scores = [(_score(sample, d) * (1.0 - _PREFERENCE * rank), d) for rank, d in enumerate(_DELIMITERS)]
    best, delimiter = max(scores, key=lambda item: item[0])
    if best <= 0.0:
        joined = "\n".join(sample)
        return max((";", "\t", ","), key=joined.count)
    return delimiter


def _score(sample: Sequence[str], delimiter: str | None) -> float:
    """Numbers less texts, of rows with two numbers at least; rows of the usual width count in full."""
    good: list[tuple[int, float]] = []
    for line in sample:
        if delimiter is not None and delimiter not in line:
            continue
        cells = _cells_of(line, delimiter)
        kinds = [kind_of(cell) for cell in cells]
        with_unit = sum(
            k == TEXT and _NUMBER_AND_UNIT.fullmatch(c) is not None for k, c in zip(kinds, cells, strict=True)
        )
        stamps = sum(a == b == CLOCK for a, b in pairwise(kinds)) if delimiter is None else 0  # date and time
        numbers = kinds.count(NUMBER) + kinds.count(CLOCK) - stamps + with_unit
        if numbers >= 2:
            torn = sum(k == TEXT and _TORN.search(c) is not None for k, c in zip(kinds, cells, strict=True))
            texts = 0.7 * (kinds.count(TEXT) - with_unit) + 0.3 * torn
            good.append((len(cells), numbers - texts - 0.2 * with_unit))
    if not good:
        return 0.0
    width = Counter(width for width, _ in good).most_common(1)[0][0]
    return sum(value if w == width else 0.3 * value for w, value in good)


def _cells_of(line: str, delimiter: str | None) -> list[str]:
    if delimiter is None:
        return line.split()
    if '"' in line and delimiter != "|":
        try:
            return [
                cell.strip() for cell in next(csv.reader([line], delimiter=delimiter, skipinitialspace=True))
            ]
        except (csv.Error, StopIteration):
            pass
    cells = [cell.strip() for cell in line.split(delimiter)]
    return cells[1:-1] if delimiter == "|" and len(cells) > 2 and not cells[0] and not cells[-1] else cells


def _split(lines: Sequence[str], delimiter: str | None, name: str) -> tuple[list[list[Cell]], list[int]]:
    """(rows of cells, number of the line of each)."""
    spans = _fixed_columns(lines) if delimiter is None else []
    quoted = delimiter not in (None, "|") and any('"' in line for line in lines)
    usual = _usual_width(lines, delimiter)
    rows: list[list[Cell]] = []
    numbers: list[int] = []
    count = 0
    for number, cells in _quoted(lines, str(delimiter), name) if quoted else enumerate(lines, 1):
        line = lines[number - 1]
        if line.startswith("#") and len(rows) > _MOST_REMARKS:
            continue
        row = cells if isinstance(cells, list) else _row(line, delimiter)
        if _RULE.fullmatch(line) and len(line) < _LONGEST:
            continue
        if (_COMMENT.match(line) and not (len(row) == usual and str(row[0]) == "%")) or (
            len(row) != usual and _is_sentence(line, row, delimiter)
        ):
            bare = line.strip().lstrip('#%/!*" ').strip()
            again = _row(bare, delimiter)
            sentence = sum("=" in cell or ":" in cell for cell in again) * 2 >= len(again)
            sentence |= delimiter == "," and _DECIMAL.search(bare) is not None and not _is_numbers(again)
            row = (
                again
                if len(again) == usual and len(again) > 1 and not sentence
                else [line.strip().strip(',;\t "')]
            )
        row = _below_columns(line, row, spans) if spans and len(row) < len(spans) else row
        count += len(row)
        if count > MAX_CELLS:
            raise InputError(f"{name}: it has more than {MAX_CELLS} cells", field="file", hint=SPLIT)
        check_columns(len(row), f"{name}, row {number}", f"row {number}")
        rows.append(list(row))
        numbers.append(number)
    return rows, numbers


_DECIMAL = re.compile(r"\d,\d")


def _is_numbers(cells: Sequence[str]) -> bool:
    return all(kind_of(cell) in (NUMBER, CLOCK) for cell in cells)


def _fixed_columns(lines: Sequence[str]) -> list[tuple[int, int]]:
    """Begin and end of the columns of a text with blanks between them; none where they do not line up."""
    usual = _usual_width(lines, None)
    found = [
        [m.span() for m in _WORD.finditer(line.expandtabs())]
        for line in _sample(lines)
        if len(cells := line.split()) == usual and all(kind_of(c) in (NUMBER, CLOCK) for c in cells)
    ]
    if usual < 2 or not found:
        return []
    spans = [(min(b for b, _ in column), max(e for _, e in column)) for column in zip(*found, strict=True)]
    return spans if all(one[1] < other[0] for one, other in pairwise(spans)) else []


def _below_columns(line: str, row: list[str], spans: Sequence[tuple[int, int]]) -> list[str]:
    """The cells of a line of words, fewer than the columns, in the places of the columns they stand at."""
    if len(row) < 2 or any(kind_of(cell) in (NUMBER, CLOCK) for cell in row):
        return row
    text, begin, placed = line.expandtabs(), 0, [""] * len(spans)
    for cell in row:
        begin = text.find(cell, begin)
        over = [min(e, begin + len(cell)) - max(b, begin) for b, e in spans]
        at = over.index(max(over))  # that it stands below most
        if begin < 0 or over[at] <= 0 or any(placed[at:]):
            return row
        placed[at] = cell
        begin += len(cell)
    return placed


_WORD = re.compile(r"\S+")
_QUOTED = re.compile(r'"[^"]*"|[^\s"]+')


def _row(line: str, delimiter: str | None) -> list[str]:
    """The cells of a line; between blanks a line of words is parted at wide gaps only."""
    if delimiter is not None:
        return _cells_of(line, delimiter)
    quotes = line.count('"')
    cells = [c.strip('"') for c in _QUOTED.findall(line)] if quotes and quotes % 2 == 0 else line.split()
    numbers = sum(kind_of(cell) in (NUMBER, CLOCK) for cell in cells)
    if max(numbers, quotes // 2) * 2 >= len(cells):
        return cells
    return [cell for cell in _GAP.split(line.strip()) if cell]


def _is_sentence(line: str, row: Sequence[object], delimiter: str | None) -> bool:
    """Whether a line that is no row of the table is one sentence with commas in it."""
    if delimiter != "," or len(row) < 2:
        return False
    cells = [str(cell) for cell in row if str(cell)]
    return (
        not any(kind_of(cell) == NUMBER for cell in cells)
        and len(line.split()) > 2 * len(cells)
        and ", " in line
    )


def _usual_width(lines: Sequence[str], delimiter: str | None) -> int:
    rows = [_row(line, delimiter) for line in _sample(lines)]
    widths = Counter(len(row) for row in rows if sum(kind_of(c) in (NUMBER, CLOCK) for c in row) >= 2)
    return widths.most_common(1)[0][0] if widths else 0


def _quoted(lines: Sequence[str], delimiter: str, name: str) -> list[tuple[int, list[str]]]:
    """Rows with quoted cells, which may hold delimiters and ends of lines."""
    csv.field_size_limit(10_000_000)
    rows: list[tuple[int, list[str]]] = []
    begin = 1
    while begin <= len(lines):
        reader = csv.reader(
            (lines[k] + "\n" for k in range(begin - 1, len(lines))),  # no copy: each odd line begins anew
            delimiter=delimiter, skipinitialspace=True, strict=True,
        )  # fmt: skip
        first = begin
        try:
            for cells in reader:
                if any(cell.count("\n") > _MOST_LINES_OF_A_CELL for cell in cells):
                    raise InputError(
                        f'{name}, row {begin}: a quote (") is never closed',
                        field=f"row {begin}",
                        hint='close it with "',
                    )
                rows.append((begin, [cell.strip() for cell in cells]))
                begin = first + reader.line_num
            break
        except csv.Error as error:
            cells = _as_it_stands(lines[begin - 1], delimiter)
            if cells is None:
                closed = "unexpected end" not in str(error)
                what = (
                    f"the quotes are wrong: {error}" if closed else 'a quote (") is opened and never closed'
                )
                raise InputError(
                    f"{name}, row {begin}: {what}", field=f"row {begin}", hint='close it with "'
                ) from error
            rows.append((begin, cells))
            begin += 1
    return rows


def _as_it_stands(line: str, delimiter: str) -> list[str] | None:
    """The cells of a line of names with something behind their quotes: ``"AI_p":IW64``; None = it has numbers
    there, or a quote is open.
    """
    cells = [cell.strip() for cell in line.split(delimiter)]
    odd = [cell for cell in cells if '"' in cell.strip('"')]
    if any(cell.count('"') % 2 for cell in cells) or not odd:
        return None
    bare = [cell.replace('"', "") for cell in cells]
    return None if any(kind_of(cell.replace('"', "")) != TEXT for cell in odd) else bare


def _paired(lines: Sequence[str]) -> tuple[list[list[Cell]], list[int]] | None:
    """The lines of a log that writes each reading with its name, ``t:12 p:3.4``, as a table; None = it is
    none.
    """
    sample = [line[:1000] for line in lines[:2000] if line.strip()]
    found = [_PAIR.findall(line) for line in sample]
    many = [pairs for pairs in found if len(pairs) >= 2 and len({key for key, *_ in pairs}) == len(pairs)]
    if len(many) < max(3, _PAIRED_SHARE * len(sample)):
        return None
    usual = Counter(tuple(key for key, *_ in pairs) for pairs in many).most_common(1)[0][0]
    units = {key: unit for key, _, unit in next(p for p in many if tuple(k for k, *_ in p) == usual)}
    stamped = all(_STAMP.match(line) for line, pairs in zip(sample, found, strict=True) if len(pairs) >= 2)
    stamped = stamped and not any(key.lower() in ("t", "time", "ms", "millis") for key in usual)
    rows: list[list[Cell]] = []
    numbers: list[int] = []
    headed = False
    for number, line in enumerate(lines, 1):
        pairs = {key: value for key, value, _ in _PAIR.findall(line[:1000])}
        if sum(key in pairs for key in usual) < max(2, (len(usual) + 1) // 2):
            if line.strip() and not set(pairs) & set(usual):
                rows.append([line.strip()])
                numbers.append(number)
            continue
        if not headed:
            rows.append(
                [
                    *(["time"] if stamped else []),
                    *(f"{key} [{units[key]}]" if units[key] else key for key in usual),
                ]
            )
            numbers.append(number)
            headed = True
        stamp = _STAMP.match(line) if stamped else None
        rows.append(
            [*([stamp[1] if stamp else ""] if stamped else []), *(pairs.get(key, "") for key in usual)]
        )
        numbers.append(number)
    return rows, numbers
