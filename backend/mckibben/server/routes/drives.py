"""Drives: simulations, linearisations, sizings, studies."""

from __future__ import annotations

from typing import Any

from fastapi import APIRouter, Request, Response
from fastapi.responses import HTMLResponse

from mckibben.application.linear.result import LinearResult
from mckibben.application.run.simulate import SimulationResult
from mckibben.application.size.size import SizingResult
from mckibben.application.study.file import parquet_bytes
from mckibben.application.study.options import StudyOptions, study_options
from mckibben.application.study.study import StudyResult, study_question
from mckibben.documents.study import StudyDocument
from mckibben.documents.task import SizingTask
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import StoreDep, StudiesDep, StudioDep
from mckibben.server.jobs import MOST_RUNS
from mckibben.server.long_work import answered, contained, whole
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.drives import (
    LinearisationRequest,
    SimulationEvents,
    SimulationRequest,
    SizingReportRequest,
    StudyEvents,
    StudyKeptAnswer,
    StudyOptionsRequest,
)
from mckibben.server.schemas.models import ReportAnswer

simulations_router = APIRouter(prefix="/api/simulations", tags=["simulations"], route_class=StrictRoute)

linearisations_router = APIRouter(
    prefix="/api/linearisations", tags=["linearisations"], route_class=StrictRoute
)

sizings_router = APIRouter(prefix="/api/sizings", tags=["sizings"], route_class=StrictRoute)
_RESPONSES: dict[int | str, dict[str, Any]] = {**errors(400, 413, 415, 422, 429), **SimulationEvents}

_PARQUET = "application/vnd.apache.parquet"

studies_router = APIRouter(prefix="/api/studies", tags=["studies"], route_class=StrictRoute)


@simulations_router.post(
    "",
    response_model=SimulationResult,
    responses={**errors(400, 413, 415, 422, 429), **SimulationEvents},
    openapi_extra=request_examples.worked("simulation"),
)
async def simulate_drive(
    body: SimulationRequest, request: Request, studio: StudioDep, store: StoreDep
) -> Response:
    """Motion, pressures, force, flows and timing table of a drive; closing the connection ends the run."""
    quick = not contained(request, body)
    return await answered(request, "simulation", body, studio, store, quick=quick)


@linearisations_router.post(
    "",
    response_model=LinearResult,
    responses={**errors(400, 413, 415, 422, 429), **SimulationEvents},
    openapi_extra=request_examples.worked("linearisation"),
)
async def linearise_drive(
    body: LinearisationRequest, request: Request, studio: StudioDep, store: StoreDep
) -> Response:
    """Linear models of a drive at an operating point; closing the connection ends sweep and design."""
    quick = body.design is None and not contained(request, body)
    return await answered(request, "linear view", body, studio, store, quick=quick)


@sizings_router.post(
    "", response_model=SizingResult, responses=_RESPONSES, openapi_extra=request_examples.worked("task")
)
async def size_drives(body: SizingTask, request: Request, studio: StudioDep, store: StoreDep) -> Response:
    """Ranked drives for a task, and rejected ones with reasons; closing the connection ends the search."""
    return await answered(request, "sizing", body, studio, store)


@sizings_router.post(
    "/reports",
    response_class=Response,  # errors are still JSON
    responses={**ReportAnswer, **errors(400, 413, 415, 422, 429)},
    openapi_extra=request_examples.worked("sizing_report"),
)
async def write_sizing_report(
    body: SizingReportRequest, request: Request, studio: StudioDep, store: StoreDep
) -> Response:
    """A new search, and one of its drives as a file for archive and print; disconnecting ends the search."""
    return HTMLResponse(await whole(request, "sizing report", body, studio, store))


@studies_router.post(
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


@studies_router.post(
    "/options",
    response_model=StudyOptions,
    responses=errors(400, 413, 415, 422),
    openapi_extra=request_examples.worked("study_options"),
)
def list_study_options(body: StudyOptionsRequest, studio: StudioDep) -> JsonAnswer:
    """Quantities that a study of this subject can vary, with their values, and figures it can watch."""
    return JsonAnswer(study_options(body.subject, studio))


@studies_router.post(
    "/kept",
    response_model=StudyKeptAnswer,
    responses=errors(400, 413, 415, 422),
    openapi_extra=request_examples.worked("study"),
)
def count_kept_runs(body: StudyDocument, studio: StudioDep, studies: StudiesDep) -> JsonAnswer:
    """How many runs a study plans, and how many are kept from before, which it does not make again."""
    question = study_question(body, studio, MOST_RUNS)
    return JsonAnswer({"runs": studies.runs(question), "planned": question.plan.runs})


@studies_router.post(
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
def write_parquet(body: StudyDocument, studio: StudioDep, studies: StudiesDep) -> Response:
    """The table of a study as Parquet, of the runs that are kept; none is made.

    Needs pyarrow where the server runs; ``/api/studies/options`` says whether it is there.
    """
    question = study_question(body, studio, MOST_RUNS)
    content = parquet_bytes(studies.result(question))
    return Response(content, media_type=_PARQUET)
