"""Assembly of the server: from settings to the application."""

from __future__ import annotations

import asyncio
import gc
import threading
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from time import perf_counter

from fastapi import FastAPI
from fastapi.routing import APIRoute
from starlette.datastructures import MutableHeaders
from starlette.middleware.gzip import GZipMiddleware
from starlette.requests import ClientDisconnect
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from mckibben.documents.studio import Studio
from mckibben.measurement.store import MeasurementStore
from mckibben.report.document import versions
from mckibben.server import errors, static
from mckibben.server.errors import error_answer, unexpected_answer
from mckibben.server.lanes import Lanes
from mckibben.server.metrics import Requests
from mckibben.server.routes.curves import asked_router, curves_router, inverse_router, joints_router
from mckibben.server.routes.drives import (
    linearisations_router,
    simulations_router,
    sizings_router,
    studies_router,
)
from mckibben.server.routes.effects import EffectsDocument, effects_router, signatures_router
from mckibben.server.routes.exports import exports_router
from mckibben.server.routes.kept import kept_router
from mckibben.server.routes.measurements import measurements_router, mysteries_router
from mckibben.server.routes.models import (
    comparisons_router,
    diagnoses_router,
    experiments_router,
    reports_router,
)
from mckibben.server.routes.presets import order_codes_router, presets_router
from mckibben.server.routes.program import (
    description_router,
    facts_router,
    health_router,
    help_router,
    metrics_router,
)
from mckibben.server.routes.projects import projects_router
from mckibben.server.security import BodyLimitMiddleware, HttpMiddleware, SecurityMiddleware
from mckibben.server.settings import Settings
from mckibben.server.uploads import Scratch
from mckibben.simulation.integrate.many import lane_kernels
from mckibben.version import __version__

# Bytes. The usual curves answer is smaller: compressing it would take longer than computing it.
_GZIP_FROM = 256 * 1024
_WARM_AFTER = 1.0  # s

_TAGS = [
    {"name": "health", "description": "Is the server up?"},
    {"name": "facts", "description": "Declared figures and units."},
    {"name": "effects", "description": "The catalogue of physical effects."},
    {"name": "presets", "description": "Real parts, reference curves, measurements and example designs."},
    {"name": "curves", "description": "Static characteristics of a muscle."},
    {"name": "inverse", "description": "Which pressure, which contraction, which range?"},
    {"name": "joints", "description": "Muscles on levers about one axis, at rest."},
    {"name": "simulations", "description": "Transient simulation of drives."},
    {"name": "linearisations", "description": "Linear models of drives, loops, controller design."},
    {"name": "sizings", "description": "Sizing: from a task to ranked drives."},
    {"name": "studies", "description": "Many runs with varied quantities."},
    {"name": "measurements", "description": "Measurement files."},
    {"name": "kept", "description": "What the user keeps: rename, delete, restore."},
    {"name": "projects", "description": "Documents with history and measurements, in a database."},
    {"name": "experiments", "description": "What a measurement was made with, and what is to be asked."},
    {"name": "comparisons", "description": "A model compared with measurements."},
    {"name": "diagnoses", "description": "Which physical effect a model is missing."},
    {"name": "reports", "description": "Comparison and diagnosis as an HTML report."},
    {"name": "exports", "description": "A model or drive as files for other programs."},
    {"name": "mysteries", "description": "Measurements with hidden effects, to practise on."},
]


