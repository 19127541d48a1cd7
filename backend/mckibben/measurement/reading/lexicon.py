"""Words and rules as data: `words.toml` and `rules.toml`, and how words of a file are compared with them.

Every look-up is a hash of a word or of its beginnings and ends, so its cost grows with the length of a text
only.
"""

from __future__ import annotations

import re
import tomllib
import unicodedata
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cache, lru_cache
from importlib.resources import files
from typing import Any

_UNPARTED = "\u3000"  # from here on stand the letters of languages that do not part their words
_LETTERS = str.maketrans({"ł": "l", "ı": "i", "đ": "d", "ø": "o", "æ": "ae", "œ": "oe"})
_UMLAUTS = str.maketrans({"ä": "ae", "ö": "oe", "ü": "ue"})
_STEM = 6  # letters from which a word counts as the beginning of its other forms
_PART = 5  # letters from which a word counts as a part of a compound
_LONGEST = 12  # letters of the longest unparted word that is looked for
_JOINING = ("any", "de", "nl", "sv", "da", "fi", "hu")  # languages that join words to longer ones
_END = 100  # strength of the end of a compound, above that of its beginning
EXACT = 1000  # strength from which a word is known as it stands
_ENDINGS = "aeiyаеияый"  # of words whose other forms end otherwise
_FORMS = 7  # letters from which such a word is long enough to be known without its ending
_WORD = re.compile(r"[^\W_]+|#")
_CAMEL = re.compile(r"(?<=[a-zäöüß])(?=[A-ZÄÖÜ])|(?<=[A-Z])(?=[A-Z][a-z]{2})")


@lru_cache(maxsize=65536)
def folded(text: str) -> str:
    """Lower case without accents; ``ß`` as ``ss``.

    >>> folded("Prüfzeit")
    'prufzeit'
    """
    plain = unicodedata.normalize("NFKD", text.casefold().translate(_LETTERS))
    bare = "".join(character for character in plain if not unicodedata.combining(character))
    return bare if bare.isascii() else unicodedata.normalize("NFC", bare)


@lru_cache(maxsize=16384)
def words_of(text: str) -> tuple[str, ...]:
    """The words of a text, folded: parted at blanks, signs, and where small letters turn into capitals.

    >>> words_of("AI 1/MuscleForce_N")
    ('ai', '1', 'muscle', 'force', 'n')
    """
    return tuple(folded(word) for word in _WORD.findall(_CAMEL.sub(" ", text)))


def _data(name: str) -> dict[str, Any]:
    return tomllib.loads((files("mckibben.measurement.reading") / name).read_text(encoding="utf-8"))


@cache
def _words() -> dict[str, Any]:
    return _data("words.toml")


class WordSet:
    """Words of one meaning, and how each may stand in a word of a file.

    Args:
        entries: ``"en: word word"``.
        compounds: in a text too they count as the end of a longer word, "Prüfdruck".
    """

    def __init__(self, entries: Iterable[str], *, compounds: bool = False) -> None:
        entries = list(entries)
        self.compounds = compounds
        self._among = lru_cache(maxsize=64)(self._found)  # a clause is asked again for each of its quantities
        plain = [word for entry in entries for word in entry.partition(":")[2].split()]
        plain += [word.translate(_UMLAUTS) for word in plain if set(word) & set("äöü")]
        self.words = frozenset(folded(word.strip("*") or word) for word in plain)
        marked = {folded(word.strip("*")) for word in plain if "*" in word and word != "*"}
        parted = {word for word in self.words if word and word[0] < _UNPARTED}
        self.unparted = frozenset(word for word in self.words - parted if len(word) > 1)
        self.single = frozenset(word for word in self.words - parted if len(word) == 1)
        self.joining = frozenset(
            folded(w) for e in entries for w in e.partition(":")[2].split() if e.partition(":")[0] in _JOINING
        )
        self.parts = frozenset(word for word in parted if len(word) >= _PART or word in marked)
        self.stems = frozenset(word for word in parted if len(word) >= _STEM)
        self.forms = frozenset(word[:-1] for word in parted if len(word) >= _FORMS and word[-1] in _ENDINGS)

    def among(self, words: Iterable[str]) -> bool:
        """Whether one of the words of a text is known, also as another form of a long one."""
        return self._among(tuple(words))

    def _found(self, words: tuple[str, ...]) -> bool:
        return any((self.strength if self.compounds else self.knows)(word) for word in words)

    def knows(self, word: str) -> bool:
        """Whether a word is known, or begins like a long known one, or holds an unparted one."""
        if word in self.words:
            return True
        if (word and word[-1] >= _UNPARTED) or (word and word[0] >= _UNPARTED):
            return self.inside(word) > 0
        beginnings = [word[:end] for end in range(_STEM, len(word))]
        return any(b in self.stems for b in beginnings) or any(
            word[:end] in self.forms for end in range(max(_FORMS - 1, len(word) - 3), len(word))
        )

    def inside(self, word: str) -> int:
        """Length of the longest unparted word in a word; 0 = none."""
        if not (self.unparted or self.single):
            return 0
        found = 1 if word and word[-1] in self.single else 0
        for size in range(2, min(_LONGEST, len(word)) + 1):
            if any(word[i : i + size] in self.unparted for i in range(min(200, len(word) - size + 1))):
                found = size
        return found

    def strength(self, word: str) -> int:
        """How much of a word of a head is known: all of it counts most, then the longest part; 0 = nothing.

        The end of a compound says what it is: a "Kraftweg" is a distance.
        """
        if word in self.words:
            return EXACT + len(word)
        if word and (word[-1] >= _UNPARTED or word[0] >= _UNPARTED):
            return 2 * self.inside(word)
        ends = [_END + len(word[start:]) for start in range(1, len(word) - 2) if word[start:] in self.parts]
        beginnings = [2 * end for end in range(3, len(word)) if word[:end] in self.parts]
        return max((*ends, *beginnings), default=0)


