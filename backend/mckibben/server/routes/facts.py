"""Figures and units as they are declared: what the page shows and reads."""

from __future__ import annotations

import hashlib
from functools import cache

from fastapi import APIRouter, Request, Response

from mckibben.application.facts import DeclaredFigure, Units, figures, units
from mckibben.application.json_text import to_json
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.schemas.common import errors

router = APIRouter(prefix="/api", tags=["facts"], route_class=StrictRoute)


@cache
def _figures() -> tuple[bytes, str]:
    return _tagged(to_json(figures()))


@cache
def _units() -> tuple[bytes, str]:
    return _tagged(to_json(units()))


def _tagged(body: bytes) -> tuple[bytes, str]:
    return body, f'"{hashlib.sha256(body).hexdigest()[:32]}"'


def _answer(request: Request, body: bytes, etag: str) -> Response:
    headers = {"etag": etag, "cache-control": "no-cache"}
    if request.headers.get("if-none-match") == etag:
        return Response(status_code=304, headers=headers)
    return JsonAnswer(body, headers=headers)


@router.get("/figures", response_model=list[DeclaredFigure], responses=errors())
def list_figures(request: Request) -> Response:
    """Every figure with its symbol, unit, label, definition and the condition under which it exists."""
    return _answer(request, *_figures())


@router.get("/units", response_model=Units, responses=errors())
def list_units(request: Request) -> Response:
    """How each quantity is shown in each unit system, and the units that forms and documents take."""
    return _answer(request, *_units())
