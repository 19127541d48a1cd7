"""Measurements with hidden effects, to practise on."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Path
from pydantic import Field

from mckibben.application.diagnose.mysteries import MysterySummary, Reveal, mysteries, reveal
from mckibben.documents.strict import Name, Strict
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import BeforeWork, StudioDep
from mckibben.server.schemas.common import errors


class RevealRequest(Strict):
    """The user's diagnosis."""

    effects: list[Name] = Field(
        default=[], max_length=64, description="Ids of the effects of the user's model.", examples=[[]]
    )


router = APIRouter(prefix="/api/mysteries", tags=["mysteries"], route_class=StrictRoute)


# In worker threads: the library reads the user's folder.
@router.get("", response_model=list[MysterySummary], responses=errors(), dependencies=[BeforeWork])
def list_mysteries(studio: StudioDep) -> JsonAnswer:
    """Every mystery with its story and start model; comparisons accept its measurement by id."""
    return JsonAnswer(mysteries(studio.library))


@router.post(
    "/{mystery_id}/reveal",
    response_model=Reveal,
    responses=errors(400, 404, 413, 415, 422),
    openapi_extra=request_examples.worked("reveal"),
)
def reveal_mystery(
    mystery_id: Annotated[str, Path(max_length=64, description="Its id.", examples=["the-dip"])],
    body: RevealRequest,
    studio: StudioDep,
) -> JsonAnswer:
    """The hidden effects of a mystery, compared with the user's diagnosis."""
    return JsonAnswer(reveal(studio.library, mystery_id, body.effects))
