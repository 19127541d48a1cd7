"""The page: the files of the frontend, and plotly.js from the installed plotly package."""

from __future__ import annotations

import gzip
import hashlib
import mimetypes
import os
import re
import threading
from functools import cache
from pathlib import Path

from anyio import to_thread
from fastapi import APIRouter, Request, Response
from fastapi.responses import FileResponse, HTMLResponse
from starlette.datastructures import Headers
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

# Modules and style sheets are linked from the page under a name of the state of all files, as in
# `/<state>/js/main.js`; what they import lies under the same name. So a browser keeps them for good, asks for
# none of them when the page is opened again, and never mixes old and new modules. By their plain path files
# are revalidated every time.
_REVALIDATE = "no-cache"
_FOREVER = "public, max-age=31536000, immutable"
_PAGE = ("/", "/index.html")
_LINK = re.compile(r'(?<=["\'])/(?=(?:js|css)/)')
_NAMED = re.compile(r"/([0-9a-f]{16})(/(?:js|css)/.+)")


class _Frontend(StaticFiles):
    """Static files that the browser revalidates, or keeps."""

    def __init__(self, folder: Path, kept: str) -> None:
        super().__init__(directory=folder, html=True, check_dir=False)
        self._kept = kept

    def file_response(self, *args: object, **kwargs: object) -> Response:
        """The file, or 304 when the browser has it already."""
        answer = super().file_response(*args, **kwargs)  # type: ignore
        answer.headers["cache-control"] = self._kept
        return answer


def frontend(folder: Path) -> ASGIApp:
    """Serve a folder at ``/``; missing files and unknown API paths answer 404."""
    files, kept = (
        GZipMiddleware(_Frontend(folder, kept), minimum_size=1000) for kept in (_REVALIDATE, _FOREVER)
    )

    async def page(scope: Scope, receive: Receive, send: Send) -> None:
        state, text = await to_thread.run_sync(_linked_page, folder)
        headers = {"cache-control": _REVALIDATE, "etag": f'"{state}"'}
        if Headers(scope=scope).get("if-none-match") == headers["etag"]:
            await Response(status_code=304, headers=headers)(scope, receive, send)
        else:
            await HTMLResponse(text, headers=headers)(scope, receive, send)

    whole_page = GZipMiddleware(page, minimum_size=1000)

    async def serve(scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            return
        path = scope["path"]
        if path.startswith("/api/") or "\0" in path or not folder.is_dir():
            raise HTTPException(404)
        if path in _PAGE and scope["method"] in ("GET", "HEAD") and (folder / "index.html").is_file():
            await whole_page(scope, receive, send)
        elif named := _NAMED.fullmatch(path):
            # A page opened before an upgrade gets the new file, which its browser must not keep for the old.
            current = named[1] == await to_thread.run_sync(_state, folder)
            await (kept if current else files)({**scope, "path": named[2]}, receive, send)
        else:
            await files(scope, receive, send)

    return serve


def _linked_page(folder: Path) -> tuple[str, str]:
    """Name of the state of all files, and the page with its links under that name."""
    state = _state(folder)
    return state, _LINK.sub(f"/{state}/", (folder / "index.html").read_text(encoding="utf-8"))


def _state(folder: Path) -> str:
    """Sixteen hexadecimal digits that differ when any file of the folder does."""
    found = hashlib.blake2b(digest_size=8)
    for place, inside, names in os.walk(folder):
        inside.sort()
        for name in sorted(names):
            file = os.stat(os.path.join(place, name))
            found.update(f"{place}/{name} {file.st_mtime_ns} {file.st_size}\n".encode())
    return found.hexdigest()


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
