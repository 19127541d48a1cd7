"""What a user says about a file beyond what it says itself: columns, kind, conditions, bad rows.

As JSON: ``{"columns": {"<header>": {"channel": "pressure", "unit": "bar"} | null}, "kind": "isobaric",
"conditions": {"load_mass": "6 kg"}, "bad_rows": "skip"}``, and in the words of the command line
``{"sheet": "300 mm", "head": 3, "column": ["force=-Kraft [kN]"], "ignore": ["Traverse"], "rest_length":
"300 mm", "load": "6 kg", "supply": "6 bar", "accuracy": "length 1 mm", "experiment": ["force_zero=2 N"]}``;
every part may be left out. A column is named by its header (with or without its unit), or by its place
("column 3") where it has none of its own.
"""

from __future__ import annotations

import hashlib
import json
import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, NamedTuple

from mckibben.measurement.kind import KINDS
from mckibben.measurement.measurement import CHANNEL_UNITS
from mckibben.measurement.reading.conditions import CONDITION_UNITS, TEXT_CONDITIONS, condition_value
from mckibben.measurement.reading.scales import answered_scale
from mckibben.measurement.reading.units import CLOCK, RAW, WEIGHTS, number_of, unit_of
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.physics.units import factor

#: Uses of a column besides a channel.
SLACK, SAMPLE = "slack", "sample"
USES = (*CHANNEL_UNITS, SLACK, SAMPLE)
#: Other names of a channel: the weights that hang on a muscle are the force that it pulls with.
SAME_CHANNEL = {"load": "force", "mass": "force", "weight": "force"}
MAX_LENGTH = 20_000  # characters of the JSON
_PARTS = (
    "columns", "kind", "conditions", "bad_rows", "sheet", "head", "column", "ignore", "rest_length", "load",
    "supply", "strict", "accuracy", "experiment", "notes",
)  # fmt: skip
_CHOICE_KEYS = ("channel", "unit", "absolute", "sign", "scale", "assumed")
_COLUMN = re.compile(r"\s*([a-z_]+)\s*=\s*([+-]?)\s*(.*?)\s*")
_WITH_UNIT = re.compile(r"(.+?)\s*\[([^\[\]]*)\]")
_LEVEL = re.compile(
    r"\s*(?P<word>[^=]{1,40}?)\s*=\s*(?P<value>[-+]?\d{1,9}(?:[.,]\d{1,9})?)\s?(?P<unit>\S{0,12})\s*"
)
MOST_LEVELS = 12
_EXAMPLE = 'e.g. {"columns": {"p1": {"channel": "pressure", "unit": "bar"}}, "kind": "isobaric"}'


@dataclass(frozen=True, slots=True)
class Choice:
    """What one column is; ``unit`` None = the header's; ``absolute`` counts for a pressure only.

    ``sign`` -1: the file counts it the other way, as a force that is negative when the muscle pulls.
    ``scale``: of a signal in V, mA or counts, ``0-10 V = 0-10 bar``; ``unit`` is the one that it leads to.
    ``assumed``: nobody said the unit, it was taken as proposed; every answer then says so.
    """

    channel: str
    unit: str | None = None
    absolute: bool | None = None
    sign: int = 1
    scale: str | None = None
    assumed: bool = False


class Note(NamedTuple):
    """A text that another file of the same test holds, and where it stands."""

    where: str
    text: str


