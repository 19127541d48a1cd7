"""The atlas of effects: what each leaves in the residual."""

from __future__ import annotations

from fastapi import APIRouter
from pydantic import Field

from mckibben.application.diagnose.signatures import AtlasQuestion, Signatures, signatures
from mckibben.documents.muscle import MuscleInput
from mckibben.documents.quantity import PositivePressure
from mckibben.documents.start_model import stated_muscle
from mckibben.documents.strict import Strict
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import StudioDep
from mckibben.server.schemas.common import errors


class SignatureRequest(Strict):
    """An effect on a muscle."""

    muscle: MuscleInput = Field(description="The muscle.")
    effect: str = Field(description="Id of the effect.")
    values: dict[str, float] = Field(
        default_factory=dict, description="Its parameters in SI; missing ones take their usual size."
    )
    pressure: PositivePressure | None = Field(
        None, description="Largest gauge pressure of the tests; null: the muscle's limit, else 6 bar."
    )


router = APIRouter(prefix="/api/signatures", tags=["effects"], route_class=StrictRoute)


@router.post(
    "",
    response_model=Signatures,
    responses=errors(400, 413, 415, 422),
    openapi_extra=request_examples.worked("signatures"),
)
def draw_signatures(body: SignatureRequest, studio: StudioDep) -> JsonAnswer:
    """What an effect leaves in the residual of each kind of test that shows it, on this muscle."""
    start = studio.start_model(stated_muscle(body.muscle), {})
    question = AtlasQuestion(start, body.effect, body.values, body.pressure)
    return JsonAnswer(signatures(question, studio))
