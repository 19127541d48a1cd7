"""``--report``: a diagnosis or a sizing as an HTML file."""

from __future__ import annotations

from pathlib import Path

from mckibben.application.asked import Asked
from mckibben.application.reports import Told, report_of
from mckibben.application.start import Json
from mckibben.cli.output import remark
from mckibben.documents.studio import Studio
from mckibben.physics.errors import InputError


def write(path: Path, studio: Studio, question: Asked, diagnosis: Json) -> None:
    """Write the report of a diagnosis.

    Raises:
        InputError: the file cannot be written.
    """
    save(path, report_of(question, studio, Told(), diagnosis))


def save(path: Path, text: str) -> None:
    """Write a report that is ready, and say where.

    Raises:
        InputError: the file cannot be written.
    """
    try:
        path.write_text(text, encoding="utf-8", newline="\n")
    except OSError as error:
        raise InputError(
            f"--report {path}: cannot be written: {error.strerror or error}", hint="name a file in a folder"
        ) from error
    remark(f"report: {path}")
