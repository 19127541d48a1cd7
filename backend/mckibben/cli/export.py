"""``mckibben export``: a model or drive as files for other programs."""

from __future__ import annotations

from pathlib import Path

from mckibben.cli.output import remark
from mckibben.documents.located import located
from mckibben.documents.studio import Studio
from mckibben.export.registry import format_named
from mckibben.export.source import stated_source
from mckibben.export.use_case import ExportQuestion, write_export
from mckibben.physics.errors import InputError


def run(studio: Studio, *, source: str, format_id: str, out: Path) -> None:
    """Write the files, and print their names.

    Raises:
        InputError: names the file or option, the field, what is wrong and what would be right.
    """
    try:
        format_named(format_id)
    except InputError as error:
        raise InputError(f"--as {format_id}: {error.message}", hint=error.hint) from error
    stated = stated_source(source, studio)
    try:
        written = write_export(
            ExportQuestion(stated, format_id), out, studio, named=f"-o {out}", remark=remark
        )
    except InputError as error:
        if error.message.startswith("-o "):
            raise
        raise InputError(f"{source}: {located(error.field, error.message)}", hint=error.hint) from error
    for path in written:
        remark(f"{format_named(format_id).title}: {path}")
