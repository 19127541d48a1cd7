"""Presets: muscles, valves, tubes, fittings, measurements, curves, designs, drives, tasks."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Path

from mckibben.application.keep import keep
from mckibben.application.saved_model import present_model
from mckibben.presets import MusclePreset
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import StoreDep, StudioDep
from mckibben.server.questions.models import model_question
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.presets import (
    FittedMuscleRequest,
    MuscleAnswer,
    PresetAnswer,
    PresetKind,
    PresetsAnswer,
)

router = APIRouter(prefix="/api/presets", tags=["presets"], route_class=StrictRoute)

Kind = Annotated[PresetKind, Path(description="Which presets.")]


# In worker threads: the library reads the user's folder.
@router.get("/{kind}", response_model=PresetsAnswer, responses=errors(404, 422))
def list_presets(kind: Kind, studio: StudioDep) -> JsonAnswer:
    """All presets of a kind with unit, source and grade of each figure, and the files that were refused."""
    return JsonAnswer(
        {
            "kind": kind,
            "presets": [preset.public() for preset in studio.library.list(kind)],
            "problems": [problem._asdict() for problem in studio.library.problems(kind)],
        }
    )


@router.get("/{kind}/{preset_id:path}", response_model=PresetAnswer, responses=errors(404, 422))
def read_preset(
    kind: Kind,
    preset_id: Annotated[str, Path(max_length=64, description="Its id.", examples=["DMSP-20"])],
    studio: StudioDep,
) -> JsonAnswer:
    """One preset."""
    return JsonAnswer(studio.library.get(kind, preset_id).public())


@router.post(
    "/muscles",
    status_code=201,
    response_model=MuscleAnswer,
    responses=errors(400, 409, 413, 415, 422),
    openapi_extra=request_examples.worked("muscle"),
)
def save_muscle(body: MusclePreset, studio: StudioDep) -> JsonAnswer:
    """Save a muscle as a user preset; replaces one of the same id, never a built-in one."""
    saved = studio.library.save_muscle(body.to_document())
    return JsonAnswer(saved.public(), status_code=201)


# In a worker thread: the model is compared with its data.
@router.post(
    "/muscles/fitted",
    status_code=201,
    response_model=MuscleAnswer,
    responses=errors(400, 404, 409, 413, 415, 422),
    openapi_extra=request_examples.worked("fitted_muscle"),
)
def keep_fitted_muscle(body: FittedMuscleRequest, studio: StudioDep, store: StoreDep) -> JsonAnswer:
    """Keep a fitted model as a user preset, as it is, with the covariance and the range of its data."""
    saved = present_model(model_question(body, studio, store), studio)
    return JsonAnswer(keep(saved, studio, id=body.id, title=body.title).public(), status_code=201)
