"""Presets: muscles, valves, tubes, fittings, measurements, curves, designs, drives, tasks; order codes."""

from __future__ import annotations

from typing import Annotated

import orjson
from fastapi import APIRouter, Path, Request
from fastapi.concurrency import run_in_threadpool

from mckibben.application.model.order_code import OrderedMuscle, ordered_muscle
from mckibben.application.model.saved import keep
from mckibben.documents.saved_model import read_saved_model
from mckibben.presets import MusclePreset
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import StoreDep, StudioDep
from mckibben.server.long_work import whole
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.presets import (
    FittedMuscleRequest,
    MuscleAnswer,
    PresetAnswer,
    PresetKind,
    PresetsAnswer,
)

presets_router = APIRouter(prefix="/api/presets", tags=["presets"], route_class=StrictRoute)

Kind = Annotated[PresetKind, Path(description="Which presets.")]

order_codes_router = APIRouter(prefix="/api/order-codes", tags=["presets"], route_class=StrictRoute)


# In worker threads: the library reads the user's folder.
@presets_router.get("/{kind}", response_model=PresetsAnswer, responses=errors(404, 422))
def list_presets(kind: Kind, studio: StudioDep) -> JsonAnswer:
    """All presets of a kind with unit, source and grade of each figure, and the files that were refused."""
    return JsonAnswer(
        {
            "kind": kind,
            "presets": [preset.public() for preset in studio.library.list(kind)],
            "problems": studio.library.problems(kind),
        }
    )


@presets_router.get("/{kind}/{preset_id:path}", response_model=PresetAnswer, responses=errors(404, 422))
def read_preset(
    kind: Kind,
    preset_id: Annotated[str, Path(max_length=64, description="Its id.", examples=["DMSP-20"])],
    studio: StudioDep,
) -> JsonAnswer:
    """One preset."""
    return JsonAnswer(studio.library.get(kind, preset_id).public())


@presets_router.post(
    "/muscles",
    status_code=201,
    response_model=MuscleAnswer,
    responses=errors(400, 409, 413, 415, 422, 507),
    openapi_extra=request_examples.worked("muscle"),
)
def save_muscle(body: MusclePreset, studio: StudioDep) -> JsonAnswer:
    """Save a muscle as a user preset; replaces one of the same id, never a built-in one."""
    saved = studio.library.save_muscle(body.to_document())
    return JsonAnswer(saved.public(), status_code=201)


@presets_router.post(
    "/muscles/fitted",
    status_code=201,
    response_model=MuscleAnswer,
    responses=errors(400, 404, 409, 413, 415, 422, 429, 507),
    openapi_extra=request_examples.worked("fitted_muscle"),
)
async def keep_fitted_muscle(
    body: FittedMuscleRequest, request: Request, studio: StudioDep, store: StoreDep
) -> JsonAnswer:
    """Keep a fitted model as a user preset, as it is, with the covariance and the range of its data."""
    document = await whole(request, "fitted model", body, studio, store)

    def kept() -> JsonAnswer:
        saved = read_saved_model(orjson.loads(document), "the model")
        return JsonAnswer(keep(saved, studio, id=body.id, title=body.title).public(), status_code=201)

    return await run_in_threadpool(kept)


# In a worker thread: the library reads the user's folder.
@order_codes_router.get("/{code:path}", response_model=OrderedMuscle, responses=errors(404, 422))
def read_order_code(
    code: Annotated[str, Path(max_length=100, description="As ordered.", examples=["DMSP-20-300N-RM-CM"])],
    studio: StudioDep,
) -> JsonAnswer:
    """Preset and length that an order code names, and what its parts mean.

    The field of an error names the part that is not understood by its place between the hyphens:
    ``code.2`` of ``DMSP-20-300X-RM`` is ``300X``.
    """
    return JsonAnswer(ordered_muscle(code, studio))
