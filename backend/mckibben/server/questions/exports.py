"""Conversion of an export request."""

from __future__ import annotations

from dataclasses import replace

from mckibben.documents.convert import stated_muscle
from mckibben.documents.studio import Studio
from mckibben.export.source import of_drive, of_saved, stated_source
from mckibben.export.subject import Stated
from mckibben.export.use_case import ExportQuestion
from mckibben.physics.errors import InputError, fields_inside
from mckibben.server.schemas.exports import ExportRequest


def export_question(body: ExportRequest, studio: Studio) -> ExportQuestion:
    """The question of a request.

    Raises:
        InputError: not exactly one of muscle, model and drive, or one that cannot be used.
    """
    given = [name for name in ("muscle", "model", "drive") if getattr(body, name) is not None]
    if len(given) != 1:
        what = "nothing to take along" if not given else f"{' and '.join(given)} at once"
        raise InputError(what, field=given[1] if given else "muscle", hint="give muscle, model or drive")
    if body.effects is not None and body.muscle is None:
        raise InputError(f"the {given[0]} has its own effects", field="effects", hint="leave it out")
    stated = _stated(body, studio)
    if body.title:
        stated = replace(stated, title=body.title)
    return ExportQuestion(stated, body.format_id, body.name)


def _stated(body: ExportRequest, studio: Studio) -> Stated:
    if body.muscle is not None:
        return Stated(studio.start_model(stated_muscle(body.muscle), body.effects))
    if body.model is not None:
        with fields_inside("model"):
            return of_saved(body.model, studio, "")
    assert body.drive is not None  # noqa: S101 - one of the three is given
    with fields_inside("drive"):
        if isinstance(body.drive, str):
            if body.drive not in {preset.id for preset in studio.library.list("drives")}:
                studio.library.get("drives", body.drive)  # raises with the nearest match
            return stated_source(body.drive, studio)
        return of_drive(body.drive, studio, "")
