"""What the texts around a table say of the test: rest length, load, supply, muscle, sample, date, signs."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import islice
from pathlib import PurePath
from typing import NamedTuple

from mckibben.measurement.read.air import AIR, unit_of_air
from mckibben.measurement.read.conditions import CONDITION_UNITS, TEXT_CONDITIONS, Note, key_of
from mckibben.measurement.read.head_text import channel_number, taken_apart
from mckibben.measurement.read.left_out import Reason
from mckibben.measurement.read.limits import MAX_REMARKS
from mckibben.measurement.read.order_codes import notes_of_code, of_code
from mckibben.measurement.read.signs import signs_of
from mckibben.measurement.read.tares import reads_empty
from mckibben.measurement.read.unit_words import dimension_of, unit_of
from mckibben.measurement.read.vocabulary import (
    LOADLESS,
    REMARK_WORDS,
    channel_of_word,
    has_word,
    other_quantity,
    reference_among,
    word_set,
    words_of,
)
from mckibben.measurement.read.words.positions import POSITION
from mckibben.physics.units import convert

NAME = "the file's name"
#: Conditions that only these texts say, besides those with a unit.
REFERENCE_OF = "reference_of_"  # and the number of a channel: "absolute" or "gauge"
KIND_SAID = "kind_said"  # text: "isotonic"
_NUMBER = r"[+-]?[0-9]+(?:[.,][0-9]+)?(?:[eE][+-]?[0-9]{1,3}(?![^\W_]))?"
#: "mm of mercury" is no length.
_MERCURY = re.compile(
    r"(?i)мм\s*рт\.?\s*ст\.?|mm\s+hg\b|mm\s*(?:of\s+|de\s+|di\s+)?(?:mercur\w*|quecksilber\w*|qs\b)"
)
_UNIT = r"(?:[^\W\d_]|[°%\"'])+(?:/[^\W\d_]+[2²]?)?"
_QUANTITY = re.compile(rf"(?<![\w.,-])({_NUMBER})\s*({_UNIT}(?:\s*\([a-zü]+\))?)?(?![\w.,]*\d)")
_UNIT_FIRST = re.compile(rf"[\[(]\s*([^\])]+?)\s*[\])]\s*[:=;]?\s*({_NUMBER})(?![\d.,]*\d|\s*[A-Za-z])")
#: A symbol, a number and a unit in one word, as in names of files: ``L200mm``, ``m5kg``, ``ps6bar``.
_GLUED = re.compile(
    rf"(?<![^\W_])([^\W\d_]{{0,12}}0?)[=]?((?<![0-9])[0-9]+(?:[.,][0-9]+)?)({_UNIT})(?![^\W_])"
)
_UNIT_IN_NAME = re.compile(
    rf"(?P<name>[^\W\d_]\w*)_(?P<unit>[^\W\d_]+)\s*[:=]\s*(?P<number>{_NUMBER})(?!\s*[^\W\d_]|[\d.,]\d)"
)
#: "L_0", "L 0 =", "Lo =" are L0; "at 0 bar" is without pressure.
_L_ZERO = re.compile(r"(?<![^\W_])[Ll](?:_\{?0\}?|_?o(?=\s*[=:≈])|[ ]0(?=\s*[=:≈]))")
_NO_PRESSURE = re.compile(
    r"(?<![\w.,])(?:p\s*=\s*)?0(?:[.,]0+)?\s*(?:mbar|bar|hPa|kPa|MPa|Pa|psig?)(?:\s*\(g\))?(?!\w)"
)
_OTHER_GAUGES = re.compile(
    r"(?i)(?:strain|dial|length|load|force|displacement|feeler)[ -]*gau?ges?|gau?ge length"
)
_AT_PRESSURE = re.compile(
    r"(?i)[\s(,]*(?:at|bei|@|à|a|con|mit|with|при|przy|při|pri|vid|bij|med)?\s*"
    r"[0-9.,]*[1-9][0-9.,]*\s*(?:mbar|bar|[hkM]?Pa|psi)(?!\w)"
)
#: Words behind a quantity that no other one follows, up to a sign or an "and".
_OWN_BEHIND = re.compile(
    r"[\s(]*([^,;:=()\d.]{0,60}?)(?=[,;().]|$|\s(?:and|with|und|mit|et|avec|con|com|og|och)\s)"
)
_CLAUSE = re.compile(r"[;|]|[.,:](?!\d)\s")
_BEFORE = frozenset(("mm", "cm", "kg", "bar", "mbar", "kPa", "MPa", "hPa", "psi", "kN", "lbf", "inch"))
_VALUED = re.compile(rf"(?P<name>[^\W\d_]+)\s*(?:[=:]|is|was|ist|war)?\s*{_NUMBER}\s*(?:{_UNIT})")
_OF_OTHER_AIR = (Reason.SUPPLY, Reason.AIR)
_POSITIONS = word_set(POSITION)
_WITHOUT = REMARK_WORDS["without"]
_LONG = word_set("long lang lungo largo comprido dlugi длинный uzun")
_AT_REST, _LOADS, _SUPPLIES = REMARK_WORDS["at rest"], REMARK_WORDS["load"], REMARK_WORDS["supply"]
_BAROMETERS = REMARK_WORDS["barometer"]
_WHOLE, _BETWEEN, _ENDS = (REMARK_WORDS[what] for what in ("whole length", "between", "ends"))
_OTHER_LENGTHS = REMARK_WORDS["other length"]
_SAMPLES, _DATES, _AMBIENT = REMARK_WORDS["sample"], REMARK_WORDS["date"], REMARK_WORDS["ambient"]
_REST_LENGTHS = re.compile(
    "|".join([r"(ruhe|einspann|anfangs|nenn|ausgangs|probe[nr]?)[a-z]{0,2}(lange|laenge)",
              *map(re.escape, REMARK_WORDS["rest length"])])
)  # fmt: skip
_SUPPLY_SYMBOLS = word_set("ps pv psup psupply pversorgung p0 pin")
#: Kind of a test -> how its name begins in the languages of the heads.
_KINDS = {"isobaric": "isobar", "isometric": "isometr", "isotonic": "isoton"}


class _Quantity(NamedTuple):
    """A number with its unit in a text, the words before it and, up to the next comma, behind it."""

    words: list[str]
    value: str
    unit: str | None
    behind: Sequence[str] = ()
    own_behind: Sequence[str] = ()  # those that no other quantity follows
    pressed: bool = False  # a pressure is said at which it has this value


def statements(rest: Iterable[tuple[str, str]], name: str) -> list[Note]:
    """The conditions that free texts state, the first word for each; the file's name comes last.

    Args:
        rest: texts that belong to no table, and where they stand; the first `MAX_REMARKS` are searched.
        name: of the file.
    """
    found: dict[str, Note] = {}
    coded: list[tuple[str, str]] = []
    for text, where in islice(rest, MAX_REMARKS):
        for key, value in _of_text(text):
            note = Note(where, key, value)
            found.setdefault(key, _in_millimetres(note) if key == "nominal_length" else note)
        coded.append((text, where))
    stem = PurePath(name).stem
    coded.append((stem, NAME))
    for text, where in coded:
        for key, value in of_code(text):
            found.setdefault(key, Note(where, key, value))
    for quantity in (*_quantities(stem.replace("_", " ")), *_glued(stem)):
        key = _key_of(quantity)
        if (
            key is None
            and quantity.words in (["l"], ["length"])
            and dimension_of(quantity.unit) == "a length"
        ):
            key = "nominal_length"
        if key is None and quantity.unit is not None and dimension_of(quantity.unit) == "a mass":
            key = None if "load_force" in found else "load_mass"
        if key is not None:
            found.setdefault(key, Note(NAME, key, f"{quantity.value} {quantity.unit or ''}".strip()))
    if "load_mass" in found and "load_force" in found and found["load_mass"].where == NAME:
        del found["load_mass"]
    return list(found.values())


def values_stated(rest: Iterable[tuple[str, str]]) -> Iterator[tuple[str, str, str]]:
    """(condition, value, place) of everything that texts state, not only the first of each condition."""
    for text, where in rest:
        for key, value in _of_text(text):
            note = Note(where, key, value)
            yield key, str((_in_millimetres(note) if key == "nominal_length" else note).value), where


def _of_text(text: str) -> Iterator[tuple[str, str]]:
    yield from signs_of(text)
    words = words_of(text)
    for channel, absolute in _references_of_text(text).items():
        key = f"{REFERENCE_OF}{channel}" if channel else "pressure"
        yield key, "absolute" if absolute else "gauge"
    kinds = {kind for word in words for kind, stem in _KINDS.items() if word.startswith(stem)}
    if len(kinds) == 1:
        yield KIND_SAID, kinds.pop()
    for quantity in (*_quantities(text), *_glued(text)):
        key = _key_of(quantity)
        if key in ("load_mass", "load_force") and reads_empty(text):
            continue  # "reads 0.85 kg with nothing attached"
        if key is not None:
            unit = quantity.unit or (unit_of_air(quantity.value) if key == AIR else None)
            yield key, f"{quantity.value} {unit}" if unit else quantity.value
    if words and words[0] in _SAMPLES:
        value = re.sub(r"^\s*[^\s:;=,]+\s*(?:label|name|nr\.?|no\.?|id)?\s*[:;=,]?\s*", "", text).strip()
        if value and not re.match(
            r"(?i)rate|freq|interval|attenuation|s\b|time|period|=|\d+\s*(Hz|ms|s)\b", value
        ):
            yield "sample", value
    if words and words[0] in _DATES and (day := re.search(r"[0-9]{1,4}[./-][0-9]{1,2}[./-][0-9]{1,4}", text)):
        yield "date", day[0]


def _references_of_text(text: str) -> dict[str, bool]:
    """What a text says the pressure of the muscle counts from: True = vacuum, by the number of the channel.

    "" is what it says of no channel in particular. Clauses about the supply or the air outside say nothing of
    the muscle; what clauses contradict is left out.
    """
    said: dict[str, set[bool]] = {}
    for clause in _CLAUSE.split(
        _OTHER_GAUGES.sub(" ", _VALUED.sub(_without_air, _MERCURY.sub("mmHg", text)))
    ):
        words = words_of(clause)
        if has_word(words, _AMBIENT | _SUPPLIES) or any(
            other_quantity(word, "pressure") in _OF_OTHER_AIR for word in words
        ):
            continue
        reference = reference_among(words)
        if reference is not None and any(channel_of_word(word) == "pressure" for word in words):
            said.setdefault(channel_number(clause), set()).add(reference)
    return {channel: marks.pop() for channel, marks in said.items() if len(marks) == 1}


def _without_air(found: re.Match[str]) -> str:
    """Nothing in the place of the pressure of the air outside with its value; other values stay."""
    return ";" if has_word(words_of(found["name"]), _AMBIENT) else found[0]


def _quantities(text: str) -> Iterator[_Quantity]:
    """The quantities of a text; each with the words since the one before it, and those up to the next one."""
    text = _UNIT_IN_NAME.sub(_unit_behind, _MERCURY.sub("mmHg", text))
    text = _NO_PRESSURE.sub(" unpressurized ", _L_ZERO.sub("L0", _UNIT_FIRST.sub(_unit_after, text)))
    begin = 0
    for found in _QUANTITY.finditer(text):
        unit = (unit_of(found[2]) or unit_of(found[2].partition("(")[0])) if found[2] else None
        before = re.split(r"[,;](?!\d)\s*(?=[^\W\d])(?![^()]*\))", text[begin : found.start()])[-1]
        begin = found.end()
        behind = re.split(r"[,;.:(]", text[begin : begin + 40])[0]
        own = _OWN_BEHIND.match(text, begin)
        value = found[1].replace(",", ".")
        if unit is None and (last := re.search(r"([^\s:=]{2,5})[\s:=]*$", before)) is not None:
            unit = unit_of(last[1]) if last[1] in _BEFORE else None  # a cell of its own: "L0 | cm | 18.5"
        yield _Quantity(
            words_of(before), value, None if unit is None else unit.unit, words_of(behind),
            words_of(own[1]) if own else (), _AT_PRESSURE.match(text, found.end()) is not None,
        )  # fmt: skip


def _unit_after(found: re.Match[str]) -> str:
    """``[mm] 250`` as ``250 mm``; brackets around other words stay."""
    return f" {found[2]} {found[1]}" if unit_of(found[1]) is not None else found[0]


def _unit_behind(found: re.Match[str]) -> str:
    """``L0_mm: 250`` as ``L0: 250 mm``, where the end of the name is a unit."""
    unit = unit_of(found["unit"])
    known = unit is not None and dimension_of(unit.unit) not in ("", "a plain number or a share")
    return f"{found['name']}: {found['number']} {found['unit']}" if known else found[0]


def _glued(text: str) -> Iterator[_Quantity]:
    """The quantities whose symbol, number and unit are one word."""
    for found in _GLUED.finditer(text):
        unit = unit_of(found[3])
        if unit is not None and found[1]:
            yield _Quantity(words_of(found[1]), found[2].replace(",", "."), unit.unit)


def lengths_named(stem: str) -> Iterator[tuple[float, str, list[str]]]:
    """(length [m], as written, words before it) of the lengths of a name that are no rest length."""
    for quantity in (*_quantities(stem.replace("_", " ")), *_glued(stem)):
        if quantity.unit and dimension_of(quantity.unit) == "a length" and _key_of(quantity) is None:
            metres = float(convert([float(quantity.value)], quantity.unit, "m")[0])
            yield metres, f"{quantity.value} {quantity.unit}", quantity.words


def _key_of(quantity: _Quantity) -> str | None:
    words = set(quantity.words)
    joined = "".join(quantity.words)
    measured = dimension_of(quantity.unit) if quantity.unit else ""
    if measured == "a pressure" and has_word(quantity.words, _AMBIENT):
        return AIR
    if quantity.unit is None and unit_of_air(quantity.value) and has_word(quantity.words, _BAROMETERS):
        return AIR  # "barometer 1013"
    if words & LOADLESS:
        return None
    if measured == "a length" and not quantity.pressed and _is_whole(quantity):
        return "nominal_length"
    if measured == "a length" and has_word(quantity.words[-3:], _POSITIONS):
        return None  # "the laser reads 152 mm at the rest length"
    lengthy = any(channel_of_word(word) == "length" for word in quantity.words)
    at_rest = _is_at_rest(quantity.words) and (lengthy or "l0" in words)
    if (at_rest or _REST_LENGTHS.search(joined)) and measured in ("", "a length"):
        return "nominal_length"
    if measured == "a length" and _is_length_at_rest(quantity.own_behind, lengthy=lengthy):
        return "nominal_length"
    loaded = has_word([*quantity.words, *quantity.behind], _LOADS) or any(
        channel_of_word(w) == "force" and w.endswith("last") for w in quantity.words
    )
    if (loaded or words == {"m"}) and measured == "a mass":
        return "load_mass"
    if loaded and measured == "a force":
        return "load_force"
    if (has_word(quantity.words, _SUPPLIES) or joined in _SUPPLY_SYMBOLS) and measured == "a pressure":
        return "supply_pressure"
    return None


def _is_at_rest(words: Sequence[str]) -> bool:
    """Whether words say "at rest", also as "without pressure"."""
    if has_word(list(words), _AT_REST):
        return True
    return any(
        word in _WITHOUT and any(channel_of_word(other) == "pressure" for other in words[i + 1 : i + 3])
        for i, word in enumerate(words)
    )


def _is_length_at_rest(behind: Sequence[str], *, lengthy: bool) -> bool:
    """Whether the words behind a length say so: "250 mm rest length", "is 250 mm long when unpressurised"."""
    if any(other_quantity(word, "length") not in (None, Reason.AT_REST) for word in behind):
        return False
    named = any(word in _LONG or channel_of_word(word) == "length" for word in behind)
    return bool((_is_at_rest(behind) and (lengthy or named)) or _REST_LENGTHS.search("".join(behind)))


def _is_whole(quantity: _Quantity) -> bool:
    """Whether words say that a length is all of the muscle's: "active length", "400 mm between fittings"."""
    before, words = quantity.words, [*quantity.words, *quantity.own_behind]
    if has_word(words, _OTHER_LENGTHS | _LOADS):
        return False
    ends = sum(has_word([word], _ENDS) for word in words)
    if ends > 1 or (ends and has_word(words, _BETWEEN)):  # "from clamp to clamp"
        return True
    lengthy = any(word == "l" or channel_of_word(word) == "length" for word in before)
    return lengthy and has_word(before, _WHOLE)


