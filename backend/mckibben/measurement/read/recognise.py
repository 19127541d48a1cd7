"""What a head of a table means, in the words of any laboratory: a channel, its unit, or why it is none.

It comes after the plain way (``pressure_bar``) and never overrules it.
"""

from __future__ import annotations

import re
from typing import NamedTuple

from mckibben.measurement.read.head_text import channel_of_letter, taken_apart, without_run
from mckibben.measurement.read.held import proper, without_pressure
from mckibben.measurement.read.left_out import OF_WORDS, UNKNOWN, LeftOut, Reason, by_word
from mckibben.measurement.read.plain_head import SET_QUANTITIES
from mckibben.measurement.read.unit_words import COUNT, DIMENSIONS, RAW_DIMENSIONS, dimension_of
from mckibben.measurement.read.vocabulary import (
    COMMANDED,
    LESS_WANTED,
    NO_CHANNEL,
    STATISTICS,
    channel_of_word,
    has_word,
    other_quantity,
    words_of,
)

BY_WORDS, BY_UNIT = 10, 60  # how much less such a column is wanted than one named the plain way
_VALUE = re.compile(r"[^\W\d_]{1,12}0?\s*[=≈]\s*[0-9]+(?:[.,][0-9]+)?\s*[^\W\d_%]{0,4}%?")  # "L = 280 mm"
_CHANGES = frozenset(("change", "delta", "anderung", "variation", "difference"))
_ALSO_VOLTAGE = frozenset(("tension", "tensione", "tensao"))  # a voltage in other languages
_STROKES_FROM_REST = frozenset(("displacement", "contraction", "extension"))  # "shortening from rest length"
#: "dL", "ΔL", "delta x": how much longer or further; a d before another letter is no diameter.
_CHANGE_OF = re.compile(r"(?:d|Δ|∆|δ|delta|Delta)[ _]?([Llxs])(?![^\W\d_])")
#: "ΔL/L0", "(L-L0)/L0", "(L0-L)/L0": the change of length as a share of the rest length.
_SHARE = re.compile(
    r"(?:.*[=:\s])?(?:(?P<longer>(?:d|Δ|∆|δ|delta[ _]?|Delta[ _]?)[Ll]|\(\s*[Ll]\s*[-−–]\s*[Ll]_?[0₀o]\s*\))"
    r"|\(\s*[Ll]_?[0₀o]\s*[-−–]\s*[Ll]\s*\))\s*/\s*[Ll]_?[0₀o]"
)
#: "p_des", "x_des": a letter of which the rest says that it is what was desired.
_DESIRED = re.compile(r"[A-Za-z][0-9]?[ _]?des")
_RAW = 3  # of LESS_WANTED: a raw column


class Recognised(NamedTuple):
    """What a head means. ``channel`` None = none, because of ``left_out``.

    ``extends``: it grows as the muscle becomes longer.
    """

    channel: str | None
    unit: str | None
    absolute: bool | None
    penalty: int
    left_out: LeftOut | None = None
    extends: bool = False

    @property
    def otherwise(self) -> bool:
        """Whether a word of the name says that it is something else than a channel."""
        return self.left_out is not None and self.left_out.reason in OF_WORDS


def _unknown(unit: str | None) -> Recognised:
    return Recognised(None, unit, None, 0, UNKNOWN)


def _none(unit: str | None, reason: Reason, text: str) -> Recognised:
    return Recognised(None, unit, None, 0, LeftOut(reason, text))


