"""Linear models of a drive, responses, loop, sweep and controller design."""

from __future__ import annotations

from fastapi import APIRouter, Request, Response

from mckibben.application.linear.result import LinearResult
from mckibben.server import request_examples
from mckibben.server.answer import StrictRoute
from mckibben.server.context import StoreDep, StudioDep
from mckibben.server.long_work import answered, contained
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.linearisations import LinearisationRequest
from mckibben.server.schemas.simulations import SimulationEvents

router = APIRouter(prefix="/api/linearisations", tags=["linearisations"], route_class=StrictRoute)


@router.post(
    "",
    response_model=LinearResult,
    responses={**errors(400, 413, 415, 422, 429), **SimulationEvents},
    openapi_extra=request_examples.worked("linearisation"),
)
async def linearise_drive(
    body: LinearisationRequest, request: Request, studio: StudioDep, store: StoreDep
) -> Response:
    """Linear models of a drive at an operating point; closing the connection ends sweep and design."""
    quick = body.design is None and not contained(request, body)
    return await answered(request, "linear view", body, studio, store, quick=quick)
