"""Positions whose texts say how they count: the length where one is 0, the pulley whose angle one is."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator

from mckibben.measurement.reading.heads import head_claims, taken_apart
from mckibben.measurement.reading.lexicon import word_set, words_of
from mckibben.measurement.reading.limits import MAX_TEXT
from mckibben.measurement.reading.model import Evidence, Table
from mckibben.measurement.reading.scales import Scale
from mckibben.measurement.reading.units import quantities, quantity_si

_SAID = 6.0  # nats
_SENTENCES = re.compile(r"[;|]|[.](?=\s|$)")
_CLAUSES = re.compile(r"[;|]|[,.](?=\s|$)")
_ZERO = re.compile(r"(?<![\w.,])0(?:[.,]0{1,4})?\s?(?:mm\b|cm\b|m\b|in\b)?(?!\s*[^\W\d_]|[.,]\d)")
_PLUS = re.compile(r"=\s?([^\W\d]\w{0,20})\s?\+\s?$")  # "length = crosshead + 214.6 mm"
_NEAR = 3  # words between the name of a position and its zero


def of_positions(table: Table) -> list[Evidence]:
    """The lengths and strokes that positions are by what texts say of them."""
    found: list[Evidence] = []
    for i, column in enumerate(table.columns):
        unit = taken_apart(column.head, column.unit).unit
        if unit is None or column.words is not None:
            continue
        claims = {(c.facet, c.value) for c in head_claims(column.head[:200], column.unit)}
        if unit.dimension == "length" and ("channel", "displacement") in claims:
            own = {word for word in words_of(taken_apart(column.head, column.unit).name) if len(word) > 1}
            lengths = {v: span for span in table.texts for v in lengths_at_zero(span.text, own)}
            if len(lengths) == 1:
                ((length, span),) = lengths.items()
                sign = -1.0 if ("sign_stroke", 1) in claims else 1.0  # it counts what the muscle shortens
                at = length / quantity_si(1.0, unit.name, "m")
                scale = Scale(sign, -sign * at, unit.name, unit.name, "length at zero", _SAID, span.text[:80])
                found.append(Evidence(i, "scale", scale, _SAID, span, scale.rule))
                found.append(Evidence(i, "channel", "length", _SAID, span, scale.rule))
        if unit.dimension == "angle":
            radii = {r: span for span in table.texts for r in pulleys_in(span.text)}
            if len(radii) == 1:
                ((radius, span),) = radii.items()
                turn = 1e3 * radius * quantity_si(1.0, unit.name, "rad")
                scale = Scale(turn, 0.0, "mm", unit.name, "pulley", _SAID, span.text[:80])
                found.append(Evidence(i, "scale", scale, _SAID, span, scale.rule))
                found.append(Evidence(i, "channel", "displacement", _SAID, span, scale.rule))
                found.append(Evidence(i, "zero_open", True, 1.5, span, scale.rule))
    return found


def lengths_at_zero(text: str, own: Collection[str]) -> Iterator[float]:
    """The lengths [m] of the muscle at the reading 0 of a position that a text states; ``own``: its words.

    >>> list(lengths_at_zero("muscle length at crosshead zero: 22.8 cm", ()))
    [0.228]
    """
    for sentence in _SENTENCES.split(text[:MAX_TEXT]):
        found = [q for q in quantities(sentence) if q.unit.dimension == "length" and q.value > 0.0]
        if len(found) != 1:
            continue
        plus = _PLUS.search(sentence, 0, found[0].begin)
        if plus is not None and word_set("@length").among(words_of(sentence[: plus.start()])):
            if {*words_of(plus[1])} & {*own} or word_set("position_position").among(words_of(plus[1])):
                yield quantity_si(found[0].value, found[0].unit.name, "m")
            continue
        rest = f"{sentence[: found[0].begin]} {sentence[found[0].end :]}"
        said = words_of(_ZERO.sub(" zero ", rest))
        if word_set("at_rest|rest_length").among(said) or not word_set("@length|separation").among(said):
            continue
        zeros = [at for at, word in enumerate(said) if word_set("zero").knows(word)]
        named = [at for at, w in enumerate(said) if w in own or word_set("position_position").knows(w)]
        if any(0 < abs(one - other) <= _NEAR for one in named for other in zeros):
            yield quantity_si(found[0].value, found[0].unit.name, "m")


def pulleys_in(text: str) -> Iterator[float]:
    """The radii [m] of the pulleys that a text states.

    >>> list(pulleys_in("wire over a drum of 50 mm diameter"))
    [0.025]
    """
    for clause in _CLAUSES.split(text[:MAX_TEXT]):
        words = words_of(clause)
        found = [q for q in quantities(clause) if q.unit.dimension == "length"]
        if len(found) != 1 or not word_set("position_pulley").among(words):
            continue
        whole = word_set("@diameter|symbol_diameter").among(words)
        if whole or word_set("position_radius").among(words):
            yield (0.5 if whole else 1.0) * quantity_si(found[0].value, found[0].unit.name, "m")
