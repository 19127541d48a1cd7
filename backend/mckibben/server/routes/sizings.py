"""Drives for a task, and one of them written down."""

from __future__ import annotations

from typing import Any

from fastapi import APIRouter, Request, Response
from fastapi.responses import HTMLResponse

from mckibben.application.sizing_reports import prepare_report
from mckibben.application.sizings import prepare_sizing
from mckibben.documents.task import SizingTask
from mckibben.server.answer import JsonAnswer, StrictRoute, to_json
from mckibben.server.context import StudioDep
from mckibben.server.long_work import events, finished, prepared, wants_events
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.reports import ReportAnswer
from mckibben.server.schemas.simulations import SimulationEvents
from mckibben.server.schemas.sizing_answer import SizingAnswer
from mckibben.server.schemas.sizing_reports import SizingReportRequest

router = APIRouter(prefix="/api/sizings", tags=["sizings"], route_class=StrictRoute)
_RESPONSES: dict[int | str, dict[str, Any]] = {**errors(400, 413, 415, 422), **SimulationEvents}


@router.post("", response_model=SizingAnswer, responses=_RESPONSES)
async def size_drives(body: SizingTask, request: Request, studio: StudioDep) -> Response:
    """Ranked drives of the catalogue for a task, and why not the others; closing ends the search."""
    work = await prepared(request, prepare_sizing, body, studio)
    if wants_events(request):
        return events(work)
    return JsonAnswer(await finished(request, work, to_json))


@router.post(
    "/reports",
    response_class=Response,  # errors are JSON all the same
    responses={**ReportAnswer, **errors(400, 413, 415, 422)},
)
async def write_sizing_report(body: SizingReportRequest, request: Request, studio: StudioDep) -> Response:
    """The search once more and one of its drives as one file to keep and to print; closing ends it."""
    work = await prepared(
        request, prepare_report, body.task, studio, proposal=body.proposal, title=body.title
    )
    return HTMLResponse(await finished(request, work, str.encode))
