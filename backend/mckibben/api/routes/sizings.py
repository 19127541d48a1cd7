"""Drives for a task."""

from __future__ import annotations

from typing import Any

from fastapi import APIRouter, Request, Response

from mckibben.api.answer import JsonAnswer, StrictRoute
from mckibben.api.answers.sizings import prepare_sizing
from mckibben.api.context import StudioDep
from mckibben.api.long_work import events, finished, wants_events
from mckibben.api.schemas.common import errors
from mckibben.api.schemas.simulations import SimulationEvents
from mckibben.api.schemas.sizing_answer import SizingAnswer
from mckibben.api.schemas.sizings import SizingTask

router = APIRouter(prefix="/api/sizings", tags=["sizings"], route_class=StrictRoute)
_RESPONSES: dict[int | str, dict[str, Any]] = {**errors(400, 413, 415, 422), **SimulationEvents}


@router.post("", response_model=SizingAnswer, responses=_RESPONSES)
async def size_drives(body: SizingTask, request: Request, studio: StudioDep) -> Response:
    """Ranked drives of the catalogue for a task, and why not the others; closing ends the search."""
    work = prepare_sizing(body, studio)
    if wants_events(request):
        return events(work)
    return JsonAnswer(await finished(request, work))
