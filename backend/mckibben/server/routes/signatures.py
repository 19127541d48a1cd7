"""The atlas of effects: what each leaves in the residual."""

from __future__ import annotations

from fastapi import APIRouter

from mckibben.application.diagnose.signatures import AtlasQuestion, Signatures, signatures
from mckibben.documents.convert import stated_muscle
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import StudioDep
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.signatures import SignatureRequest

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
