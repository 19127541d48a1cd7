"""Writing the text of a result to a file."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from mckibben.physics.errors import InputError

HTML = (".html", ".htm")


def check_ending(path: Path, known: Sequence[str], *, named: str = "") -> str:
    """The ending of a file to be written, in lower case.

    Args:
        path: the file.
        known: the endings of the forms in which it can be written.
        named: how the user named it, "--out trace.csv"; by default the path.

    Raises:
        InputError: it has another ending, and nobody would find in the file what its name promises.
    """
    ending = path.suffix.lower()
    if ending not in known:
        said = f"'{path.suffix}' is not a known ending" if ending else "the name has no ending"
        raise InputError(f"{named or path}: {said}", hint=f"{path.stem}{' or '.join(known)}")
    return ending


def write_text(path: Path, text: str, *, named: str = "") -> None:
    """Write a text file, in UTF-8 with the line ends of Unix.

    Args:
        path: the file; an existing one is replaced.
        text: its content.
        named: how the user named it, "--out trace.csv"; by default the path.

    Raises:
        InputError: it cannot be written.
    """
    try:
        path.write_text(text, encoding="utf-8", newline="\n")
    except OSError as error:
        raise InputError(
            f"{named or path}: cannot be written: {error.strerror or error}",
            hint="name a file in an existing folder",
        ) from error
