"""A column whose head is written the plain way: ``name_unit``, ``name [unit]``, ``name (unit)``."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import NamedTuple

from mckibben.measurement.measurement import CHANNEL_UNITS
from mckibben.measurement.read.correction import SAMPLE, SLACK, WEIGHTS
from mckibben.measurement.read.marks import MARK_WORDS, split_mark
from mckibben.measurement.read.unit_words import fits
from mckibben.physics.errors import InputError
from mckibben.physics.units import is_unit, meaning

#: Words of a header -> channel; the case of a single letter counts only between t (time) and T (temperature).
SYNONYMS: dict[str, str] = {
    word: channel
    for channel, words in {
        "time": "time t",
        "pressure": "pressure p",
        "force": "force load weight f",
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
_BRACKETED = re.compile(r"([^\[(]*)[\[(](.*)[\])]\s*")
_NUMBERED = re.compile(r"[0-9]+(\.[0-9]+)?[A-Za-z]")
MAX_HEADER = 120
#: What a controller may be set to, where a command is no share of an opening.
SET_QUANTITIES = ("a pressure", "a length", "a force")
#: Uses of a column that are words rather than numbers.
TEXT_COLUMNS = ("direction", "group", SLACK, SAMPLE)


class HeaderColumn(NamedTuple):
    """A column that is used: ``use`` is a channel, ``slack`` or ``sample``; ``unit`` None = not given.

    ``sign`` -1: the file counts it the other way. ``origin``: who says what it is, ``file``, ``you``
    or ``proposed`` from its numbers; ``extends``: its name says that it grows as the muscle becomes longer.
    """

    place: int
    header: str
    use: str
    unit: str | None = None
    absolute: bool | None = None
    penalty: int = 0
    sign: int = 1
    origin: str = "file"
    extends: bool = False
    unit_origin: str = "file"


def plainly_known(headers: Sequence[str]) -> list[int]:
    """Indices of the headers that name a channel the plain way; a wrong unit does not matter."""
    known = []
    for index, header in enumerate(headers):
        try:
            column = plain_column(index, header.strip(), "", "column", [])
        except InputError:
            known.append(index)
            continue
        if column is not None and column.use not in TEXT_COLUMNS:
            known.append(index)
    return known


def plain_column(index: int, header: str, where: str, noun: str, messages: list[str]) -> HeaderColumn | None:
    """The column of one header; None = not one of ours."""
    if not header or len(header) > MAX_HEADER:
        return None
    if header.lower() in ("muscle", "sample"):
        return HeaderColumn(index, header, SAMPLE)
    text, absolute = split_mark(header)
    bracketed = _BRACKETED.fullmatch(text)
    unit = None
    if bracketed is not None:
        text, inside = bracketed.groups()
        if re.search(r"[\])][^\[(]*[\[(]", inside):
            return None  # two brackets, "[kPa] (gauge)"
        words = inside.lower().split()
        if words and all(word in _QUALIFIERS or word in MARK_WORDS for word in words):
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
        elif low in MARK_WORDS:
            absolute = MARK_WORDS[low]
        elif low in _QUALIFIERS or low.startswith("slack") or (low == "zero" and penalty >= 100):
            penalty += _QUALIFIERS.get(low, 100)
        elif _NUMBERED.match(token):
            penalty += 1
        elif channel and unit is None and is_unit(token):
            unit = token
        else:
            return None
    if penalty >= 100 and unit is None and channel in ("", "force"):
        return HeaderColumn(index, header, SLACK)
    if not channel:
        return None
    column = HeaderColumn(index, header, channel, unit, absolute if channel == "pressure" else None, penalty)
    return with_unit(column, letter, where, noun, messages)


def with_unit(
    column: HeaderColumn, letter: str, where: str, noun: str, messages: list[str]
) -> HeaderColumn | None:
    """The column after its unit had a word: contraction in mm is a displacement, volts are no pressure."""
    use, unit = column.use, column.unit
    if letter in ("t", "T"):
        use = "time" if letter == "t" else "temperature"
        if unit is not None and fits(unit, "s"):
            use = "time"
        elif unit is not None and (fits(unit, "K") or unit in ("C", "F")):
            use = "temperature"
    if unit is None:
        return column._replace(use=use)
    if use == "temperature" and unit in ("C", "F"):
        unit = f"deg{unit}"
    if use == "force" and unit in WEIGHTS:
        messages.append(f"{noun} '{column.header}' is a mass: its weight is the force")
        unit = WEIGHTS[unit]
    if use == "contraction" and fits(unit, "m"):
        use = "displacement"
    elif use == "displacement" and fits(unit, "1"):
        use = "contraction"
    if column.header.isupper() and fits(unit.lower(), CHANNEL_UNITS[use]):
        unit = unit.lower()  # "TIME_S" is no siemens
    if fits(unit, CHANNEL_UNITS[use]):
        return column._replace(use=use, unit=unit)
    measured = meaning(unit)
    if use == "command" and measured in SET_QUANTITIES:
        return None  # what it is set to, or the pressure at the valve: its words tell which
    share = unit == "%" and use in ("pressure", "force", "length")  # of the range of its sensor
    if measured in ("a voltage", "a current") or share or letter or use in ("direction", "group"):
        what = f"{measured}, not a {use}" if measured else f"no unit of a {use}"
        messages.append(f"{noun} '{column.header}' is not used: '{unit}' is {what}")
        return None
    raise InputError(
        f"{where}: the unit '{unit}' is {measured or 'not known'}, a unit of {use} is needed",
        field=f"{noun} {column.header}",
        hint=f"e.g. '{use}_{_UNIT_EXAMPLES.get(use, CHANNEL_UNITS[use])}'",
    )


_UNIT_EXAMPLES = {
    "pressure": "bar", "length": "mm", "displacement": "mm", "diameter": "mm", "contraction": "pct",
    "command": "pct", "temperature": "degC",
}  # fmt: skip
