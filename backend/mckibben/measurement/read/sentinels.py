"""Numbers that a text says to stand for no reading: "-1.0 marks a lost sample", "9999 = sensor error"."""

from __future__ import annotations

import re
from collections.abc import Iterable
from functools import lru_cache

from mckibben.measurement.measurement import STROKES
from mckibben.measurement.read.unit_words import unit_of
from mckibben.measurement.read.vocabulary import channel_of_word, folded, has_word, word_set, words_of
from mckibben.measurement.read.words.cells import NO_READING

_NUMBER = re.compile(r"(?<![\w.,+-])([+-]?[0-9]+(?:[.,][0-9]+)?(?:[eE][+-]?[0-9]{1,3})?)(?![\w,]*[0-9])")
_MEANS = re.compile(
    r"=|:|->|\b(?:marks?|means?|denotes?|indicates?|stands?|is|are|for|bedeutet|heisst|kennzeichnet|steht|signifie|"
    r"indique|significa|indica|oznacza|znamena|betekent|betyder|was|were|entered|written|recorded|as)\b"
)
_WORDS = word_set(NO_READING)
_ERRORS = word_set("error fault fehler erreur errore blad chyba fout virhe hata ошибка")
_AS = word_set("as by als durch comme come como jako wie with mit")


def sentinels_in(texts: Iterable[tuple[str, str]], channel: str) -> list[float]:
    """The numbers that texts say to stand for no reading of a channel.

    >>> sentinels_in([("a force of -1.0 marks a lost sample", "line 2")], "force")
    [-1.0]
    >>> sentinels_in([("a force of -1.0 marks a lost sample", "line 2")], "pressure")
    []
    """
    found: list[float] = []
    for text, _ in texts:
        for value, channels in _of_text(text):
            if not channels or channel in channels:
                found.append(value)
    return found


@lru_cache(maxsize=512)
def _of_text(text: str) -> tuple[tuple[float, frozenset[str]], ...]:
    """(number, channels that it is said of; none = all) of the clauses of a text."""
    result = []
    for clause in re.split(r"[;|]|,\s|[.](?=\s|$)", text):
        words = words_of(clause)
        if not has_word(words, _WORDS) or _MEANS.search(folded(clause)) is None:
            continue
        numbers = [
            match for match in _NUMBER.finditer(clause)
            if (behind := re.match(r"\s*([^\W\d_]+)", clause[match.end() :])) is None
            or _is_no_count(behind[1])
        ]  # fmt: skip
        if len(numbers) != 1 or _is_size_of_error(clause[: numbers[0].start()]):
            continue
        named = {channel for word in words if (channel := channel_of_word(word)) is not None}
        named &= {"pressure", "force", *STROKES, "extension", "temperature"}
        if named & {*STROKES, "extension"}:
            named |= {*STROKES}
        result.append((float(numbers[0][1].replace(",", ".")), frozenset(named)))
    return tuple(result)


def _is_size_of_error(before: str) -> bool:
    """Whether words before a number make it the size of an error: "error = 0.5", "max. fault 2"."""
    words = words_of(before)
    return has_word(words, _ERRORS) and not has_word(words[-2:], _AS)


def _is_no_count(word: str) -> bool:
    """Whether a word behind a number leaves it a value: "3 samples lost" counts, "-1 N marks" does not."""
    return unit_of(word) is not None or _MEANS.fullmatch(folded(word)) is not None
