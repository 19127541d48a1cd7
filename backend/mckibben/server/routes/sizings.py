"""Drives for a task, and a report of one of them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from fastapi import APIRouter, Request, Response
from fastapi.responses import HTMLResponse

from mckibben.application.json_text import to_json
from mckibben.application.size import SizingResult, prepare, sizing_question
from mckibben.documents.studio import Studio
from mckibben.documents.task import SizingTask
from mckibben.report.sizing.gather import prepare_report
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import StudioDep
from mckibben.server.long_work import events, finished, prepared, wants_events
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.reports import ReportAnswer
from mckibben.server.schemas.simulations import SimulationEvents
from mckibben.server.schemas.sizing_answer import SizingAnswer
from mckibben.server.schemas.sizing_reports import SizingReportRequest
from mckibben.simulation.outcome import Watch

router = APIRouter(prefix="/api/sizings", tags=["sizings"], route_class=StrictRoute)
_RESPONSES: dict[int | str, dict[str, Any]] = {**errors(400, 413, 415, 422), **SimulationEvents}


@router.post(
    "", response_model=SizingAnswer, responses=_RESPONSES, openapi_extra=request_examples.worked("task")
)
async def size_drives(body: SizingTask, request: Request, studio: StudioDep) -> Response:
    """Ranked drives for a task, and rejected ones with reasons; closing the connection ends the search."""
    work = await prepared(request, _search_of, body, studio)
    if wants_events(request):
        return events(work)
    return JsonAnswer(await finished(request, work, to_json))


def _search_of(body: SizingTask, studio: Studio) -> Callable[[Watch], SizingResult]:
    return prepare(sizing_question(body, studio))


@router.post(
    "/reports",
    response_class=Response,  # errors are still JSON
    responses={**ReportAnswer, **errors(400, 413, 415, 422)},
    openapi_extra=request_examples.worked("sizing_report"),
)
async def write_sizing_report(body: SizingReportRequest, request: Request, studio: StudioDep) -> Response:
    """A new search, and one of its drives as a file for archive and print; disconnecting ends the search."""
    work = await prepared(
        request, prepare_report, body.task, studio, proposal=body.proposal, title=body.title
    )
    return HTMLResponse(await finished(request, work, str.encode))
