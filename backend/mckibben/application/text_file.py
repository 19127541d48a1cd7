"""Writing the text of a result to a file."""

from __future__ import annotations

from pathlib import Path

from mckibben.physics.errors import InputError


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