@cache
def word_set(name: str) -> WordSet:
    """A set of `words.toml`; several names joined by ``|`` are one set."""
    return WordSet([entry for part in name.split("|") for entry in _entries(part)], compounds="@" in name)


def _entries(name: str) -> list[str]:
    """The words of a set, or of a channel: ``@pressure``."""
    if not name.startswith("@"):
        return _words()["words"][name]
    return next(
        r["words"] for r in _data("rules.toml")["rule"] if r["on"] == "head" and r["id"] == f"head_{name[1:]}"
    )


@dataclass(frozen=True)
class Rule:
    """One row of `rules.toml`.

    Attributes:
        id: its name.
        on: ``head``, ``clause`` or ``text`` of what stands beside a table, ``quantity``, ``name`` of the
            file.
        claims: facet -> value; ``captured`` = what its pattern captures.
        weight: log-likelihood ratio [nats].
        example: a text it fires on; its test.
        words: of a head.
        needs: sets of which each must be among the words of a clause, or before a quantity.
        behind: sets that may stand behind a quantity instead, or have to as well (``both``).
        without: sets of which none may be there.
        dimension: of the quantity, or of the unit that a head must have; empty = any.
        pattern: of a text.
        any_case: whether the pattern does not distinguish capitals.
    """

    id: str
    on: str
    claims: Mapping[str, Any]
    weight: float
    example: str
    words: WordSet | None = None
    needs: tuple[str, ...] = ()
    behind: tuple[str, ...] = ()
    both: bool = False
    without: tuple[str, ...] = ()
    dimension: tuple[str, ...] = ()
    pattern: re.Pattern[str] | None = None


def pattern_of(rule: Rule) -> re.Pattern[str]:
    """The pattern of a rule that has one.

    Raises:
        ValueError: it has none, which is a mistake in `rules.toml`.
    """
    if rule.pattern is None:
        raise ValueError(f"rule '{rule.id}' has no pattern")
    return rule.pattern


@cache
def rules(on: str) -> tuple[Rule, ...]:
    """The rules for one kind of text."""
    return tuple(_rule(given) for given in _data("rules.toml")["rule"] if given["on"] == on)


def all_rules() -> tuple[Rule, ...]:
    """All rules, in the order of the file."""
    return tuple(_rule(given) for given in _data("rules.toml")["rule"])


def _rule(given: Mapping[str, Any]) -> Rule:
    flags = 0 if given.get("case") else re.IGNORECASE
    return Rule(
        id=given["id"],
        on=given["on"],
        claims=given["claims"],
        weight=float(given["weight"]),
        example=given["example"],
        words=WordSet(given["words"]) if "words" in given else None,
        needs=tuple(given.get("needs", ())),
        behind=tuple(given.get("behind", ())),
        both=bool(given.get("both")),
        without=tuple(given.get("without", ())),
        dimension=tuple(given.get("dimension", ())),
        pattern=re.compile(given["pattern"], flags) if "pattern" in given else None,
    )


#: Other spelling of a unit, lower case -> its name in the unit library.
UNIT_SPELLINGS = {spelling: unit for unit, text in _words()["units"].items() for spelling in text.split()}
#: What stands instead of a number, lower case -> why.
MARKERS = {text: reason for reason, texts in _words()["markers"].items() for text in texts}
#: Word for what a pressure counts from -> whether it is absolute.
REFERENCES = {word: name == "absolute" for name in ("absolute", "gauge") for word in word_set(name).words}
_SIGNS = re.compile(r"([-+*#?<>.–—_])\1{1,40}")  # "--", "+++++++", "####"


def marker_of(text: str) -> str | None:
    """Why a text stands where a number should: "no reading", "out of range"; None = it is no such text.

    >>> marker_of("OL")
    'out of range'
    """
    bare = text.strip().lower()
    if (reason := MARKERS.get(bare)) is not None:
        return reason
    if _SIGNS.fullmatch(bare):
        return "out of range" if bare[0] in "+#<>" else "no reading"
    return None
