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


StudioDep = Annotated[Studio, Depends(_studio)]
StoreDep = Annotated[MeasurementStore, Depends(_store)]
