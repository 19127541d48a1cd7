"""The tare of a load cell that a text states: subtracted where it says so, asked about where it does not."""

from __future__ import annotations

import re
from collections.abc import Container, Iterable, Mapping
from typing import NamedTuple

import numpy as np

from mckibben.measurement.question import Question
from mckibben.measurement.read.conditions import Note
from mckibben.measurement.read.evidence import Array
from mckibben.measurement.read.head_text import taken_apart
from mckibben.measurement.read.plain_head import WEIGHTS, HeaderColumn
from mckibben.measurement.read.unit_words import dimension_of, unit_of
from mckibben.measurement.read.vocabulary import channel_of_word, folded, word_set, words_of
from mckibben.measurement.read.words import tares as words_of_tares
from mckibben.physics.units import convert

_NUMBER = r"[+-]?[0-9]+(?:[.,][0-9]+)?"
_QUANTITY = re.compile(rf"(?<![\w.,])({_NUMBER})\s*([^\W\d_]+)(?![\w.,]*\d)")
_UNIT_FIRST = re.compile(rf"\s*[\[(]\s*([^\W\d_]+)\s*[\])]\s*[:=]?\s*({_NUMBER})")
_SENTENCES = re.compile(r"[;|]|[.!](?=\s|$)")
_OTHERS = frozenset(("pressure", "length", "displacement", "contraction", "time", "temperature"))
#: A tare without unit is the only number of its sentence, at the end.
_BARE = re.compile(rf"^[^0-9]*[:=\s]\s*({_NUMBER})\s*$")
_NEAR = 40  # characters
_NOTHING = 0.01  # of the largest reading
_LARGE = 0.5  # of the largest reading; a tare is no measurement


_TARE, _NOT, _DONE = map(word_set, (words_of_tares.TARE, words_of_tares.NOT, words_of_tares.DONE))
_READS = word_set(words_of_tares.READS)
_TO_DO, _INCLUDED = word_set(words_of_tares.TO_DO), word_set(words_of_tares.INCLUDED)


class Tare(NamedTuple):
    """The reading without pull [N] in a text, and whether the readings contain it (None: not said).

    ``bare``: the text gives no unit; the value is the number as it stands.
    """

    value: float
    contained: bool | None
    text: str
    where: str
    bare: bool = False


def tares_in(texts: Iterable[tuple[str, str]]) -> list[Tare]:
    """The tares of forces that texts state, each with a value other than 0.

    >>> tares_in([("Tara 2,1 N nicht abgezogen", "line 2")])[0][:2]
    (2.1, True)
    >>> tares_in([("tare 4 N, already subtracted", "line 2")])[0].contained
    False
    """
    found = []
    for text, where in texts:
        for sentence in _SENTENCES.split(text):
            tare = _of_sentence(sentence.strip(" #%*-"), where)
            if tare is not None and tare.value != 0.0:
                found.append(tare)
    return found


def notes_of_tares(notes: Iterable[Note]) -> list[tuple[str, str]]:
    """The conditions of a file whose name says a tare, as texts with their places."""
    found = []
    for note in notes:
        if not _has(words_of(note.key), _TARE):
            continue
        unit = taken_apart(note.key).unit or note.key.rpartition("_")[2]
        bare = isinstance(note.value, float) or re.fullmatch(_NUMBER, str(note.value).strip()) is not None
        found.append((f"{note.key}: {note.value}{f' {unit}' if bare and unit_of(unit) else ''}", note.where))
    return found


def _of_sentence(sentence: str, where: str) -> Tare | None:
    sentence = _UNIT_FIRST.sub(r": \2 \1", sentence)
    words = words_of(sentence)
    empty = reads_empty(sentence)
    if not _has(words, _TARE) and not empty:
        return None
    values = {
        value
        for match in _QUANTITY.finditer(sentence)
        if (empty or _is_beside(sentence, match)) and (value := _force(match)) is not None
    }
    if not values and (bare := _BARE.search(sentence)) and not {*map(channel_of_word, words)} & _OTHERS:
        return Tare(float(bare[1].replace(",", ".")), None, sentence, where, bare=True)
    if len(values) != 1:
        return None
    return Tare(values.pop(), is_contained(words, folded(sentence)), sentence, where)


def reads_empty(sentence: str) -> bool:
    """Whether a sentence says what something reads with nothing on it.

    >>> reads_empty("scale reads 0.850 kg with nothing attached")
    True
    """
    plain = folded(sentence)
    return any(phrase in plain for phrase in words_of_tares.EMPTY) and _has(words_of(sentence), _READS)


