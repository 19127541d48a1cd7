"""Reports: one HTML file with data, model, error and verdict."""

from __future__ import annotations

from fastapi import APIRouter, Request, Response
from fastapi.responses import HTMLResponse

from mckibben.server import request_examples
from mckibben.server.answer import StrictRoute
from mckibben.server.context import StoreDep, StudioDep
from mckibben.server.long_work import whole
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.reports import ReportAnswer, ReportRequest

router = APIRouter(prefix="/api/reports", tags=["reports"], route_class=StrictRoute)


@router.post(
    "",
    response_class=Response,  # errors are still JSON
    responses={**ReportAnswer, **errors(400, 404, 413, 415, 422, 429)},
    openapi_extra=request_examples.worked("report"),
)
async def write_report(body: ReportRequest, request: Request, studio: StudioDep, store: StoreDep) -> Response:
    """The comparison and the diagnosis of a model as one file for archive and print."""
    return HTMLResponse(await whole(request, "report", body, studio, store))
