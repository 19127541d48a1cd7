"""The mass of the hanger on which weights are put: part of the load, where the file states it apart."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from mckibben.measurement.question import Question
from mckibben.measurement.read.evidence import Array
from mckibben.measurement.read.head_text import taken_apart
from mckibben.measurement.read.plain_head import WEIGHTS, HeaderColumn
from mckibben.measurement.read.unit_words import dimension_of, unit_of
from mckibben.measurement.read.vocabulary import REMARK_WORDS, has_word, word_set, words_of
from mckibben.measurement.read.words.hangers import HANGER, MORE
from mckibben.measurement.read.words.tares import INCLUDED, NOT
from mckibben.physics.units import convert

_HANGERS, _NOT, _MORE = word_set(HANGER), word_set(NOT), word_set(MORE)
_INCLUDED = word_set(INCLUDED)
_NUMBER = r"[0-9]+(?:[.,][0-9]+)?"
_QUANTITY = re.compile(rf"(?<![\w.,])({_NUMBER})\s*([^\W\d_]+)(?![\w.,]*\d)")
_SENTENCES = re.compile(r"[;|]|[.!](?=\s|$)")
_LARGE = 0.9  # of the largest load
_G = 9.80665  # m/s2, standard gravity


class Hanger(NamedTuple):
    """The weight [N] of a hanger in a text, and whether the loads contain it (None: not said)."""

    value: float
    contained: bool | None
    text: str
    where: str


def hangers_in(texts: Iterable[tuple[str, str]]) -> list[Hanger]:
    """The hangers of weights that texts state, each with its mass or weight.

    >>> hangers_in([("The hanger (0.5 kg) is not included in the masses.", "line 3")])[0][:2]
    (4.903325, False)
    """
    found = []
    for text, where in texts:
        for sentence in _SENTENCES.split(text):
            words = words_of(sentence)
            if not has_word(words, _HANGERS):
                continue
            values = {
                v for match in _QUANTITY.finditer(sentence) if (v := _weight(sentence, match)) is not None
            }
            if len(values) == 1:
                contained = _contained(words, sentence)
                found.append(Hanger(values.pop(), contained, sentence.strip(" #%*"), where))
    return found


def _contained(words: Sequence[str], sentence: str) -> bool | None:
    """Whether the loads contain the hanger; None where the words do not say it."""
    negated, included = has_word(list(words), _NOT), has_word(list(words), _INCLUDED)
    if included:
        return not negated
    if negated or has_word(list(words), _MORE) or "+" in sentence:
        return False
    return None


def _weight(sentence: str, found: re.Match[str]) -> float | None:
    """The weight [N] of the hanger; None = the quantity is none, or another word stands nearer to it."""
    unit = unit_of(found[2])
    if unit is None or dimension_of(unit.unit) not in ("a force", "a mass"):
        return None
    before = re.split(r"[,+]\s|[0-9]", sentence[: found.start()])[-1]
    behind = re.split(r"[,+]\s|[0-9]", sentence[found.end() :])[0][:40]
    if not has_word([*words_of(before), *words_of(behind)], _HANGERS):
        return None
    value = float(found[1].replace(",", "."))
    return float(convert([value], WEIGHTS.get(unit.unit, unit.unit), "N")[0])


def add_hanger(
    columns: dict[str, Array], by_use: Mapping[str, HeaderColumn], texts: Sequence[tuple[str, str]],
    conditions: dict[str, float | str], messages: list[str], *, answered: bool,
) -> list[Question]:  # fmt: skip
    """Add the weight of a hanger to the loads that do not contain it, with a message.

    The loads are a column of masses, or the load of the whole test. Returns the question where the file does
    not say whether they contain it.
    """
    stated = list({hanger.value: hanger for hanger in hangers_in(texts)}.values())
    column = by_use.get("force")
    weighed = column is not None and "force" in columns and _is_mass(column)
    whole = "force" not in columns and isinstance(conditions.get("load_mass"), float)
    if len(stated) != 1 or answered or not (weighed or whole):
        return []
    (hanger,) = stated
    place = f"'{hanger.text[:100]}' ({hanger.where})"
    load = float(columns["force"].max()) if weighed else float(conditions["load_mass"]) * _G
    if abs(load - hanger.value) < 1e-6 * load:
        return []  # it is the load itself
    if hanger.contained:
        messages.append(f"{place}: the loads are taken to include the hanger")
        return []
    if hanger.contained is False and hanger.value < _LARGE * load:
        if weighed:
            columns["force"] = columns["force"] + hanger.value
            messages.append(
                f"{hanger.value:.4g} N is added to the force for the weight of the hanger: {place}"
            )
        else:
            conditions["load_mass"] = float(conditions["load_mass"]) + hanger.value / _G
            messages.append(f"{hanger.value / _G:.4g} kg is added to the load for the hanger: {place}")
        return []
    name = column.header if weighed and column is not None else "load"
    option = (
        f'--experiment "force_zero={-hanger.value:.4g} N" if it has to be added, or '
        '--experiment "force_zero=0 N" if the loads include it'
        if weighed
        else f'--load "{float(conditions["load_mass"]) + hanger.value / _G:.4g} kg" or '
        f'--load "{conditions["load_mass"]:.4g} kg"'
    )
    return [
        Question(
            "hanger of the load",
            f"the file states the weight of a hanger, {place}, but not whether '{name}' contains it",
            option,
            name if weighed else None,
        )
    ]


def _is_mass(column: HeaderColumn) -> bool:
    """Whether a force is the weight of masses that were put on, or named as a load."""
    head = taken_apart(column.header, column.unit)
    units = {"kgf", "gf", "lbf", "kg", "g"}
    words = words_of(head.name)
    return (column.unit in units and has_word(words, REMARK_WORDS["load"])) or has_word(
        words, word_set("mass masse massa masa weights gewicht poids peso pesi")
    )
