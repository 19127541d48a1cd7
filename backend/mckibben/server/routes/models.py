"""A model and its measurements: comparisons, diagnoses, the experiments behind them, reports."""

from __future__ import annotations

from fastapi import APIRouter, Request, Response
from fastapi.responses import HTMLResponse

from mckibben.application.compare.compare import ComparisonResult
from mckibben.application.diagnose.result import DiagnosisResult
from mckibben.application.measurement.form import ExperimentForms
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import StoreDep, StudioDep
from mckibben.server.long_work import answered, whole
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.models import (
    ComparisonRequest,
    DiagnosisEvents,
    DiagnosisRequest,
    ReportAnswer,
    ReportRequest,
)

comparisons_router = APIRouter(prefix="/api/comparisons", tags=["comparisons"], route_class=StrictRoute)

diagnoses_router = APIRouter(prefix="/api/diagnoses", tags=["diagnoses"], route_class=StrictRoute)

experiments_router = APIRouter(prefix="/api/experiments", tags=["experiments"], route_class=StrictRoute)

reports_router = APIRouter(prefix="/api/reports", tags=["reports"], route_class=StrictRoute)


@comparisons_router.post(
    "",
    response_model=ComparisonResult,
    responses=errors(400, 404, 413, 415, 422, 429),
    openapi_extra=request_examples.worked("comparison"),
)
async def compare_with_measurement(
    body: ComparisonRequest, request: Request, studio: StudioDep, store: StoreDep
) -> JsonAnswer:
    """The model's error on measurements, with or without a fit: figures, where it fails, the points."""
    return JsonAnswer(await whole(request, "comparison", body, studio, store))


@diagnoses_router.post(
    "",
    response_model=DiagnosisResult,
    responses={**errors(400, 404, 413, 415, 422, 429), **DiagnosisEvents},
    openapi_extra=request_examples.worked("diagnosis"),
)
async def diagnose_model(
    body: DiagnosisRequest, request: Request, studio: StudioDep, store: StoreDep
) -> Response:
    """The missing effects with reasons, twins, path and verdict; closing the connection ends the search."""
    return await answered(request, "diagnosis", body, studio, store)


@experiments_router.post(
    "",
    response_model=ExperimentForms,
    responses=errors(400, 404, 413, 415, 422, 429),
    openapi_extra=request_examples.worked("experiments"),
)
async def describe_experiments(
    body: DiagnosisRequest, request: Request, studio: StudioDep, store: StoreDep
) -> JsonAnswer:
    """The experiment of each measurement of a diagnosis, before it is asked for."""
    return JsonAnswer(await whole(request, "experiment form", body, studio, store))


@reports_router.post(
    "",
    response_class=Response,  # errors are still JSON
    responses={**ReportAnswer, **errors(400, 404, 413, 415, 422, 429)},
    openapi_extra=request_examples.worked("report"),
)
async def write_report(body: ReportRequest, request: Request, studio: StudioDep, store: StoreDep) -> Response:
    """The comparison and the diagnosis of a model as one file for archive and print."""
    return HTMLResponse(await whole(request, "report", body, studio, store))
