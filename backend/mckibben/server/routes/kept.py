"""What the user keeps on the disk: list, rename, delete, restore."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Path, Query
from pydantic import Field

from mckibben.application.project import stored as kept
from mckibben.application.project.stored import KeptData, KeptKind, SpaceKind
from mckibben.documents.strict import Strict
from mckibben.measurement.store import MAX_NAME
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import SpaceDep, StoreDep, StudioDep
from mckibben.server.schemas.common import errors


class RenameRequest(Strict):
    """A new name."""

    name: str = Field(
        min_length=1, max_length=MAX_NAME, description="The new name.", examples=["bench 3, 300 mm"]
    )
    was: str | None = Field(
        None, max_length=MAX_NAME, description="The name that the user saw; refused if it is another by now."
    )


kept_router = APIRouter(prefix="/api/kept", tags=["kept"], route_class=StrictRoute)

Kind = Annotated[KeptKind, Path(description="'files' for measurement files, else the kind of preset.")]
Identity = Annotated[
    str,
    Path(
        pattern=r"^[A-Za-z0-9][A-Za-z0-9-]{0,63}$",
        description="Id of the measurement or preset.",
        examples=["bench-3"],
    ),
]


# In worker threads, all of them: they read and write files.
@kept_router.get("", response_model=KeptData, responses=errors())
def list_kept(studio: StudioDep, store: StoreDep, space: SpaceDep) -> JsonAnswer:
    """Measurements and presets of the user, those that can be restored, and what they take."""
    return JsonAnswer(kept.kept(studio, store, space))


@kept_router.patch(
    "/{kind}/{identity}",
    response_model=KeptData,
    responses=errors(400, 404, 409, 413, 415, 422, 507),
    openapi_extra=request_examples.worked("rename"),
)
def rename_kept(
    kind: Kind, identity: Identity, body: RenameRequest, studio: StudioDep, store: StoreDep, space: SpaceDep
) -> JsonAnswer:
    """Give a measurement or preset another name; its id stays. The answer is what is kept now."""
    space.with_room(
        lambda: kept.rename(studio, store, kind=kind, identity=identity, name=body.name, was=body.was)
    )
    return JsonAnswer(kept.kept(studio, store, space))


@kept_router.delete("/{kind}/{identity}", response_model=KeptData, responses=errors(404, 409, 422, 507))
def delete_kept(
    kind: Kind,
    identity: Identity,
    studio: StudioDep,
    store: StoreDep,
    space: SpaceDep,
    erase: Annotated[bool, Query(description="For good and now, also what was deleted before.")] = False,
) -> JsonAnswer:
    """Delete a measurement or preset; it can be restored until its room is needed."""
    kept.delete(studio, store, kind=kind, identity=identity, erase=erase)
    return JsonAnswer(kept.kept(studio, store, space))


@kept_router.delete("/space/bin/{kind}", response_model=KeptData, responses=errors(404, 409, 422, 503, 507))
def erase_deleted(
    kind: Annotated[SpaceKind, Path(description="Of what is kept.")],
    studio: StudioDep,
    store: StoreDep,
    space: SpaceDep,
) -> JsonAnswer:
    """Erase what was deleted of a kind now; results of studies and diagnoses are made again when needed."""
    space.erase(kind)
    return JsonAnswer(kept.kept(studio, store, space))


@kept_router.post("/{kind}/{identity}/restore", response_model=KeptData, responses=errors(404, 409, 422, 507))
def restore_kept(
    kind: Kind, identity: Identity, studio: StudioDep, store: StoreDep, space: SpaceDep
) -> JsonAnswer:
    """Bring a deleted measurement or preset back. The answer is what is kept now."""
    kept.restore(studio, store, kind=kind, identity=identity)
    return JsonAnswer(kept.kept(studio, store, space))
