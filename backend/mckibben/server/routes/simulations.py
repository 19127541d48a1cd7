"""Transient simulation of a drive."""

from __future__ import annotations

from fastapi import APIRouter, Request, Response

from mckibben.application.run.simulate import SimulationResult
from mckibben.server import request_examples
from mckibben.server.answer import StrictRoute
from mckibben.server.context import StoreDep, StudioDep
from mckibben.server.long_work import answered, contained
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.simulations import SimulationEvents, SimulationRequest

router = APIRouter(prefix="/api/simulations", tags=["simulations"], route_class=StrictRoute)


@router.post(
    "",
    response_model=SimulationResult,
    responses={**errors(400, 413, 415, 422, 429), **SimulationEvents},
    openapi_extra=request_examples.worked("simulation"),
)
async def simulate_drive(
    body: SimulationRequest, request: Request, studio: StudioDep, store: StoreDep
) -> Response:
    """Motion, pressures, force, flows and timing table of a drive; closing the connection ends the run."""
    quick = not contained(request, body)
    return await answered(request, "simulation", body, studio, store, quick=quick)
