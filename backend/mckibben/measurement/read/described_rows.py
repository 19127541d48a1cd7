"""Rows of a JSON document joined with the list of their channels: `channels: [{name, unit}], data: [[]]`."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from mckibben.measurement.read.limits import MAX_COLUMNS
from mckibben.measurement.read.recognise import recognise
from mckibben.measurement.read.unit_words import reference_of, unit_of
from mckibben.measurement.read.vocabulary import SIGN_WORDS, folded, has_word, words_of

_NAMES = (
    "name",
    "channel",
    "quantity",
    "label",
    "signal",
    "id",
    "key",
    "title",
    "column",
    "field",
    "bezeichnung",
)
_UNITS = ("unit", "units", "uom", "einheit", "unite", "unidad", "unita")
_WORDS = (
    "description",
    "desc",
    "quantity",
    "meaning",
    "beschreibung",
    "comment",
    "remark",
    "longname",
    "long_name",
)
_SHORT = 60  # characters
_DEEPEST = 12
_FEWEST = 3  # readings


def with_described_rows(document: Any) -> Any:
    """The document with the rows of one table as records under the heads of its channels.

    It is joined only where one list describes the columns (a name each, one unit at least) and one list of
    rows has as many numbers in each; every other document stays as it is.
    """
    lists = list(_lists(document, 0))
    described = [found for found in lists if _is_described(found)]
    if len(described) != 1:
        return document if described else _with_named_points(document, lists)
    (channels,) = described
    width = len(channels)
    renamed = _with_described_names(document, lists, channels)
    if renamed is not None:
        return renamed
    heads = [_head(channel) for channel in channels]
    if len(set(heads)) != width or not any(recognise(head).channel for head in heads):
        return document
    signs = {f"sign {number}": text for number, c in enumerate(channels) if (text := _sign(c))}
    joined = _with_heads(document, heads, channels)
    return {**joined, **signs} if isinstance(joined, dict) else document


def _with_named_points(document: Any, lists: Sequence[list[Any]]) -> Any:
    """The document with the rows of several runs as records under the one list of names further out.

    ``{"point": ["shortening_mm", "force_N"], "runs": [{"p_bar": 2, "points": [[0, 570], ...]}, ...]}``; the
    names are the only list of texts that name two channels, and no other rows have as many numbers.
    """
    named = [found for found in lists if _names_channels(found)]
    if len(named) != 1 or not isinstance(document, dict):
        return document
    (names,) = named
    heads = [str(name).strip() for name in names]
    return _with_heads(document, heads, names) or document


def _names_channels(value: Sequence[Any]) -> bool:
    """Whether a list holds the different names of columns, two channels among them."""
    if (
        not 2 <= len(value) <= MAX_COLUMNS
        or not all(isinstance(name, str) for name in value)
        or len(set(value)) < len(value)
    ):
        return False
    return len({channel for name in value if (channel := recognise(name).channel)}) > 1


def _with_heads(document: Any, heads: Sequence[str], names: list[Any]) -> dict[str, Any] | None:
    """The document with its rows of as many numbers as records; None = it has none, or of several names.

    Rows of several runs stand under the same key of each.
    """
    keys: set[str] = set()

    def joined(value: Any, key: str, depth: int) -> Any:
        if depth > _DEEPEST:
            return value
        if isinstance(value, dict):
            return {k: joined(item, k, depth + 1) for k, item in value.items() if item is not names}
        if not isinstance(value, list):
            return value
        table = _rows(value, len(heads))
        if table:
            keys.add(key)
            return [dict(zip(heads, row, strict=True)) for row in table]
        return [joined(v, key, depth + 1) for v in value] if value and isinstance(value[0], dict) else value

    result = joined(document, "", 0)
    return result if len(keys) == 1 and isinstance(result, dict) else None


def _with_described_names(document: Any, lists: Sequence[list[Any]], channels: list[Any]) -> Any:
    """The document with its records under the heads of the channels they name; None = they name none."""
    heads = {_named(channel, _NAMES): _head(channel) for channel in channels}
    tables = [
        rows
        for rows in lists
        if rows is not channels and len(rows) >= _FEWEST and all(isinstance(row, dict) for row in rows)
        and len(set(heads) & set(rows[0])) >= 2
    ]  # fmt: skip
    if len(tables) != 1 or len(set(heads.values())) != len(channels):
        return None
    (rows,) = tables
    records = [{heads[k] if k in heads else str(k): cell for k, cell in row.items()} for row in rows]
    joined = _replaced(document, rows, records, channels)
    signs = {f"sign {number}": text for number, c in enumerate(channels) if (text := _sign(c))}
    return {**joined, **signs} if isinstance(joined, dict) else None


def _lists(value: Any, depth: int) -> Iterator[list[Any]]:
    if depth > _DEEPEST:
        return
    if isinstance(value, list):
        yield value
    elif isinstance(value, dict):
        for item in value.values():
            yield from _lists(item, depth + 1)


def _is_described(value: Sequence[Any]) -> bool:
    """Whether a list holds a description of a channel each: texts, a name among them, no list of readings."""
    if not 2 <= len(value) <= MAX_COLUMNS or not all(
        isinstance(one, dict) and _named(one, _NAMES) for one in value
    ):
        return False
    plain = not any(isinstance(item, (list, dict)) for one in value for item in one.values())
    return plain and any(_named(one, _UNITS) for one in value)


def _named(channel: Mapping[str, Any], keys: Sequence[str]) -> str:
    """The text under the first of some keys; "" = none."""
    plain = {folded(key): item for key, item in channel.items()}
    return next((plain[k].strip() for k in keys if isinstance(plain.get(k), str) and plain[k].strip()), "")


def _rows(value: Sequence[Any], width: int) -> list[list[Any]] | None:
    """The rows of as many numbers each, also of one list for each column; None = it is no such table."""
    if not value or not all(isinstance(row, list) for row in value):
        return None
    if not all(_is_reading(cell) for row in value for cell in row):
        return None
    lengths = {len(row) for row in value}
    if lengths == {width} and len(value) >= _FEWEST and len(value) != width:
        return list(value)
    if len(value) == width and len(lengths) == 1 and max(lengths) >= _FEWEST and lengths != {width}:
        return [list(row) for row in zip(*value, strict=True)]
    return None


def _is_reading(cell: Any) -> bool:
    return cell is None or (isinstance(cell, (int, float, str)) and not isinstance(cell, bool))


def _head(channel: Mapping[str, Any]) -> str:
    """The head of a column: its name, its unit, what a pressure counts from."""
    name, unit = _named(channel, _NAMES), _named(channel, _UNITS)
    said = _named(channel, _WORDS)
    if said and len(said) < _SHORT and recognise(name, unit or None).channel is None:
        name = f"{name} {said}" if recognise(f"{name} {said}", unit or None).channel else name
    head = f"{name} [{unit}]" if unit and unit_of(unit) is not None and recognise(name).unit is None else name
    marks = {
        v.strip() for v in channel.values() if isinstance(v, str) and reference_of(v.strip()) is not None
    }
    marks -= {name, unit}
    return f"{head} ({marks.pop()})" if len(marks) == 1 else head


def _sign(channel: Mapping[str, Any]) -> str:
    """What a description says of the sign of its channel, as a sentence; "" = nothing."""
    for key, item in channel.items():
        if isinstance(item, str) and has_word(words_of(key), SIGN_WORDS["positive"] | SIGN_WORDS["negative"]):
            return f"{_named(channel, _NAMES)}: {key} = {item}"
        if isinstance(item, str) and has_word(words_of(key), frozenset(("sign", "direction", "vorzeichen"))):
            return f"{_named(channel, _NAMES)}: {item}"
    return ""


def _replaced(value: Any, rows: list[Any], records: list[dict[str, Any]], channels: list[Any]) -> Any:
    if value is rows:
        return records
    if isinstance(value, dict):
        return {
            key: _replaced(item, rows, records, channels)
            for key, item in value.items()
            if item is not channels
        }
    return value
