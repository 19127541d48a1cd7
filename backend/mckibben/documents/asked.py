"""A question typed in one line, read into the fields that it fills.

"How far does a DMSP-20 of 300 mm at 6 bar lift 20 kg, which pressure for 15 %" states a muscle, its length,
a pressure, a load and a contraction. What a quantity is follows from its unit; which of several lengths it is
from the word before it. Nothing is guessed: what is not read is named.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator
from dataclasses import dataclass, replace

from mckibben.facts.result import result_class
from mckibben.physics.errors import InputError
from mckibben.physics.units import GRAVITY, si
from mckibben.presets.order_code import order_code

_NUMBER = r"[+-]?(?:\d+(?:[.,]\d+)?|\.\d+)(?:[eE][+-]?\d{1,3})?"
_QUANTITY = re.compile(
    rf"(?P<numbers>{_NUMBER}(?:\s*[*×·]\s*{_NUMBER})*)\s*(?P<unit>%|(?:[A-Za-zµμ°]+(?:/[A-Za-z]+)?[²³23]?))?"
)
_WORD = re.compile(r"[^\W_][\w'’./-]*")
# Words that state nothing beyond what the quantities beside them do.
_FILLING = frozenset((
    "a", "an", "and", "at", "by", "can", "carry", "carries", "contract", "contraction", "contracts", "do",
    "does", "far", "festo", "find", "for", "force", "from", "give", "hang", "hanging", "hangs", "has",
    "high", "hold", "holds", "how", "i", "in", "is", "it", "its", "kept", "length", "lift", "lifted",
    "lifting", "lifts", "load", "long", "mass", "me", "move", "moves", "much", "muscle", "need", "needed",
    "needs", "of", "on", "or", "pressure", "pull", "pulls", "raise", "raises", "rest", "stiff", "room",
    "space", "stiffness", "stroke", "supply", "takes", "that", "the", "to", "travel", "under", "up",
    "vertical", "vertically", "weight", "what", "where", "which", "will", "with", "within",
))  # fmt: skip
_LARGEST = 1e30  # far beyond any design; its weight and its SI value are still numbers
_STROKE_BEFORE = re.compile(
    r"(?:\b(?:by|stroke|travel|lifts?|move|raise)(?:\s+(?:of|it))*)\s*$", re.IGNORECASE
)
_ROOM_BESIDE = re.compile(r"(?:\b(?:room|space)(?:\s+of)?)\s*$", re.IGNORECASE)
_ROOM_AFTER = re.compile(r"\s*(?:of\s+)?(?:room|space)\b", re.IGNORECASE)


@result_class
class AskedPart:
    """A part of the line that states something, or that was not read."""

    text: str
    """As it stands in the line."""
    start: int
    """Where it begins in the line, in characters."""
    meaning: str | None
    """What it was read as; None where it was not read."""
    problem: str | None
    """Why it was not read; None where it was."""


@result_class
class AskedLine:
    """What a line of text asks; None for what it does not state."""

    parts: tuple[AskedPart, ...]
    """What was read and what was not, in the order of the line."""
    muscle: str | None = None
    """Id of the muscle preset."""
    nominal_length: float | None = None
    """Rest length of the muscle [m]."""
    pressure: float | None = None
    """Gauge pressure [Pa]."""
    mass: float | None = None
    """Mass that is lifted [kg]."""
    load: float | None = None
    """Load [N]: as stated, or the weight of the mass."""
    contraction: float | None = None
    """Contraction whose pressure is asked for [-]."""
    stroke: float | None = None
    """Stroke that is asked for [m]."""
    time: float | None = None
    """Longest time for the stroke [s]."""
    room: float | None = None
    """Largest installed length [m]."""


@dataclass(frozen=True, slots=True)
class _Read:
    """What a part states: fields of the line, in words."""

    meaning: str
    stated: dict[str, float | str]


def read_asked(text: str, muscles: Collection[str]) -> AskedLine:
    """What a typed line asks.

    Args:
        text: the line.
        muscles: ids of the muscle presets.
    """
    line = AskedLine(())
    parts: list[AskedPart] = []
    for start, part, read in _parts(text, muscles):
        if read is None:
            continue
        try:
            found = read(line)
            again = [name for name in found.stated if getattr(line, name) is not None]
            if again:
                raise InputError(f"a second {found.meaning}")
        except InputError as error:
            parts.append(AskedPart(part, start, None, error.message))
        else:
            line = replace(line, **found.stated)  # type: ignore[arg-type]
            parts.append(AskedPart(part, start, found.meaning, None))
    return replace(line, parts=tuple(parts))


_Reader = Callable[[AskedLine], _Read]


def _parts(text: str, muscles: Collection[str]) -> Iterator[tuple[int, str, _Reader | None]]:
    """The parts of a line with how each is read; None for a word that states nothing."""
    names = "|".join(
        re.escape(name).replace("\\-", r"[-\s]?") for name in sorted(muscles, key=len, reverse=True)
    )
    muscle = re.compile(rf"(?:{names})(?P<code>(?:-[\w.]+)*)(?![\w-])", re.IGNORECASE) if names else None
    series = {name.partition("-")[0].upper() for name in muscles}
    at = 0
    while at < len(text):
        if not text[at].isalnum() and text[at] not in ".+-":
            at += 1
        elif muscle and (match := muscle.match(text, at)):
            yield at, match[0], _muscle_reader(match[0], match["code"], muscles)
            at = match.end()
        elif (match := _QUANTITY.match(text, at)) and match[0].strip():
            yield at, match[0].rstrip(), _quantity_reader(match, text)
            at = match.end()
        elif match := _WORD.match(text, at):
            word = match[0].rstrip(".")
            if word.partition("-")[0].upper() in series:
                yield at, word, _muscle_reader(word, "-", muscles)
            else:
                yield at, word, None if word.lower() in _FILLING else _unread("not read")
            at += len(word)
        else:
            at += 1


def _unread(why: str) -> _Reader:
    def read(_: AskedLine) -> _Read:
        raise InputError(why)

    return read


def _muscle_reader(text: str, code: str, muscles: Collection[str]) -> _Reader:
    """The muscle of a preset, "DMSP-20", or of an order code, "DMSP-20-300N-RM-CM"."""

    def read(_: AskedLine) -> _Read:
        if code:
            ordered = order_code(text, muscles)
            if ordered is None:
                raise InputError("no muscle of the catalogue")
            return _Read("muscle", {"muscle": ordered.preset, "nominal_length": ordered.length})
        plain = re.sub(r"[-\s]", "", text).upper()
        return _Read("muscle", {"muscle": next(x for x in muscles if x.replace("-", "").upper() == plain)})

    return read


def _quantity_reader(match: re.Match[str], text: str) -> _Reader:
    number = 1.0
    for factor in re.split(r"[*×·]", match["numbers"]):
        number *= float(factor.strip().replace(",", "."))
    unit = match["unit"]

    def read(line: AskedLine) -> _Read:
        if unit is None:
            raise InputError("a number without a unit")
        if abs(number) > _LARGEST:
            raise InputError("too large a number")
        if number < 0.0 and unit != "%":  # a contraction below zero is a stretch
            raise InputError("below zero")

        def value(of: str) -> float | None:
            try:
                return si(f"{number!r} {unit}", of, reference="gauge" if of == "Pa" else None)
            except InputError:
                return None

        if (length := value("m")) is not None:
            return _length(length, line, text[: match.start()], text[match.end() :])
        if (mass := value("kg")) is not None:
            return _Read("load", {"mass": mass, "load": mass * GRAVITY})
        for of, name, meaning in (
            ("Pa", "pressure", "pressure"),
            ("N", "load", "load"),
            ("s", "time", "time"),
            ("1", "contraction", "contraction"),
        ):
            if (found := value(of)) is not None:
                return _Read(meaning, {name: found})
        raise InputError(f"'{unit}' is no unit of a length, pressure, load, contraction or time")

    return read


def _length(length: float, line: AskedLine, before: str, after: str) -> _Read:
    """A length is that of the muscle, unless the word beside it says otherwise."""
    if _ROOM_BESIDE.search(before) or _ROOM_AFTER.match(after):
        return _Read("room", {"room": length})
    if _STROKE_BEFORE.search(before) or line.nominal_length is not None:
        return _Read("stroke", {"stroke": length})
    return _Read("length of the muscle", {"nominal_length": length})