def create_app(settings: Settings | None = None) -> FastAPI:
    """The application with all its routes.

    Raises:
        InputError: an effects folder does not exist.
    """
    settings = settings or Settings()

    @asynccontextmanager
    async def lifespan(app: FastAPI) -> AsyncIterator[None]:
        # Ready when the first page asks for it, without delaying the start.
        threading.Thread(target=app.state.plotly.compressed, daemon=True).start()
        # Delayed: importing numba blocks the interpreter for half a second, while the first page loads.
        loop = asyncio.get_running_loop()
        warming = [loop.call_later(_WARM_AFTER, threading.Thread(target=_warm, daemon=True).start)]
        if app.state.workers is not None:
            warming.append(loop.call_later(_WARM_AFTER, app.state.workers.start, "files"))
        yield
        for later in warming:
            later.cancel()
        if app.state.workers is not None:
            await asyncio.to_thread(app.state.workers.close)
        if app.state.projects is not None:
            await asyncio.to_thread(app.state.projects.close)

    app = FastAPI(
        title="mckibben",
        version=__version__,
        description="Design studio for pneumatic-muscle drives. Physical values of requests are numbers in "
        "SI units or texts with a unit; answers are in SI.",
        # Their pages load scripts from elsewhere, which the content security policy forbids.
        docs_url=None,
        redoc_url=None,
        openapi_url=None,  # FastAPI's own route would block the event loop; see `description`
        openapi_tags=_TAGS,
        generate_unique_id_function=_operation_name,
        lifespan=lifespan,
    )
    app.state.settings = settings
    app.state.studio = Studio(
        presets=settings.presets, user_presets=settings.user_presets, effects=settings.effects
    )
    app.state.projects, app.state.opening_projects = None, threading.Lock()
    app.state.studio.library.quota = settings.quotas.presets
    app.state.store = MeasurementStore(settings.data, quotas=settings.quotas)
    app.state.requests, app.state.in_flight = Requests(), {True: 0, False: 0}
    app.state.scratch = Scratch(app.state.store)
    app.state.workers = Lanes(settings) if settings.workers else None
    app.state.effects = EffectsDocument(app.state.studio.catalogue)
    app.state.versions = versions()
    app.state.plotly = static.PlotlyBundle()
    # Routes are matched in this order: first the one requested at every movement of a slider.
    routers = (
        curves_router,
        asked_router,
        simulations_router,
        linearisations_router,
        inverse_router,
        joints_router,
        sizings_router,
        studies_router,
        comparisons_router,
        diagnoses_router,
        health_router,
        metrics_router,
        facts_router,
        effects_router,
        signatures_router,
        presets_router,
        order_codes_router,
        projects_router,
        measurements_router,
        kept_router,
        experiments_router,
        reports_router,
        exports_router,
        mysteries_router,
        description_router,
        help_router,
        static.router,
    )
    for router in routers:
        app.include_router(router)
    app.router.redirect_slashes = False
    app.router.default = static.frontend(settings.frontend)
    routes = [route for router in routers for route in router.routes if isinstance(route, APIRoute)]
    errors.install(app, list(dict.fromkeys(route.path_format for route in routes if route.include_in_schema)))
    # The middleware added last is the outermost.
    app.add_middleware(GZipMiddleware, minimum_size=_GZIP_FROM, compresslevel=1)
    app.add_middleware(BodyLimitMiddleware, in_flight=app.state.in_flight)
    app.add_middleware(SecurityMiddleware, settings=settings)
    app.add_middleware(TimingMiddleware, requests=app.state.requests)
    return app


def _warm() -> None:
    """Load the integrators, and take all that is loaded by then out of what the garbage collector looks at.

    It would otherwise hold up every request for two tenths of a second each time.
    """
    lane_kernels.warm().join()
    gc.freeze()


def _operation_name(route: APIRoute) -> str:
    """Operation id: the name of the function (``list_presets``), unique within the application."""
    return route.name


class TimingMiddleware(HttpMiddleware):
    """``Server-Timing: app;dur=<ms>`` on API answers, no caching unless a route sets it, 500 as JSON.

    Counts each answer, by its route.
    """

    def __init__(self, app: ASGIApp, *, requests: Requests | None = None) -> None:
        super().__init__(app)
        self._requests = requests or Requests()

    async def answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Time one request from its arrival to the first byte of its answer, without waiting for its body."""
        start, waited, started = perf_counter(), 0.0, False
        is_api = scope["path"].startswith("/api/")

        async def timed_receive() -> Message:
            nonlocal waited
            before = perf_counter()
            message = await receive()
            waited += perf_counter() - before
            return message

        async def timed_send(message: Message) -> None:
            nonlocal started
            if message["type"] == "http.response.start":
                started = True
                took = perf_counter() - start - waited
                route = getattr(scope.get("route"), "path_format", "/api/..." if is_api else "page")
                self._requests.add(scope["method"], route, message["status"], took)
                if is_api:
                    headers = MutableHeaders(raw=message["headers"])
                    headers.setdefault("cache-control", "no-store")
                    headers["server-timing"] = f"app;dur={took * 1e3:.3f}"
            await send(message)

        try:
            await self.app(scope, timed_receive, timed_send)
        except ClientDisconnect:
            return  # the client disconnected within the body: no answer is needed, and nothing is stored
        except asyncio.CancelledError:
            # By uvicorn at the end; uvicorn would send plain text.
            if started:
                raise
            await error_answer(503, "The server is ending.", hint="Start it again.")(
                scope, receive, timed_send
            )
        except Exception as error:
            # Inside Starlette's error layer, which would send plain text and log a second time.
            if started:
                raise
            await unexpected_answer(error)(scope, receive, timed_send)
