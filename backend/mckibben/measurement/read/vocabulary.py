"""What the words of heads and remarks mean: the table of `words`, and how words are compared with it."""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Mapping, Sequence
from functools import lru_cache
from typing import NamedTuple

from mckibben.measurement.read import words
from mckibben.measurement.read.left_out import Reason

_UNPARTED = "\u3000"  # from here on stand the letters of languages that do not part their words
_LETTERS = str.maketrans({"ł": "l", "ı": "i", "đ": "d", "ø": "o", "æ": "ae", "œ": "oe"})


def folded(text: str) -> str:
    """Lower case without accents; ``ß`` as ``ss``.

    >>> folded("Prüfzeit")
    'prufzeit'
    """
    plain = unicodedata.normalize("NFKD", text.casefold().translate(_LETTERS))
    bare = "".join(character for character in plain if not unicodedata.combining(character))
    return bare if bare.isascii() else unicodedata.normalize("NFC", bare)


def word_set(text: str) -> frozenset[str]:
    """The words of a text, parted by blanks."""
    return frozenset(text.split())


def all_words(by_language: Mapping[str, str]) -> tuple[str, ...]:
    """The words of all languages, folded, without the marks of their parts."""
    return tuple(
        dict.fromkeys(folded(w.strip("*") or w) for text in by_language.values() for w in text.split())
    )


def _marked(by_language: Mapping[str, str]) -> frozenset[str]:
    """The words that count as the beginning or end of others although they are short."""
    return frozenset(
        folded(w.strip("*")) for t in by_language.values() for w in t.split() if "*" in w and w != "*"
    )


def is_unparted(word: str) -> bool:
    """Whether a word is of a language that writes its words without blanks."""
    return bool(word) and word[0] >= _UNPARTED


def has_word(text_words: list[str], known: frozenset[str]) -> bool:
    """Whether one of the words is known; long ones also as beginnings, unparted ones wherever they stand."""
    patterns = _patterns(known)
    return any(word in known or _matches(word, patterns) for word in text_words)


class _Patterns(NamedTuple):
    """What is known, sorted by how it may stand in a word: a file may have thousands of remarks."""

    beginnings: tuple[str, ...]
    anywhere: tuple[str, ...]
    forms: tuple[str, ...]  # of long words that end with a vowel, without it


@lru_cache(maxsize=1024)
def _patterns(known: frozenset[str]) -> _Patterns:
    return _Patterns(
        tuple(stem for stem in known if len(stem) >= _STEM and not is_unparted(stem)),
        tuple(stem for stem in known if len(stem) > 1 and is_unparted(stem)),
        tuple(word[:-1] for word in known if len(word) >= _STEM_OF_FORMS and word[-1] in _ENDINGS),
    )


def _matches(word: str, patterns: _Patterns) -> bool:
    """Whether a known word stands in this one, or this one is another form of it ("poczatkowej")."""
    return (
        word.startswith(patterns.beginnings)
        or any(stem in word for stem in patterns.anywhere)
        or (
            word.startswith(patterns.forms)
            and any(word.startswith(form) and len(word) <= len(form) + 3 for form in patterns.forms)
        )
    )


_STEM_OF_FORMS = 7
_ENDINGS = "aeiyаеияый"


def is_part(word: str, stem: str) -> bool:
    """Whether a known word stands in a longer one."""
    if is_unparted(stem):
        return len(stem) > 1 and stem in word
    return word.startswith(stem)


_STEM = 6  # letters from which a word counts as the beginning of its other forms

#: Channel -> words for it.
CHANNEL_WORDS = {channel: all_words(texts) for channel, texts in words.CHANNELS.items()}
_COMPOUNDS = frozenset().union(*(_marked(texts) for texts in words.CHANNELS.values()))
#: Letters that stand for a channel where their unit agrees.
LETTERS = {
    "t": "time", "p": "pressure", "f": "force", "l": "length", "x": "displacement", "s": "displacement",
    "d": "diameter", "v": "velocity", "u": "command",
}  # fmt: skip

