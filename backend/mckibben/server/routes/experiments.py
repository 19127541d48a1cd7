"""The experiments behind measurements: what is said, what is assumed, what is to be asked."""

from __future__ import annotations

from fastapi import APIRouter

from mckibben.application.experiment_form import experiment_forms
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import StoreDep, StudioDep
from mckibben.server.questions.models import model_question, said_measurements
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.diagnoses import DiagnosisRequest
from mckibben.server.schemas.experiments import ExperimentAnswer

router = APIRouter(prefix="/api/experiments", tags=["experiments"], route_class=StrictRoute)


# In a worker thread: it reads the measurements.
@router.post(
    "",
    response_model=ExperimentAnswer,
    responses=errors(400, 404, 413, 415, 422),
    openapi_extra=request_examples.worked("experiments"),
)
def describe_experiments(body: DiagnosisRequest, studio: StudioDep, store: StoreDep) -> JsonAnswer:
    """The experiment of each measurement of a diagnosis, before it is asked for."""
    measurements = said_measurements(body, studio, store)
    ids = [item.id for item in body.chosen()]
    return JsonAnswer(
        experiment_forms(
            list(zip(ids, measurements, strict=True)),
            lambda: model_question(body, studio, store),
            studio,
        )
    )
