"""Studio and measurement store as annotated dependencies of the routes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from fastapi import Depends, Request

from mckibben.application.diagnose.kept import DiagnosisStore
from mckibben.application.project.stored import Space
from mckibben.application.study.store import StudyStore
from mckibben.documents.studio import Studio
from mckibben.measurement.store import MeasurementStore
from mckibben.server.settings import Settings

if TYPE_CHECKING:
    from mckibben.projects.store import ProjectStore
else:
    ProjectStore = object  # imported with the first question for projects


async def _studio(request: Request) -> Studio:
    return request.app.state.studio


async def _store(request: Request) -> MeasurementStore:
    return request.app.state.store


def _projects(request: Request) -> ProjectStore:
    """The projects; their database is imported with the first question for them."""
    state = request.app.state
    with state.opening_projects:
        if state.projects is None:
            from mckibben.projects.database import Database
            from mckibben.projects.store import ProjectStore

            settings: Settings = state.settings
            database = Database(settings.projects or settings.data)
            state.projects = ProjectStore(database, quota=state.store.quotas.projects)
    return state.projects


async def _studies(request: Request) -> StudyStore:
    store: MeasurementStore = request.app.state.store
    return StudyStore(store.data, quota=store.quotas.studies)


async def _space(request: Request) -> Space:
    state = request.app.state
    diagnoses = DiagnosisStore(state.store.data, quota=state.store.quotas.diagnoses)
    return Space(state.studio, state.store, await _studies(request), diagnoses, lambda: _projects(request))


async def _start_workers(request: Request) -> None:
    if request.app.state.workers is not None:
        request.app.state.workers.start("models", "files", "long")  # in the order in which a page asks them


#: Of a route that is asked before long work: the workers start meanwhile.
BeforeWork = Depends(_start_workers)
StudioDep = Annotated[Studio, Depends(_studio)]
ProjectsDep = Annotated[ProjectStore, Depends(_projects)]
StudiesDep = Annotated[StudyStore, Depends(_studies)]
SpaceDep = Annotated[Space, Depends(_space)]
StoreDep = Annotated[MeasurementStore, Depends(_store)]