#: Words that make a column something else -> what it is.
OTHER_QUANTITIES = {word: reason for reason, texts in words.OTHERS.items() for word in all_words(texts)}
#: These leave a pressure or a time what it is, but not a diameter; of a length only.
_ONLY_OF_DIAMETERS = frozenset(all_words(words.OTHERS[Reason.TUBE_SIZE]))
#: A column with one of these is wanted less than one without.
LESS_WANTED = {
    **dict.fromkeys(word_set("raw roh brut grezzo crudo adc counts digits uncalibrated unkalibriert"), 3),
    **dict.fromkeys(
        word_set("filtered gefiltert smoothed geglaettet filtre filtrato filtrado mean mittel"), 2
    ),
}
#: Words before a length that is not the muscle's.
OTHER_LENGTHS = word_set(
    "radius diameter pulley drum wheel wire tube hose cylinder bore wall travel range durchmesser rolle "
    "scheibe schlauch rayon diametre poulie raggio diametro puleggia radio polea raio polia promien srednica "
    "polomer prumer straal halfsalja"
)
#: Words for a running number, a remark: columns of these names are no channel.
NO_CHANNEL = {word: reason for reason, texts in words.NO_CHANNELS.items() for word in all_words(texts)}
#: Remark -> its words: "at rest", "load", "supply", "ambient", "barometer", "sample", "date".
REMARK_WORDS = {what: frozenset(all_words(texts)) for what, texts in words.REMARKS.items()}
#: Words with which an attribute or field says that it holds units.
UNIT_WORDS = REMARK_WORDS["unit"]
#: Words before a force or mass that is not the load of the muscle.
LOADLESS = REMARK_WORDS["loadless"]
#: Words of columns that count the steps of an encoder.
COUNTER_WORDS = frozenset(all_words(words.COUNTERS))
#: Words of a column that holds the values of all signals.
VALUE_WORDS = frozenset(all_words(words.VALUES))
#: Words with which the statistics below a table begin.
STATISTICS = frozenset(all_words(words.STATISTIC))
#: Words for the way there and the way back.
WAYS = frozenset(all_words(words.WAYS))
#: Way of the muscle or of the test -> words for it in cells.
MOVES = {way: frozenset(all_words(texts)) for way, texts in (words.DIRECTIONS | words.MOVES).items()}
#: Words for a state without motion in cells.
HOLDS = frozenset(all_words(words.HOLDS))
#: Words of texts about signs: "positive", "negative", "tension", "compression", "extension", "shortening".
SIGN_WORDS = {what: frozenset(all_words(texts)) for what, texts in words.SIGNS.items()}
#: State of a valve, "closed", "open" (fills the muscle), "exhaust" -> words for it.
VALVE_WORDS = {state: frozenset(all_words(texts)) for state, texts in words.VALVES.items()}
#: Words with which a text says that a pressure was measured, not set.
MEASURED_WORDS = frozenset(all_words(words.MEASURED))
#: Words of heads that name the phase of a test.
PHASES = frozenset(all_words(words.PHASES))
#: Words for a command that name no valve: in a unit of pressure, length or force it is a set value.
COMMANDED = frozenset(all_words(words.COMMANDED))
#: Words for the reference of a pressure: True = absolute.
REFERENCE_WORDS = {
    word: reference == "absolute"
    for reference, texts in words.REFERENCES.items()
    for word in all_words(texts)
}


def reference_among(text_words: Sequence[str]) -> bool | None:
    """Absolute (True) or gauge (False) where the words say just one of them."""
    marks = {
        mark for word in text_words for known, mark in REFERENCE_WORDS.items()
        if (len(word) > 2 and word == known) or (is_unparted(known) and known in word)
    }  # fmt: skip
    return marks.pop() if len(marks) == 1 else None


def words_of(text: str) -> list[str]:
    """The words of a name, folded: parted at blanks, signs, and where small letters turn into capitals.

    >>> words_of("AI 1/MuscleForce_N")
    ['ai', '1', 'muscle', 'force', 'n']
    """
    spaced = re.sub(r"(?<=[a-zäöüß])(?=[A-ZÄÖÜ])|(?<=[A-Z])(?=[A-Z][a-z]{2})", " ", text)
    return [folded(word) for word in re.findall(r"[^\W_]+|#", spaced)]


_NO_FORCE = ("出力", "入力", "能力", "电力", "電力", "功力")  # "output": no word of a force


@lru_cache(maxsize=4096)
def channel_of_word(word: str) -> str | None:
    """The channel that a folded word stands for, alone or as a part of it."""
    for channel, stems in CHANNEL_WORDS.items():
        if word in stems:
            return channel
    if word in PHASES:
        return "direction"
    if any(word.endswith(end) for end in _NO_FORCE):
        return None
    best, length = None, 0
    for channel, stems in CHANNEL_WORDS.items():
        for stem in stems:
            if is_unparted(stem):
                found = stem in word if len(stem) > 1 else word.endswith(stem)
            else:
                long_enough = len(stem) >= 5 or (len(stem) >= 3 and stem in _COMPOUNDS)
                found = long_enough and (word.startswith(stem) or word.endswith(stem))
            if found and len(stem) > length:
                # The last part of a compound says what it is: a "Kraftweg" is a distance.
                best, length = channel, len(stem)
    return best


def proper_channel(channel: str | None) -> str | None:
    """The channel itself: an extension is a displacement counted the other way."""
    return "displacement" if channel == "extension" else channel


@lru_cache(maxsize=4096)
def other_quantity(word: str, channel: str | None) -> Reason | None:
    """What a folded word makes of a column, where that is not the channel itself."""
    if word in OTHER_QUANTITIES:
        reason = OTHER_QUANTITIES[word]
        return None if word in _ONLY_OF_DIAMETERS and channel not in (None, "diameter") else reason
    unparted = next((r for part, r in OTHER_QUANTITIES.items() if is_unparted(part) and part in word), None)
    if unparted is not None or channel is None:
        return unparted
    for part, reason in OTHER_QUANTITIES.items():
        if part in _ONLY_OF_DIAMETERS and channel != "diameter":
            continue
        if len(part) >= 4 and word.startswith(part) and word != part:
            rest = word[len(part) :]
            if channel_of_word(rest) or channel_of_word(rest.lstrip("s")):
                return reason
    return None
