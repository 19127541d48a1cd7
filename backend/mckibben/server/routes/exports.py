"""Exports: a model or drive as files for other programs."""

from __future__ import annotations

from fastapi import APIRouter, Response

from mckibben.export.registry import formats
from mckibben.export.use_case import export
from mckibben.physics.errors import InputError
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import StudioDep
from mckibben.server.questions.exports import export_question
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.exports import ExportAnswer, ExportRequest, FormatsAnswer

router = APIRouter(prefix="/api/exports", tags=["exports"], route_class=StrictRoute)


@router.get("", response_model=FormatsAnswer)
def list_formats() -> JsonAnswer:
    """The formats in which a model or drive can be taken along."""
    return JsonAnswer(
        {
            "formats": [
                {"id": form.id, "title": form.title, "note": form.note, "drives": form.drives}
                for form in formats().values()
            ]
        }
    )


# In a worker thread: writing the derivatives of a drive takes up to a second.
@router.post(
    "",
    response_class=Response,  # errors are still JSON
    responses={**ExportAnswer, **errors(400, 404, 413, 415, 422)},
    openapi_extra=request_examples.worked("export"),
)
def write_export(body: ExportRequest, studio: StudioDep) -> Response:
    """A muscle, a fitted model or a drive in a format; the file names model, sources, range and gaps."""
    question = export_question(body, studio)
    inside = "drive" if body.drive is not None else "model" if body.model is not None else None
    try:
        file = export(question, studio).file
    except InputError as error:
        if inside is not None and error.field not in ("as", "name"):
            raise error.inside(inside) from error
        raise
    # The name is made of letters, digits, '-', '_' and '.'.
    return Response(
        file.content,
        media_type=file.media_type,
        headers={"content-disposition": f'attachment; filename="{file.name}"'},
    )