def in_known_words(notes: Iterable[Note]) -> list[Note]:
    """Conditions under the names of this program: ``L0_mm`` and ``Ruhelänge [mm]`` are ``nominal_length``.

    A rest length without unit that can only be millimetres is read as such.
    """
    renamed = []
    for note in notes:
        key, unit = key_of(note.key)
        if key not in CONDITION_UNITS and key not in TEXT_CONDITIONS:
            head = taken_apart(note.key)
            quantity = next(iter(_quantities(f"{head.name.replace('_', ' ')}: {note.value}")), None)
            words = words_of(head.name)
            reference = reference_among([*words_of(str(note.value)), *words])
            if reference is not None and any(channel_of_word(word) == "pressure" for word in words):
                renamed.append(note._replace(key="pressure", value="absolute" if reference else "gauge"))
                continue
            unit = head.unit or (quantity.unit if quantity else None) or _unit_at_the_end(note.key)
            known = (
                _key_of(_Quantity(words, str(note.value), unit))
                if quantity or not isinstance(note.value, str)
                else None
            )
            if known is None and words and words[0] in _SAMPLES and isinstance(note.value, str):
                renamed += [note._replace(key="sample"), *notes_of_code(note)]
                continue
            if known is None:
                renamed.append(note)
                continue
            value = quantity.value if quantity and isinstance(note.value, str) else note.value
            note, key = Note(note.where, known, f"{value} {unit}" if unit else value), known
            unit = None
        if key == "nominal_length" and unit is None:
            note = _in_millimetres(note)
        if key == AIR and unit is None and (shown := unit_of_air(note.value)) is not None:
            note = note._replace(
                value=f"{note.value} {shown}", where=f"{note.where}, no unit: read as {shown}"
            )
        renamed.append(note)
    return renamed


def _unit_at_the_end(key: str) -> str | None:
    """The unit of a pressure, a length or a load behind the last mark of a name: ``barometer_Pa``."""
    name, _, last = key.strip().rpartition("_")
    unit = unit_of(last) if name else None
    return unit.unit if unit and dimension_of(unit.unit) == "a pressure" else None


def _in_millimetres(note: Note) -> Note:
    try:
        number = float(str(note.value).replace(",", "."))
    except ValueError:
        return note
    if number < _LONGEST_METRES:
        return note
    return note._replace(value=f"{number:.10g} mm", where=f"{note.where}, no unit: read as mm".lstrip(", "))


_LONGEST_METRES = 10.0  # no muscle is longer; a larger number without unit counts millimetres
