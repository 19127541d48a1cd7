"""What a sensor shows at true zero, as texts state it: tares, offsets, fittings in a length over all."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from mckibben.measurement.measurement import CHANNEL_UNITS
from mckibben.measurement.reading.heads import taken_apart
from mckibben.measurement.reading.lexicon import word_set, words_of
from mckibben.measurement.reading.limits import MAX_TEXT
from mckibben.measurement.reading.model import FILE, Evidence, Span, Table
from mckibben.measurement.reading.scales import scales_in
from mckibben.measurement.reading.units import FITTING, WEIGHTS, Quantity, number_of, quantities, quantity_si

_STATED = 5.0  # nats
_LARGE = 0.9  # of the largest load, that a hanger does not reach
_CLAUSES = re.compile(r"[;,](?!\d)\s?")
_SENTENCES = re.compile(r"[;|]|[.!](?=\s|$)")
_NO_LOAD = re.compile(
    r"(?i)nothing (?:attached|hung|on it)|(?:without|with no|no) load|ohne (?:last|kraft)|sans charge|"
    r"senza carico|sin carga|sem carga"
)
_NUMBER = re.compile(r"(?<![\w.,])[-+]?\d{1,9}(?:[.,]\d{1,6})?(?![\w.,%:/-])")  # without a unit
_TIMES = re.compile(r"(?:(?<![\d.,])(?P<count>[1-4])\s?(?:[x×*]\s?|[^\W\d_]{4,}[^\d;,]{0,20}))$")


class Zero(NamedTuple):
    """A reading at true zero.

    Attributes:
        channel: whose sensor shows it.
        value: in SI.
        contained: whether the readings of the file contain it; None = the text does not say so.
        span: of the text.
        bare: it is written without a unit.
    """

    channel: str
    value: float
    contained: bool | None
    span: Span
    bare: bool = False


class Hanger(NamedTuple):
    """The weight [N] of what carries the weights, whether these contain it (None = not said), its text."""

    weight: float
    contained: bool | None
    span: Span


def hangers_in(span: Span) -> Iterator[Hanger]:
    """The hangers with their masses or weights that a text states."""
    for sentence in _SENTENCES.split(span.text[:MAX_TEXT]):
        words = words_of(sentence)
        if not word_set("hanger").among(words):
            continue
        found = {weight for q in quantities(sentence) if (weight := _hanging(sentence, q)) is not None}
        negated = word_set("negations").among(words)
        if word_set("tare_included").among(words):
            contained: bool | None = not negated
        else:
            contained = False if negated or "+" in sentence or word_set("on_top").among(words) else None
        if len(found) == 1:
            yield Hanger(found.pop(), contained, span)


def _hanging(sentence: str, quantity: Quantity) -> float | None:
    """The weight [N] that a quantity is of a hanger; None = it is none, or a comma or a number parts them."""
    if quantity.unit.dimension not in FITTING["force"]:
        return None
    before = re.split(r"[,+]\s|[0-9]", sentence[: quantity.begin])[-1]
    behind = re.split(r"[,+]\s|[0-9]", sentence[quantity.end :])[0][:40]
    if not word_set("hanger").among([*words_of(before), *words_of(behind)]):
        return None
    return quantity_si(quantity.value, WEIGHTS.get(quantity.unit.name, quantity.unit.name), "N")


def zeros_in(span: Span) -> Iterator[Zero]:
    """The zeros that a text states."""
    text = span.text[:MAX_TEXT]
    if not any(c.isdigit() for c in text) or "mV/V" in text:
        return
    scaled = bool(scales_in(text))
    contained = _contained(words_of(text))
    for clause in _CLAUSES.split(text):
        words = words_of(clause)
        if scaled and (not word_set("tare_tare|sensor_zero").among(words) or scales_in(clause)):
            continue
        found = quantities(clause)
        bare = _NUMBER.findall(clause) if word_set("tare_tare").among(words) and not found else ()
        if len(bare) == 1 and number_of(bare[0]):
            yield Zero("force", number_of(bare[0]), False if contained is False else None, span, True)
        for quantity in found:
            if not quantity.value:
                continue
            fittings = _of_fittings(clause, words, quantity)
            if fittings is not None:
                yield Zero("length", fittings[0], fittings[1], span)
            elif (channel := _channel(clause, words, quantity.unit.dimension, scaled=scaled)) is not None:
                unit = WEIGHTS.get(quantity.unit.name, quantity.unit.name)
                value = quantity_si(quantity.value, unit, CHANNEL_UNITS[channel])
                yield Zero(channel, value, contained, span)


def stated_zeros(table: Table) -> list[Zero]:
    """The zeros that the texts beside a table and its heads state, each once."""
    heads = (span for c in table.columns for span in (Span(c.where, c.head), *c.described))
    return list(dict.fromkeys(zero for span in (*table.texts, *heads) for zero in zeros_in(span)))


def of_zeros(table: Table) -> list[Evidence]:
    """The zeros that the readings contain, one of each channel: they are subtracted."""
    found: dict[str, dict[float, Zero]] = {}
    for zero in (z for z in stated_zeros(table) if z.contained):
        found.setdefault(zero.channel, {}).setdefault(zero.value, zero)
    return [
        *_of_hangers(table),
        *(
            Evidence(FILE, f"zero:{channel}", value, _STATED, zero.span, "zero")
            for channel, zeros in found.items()
            for value, zero in zeros.items()
            if len(zeros) == 1
        ),
    ]


def stated_hangers(table: Table) -> list[Hanger]:
    """The hangers that the texts beside a table state, each weight once."""
    return list({h.weight: h for span in table.texts for h in hangers_in(span)}.values())


def _of_hangers(table: Table) -> list[Evidence]:
    """A hanger that columns of masses lack: it is added to them, as a zero below 0."""
    found = stated_hangers(table)
    if len(found) != 1 or found[0].contained is not False:
        return []
    columns = [
        (i, c.values, taken_apart(c.head, c.unit).unit)
        for i, c in enumerate(table.columns)
        if c.words is None
    ]
    return [
        Evidence(i, "zero:force", -found[0].weight, _STATED, found[0].span, "hanger")
        for i, values, unit in columns
        if unit is not None
        and unit.dimension == "mass"
        and found[0].weight < _LARGE * quantity_si(float(np.nanmax(values)), WEIGHTS[unit.name], "N")
    ]


def _contained(words: Sequence[str]) -> bool | None:
    """Whether the readings contain a zero, by what is said to be done with it."""
    negated = word_set("negations").among(words)
    if word_set("tare_done").among(words):
        if word_set("tare_must").among(words):
            return None if negated else True
        return negated or word_set("tare_still").among(words)
    if word_set("tare_to_do|tare_included").among(words):
        return None if negated else True
    return None


def _channel(clause: str, words: Sequence[str], dimension: str, *, scaled: bool) -> str | None:
    """The channel whose zero a quantity is by the words around it; None = it is none."""
    words = [word for word in words if word != "0"]
    offset, force = word_set("sensor_zero").among(words), word_set("@force|force_sensor").among(words)
    if dimension in FITTING["force"]:
        empty = word_set("tare_reads").among(words) and _NO_LOAD.search(clause) is not None
        zero = (
            word_set("zero").among(words)
            and word_set("force_sensor").among(words)
            and not word_set("@displacement|@pressure|@length|@contraction").among(words)
        )
        return (
            "force"
            if word_set("tare_tare").among(words) or empty or zero or (offset and (force or scaled))
            else None
        )
    if not offset or force or word_set("at_rest|rest_length").among(words):
        return None
    if dimension == "pressure" and not word_set("ambient|supply").among(words):
        return "pressure" if word_set("@pressure").among(words) else None
    if dimension == "length":
        return "displacement" if word_set("@displacement").among(words) else None
    return None


def _of_fittings(clause: str, words: Sequence[str], quantity: Quantity) -> tuple[float, bool | None] | None:
    """The length [m] of the fittings that the readings of the length contain, and whether it is sure."""
    if (
        quantity.unit.dimension != "length"
        or not word_set("ends").among(words)
        or not word_set("tare_included").among(words)
        or word_set("at_rest|rest_length|negations").among(words)
    ):
        return None
    times = _TIMES.search(clause[: quantity.begin])
    each = word_set("each").among(words)
    count = int(times["count"]) if times else 2 if each else 1
    return count * quantity_si(quantity.value, quantity.unit.name, "m"), True if times or each else None
