"""Measurements from delimited text (CSV): bytes to a Measurement in SI.

UTF-8 with or without BOM; ``,`` ``;`` or tab; decimal point or comma; ``# key: value`` above the header.
"""

from __future__ import annotations

import hashlib
import re
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from mckibben.identification.measurement import CHANNEL_UNITS, STROKES, Measurement, build
from mckibben.identification.read.header import (
    HEADER_EXAMPLE,
    SAMPLE,
    SLACK,
    TEXT_COLUMNS,
    Column,
    map_headers,
    split_mark,
)
from mckibben.identification.read.table import Labels, Table, read_table, split_header
from mckibben.physics.errors import InputError
from mckibben.physics.units import convert, si

ATMOSPHERE = 101_325.0  # Pa, subtracted from an absolute pressure
LARGEST = 1e100  # no physical value is; keeps sums and ranges of a column finite

#: Conditions that are physical values -> SI unit; the others stay text.
CONDITION_UNITS = {
    "load_mass": "kg", "load_force": "N", "supply_pressure": "Pa", "nominal_length": "m", "temperature": "K",
}  # fmt: skip
_KEY_LINE = re.compile(r"#+\s*([A-Za-z][A-Za-z_ -]{0,30}?)\s*:\s*(.*)")
_CONTROL = re.compile(rb"[\x00-\x08\x0b\x0e-\x1f\x7f]")
_SHORTENING = {"up", "u", "p", "positive", "fill", "filling", "inflation", "inflating", "shortening"}
_LENGTHENING = {"down", "d", "n", "negative", "vent", "venting", "deflation", "deflating", "lengthening"}
_UNKNOWN = {"", "-", "unknown", "none"}
_LOADING = {"load": 1.0, "loading": 1.0, "unload": -1.0, "unloading": -1.0}


def read_csv(data: bytes, name: str) -> Measurement:
    """The measurement in a delimited text.

    Args:
        data: the file's bytes.
        name: file name, for messages.

    Raises:
        InputError: whatever is wrong with the file, naming file, row (1-based line), column, remedy.
    """
    messages: list[str] = []
    text = _decoded(data, name, messages)
    preamble, separator, header_line, row, body = _split(text, name)
    conditions = _conditions(preamble, name, messages)
    headers = split_header(header_line, separator, name=name, row=row)
    mapping = map_headers(headers, name=name, row=row)
    messages += mapping.messages
    table = read_table(
        body, separator, headers, name=name, first_line=row + 1,
        numeric=[c.index for c in mapping.columns if c.use not in TEXT_COLUMNS],
        text=[c.index for c in mapping.columns if c.use in TEXT_COLUMNS],
    )  # fmt: skip
    reading = _Reading(name, table, conditions, messages, list(mapping.ignored))
    columns: dict[str, NDArray] = {}
    for column in mapping.columns:
        if column.use not in TEXT_COLUMNS:
            columns |= _channel(column, reading)
    by_use = {column.use: column for column in mapping.columns}
    slack = _read_labels(by_use, columns, reading)
    kind = conditions.pop("kind", None)
    return build(
        columns,
        name=name,
        id=hashlib.sha256(data).hexdigest(),
        kind=None if kind is None else str(kind).lower(),
        origins={c: (by_use[c].header, by_use[c].unit or CHANNEL_UNITS[c]) for c in columns},
        ignored=sorted(reading.ignored, key=lambda h: headers.index(h) if h in headers else len(headers)),
        conditions=conditions,
        marked_slack=slack,
        messages=messages,
    )


class _Reading(NamedTuple):
    """What the conversion of columns reads and adds to."""

    name: str
    table: Table
    conditions: dict[str, float | str]
    messages: list[str]
    ignored: list[str]

    def drop(self, column: Column, why: str) -> None:
        self.ignored.append(column.header)
        self.messages.append(f"column '{column.header}' is not used: {why}")


