"""The calibration that texts state for a column of a signal: a scale, a formula, a range, a sensitivity."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from itertools import pairwise

from mckibben.measurement.read.formulas import formulas_in
from mckibben.measurement.read.head_text import taken_apart
from mckibben.measurement.read.positions import is_position, length_scale, position_scale, pulley_scale
from mckibben.measurement.read.recognise import recognise
from mckibben.measurement.read.scales import Scale, scale_in
from mckibben.measurement.read.unit_words import (
    BRIDGE,
    COUNT,
    DIMENSIONS,
    FULL_SCALE,
    RAW_DIMENSIONS,
    dimension_of,
    unit_of,
)
from mckibben.measurement.read.vocabulary import (
    LETTERS,
    channel_of_word,
    folded,
    proper_channel,
    reference_among,
    word_set,
    words_of,
)
from mckibben.measurement.read.words import calibrations as words
from mckibben.physics.units import convert, factor

Texts = Sequence[tuple[str, str]]

_NUMBER = r"[+-]?[0-9]+(?:[.,][0-9]+)?"
_SPANNED = re.compile(
    rf"(?<![\w.,])(?:({_NUMBER})\s*(?:-|–|\.\.+|to|bis|…|à|a|~)\s*)?({_NUMBER})\s*"
    r"([^\W\d_]+[2²]?(?:/[^\W\d_]+[2²]?)?)(?![\w/])"
)
_BRIDGED = re.compile(rf"({_NUMBER})\s*(?:mV\s*/\s*V)")
_OF_HEAD = re.compile(rf"%\s*(?:of|von|de|di|van|av|FS)?\s*[=:]?\s*({_NUMBER})\s*([^\W\d_]+[2²]?)")
_RANGES, _ZEROS = word_set(words.RANGE), word_set(words.ZERO)
_BALANCED = word_set(words.BALANCED)
_ANY_SIGNAL = word_set(words.SIGNAL)
_SAME = 1e-6
_ALONG = {"length", "displacement", "contraction", "extension"}
_SCALED = ("pressure", "force", "length", "displacement", "extension")


def is_raw_share(name: str, unit: str | None) -> bool:
    """Whether a column in per cent can only be a share of a range: a pressure, a force or a length.

    >>> is_raw_share("Druck", "%"), is_raw_share("contraction", "%")
    (True, False)
    """
    if unit != "%":
        return False
    named = {proper_channel(channel) for word in words_of(name) if (channel := channel_of_word(word))}
    return len(named) == 1 and named <= {"pressure", "force", "length"}


def calibration_of(header: str, unit: str | None, heads: Sequence[tuple[str, str | None]], texts: Texts) -> (
    Scale | None
):  # fmt: skip
    """The one calibration that the texts state for a column; None = none, or several.

    Args:
        header, unit: of the column.
        heads: names and units of all columns.
        texts: of the file, and where they stand.
    """
    head = taken_apart(header, unit)
    raw = dimension_of(head.unit) if head.unit else ""
    share = head.unit == FULL_SCALE or is_raw_share(head.name, head.unit) or _is_stroke_share(head)
    if head.unit is not None and raw not in RAW_DIMENSIONS and not share:
        if raw == "an angle":
            return pulley_scale(head.unit, texts)
        return _of_position(head.name, head.unit, texts) if raw == "a length" else None
    found = [
        *_by_formula(header, head.name, head.unit, heads, texts),
        *(_by_scale(head.name, head.unit, heads, texts) if head.unit else ()),
    ]
    if not found and head.unit == BRIDGE:
        found = list(_by_sensitivity(head.name, texts))
    if not found and share:
        found = [*_of_head(header, head.name), *_by_range(head.name, texts)]
    return found[0] if found and all(_equal(found[0], other) for other in found) else None


def _of_position(name: str, unit: str, texts: Texts) -> Scale | None:
    """The formula by which a stroke follows from a position: ``muscle length = crosshead + 214.6 mm``."""
    if recognise(name, unit).channel == "length":
        return None
    found = [
        Scale(formula.factor, formula.offset, unit, unit, formula.name, f"'{formula.text}'", where)
        for text, where in texts
        for formula in formulas_in(text)
        if _plain(formula.symbol) == _plain(name)
        and _plain(formula.name) != _plain(name)
        and formula.unit == unit
        and recognise(formula.name, unit).channel in ("length", "displacement")
        and abs(formula.factor) == 1.0
    ]
    if not found:
        known = recognise(name, unit)
        if known.channel in (None, "displacement", "extension"):
            at_zero = length_scale(name, unit, texts)
            if at_zero is not None:
                return at_zero
        open_one = known.channel is None and not known.otherwise
        return position_scale(name, unit, texts) if open_one or is_position(name) else None
    return found[0] if all(_equal(found[0], other) for other in found) else None


def _is_stroke_share(head: object) -> bool:
    """Whether a column is a stroke in per cent: of L0, or of the range of its sensor where a text says it."""
    name, unit = getattr(head, "name", ""), getattr(head, "unit", None)
    return unit == "%" and recognise(name).channel == "displacement"


def _channel(name: str) -> str | None:
    known = recognise(name).channel
    if known is None:
        for word in words_of(name):
            known = known or channel_of_word(word) or LETTERS.get(word.rstrip("0123456789"))
    return known


def _fits(channel: str | None, unit: str) -> bool:
    """Whether a unit measures a channel; a stroke is a length here, as a share of itself says nothing."""
    if channel not in _SCALED and channel is not None:
        return dimension_of(unit) in DIMENSIONS.get(channel, ())
    wanted = (
        ("a length",)
        if channel in ("length", "displacement", "extension")
        else DIMENSIONS.get(channel or "", ())
    )
    return dimension_of(unit) in wanted


def _by_formula(
    header: str, name: str, unit: str | None, heads: Sequence[tuple[str, str | None]], texts: Texts
) -> Iterator[Scale]:
    """The formulas whose symbol is the column, or any signal where the result is what the column measures."""
    plain = _plain(name)
    others = {_plain(taken_apart(h, u).name) for h, u in heads} - {plain}
    for text, where in texts:
        for formula in formulas_in(text):
            symbol = _plain(formula.symbol)
            channel = _channel(formula.name)
            own = symbol in (plain, _plain(header)) or (symbol in words_of(name) and symbol not in others)
            meant = symbol in _ANY_SIGNAL and symbol not in others and channel is not None
            meant = meant and unit is not None and _proper(_channel(name)) == _proper(channel)
            if not (own or meant) or (unit is None and recognise(name).channel not in (None, channel)):
                continue
            if channel is None and _proper(_channel(name)) is None:
                continue
            head = formula.name if channel is not None else name
            said = _referenced(formula.unit, text)
            yield Scale(formula.factor, formula.offset, unit or COUNT, said, head, f"'{formula.text}'", where)


def _by_scale(name: str, unit: str, heads: Sequence[tuple[str, str | None]], texts: Texts) -> Iterator[Scale]:
    """The scales of texts that name no column, but a quantity that this one alone measures."""
    channel = _proper(_channel(name))
    if channel not in _SCALED:
        return
    rivals = [
        head.name
        for h, u in heads
        if (head := taken_apart(h, u)).unit is not None
        and dimension_of(head.unit) == dimension_of(unit)
        and _proper(_channel(head.name)) == channel
    ]
    if len(rivals) > 1:
        return
    for text, where in _with_clauses(texts):
        scale = scale_in(text, where)
        if scale is None or not scale.zeroed or dimension_of(scale.raw) != _raw_dimension(unit):
            continue
        if not _fits(channel, _bare(scale.unit)):
            continue
        named = {_proper(c) for word in words_of(text) if (c := channel_of_word(word)) in _SCALED}
        if named & _ALONG and channel in _ALONG:
            named |= {channel}  # "10 mm/V, positive = contraction" is of any reading of the stroke
        if named - {channel, None} and channel not in named:
            continue
        per = 1.0 if unit in (COUNT, "%", FULL_SCALE, BRIDGE) else float(convert([1.0], unit, scale.raw)[0])
        yield scale._replace(factor=scale.factor * per, name=name)


def _with_clauses(texts: Texts) -> Iterator[tuple[str, str]]:
    """Each text, and its clauses where it states several scales: ``p: 1 bar/V, x: 20 mm/V``."""
    for text, where in texts:
        clauses = re.split(r"[;|]|,(?=\s)", text)
        stated = [clause for clause in clauses if scale_in(clause, where) is not None]
        if len(stated) < 2:  # cells of one row: "pressure 0.5 bar/V force 400 N/V"
            begins = [m.start() for m in re.finditer(r"[^\W\d_]+", text) if channel_of_word(m[0]) in _SCALED]
            clauses = [text[a:b] for a, b in pairwise([*begins, len(text)])]
            stated = [clause for clause in clauses if scale_in(clause, where) is not None] or stated
        yield from ((clause, where) for clause in stated) if len(stated) > 1 else ((text, where),)


def _raw_dimension(unit: str) -> str:
    return dimension_of(FULL_SCALE if unit == "%" else unit)


def _by_sensitivity(name: str, texts: Texts) -> Iterator[Scale]:
    """mV/V by the output at the rated load, which may stand in two texts; a zero that is stated counts."""
    channel = _proper(_channel(name)) or "force"
    rated: set[float] = set()
    zero: set[float] = set()
    spans: dict[float, tuple[float, str, str, str]] = {}
    for text, where in texts:
        bridged = list(_BRIDGED.finditer(text))
        for found in bridged:
            before = re.split(r"[,;.(]\s", text[: found.start()])[-1]
            (zero if set(words_of(before)) & _ZEROS else rated).add(_float(found[1]))
        for low, high, unit in _ranges(_BRIDGED.sub(" ", text), needed=not bridged):
            if low == 0.0 and _fits(channel, unit):
                spans.setdefault(_si(high, unit), (high, unit, text[:80], where))
    rated -= {0.0}
    if len(rated) != 1 or len(spans) != 1 or len(zero) > 1:
        return
    ((high, unit, text, where),) = spans.values()
    slope = high / rated.pop()
    zeroed = bool(zero) or any(_is_balanced(text) for text, _ in texts)
    yield Scale(slope, -slope * next(iter(zero), 0.0), BRIDGE, unit, name, f"'{text}'", where, zeroed)


def says_zero_of_bridge(texts: Texts) -> bool:
    """Whether a text speaks of the reading of a load cell without load, or says that it was set to zero."""
    return any(_is_balanced(text) or set(words_of(text)) & _ZEROS for text, _ in texts)


def _is_balanced(text: str) -> bool:
    """Whether a text says that a force or a bridge was set to zero before the test."""
    said = words_of(text)
    return bool(set(said) & _BALANCED) and not {*map(channel_of_word, said)} & {"pressure", "displacement"}


def _by_range(name: str, texts: Texts) -> Iterator[Scale]:
    """Per cent of the range that a text states for what the column measures; it has to begin at 0."""
    channel = _proper(_channel(name))
    for text, where in texts:
        for low, high, unit in _ranges(text, needed=True):
            if low == 0.0 and high > 0.0 and _fits(channel, unit):
                said = _referenced(unit, text)
                yield Scale(high / 100.0, 0.0, FULL_SCALE, said, name, f"'{text[:80]}'", where)


def _ranges(text: str, *, needed: bool) -> Iterator[tuple[float, float, str]]:
    """(least, largest value, unit) of the ranges of a text; ``needed``: a word has to say that it is one."""
    if needed and not (
        set(words_of(text)) & _RANGES or any(phrase in folded(text) for phrase in words.PHRASES)
    ):
        return
    for found in _SPANNED.finditer(text):
        unit = unit_of(found[3])
        if unit is not None and dimension_of(unit.unit) in ("a force", "a mass", "a pressure", "a length"):
            weight = {"kg": "kgf", "g": "gf", "lb": "lbf"}.get(unit.unit, unit.unit)
            yield _float(found[1] or "0"), _float(found[2]), weight


def _of_head(header: str, name: str) -> Iterator[Scale]:
    """The range in the head itself: "F [% of 2 kN]"."""
    found = _OF_HEAD.search(header)
    unit = unit_of(found[2]) if found else None
    if found and unit and _fits(_proper(_channel(name)), unit.unit):
        yield Scale(_float(found[1]) / 100.0, 0.0, FULL_SCALE, unit.unit, name, f"'{found[0]}'", "its head")


def _referenced(unit: str, text: str) -> str:
    """A unit with what its pressure counts from, where a text says it."""
    if dimension_of(unit) != "a pressure":
        return unit
    reference = reference_among(words_of(text))
    return unit if reference is None else f"{unit}({'a' if reference else 'g'})"


def _proper(channel: str | None) -> str | None:
    return proper_channel(channel)


def _bare(unit: str) -> str:
    return unit.removesuffix("(a)").removesuffix("(g)")


def _plain(name: str) -> str:
    return re.sub(r"[\s_]+", "", folded(name))


def _equal(one: Scale, other: Scale) -> bool:
    if _bare(one.unit) != _bare(other.unit):
        if dimension_of(_bare(one.unit)) != dimension_of(_bare(other.unit)):
            return False
        times = factor(_bare(other.unit), _bare(one.unit))
        per = times.multiplier / times.divisor
        other = other._replace(factor=other.factor * per, offset=other.offset * per)
    near = abs(one.offset - other.offset) <= _SAME * (abs(one.offset) + abs(one.factor))
    return near and abs(one.factor - other.factor) <= _SAME * abs(one.factor)


def _si(value: float, unit: str) -> float:
    known = {"a force": "N", "a pressure": "Pa", "a length": "m"}.get(dimension_of(unit), unit)
    return round(float(convert([value], unit, known)[0]), 6)


def _float(text: str) -> float:
    return float(text.replace(",", "."))
