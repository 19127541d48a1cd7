"""Inverse questions."""

from __future__ import annotations

from fastapi import APIRouter, Request

from mckibben.application.curves.inverse import InverseFinding
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import StoreDep, StudioDep
from mckibben.server.long_work import contained, whole
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.inverse import InverseRequest

router = APIRouter(prefix="/api/inverse", tags=["inverse"], route_class=StrictRoute)


@router.post(
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
