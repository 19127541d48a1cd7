"""Exports: a model or drive as files for other programs."""

from __future__ import annotations

import orjson
from fastapi import APIRouter, Request, Response

from mckibben.export.registry import formats
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import StoreDep, StudioDep
from mckibben.server.long_work import contained, whole
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.exports import ExportAnswer, ExportRequest, FormatsAnswer

exports_router = APIRouter(prefix="/api/exports", tags=["exports"], route_class=StrictRoute)


@exports_router.get("", response_model=FormatsAnswer)
def list_formats() -> JsonAnswer:
    """The formats in which a model or drive can be taken along."""
    return JsonAnswer(
        {
            "formats": [
                {
                    "id": form.id,
                    "title": form.title,
                    "note": form.note,
                    "drives": form.drives,
                    "muscles": form.muscles,
                }
                for form in formats().values()
            ]
        }
    )


@exports_router.post(
    "",
    response_class=Response,  # errors are still JSON
    responses={**ExportAnswer, **errors(400, 404, 413, 415, 422, 429)},
    openapi_extra=request_examples.worked("export"),
)
async def write_export(body: ExportRequest, request: Request, studio: StudioDep, store: StoreDep) -> Response:
    """A muscle, a fitted model or a drive in a format; the file names model, sources, range and gaps."""
    form = formats().get(body.format_id)
    if form is not None and form.compiles:
        written = await whole(request, "compiled export", body, studio, store)
    else:
        written = await whole(request, "export", body, studio, store, quick=not contained(request, body))
    about, _, content = written.partition(b"\n")
    file = orjson.loads(about)
    # The name is made of letters, digits, '-', '_' and '.'.
    return Response(
        content,
        media_type=file["media_type"],
        headers={"content-disposition": f'attachment; filename="{file["name"]}"'},
    )
