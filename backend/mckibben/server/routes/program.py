"""What the server says of itself: health, figures and units, description of the interface, help pages."""

from __future__ import annotations

import hashlib
import os
import sys
from collections.abc import Iterator
from functools import cache
from importlib import import_module
from types import ModuleType
from typing import Literal

from fastapi import APIRouter, HTTPException, Request, Response
from fastapi.concurrency import run_in_threadpool
from fastapi.responses import HTMLResponse, RedirectResponse
from pydantic import Field

from mckibben.application.facts import DeclaredFigure, Units, figures, units
from mckibben.application.json_text import to_json
from mckibben.application.project.stored import Space
from mckibben.documents.strict import Strict
from mckibben.folder import free_space
from mckibben.report.reference.http import http_reference
from mckibben.report.reference.page import overview
from mckibben.report.reference.python import python_reference, start_of
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import SpaceDep, StudioDep
from mckibben.server.lanes import Lanes
from mckibben.server.metrics import MEDIA_TYPE, family, memory_of, open_descriptors
from mckibben.server.schemas.common import errors
from mckibben.simulation.integrate.background import is_compiling
from mckibben.version import __version__

facts_router = APIRouter(prefix="/api", tags=["facts"], route_class=StrictRoute)

description_router = APIRouter(include_in_schema=False)

help_router = APIRouter(prefix="/help", include_in_schema=False)

_REVALIDATE = {"cache-control": "no-cache"}


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
    version: str = Field(description="Version of mckibben.", examples=["0.2.0"])
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


health_router = APIRouter(prefix="/api/health", tags=["health"], route_class=StrictRoute)


@health_router.get("", response_model=Health, responses=errors())
async def read_health(request: Request) -> JsonAnswer:
    """Version of the server, what it does at the moment and how much memory it takes."""
    settings, workers = request.app.state.settings, request.app.state.workers
    return JsonAnswer(
        {
            "status": "ok",
            "version": __version__,
            "plotly": request.app.state.plotly.version,
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


metrics_router = APIRouter(include_in_schema=False)


@metrics_router.get("/metrics")
async def read_metrics(request: Request, space: SpaceDep) -> Response:
    """Figures of the server about itself, for Prometheus; like all else only with the token."""
    state = request.app.state
    # On the event loop, which alone changes them; what reads files, in a thread.
    text = "".join([*state.requests.families(), *_of_lanes(state.workers, state.in_flight)])
    text += "".join(await run_in_threadpool(lambda: list(_of_machine(space))))
    return Response(text, media_type=MEDIA_TYPE)


def _of_lanes(lanes: Lanes | None, in_flight: dict[bool, int]) -> Iterator[str]:
    each = {} if lanes is None else lanes.each
    yield from family(
        "jobs", "gauge", "Jobs that run and that wait, by sort of work.",
        (({"lane": name, "state": state}, number) for name, lane in each.items()
         for state, number in (("running", lane.running), ("waiting", lane.waiting))),
    )  # fmt: skip
    yield from family(
        "workers_ended_total", "counter", "Worker processes that have ended and were replaced, by why.",
        (({"lane": name, "why": why}, number) for name, lane in each.items()
         for why, number in lane.ended.items()),
    )  # fmt: skip
    yield from family(
        "worker_memory_bytes", "gauge", "Resident memory of the worker processes.",
        (({"lane": name, "pid": str(pid)}, size) for name, lane in each.items() for pid in lane.pids
         if (size := memory_of(pid)) is not None),
    )  # fmt: skip
    yield from family(
        "in_flight_bytes", "gauge", "Bodies of requests that arrive or are worked on.",
        (({"what": "files" if files else "other"}, size) for files, size in in_flight.items()),
    )  # fmt: skip


def _of_machine(space: Space) -> Iterator[str]:
    own, files = memory_of(os.getpid()), open_descriptors()
    yield from family(
        "memory_bytes", "gauge", "Resident memory of the server itself.", [] if own is None else [({}, own)]
    )
    yield from family(
        "open_descriptors", "gauge", "Files and connections that the server has open.",
        [] if files is None else [({}, files)],
    )  # fmt: skip
    yield from family(
        "space_bytes", "gauge", "What is kept, by kind.",
        (({"kind": each.kind, "what": what}, size) for each in space.ledger()
         for what, size in (("taken", each.taken), ("restorable", each.restorable), ("quota", each.quota))),
    )  # fmt: skip
    free = free_space(space.store.data)
    yield from family("disk_free_bytes", "gauge", "Left on the disk.", [] if free is None else [({}, free)])


def _memory() -> int | None:
    """Most resident memory of the server's own process so far [bytes]; None on Windows."""
    if sys.platform == "win32":
        return None
    import resource

    unit = 1 if sys.platform == "darwin" else 1024
    return unit * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss


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


@facts_router.get("/figures", response_model=list[DeclaredFigure], responses=errors())
def list_figures(request: Request) -> Response:
    """Every figure with its symbol, unit, label, definition and the condition under which it exists."""
    return _answer(request, *_figures())


@facts_router.get("/units", response_model=Units, responses=errors())
def list_units(request: Request) -> Response:
    """How each quantity is shown in each unit system, and the units that forms and documents take."""
    return _answer(request, *_units())


@description_router.get("/openapi.json")
def describe(request: Request) -> JsonAnswer:
    """Every route with its request and answers (OpenAPI); takes half a second to write the first time."""
    return JsonAnswer(request.app.openapi())


# In worker threads: the first request of each page writes it.
@help_router.get("")
def read_help(studio: StudioDep) -> HTMLResponse:
    """Where the references are, and the misprints of the sources that presets follow."""
    library = studio.library
    presets = [each for kind in library.kinds for each in library.list(kind)]
    misprints = {each.heading: each.misprints for each in presets if each.misprints}
    return HTMLResponse(overview(__version__, misprints), headers=_REVALIDATE)


@help_router.get("/python")
def read_python_reference() -> RedirectResponse:
    """To the public Python names."""
    return RedirectResponse(f"/help/python/{start_of(_package())}")


@help_router.get("/python/{address:path}")
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


@help_router.get("/http")
def read_http_reference(request: Request) -> HTMLResponse:
    """Every path of this server."""
    return HTMLResponse(http_reference(request.app.openapi()), headers=_REVALIDATE)
