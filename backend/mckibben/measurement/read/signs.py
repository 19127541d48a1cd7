"""What texts say of signs: ``compression positive``, ``extension positive, shortening reads negative``."""

from __future__ import annotations

import re
from collections.abc import Iterator

from mckibben.measurement.read.vocabulary import CHANNEL_WORDS, SIGN_WORDS, folded, has_word, words_of

#: Keys of conditions that only texts say, with their one value each.
FORCE_SIGN, COMPRESSION_POSITIVE = "force_sign", "compression positive"
STROKE_SIGN, EXTENSION_POSITIVE = "stroke_sign", "extension positive"

_EXTENSION = frozenset(CHANNEL_WORDS["extension"]) | SIGN_WORDS["extension"]
_CLAUSES = re.compile(r"[,;.|()\[\]]|\s[/–-]\s|\b(?:and|und|et|e|y|og|och|en|i|a|ve|и|та)\b")
_SHORT = 3  # words
_ASIDE = re.compile(r"\(([^()]*)\)")


def signs_of(text: str) -> Iterator[tuple[str, str]]:
    """The signs that a text says, where they are not those of this program.

    >>> list(signs_of("tension positive; extension positive (shortening reads negative)"))
    [('stroke_sign', 'extension positive')]
    """
    plain = folded(text)
    if not _says_a_sign(words_of(plain)):
        return
    plain = _ASIDE.sub(lambda aside: aside[0] if _says_a_sign(words_of(aside[1])) else " ", plain)
    force, stroke = set[bool](), set[bool]()
    for clause in _CLAUSES.split(plain):
        words = words_of(clause)
        said = words if len(words) <= _SHORT else words[-2:]  # "positive displacement sensor" says no sign
        positive, negative = (has_word(said, SIGN_WORDS[sign]) for sign in ("positive", "negative"))
        if positive == negative:
            continue
        if has_word(words, SIGN_WORDS["tension"]) != has_word(words, SIGN_WORDS["compression"]):
            force.add(positive == has_word(words, SIGN_WORDS["compression"]))
        if has_word(words, _EXTENSION) != has_word(words, SIGN_WORDS["shortening"]):
            stroke.add(positive == has_word(words, _EXTENSION))
    if force == {True}:
        yield FORCE_SIGN, COMPRESSION_POSITIVE
    if stroke == {True}:
        yield STROKE_SIGN, EXTENSION_POSITIVE


def _says_a_sign(words: list[str]) -> bool:
    return has_word(words, SIGN_WORDS["positive"]) or has_word(words, SIGN_WORDS["negative"])
