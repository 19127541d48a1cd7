"""Bytes to text: Unicode where it is, else the encoding in which the text holds known words."""

from __future__ import annotations

import re
from functools import cache

from mckibben.measurement.reading.lexicon import folded, rules
from mckibben.physics.errors import InputError

_LOOKED_AT = 200_000  # bytes
_WORD = re.compile(r"[^\W\d_]+")
_KANA_OR_KANJI = re.compile("[\u3040-\u30ff\u4e00-\u9fff]+")
_HALF_WIDTH = re.compile("[\uff61-\uff9f]")  # single bytes: any letter of Latin-1 looks like one
#: Alphabets of one byte: codec -> name for people; the first of equally good ones is taken.
_ALPHABETS = {
    "latin-1": "Latin-1",
    "cp1250": "Windows-1250",
    "cp1251": "Windows-1251",
    "cp1254": "Windows-1254",
}
#: Alphabets of two bytes, whose texts do not decode by chance.
_PAIRED = {"gb18030": "GB 18030", "euc-kr": "EUC-KR", "big5": "Big5"}
#: Letters of Windows-1250 whose bytes are signs in Latin-1; signs do not stand inside of words.
_SIGN_INSIDE = re.compile(r"[^\W\d_][³¥¯¹¿£\x80-\x9f][^\W\d_]|[^\W\d_][\x80-\x9f]|[\x80-\x9f][^\W\d_]")
_RARE = re.compile("[ðþýÐÞÝ]")  # of Iceland in Latin-1, of Turkey in Windows-1254
_MANY_ACCENTS = re.compile("[\u00c0-\u017f]{4,40}")  # a word in other letters, taken for Latin ones
_CYRILLIC = re.compile("[\u0400-\u04ff]+")
_SEVERAL = 3  # words
_CONTROL = re.compile(rb"[\x00-\x08\x0b\x0e-\x1f\x7f]")
_ZEROS = 0.4  # share of zero bytes at every other place from which a text without a mark is UTF-16


def decoded(data: bytes, name: str) -> tuple[str, tuple[str, ...]]:
    """(text with ``\\n`` line ends, messages).

    Raises:
        InputError: it is no text, or an empty one.
    """
    messages: tuple[str, ...] = ()
    head = data[:4000]
    if data[:2] in (b"\xff\xfe", b"\xfe\xff") or (
        len(head) > 20
        and max(head[::2].count(0), head[1::2].count(0)) > _ZEROS * len(head)
        and min(head[::2].count(0), head[1::2].count(0)) == 0
    ):
        data = _from_utf16(data, name)
    if control := _CONTROL.search(data):
        what = "NUL bytes" if control.group() == b"\0" else "control characters"
        line = data.count(b"\n", 0, control.start()) + 1
        raise InputError(
            f"{name}, row {line}: the file holds {what}, it is not a text table",
            field=f"row {line}",
            hint="save it as 'CSV UTF-8'",
        )
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError:
        text, encoding = _otherwise(data)
        messages = (f"the file is not UTF-8: read as {encoding}",)
    if not text.strip():
        raise InputError(
            f"{name}, row 1: the file is empty",
            field="row 1",
            hint="it needs a header and one line per reading",
        )
    return (text.replace("\r\n", "\n").replace("\r", "\n") if "\r" in text else text), messages


def _from_utf16(data: bytes, name: str) -> bytes:
    """UTF-16 as UTF-8; without a mark the order of the bytes shows by the zeros."""
    head = data[:4000]
    codec = (
        "utf-16"
        if data[:2] in (b"\xff\xfe", b"\xfe\xff")
        else ("utf-16-le" if head[1::2].count(0) > head[::2].count(0) else "utf-16-be")
    )
    try:
        return data.decode(codec).encode()
    except UnicodeDecodeError as error:
        if codec != "utf-16":
            return data
        row = data[: error.start].decode(codec, "ignore").count("\n") + 1
        raise InputError(
            f"{name}, row {row}: the UTF-16 text is damaged",
            field=f"row {row}",
            hint="save it as 'CSV UTF-8'",
        ) from error


def _otherwise(data: bytes) -> tuple[str, str]:
    """A text that is not UTF-8, and the name of its encoding.

    Alphabets of two bytes where all of it decodes to such letters side by side; else the alphabet of one byte
    with most words of laboratories and fewest letters where none stand.
    """
    head = data[:_LOOKED_AT]
    japanese = head.decode("cp932", "ignore")
    runs = [len(run) for run in _KANA_OR_KANJI.findall(japanese)]
    words = sum(length for length in runs if length > 1)  # a letter of Latin-1 and the next look like one
    likely = words > len(_HALF_WIDTH.findall(japanese)) + runs.count(1)
    candidates = {"cp932": "Shift-JIS", **_PAIRED} if likely else _PAIRED
    paired = {}
    for codec in candidates:
        try:
            data.decode(codec)
        except UnicodeDecodeError:
            continue
        if known := _known_words(head.decode(codec, "ignore"), ascii_too=False):
            paired[codec] = known
    if likely and not paired:
        try:
            return data.decode("cp932"), "Shift-JIS"
        except UnicodeDecodeError:
            pass
    scores = {codec: _score(head.decode(codec, "replace")) for codec in _ALPHABETS}
    best = max(scores, key=lambda codec: scores[codec])
    codec = max(paired, key=lambda codec: paired[codec], default="")
    # Names of quantities in English, as loggers write them too, speak for no alphabet.
    own = max(_score(head.decode(one, "replace"), ascii_too=False) for one in _ALPHABETS)
    if paired and (scores[best] <= 0 or best == "cp1251" or (own <= 0 and paired[codec] >= _SEVERAL)):
        return data.decode(codec), candidates[codec]
    return data.decode(best, "replace"), _ALPHABETS[best]


@cache
def _known() -> tuple[frozenset[str], frozenset[str]]:
    """(words of the channels, those among them that stand anywhere in a run of letters)."""
    sets = [rule.words for rule in rules("head") if "channel" in rule.claims and rule.words is not None]
    known = frozenset(word for s in sets for word in s.words if len(word) > 2 or not word.isascii())
    return known, frozenset(word for s in sets for word in s.unparted)


def _known_words(text: str, *, ascii_too: bool = True) -> int:
    """Number of known words; unparted languages have theirs anywhere in a run of letters."""
    known, anywhere = _known()
    count = 0
    for word in set(_WORD.findall(text)):
        plain = folded(word)
        if word.isascii():
            count += ascii_too and plain in known
        else:
            count += plain in known or (plain > "\u3000" and any(part in plain[:200] for part in anywhere))
    return count


def _score(text: str, *, ascii_too: bool = True) -> int:
    """How well a text reads: known words count for it, letters and signs where none stand against it."""
    against = len(_SIGN_INSIDE.findall(text)) + len(_RARE.findall(text)) + len(_MANY_ACCENTS.findall(text))
    mixed = sum(1 for run in _CYRILLIC.findall(text) if not (run[1:].islower() or run.isupper()))
    return 3 * _known_words(text, ascii_too=ascii_too) - against - 2 * mixed
