"""Access control of the server, as pure ASGI middleware.

Four things are checked before a request reaches a route: the Host header (against DNS rebinding), the origin
of requests that change or compute something (against other pages in the same browser), the token (against
other users of this machine, and of others), and the size of the body. Every answer carries the security
headers.
"""

from __future__ import annotations

import ipaddress
import os
import re
import secrets
import socket
import time
from contextlib import suppress
from http.cookies import CookieError, SimpleCookie
from pathlib import Path
from urllib.parse import parse_qsl, quote, urlencode, urlsplit

from starlette.datastructures import Headers
from starlette.exceptions import HTTPException
from starlette.responses import RedirectResponse, Response
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from mckibben.physics.errors import InputError
from mckibben.server.errors import error_answer
from mckibben.server.peer import is_own_account
from mckibben.server.settings import LOOPBACK_NAMES, Settings, is_every_interface

JSON_LIMIT = 1_000_000
UPLOAD_LIMIT = 64_000_000
UPLOADS = frozenset(
    {("PUT", "/api/measurements"), ("POST", "/api/measurements/preview"), ("POST", "/api/projects/import")}
)

#: Bytes of all bodies that arrive or are worked on at a time: of files, and of others, which are in memory.
IN_FLIGHT = {True: 512_000_000, False: 64_000_000}
_FLIGHT_PASSES = 5  # s after which to try again
_FULL_FLIGHT = "The server is busy: too much is being sent to it at the moment."

CONTENT_SECURITY_POLICY = (
    "default-src 'self'; img-src 'self' data: blob:; style-src 'self' 'unsafe-inline'; object-src 'none'; "
    "base-uri 'none'; frame-ancestors 'none'; form-action 'none'"
)
SECURITY_HEADERS = {
    "content-security-policy": CONTENT_SECURITY_POLICY,
    "x-content-type-options": "nosniff",
    "x-frame-options": "DENY",
    "referrer-policy": "no-referrer",
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "permissions-policy": "camera=(), microphone=(), geolocation=()",
}
_RAW_HEADERS = [(name.encode(), value.encode()) for name, value in SECURITY_HEADERS.items()]
_IN_LINKS = ("token", "once")
_ONCE_WITHIN = 300.0  # s
_TOKEN = re.compile(r"[A-Za-z0-9_-]{43}")
_READING = frozenset({"GET", "HEAD"})


def new_token() -> str:
    """A new secret of 32 random bytes for the link."""
    return secrets.token_urlsafe(32)


