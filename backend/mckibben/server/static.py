"""The page: the files of the frontend, and plotly.js from the installed plotly package."""

from __future__ import annotations

import gzip
import hashlib
import mimetypes
import os
import re
import threading
from dataclasses import dataclass
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
_COMPRESSED_FROM = 1000  # bytes
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
        GZipMiddleware(_Frontend(folder, kept), minimum_size=_COMPRESSED_FROM)
        for kept in (_REVALIDATE, _FOREVER)
    )
    linked = _Linked(folder)

    async def page(scope: Scope, receive: Receive, send: Send) -> None:
        state, text = await to_thread.run_sync(linked.page)
        headers = {"cache-control": _REVALIDATE, "etag": f'"{state}"'}
        if Headers(scope=scope).get("if-none-match") == headers["etag"]:
            await Response(status_code=304, headers=headers)(scope, receive, send)
        else:
            await HTMLResponse(text, headers=headers)(scope, receive, send)

    whole_page = GZipMiddleware(page, minimum_size=_COMPRESSED_FROM)

    async def serve(scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            return
        path = scope["path"]
        if path.startswith("/api/") or "\0" in path or not folder.is_dir():
            raise HTTPException(404)
        if path in _PAGE and scope["method"] in ("GET", "HEAD") and (folder / "index.html").is_file():
            await whole_page(scope, receive, send)
        elif named := _NAMED.fullmatch(path):
            content = await to_thread.run_sync(linked.content, named[1], named[2])
            if content is not None and scope["method"] == "GET":
                await content.answer(Headers(scope=scope))(scope, receive, send)
            else:
                # A page opened before an upgrade gets the new file, which its browser must not keep for the
                # old.
                current = named[1] == linked.state
                await (kept if current else files)({**scope, "path": named[2]}, receive, send)
        else:
            await files(scope, receive, send)

    return serve


@dataclass(frozen=True, slots=True)
class _Content:
    """A file in memory, and compressed if that pays."""

    kind: str | None
    plain: bytes
    compressed: bytes | None

    def answer(self, headers: Headers) -> Response:
        """To a request with these headers."""
        sent = {"cache-control": _FOREVER, "vary": "accept-encoding"}
        if self.compressed is not None and "gzip" in headers.get("accept-encoding", ""):
            sent["content-encoding"] = "gzip"
            return Response(self.compressed, media_type=self.kind, headers=sent)
        return Response(self.plain, media_type=self.kind, headers=sent)


class _Linked:
    """The files under the name of their state, from memory while they are as they were in that state.

    A page asks for two hundred of them when it is first opened.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._lock = threading.Lock()
        self._marks: dict[str, tuple[int, int]] = {}
        self._contents: dict[str, _Content] = {}
        self.state = ""

    def page(self) -> tuple[str, str]:
        """Name of the present state of all files, and the page with its links under that name."""
        with self._lock:
            self._look()
            text = (self._folder / "index.html").read_text(encoding="utf-8")
            return self.state, _LINK.sub(f"/{self.state}/", text)

    def content(self, state: str, path: str) -> _Content | None:
        """A file in a state; None when that is not the present one, or there is no such file in it."""
        with self._lock:
            if state != self.state:
                self._look()
            if state != self.state or path not in self._marks:
                return None
            try:
                if path in self._contents and _mark(os.stat(self._place(path))) == self._marks[path]:
                    return self._contents[path]
                with open(self._place(path), "rb") as file:
                    mark, plain = _mark(os.fstat(file.fileno())), file.read()
            except OSError:
                mark, plain = None, b""
            if mark != self._marks[path]:  # the file has changed, and with it the state
                self._look()
                return None
            compressed = gzip.compress(plain, 6, mtime=0) if len(plain) >= _COMPRESSED_FROM else None
            self._contents[path] = _Content(mimetypes.guess_type(path)[0], plain, compressed)
            return self._contents[path]

    def _place(self, path: str) -> str:
        return f"{self._folder}{path}"

    def _look(self) -> None:
        """Look at all files: sixteen hexadecimal digits that differ when any of them does."""
        found, marks = hashlib.blake2b(digest_size=8), {}
        for place, inside, names in os.walk(self._folder):
            inside.sort()
            for name in sorted(names):
                file = os.path.join(place, name)
                try:
                    mark = _mark(os.stat(file))
                except OSError:  # removed meanwhile, or a link to nothing
                    continue
                found.update(f"{file} {mark[0]} {mark[1]}\n".encode())
                if not os.path.islink(file):  # a link may lead out of the folder: served by nobody
                    marks[file.removeprefix(str(self._folder)).replace(os.sep, "/")] = mark
        if found.hexdigest() != self.state:
            self.state, self._marks, self._contents = found.hexdigest(), marks, {}


def _mark(file: os.stat_result) -> tuple[int, int]:
    return file.st_mtime_ns, file.st_size


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
