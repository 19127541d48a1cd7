"""Studies: many runs of a drive or a task with varied quantities."""

from __future__ import annotations

from fastapi import APIRouter, Request, Response

from mckibben.documents.study import StudyDocument
from mckibben.server import request_examples
from mckibben.server.answer import StrictRoute
from mckibben.server.context import StoreDep, StudioDep
from mckibben.server.long_work import answered
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.studies import StudyAnswer, StudyEvents

router = APIRouter(prefix="/api/studies", tags=["studies"], route_class=StrictRoute)


@router.post(
    "",
    response_model=StudyAnswer,
    responses={**errors(400, 413, 415, 422, 429), **StudyEvents},
    openapi_extra=request_examples.worked("study"),
)
async def run_study(body: StudyDocument, request: Request, studio: StudioDep, store: StoreDep) -> Response:
    """Sweeps, Monte Carlo, sensitivities, optimisation, robust designs; at most 20 000 runs.

    Closing the connection ends the study. Longer ones: ``mckibben study``.
    """
    return await answered(request, "study", body, studio, store)
