"""Column headers to channels: ``name_unit``, ``name [unit]``, ``name (unit)`` or a bare name in SI."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from difflib import get_close_matches
from types import MappingProxyType
from typing import NamedTuple

from mckibben.measurement.measurement import CHANNEL_UNITS
from mckibben.measurement.read.conditions import Constant
from mckibben.measurement.read.correction import Choice
from mckibben.measurement.read.head_text import taken_apart, without_paths
from mckibben.measurement.read.left_out import DISMISSED, UNKNOWN, LeftOut, Reason
from mckibben.measurement.read.plain_head import (
    MAX_HEADER,
    SYNONYMS,
    WEIGHTS,
    HeaderColumn,
    plain_column,
    with_unit,
)
from mckibben.measurement.read.recognise import BY_UNIT, BY_WORDS, is_raw, recognise
from mckibben.measurement.read.unit_words import CLOCK, fits, unit_of
from mckibben.physics.errors import InputError, did_you_mean

_MASSES = {weight: mass for mass, weight in WEIGHTS.items() if mass != "lb"}  # lbf is a unit of force as well
#: What loggers write above their ticks -> the unit of these; "s" alone may be a stroke.
_TICKS = {"ms": "ms", "msec": "ms", "msecs": "ms", "millis": "ms", "micros": "us"}
_CLIPPED = 100  # penalty of a clipped column
_NEAR = 0.75  # likeness of a word to one that it is probably meant for

HEADER_EXAMPLE = "e.g. a header 'pressure_bar,length_mm,force_N'"


class Meaning(NamedTuple):
    """What a header row means; ``ignored`` in the order of the file.

    ``problems``: index of a column -> why its header cannot be used, only where they are collected.
    ``reasons``: index of a column that is not used -> why. ``rivals``: (column used, column that could be).
    ``dismissed``: columns that the user does not want. ``constants``: columns of conditions.
    """

    columns: list[HeaderColumn]
    ignored: list[str]
    messages: list[str]
    problems: dict[int, InputError]
    reasons: Mapping[int, LeftOut] = MappingProxyType({})
    rivals: tuple[tuple[HeaderColumn, HeaderColumn], ...] = ()
    dismissed: frozenset[int] = frozenset()
    constants: tuple[Constant, ...] = ()


def map_headers(
    headers: Sequence[str], *, place: str, row: int | None = None, noun: str = "column",
    chosen: Mapping[str, Choice | None] | None = None, collect: bool = False,
    units: Sequence[str | None] = (), stood: Sequence[str] = (),
) -> Meaning:  # fmt: skip
    """Which column is which channel.

    Of two columns for one channel the one the user chose wins, then the plainer one (no "clipped", fewer
    extra words, the channel's own name rather than a synonym, the first); the other is ignored, with a
    message.

    Args:
        headers: names of the columns.
        place: the file (and sheet), for messages.
        row: 1-based row of the header, None where a format has none.
        noun: what the format calls a column.
        chosen: header (or "column 3") -> what the user says it is; None = not used.
        collect: keep what is wrong with a header in ``problems`` instead of raising it.
        units: units that stand apart from the headers, one per header.
        stood: the names as the file writes them, where they differ; a choice may use either.

    Raises:
        InputError: no or duplicate names, no known channel, a unit that is unknown or of another dimension, a
            choice for a column that is not there.
    """
    names = [header.strip() for header in headers]
    apart = [*units, *[None] * (len(names) - len(units))]
    reasons: dict[int, LeftOut] = {}
    where = place if row is None else f"{place}, row {row}"
    field = f"{noun}s" if row is None else f"row {row}"
    if not any(names):
        raise InputError(f"{where}: the header names no column", field=field, hint=HEADER_EXAMPLE)
    choices = _positions(chosen or {}, names, apart, stood)
    messages: list[str] = []
    problems: dict[int, InputError] = {}
    seen: set[str] = set()
    found: list[HeaderColumn] = []
    bare = without_paths(names)
    for index, header in enumerate(names):
        name = bare[index]
        try:
            if index in choices:
                column = _chosen(index, header, choices[index], apart[index])
                if column is None:
                    reasons[index] = DISMISSED
                elif column.use == "force" and column.unit in _MASSES:
                    kilos = _MASSES[column.unit]
                    messages.append(f"{noun} '{header}' is the force: the weight of its {kilos}")
            elif header and header.casefold() in seen and recognise(name, apart[index]).channel != "time":
                raise InputError(
                    f"{where}, {noun} '{header[:MAX_HEADER]}': the name occurs twice",
                    field=field,
                    hint=f'give every {noun} its own name, or leave one out: --ignore "column {index + 1}"',
                )  # fmt: skip
            else:
                column, said = None, []
                if CLOCK not in (recognise(name).unit, apart[index]):
                    text = _with(name, apart[index])
                    column = plain_column(index, text, f"{where}, {noun} '{header}'", noun, said)
                if column is None and not (said and recognise(name, apart[index]).unit is None):
                    other: list[str] = []
                    column = _in_other_words(index, name, apart[index], reasons, other, f"{where}, {noun}")
                    said = said if column is None else other
                if column is None and said:
                    reasons[index] = LeftOut(Reason.UNFIT, said[-1].partition(" is not used: ")[2])
                messages += [text.replace(f"'{name}'", f"'{header}'") for text in said]
                column = column if column is None else column._replace(header=header)
        except InputError as error:
            if not collect:
                raise
            problems[index] = error
            column = None
        if index not in choices:
            seen.add(header.casefold())
        if column is not None:
            found.append(column)
    if not any(column.penalty < BY_UNIT for column in found) and not all(map(_is_unit, names)):
        found.clear()  # units alone make no table
    found.sort(key=lambda c: _rank(c, bare[c.place], c.place in choices))
    messages += [
        f"{noun} '{column.header}' is read as {column.use} by its unit '{column.unit}' alone"
        for column in found
        if column.penalty >= BY_UNIT and column.penalty < _CLIPPED
    ]
    used: dict[str, HeaderColumn] = {}
    rivals = []
    for column in found:
        winner = used.setdefault(column.use, column)
        if winner is not column:
            better = f"{column.use} is read from '{winner.header}'"
            reasons[column.place] = LeftOut(Reason.RIVAL, better)
            rivals.append((winner, column))
            messages.append(f"{noun} '{column.header}' is not used: {better}")
    if not collect and not any(use in CHANNEL_UNITS and use not in ("direction", "group") for use in used):
        raise _no_channel(names, where, field, noun, messages)
    taken = {column.place for column in used.values()}
    ignored = [header or f"column {i + 1}" for i, header in enumerate(names) if i not in taken]
    dismissed = frozenset(index for index, choice in choices.items() if choice is None)
    columns = sorted(used.values(), key=lambda column: column.place)
    return Meaning(columns, ignored, messages, problems, reasons, tuple(rivals), dismissed)


def _rank(column: HeaderColumn, name: str, chosen: bool) -> tuple[bool, bool, int, bool, int]:
    plainly = name.lower().startswith(column.use)
    return not chosen, is_raw(column.header), column.penalty, not plainly, column.place


def _with(header: str, unit: str | None) -> str:
    """A header with the unit that stands apart from it, in the plain way."""
    known = unit_of(unit) if unit else None
    if known is None or known.unit in (CLOCK, "1") or recognise(header).unit is not None:
        return header
    mark = {True: "(a)", False: "(g)", None: ""}[known.absolute]
    return f"{header} [{known.unit}{mark}]"


def _in_other_words(
    index: int, header: str, unit: str | None, reasons: dict[int, LeftOut], messages: list[str], where: str
) -> HeaderColumn | None:
    """The column of a header that is not written the plain way; ``where`` it stands, for a refusal."""
    if not (header or unit) or len(header) > MAX_HEADER:
        return None
    known = recognise(header, unit)
    if unit is None and (ticks := _TICKS.get(header.lower().removesuffix("()"))) is not None:
        return HeaderColumn(index, header, "time", ticks, penalty=BY_WORDS + BY_UNIT)
    if known.channel is None:
        reasons[index] = known.left_out or UNKNOWN
        return None
    column = HeaderColumn(index, header, known.channel, known.unit, known.absolute, known.penalty)
    column = column._replace(extends=known.extends)
    if known.unit in (None, CLOCK):
        return column
    return with_unit(column, "", f"{where} '{header}'", "column", messages)


def _is_unit(header: str) -> bool:
    return not header or unit_of(header) is not None


def _positions(
    chosen: Mapping[str, Choice | None], names: Sequence[str], apart: Sequence[str | None],
    stood: Sequence[str],
) -> dict[int, Choice | None]:  # fmt: skip
    """Column index of each choice.

    A column is named by its header, also as the file writes it or with its unit, or by its place, "column 3".
    """
    bare = [taken_apart(name).name for name in names]
    before = [taken_apart(name).name for name in stood]
    with_units = [_united(name, unit) for name, unit in zip(names, apart, strict=True)]
    with_units_before = [_united(name, None) for name in stood]
    result = {}
    for key, choice in chosen.items():
        numbered = re.fullmatch(r"column ([1-9][0-9]{0,4})", key)
        written = _united(key, None)
        among = next(
            (
                (known, wanted)
                for known, wanted in (
                    (bare, key),
                    (stood, key),
                    (before, key),
                    (with_units, written),
                    (with_units_before, written),
                )
                if list(known).count(wanted) == 1
            ),
            None,
        )
        if key in names:
            index = names.index(key)
        elif among is not None:
            index = list(among[0]).index(among[1])
        elif numbered and int(numbered[1]) <= len(names):
            index = int(numbered[1]) - 1
        else:
            raise InputError(
                f"mapping.columns: the file has no column '{key[:MAX_HEADER]}'",
                field=f"mapping.columns.{key[:MAX_HEADER]}",
                hint=did_you_mean(key, [name for name in (*names, *stood) if name]),
            )
        result[index] = choice
    return result


def _united(name: str, unit: str | None) -> tuple[str, str | None, bool | None]:
    """Name, unit and reference of a column, however they are written: "Kraft (N)" and "Kraft" over "N"."""
    head = taken_apart(name, unit)
    return head.name, head.unit, head.absolute


def _chosen(index: int, header: str, choice: Choice | None, apart: str | None) -> HeaderColumn | None:
    """A column as the user wants it; a unit that is not said is the header's, where it fits."""
    if choice is None:
        return None
    unit, absolute = choice.unit, choice.absolute
    who = "assumed" if choice.assumed else "you"
    origin = "file" if unit is None else who
    if unit is None and choice.channel in CHANNEL_UNITS:
        try:
            guess = plain_column(index, _with(header, apart), header, "column", [])
        except InputError:
            guess = None
        guess = guess or _in_other_words(index, header, apart, {}, [], "column")
        if guess is None and (known := recognise(header, apart)).unit is not None:
            own = WEIGHTS.get(known.unit, known.unit) if choice.channel == "force" else known.unit
            guess = HeaderColumn(index, header, choice.channel, own, known.absolute)
        if (
            guess is not None
            and guess.unit is not None
            and (guess.unit == CLOCK or fits(guess.unit, CHANNEL_UNITS[choice.channel]))
        ):
            unit, absolute = guess.unit, guess.absolute if absolute is None else absolute
    name = header or f"column {index + 1}"
    return HeaderColumn(
        index, name, choice.channel, unit, absolute, sign=choice.sign, origin=who, unit_origin=origin
    )


def _no_channel(
    names: Sequence[str], where: str, field: str, noun: str, messages: Iterable[str]
) -> InputError:
    shown = ", ".join(f"'{n[:40]}'" for n in names[:8])
    if all(re.fullmatch(r"[-+.,0-9eE\s]*", n) for n in names):
        problem = "numbers where the header should be"
        return InputError(f"{where}: {problem}", field=field, hint=HEADER_EXAMPLE)
    words = [re.split(r"[\s_\[(]", n)[0][:40] for n in names[:8]]
    near = [
        did_you_mean(word, SYNONYMS) for word in words if get_close_matches(word.lower(), SYNONYMS, 1, _NEAR)
    ]
    example = next(name for name in names if name)[:40]
    hint = next(iter(near), None) or f'e.g. --column "pressure={example} [bar]", or {HEADER_EXAMPLE[5:]}'
    why = "".join(f"; {message}" for message in messages)
    problem = f"no known channel among the {noun}s {shown}{why}"
    return InputError(f"{where}: {problem}", field=field, hint=hint)
