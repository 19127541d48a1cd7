"""Health and version of the server."""

from __future__ import annotations

import sys
from typing import Literal

from fastapi import APIRouter, Request
from pydantic import Field

from mckibben.documents.strict import Strict
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.schemas.common import errors
from mckibben.simulation.integrate.background import is_compiling
from mckibben.version import __version__


class LaneState(Strict):
    """Processes for one sort of work."""

    name: Literal["long", "files", "models"] = Field(
        description="Diagnoses and the like; files that are read; comparisons and models with typed terms."
    )
    processes: int = Field(description="Jobs that run at a time.")
    running: int = Field(description="Jobs that run.")
    waiting: int = Field(description="Jobs that wait.")


class Health(Strict):
    """The server is up."""

    status: Literal["ok"] = Field(description="The word 'ok'.")
    version: str = Field(description="Version of mckibben.", examples=["0.1.0"])
    plotly: str = Field(description="Version of the plotly bundle, for its link's ``?v=``.")
    workers: int = Field(
        description="Processes for diagnoses, sizings and reports; 0 = threads of the server."
    )
    running: int = Field(description="Jobs in these processes.")
    waiting: int = Field(description="Jobs in the queue.")
    queue: int = Field(description="Jobs that may wait; further ones are refused with status 429.")
    lanes: list[LaneState] = Field(description="The processes by sort of work; empty without workers.")
    memory: int | None = Field(
        description="Most memory that the server itself took so far [bytes]; null on Windows."
    )
    versions: dict[str, str] = Field(description="Program -> version.")
    compiling: bool = Field(
        description="Whether the integrators are being compiled for this machine: once after an "
        "installation, about 20 s of a core. What needs them waits."
    )
    can_save_presets: bool = Field(description="Whether the server has a folder for the user's presets.")


router = APIRouter(prefix="/api/health", tags=["health"], route_class=StrictRoute)


@router.get("", response_model=Health, responses=errors())
async def read_health(request: Request) -> JsonAnswer:
    """Version of the server, what it does at the moment and how much memory it takes."""
    settings, workers = request.app.state.settings, request.app.state.workers
    return JsonAnswer(
        {
            "status": "ok",
            "version": __version__,
            "plotly": request.app.state.plotly.version,
            "can_save_presets": settings.user_presets is not None,
            "workers": settings.workers,
            "running": 0 if workers is None else workers.each["long"].running,
            "waiting": 0 if workers is None else workers.each["long"].waiting,
            "queue": settings.queue,
            "lanes": []
            if workers is None
            else [
                {"name": name, "processes": lane.processes, "running": lane.running, "waiting": lane.waiting}
                for name, lane in workers.each.items()
            ],
            "compiling": is_compiling(),
            "memory": _memory(),
            "versions": request.app.state.versions,
        }
    )


def _memory() -> int | None:
    """Most resident memory of the server's own process so far [bytes]; None on Windows."""
    if sys.platform == "win32":
        return None
    import resource

    unit = 1 if sys.platform == "darwin" else 1024
    return unit * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
