"""A model compared with measurements."""

from __future__ import annotations

from fastapi import APIRouter, Request

from mckibben.application.compare.compare import ComparisonResult
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import StoreDep, StudioDep
from mckibben.server.long_work import whole
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.comparisons import ComparisonRequest

router = APIRouter(prefix="/api/comparisons", tags=["comparisons"], route_class=StrictRoute)


@router.post(
    "",
    response_model=ComparisonResult,
    responses=errors(400, 404, 413, 415, 422, 429),
    openapi_extra=request_examples.worked("comparison"),
)
async def compare_with_measurement(
    body: ComparisonRequest, request: Request, studio: StudioDep, store: StoreDep
) -> JsonAnswer:
    """The model's error on measurements, with or without a fit: figures, where it fails, the points."""
    return JsonAnswer(await whole(request, "comparison", body, studio, store))
