"""``mckibben convert``: any laboratory's file as the canonical CSV."""

from __future__ import annotations

from pathlib import Path

import typer

from mckibben.application.convert import converted
from mckibben.application.measurement_files import read_file
from mckibben.cli.output import remark
from mckibben.measurement.read import Correction
from mckibben.physics.errors import InputError


def run(*, file: str, correction: Correction, out: Path | None) -> None:
    """Write the canonical file, or print it.

    Raises:
        InputError: names the file, the row or field, what is wrong and what would be right.
    """
    result = converted(read_file(file, correction))
    if out is None:
        typer.echo(result.text, nl=False)
    else:
        try:
            out.write_text(result.text, encoding="utf-8")
        except OSError as error:
            raise InputError(
                f"--out {out}: cannot be written: {error.strerror}", hint="name a writable file"
            ) from error
    for message in result.messages:
        remark(message)
