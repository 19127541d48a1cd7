"""A model beside a measurement."""

from __future__ import annotations

from fastapi import APIRouter

from mckibben.api.answer import JsonAnswer, StrictRoute
from mckibben.api.answers.comparisons import comparison_answer
from mckibben.api.answers.measured import find_points
from mckibben.api.context import StoreDep, StudioDep
from mckibben.api.schemas.common import errors
from mckibben.api.schemas.comparisons import ComparisonAnswer, ComparisonRequest
from mckibben.api.schemas.convert import given_muscle

router = APIRouter(prefix="/api/comparisons", tags=["comparisons"], route_class=StrictRoute)


# In a worker thread: a fit takes longer than other requests should wait.
@router.post("", response_model=ComparisonAnswer, responses=errors(400, 404, 413, 415, 422))
def compare_with_measurement(body: ComparisonRequest, studio: StudioDep, store: StoreDep) -> JsonAnswer:
    """The model's error on a measurement in numbers, with or without a fit, and the points of both."""
    start = studio.start_model(given_muscle(body.muscle), body.effects)
    points = find_points(body.measurement, library=studio.library, store=store)
    return JsonAnswer(comparison_answer(studio, start, points, fit=body.fit, free=body.free))
