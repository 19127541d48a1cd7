"""The pressure or stroke of a test that no column holds: a line of the file says it, or the file's name."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import PurePath

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.measurement import CHANNEL_UNITS, STROKES
from mckibben.measurement.read.air import ambient_of
from mckibben.measurement.read.head_text import taken_apart
from mckibben.measurement.read.held import HeldQuantity, held_pressure, held_quantities
from mckibben.measurement.read.plain_head import HeaderColumn
from mckibben.measurement.read.source import RawTable
from mckibben.measurement.read.stated import KIND_SAID, NAME
from mckibben.measurement.read.unit_words import RAW_DIMENSIONS, dimension_of
from mckibben.measurement.read.vocabulary import REMARK_WORDS, folded, has_word, word_set, words_of
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
    conditions: Mapping[str, float | str], messages: list[str],
) -> None:  # fmt: skip
    """Forces over pressure without any stroke are at the length, stroke or contraction that a text names.

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
    if not found and str(conditions.get(KIND_SAID, conditions.get("kind", ""))) == "isometric":
        raise InputError(
            f"{name}: the file says that the test is isometric, but neither a column nor a text states the "
            "length at which the muscle was held",
            field="length", hint="write it as a column, 'length_mm', or as a line, '# clamped at L = 285 mm'",
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


def _held_strokes(text: str) -> list[HeldQuantity]:
    """The strokes at which a text says that the muscle was held, clause by clause.

    Right before the quantity stands that it was held, or the name of the quantity: "clamped at 285 mm".
    """
    found = []
    for clause in re.split(r"[,;(]\s|[.]\s|:\s", text):
        words = words_of(clause)
        if _LIMITS & set(words) or has_word(words, _OTHER_LENGTHS):
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
        unit = taken_apart(header, units[index]).unit if index not in used else None
        if unit is not None and dimension_of(unit) in ("a length", "an angle", *RAW_DIMENSIONS):
            return True
    return False


_NEAR = 5  # words, those of the quantity among them
_OTHER_LENGTHS = word_set(
    "radius diameter pulley drum wheel wire tube hose cylinder bore wall travel range durchmesser rolle "
    "scheibe schlauch rayon diametre poulie raggio diametro puleggia radio polea raio polia promien srednica "
    "polomer prumer straal halfsalja"
)
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
