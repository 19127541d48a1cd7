"""Column headers to channels: ``name_unit``, ``name [unit]``, ``name (unit)`` or a bare name in SI."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import NamedTuple

from mckibben.identification.measurement import CHANNEL_UNITS
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.physics.units import factor, is_unit, meaning

#: Words of a header -> channel; the case of a single letter counts only between t (time) and T (temperature).
SYNONYMS = {
    word: channel
    for channel, words in {
        "time": "time t",
        "pressure": "pressure p",
        "force": "force load f",
        "length": "length l",
        "contraction": "contraction kappa strain κ ε",
        "displacement": "displacement position stroke x",
        "diameter": "diameter d",
        "velocity": "velocity v",
        "command": "command u valve",
        "temperature": "temperature",
        "direction": "direction",
        "group": "group run cycle sweep",
    }.items()
    for word in words.split()
}

# Words that leave a column what it is, and how much less it is wanted than the same column without them.
_QUALIFIERS = dict.fromkeys(
    ("measured", "meas", "actual", "mean", "avg", "average", "raw", "unclipped", "as", "given", "sensor",
     "muscle", "actuator", "pam", "pulling", "total", "number", "no", "nr", "id", "index"),
    1,
) | {"filtered": 2, "smoothed": 2, "clipped": 100}  # fmt: skip
_MARKS = {
    "a": True, "abs": True, "absolute": True,
    "g": False, "gauge": False, "gage": False, "rel": False, "relative": False,
}  # fmt: skip
_MARK_WORDS = {word: mark for word, mark in _MARKS.items() if len(word) > 1}
_MARKED_UNIT = re.compile(
    r"(?i)(?<![a-z])([mkh]?(?:bar|pa)|psi)"
    r"(?:[\s_]*\((a|abs|absolute|g|gauge|rel)\)|(a|g)(?![a-z])|[\s_]+(abs|absolute|gauge|rel)(?![a-z]))"
)
_BRACKETED = re.compile(r"([^\[(]*)[\[(](.*)[\])]\s*")
_NUMBERED = re.compile(r"[0-9]+(\.[0-9]+)?[A-Za-z]")
_MAX_HEADER = 120

HEADER_EXAMPLE = "e.g. a header 'pressure_bar,length_mm,force_N'"

#: Uses of a column besides a channel.
SLACK, SAMPLE = "slack", "sample"
TEXT_COLUMNS = ("direction", "group", SLACK, SAMPLE)


class Column(NamedTuple):
    """A column that is used: ``use`` is a channel, ``slack`` or ``sample``; ``unit`` None = not given."""

    index: int
    header: str
    use: str
    unit: str | None = None
    absolute: bool | None = None
    penalty: int = 0


class Mapping(NamedTuple):
    """What a header row means; ``ignored`` in the order of the file."""

    columns: list[Column]
    ignored: list[str]
    messages: list[str]


def split_mark(text: str) -> tuple[str, bool | None]:
    """Take "absolute"/"gauge" off a pressure unit: ``"bar(a)"`` -> ``("bar", True)``; None = not said."""
    found = _MARKED_UNIT.search(text)
    if found is None:
        return text, None
    mark = next(group for group in found.groups()[1:] if group)
    return text[: found.end(1)] + text[found.end() :], _MARKS[mark.lower()]


def map_headers(headers: Sequence[str], *, name: str, row: int) -> Mapping:
    """Which column is which channel.

    Of two columns for one channel the plainer one wins (no "clipped", fewer extra words, the channel's own
    name rather than a synonym, the first); the other is ignored with a message.

    Raises:
        InputError: no or duplicate names, no known channel, a unit that is unknown or of another dimension.
    """
    names = [header.strip() for header in headers]
    where = f"{name}, row {row}"
    if not any(names):
        raise InputError(f"{where}: the header names no column", field=f"row {row}", hint=HEADER_EXAMPLE)
    seen: dict[str, str] = {}
    for header in filter(None, names):
        if header.casefold() in seen:
            raise InputError(
                f"{where}, column '{header[:_MAX_HEADER]}': the name occurs twice",
                field=f"row {row}", hint="give every column its own name",
            )  # fmt: skip
        seen[header.casefold()] = header
    messages: list[str] = []
    found = [c for i, header in enumerate(names) if (c := _column(i, header, where, messages)) is not None]
    found.sort(key=lambda c: (c.penalty, not c.header.lower().startswith(c.use), c.index))
    used: dict[str, Column] = {}
    for column in found:
        winner = used.setdefault(column.use, column)
        if winner is not column:
            better = f"{column.use} is read from '{winner.header}'"
            messages.append(f"column '{column.header}' is not used: {better}")
    if not any(use in CHANNEL_UNITS and use not in ("direction", "group") for use in used):
        raise _no_channel(names, where, row, messages)
    taken = {column.index for column in used.values()}
    ignored = [header or f"column {i + 1}" for i, header in enumerate(names) if i not in taken]
    return Mapping(sorted(used.values()), ignored, messages)


def _no_channel(names: Sequence[str], where: str, row: int, messages: Iterable[str]) -> InputError:
    shown = ", ".join(f"'{n[:40]}'" for n in names[:8])
    if all(re.fullmatch(r"[-+.,0-9eE\s]*", n) for n in names):
        problem = "numbers where the header should be"
        return InputError(f"{where}: {problem}", field=f"row {row}", hint=HEADER_EXAMPLE)
    near = [did_you_mean(re.split(r"[\s_\[(]", n)[0][:40] or "?", SYNONYMS) for n in names[:8]]
    hint = next((n for n in near if n and n.startswith("Did")), HEADER_EXAMPLE)
    why = "".join(f"; {message}" for message in messages)
    problem = f"no known channel among the columns {shown}{why}"
    return InputError(f"{where}: {problem}", field=f"row {row}", hint=hint)


def _column(index: int, header: str, where: str, messages: list[str]) -> Column | None:
    """The column of one header; None = not one of ours."""
    if not header or len(header) > _MAX_HEADER:
        return None
    if header.lower() in ("muscle", "sample"):
        return Column(index, header, SAMPLE)
    text, absolute = split_mark(header)
    bracketed = _BRACKETED.fullmatch(text)
    unit = None
    if bracketed is not None:
        text, inside = bracketed.groups()
        words = inside.lower().split()
        if words and all(word in _QUALIFIERS or word in _MARK_WORDS for word in words):
            text = f"{text} {inside}"
        elif inside.strip():
            unit = inside.strip()
    tokens = [token for token in re.split(r"[\s_]+", text) if token]
    channel, penalty, letter = "", 0, ""
    for position, token in enumerate(tokens):
        low = token.lower()
        last = position == len(tokens) - 1
        if low in SYNONYMS and not (channel and len(low) == 1 and last and unit is None and is_unit(token)):
            if channel not in ("", SYNONYMS[low]):
                return None  # "supply_time", "valve_position": a name of its own
            channel, letter = SYNONYMS[low], letter or (token if len(token) == 1 else "")
        elif low in _MARK_WORDS:
            absolute = _MARK_WORDS[low]
        elif low in _QUALIFIERS or low.startswith("slack") or (low == "zero" and penalty >= 100):
            penalty += _QUALIFIERS.get(low, 100)
        elif _NUMBERED.match(token):
            penalty += 1
        elif channel and unit is None and is_unit(token):
            unit = token
        else:
            return None
    if penalty >= 100 and unit is None and channel in ("", "force"):
        return Column(index, header, SLACK)
    if not channel:
        return None
    column = Column(index, header, channel, unit, absolute if channel == "pressure" else None, penalty)
    return _with_unit(column, letter, where, messages)


def _with_unit(column: Column, letter: str, where: str, messages: list[str]) -> Column | None:
    """The column after its unit had a word: contraction in mm is a displacement, volts are no pressure."""
    use, unit = column.use, column.unit
    if letter in ("t", "T"):
        use = "time" if letter == "t" else "temperature"
        if unit is not None and _fits(unit, "s"):
            use = "time"
        elif unit is not None and (_fits(unit, "K") or unit in ("C", "F")):
            use = "temperature"
    if unit is None:
        return column._replace(use=use)
    if use == "temperature" and unit in ("C", "F"):
        unit = f"deg{unit}"
    if use == "contraction" and _fits(unit, "m"):
        use = "displacement"
    elif use == "displacement" and _fits(unit, "1"):
        use = "contraction"
    if _fits(unit, CHANNEL_UNITS[use]):
        return column._replace(use=use, unit=unit)
    measured = meaning(unit)
    if measured in ("a voltage", "a current") or letter or use in ("direction", "group"):
        what = f"{measured}, not a {use}" if measured else f"no unit of a {use}"
        messages.append(f"column '{column.header}' is not used: '{unit}' is {what}")
        return None
    problem = f"the unit '{unit}' is {measured}" if measured else f"the unit '{unit}' is not known"
    raise InputError(
        f"{where}, column '{column.header}': {problem}, a unit of {use} is needed",
        field=f"column {column.header}",
        hint=f"e.g. '{use}_{_UNIT_EXAMPLES.get(use, CHANNEL_UNITS[use])}'",
    )


_UNIT_EXAMPLES = {
    "pressure": "bar", "length": "mm", "displacement": "mm", "diameter": "mm", "contraction": "pct",
    "command": "pct", "temperature": "degC",
}  # fmt: skip


def _fits(unit: str, si_unit: str) -> bool:
    try:
        factor(unit, si_unit)
    except ValueError:
        return False
    return True
