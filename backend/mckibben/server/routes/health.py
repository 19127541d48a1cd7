"""Health and version of the server."""

from __future__ import annotations

import sys

from fastapi import APIRouter, Request

from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.health import Health
from mckibben.simulation.integrate.background import is_compiling
from mckibben.version import __version__

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
