"""Reports: one HTML file with data, model, error and verdict."""

from __future__ import annotations

from fastapi import APIRouter, Request, Response
from fastapi.responses import HTMLResponse

from mckibben.application.diagnose import TIME_LIMIT
from mckibben.documents.drive_reading import drive_of
from mckibben.documents.studio import Studio
from mckibben.measurement.store import MeasurementStore
from mckibben.physics.errors import InputError
from mckibben.report.diagnosis.gather import ReportOptions, prepare
from mckibben.server import request_examples
from mckibben.server.answer import StrictRoute
from mckibben.server.context import StoreDep, StudioDep
from mckibben.server.long_work import finished, prepared
from mckibben.server.questions.models import model_question
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.reports import ReportAnswer, ReportRequest

router = APIRouter(prefix="/api/reports", tags=["reports"], route_class=StrictRoute)


@router.post(
    "",
    response_class=Response,  # errors are still JSON
    responses={**ReportAnswer, **errors(400, 404, 413, 415, 422)},
    openapi_extra=request_examples.worked("report"),
)
async def write_report(body: ReportRequest, request: Request, studio: StudioDep, store: StoreDep) -> Response:
    """The comparison and the diagnosis of a model as one file for archive and print."""
    question = await prepared(request, model_question, body, studio, store)
    options = await prepared(request, _options, body, studio, store)
    work = await prepared(request, prepare, question, studio, options, diagnose=body.diagnose)
    return HTMLResponse(await finished(request, work, str.encode, time_limit=TIME_LIMIT))


def _options(body: ReportRequest, studio: Studio, store: MeasurementStore) -> ReportOptions:
    history = []
    for place, step in enumerate(body.history):
        changed = {"effects": step.effects, "freed": step.freed, "muscle": step.muscle or body.muscle}
        try:
            history.append((step.label, model_question(body.model_copy(update=changed), studio, store)))
        except InputError as error:
            raise error.at(error.field or "effects").inside(f"history.{place}") from error
    unverified = {} if body.drive is None else drive_of(body.drive, studio, measured=True).unverified
    return ReportOptions(body.title, history, unverified, body.fit)