@dataclass(frozen=True, slots=True)
class Correction:
    """What the user says about a file.

    Attributes:
        columns: header -> what the column is, None = not used; columns not named keep their guess.
        kind: the kind, None = as the file says, else detected.
        conditions: condition -> value in SI or text, over those of the file; None = takes the file's away.
        skip_bad_rows: leave rows out that cannot be read, with a count, instead of refusing the file.
        sheet: the sheet (or group, or struct) to read, None = the one with the table.
        head: 1-based row of the column names, None = looked for.
        strict: what would be proposed or assumed is refused as well.
        notes: what other files of the same test say, read as texts of this one.
        beside: names of the other files of the same test; as the file's own, no part of what identifies it.
        muscle_length: rest length [m] of the muscle that is stated beside the file; it only says what a
            number in the file's name can be.
    """

    columns: Mapping[str, Choice | None] = field(default_factory=dict)
    kind: str | None = None
    conditions: Mapping[str, float | str | None] = field(default_factory=dict)
    skip_bad_rows: bool = False
    sheet: str | None = None
    head: int | None = None
    strict: bool = False
    notes: tuple[Note, ...] = ()
    beside: tuple[str, ...] = ()
    muscle_length: float | None = None

    def canonical(self) -> str:
        """The one JSON text of this correction: sorted keys, nothing that is said by leaving it out."""
        columns = {
            header: None
            if choice is None
            else {
                key: value
                for key in _CHOICE_KEYS
                if (value := getattr(choice, key)) is not None
                and (key, value) not in (("sign", 1), ("assumed", False))
            }
            for header, choice in self.columns.items()
        }
        parts = {
            "columns": columns,
            "kind": self.kind,
            "conditions": dict(self.conditions),
            "bad_rows": "skip" if self.skip_bad_rows else None,
            "sheet": self.sheet,
            "head": self.head,
            "strict": self.strict or None,
            "notes": [list(note) for note in self.notes],
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
    for text in _texts(given.get("experiment"), ".experiment"):
        key, _, value = (part.strip() for part in text.partition("="))
        if not value or key not in (*CONDITION_UNITS, *TEXT_CONDITIONS):
            raise _refused(".experiment", f"{text[:80]!r}: is not 'field=value'", 'e.g. "force_zero=2.5 N"')
        conditions[key] = _condition(key, value)
    if (accuracy := _typed(given.get("accuracy"), str, ".accuracy")) is not None:
        conditions["accuracy"] = _condition("accuracy", accuracy)
    spoken = spoken_correction(
        sheet=_typed(given.get("sheet"), str, ".sheet"),
        head=_typed(given.get("head"), int, ".head"),
        columns=_texts(given.get("column"), ".column"),
        ignore=_texts(given.get("ignore"), ".ignore"),
        rest_length=_quantity(given.get("rest_length"), ".rest_length"),
        load=_quantity(given.get("load"), ".load"),
        supply=_quantity(given.get("supply"), ".supply"),
        strict=bool(_typed(given.get("strict"), bool, ".strict")),
        prefix="mapping.",
    )
    return replace(
        spoken,
        columns={**columns, **spoken.columns},
        kind=kind,
        conditions={**conditions, **spoken.conditions},
        skip_bad_rows=bad_rows == "skip",
        notes=_notes(given.get("notes")),
    )


def spoken_correction(
    *, sheet: str | None = None, head: int | None = None, columns: Sequence[str] = (),
    ignore: Sequence[str] = (), rest_length: str | float | None = None, load: str | float | None = None,
    supply: str | float | None = None, strict: bool = False, prefix: str = "--",
) -> Correction:  # fmt: skip
    """A correction in the words of the command line.

    Args:
        sheet: name of the sheet.
        head: 1-based row of the column names.
        columns: texts such as ``force=-Kraft [kN]``: channel, sign, name of the column, its unit.
        ignore: names of columns that are not wanted.
        rest_length: of the muscle without air and load.
        load: a mass or a force.
        supply: supply pressure, gauge.
        strict: refuse instead of assuming.
        prefix: of the names, for messages.

    Raises:
        InputError: a text that cannot be used, naming the option.
    """
    if head is not None and head < 1:
        raise InputError(f"{prefix}head {head}: rows count from 1", field=f"{prefix}head", hint="e.g. 3")
    choices: dict[str, Choice | None] = {}
    for text in columns:
        name, choice = column_choice(text, where=f"{prefix}column")
        choices[name] = choice
    choices |= dict.fromkeys(ignore)
    conditions: dict[str, float | str | None] = {}
    if rest_length is not None:
        option = "--rest-length" if prefix == "--" else f"{prefix}rest_length"
        conditions["nominal_length"] = _given(rest_length, "nominal_length", option)
    if load is not None:
        is_force = isinstance(load, str) and re.search(r"(?:N|lbf|kgf|daN|kp)\s*$", load) is not None
        key, other = ("load_force", "load_mass") if is_force else ("load_mass", "load_force")
        conditions[key], conditions[other] = _given(load, key, f"{prefix}load"), None
    if supply is not None:
        conditions["supply_pressure"] = _given(supply, "supply_pressure", f"{prefix}supply")
    return Correction(choices, None, conditions, sheet=sheet, head=head, strict=strict)


def column_choice(text: str, *, where: str) -> tuple[str, Choice]:
    """(name of the column, what it is) of ``force=-Kraft [kN]``.

    Raises:
        InputError: no such text, an unknown channel, a unit that does not fit.
    """
    found = _COLUMN.fullmatch(text)
    if found is None or not found[3]:
        raise InputError(
            f"{where} {text[:80]!r}: is not 'channel=name [unit]'",
            field=where,
            hint='e.g. "force=-Kraft [kN]"',
        )
    said, sign, name = found.groups()
    channel = SAME_CHANNEL.get(said, said)
    if channel not in USES:
        raise InputError(
            f"{where} {text[:80]!r}: there is no channel '{said}'",
            field=where,
            hint=did_you_mean(said, (*USES, *SAME_CHANNEL)),
        )
    minus = -1 if sign == "-" else 1
    split = _WITH_UNIT.fullmatch(name)
    if split is None:
        return name, Choice(channel, None, None, minus)
    scale = answered_scale(split[2]) or levels_of(split[2])
    unit = unit_of(split[2] if scale is None else scale.unit)
    if unit is None:
        raise InputError(
            f"{where} {text[:80]!r}: '{split[2][:40]}' is not a known unit", field=where,
            hint=f"e.g. '{CHANNEL_UNITS.get(channel, '1')}'",
        )  # fmt: skip
    if scale is None and unit.dimension in RAW and channel != "command":
        return name, Choice(channel, None, None, minus)  # a signal has its own unit in its name
    spelling = WEIGHTS.get(unit.name, unit.name) if channel == "force" else unit.name
    if said == "mass" and unit.dimension != "mass":
        raise InputError(
            f"{where} {text[:80]!r}: '{split[2][:40]}' is not a unit of mass", field=where,
            hint="e.g. 'kg', or force= or load= for a weight in N",
        )  # fmt: skip
    try:
        if spelling != CLOCK:
            factor(spelling, CHANNEL_UNITS.get(channel, "1"))
    except ValueError as error:
        raise InputError(
            f"{where} {text[:80]!r}: '{split[2][:40]}' cannot be used: {error}", field=where,
            hint=f"a unit such as {CHANNEL_UNITS.get(channel, '1')}",
        ) from error  # fmt: skip
    return split[1], Choice(channel, spelling, unit.absolute, minus, None if scale is None else split[2])


class Levels(NamedTuple):
    """What the words of a column stand for, in one unit."""

    values: Mapping[str, float]
    unit: str


def levels_of(text: str) -> Levels | None:
    """What a user says that words stand for, ``I = 1 bar, II = 2 bar``; None = it is something else.

    The unit of the last one counts for those without: ``low = 1, high = 6 bar``.
    """
    parts = [_LEVEL.fullmatch(part) for part in re.split(r"[,;]\s", text)]
    found = [part for part in parts if part is not None]
    unit = found[-1]["unit"] if found else ""
    if len(found) < len(parts) or not 1 < len(found) <= MOST_LEVELS or unit_of(unit) is None:
        return None
    if any(part["unit"] not in ("", unit) for part in found):
        return None
    return Levels({part["word"]: number_of(part["value"]) for part in found}, unit)


def _given(value: str | float, key: str, where: str) -> float | str:
    return condition_value(key, value, where=where, field=where)


def _typed(value: Any, kind: type, key: str) -> Any:
    if value is None:
        return None
    if not isinstance(value, kind) or (kind is int and isinstance(value, bool)):
        names: dict[type, str] = {str: "a text", int: "a whole number", bool: "true or false"}
        raise _refused(key, f"is not {names[kind]}", None)
    return value


def _texts(value: Any, key: str) -> list[str]:
    if value is None:
        return []
    if not isinstance(value, list) or not all(isinstance(text, str) for text in value):
        raise _refused(key, "is not a list of texts", 'e.g. ["force=-Kraft [kN]"]')
    return value


def _notes(value: Any) -> tuple[Note, ...]:
    if value is None:
        return ()
    if not isinstance(value, list) or not all(
        isinstance(note, list) and len(note) == 2 and all(isinstance(text, str) for text in note)
        for note in value
    ):
        raise _refused(
            ".notes",
            "is not a list of places with their texts",
            'e.g. [["notes.txt, line 3", "force in kp"]]',
        )
    return tuple(Note(*note) for note in value)


def _quantity(value: Any, key: str) -> str | float | None:
    if value is None or (isinstance(value, (str, int, float)) and not isinstance(value, bool)):
        return value
    raise _refused(key, "is neither a text nor a number", "e.g. '300 mm'")


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
    said = _one_of(given.get("channel"), (*USES, *SAME_CHANNEL), f"{key}.channel")
    channel = None if said is None else SAME_CHANNEL.get(said, said)
    if channel is None:
        raise _refused(f"{key}.channel", "is missing", f"one of {', '.join(USES)}")
    if (scale := given.get("scale")) is not None:
        return _scaled(scale, channel, given, key)
    unit, absolute, sign = given.get("unit"), given.get("absolute"), given.get("sign", 1)
    if isinstance(sign, bool) or sign not in (1, -1):
        raise _refused(f"{key}.sign", "is neither 1 nor -1", "-1: the file counts it the other way")
    if absolute is not None and not isinstance(absolute, bool):
        raise _refused(f"{key}.absolute", "is not true or false", "true: above vacuum, false: gauge")
    assumed = bool(_typed(given.get("assumed"), bool, f"{key}.assumed"))
    if unit is None:
        return Choice(channel, None, absolute, int(sign))
    if not isinstance(unit, str):
        raise _refused(f"{key}.unit", "is not a text", "e.g. 'bar'")
    known = unit_of(unit)
    unit, marked = (unit, None) if known is None else (known.name, known.absolute)
    unit = WEIGHTS.get(unit, unit) if channel == "force" else unit
    try:
        factor(unit, CHANNEL_UNITS.get(channel, "1"))
    except ValueError as error:
        text = str(error)
        problem = f"'{unit[:40]}' cannot be used: {text}"
        raise _refused(f"{key}.unit", problem, f"a unit such as {CHANNEL_UNITS.get(channel, '1')}") from error
    return Choice(channel, unit, marked if absolute is None else absolute, int(sign), None, assumed)


def _scaled(scale: Any, channel: str, given: Mapping[str, Any], key: str) -> Choice:
    """A column with the scale of its signal, as ``column_choice`` reads it."""
    text = _typed(scale, str, f"{key}.scale")
    if answered_scale(text) is None and levels_of(text) is None:
        raise _refused(f"{key}.scale", f"{text[:80]!r} is not a scale", "e.g. '0-10 V = 0-10 bar'")
    minus = "-" if given.get("sign") == -1 else ""
    return column_choice(f"{channel}={minus}x [{text}]", where=f"mapping{key}.scale")[1]


def _condition(key: str, value: Any) -> float | str | None:
    if value is None:
        return None
    if isinstance(value, bool) or not isinstance(value, (str, int, float)):
        raise _refused(f".conditions.{key}", "is neither a text nor a number", "e.g. '6 kg'")
    where = f"mapping.conditions.{key}"
    return condition_value(key, value, where=where, field=where)
