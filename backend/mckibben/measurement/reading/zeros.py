"""What a sensor shows at true zero, as texts state it: tares, offsets, fittings in a length over all."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from mckibben.measurement.measurement import CHANNEL_UNITS
from mckibben.measurement.reading.lexicon import word_set, words_of
from mckibben.measurement.reading.limits import MAX_TEXT
from mckibben.measurement.reading.model import FILE, Evidence, Span, Table
from mckibben.measurement.reading.scales import scales_in
from mckibben.measurement.reading.units import FITTING, WEIGHTS, Quantity, number_of, quantities, quantity_si

_STATED = 5.0  # nats
_CLAUSES = re.compile(r"[;,](?!\d)\s?")
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
        text: as it is written.
        span: of the text.
    """

    channel: str
    value: float
    contained: bool | None
    text: str
    span: Span


def zeros_in(span: Span) -> Iterator[Zero]:
    """The zeros that a text states."""
    text = span.text[:MAX_TEXT]
    if not any(c.isdigit() for c in text) or "mV/V" in text or next(scales_in(text), None) is not None:
        return
    contained = _contained(words_of(text))
    for clause in _CLAUSES.split(text):
        words = words_of(clause)
        found = quantities(clause)
        bare = _NUMBER.findall(clause) if word_set("tare_tare").among(words) and not found else ()
        if len(bare) == 1 and number_of(bare[0]):
            yield Zero(
                "force", number_of(bare[0]), False if contained is False else None, f"{bare[0]} N", span
            )
        for quantity in found:
            if not quantity.value:
                continue
            fittings = _of_fittings(clause, words, quantity)
            if fittings is not None:
                yield Zero("length", fittings[0], fittings[1], quantity.text, span)
            elif (channel := _channel(clause, words, quantity.unit.dimension)) is not None:
                unit = WEIGHTS.get(quantity.unit.name, quantity.unit.name)
                value = quantity_si(quantity.value, unit, CHANNEL_UNITS[channel])
                yield Zero(channel, value, contained, quantity.text, span)


def stated_zeros(table: Table) -> list[Zero]:
    """The zeros that the texts beside a table and its heads state, each once."""
    heads = (Span(c.where, text) for c in table.columns for text in (c.head, *c.described))
    return list(dict.fromkeys(zero for span in (*table.texts, *heads) for zero in zeros_in(span)))


def of_zeros(table: Table) -> list[Evidence]:
    """The zeros that the readings contain, one of each channel: they are subtracted."""
    found: dict[str, dict[float, Zero]] = {}
    for zero in (z for z in stated_zeros(table) if z.contained):
        found.setdefault(zero.channel, {}).setdefault(zero.value, zero)
    return [
        Evidence(FILE, f"zero:{channel}", value, _STATED, zero.span, "zero")
        for channel, zeros in found.items()
        for value, zero in zeros.items()
        if len(zeros) == 1
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


def _channel(clause: str, words: Sequence[str], dimension: str) -> str | None:
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
        return "force" if word_set("tare_tare").among(words) or empty or zero or (offset and force) else None
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
