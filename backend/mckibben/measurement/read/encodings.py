"""Texts that are not Unicode: the encoding in which they hold known words and no letter stands oddly."""

from __future__ import annotations

import re

from mckibben.measurement.read.vocabulary import CHANNEL_WORDS, folded

_LOOKED_AT = 200_000  # bytes
_KANA_OR_KANJI = re.compile("[\u3040-\u30ff\u4e00-\u9fff]+")
_HALF_WIDTH = re.compile("[\uff61-\uff9f]")  # single bytes: any letter of Latin-1 looks like one
_WORD = re.compile(r"[^\W\d_]+")
#: Alphabets of one byte: codec -> name for people; the first of equally good ones is taken.
_ALPHABETS = {
    "latin-1": "Latin-1", "cp1250": "Windows-1250", "cp1251": "Windows-1251", "cp1254": "Windows-1254",
}  # fmt: skip
#: Alphabets of two bytes, whose texts do not decode by chance.
_PAIRED = {"gb18030": "GB 18030", "euc-kr": "EUC-KR", "big5": "Big5"}
_KNOWN = frozenset(
    word for words in CHANNEL_WORDS.values() for word in words if len(word) > 2 or not word.isascii()
)
#: Letters of Windows-1250 whose bytes are signs in Latin-1; signs do not stand inside of words.
_SIGN_INSIDE = re.compile(r"[^\W\d_][³¥¯¹¿£\x80-\x9f][^\W\d_]|[^\W\d_][\x80-\x9f]|[\x80-\x9f][^\W\d_]")
_RARE = re.compile("[ðþýÐÞÝ]")  # of Iceland in Latin-1, of Turkey in Windows-1254
_MANY_ACCENTS = re.compile("[\u00c0-\u017f]{4,}")  # a word in other letters, taken for Latin ones
_SEVERAL = 3  # words
_CYRILLIC = re.compile("[\u0400-\u04ff]+")


def decoded_otherwise(data: bytes) -> tuple[str, str]:
    """A text that is not UTF-8, and the name of its encoding.

    Shift-JIS and other alphabets of two bytes where all of it decodes to such letters side by side; else the
    alphabet of one byte with most words of laboratories and fewest letters where none stand.
    """
    head = data[:_LOOKED_AT]
    japanese = head.decode("cp932", "ignore")
    runs = [len(run) for run in _KANA_OR_KANJI.findall(japanese)]
    words = sum(length for length in runs if length > 1)  # a letter of Latin-1 and the next look like one
    if words > len(_HALF_WIDTH.findall(japanese)) + runs.count(1):
        candidates = {"cp932": "Shift-JIS", **_PAIRED}
    else:
        candidates = _PAIRED
    paired = {}
    for codec in candidates:
        try:
            data.decode(codec)
        except UnicodeDecodeError:
            continue
        if known := _known_words(head.decode(codec, "ignore"), ascii_too=False):
            paired[codec] = known
    if "cp932" in candidates and not paired:
        try:
            return data.decode("cp932"), "Shift-JIS"
        except UnicodeDecodeError:
            pass
    scores = {codec: _score(head.decode(codec, "replace")) for codec in _ALPHABETS}
    best = max(scores, key=lambda codec: scores[codec])  # the first of the best
    codec = max(paired, key=lambda codec: paired[codec], default="")
    # Names of quantities in English, as loggers write them too, speak for no alphabet.
    own = max(_score(head.decode(one, "replace"), ascii_too=False) for one in _ALPHABETS)
    if paired and (scores[best] <= 0 or best == "cp1251" or (own <= 0 and paired[codec] >= _SEVERAL)):
        return data.decode(codec), candidates[codec]
    return data.decode(best, "replace"), _ALPHABETS[best]


def _known_words(text: str, *, ascii_too: bool = True) -> int:
    """Number of known words; unparted languages have theirs anywhere in a run of letters."""
    found = 0
    for word in set(_WORD.findall(text)):
        plain = folded(word)
        if word.isascii():
            found += ascii_too and plain in _KNOWN
        else:
            found += plain in _KNOWN or (plain > "\u3000" and any(k in plain for k in _KNOWN if k > "\u3000"))
    return found


def _score(text: str, *, ascii_too: bool = True) -> int:
    """How well a text reads: known words count for it, letters and signs where none stand against it."""
    against = len(_SIGN_INSIDE.findall(text)) + len(_RARE.findall(text)) + len(_MANY_ACCENTS.findall(text))
    mixed = sum(1 for run in _CYRILLIC.findall(text) if not (run[1:].islower() or run.isupper()))
    return 3 * _known_words(text, ascii_too=ascii_too) - against - 2 * mixed
