"""Studio and measurement store as annotated dependencies of the routes."""

from __future__ import annotations

from typing import Annotated

from fastapi import Depends, Request

from mckibben.documents.studio import Studio
from mckibben.measurement.store import MeasurementStore


async def _studio(request: Request) -> Studio:
    return request.app.state.studio


async def _store(request: Request) -> MeasurementStore:
    return request.app.state.store


async def _start_workers(request: Request) -> None:
    if request.app.state.workers is not None:
        request.app.state.workers.start()


#: Of a route that is asked before long work: the workers start meanwhile.
BeforeWork = Depends(_start_workers)
StudioDep = Annotated[Studio, Depends(_studio)]
StoreDep = Annotated[MeasurementStore, Depends(_store)]
