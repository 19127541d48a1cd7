"""The experiments behind measurements: what is said, what is assumed, what is to be asked."""

from __future__ import annotations

from fastapi import APIRouter, Request

from mckibben.application.measurement.form import ExperimentForms
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import StoreDep, StudioDep
from mckibben.server.long_work import whole
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.diagnoses import DiagnosisRequest

router = APIRouter(prefix="/api/experiments", tags=["experiments"], route_class=StrictRoute)


@router.post(
    "",
    response_model=ExperimentForms,
    responses=errors(400, 404, 413, 415, 422, 429),
    openapi_extra=request_examples.worked("experiments"),
)
async def describe_experiments(
    body: DiagnosisRequest, request: Request, studio: StudioDep, store: StoreDep
) -> JsonAnswer:
    """The experiment of each measurement of a diagnosis, before it is asked for."""
    return JsonAnswer(await whole(request, "experiment form", body, studio, store))
