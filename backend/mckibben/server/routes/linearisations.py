"""Linear models of a drive, responses, loop, sweep and controller design."""

from __future__ import annotations

from collections.abc import Callable

from fastapi import APIRouter, Request, Response

from mckibben.application.json_text import to_json
from mckibben.application.linear_result import LinearResult
from mckibben.application.linearise import prepare
from mckibben.documents.studio import Studio
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import StudioDep
from mckibben.server.long_work import events, finished, prepared, wants_events
from mckibben.server.questions.linearisations import linear_question
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.linearisations import LinearisationAnswer, LinearisationRequest
from mckibben.server.schemas.simulations import SimulationEvents
from mckibben.simulation.outcome import Watch

router = APIRouter(prefix="/api/linearisations", tags=["linearisations"], route_class=StrictRoute)


@router.post(
    "",
    response_model=LinearisationAnswer,
    responses={**errors(400, 413, 415, 422), **SimulationEvents},
    openapi_extra=request_examples.worked("linearisation"),
)
async def linearise_drive(body: LinearisationRequest, request: Request, studio: StudioDep) -> Response:
    """Linear models of a drive at an operating point; closing the connection ends sweep and design."""
    work = await prepared(request, _work_of, body, studio)
    if wants_events(request):
        return events(work)
    return JsonAnswer(await finished(request, work, to_json))


def _work_of(body: LinearisationRequest, studio: Studio) -> Callable[[Watch], LinearResult]:
    return prepare(linear_question(body, studio))
