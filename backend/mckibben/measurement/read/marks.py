"""Absolute or gauge: the mark on a pressure unit, ``bar(a)``, ``barg``, ``kPa abs``."""

from __future__ import annotations

import re

_MARKS = {
    "a": True, "abs": True, "absolute": True,
    "g": False, "gauge": False, "gage": False, "rel": False, "relative": False,
}  # fmt: skip
#: Words that say whether a pressure is absolute (True) or gauge (False).
MARK_WORDS = {word: mark for word, mark in _MARKS.items() if len(word) > 1}
_MARKED_UNIT = re.compile(
    r"(?i)(?<![a-z])([mkh]?(?:bar|pa)|psi)"
    r"(?:[\s_]*\((a|abs|absolute|g|gauge|rel)\)|(a|g)(?![a-z])|[\s_,;]+(abs|absolute|gauge|rel)(?![a-z]))"
)


def split_mark(text: str) -> tuple[str, bool | None]:
    """Take "absolute"/"gauge" off a pressure unit: ``"bar(a)"`` -> ``("bar", True)``; None = not said."""
    found = _MARKED_UNIT.search(text)
    if found is None:
        return text, None
    mark = next(group for group in found.groups()[1:] if group)
    return text[: found.end(1)] + text[found.end() :], _MARKS[mark.lower()]
