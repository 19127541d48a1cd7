"""What the texts around a table say of the test: rest length, load, supply, muscle, sample, date, signs."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from functools import cache
from pathlib import PurePath
from typing import NamedTuple

from mckibben.measurement.read.conditions import CONDITION_UNITS, TEXT_CONDITIONS, Note, key_of
from mckibben.measurement.read.recognise import taken_apart
from mckibben.measurement.read.unit_words import REFERENCE_WORDS, dimension_of, unit_of
from mckibben.measurement.read.vocabulary import LOADLESS, channel_of_word, folded, word_set, words_of
from mckibben.resources import presets_folder

NAME = "the file's name"
#: Conditions that only these texts say, besides those with a unit.
SIGN = "force_sign"  # text: "compression positive"
KIND_SAID = "kind_said"  # text: "isotonic"
_NUMBER = r"[+-]?[0-9]+(?:[.,][0-9]+)?"
_QUANTITY = re.compile(rf"(?<![\w.,-])({_NUMBER})\s*([A-Za-zµ°%\"]+(?:\s*\([a-zü]+\))?)?(?![\w.,]*\d)")
_UNIT_FIRST = re.compile(rf"[\[(]\s*([^\])]+?)\s*[\])]\s*[:=;]?\s*({_NUMBER})(?!\s*[A-Za-z])")
_AT_REST = word_set(
    "l0 rest unloaded relaxed free initial nominal gauge start ruhe anfang anfangs nenn einspann ausgangs "
    "vide repos initiale libre riposo iniziale libera reposo inicial spoczynkowa poczatkowa repouso "
    "sample specimen"
)
_REST_LENGTHS = re.compile(
    r"(ruhe|einspann|anfangs|nenn|ausgangs|probe[nr]?)[a-z]{0,2}(lange|laenge)|自然長|初期長"
)
_LOADS = word_set("load last mass masse weight gewicht charge carico carga massa peso poids masa")
_SUPPLIES = word_set(
    "supply versorgung versorgungsdruck speisedruck vordruck netzdruck alimentation alimentazione "
    "alimentacion"
)
_SAMPLES = word_set(
    "specimen sample probe prufling eprouvette provino probeta muestra muster dut campione probka amostra"
)
_DATES = word_set("date datum fecha data giorno")
#: Kind of a test -> how its name begins in the languages of the heads.
_KINDS = {"isobaric": "isobar", "isometric": "isometr", "isotonic": "isoton"}
_UNPARTED = 0x3000  # code of the first letters of languages without blanks
_COMPRESSION = re.compile(
    r"(compress\w*|druckkraft)\W+(?:\w+\W+){0,2}positi|(tension|traction|pull\w*|zug\w*|trazione)\W+(?:\w+\W+){0,3}negati"
)
_CODE = re.compile(r"(?<![A-Za-z0-9])([A-Z]{2,6}-[0-9]{1,3})(?:-([0-9]{2,4})(?![0-9]))?")


class _Quantity(NamedTuple):
    """A number with its unit in a text, and the words before it."""

    words: list[str]
    value: str
    unit: str | None


def statements(rest: Iterable[tuple[str, str]], name: str) -> list[Note]:
    """The conditions that free texts state, the first word for each; the file's name comes last.

    Args:
        rest: texts that belong to no table, and where they stand.
        name: of the file.
    """
    found: dict[str, Note] = {}
    coded: list[tuple[str, str]] = []
    for text, where in rest:
        for key, value in _of_text(text):
            found.setdefault(key, Note(where, key, value))
        coded.append((text, where))
    stem = PurePath(name).stem
    coded.append((stem, NAME))
    for text, where in coded:
        for key, value in _of_code(text):
            found.setdefault(key, Note(where, key, value))
    for quantity in _quantities(stem.replace("_", " ")):
        if (
            quantity.unit is not None
            and dimension_of(quantity.unit) == "a mass"
            and "load_force" not in found
        ):
            found.setdefault("load_mass", Note(NAME, "load_mass", f"{quantity.value} {quantity.unit}"))
    if "load_mass" in found and "load_force" in found and found["load_mass"].where == NAME:
        del found["load_mass"]
    return list(found.values())


def _of_text(text: str) -> Iterator[tuple[str, str]]:
    plain = folded(text)
    if _COMPRESSION.search(plain):
        yield SIGN, "compression positive"
    words = words_of(text)
    references = {REFERENCE_WORDS[w] for w in folded_words(text) if len(w) > 2 and w in REFERENCE_WORDS}
    if len(references) == 1 and any(channel_of_word(word) == "pressure" for word in words):
        yield "pressure", "absolute" if references.pop() else "gauge"
    kinds = {kind for word in words for kind, stem in _KINDS.items() if word.startswith(stem)}
    if len(kinds) == 1:
        yield KIND_SAID, kinds.pop()
    for quantity in _quantities(text):
        key = _key_of(quantity)
        if key is not None:
            yield key, f"{quantity.value} {quantity.unit}" if quantity.unit else quantity.value
    if words and words[0] in _SAMPLES:
        value = re.sub(r"^\s*[^\s:;=,]+\s*(?:label|name|nr\.?|no\.?|id)?\s*[:;=,]?\s*", "", text).strip()
        if value and not re.match(r"(?i)rate|freq|interval|s\b|time|period|=|\d+\s*(Hz|ms|s)\b", value):
            yield "sample", value
    if words and words[0] in _DATES and (day := re.search(r"[0-9]{1,4}[./-][0-9]{1,2}[./-][0-9]{1,4}", text)):
        yield "date", day[0]


def folded_words(text: str) -> list[str]:
    """The words of a text in lower case, with their accents and without; Japanese does not part its words."""
    lower = re.findall(r"[^\W_]+", text.lower())
    unparted = [word for word in REFERENCE_WORDS if ord(word[0]) > _UNPARTED and word in text]
    return [*lower, *(folded(word) for word in lower), *unparted]


def _quantities(text: str) -> Iterator[_Quantity]:
    """The quantities of a text; each with the words since the one before it."""
    text = _UNIT_FIRST.sub(r" \2 \1", text)
    begin = 0
    for found in _QUANTITY.finditer(text):
        unit = unit_of(found[2]) if found[2] else None
        before = re.split(r"[,;](?!\d)\s*(?=[^\W\d])", text[begin : found.start()])[-1]
        begin = found.end()
        yield _Quantity(words_of(before), found[1].replace(",", "."), None if unit is None else unit.unit)


def _key_of(quantity: _Quantity) -> str | None:
    words = set(quantity.words)
    joined = "".join(quantity.words)
    measured = dimension_of(quantity.unit) if quantity.unit else ""
    if words & LOADLESS:
        return None
    lengthy = any(channel_of_word(word) == "length" for word in quantity.words)
    at_rest = (bool(words & _AT_REST) and (lengthy or "l0" in words)) or bool(_REST_LENGTHS.search(joined))
    if at_rest and measured in ("", "a length"):
        return "nominal_length"
    loaded = words & _LOADS or any(
        channel_of_word(w) == "force" and w.endswith("last") for w in quantity.words
    )
    if loaded and measured == "a mass":
        return "load_mass"
    if loaded and measured == "a force":
        return "load_force"
    if words & _SUPPLIES and measured == "a pressure":
        return "supply_pressure"
    return None


def _of_code(text: str) -> Iterator[tuple[str, str]]:
    """Muscle and length in an order code: ``DMSP-20-250N`` is 250 mm of a DMSP-20."""
    for found in _CODE.finditer(text.replace("_", " ")):
        if found[1].upper() in _known_muscles():
            yield "muscle", found[1]
            if found[2]:
                yield "nominal_length", f"{found[2]} mm"


@cache
def _known_muscles() -> frozenset[str]:
    """Ids of the muscles that come with the program."""
    return frozenset(path.stem.upper() for path in (presets_folder() / "muscles").glob("*.json"))


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
            unit = head.unit or (quantity.unit if quantity else None)
            known = (
                _key_of(_Quantity(words, "", unit)) if quantity or not isinstance(note.value, str) else None
            )
            if known is None and words and words[0] in _SAMPLES and isinstance(note.value, str):
                renamed += [note._replace(key="sample"), *_notes_of_code(note)]
                continue
            if known is None:
                renamed.append(note)
                continue
            value = quantity.value if quantity and isinstance(note.value, str) else note.value
            note, key = Note(note.where, known, f"{value} {unit}" if unit else value), known
            unit = None
        if key == "nominal_length" and unit is None:
            note = _in_millimetres(note)
        renamed.append(note)
    return renamed


def _notes_of_code(note: Note) -> list[Note]:
    return [Note(note.where, key, value) for key, value in _of_code(str(note.value))]


def _in_millimetres(note: Note) -> Note:
    try:
        number = float(str(note.value).replace(",", "."))
    except ValueError:
        return note
    return note._replace(value=f"{number:.10g} mm") if number >= _LONGEST_METRES else note


_LONGEST_METRES = 10.0  # no muscle is longer; a larger number without unit counts millimetres


def texts_around(rows: Iterable[tuple[Sequence[str], str]]) -> list[tuple[str, str]]:
    """Rows of texts as one text each, with their place: ``("Ruhelänge 250 mm", "line 4")``."""
    joined = ((" ".join(cell for cell in cells if cell).strip(), where) for cells, where in rows)
    return [(text, where) for text, where in joined if text]
