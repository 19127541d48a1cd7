"""Help pages of our own, which work offline: the references of Python and HTTP."""

from __future__ import annotations

from functools import cache
from importlib import import_module
from types import ModuleType

from fastapi import APIRouter, HTTPException, Request
from fastapi.responses import HTMLResponse, RedirectResponse

from mckibben.report.reference.http import http_reference
from mckibben.report.reference.page import overview
from mckibben.report.reference.python import python_reference, start_of
from mckibben.version import __version__

router = APIRouter(prefix="/help", include_in_schema=False)

_REVALIDATE = {"cache-control": "no-cache"}


# In worker threads: the first request of each page writes it.
@router.get("")
def read_help() -> HTMLResponse:
    """Where the references are."""
    return HTMLResponse(overview(__version__), headers=_REVALIDATE)


@router.get("/python")
def read_python_reference() -> RedirectResponse:
    """To the public Python names."""
    return RedirectResponse(f"/help/python/{start_of(_package())}")


@router.get("/python/{address:path}")
def read_python_page(address: str) -> HTMLResponse:
    """The public Python names, or the classes of a module."""
    try:
        return HTMLResponse(_python(address), headers=_REVALIDATE)
    except LookupError:
        raise HTTPException(404) from None


def _package() -> ModuleType:
    # By its name: the server does not depend on the Python door, it only shows its docstrings.
    return import_module("mckibben")


@cache
def _python(address: str) -> str:
    return python_reference(_package(), address)


@router.get("/http")
def read_http_reference(request: Request) -> HTMLResponse:
    """Every path of this server."""
    return HTMLResponse(http_reference(request.app.openapi()), headers=_REVALIDATE)
