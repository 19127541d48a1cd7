"""Studies: many runs of a drive or a task with varied quantities."""

from __future__ import annotations

from collections.abc import Callable

from fastapi import APIRouter, Request, Response

from mckibben.application.json_text import to_json
from mckibben.application.study import StudyResult, prepare, study_question
from mckibben.documents.studio import Studio
from mckibben.documents.study import StudyDocument
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import StudioDep
from mckibben.server.long_work import events, finished, prepared, wants_events
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.studies import StudyAnswer, StudyEvents
from mckibben.simulation.outcome import Watch

router = APIRouter(prefix="/api/studies", tags=["studies"], route_class=StrictRoute)
MOST_RUNS = 20_000  # of a request: a minute of both cores, and a table that a page can hold
_TIME_LIMIT = 900.0  # s


@router.post(
    "",
    response_model=StudyAnswer,
    responses={**errors(400, 413, 415, 422), **StudyEvents},
    openapi_extra=request_examples.worked("study"),
)
async def run_study(body: StudyDocument, request: Request, studio: StudioDep) -> Response:
    """Sweeps, Monte Carlo, sensitivities, optimisation, robust designs; at most 20 000 runs.

    Closing the connection ends the study. Longer ones: ``mckibben study``.
    """
    work = await prepared(request, _study_of, body, studio)
    if wants_events(request):
        return events(work, time_limit=_TIME_LIMIT)
    return JsonAnswer(await finished(request, work, to_json, time_limit=_TIME_LIMIT))


def _study_of(body: StudyDocument, studio: Studio) -> Callable[[Watch], StudyResult]:
    return prepare(study_question(body, studio, MOST_RUNS))