def _decoded(data: bytes, name: str, messages: list[str]) -> str:
    """The text with ``\\n`` line ends; refuses what is not text."""
    if data[:2] in (b"\xff\xfe", b"\xfe\xff"):
        raise InputError(f"{name}: the file is UTF-16 text", field="file", hint="save it as 'CSV UTF-8'")
    if control := _CONTROL.search(data):
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
        raise InputError(f"{name}: the file is empty", field="file", hint="a header and one line per reading")
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _split(text: str, name: str) -> tuple[list[tuple[int, str]], str, str, int, str]:
    """(comment lines with their row, separator, header line, row of the header, text below it)."""
    preamble: list[tuple[int, str]] = []
    separator = None
    row, position = 0, 0
    while position < len(text):
        end = text.find("\n", position)
        end = len(text) if end < 0 else end
        line = text[position:end]
        row, position = row + 1, end + 1
        bare = line.strip()
        if bare.lstrip('"').startswith("#"):
            preamble.append((row, bare.strip(';,\t "')))
        elif re.fullmatch(r"sep=[,;\t]", bare):  # a spreadsheet's own hint
            separator = bare[-1]
        elif bare.strip(",;\t "):
            separator = separator or next((s for s in "\t;," if s in line), ",")
            return preamble, separator, line, row, text[position:]
    raise InputError(f"{name}: the header names no column", field="header", hint=HEADER_EXAMPLE)


def _conditions(preamble: list[tuple[int, str]], name: str, messages: list[str]) -> dict[str, float | str]:
    """``# key: value`` lines; the known physical ones in SI."""
    conditions: dict[str, float | str] = {}
    for row, line in preamble:
        found = _KEY_LINE.fullmatch(line)
        if found is None or not found.group(2):
            continue  # a plain comment
        key = re.sub(r"[ -]+", "_", found.group(1).lower())
        value = found.group(2).strip()[:200]
        if key not in CONDITION_UNITS:
            conditions[key] = value
            continue
        unit, field = CONDITION_UNITS[key], f"{name}, row {row}, {key}"
        plain, absolute = split_mark(re.sub(r"^([+-]?[0-9]+),([0-9]+)", r"\1.\2", value))
        if re.fullmatch(r"[+-]?[0-9.]+(?:[eE][+-]?[0-9]+)?", plain):
            messages.append(f"{key}: no unit given, read as {plain} {unit}")
            plain = f"{plain} {unit}"
        number = si(plain, unit, field=field) - (ATMOSPHERE if absolute else 0.0)
        if number < 0.0:
            raise InputError(f"{field}: '{value}' is negative", field=key, hint="a value of 0 or more")
        conditions[key] = number
    return conditions


def _channel(column: Column, reading: _Reading) -> dict[str, NDArray[np.float64]]:
    """The channel of one numeric column in SI; empty when its numbers show that it is not one."""
    raw = reading.table.numbers[column.index]
    use, unit, messages = column.use, column.unit, reading.messages
    label = f"column '{column.header}'"
    if unit is None:
        largest = float(np.max(np.abs(raw)))
        if use == "contraction" and largest > 1.5:
            unit = "%"
        elif use == "temperature" and largest < 150.0:
            unit = "degC"
        if use != "command":
            messages.append(f"{label} has no unit: read as {unit or CHANNEL_UNITS[use]}")
    values = convert(raw, unit or CHANNEL_UNITS[use], CHANNEL_UNITS[use], field=label)
    if use == "command" and np.max(np.abs(values)) > 1.001:
        reading.drop(column, "a command is the share of valve opening, -1 to 1")
        return {}
    huge = ~(np.abs(values) < LARGEST)
    if huge.any():
        raise _value_error(reading, column, huge, "is too large", "a number of physical size")
    bad, what, hint = np.zeros(len(values), bool), "", ""
    if use == "pressure":
        said = str(reading.conditions.get("pressure", "")).lower()
        by_line = True if said.startswith("abs") else False if said.startswith(("gauge", "rel")) else None
        absolute = by_line if column.absolute is None else column.absolute
        if absolute:
            values -= ATMOSPHERE
            messages.append(f"{label} is absolute pressure: {ATMOSPHERE:.0f} Pa subtracted")
        elif absolute is None:
            messages.append(f"{label} read as gauge pressure")
        bad = values < -ATMOSPHERE
        what = "is a negative absolute pressure"
        hint = "say 'pressure_abs_bar' or '# pressure: absolute' where it is absolute, gauge is assumed"
    elif use in ("length", "diameter", "temperature"):
        bad = values <= 0.0
        what, hint = f"is not a {use}", f"a {use} above 0"
    elif use == "contraction":
        bad = values >= 1.0
        what, hint = "leaves no length", "contraction is (L0 - L)/L0 < 1; percent is 'contraction_pct'"
    if bad.any():
        raise _value_error(reading, column, bad, what, hint)
    return {use: values}


