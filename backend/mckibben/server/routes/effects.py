"""The catalogue of physical effects."""

from __future__ import annotations

import hashlib
import threading

from fastapi import APIRouter, Request, Response

from mckibben.application.json_text import to_json
from mckibben.physics.catalogue import EffectCatalogue
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.effects_json import effects_answer
from mckibben.server.schemas.common import errors
from mckibben.server.schemas.effects import EffectsAnswer

router = APIRouter(prefix="/api/effects", tags=["effects"], route_class=StrictRoute)


class EffectsDocument:
    """The answer as bytes, written once: the catalogue does not change while the server runs."""

    def __init__(self, catalogue: EffectCatalogue) -> None:
        self._catalogue = catalogue
        self._lock = threading.Lock()
        self._content: tuple[bytes, str] | None = None

    def content(self) -> tuple[bytes, str]:
        """The JSON text and its ETag."""
        with self._lock:
            if self._content is None:
                body = to_json(effects_answer(self._catalogue))
                self._content = body, f'"{hashlib.sha256(body).hexdigest()[:32]}"'
            return self._content


@router.get("", response_model=EffectsAnswer, responses=errors())
def list_effects(request: Request) -> Response:
    """Every effect with its equation, parameters, sources and what it is confused with."""
    body, etag = request.app.state.effects.content()
    headers = {"etag": etag, "cache-control": "no-cache"}
    if request.headers.get("if-none-match") == etag:
        return Response(status_code=304, headers=headers)
    return JsonAnswer(body, headers=headers)