def _is_beside(sentence: str, found: re.Match[str]) -> bool:
    """Whether the word for a tare stands near a quantity, without a comma or another number between them.

    Words for another quantity than a force beside it make it the tare of something else.
    """
    before = re.split(r",\s|[0-9]", sentence[: found.start()])[-1]
    behind = re.split(r",\s|[0-9]", sentence[found.end() :])[0]
    near = [words_of(before[-_NEAR:]), words_of(behind[:_NEAR])]
    return any(
        _has(words, _TARE) and not {channel_of_word(word) for word in words} & _OTHERS for words in near
    )


def _force(found: re.Match[str]) -> float | None:
    """A force [N], also as the weight of a mass; None = the quantity is neither."""
    unit = unit_of(found[2]) or unit_of(found[2].lower())
    if unit is None or dimension_of(unit.unit) not in ("a force", "a mass"):
        return None
    return float(convert([float(found[1].replace(",", "."))], WEIGHTS.get(unit.unit, unit.unit), "N")[0])


def is_contained(words: list[str], plain: str) -> bool | None:
    """Whether the readings contain the tare; None where the words do not say it, or say both."""
    negated = _has(words, _NOT) or any(phrase in plain for phrase in words_of_tares.NOT_YET)
    if _has(words, _DONE) and any(phrase in plain for phrase in words_of_tares.MUST):
        return None if negated else True
    done, to_do, included = _has(words, _DONE), _has(words, _TO_DO), _has(words, _INCLUDED)
    if negated:  # of "not included" and "do not subtract" it is not clear which side is meant
        return True if done and not (to_do or included) else None
    if done and (included or to_do):
        return None
    if done:
        return False
    return True if to_do or included else None


def _has(words: list[str], known: frozenset[str]) -> bool:
    return any(word in known for word in words)


def subtract_tare(
    columns: dict[str, Array], by_use: Mapping[str, HeaderColumn], texts: Iterable[tuple[str, str]],
    conditions: Mapping[str, float | str], messages: list[str],
) -> list[Question]:  # fmt: skip
    """Subtract a tare that the readings contain from the force [N], with a message.

    Returns the question where a text states a tare and not whether the readings contain it, where several
    differ, or where it is as large as the readings.
    """
    force, column = columns.get("force"), by_use.get("force")
    if force is None or column is None or not len(force):
        return []
    stated: list[Tare] = []
    for tare in tares_in(texts):  # the head of each page may say it again
        if not any((tare.value, tare.contained) == (t.value, t.contained) for t in stated):
            stated.append(tare)
    if not stated:
        return []
    first = stated[0]
    place = f"'{first.text[:100]}' ({first.where})"
    if "force_zero" in conditions:
        messages.append(f"the tare {place} is not used: the zero of the force is stated as well")
        return []
    # Of a column that counts a pull as negative it is open which sign the tare has.
    sure = (
        len(stated) == 1
        and not first.bare
        and column.sign > 0
        and first.value < _LARGE * float(np.max(np.abs(force)))
    )
    if sure and first.contained is False:
        messages.append(f"{place}: the tare is taken as already subtracted from the force")
        return []
    if sure and first.contained:
        columns["force"] = force - first.value
        messages.append(f"{first.value:.4g} N is subtracted from the force: {place}")
        return []
    return [
        Question(
            "zero of force",
            f"the file states a tare of the force, {place}, "
            f"{'without a unit, ' if first.bare else ''}but it is not clear whether the readings of "
            f"column '{column.header}' contain it; what do they show at zero force",
            f'--experiment "force_zero={first.value:.4g} N", or --experiment "force_zero=0 N" where it is '
            "subtracted already",
            column.header,
        )
    ]


def zero_questions(
    columns: Mapping[str, Array], by_use: Mapping[str, HeaderColumn], unzeroed: Container[int],
    conditions: Mapping[str, float | str],
) -> list[Question]:  # fmt: skip
    """A question where a bridge is read by its sensitivity alone, and no reading shows its zero.

    A force that comes down to nothing shows it: a muscle does not push.
    """
    force, column = columns.get("force"), by_use.get("force")
    if force is None or column is None or not len(force) or column.place not in unzeroed:
        return []
    smallest, largest = float(np.min(np.abs(force))), float(np.max(np.abs(force)))
    if "force_zero" in conditions or smallest <= _NOTHING * largest:
        return []
    return [
        Question(
            "zero of force",
            f"column '{column.header}' is read by the sensitivity of its load cell, and neither the file "
            f"nor a reading (all are at least {smallest:.4g} N) states what it shows at zero force",
            '--experiment "force_zero=0 N"',
            column.header,
        )
    ]
