"""Studies: many runs of a drive or a task with varied quantities."""

from __future__ import annotations

from fastapi import APIRouter, Request, Response

from mckibben.application.study.file import parquet_bytes
from mckibben.application.study.options import StudyOptions, study_options
from mckibben.application.study.store import StudyStore
from mckibben.application.study.study import StudyResult, study_question
from mckibben.documents.study import StudyDocument
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import StoreDep, StudioDep
from mckibben.server.jobs import MOST_RUNS
from mckibben.server.long_work import answered
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.studies import StudyEvents, StudyKeptAnswer, StudyOptionsRequest

_PARQUET = "application/vnd.apache.parquet"

router = APIRouter(prefix="/api/studies", tags=["studies"], route_class=StrictRoute)


@router.post(
    "",
    response_model=StudyResult,
    responses={**errors(400, 413, 415, 422, 429), **StudyEvents},
    openapi_extra=request_examples.worked("study"),
)
async def run_study(body: StudyDocument, request: Request, studio: StudioDep, store: StoreDep) -> Response:
    """Sweeps, Monte Carlo, sensitivities, optimisation, robust designs; at most 20 000 runs.

    Closing the connection ends the study. Its runs are kept: asked again, also after a restart of the server,
    it goes on from there, and a finished one answers at once. Longer studies: ``mckibben study``.
    """
    return await answered(request, "study", body, studio, store)


@router.post(
    "/options",
    response_model=StudyOptions,
    responses=errors(400, 413, 415, 422),
    openapi_extra=request_examples.worked("study_options"),
)
def list_study_options(body: StudyOptionsRequest, studio: StudioDep) -> JsonAnswer:
    """Quantities that a study of this subject can vary, with their values, and figures it can watch."""
    return JsonAnswer(study_options(body.subject, studio))


@router.post(
    "/kept",
    response_model=StudyKeptAnswer,
    responses=errors(400, 413, 415, 422),
    openapi_extra=request_examples.worked("study"),
)
def count_kept_runs(body: StudyDocument, studio: StudioDep, store: StoreDep) -> JsonAnswer:
    """How many runs of a study are kept from before; asked again, it does not make them again."""
    return JsonAnswer({"runs": StudyStore(store.data).runs(body, studio)})


@router.post(
    "/parquet",
    response_class=Response,
    responses={
        200: {
            "description": "The runs of the study that are kept, SI.",
            "content": {_PARQUET: {"schema": {"type": "string", "format": "binary"}}},
        },
        **errors(400, 413, 415, 422),
    },
    openapi_extra=request_examples.worked("study"),
)
def write_parquet(body: StudyDocument, studio: StudioDep, store: StoreDep) -> Response:
    """The table of a study as Parquet, of the runs that are kept; none is made.

    Needs pyarrow where the server runs; ``/api/studies/options`` says whether it is there.
    """
    question = study_question(body, studio, MOST_RUNS)
    content = parquet_bytes(StudyStore(store.data).result(question))
    return Response(content, media_type=_PARQUET)
