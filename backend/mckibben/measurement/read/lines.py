"""The table of a text that is not plain: preambles, head lines, unit rows, blocks, logs of keys and values.

Every line keeps its number.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from mckibben.measurement.read.blocks import Table
from mckibben.measurement.read.column_lists import is_column_list
from mckibben.measurement.read.conditions import note_of_line
from mckibben.measurement.read.correction import Correction
from mckibben.measurement.read.grid import TextGrid, separator_of
from mckibben.measurement.read.head_text import taken_apart, without_paths
from mckibben.measurement.read.legend import explain_heads
from mckibben.measurement.read.limits import check_columns, check_rows
from mckibben.measurement.read.recognise import recognise
from mckibben.measurement.read.reshape import Regular, regular
from mckibben.measurement.read.source import RawTable
from mckibben.measurement.read.stated import in_known_words, statements
from mckibben.measurement.read.table_source import source_of
from mckibben.measurement.read.tables import choose, tables_of_grid
from mckibben.measurement.read.unit_words import unit_of

_ALL_LINES = 100_000  # a longer text is taken as one table after its first lines
_ALL_CHARACTERS = 30_000_000
_LABVIEW = re.compile(r"(?i)labview measurement\b")
_FIRST_LINES = 5000
_LONGEST_LINE = 200_000  # characters
_PAIR = re.compile(
    r"""["']?(?P<key>[A-Za-zµκ][A-Za-z0-9_ ]{0,30}?)["']?\s*[:=]\s*"""
    r"""(?P<value>[+-]?[0-9]+(?:\.[0-9]*)?(?:[eE][+-]?[0-9]+)?)(?:\s?(?P<unit>[A-Za-zµ°%][A-Za-z²2/]*)(?![\w=:])"""
    r"""(?!\s*[:=])|(?![\w:.]))"""
)
_UNIT_SAID = re.compile(r"(?i)\bunits?\s*[:=]\s*[\"'\[(]?([^\s,;\"'\])]+)")
_STAMP = re.compile(
    r"\s*\[?(?P<clock>(?:[0-9]{4}-[0-9]{2}-[0-9]{2}[T ])?"
    r"[0-9]{1,2}:[0-9]{2}:[0-9]{2}(?:[.,][0-9]{1,6})?)\]?(?=[\s,;])"
)
_ALIKE = 2.0  # how much more a line with the same three keys and more counts
_KEYED_SHARE = 0.5  # of the lines, from which a text is a log of keys and values


