"""What an order code of a muscle means."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Path

from mckibben.application.model.order_code import OrderedMuscle, ordered_muscle
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import StudioDep
from mckibben.server.schemas.common import errors

router = APIRouter(prefix="/api/order-codes", tags=["presets"], route_class=StrictRoute)


# In a worker thread: the library reads the user's folder.
@router.get("/{code:path}", response_model=OrderedMuscle, responses=errors(404, 422))
def read_order_code(
    code: Annotated[str, Path(max_length=100, description="As ordered.", examples=["DMSP-20-300N-RM-CM"])],
    studio: StudioDep,
) -> JsonAnswer:
    """Preset and length that an order code names, and what its parts mean.

    The field of an error names the part that is not understood by its place between the hyphens:
    ``code.2`` of ``DMSP-20-300X-RM`` is ``300X``.
    """
    return JsonAnswer(ordered_muscle(code, studio))
