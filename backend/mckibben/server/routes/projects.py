"""Projects: documents with their history, measurements and study tables, in a database.

Each route is a transaction of the database and runs in a thread; what reads files, in a process.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import Annotated, Any

import orjson
from fastapi import APIRouter, Path, Query, Request, Response
from fastapi.concurrency import run_in_threadpool

from mckibben.application.project.projects import files_of, missing_files, packed
from mckibben.application.project.studies import give_back, table_of
from mckibben.application.study.store import StudyStore
from mckibben.projects.project import Project, ProjectSummary
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import BeforeWork, ProjectsDep, StoreDep, StudioDep
from mckibben.server.long_work import whole
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.projects import (
    HistoryAnswer,
    NewProject,
    ProjectAnswer,
    ProjectChange,
    ProjectCopy,
    ProjectsAnswer,
    ProjectState,
)
from mckibben.server.short_jobs import FilesOfProject, PackedProject

router = APIRouter(prefix="/api/projects", tags=["projects"], route_class=StrictRoute)

Id = Annotated[str, Path(pattern="^[0-9a-f]{32}$", description="Id of the project.")]
_ZIP = {"application/zip": {"schema": {"type": "string", "format": "binary"}}}
_FILE = {
    "requestBody": {
        "required": True,
        "description": "A packed project, up to 64 MB.",
        "content": _ZIP | {"application/octet-stream": _ZIP["application/zip"]},
    }
}


@router.get("", response_model=ProjectsAnswer, responses=errors(409, 422))
def list_projects(
    projects: ProjectsDep,
    deleted: Annotated[bool, Query(description="Those in the bin instead of the others.")] = False,
) -> JsonAnswer:
    """All projects, the one changed last first."""
    found = [_info(each) for each in projects.list(deleted=deleted)]
    return JsonAnswer({"projects": found, "place": projects.place})


@router.post(
    "",
    status_code=201,
    response_model=ProjectAnswer,
    responses=errors(400, 409, 413, 415, 422),
    openapi_extra=request_examples.worked("project"),
)
def create_project(body: NewProject, projects: ProjectsDep, store: StoreDep, studio: StudioDep) -> JsonAnswer:
    """Keep a document as a new project, with the measurements that it names and the table of its study."""
    files = files_of(body.document, store)
    studies, remarks = table_of(body.study, StudyStore(store.data), studio)
    made = projects.create(body.document, title=body.title, notes=body.notes, files=files, studies=studies)
    return JsonAnswer(_answer(made, remarks), status_code=201)


@router.post(
    "/import",
    status_code=201,
    dependencies=[BeforeWork],
    response_model=ProjectAnswer,
    responses=errors(400, 409, 413, 422, 429),
    openapi_extra=_FILE,
)
async def import_project(
    request: Request, projects: ProjectsDep, store: StoreDep, studio: StudioDep
) -> JsonAnswer:
    """Unpack a project of another machine as a new one, with its history, measurements and study tables."""
    settings = request.app.state.settings
    packed_one = PackedProject(await request.body(), settings.projects or settings.data)
    made = orjson.loads(await whole(request, "project import", packed_one, studio, store))["id"]
    return await run_in_threadpool(lambda: JsonAnswer(_answer(projects.open(made)), status_code=201))


@router.get(
    "/{project_id}",
    dependencies=[BeforeWork],
    response_model=ProjectAnswer,
    responses=errors(404, 409, 422, 429),
)
async def open_project(
    request: Request,
    project_id: Id,
    projects: ProjectsDep,
    store: StoreDep,
    studio: StudioDep,
    version: Annotated[int | None, Query(ge=1, description="An earlier version; left out: the last.")] = None,
) -> JsonAnswer:
    """A project; measurements and runs of studies that the server no longer has are stored again."""
    project = await run_in_threadpool(projects.open, project_id, version)
    if await run_in_threadpool(missing_files, project, store):
        settings = request.app.state.settings
        wanted = FilesOfProject(project_id, version, settings.projects or settings.data)
        await whole(request, "project files", wanted, studio, store)

    def answer() -> JsonAnswer:
        studies = projects.studies(project_id) if project.studies else []
        return JsonAnswer(_answer(project, give_back(studies, StudyStore(store.data), studio)))

    return await run_in_threadpool(answer)


@router.put(
    "/{project_id}",
    response_model=ProjectAnswer,
    responses=errors(400, 404, 409, 413, 415, 422),
    openapi_extra=request_examples.worked("project_state"),
)
def save_project(
    project_id: Id, body: ProjectState, projects: ProjectsDep, store: StoreDep, studio: StudioDep
) -> JsonAnswer:
    """Save a further state; 409 where somebody else has saved since ``base_version``."""
    studies, remarks = table_of(body.study, StudyStore(store.data), studio)
    saved = projects.save(
        project_id,
        body.document,
        base_version=body.base_version,
        files=files_of(body.document, store),
        studies=studies,
        label=body.label,
        automatic=body.automatic,
    )
    return JsonAnswer(_answer(saved, remarks))


@router.patch(
    "/{project_id}",
    response_model=ProjectSummary,
    responses=errors(400, 404, 409, 413, 415, 422),
    openapi_extra=request_examples.worked("project_change"),
)
def describe_project(project_id: Id, body: ProjectChange, projects: ProjectsDep) -> JsonAnswer:
    """Another title or other notes."""
    changed = projects.describe(
        project_id, base_version=body.base_version, title=body.title, notes=body.notes
    )
    return JsonAnswer(_info(changed))


@router.post(
    "/{project_id}/copies",
    status_code=201,
    response_model=ProjectAnswer,
    responses=errors(400, 404, 409, 413, 415, 422),
    openapi_extra=request_examples.worked("project_copy"),
)
def copy_project(project_id: Id, body: ProjectCopy, projects: ProjectsDep) -> JsonAnswer:
    """A copy with the last document and all measurements."""
    return JsonAnswer(_answer(projects.duplicate(project_id, title=body.title)), status_code=201)


@router.delete("/{project_id}", response_model=ProjectSummary, responses=errors(404, 409, 422))
def delete_project(
    project_id: Id,
    projects: ProjectsDep,
    erase: Annotated[bool, Query(description="For good; it has to be in the bin already.")] = False,
) -> JsonAnswer:
    """Put a project into the bin, where it stays for 30 days; or erase it from there."""
    return JsonAnswer(_info(projects.erase(project_id) if erase else projects.delete(project_id)))


@router.post("/{project_id}/restore", response_model=ProjectSummary, responses=errors(404, 409, 422))
def restore_project(project_id: Id, projects: ProjectsDep) -> JsonAnswer:
    """Take a project out of the bin."""
    return JsonAnswer(_info(projects.restore(project_id)))


@router.get("/{project_id}/history", response_model=HistoryAnswer, responses=errors(404, 409, 422))
def read_history(project_id: Id, projects: ProjectsDep) -> JsonAnswer:
    """The versions of a project, the last one first; open one with ``?version=``."""
    return JsonAnswer({"history": [asdict(each) for each in projects.history(project_id)]})


@router.get(
    "/{project_id}/file",
    response_class=Response,
    responses={200: {"content": _ZIP, "description": "The packed project."}, **errors(404, 409, 422)},
)
def export_project(project_id: Id, projects: ProjectsDep) -> Response:
    """A project as one file, with its history, measurements and study tables."""
    name, content = packed(projects, project_id)
    return Response(
        content,
        media_type="application/zip",
        headers={"content-disposition": f'attachment; filename="{name}"'},
    )


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
