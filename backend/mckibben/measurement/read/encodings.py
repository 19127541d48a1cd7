"""Texts that are not Unicode: the encoding in which most of their letters make sense."""

from __future__ import annotations

import re

_LOOKED_AT = 200_000  # bytes
_KANA_OR_KANJI = re.compile("[\u3040-\u30ff\u4e00-\u9fff]+")
_HALF_WIDTH = re.compile("[\uff61-\uff9f]")  # single bytes: any letter of Latin-1 looks like one
#: Letters of Windows-1250 whose bytes are signs in Latin-1; signs do not stand inside of words.
_SIGNS_INSIDE = re.compile(rb"[A-Za-z][\xa3\xa5\xaf\xb3\xb9\xbf][a-z]")


def decoded_otherwise(data: bytes) -> tuple[str, str]:
    """A text that is not UTF-8, and the name of its encoding.

    Shift-JIS where all of it decodes to Japanese letters in pairs of bytes; Windows-1250 where signs
    of Latin-1 (``³``, ``¹``, ``¿``) would stand inside of words; else Latin-1.
    """
    head = data[:_LOOKED_AT]
    japanese = head.decode("cp932", "ignore")
    runs = [len(run) for run in _KANA_OR_KANJI.findall(japanese)]
    words = sum(length for length in runs if length > 1)  # a letter of Latin-1 and the next look like one
    if words > len(_HALF_WIDTH.findall(japanese)) + runs.count(1):
        try:
            return data.decode("cp932"), "Shift-JIS"
        except UnicodeDecodeError:
            pass
    if _SIGNS_INSIDE.search(head):
        return data.decode("cp1250", "replace"), "Windows-1250"
    return data.decode("latin-1"), "Latin-1"
