"""A model compared with measurements."""

from __future__ import annotations

from fastapi import APIRouter

from mckibben.application.compare import compare
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import StoreDep, StudioDep
from mckibben.server.questions.models import model_question
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.comparisons import ComparisonAnswer, ComparisonRequest

router = APIRouter(prefix="/api/comparisons", tags=["comparisons"], route_class=StrictRoute)


# In a worker thread: a fit takes longer than other requests should wait.
@router.post(
    "",
    response_model=ComparisonAnswer,
    responses=errors(400, 404, 413, 415, 422),
    openapi_extra=request_examples.worked("comparison"),
)
def compare_with_measurement(body: ComparisonRequest, studio: StudioDep, store: StoreDep) -> JsonAnswer:
    """The model's error on measurements, with or without a fit: figures, where it fails, the points."""
    return JsonAnswer(compare(model_question(body, studio, store), fit=body.fit))
