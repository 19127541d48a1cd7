"""Measurement files: preview, upload, read back; measurements with hidden effects, to practise on."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Path, Query, Request
from pydantic import Field, StringConstraints
from starlette.exceptions import HTTPException

from mckibben.application.diagnose.mysteries import MysterySummary, Reveal, mysteries, reveal
from mckibben.application.measurement.summary import MeasurementDetails, MeasurementSummary, PreviewResult
from mckibben.documents.strict import Name, Strict
from mckibben.measurement.preparation import LONGEST, MOST
from mckibben.measurement.reading import Correction, read_correction
from mckibben.measurement.reading.correction import MAX_LENGTH
from mckibben.measurement.store import MAX_NAME
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import BeforeWork, StoreDep, StudioDep
from mckibben.server.long_work import whole
from mckibben.server.schemas.common import errors
from mckibben.server.short_jobs import FileRequest, StoredMeasurement

measurements_router = APIRouter(prefix="/api/measurements", tags=["measurements"], route_class=StrictRoute)

# Content types that browsers send; Windows with Excel installed sends vnd.ms-excel for CSV.
_CONTENT_TYPES = (
    "text/csv",
    "text/plain",
    "text/tab-separated-values",
    "application/csv",
    "application/vnd.ms-excel",
    "application/vnd.openxmlformats-officedocument.spreadsheetml.sheet",
    "application/x-matlab-data",
    "application/octet-stream",
)
_TEXTS = ("text/csv", "text/plain", "application/csv")
_BODY = {
    "requestBody": {
        "required": True,
        "description": "The file as it is, up to 64 MB: CSV, JSON, .xlsx, .mat (v5 to v7.3), HDF5 or .tdms.",
        "content": {
            kind: {"schema": {"type": "string", "format": "binary"}}
            | ({"example": request_examples.FILE} if kind in _TEXTS else {})
            for kind in _CONTENT_TYPES
        },
    }
}
_Name = Annotated[
    str,
    Query(
        min_length=1, max_length=MAX_NAME, description="Name of the file, for people.", examples=["run1.csv"]
    ),
]


_Mapping = Annotated[
    str | None,
    Query(
        max_length=MAX_LENGTH,
        description="Corrections by the user, as JSON: 'columns' (header -> channel, unit and sign, "
        "null = not used), 'kind', 'conditions', 'bad_rows' ('refuse' or 'skip'), and the words of the "
        "command line: 'sheet', 'head', 'column' (list of texts such as 'force=-Kraft [kN]'), 'ignore' "
        "(list of columns), 'rest_length', 'load', 'supply', 'strict'; each may be left out.",
        examples=[
            '{"columns": {"p1": {"channel": "pressure", "unit": "bar"}, "x9": null}, "kind": "isobaric"}'
        ],
    ),
]


Identity = Annotated[str, Path(pattern=r"^[0-9a-f]{64}$", description="SHA-256 of the file.")]
_Muscle = Annotated[
    str | None,
    Query(
        pattern=r"^[A-Za-z0-9][A-Za-z0-9./-]{0,63}$",
        description="Id of the muscle preset that the user has chosen, for the questions of 'experiment'.",
        examples=["DMSP-20"],
    ),
]


_Step = Annotated[str, StringConstraints(min_length=1, max_length=LONGEST)]
_Prepare = Query(
    max_length=MOST,
    description="Steps that prepare the data, in their order, as the command line takes them.",
    examples=[["low pass 20 Hz"]],
)


@measurements_router.put(
    "",
    dependencies=[BeforeWork],
    response_model=MeasurementSummary,
    responses=errors(400, 409, 413, 415, 422, 429, 507),
    openapi_extra=_BODY,
)
async def upload_measurement(
    request: Request, name: _Name, studio: StudioDep, store: StoreDep, mapping: _Mapping = None
) -> JsonAnswer:
    """Upload a measurement file; the answer shows how it was read. The same file is stored once.

    With a mapping the measurement gets its own id, so that two readings of a file can be compared.
    """
    correction = _correction(request, mapping)
    async with request.app.state.scratch.received(request) as path:
        file = FileRequest(path, name, correction)
        return JsonAnswer(await whole(request, "file upload", file, studio, store))


@measurements_router.post(
    "/preview",
    dependencies=[BeforeWork],
    response_model=PreviewResult,
    responses=errors(400, 413, 415, 422, 429),
    openapi_extra=_BODY,
)
async def preview_measurement(
    request: Request,
    name: _Name,
    studio: StudioDep,
    store: StoreDep,
    mapping: _Mapping = None,
    muscle: _Muscle = None,
) -> JsonAnswer:
    """How a file would be read: columns, units, rows, kind, experiment. Nothing is stored."""
    correction = _correction(request, mapping)
    async with request.app.state.scratch.received(request) as path:
        file = FileRequest(path, name, correction, muscle)
        return JsonAnswer(await whole(request, "preview", file, studio, store))


def _correction(request: Request, mapping: str | None) -> Correction:
    """The user's corrections of the file of a request."""
    # The body is the file whatever its content type (curl sends urlencoded); only a form wraps it.
    declared = request.headers.get("content-type", "")
    if declared.partition(";")[0].strip().lower() == "multipart/form-data":
        raise HTTPException(415, "Send the file itself as the body, not a form with the file in it.")
    return Correction() if mapping is None else read_correction(mapping)


@measurements_router.get(
    "/{measurement_id}", response_model=MeasurementDetails, responses=errors(404, 422, 429)
)
async def read_measurement(
    measurement_id: Identity,
    request: Request,
    studio: StudioDep,
    store: StoreDep,
    prepare: Annotated[list[_Step] | None, _Prepare] = None,
) -> JsonAnswer:
    """A measurement with its columns in SI, as it was read or after steps that prepare it."""
    wanted = StoredMeasurement(measurement_id, tuple(prepare or ()))
    return JsonAnswer(await whole(request, "measurement", wanted, studio, store))


class RevealRequest(Strict):
    """The user's diagnosis."""

    effects: list[Name] = Field(
        default=[], max_length=64, description="Ids of the effects of the user's model.", examples=[[]]
    )


mysteries_router = APIRouter(prefix="/api/mysteries", tags=["mysteries"], route_class=StrictRoute)


# In worker threads: the library reads the user's folder.
@mysteries_router.get("", response_model=list[MysterySummary], responses=errors(), dependencies=[BeforeWork])
def list_mysteries(studio: StudioDep) -> JsonAnswer:
    """Every mystery with its story and start model; comparisons accept its measurement by id."""
    return JsonAnswer(mysteries(studio.library))


@mysteries_router.post(
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
