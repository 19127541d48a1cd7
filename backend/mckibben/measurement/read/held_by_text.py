"""The pressure or stroke of a test that no column holds: a line of the file says it, or the file's name."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import PurePath

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.measurement import CHANNEL_UNITS, STROKES
from mckibben.measurement.read.air import ambient_of
from mckibben.measurement.read.correction import Correction
from mckibben.measurement.read.head_text import taken_apart
from mckibben.measurement.read.held import HeldQuantity, held_pressure, held_quantities
from mckibben.measurement.read.held_by_name import NamedLength, length_of_name, numbers_in_name
from mckibben.measurement.read.plain_head import HeaderColumn
from mckibben.measurement.read.source import RawTable
from mckibben.measurement.read.stated import KIND_SAID, NAME
from mckibben.measurement.read.unit_words import RAW_DIMENSIONS, dimension_of
from mckibben.measurement.read.valve_pressure import is_command
from mckibben.measurement.read.vocabulary import (
    OTHER_LENGTHS,
    REMARK_WORDS,
    folded,
    has_word,
    word_set,
    words_of,
)
from mckibben.physics.errors import InputError
from mckibben.physics.units import convert


def hold_pressure(
    columns: dict[str, NDArray], by_use: dict[str, HeaderColumn], name: str, source: RawTable,
    conditions: Mapping[str, float | str], messages: list[str],
) -> None:  # fmt: skip
    """Forces over a stroke without any pressure are at the one that a line states, else the file's name.

    A line beats the name, and a message says where they differ. Of several lines the one counts that the name
    agrees with.

    Raises:
        InputError: lines state several pressures, and the name none of them.
    """
    if "pressure" in columns or "force" not in columns or not set(columns) & set(STROKES):
        return
    stated = {_pascal(said, conditions): (said, where) for said, where in _stated(source)}
    named = held_pressure(PurePath(name).stem)
    if len(stated) > 1:
        agreed = None if named is None else stated.get(_pascal(named, conditions))
        if agreed is None:
            shown = ", ".join(f"'{said.text}' ({where})" for said, where in stated.values())
            raise InputError(
                f"{name}: no column holds the pressure, and the texts state several: {shown}; at which one "
                "was it measured",
                field="pressure",
                hint="keep only one of them in the file, or write the pressure as a column, 'pressure_bar'",
            )
        stated = {0.0: agreed}
    said, where = next(iter(stated.values()), (named, NAME))
    if said is None:
        return
    value = _pascal(said, conditions)
    columns["pressure"] = np.full(len(columns["force"]), value)
    by_use["pressure"] = HeaderColumn(-1, where, "pressure", said.unit, said.absolute)
    if where == NAME:
        messages.append(f"pressure is taken from the file's name: '{said.text}'")
        return
    messages.append(f"pressure is taken from {where}: '{said.text}'")
    if named is not None and abs(_pascal(named, conditions) - value) > 1e-3 * abs(value):
        messages.append(
            f"the file's name states another pressure, '{named.text}': the one in {where} is used"
        )


def hold_stroke(
    columns: dict[str, NDArray], by_use: dict[str, HeaderColumn], source: RawTable, name: str,
    conditions: dict[str, float | str], messages: list[str], correction: Correction,
) -> None:  # fmt: skip
    """Forces over pressure without any stroke are at the length, stroke or contraction that a text names.

    Where no text does, it is the length in the file's name, if the rest length is known from elsewhere.

    Raises:
        InputError: texts name several, or the file says that it is an isometric test and names none.
    """
    if not {"pressure", "force"} <= set(columns) or set(columns) & {*STROKES, "diameter", "command"}:
        return
    if _has_other_stroke(source, by_use):
        return
    found = {
        (said.channel, float(convert([said.value], said.unit, CHANNEL_UNITS[said.channel])[0])): (said, where)
        for text, where in source.rest
        for said in _held_strokes(text)
    }
    if len({channel for channel, _ in found}) > 1:  # a length with the contraction that it is
        found = {key: one for key, one in found.items() if key[0] == "length"} or found
    isometric = str(conditions.get(KIND_SAID, conditions.get("kind", ""))) == "isometric"
    named = None if found else _named_length(source, name, conditions, correction, isometric=isometric)
    if named is not None:
        columns["length"] = np.full(len(columns["force"]), named.value)
        by_use["length"] = HeaderColumn(-1, NAME, "length", "m")
        if (
            correction.conditions.get("nominal_length") is None
            and conditions.get("nominal_length") == named.value
        ):
            del conditions["nominal_length"]  # the name was taken to say the rest length
        messages.append(
            f"length is taken from {NAME}: '{named.text}'{f' ({named.why})' if named.why else ''}"
        )
    elif not found and isometric:
        raise InputError(
            f"{name}: the file says that the test is isometric, but neither a column nor a text states the "
            "length at which the muscle was held",
            field="length", hint=_how_to_say(name, source, conditions, correction),
        )  # fmt: skip
    if len(found) > 1:
        shown = ", ".join(f"'{said.text}' ({where})" for said, where in found.values())
        raise InputError(
            f"{name}: no column holds the stroke, and the texts state several: {shown}; at which one was it "
            "measured",
            field="length", hint="write the length as a column, 'length_mm'",
        )  # fmt: skip
    for (channel, value), (said, where) in found.items():
        columns[channel] = np.full(len(columns["force"]), value)
        by_use[channel] = HeaderColumn(-1, where, channel, said.unit)
        messages.append(f"{channel} is taken from {where}: '{said.text}'")


def _named_length(
    source: RawTable, name: str, conditions: Mapping[str, float | str], correction: Correction, *,
    isometric: bool,
) -> NamedLength | None:  # fmt: skip
    """The length in the file's name; a bare number is an assumption, which a strict reading refuses."""
    rest = _rest_length(source, conditions, correction)
    if rest is None:
        return None
    found = length_of_name(name, rest, isometric=isometric, others=correction.beside)
    return None if found is not None and found.why and correction.strict else found


