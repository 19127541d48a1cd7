"""Which physical effect a model is missing."""

from __future__ import annotations

from fastapi import APIRouter, Request, Response

from mckibben.application.diagnose.result import DiagnosisResult
from mckibben.server import request_examples
from mckibben.server.answer import StrictRoute
from mckibben.server.context import StoreDep, StudioDep
from mckibben.server.long_work import answered
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.diagnoses import DiagnosisEvents, DiagnosisRequest

router = APIRouter(prefix="/api/diagnoses", tags=["diagnoses"], route_class=StrictRoute)


@router.post(
    "",
    response_model=DiagnosisResult,
    responses={**errors(400, 404, 413, 415, 422, 429), **DiagnosisEvents},
    openapi_extra=request_examples.worked("diagnosis"),
)
async def diagnose_model(
    body: DiagnosisRequest, request: Request, studio: StudioDep, store: StoreDep
) -> Response:
    """The missing effects with reasons, twins, path and verdict; closing the connection ends the search."""
    return await answered(request, "diagnosis", body, studio, store)