def recognise(header: str, unit_below: str | None = None) -> Recognised:
    """What a head means.

    >>> recognise("Kraftaufnehmer U10M [kN]")[:2]
    ('force', 'kN')
    >>> recognise("Solldruck [bar]").left_out.text
    'it is a set value'
    """
    head = taken_apart(header, unit_below)
    dimension = dimension_of(head.unit)
    base = without_pressure(head.name) if head.held is not None else head.name
    words = words_of(without_run(base)[0])
    if _VALUE.fullmatch(header.strip()):
        return _none(None, Reason.VALUE, "it names a value, not what was measured")
    if head.unit == COUNT:
        return _none(COUNT, Reason.COUNTS, "it holds counts of a converter, not a physical value")
    if dimension in RAW_DIMENSIONS:
        return _none(head.unit, Reason.RAW, f"'{head.unit}' is {dimension}, not a calibrated value")
    if (share := _SHARE.fullmatch(head.name)) is not None and dimension in ("", DIMENSIONS["contraction"][0]):
        longer = share["longer"] is not None
        return Recognised("contraction", head.unit, None, BY_WORDS, extends=longer)
    if _DESIRED.fullmatch(head.name) is not None and dimension in SET_QUANTITIES:
        return Recognised(None, head.unit, None, 0, by_word(Reason.SET_VALUE))
    meant = _without_statistic(words, dimension)
    named = [channel for word in meant if (channel := channel_of_word(word)) is not None]
    if "command" in named:
        named = [
            c for word in meant if word not in _ALSO_VOLTAGE and (c := channel_of_word(word)) is not None
        ]
    if dimension or len(set(named)) > 1:
        named = [channel for channel in named if channel != "direction"]
    for word in words:
        reason = other_quantity(word, named[-1] if named else None)
        if reason is Reason.AT_REST and set(named) & _STROKES_FROM_REST:
            named = [channel for channel in named if channel != "length"]
            continue
        if reason is Reason.SET_VALUE and named[-1:] == ["command"]:
            continue  # what a valve is set to is its command
        if reason is not None and (named or dimension):
            return Recognised(None, head.unit, None, 0, by_word(reason))
    distinct = set(named)
    if "command" in distinct and dimension in SET_QUANTITIES and has_word(words, COMMANDED):
        return Recognised(None, head.unit, None, 0, by_word(Reason.SET_VALUE))
    if len(distinct) > 1 and ("command" in distinct or not dimension):
        return _none(head.unit, Reason.SEVERAL, f"its name says {' and '.join(sorted(distinct))}")
    penalty = BY_WORDS + sum(LESS_WANTED.get(word, 0) for word in words)
    channel = _of_names(named, dimension) or channel_of_letter(words, dimension)
    if (change := _CHANGE_OF.match(base)) is not None and channel in (
        "diameter",
        "length",
        "displacement",
        None,
    ):
        channel = "extension" if change[1] in "Ll" else "displacement"
    if channel == "length" and set(words) & _CHANGES:
        channel = "extension"
    if channel is not None and (not dimension or dimension in DIMENSIONS[channel]):
        ambiguous = set(words) & {"last", "charge", "carga", "load"} and len(words) > 2
        if channel == "force" and not dimension and (ambiguous or set(words) & _ALSO_VOLTAGE):
            return _unknown(None)
        return Recognised(proper(channel), head.unit, head.absolute, penalty, extends=channel == "extension")
    if channel is not None and dimension:
        return _none(head.unit, Reason.UNFIT, f"its name says {channel}, '{head.unit}' is {dimension}")
    if not dimension or dimension == "a plain number or a share":
        no_channel = next((NO_CHANNEL[word] for word in words if word in NO_CHANNEL), None)
        if no_channel is None:
            return _unknown(head.unit)
        return Recognised(None, head.unit, None, 0, by_word(no_channel))
    by_unit = {"a force": "force", "a pressure": "pressure", "a time": "time"}.get(dimension)
    if by_unit is None:
        return _unknown(head.unit)
    return Recognised(by_unit, head.unit, head.absolute, penalty + BY_UNIT)


def _without_statistic(words: list[str], dimension: str) -> list[str]:
    """Words without the statistic behind them; "Last" is one where the unit is none of a load."""
    while len(words) > 1 and (words[-1] in STATISTICS or (words[-1] == "last" and _no_load(dimension))):
        words = words[:-1]
    return words


def _no_load(dimension: str) -> bool:
    return bool(dimension) and dimension not in DIMENSIONS["force"]


def is_raw(header: str) -> bool:
    """Whether a head says that its values are raw: counts, volts before calibration."""
    return any(LESS_WANTED.get(word, 0) >= _RAW for word in words_of(header))


def _of_names(named: list[str], dimension: str) -> str | None:
    """The one channel that the words name; of several the one that the unit fits, else the last."""
    if not named:
        return None
    fitting = [channel for channel in named if not dimension or dimension in DIMENSIONS[channel]]
    distinct = list(dict.fromkeys(fitting or named))
    return distinct[-1]
