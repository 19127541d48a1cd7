"""What texts say of signs: ``compression positive``, ``extension positive, shortening reads negative``."""

from __future__ import annotations

import re
from collections.abc import Iterator

from mckibben.measurement.read.vocabulary import (
    CHANNEL_WORDS,
    SIGN_WORDS,
    channel_of_word,
    folded,
    has_word,
    words_of,
)

#: Keys of conditions that only texts say, with their one value each.
FORCE_SIGN, COMPRESSION_POSITIVE = "force_sign", "compression positive"
STROKE_SIGN, EXTENSION_POSITIVE, SHORTENING_POSITIVE = (
    "stroke_sign", "extension positive", "shortening positive",
)  # fmt: skip

_LONGER, _SHORTER = SIGN_WORDS["longer"], SIGN_WORDS["shorter"]
_EXTENSION = frozenset(CHANNEL_WORDS["extension"]) | SIGN_WORDS["extension"] | _LONGER
_SHORTENING = SIGN_WORDS["shortening"] | _SHORTER
_CLAUSES = re.compile(r"[,;.|()\[\]]|\s[/–-]\s|\b(?:and|und|et|e|y|og|och|en|i|a|ve|и|та)\b")
_STROKES = {"displacement", "extension", "length", "contraction"}
_OTHERS = {"force", "pressure", "command", "velocity"}
_SHORT = 3  # words
_ASIDE = re.compile(r"\(([^()]*)\)")
#: "+ = shortening", "(+) longer": a sign that stands for the word.
_PLUS = re.compile(r"(?<![\w.,+])\(?\+\)?(?=\s*(?:[A-Za-z]\w{0,2}\s*)?(?:=|:|≙|->|→|is\b))")
_MINUS = re.compile(r"(?<![\w.,-])\(?[-−]\)?(?=\s*(?:[A-Za-z]\w{0,2}\s*)?(?:=|≙|->|→))")
#: "compression +, tension -": a sign behind the word.
_PLUS_BEHIND = re.compile(r"(?<=[^\W\d_])\s*[:=]?\s*\(?\+\)?(?=\s*(?:[,;.)/]|$))")
_MINUS_BEHIND = re.compile(r"(?<=[^\W\d_])\s*[:=]?\s+\(?[-−]\)?(?=\s*(?:[,;.)/]|$))")
#: What stands between a sign and what it means.
_MEANS = re.compile(
    r"=|≙|->|→|\b(?:when|if|while|means|wenn|falls|sobald|heisst|bedeutet|quand|lorsque|si|signifie|se|"
    r"cuando|quando|significa|gdy|kdyz|если|когда|значит|als|wanneer|betekent|nar|om|kun|jos|ha|cand)\b"
)
_BEFORE_MEANS = re.compile(rf",\s*(?={_MEANS.pattern})")


def signs_of(text: str) -> Iterator[tuple[str, str]]:
    """The signs that a text says; of a force only where it is not that of this program.

    >>> list(signs_of("tension positive; extension positive (shortening reads negative)"))
    [('stroke_sign', 'extension positive')]
    >>> list(signs_of("Extension positive = muscle gets longer"))
    [('stroke_sign', 'extension positive')]
    """
    text = _MINUS_BEHIND.sub(" minus", _PLUS_BEHIND.sub(" plus", text))
    plain = folded(_MINUS.sub(" minus ", _PLUS.sub(" plus ", text)))
    if not _says_a_sign(words_of(plain)):
        return
    plain = _ASIDE.sub(lambda aside: aside[0] if _says_a_sign(words_of(aside[1])) else " ", plain)
    force, stroke = set[bool](), set[bool]()
    for clause in _CLAUSES.split(_BEFORE_MEANS.sub(" ", plain)):
        words = words_of(clause)
        longer, shorter = has_word(words, _LONGER), has_word(words, _SHORTER)
        equated = _MEANS.search(clause) is not None
        # "positive displacement sensor" says no sign; "positive when the muscle gets shorter" does.
        said = words if len(words) <= _SHORT or equated or longer != shorter else words[-2:]
        positive, negative = (has_word(said, SIGN_WORDS[sign]) for sign in ("positive", "negative"))
        if positive == negative:
            continue
        if has_word(words, SIGN_WORDS["tension"]) != has_word(words, SIGN_WORDS["compression"]):
            force.add(positive == has_word(words, SIGN_WORDS["compression"]))
        # What the muscle does counts, not the name of the column: "extension: positive = shorter".
        meant = words_of(_MEANS.split(clause, maxsplit=1)[-1]) if equated else words
        meant = meant if has_word(meant, _EXTENSION) != has_word(meant, _SHORTENING) else words
        extension, shortening = has_word(meant, _EXTENSION), has_word(meant, _SHORTENING)
        channels = {channel_of_word(word) for word in words}
        if channels & _OTHERS and not channels & _STROKES:
            continue  # "force positive when stretched"
        if longer != shorter:
            stroke.add(positive == longer)
        elif extension != shortening:
            stroke.add(positive == extension)
    if force == {True}:
        yield FORCE_SIGN, COMPRESSION_POSITIVE
    if len(stroke) == 1:
        yield STROKE_SIGN, EXTENSION_POSITIVE if True in stroke else SHORTENING_POSITIVE


def _says_a_sign(words: list[str]) -> bool:
    return has_word(words, SIGN_WORDS["positive"]) or has_word(words, SIGN_WORDS["negative"])
