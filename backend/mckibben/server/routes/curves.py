"""The static characteristics of one muscle."""

from __future__ import annotations

from fastapi import APIRouter, Request
from fastapi.concurrency import run_in_threadpool

from mckibben.application.curves.curves import CurvesResult, curves
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import StoreDep, StudioDep
from mckibben.server.long_work import contained, whole
from mckibben.server.questions.curves import curves_question
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.curves import CurvesRequest

router = APIRouter(prefix="/api/curves", tags=["curves"], route_class=StrictRoute)


@router.post(
    "",
    response_model=CurvesResult,
    responses=errors(400, 413, 415, 422, 429),
    openapi_extra=request_examples.worked("curves"),
)
async def compute_curves(
    body: CurvesRequest, request: Request, studio: StudioDep, store: StoreDep
) -> JsonAnswer:
    """Force, stiffness, volume and diameter over the length for each pressure, and their limits."""

    def answer() -> JsonAnswer:
        return JsonAnswer(curves(curves_question(body, studio), studio))

    if studio.is_built_in(body.muscle.preset, body.effects or ()):
        # On the event loop: such an answer takes about as long as the change of thread would.
        return answer()
    if contained(request, body):
        return JsonAnswer(await whole(request, "computation of curves", body, studio, store))
    return await run_in_threadpool(answer)
