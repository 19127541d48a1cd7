"""Drives for a task, and a report of one of them."""

from __future__ import annotations

from typing import Any

from fastapi import APIRouter, Request, Response
from fastapi.responses import HTMLResponse

from mckibben.application.size.size import SizingResult
from mckibben.documents.task import SizingTask
from mckibben.server import request_examples
from mckibben.server.answer import StrictRoute
from mckibben.server.context import StoreDep, StudioDep
from mckibben.server.long_work import answered, whole
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.reports import ReportAnswer
from mckibben.server.schemas.simulations import SimulationEvents
from mckibben.server.schemas.sizing_reports import SizingReportRequest

router = APIRouter(prefix="/api/sizings", tags=["sizings"], route_class=StrictRoute)
_RESPONSES: dict[int | str, dict[str, Any]] = {**errors(400, 413, 415, 422, 429), **SimulationEvents}


@router.post(
    "", response_model=SizingResult, responses=_RESPONSES, openapi_extra=request_examples.worked("task")
)
async def size_drives(body: SizingTask, request: Request, studio: StudioDep, store: StoreDep) -> Response:
    """Ranked drives for a task, and rejected ones with reasons; closing the connection ends the search."""
    return await answered(request, "sizing", body, studio, store)


@router.post(
    "/reports",
    response_class=Response,  # errors are still JSON
    responses={**ReportAnswer, **errors(400, 413, 415, 422, 429)},
    openapi_extra=request_examples.worked("sizing_report"),
)
async def write_sizing_report(
    body: SizingReportRequest, request: Request, studio: StudioDep, store: StoreDep
) -> Response:
    """A new search, and one of its drives as a file for archive and print; disconnecting ends the search."""
    return HTMLResponse(await whole(request, "sizing report", body, studio, store))
