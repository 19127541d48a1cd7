"""Order codes of muscles in texts and names of files: ``DMSP-20-250N``."""

from __future__ import annotations

import re
from collections.abc import Iterator
from functools import cache

from mckibben.measurement.read.conditions import Note
from mckibben.resources import presets_folder

_CODE = re.compile(r"(?<![A-Za-z0-9])([A-Z]{2,6}-[0-9]{1,3})(?:-([0-9]{2,4})(?![0-9]))?")
_CODE_IN_A_WORD = re.compile(r"(?i)(?<![a-z0-9])([a-z]{2,6})[-_ ]?([0-9]{1,3})(?![0-9a-z])")


def of_code(text: str) -> Iterator[tuple[str, str]]:
    """Muscle and length in an order code: ``DMSP-20-250N`` is 250 mm of a DMSP-20."""
    for found in _CODE.finditer(text.replace("_", " ")):
        if found[1].upper() in _known_muscles():
            yield "muscle", found[1]
            if found[2]:
                yield "nominal_length", f"{found[2]} mm"
    for found in _CODE_IN_A_WORD.finditer(text):
        if (code := f"{found[1]}-{found[2]}".upper()) in _known_muscles():
            yield "muscle", code


def without_codes(text: str) -> str:
    """A text, as long, in which the digits of order codes are blanks: they are no measured number."""
    for code in (_CODE, _CODE_IN_A_WORD):
        text = code.sub(_blanked, text)
    return text


def _blanked(found: re.Match[str]) -> str:
    code = found[1] if found.re is _CODE else f"{found[1]}-{found[2]}"
    return re.sub(r"[0-9]", " ", found[0]) if code.upper() in _known_muscles() else found[0]


def notes_of_code(note: Note) -> list[Note]:
    """Muscle and rest length in the order code of a value."""
    return [Note(note.where, key, value) for key, value in of_code(str(note.value))]


@cache
def _known_muscles() -> frozenset[str]:
    """Ids of the muscles that come with the program."""
    return frozenset(path.stem.upper() for path in (presets_folder() / "muscles").glob("*.json"))
