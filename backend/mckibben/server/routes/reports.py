"""Reports: one HTML file with data, model, error and verdict."""

from __future__ import annotations

from fastapi import APIRouter, Request, Response
from fastapi.responses import HTMLResponse

from mckibben.application.asked import asked
from mckibben.application.diagnoses import TIME_LIMIT
from mckibben.application.reports import Told, prepare
from mckibben.documents.drive_reading import drive_of
from mckibben.documents.studio import Studio
from mckibben.measurement.store import MeasurementStore
from mckibben.physics.errors import InputError
from mckibben.server.answer import StrictRoute
from mckibben.server.context import StoreDep, StudioDep
from mckibben.server.long_work import finished, prepared
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.reports import ReportAnswer, ReportRequest

router = APIRouter(prefix="/api/reports", tags=["reports"], route_class=StrictRoute)


@router.post(
    "",
    response_class=Response,  # errors are JSON all the same
    responses={**ReportAnswer, **errors(400, 404, 413, 415, 422)},
)
async def write_report(body: ReportRequest, request: Request, studio: StudioDep, store: StoreDep) -> Response:
    """The comparison and the diagnosis of a model as one file to keep and to print."""
    question = await prepared(request, asked, body, studio, store)
    told = await prepared(request, _told, body, studio, store)
    work = await prepared(request, prepare, question, studio, told, diagnose=body.diagnose)
    return HTMLResponse(await finished(request, work, str.encode, time_limit=TIME_LIMIT))


def _told(body: ReportRequest, studio: Studio, store: MeasurementStore) -> Told:
    history = []
    for place, step in enumerate(body.history):
        changed = {"effects": step.effects, "freed": step.freed, "muscle": step.muscle or body.muscle}
        try:
            history.append((step.label, asked(body.model_copy(update=changed), studio, store)))
        except InputError as error:
            field = f"history.{place}.{error.field or 'effects'}"
            raise InputError(error.message, field=field, hint=error.hint, code=error.code) from error
    unverified = {} if body.drive is None else drive_of(body.drive, studio, measured=True).unverified
    return Told(body.title, history, unverified, body.fit)
