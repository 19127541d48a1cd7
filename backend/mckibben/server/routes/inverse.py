"""Inverse questions."""

from __future__ import annotations

from fastapi import APIRouter

from mckibben.application.inverse import answer
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import StudioDep
from mckibben.server.questions.inverse import inverse_question
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.inverse import InverseAnswer, InverseRequest

router = APIRouter(prefix="/api/inverse", tags=["inverse"], route_class=StrictRoute)


@router.post(
    "",
    response_model=InverseAnswer,
    responses=errors(400, 413, 415, 422),
    openapi_extra=request_examples.worked_each("questions"),
)
def answer_question(body: InverseRequest, studio: StudioDep) -> JsonAnswer:
    """A pressure, contraction, working range or stroke pressure, with the limits it crosses."""
    return JsonAnswer(answer(inverse_question(body, studio), studio))
