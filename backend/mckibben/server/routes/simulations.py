"""A drive through time."""

from __future__ import annotations

from fastapi import APIRouter, Request, Response

from mckibben.application.simulations import prepare
from mckibben.server.answer import JsonAnswer, StrictRoute, to_json
from mckibben.server.context import StudioDep
from mckibben.server.long_work import events, finished, prepared, wants_events
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.simulations import SimulationAnswer, SimulationEvents, SimulationRequest

router = APIRouter(prefix="/api/simulations", tags=["simulations"], route_class=StrictRoute)


@router.post(
    "", response_model=SimulationAnswer, responses={**errors(400, 413, 415, 422), **SimulationEvents}
)
async def simulate_drive(body: SimulationRequest, request: Request, studio: StudioDep) -> Response:
    """Position, speed, pressures, force, flows and the timing table of a drive; closing ends the run."""
    work = await prepared(request, prepare, body, studio)
    if wants_events(request):
        return events(work)
    return JsonAnswer(await finished(request, work, to_json))
