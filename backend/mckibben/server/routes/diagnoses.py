"""Which physical effect a model is missing."""

from __future__ import annotations

from fastapi import APIRouter, Request, Response

from mckibben.application.diagnose import TIME_LIMIT, prepare
from mckibben.application.json_text import to_json
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import StoreDep, StudioDep
from mckibben.server.long_work import events, finished, prepared, wants_events
from mckibben.server.questions.models import model_question
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.diagnoses import DiagnosisAnswer, DiagnosisEvents, DiagnosisRequest

router = APIRouter(prefix="/api/diagnoses", tags=["diagnoses"], route_class=StrictRoute)


@router.post(
    "",
    response_model=DiagnosisAnswer,
    responses={**errors(400, 404, 413, 415, 422), **DiagnosisEvents},
    openapi_extra=request_examples.worked("diagnosis"),
)
async def diagnose_model(
    body: DiagnosisRequest, request: Request, studio: StudioDep, store: StoreDep
) -> Response:
    """The missing effects with reasons, twins, path and verdict; closing the connection ends the search."""
    question = await prepared(request, model_question, body, studio, store)
    work = await prepared(request, prepare, question, studio)
    if wants_events(request):
        return events(work, time_limit=TIME_LIMIT)
    return JsonAnswer(await finished(request, work, to_json, time_limit=TIME_LIMIT))
