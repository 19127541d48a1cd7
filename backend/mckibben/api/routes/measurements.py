"""Measurement files: send one, read one back."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Path, Query, Request
from fastapi.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException

from mckibben.api.answer import JsonAnswer, StrictRoute
from mckibben.api.answers.measurements import measurement_answer
from mckibben.api.context import StoreDep
from mckibben.api.schemas.common import errors
from mckibben.api.schemas.measurements import MeasurementAnswer, MeasurementDetail
from mckibben.api.store import MAX_NAME

router = APIRouter(prefix="/api/measurements", tags=["measurements"], route_class=StrictRoute)

# What browsers say of a CSV file; Windows with Excel installed says vnd.ms-excel.
_CONTENT_TYPES = (
    "text/csv",
    "text/plain",
    "text/tab-separated-values",
    "application/csv",
    "application/vnd.ms-excel",
    "application/octet-stream",
)
_BODY = {
    "requestBody": {
        "required": True,
        "description": "The file as it is, up to 64 MB.",
        "content": {kind: {"schema": {"type": "string", "format": "binary"}} for kind in _CONTENT_TYPES},
    }
}
_Name = Annotated[
    str,
    Query(
        min_length=1, max_length=MAX_NAME, description="Name of the file, for people.", examples=["run1.csv"]
    ),
]


@router.put(
    "",
    response_model=MeasurementAnswer,
    responses=errors(400, 409, 413, 415, 422),
    openapi_extra=_BODY,
)
async def upload_measurement(request: Request, name: _Name, store: StoreDep) -> JsonAnswer:
    """Send a measurement file; the answer says how it was understood. Sent twice it is kept once."""
    # The body is the file whatever a client calls it (curl says urlencoded); only a form wraps it.
    declared = request.headers.get("content-type", "")
    if declared.partition(";")[0].strip().lower() == "multipart/form-data":
        raise HTTPException(415, "Send the file itself as the body, not a form with the file in it.")
    content = await request.body()
    measurement = await run_in_threadpool(store.put, content, name)
    return JsonAnswer(measurement_answer(measurement))


@router.get("/{measurement_id}", response_model=MeasurementDetail, responses=errors(404, 422))
def read_measurement(
    measurement_id: Annotated[str, Path(pattern=r"^[0-9a-f]{64}$", description="SHA-256 of the file.")],
    store: StoreDep,
) -> JsonAnswer:
    """A measurement with its columns in SI."""
    return JsonAnswer(measurement_answer(store.get(measurement_id), columns=True))
