"""The one exception for input that cannot be used: what is wrong, where, and what would be right."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from difflib import get_close_matches

_WORDS = re.compile(r"[^a-z0-9]+")  # between the words of a name
_LONGEST = 300  # most characters shown of an error in a user's code


class InputError(ValueError):
    """Input of the caller that cannot be used.

    Args:
        message: what is wrong ("braid angle 95° is not between 0° and 90°").
        field: where, as a path of the request or file ("muscle.braid_angle", "row 7, column force").
        hint: what would be right ("e.g. '25 deg'").
        code: machine-readable kind; ``not_found`` becomes HTTP 404, ``conflict`` 409, ``unavailable`` 503 (it
            may work later), ``no_space`` 507, everything else 422.
    """

    def __init__(
        self, message: str, *, field: str | None = None, hint: str | None = None, code: str = "bad_input"
    ) -> None:
        super().__init__(message)
        self.message = message
        self.field = field
        self.hint = hint
        self.code = code

    def at(self, field: str | None, *, code: str | None = None) -> InputError:
        """The same error at another field, and with another code if given."""
        return InputError(self.message, field=field, hint=self.hint, code=code or self.code)

    def inside(self, part: str) -> InputError:
        """The same error within a part of a whole: "valve.preset" inside "drive" is "drive.valve.preset"."""
        return self.at(f"{part}.{self.field}" if self.field else part)


@contextmanager
def fields_inside(part: str) -> Iterator[None]:
    """Prefix the fields of errors in this block with the name of the part."""
    try:
        yield
    except InputError as error:
        raise error.inside(part) from error


def did_you_mean(word: str, options: Iterable[str]) -> str | None:
    """A sentence with the nearest known word, or the list of known words if none is near."""
    known = sorted(options)
    by_lower = {option.lower(): option for option in known}
    # A whole word of names, as "length" of "nominal_length" and "thread_length", may mean each of them.
    near = [word.lower()] if word.lower() in by_lower else []
    near = near or [option for option in by_lower if word.lower() in _WORDS.split(option)]
    near = near or get_close_matches(word.lower(), by_lower, n=1, cutoff=0.6)
    if not near:  # near to a part of a name, as "blader" to "bladder_elasticity"
        parts = [(p, option) for option in by_lower for p in _WORDS.split(option) if len(p) > 3]
        nearest = get_close_matches(word.lower(), {part for part, _ in parts}, n=1, cutoff=0.75)
        near = [option for part, option in parts if part in nearest]
    if len(near) == 1:
        return f"Did you mean '{by_lower[near[0]]}'?"
    if 1 < len(near) <= 6:
        return f"Did you mean one of {', '.join(sorted(by_lower[option] for option in near))}?"
    return f"Known: {', '.join(known)}." if 0 < len(known) <= 60 else None


def error_text(error: BaseException) -> str:
    """An error in a user's code in one line: its type, its message, and whether it would end the program."""
    try:
        message = " ".join(str(error).split())[:_LONGEST]
    except Exception:  # str(error) itself may fail
        message = ""
    text = f"{type(error).__name__}: {message}" if message else type(error).__name__
    return text if isinstance(error, Exception) else f"it ends the program ({text})"
