"""Health and version of the server."""

from __future__ import annotations

from fastapi import APIRouter, Request

from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.health import Health
from mckibben.version import __version__

router = APIRouter(prefix="/api/health", tags=["health"], route_class=StrictRoute)


@router.get("", response_model=Health, responses=errors())
async def read_health(request: Request) -> JsonAnswer:
    """Version of the server."""
    settings = request.app.state.settings
    return JsonAnswer(
        {
            "status": "ok",
            "version": __version__,
            "plotly": request.app.state.plotly.version,
            "can_save_presets": settings.user_presets is not None,
        }
    )
