"""Help pages of our own, which work offline: the references of Python and HTTP."""

from __future__ import annotations

from functools import cache
from importlib import import_module

from fastapi import APIRouter, Request
from fastapi.responses import HTMLResponse

from mckibben.report.reference.http import http_reference
from mckibben.report.reference.page import overview
from mckibben.report.reference.python import python_reference
from mckibben.version import __version__

router = APIRouter(prefix="/help", include_in_schema=False)

_REVALIDATE = {"cache-control": "no-cache"}


# In worker threads: the first request of each page writes it.
@router.get("")
def read_help() -> HTMLResponse:
    """Where the references are."""
    return HTMLResponse(overview(__version__), headers=_REVALIDATE)


@router.get("/python")
def read_python_reference() -> HTMLResponse:
    """The public Python names."""
    return HTMLResponse(_python(), headers=_REVALIDATE)


@cache
def _python() -> str:
    # By its name: the server does not depend on the Python door, it only shows its docstrings.
    return python_reference(import_module("mckibben"))


@router.get("/http")
def read_http_reference(request: Request) -> HTMLResponse:
    """Every path of this server."""
    return HTMLResponse(http_reference(request.app.openapi()), headers=_REVALIDATE)
