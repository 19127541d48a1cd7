"""What a user says about a file beyond what it says itself: columns, kind, conditions, bad rows.

As JSON: ``{"columns": {"<header>": {"channel": "pressure", "unit": "bar"} | null}, "kind": "isobaric",
"conditions": {"load_mass": "6 kg"}, "bad_rows": "skip"}``; every part may be left out. A column is named by
its header, or by its place ("column 3") where it has none of its own.
"""

from __future__ import annotations

import hashlib
import json
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from mckibben.measurement.kind import KINDS
from mckibben.measurement.measurement import CHANNEL_UNITS
from mckibben.measurement.read.conditions import CONDITION_UNITS, TEXT_CONDITIONS, condition_value
from mckibben.measurement.read.marks import split_mark
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.physics.units import factor

#: Uses of a column besides a channel.
SLACK, SAMPLE = "slack", "sample"
USES = (*CHANNEL_UNITS, SLACK, SAMPLE)
MAX_LENGTH = 20_000  # characters of the JSON
_PARTS = ("columns", "kind", "conditions", "bad_rows")
_CHOICE_KEYS = ("channel", "unit", "absolute")
_EXAMPLE = 'e.g. {"columns": {"p1": {"channel": "pressure", "unit": "bar"}}, "kind": "isobaric"}'


@dataclass(frozen=True, slots=True)
class Choice:
    """What one column is; ``unit`` None = the header's; ``absolute`` counts for a pressure only."""

    channel: str
    unit: str | None = None
    absolute: bool | None = None


@dataclass(frozen=True, slots=True)
class Correction:
    """What the user says about a file.

    Attributes:
        columns: header -> what the column is, None = not used; columns not named keep their guess.
        kind: the kind, None = as the file says, else detected.
        conditions: condition -> value in SI or text, over those of the file; None = takes the file's away.
        skip_bad_rows: leave rows out that cannot be read, with a count, instead of refusing the file.
    """

    columns: Mapping[str, Choice | None] = field(default_factory=dict)
    kind: str | None = None
    conditions: Mapping[str, float | str | None] = field(default_factory=dict)
    skip_bad_rows: bool = False

    def canonical(self) -> str:
        """The one JSON text of this correction: sorted keys, nothing that is said by leaving it out."""
        columns = {
            header: None
            if choice is None
            else {key: value for key in _CHOICE_KEYS if (value := getattr(choice, key)) is not None}
            for header, choice in self.columns.items()
        }
        parts = {
            "columns": columns,
            "kind": self.kind,
            "conditions": dict(self.conditions),
            "bad_rows": "skip" if self.skip_bad_rows else None,
        }
        said = {name: part for name, part in parts.items() if part}
        return json.dumps(said, sort_keys=True, separators=(",", ":"), ensure_ascii=False)

    def identity(self, content: bytes) -> str:
        """Id of a file read with this correction: SHA-256 of the content, and of the correction if any."""
        digest = hashlib.sha256(content)
        if (said := self.canonical()) != "{}":
            digest.update(b"\0" + said.encode("utf-8", "surrogatepass"))
        return digest.hexdigest()


def read_correction(text: str) -> Correction:
    """The correction in a JSON text.

    Raises:
        InputError: no JSON object, an unknown key, channel, unit, kind or condition, with the nearest match.
    """
    if len(text) > MAX_LENGTH:
        raise _refused("", f"is longer than {MAX_LENGTH} characters", _EXAMPLE)
    try:
        given = json.loads(text, object_pairs_hook=_unique)
    except RecursionError as error:
        raise _refused("", "is nested too deeply", _EXAMPLE) from error
    except json.JSONDecodeError as error:
        raise _refused("", f"is not valid JSON: {error}", _EXAMPLE) from error
    given = _object(given, "", _PARTS)
    columns = {
        header: _choice(value, f".columns.{header[:80]}")
        for header, value in _object(given.get("columns") or {}, ".columns").items()
    }
    conditions = {
        key: _condition(key, value)
        for key, value in _object(
            given.get("conditions") or {}, ".conditions", (*CONDITION_UNITS, *TEXT_CONDITIONS)
        ).items()
    }
    kind = _one_of(given.get("kind"), KINDS, ".kind")
    bad_rows = _one_of(given.get("bad_rows"), ("refuse", "skip"), ".bad_rows")
    return Correction(columns, kind, conditions, bad_rows == "skip")


def _refused(key: str, problem: str, hint: str | None) -> InputError:
    return InputError(f"mapping{key} {problem}", field=f"mapping{key}", hint=hint)


def _unique(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) < len(pairs):
        times = Counter(name for name, _ in pairs)
        twice = next(name for name in times if times[name] > 1)
        raise _refused(f".{twice[:80]}", "occurs twice", "say every key once")
    return found


def _object(value: Any, key: str, known: tuple[str, ...] = ()) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise _refused(key, "is not a JSON object", _EXAMPLE)
    for name in value:
        if known and name not in known:
            raise _refused(f"{key}.{name[:80]}", "is not known", did_you_mean(name, known))
    return value


def _one_of(value: Any, known: tuple[str, ...], key: str) -> str | None:
    if value is None or value in known:
        return value
    if not isinstance(value, str):
        raise _refused(key, "is not a text", f"one of {', '.join(known)}")
    raise _refused(key, f"'{value[:80]}' is not known", did_you_mean(value, known))


def _choice(value: Any, key: str) -> Choice | None:
    if value is None:
        return None
    given = _object(value, key, _CHOICE_KEYS)
    channel = _one_of(given.get("channel"), USES, f"{key}.channel")
    if channel is None:
        raise _refused(f"{key}.channel", "is missing", f"one of {', '.join(USES)}")
    unit, absolute = given.get("unit"), given.get("absolute")
    if absolute is not None and not isinstance(absolute, bool):
        raise _refused(f"{key}.absolute", "is not true or false", "true: above vacuum, false: gauge")
    if unit is None:
        return Choice(channel, None, absolute)
    if not isinstance(unit, str):
        raise _refused(f"{key}.unit", "is not a text", "e.g. 'bar'")
    unit, marked = split_mark(unit)
    try:
        factor(unit, CHANNEL_UNITS.get(channel, "1"))
    except ValueError as error:
        text = str(error)
        problem = f"'{unit[:40]}' cannot be used: {text}"
        raise _refused(f"{key}.unit", problem, f"a unit such as {CHANNEL_UNITS.get(channel, '1')}") from error
    return Choice(channel, unit, marked if absolute is None else absolute)


def _condition(key: str, value: Any) -> float | str | None:
    if value is None:
        return None
    if isinstance(value, bool) or not isinstance(value, (str, int, float)):
        raise _refused(f".conditions.{key}", "is neither a text nor a number", "e.g. '6 kg'")
    where = f"mapping.conditions.{key}"
    return condition_value(key, value, where=where, field=where)
