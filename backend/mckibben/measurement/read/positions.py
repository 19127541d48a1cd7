"""Zero and direction of a position that texts state: ``the laser reads 152.4 mm at the rest length``."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from mckibben.measurement.read.scales import Scale
from mckibben.measurement.read.unit_words import dimension_of, unit_of
from mckibben.measurement.read.vocabulary import (
    REMARK_WORDS,
    SIGN_WORDS,
    channel_of_word,
    folded,
    has_word,
    word_set,
    words_of,
)
from mckibben.measurement.read.words import positions as words
from mckibben.physics.units import factor

Texts = Sequence[tuple[str, str]]

_NUMBER = r"[+-]?[0-9]+(?:[.,][0-9]+)?"
_QUANTITY = re.compile(rf"(?<![\w.,])({_NUMBER})\s*([^\W\d_]+|\")(?![\w.,]*\d)")
_CLAUSES = re.compile(r"[;|]|[,.](?=\s|$)|\s[–-]\s|\b(?:and|und|et)\b")
_POSITIONS, _GROWS, _FALLS = (
    word_set(f"{words.POSITION} {words.POSITION_TOO}"),
    word_set(words.GROWS),
    word_set(words.FALLS),
)
_PULLEYS, _RADII, _DIAMETERS = word_set(words.PULLEY), word_set(words.RADIUS), word_set(words.DIAMETER)
_ZEROS, _SEPARATIONS = word_set(words.ZERO), word_set(words.SEPARATION)
_ZERO = re.compile(r"(?<![\w.,])0(?:[.,]0+)?\s*(?:mm\b|cm\b|m\b|in\b)?(?!\s*[^\W\d_]|[.,]\d)")
_NEAR = 3  # words between the name of a reading and its zero
_AT_REST = REMARK_WORDS["at rest"]
_SHORTER = SIGN_WORDS["shortening"] | SIGN_WORDS["shorter"] | word_set(words.SHORTENS)
_LONGER = SIGN_WORDS["extension"] | SIGN_WORDS["longer"]


def position_scale(name: str, unit: str, texts: Texts) -> Scale | None:
    """Displacement = reading less its value at the rest length, in the direction that the texts state.

    None where no text states that value, or texts state several; without a stated direction the readings are
    taken to grow as the muscle shortens, which the questions about signs check.
    """
    own = {word for word in words_of(name) if len(word) > 1}
    stated = _stated([(value, where, text) for text, where in texts for value in _zeros(text, own, unit)])
    falls = _directions(texts, own)
    if stated is None or len(falls) > 1:
        return None
    value, where, text = stated
    sign = -1.0 if falls == {True} else 1.0
    return Scale(sign, -sign * value, unit, unit, "displacement", f"'{text[:100]}'", where)


def _stated(found: Sequence[tuple[float, str, str]]) -> tuple[float, str, str] | None:
    """The value that texts state, where, and the first of these texts; None for none or several values."""
    return found[0] if len({value for value, _, _ in found}) == 1 else None


def _directions(texts: Texts, own: set[str]) -> set[bool]:
    """What texts say of the direction of a reading, see `_direction`."""
    return {found for said, _ in texts if (found := _direction(said, own)) is not None}


def length_scale(name: str, unit: str, texts: Texts) -> Scale | None:
    """Length of the muscle = its length where the reading is 0, plus or minus the reading.

    From texts like ``length at crosshead zero: 228 mm``. The reading adds to it unless a text says that it
    grows as the muscle shortens; None where no text states that length, or texts state several.
    """
    own = {word for word in words_of(name) if len(word) > 1 or name == word}
    stated = _stated([
        (value, where, text) for text, where in texts for value in _lengths_at_zero(text, own, unit)
    ])  # fmt: skip
    falls = _directions(texts, own)
    if stated is None or len(falls) > 1:
        return None
    value, where, text = stated
    shortens = bool(own & _SHORTER) if not falls else falls == {False}
    sign = -1.0 if shortens else 1.0
    return Scale(sign, value, unit, unit, "muscle length", f"'{text[:100]}'", where)


def _lengths_at_zero(text: str, own: set[str], unit: str) -> Iterator[float]:
    """The lengths of the muscle at the reading 0 that a text states, in the unit of the column."""
    for clause in re.split(r"[;|]|[.](?=\s|$)", text):
        sizes = [
            (float(match[1].replace(",", ".")) * scale.multiplier / scale.divisor, match)
            for match in _QUANTITY.finditer(clause)
            if (known := unit_of(match[2])) is not None and dimension_of(known.unit) == "a length"
            for scale in (factor(known.unit, unit),)
        ]
        sizes = [(size, match) for size, match in sizes if size > 0.0]
        if len(sizes) != 1:
            continue
        size, match = sizes[0]
        said = words_of(_ZERO.sub(" zero ", f"{clause[: match.start()]} {clause[match.end() :]}"))
        if has_word(said, _AT_REST):
            continue  # a zero at the rest length: `position_scale`
        named = {at for at, word in enumerate(said) if word in own or word in _POSITIONS - _ZEROS}
        zeros = {at for at, word in enumerate(said) if word in _ZEROS}
        near = any(abs(one - other) <= _NEAR for one in named for other in zeros)
        if near and any(channel_of_word(word) == "length" or word in _SEPARATIONS for word in said):
            yield size


def _zeros(text: str, own: set[str], unit: str) -> Iterator[float]:
    """The readings at the rest length that a text states, in the unit of the column."""
    for clause in _CLAUSES.split(text):
        said = words_of(clause)
        if not (has_word(said, _AT_REST) or "l0" in said):
            continue
        if not (own & set(said) or has_word(said, _POSITIONS)):
            continue
        found = []
        for match in _QUANTITY.finditer(clause):
            known = unit_of(match[2])
            before = words_of(clause[: match.start()])[-4:]
            behind = words_of(clause[match.end() :])[:2]
            near = has_word([*before, *behind], _POSITIONS) or own & {*before, *behind}
            if (
                known is not None
                and dimension_of(known.unit) == "a length"
                and near
                and before[-1:] != ["l0"]
            ):
                scale = factor(known.unit, unit)
                found.append(float(match[1].replace(",", ".")) * scale.multiplier / scale.divisor)
        if len(found) == 1:
            yield found[0]


def _direction(text: str, own: set[str]) -> bool | None:
    """Whether the reading falls as the muscle shortens; None where a text does not say it."""
    whole = set(words_of(text))
    if not (own & whole or has_word(list(whole), _POSITIONS)):
        return None
    for clause in _CLAUSES.split(text):
        said = words_of(clause)
        grows, falls = has_word(said, _GROWS), has_word(said, _FALLS)
        shorter, longer = has_word(said, _SHORTER), has_word(said, _LONGER)
        if grows != falls and shorter != longer:
            return falls if shorter else grows
    return None


def falls_with_shortening(said: str, where: str, texts: Texts) -> bool:
    """Whether the text that states a scale also says that the reading falls as the muscle shortens."""
    return any(
        place == where and _direction(f"position; {text}", set()) is True
        for text, place in texts
        if said.strip("'")[:20] in text
    )


def is_position(name: str) -> bool:
    """Whether a name is that of a position or of a sensor for it, not of a stroke of the muscle."""
    return has_word(words_of(name), _POSITIONS) or bool({*folded(name).split()} & _POSITIONS)


def pulley_scale(unit: str, texts: Texts) -> Scale | None:
    """Displacement [mm] of a wire over a pulley whose radius or diameter a text states, from its angle.

    None where no text states one, or texts state several.
    """
    found: set[tuple[float, str, str]] = set()
    for text, where in texts:
        for clause in re.split(r"[;|]|[,.](?=\s|$)", text):
            said = words_of(clause)
            if not has_word(said, _PULLEYS):
                continue
            share = 0.5 if has_word(said, _DIAMETERS) else 1.0 if has_word(said, _RADII) else None
            sizes = [
                float(match[1].replace(",", ".")) * scale.multiplier / scale.divisor
                for match in _QUANTITY.finditer(clause)
                if (known := unit_of(match[2])) is not None and dimension_of(known.unit) == "a length"
                for scale in (factor(known.unit, "mm"),)
            ]
            if share is not None and len(sizes) == 1:
                found.add((share * sizes[0], text, where))
    if len({radius for radius, _, _ in found}) != 1:
        return None
    radius, text, where = next(iter(found))
    falls = {one for said, _ in texts if (one := _direction(said, {"angle"})) is not None}
    if len(falls) > 1:
        return None
    turn = factor(unit, "rad")
    sign = -1.0 if falls == {True} else 1.0
    return Scale(
        sign * radius * turn.multiplier / turn.divisor,
        0.0,
        unit,
        "mm",
        "displacement",
        f"'{text[:100]}'",
        where,
    )
