"""``mckibben convert``: any laboratory's file as the canonical CSV."""

from __future__ import annotations

from pathlib import Path

import typer

from mckibben.application.measurement.convert import converted
from mckibben.application.measurement.files import read_file
from mckibben.application.text_file import write_text
from mckibben.cli.output import progress, remark, standard_input
from mckibben.measurement.read import Correction


def run(*, file: str, correction: Correction, out: Path | None) -> None:
    """Write the canonical file, or print it.

    Raises:
        InputError: names the file, the row or field, what is wrong and what would be right.
    """
    with progress("reading"):
        result = converted(read_file(file, correction, standard_input([file]).get(file)))
    if out is None:
        typer.echo(result.text, nl=False)
    else:
        write_text(out, result.text, named=f"--out {out}")
    for message in result.messages:
        remark(message)
