"""Scales of raw signals in texts and answers: ``0.5 bar/V``, ``0-10 V = 0-10 bar``, ``p = 1.25*U - 0.62 bar``."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from mckibben.measurement.reading.lexicon import rules
from mckibben.measurement.reading.units import number_of, unit_of

_NUMBER = r"[-+]?\d{1,9}(?:[.,]\d{1,9})?"
_ANSWER_RANGE = re.compile(
    rf"(?P<low>{_NUMBER})\s?(?P<rawfirst>[^\W\d_]{{1,7}}|%FS|%)?\s?(?:-|–|to|bis|\.{{2,3}}|…)\s?(?P<high>{_NUMBER})\s?(?P<raw>[^\W\d_]{{0,7}}(?:/V)?|%FS|%)"
    rf"\s?(?:=|->|→|≙)\s?(?P<from>{_NUMBER})\s?(?P<unitfirst>[^\W\d_]{{1,7}})?\s?(?:-|–|to|bis|\.{{2,3}}|…)\s?(?P<value>{_NUMBER})\s?(?P<unit>\S{{1,12}})"
)
_ANSWER_ONE = re.compile(rf"(?P<high>{_NUMBER})\s?(?P<raw>[^\W\d_]{{1,7}}(?:/V)?|%FS|%)\s?(?:=|->|→|≙)\s?(?P<value>{_NUMBER})\s?(?P<unit>\S{{1,12}})")
_ANSWER_PER = re.compile(rf"(?P<value>{_NUMBER})\s?(?P<unit>[^\s/\d]{{1,8}})\s?/\s?(?P<raw>[^\W\d_]{{1,7}}(?:/V)?)")


class Scale(NamedTuple):
    """value [unit] = factor * (reading - offset); ``raw``: unit of the reading, empty = not said."""

    factor: float
    offset: float
    unit: str
    raw: str = ""
    rule: str = ""
    weight: float = 6.0
    text: str = ""
    absolute: bool | None = None


def scales_in(text: str) -> Iterator[tuple[Scale, str]]:
    """(scale, words around it) of every calibration in a text."""
    if not any(character.isdigit() for character in text):
        return
    taken: list[tuple[int, int]] = []
    for rule in sorted((r for r in rules("text") if "scale" in r.claims), key=lambda r: -r.weight):
        assert rule.pattern is not None
        for match in rule.pattern.finditer(text):
            if any(match.start() < end and begin < match.end() for begin, end in taken):
                continue
            scale = _of_match(match, rule.id, rule.weight)
            if scale is not None:
                taken.append(match.span())
                before = re.split(r"[;,](?!\d)", text[: match.start()])[-1]
                yield scale, f"{before} {match[0]}"


def answered_scale(text: str) -> Scale | None:
    """The scale that a user says: ``0-10 V = 0-10 bar``, ``1 V = 2 bar``, ``0.5 bar/V``; None = it is none."""
    bare = text.strip()
    for pattern in (_ANSWER_RANGE, _ANSWER_ONE, _ANSWER_PER):
        match = pattern.fullmatch(bare)
        if match is not None and (scale := _of_match(match, "you", 20.0)) is not None:
            return scale
    return None


def _of_match(match: re.Match[str], rule: str, weight: float) -> Scale | None:
    groups = match.groupdict()
    unit = unit_of(groups.get("unit") or groups.get("unitlast") or "")
    if unit is None or not unit.dimension:
        return None
    value = number_of(groups["value"])
    raw = unit_of(groups.get("raw") or "")
    raw_name = "" if raw is None else raw.name
    if groups.get("high"):
        low, high = number_of(groups.get("low") or "0"), number_of(groups["high"])
        begin = number_of(groups.get("from") or "0")
        if high == low or value == begin:
            return None
        factor = (value - begin) / (high - low)
        return Scale(factor, low - begin / factor, unit.name, raw_name, rule, weight, match[0], unit.absolute)
    if value == 0.0:
        return None
    shift = groups.get("offset")
    offset = 0.0 if not shift else -number_of(shift.replace(" ", "")) / value
    return Scale(value, offset, unit.name, raw_name or (groups.get("raw") or ""), rule, weight, match[0], unit.absolute)
