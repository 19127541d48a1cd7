"""The description of this interface."""

from __future__ import annotations

from fastapi import APIRouter, Request

from mckibben.server.answer import JsonAnswer

router = APIRouter(include_in_schema=False)


@router.get("/openapi.json")
def describe(request: Request) -> JsonAnswer:
    """Every route with its request and answers (OpenAPI); takes half a second to write the first time."""
    return JsonAnswer(request.app.openapi())