def _value_error(
    reading: _Reading, column: Column, bad: NDArray[np.bool_], what: str, hint: str
) -> InputError:
    first, count = int(np.argmax(bad)), int(np.count_nonzero(bad))
    line, value = int(reading.table.lines[first]), reading.table.numbers[column.index][first]
    more = f" (and {count - 1} more such rows)" if count > 1 else ""
    unit = f" {column.unit}" if column.unit else ""
    return InputError(
        f"{reading.name}, row {line}, column '{column.header}': {value:g}{unit} {what}{more}",
        field=f"row {line}, column {column.header}", hint=hint,
    )  # fmt: skip


def _read_labels(
    by_use: dict[str, Column], columns: dict[str, NDArray], reading: _Reading
) -> NDArray[np.bool_] | None:
    """Add direction, group and sample; returns the rows marked as slack."""
    labels = {use: reading.table.labels[c.index] for use, c in by_use.items() if use in TEXT_COLUMNS}
    if "group" in labels:
        columns["group"] = _group(labels["group"])
    if "direction" in labels:
        direction = _direction(labels["direction"], columns, reading.messages)
        if direction is None:
            reading.drop(by_use["direction"], "its words are not known, e.g. 'filling' and 'venting'")
        else:
            columns["direction"] = direction
    if SAMPLE in labels:
        words = labels[SAMPLE].words
        if len(words) == 1 and words[0]:
            reading.conditions.setdefault("sample", words[0][:200])
        else:
            reading.drop(by_use[SAMPLE], "it names more than one muscle")
    if SLACK not in labels:
        return None
    marks = {"0": False, "0.0": False, "false": False, "1": True, "1.0": True, "true": True}
    words = [word.lower() for word in labels[SLACK].words]
    if "force" not in columns or any(word not in marks for word in words):
        reading.drop(by_use[SLACK], "slack is marked by 0 and 1 beside a force")
        return None
    return np.array([marks[word] for word in words])[labels[SLACK].codes]


def _group(labels: Labels) -> NDArray[np.int64]:
    """Integer labels as they are, other words numbered from 0 in order of appearance."""
    whole = [int(word) if re.fullmatch(r"[+-]?[0-9]{1,9}", word) else None for word in labels.words]
    numbers = [n for n in whole if n is not None]
    chosen = numbers if len(set(numbers)) == len(labels.words) else range(len(labels.words))
    return np.array(chosen, dtype=np.int64)[labels.codes]


def _direction(
    labels: Labels, columns: dict[str, NDArray], messages: list[str]
) -> NDArray[np.float64] | None:
    """-1 shortening, +1 lengthening, 0 unknown; None when a word is not understood.

    "load" alone says too little (a weight lengthens, air shortens): there the stroke, else the pressure, of
    neighbouring rows decides.
    """
    values = []
    for word in (w.lower() for w in labels.words):
        if word in _SHORTENING or word in _LENGTHENING:
            values.append(-1.0 if word in _SHORTENING else 1.0)
        elif word in _LOADING:
            values.append(_LOADING[word] * _loading_sign(labels, columns))
        elif re.fullmatch(r"[+-]?[01](\.0*)?", word) or word in _UNKNOWN:
            values.append(float(word) if word not in _UNKNOWN else 0.0)
        else:
            return None
    meaning = {-1.0: "shortening", 1.0: "lengthening", 0.0: "unknown"}
    read = ", ".join(f"'{w}' as {meaning[v]}" for w, v in zip(labels.words, values, strict=True))
    messages.append(f"direction read: {read}")
    return np.array(values)[labels.codes]


def _loading_sign(labels: Labels, columns: dict[str, NDArray]) -> float:
    """Direction of rows called "load": the sign of the summed change of length along them."""
    side = np.array([_LOADING.get(word.lower(), 0.0) for word in labels.words])[labels.codes]
    same = (side[1:] == side[:-1]) * side[1:]
    for channel in (*STROKES, "pressure"):
        if channel in columns and np.ptp(columns[channel]) > 0.0:
            change = float(np.sum(np.diff(columns[channel]) * same))
            return float(np.sign(change)) * (1.0 if channel == "length" else -1.0)
    return 0.0
