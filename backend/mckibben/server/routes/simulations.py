"""Transient simulation of a drive."""

from __future__ import annotations

from collections.abc import Callable

from fastapi import APIRouter, Request, Response

from mckibben.application.json_text import to_json
from mckibben.application.simulate import SimulationResult, prepare
from mckibben.documents.studio import Studio
from mckibben.physics.errors import fields_inside
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import StudioDep
from mckibben.server.long_work import events, finished, prepared, wants_events
from mckibben.server.questions.simulations import simulation_question
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.simulations import SimulationAnswer, SimulationEvents, SimulationRequest
from mckibben.simulation.outcome import Watch

router = APIRouter(prefix="/api/simulations", tags=["simulations"], route_class=StrictRoute)


@router.post(
    "",
    response_model=SimulationAnswer,
    responses={**errors(400, 413, 415, 422), **SimulationEvents},
    openapi_extra=request_examples.worked("simulation"),
)
async def simulate_drive(body: SimulationRequest, request: Request, studio: StudioDep) -> Response:
    """Motion, pressures, force, flows and timing table of a drive; closing the connection ends the run."""
    work = await prepared(request, _run_of, body, studio)
    if wants_events(request):
        return events(work)
    return JsonAnswer(await finished(request, work, to_json))


def _run_of(body: SimulationRequest, studio: Studio) -> Callable[[Watch], SimulationResult]:
    run = prepare(simulation_question(body, studio))

    def work(watch: Watch) -> SimulationResult:
        with fields_inside("drive"):
            return run(watch)

    return work