def located_text(text: str, name: str, correction: Correction, messages: Sequence[str]) -> RawTable | None:
    """The table of a text, wherever it stands; None = no table is found.

    Raises:
        InputError: the head or sheet of the user is not there; too many rows or columns.
    """
    check_rows(text.count("\n") + 1, name)
    lines = original = text.split("\n")
    if max(map(len, lines)) > _LONGEST_LINE:
        return None
    notes = [
        note
        for row, line in enumerate(lines[:_FIRST_LINES], start=1)
        if line.lstrip(' "').startswith("#")
        and (note := note_of_line(line.strip(';,\t "'), f"{name}, row {row}")) is not None
        and not is_column_list(line)
    ]
    values = {}
    for note in notes:
        values.setdefault(note.key, set()).add(note.value)
    notes = [note for note in notes if len(values[note.key]) == 1]  # others are titles of blocks
    stated = {int(note.where.rpartition(" ")[2]) for note in notes}
    lines = ["" if number in stated else line for number, line in enumerate(lines, start=1)]
    said = list(messages)
    keyed = _keyed(lines)
    if keyed is not None:
        lines, remarks = keyed
        grid = TextGrid(lines, name, "\t")
        said.append(f"a log of keys and values: {len(remarks)} lines without readings are not read")
    else:
        hint = next((line[4] for line in lines[:20] if re.fullmatch(r"sep=[,;\t]", line.strip())), None)
        grid = TextGrid(lines, name, hint or separator_of(_sampled(lines)))
        remarks = []
    long = len(lines) > _ALL_LINES or len(text) > _ALL_CHARACTERS
    reshaped = Regular(grid, [], [], False) if long or keyed else regular(grid)
    said += reshaped.messages
    tables = tables_of_grid(reshaped.grid, head=correction.head, until=_FIRST_LINES if long else None)
    if not any(any(table.names) or any(table.units) for table in tables):
        return None
    chosen = choose(tables, sheet=None)
    table = chosen.table
    check_columns(len(table.names), f"{name}, row {table.head_row}", f"row {table.head_row}")
    _name_abscissa(table)
    _units_of_comments(table, original)
    explain_heads(table)
    table.rest += remarks
    table.unread = [*table.unread, *chosen.unread, *reshaped.unread]
    found = in_known_words(notes)
    known = {note.key for note in found}
    sentences = [(original[row - 1].strip('#;, \t"'), f"line {row}") for row in sorted(stated)]
    found += [note for note in statements([*table.rest, *sentences], name) if note.key not in known]
    shown = (
        (number, [line] if keyed or number in stated else grid.cells(number - 1))
        for number, line in enumerate(original, start=1)
    )
    return source_of(
        table, format="csv", notes=found, messages=[*said, *chosen.messages], shown=shown,
        rewritten=keyed is not None or reshaped.rewritten,
    )  # fmt: skip


