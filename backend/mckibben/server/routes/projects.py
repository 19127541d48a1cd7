"""Projects: documents with their history, measurements and study tables, in a database.

Each route is a transaction of the database and runs in a thread; what reads files, in a process.
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from dataclasses import asdict
from typing import Annotated, Any

import orjson
from fastapi import APIRouter, Path, Query, Request, Response
from fastapi.concurrency import run_in_threadpool
from fastapi.responses import FileResponse
from pydantic import ConfigDict, Field
from starlette.background import BackgroundTask

from mckibben.application.project.projects import (
    files_of,
    give_back,
    missing_files,
    packed,
    table_of,
    texts_in,
)
from mckibben.documents.strict import Strict
from mckibben.projects.project import Project, ProjectSummary, Revision
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import BeforeWork, ProjectsDep, SpaceDep, StoreDep, StudiesDep, StudioDep
from mckibben.server.long_work import whole
from mckibben.server.schemas.common import errors
from mckibben.server.short_jobs import FilesOfProject, PackedProject

_TITLE = Field(description="Title, in one line, at most 200 characters.", examples=["Lift, second muscle"])
_DOCUMENT = Field(
    description="The document: any JSON object. Measurements whose ids stand anywhere in it are kept with it."
)
_BASE = Field(description="Version that the change began with; 409 where the project has a later one.", ge=1)
_LABEL = Field(description="What was done, in words, for the history.", examples=["mass 20 kg"])
_STUDY = Field(
    default=None,
    description="The study of the document, as for /api/studies: its runs that the server keeps, up to 20 "
    "MB, are kept with the project. One that cannot be used is passed over. null: study tables stay.",
)


class NewProject(Strict):
    """A project to be kept."""

    title: str = _TITLE
    notes: str = Field(default="", description="Notes of the user, plain text.")
    document: dict[str, Any] = _DOCUMENT
    study: dict[str, Any] | None = _STUDY


class ProjectState(Strict):
    """A further state of a project."""

    document: dict[str, Any] = _DOCUMENT
    study: dict[str, Any] | None = _STUDY
    base_version: int = _BASE
    label: str = Field(default="saved", description="What was done, in words, for the history.")
    automatic: bool = Field(
        default=False,
        description="Saved without being asked for: such states replace each other within five minutes.",
    )


class ProjectChange(Strict):
    """Another title or other notes."""

    base_version: int = _BASE
    title: str | None = Field(default=None, description="New title; null = as it is.")
    notes: str | None = Field(default=None, description="New notes; null = as they are.")


class ProjectCopy(Strict):
    """How a copy is called."""

    title: str | None = Field(default=None, description='Title; null = that of the original with "(copy)".')


class ProjectAnswer(Strict):
    """A project with the document of one version."""

    project: ProjectSummary = Field(description="The project as it is now.")
    revision: Revision = Field(description="The version of the document.")
    document: dict[str, Any] = Field(description="The document as it was saved.")
    measurements: list[str] = Field(description="Ids of the measurements kept with it.")
    studies: int = Field(description="Number of study tables kept with it.")
    remarks: list[str] = Field(description="Study tables that are not kept or not shown, and why, in words.")

    model_config = ConfigDict(extra="forbid")


class ProjectsAnswer(Strict):
    """The projects, the one changed last first."""

    projects: list[ProjectSummary] = Field(description="The projects.")
    place: str = Field(description="The database they are in, without a password.")


class HistoryAnswer(Strict):
    """The versions of a project, the last one first."""

    history: list[Revision] = Field(description="The versions that are kept.")


projects_router = APIRouter(prefix="/api/projects", tags=["projects"], route_class=StrictRoute)

Id = Annotated[str, Path(pattern="^[0-9a-f]{32}$", description="Id of the project.")]
_ZIP = {"application/zip": {"schema": {"type": "string", "format": "binary"}}}
_FILE = {
    "requestBody": {
        "required": True,
        "description": "A packed project, up to 64 MB.",
        "content": _ZIP | {"application/octet-stream": _ZIP["application/zip"]},
    }
}


@projects_router.get("", response_model=ProjectsAnswer, responses=errors(409, 422, 503, 507))
def list_projects(
    projects: ProjectsDep,
    deleted: Annotated[bool, Query(description="Those in the bin instead of the others.")] = False,
) -> JsonAnswer:
    """All projects, the one changed last first."""
    found = [_info(each) for each in projects.list(deleted=deleted)]
    return JsonAnswer({"projects": found, "place": projects.place})


@projects_router.post(
    "",
    status_code=201,
    response_model=ProjectAnswer,
    responses=errors(400, 409, 413, 415, 422, 503, 507),
    openapi_extra=request_examples.worked("project"),
)
def create_project(
    body: NewProject,
    projects: ProjectsDep,
    store: StoreDep,
    studio: StudioDep,
    kept_studies: StudiesDep,
    space: SpaceDep,
) -> JsonAnswer:
    """Keep a document as a new project, with the measurements that it names and the table of its study."""
    studies, remarks = table_of(body.study, kept_studies, studio)
    made = space.with_room(
        lambda: projects.create(
            body.document,
            title=body.title,
            notes=body.notes,
            files=files_of(body.document, store),
            studies=studies,
            answers=space.diagnoses.about(texts_in(body.document)),
        )
    )
    return JsonAnswer(_answer(made, remarks), status_code=201)


@projects_router.post(
    "/import",
    status_code=201,
    dependencies=[BeforeWork],
    response_model=ProjectAnswer,
    responses=errors(400, 409, 413, 422, 429, 503, 507),
    openapi_extra=_FILE,
)
async def import_project(
    request: Request, projects: ProjectsDep, store: StoreDep, studio: StudioDep
) -> JsonAnswer:
    """Unpack a project of another machine as a new one, with its history, measurements and study tables."""
    settings = request.app.state.settings
    async with request.app.state.scratch.received(request) as path:
        packed_one = PackedProject(path, settings.projects or settings.data)
        made = orjson.loads(await whole(request, "project import", packed_one, studio, store))["id"]
    return await run_in_threadpool(lambda: JsonAnswer(_answer(projects.open(made)), status_code=201))


@projects_router.get(
    "/{project_id}",
    dependencies=[BeforeWork],
    response_model=ProjectAnswer,
    responses=errors(404, 409, 422, 429, 503, 507),
)
async def open_project(
    request: Request,
    project_id: Id,
    projects: ProjectsDep,
    store: StoreDep,
    studio: StudioDep,
    kept_studies: StudiesDep,
    space: SpaceDep,
    version: Annotated[int | None, Query(ge=1, description="An earlier version; left out: the last.")] = None,
) -> JsonAnswer:
    """A project; measurements and runs of studies that the server no longer has are stored again."""
    project = await run_in_threadpool(projects.open, project_id, version)
    if await run_in_threadpool(missing_files, project, store):
        settings = request.app.state.settings
        wanted = FilesOfProject(project_id, version, settings.projects or settings.data)
        await whole(request, "project files", wanted, studio, store)

    def answer() -> JsonAnswer:
        for finished in projects.answers(project_id, space.diagnoses.names()):
            space.diagnoses.bring(finished)
        studies = projects.studies(project_id) if project.studies else []
        return JsonAnswer(_answer(project, give_back(studies, kept_studies, studio)))

    return await run_in_threadpool(answer)


@projects_router.put(
    "/{project_id}",
    response_model=ProjectAnswer,
    responses=errors(400, 404, 409, 413, 415, 422, 503, 507),
    openapi_extra=request_examples.worked("project_state"),
)
def save_project(
    project_id: Id,
    body: ProjectState,
    projects: ProjectsDep,
    store: StoreDep,
    studio: StudioDep,
    kept_studies: StudiesDep,
    space: SpaceDep,
) -> JsonAnswer:
    """Save a further state; 409 where somebody else has saved since ``base_version``."""
    studies, remarks = table_of(body.study, kept_studies, studio)
    has, answered = projects.measurements(project_id), projects.answer_names(project_id)
    saved = space.with_room(
        lambda: projects.save(
            project_id,
            body.document,
            base_version=body.base_version,
            files=files_of(body.document, store, has),
            studies=studies,
            answers=space.diagnoses.about(texts_in(body.document), answered),
            label=body.label,
            automatic=body.automatic,
        )
    )
    return JsonAnswer(_answer(saved, remarks))


@projects_router.patch(
    "/{project_id}",
    response_model=ProjectSummary,
    responses=errors(400, 404, 409, 413, 415, 422, 503, 507),
    openapi_extra=request_examples.worked("project_change"),
)
def describe_project(project_id: Id, body: ProjectChange, projects: ProjectsDep) -> JsonAnswer:
    """Another title or other notes."""
    changed = projects.describe(
        project_id, base_version=body.base_version, title=body.title, notes=body.notes
    )
    return JsonAnswer(_info(changed))


@projects_router.post(
    "/{project_id}/copies",
    status_code=201,
    response_model=ProjectAnswer,
    responses=errors(400, 404, 409, 413, 415, 422, 503, 507),
    openapi_extra=request_examples.worked("project_copy"),
)
def copy_project(project_id: Id, body: ProjectCopy, projects: ProjectsDep, space: SpaceDep) -> JsonAnswer:
    """A copy with the last document and all measurements."""
    copy = space.with_room(lambda: projects.duplicate(project_id, title=body.title))
    return JsonAnswer(_answer(copy), status_code=201)


@projects_router.delete(
    "/{project_id}", response_model=ProjectSummary, responses=errors(404, 409, 422, 503, 507)
)
def delete_project(
    project_id: Id,
    projects: ProjectsDep,
    erase: Annotated[bool, Query(description="For good; it has to be in the bin already.")] = False,
) -> JsonAnswer:
    """Put a project into the bin, where it stays until its room is needed; or erase it from there."""
    return JsonAnswer(_info(projects.erase(project_id) if erase else projects.delete(project_id)))


@projects_router.post(
    "/{project_id}/restore", response_model=ProjectSummary, responses=errors(404, 409, 422, 503, 507)
)
def restore_project(project_id: Id, projects: ProjectsDep) -> JsonAnswer:
    """Take a project out of the bin."""
    return JsonAnswer(_info(projects.restore(project_id)))


@projects_router.get(
    "/{project_id}/history", response_model=HistoryAnswer, responses=errors(404, 409, 422, 503, 507)
)
def read_history(project_id: Id, projects: ProjectsDep) -> JsonAnswer:
    """The versions of a project, the last one first; open one with ``?version=``."""
    return JsonAnswer({"history": [asdict(each) for each in projects.history(project_id)]})


@projects_router.get(
    "/{project_id}/file",
    response_class=Response,
    responses={
        200: {"content": _ZIP, "description": "The packed project."},
        **errors(404, 409, 422, 503, 507),
    },
)
def export_project(request: Request, project_id: Id, projects: ProjectsDep) -> Response:
    """A project as one file, with its history, measurements and study tables."""
    scratch = request.app.state.scratch
    with ExitStack() as stack:
        path, into = stack.enter_context(scratch.file())
        name = packed(projects, project_id, into)
        return FileResponse(
            path,
            media_type="application/zip",
            headers={"content-disposition": f'attachment; filename="{name}"'},
            background=BackgroundTask(stack.pop_all().close),
        )
    raise AssertionError("an exit stack passes all exceptions on")


def _info(summary: ProjectSummary) -> dict[str, Any]:
    return asdict(summary)


def _answer(project: Project, remarks: Sequence[str] = ()) -> dict[str, Any]:
    return {
        "project": _info(project.summary),
        "revision": asdict(project.revision),
        "document": project.document,
        "measurements": list(project.measurements),
        "studies": len(project.studies),
        "remarks": list(remarks),
    }
