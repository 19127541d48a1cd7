"""The page: the files of the frontend, and plotly.js from the installed plotly package."""

from __future__ import annotations

import gzip
import mimetypes
import threading
from functools import cache
from pathlib import Path

from fastapi import APIRouter, Request, Response
from fastapi.responses import FileResponse
from starlette.exceptions import HTTPException
from starlette.middleware.gzip import GZipMiddleware
from starlette.staticfiles import StaticFiles
from starlette.types import ASGIApp, Receive, Scope, Send

from mckibben.resources import plotly_javascript

# The system's table may map .js to text/plain, which browsers refuse to run as a module.
for _suffix, _type in {
    ".js": "text/javascript", ".mjs": "text/javascript", ".css": "text/css", ".html": "text/html",
    ".svg": "image/svg+xml", ".json": "application/json", ".woff2": "font/woff2", ".ico": "image/x-icon",
}.items():  # fmt: skip
    mimetypes.add_type(_type, _suffix)

# Files are revalidated every time, by their ETag: an upgrade never mixes old and new modules.
_REVALIDATE = "no-cache"
_FOREVER = "public, max-age=31536000, immutable"


class _Frontend(StaticFiles):
    """Static files that the browser revalidates."""

    def file_response(self, *args: object, **kwargs: object) -> Response:
        """The file, or 304 when the browser has it already."""
        answer = super().file_response(*args, **kwargs)  # type: ignore[arg-type]
        answer.headers["cache-control"] = _REVALIDATE
        return answer


def frontend(folder: Path) -> ASGIApp:
    """Serve a folder at ``/``; missing files and unknown API paths answer 404."""
    files = GZipMiddleware(_Frontend(directory=folder, html=True, check_dir=False), minimum_size=1000)

    async def serve(scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            return
        if scope["path"].startswith("/api/") or "\0" in scope["path"] or not folder.is_dir():
            raise HTTPException(404)
        await files(scope, receive, send)

    return serve


_compressing = threading.Lock()


class PlotlyBundle:
    """plotly.js and its compressed form."""

    def __init__(self) -> None:
        self.path, self.version = plotly_javascript()

    def compressed(self) -> bytes:
        """The bundle gzipped; 0.2 s the first time in a process."""
        with _compressing:
            return _gzipped(self.path)


@cache
def _gzipped(path: Path) -> bytes:
    return gzip.compress(path.read_bytes(), compresslevel=6, mtime=0)


router = APIRouter(include_in_schema=False)


@router.get("/vendor/plotly.min.js")
def plotly(request: Request) -> Response:
    """plotly.js; cached permanently when the link names the installed version (``?v=``)."""
    bundle: PlotlyBundle = request.app.state.plotly
    exact = request.query_params.get("v") == bundle.version
    etag = f'"plotly-{bundle.version}"'
    headers = {"cache-control": _FOREVER if exact else _REVALIDATE, "etag": etag, "vary": "accept-encoding"}
    if request.headers.get("if-none-match") == etag:
        return Response(status_code=304, headers=headers)
    if "gzip" in request.headers.get("accept-encoding", ""):
        headers["content-encoding"] = "gzip"
        return Response(bundle.compressed(), media_type="text/javascript", headers=headers)
    return FileResponse(bundle.path, media_type="text/javascript", headers=headers)