def kept_token(data: Path) -> str:
    """The secret of a user's data folder, in the file ``token``, which only he can read; made the first time.

    It stays over starts, so that an open page goes on with a server that was started again. Where others
    could read it, it is a new one.

    Raises:
        InputError: code ``conflict``, the file can be neither read nor written.
    """
    path = data / "token"
    try:
        with suppress(FileNotFoundError):
            info, text = path.stat(), path.read_text("ascii").strip()
            private = os.name != "posix" or (info.st_uid == os.geteuid() and not info.st_mode & 0o077)
            if private and _TOKEN.fullmatch(text):
                return text
            path.unlink()
        data.mkdir(parents=True, exist_ok=True)
        token = new_token()
        with os.fdopen(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w") as file:
            file.write(f"{token}\n")
    except FileExistsError:  # another server has just made it
        return kept_token(data)
    except (OSError, UnicodeError) as error:
        why = getattr(error, "strerror", None) or str(error)
        raise InputError(
            f"the token cannot be kept in {path}: {why}", hint="name a folder of your own with --data",
            code="conflict",
        ) from error  # fmt: skip
    return token


def _host_name(host: str) -> str | None:
    """Name part of a Host header, lower case; None when it is malformed."""
    try:
        parts = urlsplit(f"//{host}")
        _ = parts.port  # raises when it is not a port number
    except ValueError:
        return None
    if parts.username is not None or parts.path or parts.query or parts.fragment:
        return None
    return parts.hostname


class HttpMiddleware:
    """What `answer` does with requests; all else passes."""

    def __init__(self, app: ASGIApp) -> None:
        self.app = app

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request, or pass on what is none."""
        await (self.answer if scope["type"] == "http" else self.app)(scope, receive, send)

    async def answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer one request."""
        raise NotImplementedError


class SecurityMiddleware:
    """Host, origin and token checks, and the security headers on every answer."""

    def __init__(self, app: ASGIApp, *, settings: Settings) -> None:
        self.app = app
        self._token = settings.token
        self._once, self._made = settings.once, time.monotonic()
        self._own_account = settings.own_account
        # Cookies are shared between ports: two servers on one machine need two names.
        self._cookie = f"mckibben-{settings.port}"
        self._hosts = {*LOOPBACK_NAMES, settings.host.strip("[]").lower()}
        self._any_address = is_every_interface(settings.host)
        if self._any_address:
            self._hosts.add(socket.gethostname().lower())

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Check one request, then pass it on or refuse it."""
        if scope["type"] == "lifespan":
            await self.app(scope, receive, send)
            return
        if scope["type"] != "http":
            # There are no WebSockets; closing before accepting answers 403.
            await send({"type": "websocket.close", "code": 1008})
            return

        async def send_with_headers(message: Message) -> None:
            if message["type"] == "http.response.start":
                message["headers"] = [*message["headers"], *_RAW_HEADERS]
            await send(message)

        headers = Headers(scope=scope)
        refusal = self._refuse_host(headers) or self._refuse_origin(scope, headers)
        if refusal is None and self._token is not None:
            refusal = self._refuse_stranger(scope, headers, self._token)
        await (refusal or self.app)(scope, receive, send_with_headers)

    def _refuse_host(self, headers: Headers) -> Response | None:
        """Refuse other host names: a foreign page can point its name at 127.0.0.1, but not change Host."""
        hosts = headers.getlist("host")
        name = _host_name(hosts[0]) if len(hosts) == 1 else None
        if name is not None and (name in self._hosts or (self._any_address and _is_address(name))):
            return None
        return error_answer(
            403,
            f"This server does not answer to the host name '{', '.join(hosts)[:80]}'.",
            code="host_refused",
            hint="Open it as http://127.0.0.1 with its port, or start it with --host and that name.",
        )

    def _refuse_origin(self, scope: Scope, headers: Headers) -> Response | None:
        """Refuse requests other than GET from pages of other sites."""
        if scope["method"] in _READING:
            return None
        site, origin = headers.get("sec-fetch-site"), headers.get("origin")
        own_site = site is None or site in ("same-origin", "none")
        own_origin = origin is None or urlsplit(origin).netloc.lower() == headers.get("host", "").lower()
        if own_site and own_origin:
            return None
        return error_answer(
            403,
            "This request comes from another site.",
            code="origin_refused",
            hint="Send it from a page of this server, or without an Origin header.",
        )

    def _refuse_stranger(self, scope: Scope, headers: Headers, token: str) -> Response | None:
        """Refuse requests without the token, which is in the link (then set as cookie), cookie or header.

        The link with which the program opens the browser holds a code instead that works once: other users
        of the machine see the arguments of programs.
        """
        query = parse_qsl(scope["query_string"].decode("latin-1"), keep_blank_values=True)
        known = _same(_cookie_value(headers.get("cookie", ""), self._cookie), token)
        shown = [(name, value) for name, value in query if name in _IN_LINKS]
        if shown and scope["method"] == "GET" and (self._opens(*shown[0], token) or known):
            rest = urlencode([pair for pair in query if pair[0] not in _IN_LINKS])
            # One leading slash only: '//name' would be the address of another server.
            clean = "/" + quote(scope["path"].lstrip("/\\"), safe="/") + (f"?{rest}" if rest else "")
            answer = RedirectResponse(clean, status_code=303)
            # Lax: a link on another page may lead here. What such a page sends is refused by its origin.
            secure = scope["scheme"] == "https"
            answer.set_cookie(self._cookie, token, httponly=True, samesite="lax", path="/", secure=secure)
            answer.headers["cache-control"] = "no-store"
            return answer
        scheme, _, secret = headers.get("authorization", "").partition(" ")
        if known or (scheme.lower() in ("bearer", "token") and _same(secret.strip(), token)):
            return None
        # What its user runs could read the file with the token, so that it need not send it.
        if (
            self._own_account
            and not _is_for_other_pages(headers)
            and is_own_account(scope.get("client"), scope.get("server"))
        ):
            return None
        answer = error_answer(
            401,
            "This server needs its token.",
            code="token_required",
            hint="Open the link that 'mckibben serve' printed (…/?token=…), or send 'Authorization: Bearer "
            "<token>' with the token of the file that it names.",
        )
        answer.headers["www-authenticate"] = "Bearer"
        return answer

    def _opens(self, name: str, value: str, token: str) -> bool:
        """Whether what a link holds opens the server: the token, or the code that works once."""
        if name == "token":
            return _same(value, token)
        if self._once is None or time.monotonic() - self._made > _ONCE_WITHIN or not _same(value, self._once):
            return False
        self._once = None
        return True


def _is_address(name: str) -> bool:
    """Whether the host is a literal address: it cannot be rebound by a name server."""
    try:
        ipaddress.ip_address(name)
    except ValueError:
        return False
    return True


def _is_for_other_pages(headers: Headers) -> bool:
    """Whether a browser says that another page wants it, or does not say whose wish it is."""
    site = headers.get("sec-fetch-site")
    if site is None:  # a program, or a browser of before 2023
        return "origin" in headers or "referer" in headers
    return site not in ("none", "same-origin")


def _same(secret: str, token: str) -> bool:
    return secrets.compare_digest(secret.encode("utf-8", "surrogateescape"), token.encode())


def _cookie_value(header: str, name: str) -> str:
    try:
        morsel = SimpleCookie(header).get(name)
    except CookieError:
        return ""
    return morsel.value if morsel else ""


class BodyLimitMiddleware(HttpMiddleware):
    """Refuse a body that is too large, alone or beside others: by its declared length, or as it streams in.

    Files arrive on the disk, other bodies in memory; each has its budget of bytes that are in flight.
    """

    def __init__(self, app: ASGIApp, *, in_flight: dict[bool, int]) -> None:
        super().__init__(app)
        self._in_flight = in_flight  # whether they are files -> bytes

    async def answer(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Pass one request on with its body counted."""
        is_file = (scope["method"], scope["path"]) in UPLOADS
        limit = UPLOAD_LIMIT if is_file else JSON_LIMIT
        message = f"The body is larger than {limit // 1_000_000} MB."
        declared = Headers(scope=scope).get("content-length", "0")
        if not (declared.isascii() and declared.isdigit()):
            refusal = error_answer(400, "Content-Length is not a number.", code="bad_header")
            await refusal(scope, receive, send)
            return
        # Compare the number of digits first: int() refuses more than 4300.
        if len(declared.lstrip("0")) > 12 or int(declared) > limit:
            await error_answer(413, message)(scope, receive, send)
            return
        received = held = 0

        def hold(size: int) -> None:
            """Count the body as in flight, at first as large as it declares to be."""
            nonlocal held
            if size > held:
                if self._in_flight[is_file] + size - held > IN_FLIGHT[is_file]:
                    raise HTTPException(429, _FULL_FLIGHT, {"retry-after": str(_FLIGHT_PASSES)})
                self._in_flight[is_file] += size - held
                held = size

        async def counted() -> Message:
            nonlocal received
            part = await receive()
            received += len(part.get("body", b""))
            if received > limit:
                raise HTTPException(413, message)
            hold(received)
            return part

        try:
            hold(int(declared))
            await self.app(scope, counted, send)
        except HTTPException as refused:  # by its declared length; later ones are answered inside
            answer = error_answer(
                refused.status_code, str(refused.detail), hint=f"Try again in {_FLIGHT_PASSES} s."
            )
            answer.headers.update(refused.headers or {})
            await answer(scope, receive, send)
        finally:
            self._in_flight[is_file] -= held
