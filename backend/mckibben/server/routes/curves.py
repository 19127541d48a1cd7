"""The static characteristics of one muscle, inverse questions, and joints at rest."""

from __future__ import annotations

from fastapi import APIRouter, Request
from fastapi.concurrency import run_in_threadpool

from mckibben.application.curves.curves import CurvesResult, curves
from mckibben.application.curves.inverse import InverseFinding
from mckibben.application.joint.joint import JointResult
from mckibben.documents.asked import AskedLine, read_asked
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import StoreDep, StudioDep
from mckibben.server.long_work import contained, whole
from mckibben.server.questions import curves_question
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.curves import AskedRequest, CurvesRequest, InverseRequest, JointRequest

curves_router = APIRouter(prefix="/api/curves", tags=["curves"], route_class=StrictRoute)

joints_router = APIRouter(prefix="/api/joints", tags=["joints"], route_class=StrictRoute)

inverse_router = APIRouter(prefix="/api/inverse", tags=["inverse"], route_class=StrictRoute)

asked_router = APIRouter(prefix="/api/asked", tags=["curves"], route_class=StrictRoute)


# In a worker thread: the library reads the user's folder.
@asked_router.post(
    "",
    response_model=AskedLine,
    responses=errors(400, 413, 415, 422),
    openapi_extra=request_examples.worked("asked"),
)
def read_question(body: AskedRequest, studio: StudioDep) -> JsonAnswer:
    """What a question typed in one line states, and what of it is not read."""
    return JsonAnswer(read_asked(body.text, [preset.id for preset in studio.library.list("muscles")]))


@curves_router.post(
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


@inverse_router.post(
    "",
    response_model=InverseFinding,
    responses=errors(400, 413, 415, 422, 429),
    openapi_extra=request_examples.worked_each("questions"),
)
async def answer_question(
    body: InverseRequest, request: Request, studio: StudioDep, store: StoreDep
) -> JsonAnswer:
    """A pressure, contraction, working range or stroke pressure, with the limits it crosses."""
    quick = not contained(request, body)
    return JsonAnswer(await whole(request, "inverse question", body, studio, store, quick=quick))


@joints_router.post(
    "",
    response_model=JointResult,
    responses=errors(400, 413, 415, 422, 429),
    openapi_extra=request_examples.worked("joint"),
)
async def compute_joint(
    body: JointRequest, request: Request, studio: StudioDep, store: StoreDep
) -> JsonAnswer:
    """Torque and stiffness over the angle, resting angles, and pressures for an angle and a stiffness."""
    quick = not contained(request, body)
    return JsonAnswer(await whole(request, "joint", body, studio, store, quick=quick))