def _sampled(lines: Sequence[str]) -> list[str]:
    """Lines from which the separator is told: the first ones, and some further down."""
    return [*lines[:400], *lines[len(lines) // 2 : len(lines) // 2 + 200]]


def _name_abscissa(table: Table) -> None:
    """What a preamble says of the first column, where its head is "X_Value": the time in seconds.

    LabVIEW writes seconds there unless it says another dimension.
    """
    for index, column in enumerate(table.names):
        if re.fullmatch(r"(?i)x[_ ]?values?(?: #[0-9]+)?", column) and table.units[index] is None:
            said = next((each for each in table.rest if re.match(r"(?i)x[_ ]dimension\W", each[0])), None)
            if said is not None and not re.match(r"(?i)x[_ ]dimension\W+time", said[0]):
                continue
            said = said or next((each for each in table.rest if _LABVIEW.match(each[0])), None)
            if said is not None:
                table.names[index], table.units[index] = f"{column} (time)", "s"
                table.messages.append(f"'{column}' is the time in s ({said[1]}: '{said[0][:40]}')")


def _units_of_comments(table: Table, lines: Sequence[str]) -> None:
    """Units that comment lines say of columns by their full names: ``# /rig/p  units=kPa``, ``# p: bar``."""
    above = range(min((table.head_row or 1) - 1, _FIRST_LINES))
    comments = [(i, lines[i].lstrip("# \t")) for i in above if lines[i].lstrip().startswith("#")]
    for index, (name, bare) in enumerate(zip(table.names, without_paths(table.names), strict=True)):
        if not name or table.units[index] is not None or taken_apart(bare).unit is not None:
            continue
        for line, text in comments:
            if not re.match(rf"{re.escape(name)}(?![\w./])", text):
                continue
            rest = text[len(name) :].strip()
            found = _UNIT_SAID.search(rest) or re.fullmatch(r"[:=\s]*[\[(]?([^\s\[\]()]+)[\])]?", rest)
            if found and unit_of(found[1]) is not None:
                table.units[index] = found[1]
                table.unit_where = table.unit_where or f"line {line + 1}"
                table.messages.append(f"column '{name}' is in {found[1]} (line {line + 1})")
                break


def _keyed(lines: Sequence[str]) -> tuple[list[str], list[tuple[str, str]]] | None:
    """A log of "key: value" pairs as lines of a table, and its other lines; None = it is no such log.

    Its lines keep their numbers: one without readings becomes an empty line.
    """
    filled = [line for line in lines[:600] if line.strip()]
    counted = [_pairs(line) for line in filled]
    share = sum(len(pairs) >= 2 for pairs in counted)
    first = next((pairs for pairs in counted if len(pairs) >= 2), {})
    alike = sum(pairs.keys() >= first.keys() for pairs in counted) if len(first) > 2 else 0
    if len(filled) < 3 or max(share, _ALIKE * alike) < _KEYED_SHARE * len(filled):
        return None
    keys = list(first)
    stamped = _stamps(line for line, pairs in zip(filled, counted, strict=True) if len(pairs) >= 2)
    stamped = stamped and not any(key.lower() == "t" or recognise(key).channel == "time" for key in keys)
    rest, rows = [], []
    for number, line in enumerate(lines, start=1):
        pairs = _pairs(line)
        good = len(pairs) >= 2 and (_ALIKE * alike < share or pairs.keys() >= first.keys())
        stamp = [found["clock"] if (found := _STAMP.match(line)) else ""] if stamped else []
        rows.append("\t".join([*stamp, *(pairs.get(key, "") for key in keys)]) if good else "")
        if line.strip() and not good:
            rest.append((line.strip(), f"line {number}"))
    units = _units_of_pairs(filled)
    heads = [_head_of_key(key, [text for text, _ in rest], units.get(key)) for key in keys]
    heads = ["time", *heads] if stamped else heads
    row = next((number for number, line in enumerate(rows) if line), 0)
    if row == 0:
        return None if not rows else (["\t".join(heads), *rows], [(text, where) for text, where in rest])
    rows[row - 1] = "\t".join(heads)
    return rows, [(re.sub(r"^.*?(?:->|\])\s*", "", text), where) for text, where in rest]


def _pairs(line: str) -> dict[str, str]:
    body = re.sub(r"^.*?->\s*", "", line)
    return {
        found["key"].strip(): found["value"]
        for found in _PAIR.finditer(body)
        if found["unit"] is None or unit_of(found["unit"]) is not None
    }


def _stamps(lines: Iterable[str]) -> bool:
    """Whether all lines begin with a time of day or a date and time."""
    found = [_STAMP.match(line) is not None for line in lines]
    return bool(found) and all(found)


def _units_of_pairs(lines: Sequence[str]) -> dict[str, str]:
    """Key -> unit behind its numbers, where it is the same in all lines: ``p=2.001bar``."""
    found: dict[str, set[str]] = {}
    for line in lines:
        for pair in _PAIR.finditer(re.sub(r"^.*?->\s*", "", line)):
            found.setdefault(pair["key"].strip(), set()).add(pair["unit"] or "")
    return {key: units.pop() for key, units in found.items() if len(units) == 1 and units != {""}}


def _head_of_key(key: str, texts: Sequence[str], unit: str | None) -> str:
    """A key with its unit, or that of another line: "x[mm shortening]" -> ``x shortening [mm]``.

    ``x=shortening`` in another line says what it is.
    """
    said = next(
        (
            f[1]
            for text in texts
            if (f := re.search(rf"(?<![\w]){re.escape(key)}\s*[=:]\s*([^\W\d][^\s,;]*)", text))
        ),
        "",
    )
    if unit is not None:
        return f"{key} {said} [{unit}]" if said else f"{key} [{unit}]"
    if said and unit_of(said) is None and recognise(f"{key} {said}").channel is not None:
        return f"{key} {said}"
    for text in texts:
        for found in re.finditer(rf"(?<![\w]){re.escape(key)}\s*[\[(]([^\])]*)[\])]", text):
            inside = found[1].strip()
            if unit_of(inside) is not None:
                return f"{key} [{inside}]"
            first, _, words = inside.partition(" ")
            if unit_of(first.strip(",")) is not None:
                return f"{key} {words.strip()} [{first.strip(',')}]"
    return key