def _rest_length(
    source: RawTable, conditions: Mapping[str, float | str], correction: Correction
) -> float | None:
    """The rest length [m], unless the name of the file alone says it: then it may be the length held."""
    rest = conditions.get("nominal_length")
    by_name = any(note.key == "nominal_length" and note.where == NAME for note in source.notes)
    if not isinstance(rest, (int, float)) or (
        by_name and correction.conditions.get("nominal_length") is None
    ):
        return correction.muscle_length
    return float(rest)


def _how_to_say(
    name: str, source: RawTable, conditions: Mapping[str, float | str], correction: Correction
) -> str:
    """What would be right where nothing says the length; the name may hold it beside a rest length."""
    hint = "write it as a column, 'length_mm', or as a line, '# clamped at L = 285 mm'"
    numbers = numbers_in_name(name)
    if not numbers or _rest_length(source, conditions, correction) is not None:
        return hint
    shown = " or ".join(f"'{number}'" for number in numbers)
    return f"{hint}; if it is the {shown} in {NAME}, state the rest length: --rest-length"


def _held_strokes(text: str) -> list[HeldQuantity]:
    """The strokes at which a text says that the muscle was held, clause by clause.

    Right before the quantity stands that it was held, or the name of the quantity: "clamped at 285 mm".
    """
    found = []
    for clause in re.split(r"[,;(]\s|[.]\s|:\s", text):
        words = words_of(clause)
        if _LIMITS & set(words) or has_word(words, OTHER_LENGTHS):
            continue
        held = has_word(words, _HELD_WORDS) or "isometr" in folded(clause)
        for said in held_quantities(clause):
            before = words_of(clause[: max(0, clause.find(said.text))] + " " + said.text)[-_NEAR:]
            near = has_word(before, _HELD_WORDS) or said.worded
            if said.channel in STROKES and near and (held or re.search("=|:", said.text)):
                found.append(said)
    return found


def _has_other_stroke(source: RawTable, by_use: Mapping[str, HeaderColumn]) -> bool:
    """Whether a column that is not read may be the stroke: lengths, angles, signals without a scale."""
    used = {column.place for column in by_use.values()}
    units = [*source.units, *[None] * (len(source.headers) - len(source.units))]
    for index, header in enumerate(source.headers):
        head = taken_apart(header, units[index])
        unit = head.unit if index not in used and not is_command(head.name, head.unit) else None
        if unit is not None and dimension_of(unit) in ("a length", "an angle", *RAW_DIMENSIONS):
            return True
    return False


_NEAR = 5  # words, those of the quantity among them
_LIMITS = REMARK_WORDS["loadless"]
_HELD_WORDS = REMARK_WORDS["constant"] | word_set(
    "clamped clamp held locked blocked fixed at eingespannt "
    "festgehalten fixiert fest bei bloque fixe fixee bloquee "
    "a fija fijo sujeto bloccato bloccata fissa fissato fixado fixo preso zablokowany zamocowany upnuty "
    "ingeklemd vastgezet fastspand last fast kiinni sabit закреплен зажат 固定 fixed-length"
)


def _stated(source: RawTable) -> list[tuple[HeldQuantity, str]]:
    """The pressures that texts name as such, with their places."""
    texts = [*source.rest]
    texts += [(f"pressure: {note.value}", note.where) for note in source.notes if note.key == "pressure"]
    limits = REMARK_WORDS["loadless"] | REMARK_WORDS["ambient"] | REMARK_WORDS["supply"]
    return [
        (said, where)
        for text, where in texts
        if not has_word(words_of(text), limits) and (said := held_pressure(text)) is not None and said.named
    ]


def _pascal(said: HeldQuantity, conditions: Mapping[str, float | str]) -> float:
    """The gauge pressure [Pa]; what it counts from may stand elsewhere in the file."""
    absolute = said.absolute
    if absolute is None:
        absolute = str(conditions.get("pressure", "")).lower().startswith("abs")
    return float(convert([said.value], said.unit, "Pa")[0]) - (ambient_of(conditions) if absolute else 0.0)
