"""How a server listens: limits on connections and on the time that a request may take, what it writes.

uvicorn accepts as many connections as there are descriptors and waits for each request for ever. Here a new
connection takes the place of one that has not sent a whole request, so that a few hundred half requests keep
nobody from being answered; only when all are at work is it refused.

What is written to the terminal: a level, a line for each request if asked for, never a flood. The token of a
link is not written.
"""

from __future__ import annotations

import asyncio
import copy
import json
import logging
import re
import sys
import time
import traceback
from collections import Counter
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, ClassVar

import uvicorn
from fastapi import FastAPI
from uvicorn.config import LOGGING_CONFIG
from uvicorn.protocols.http.h11_impl import H11Protocol

from mckibben.server.settings import Settings, is_loopback

_END_WITHIN = 2  # s for requests at work
_LEAST_ACCEPTED, _SHARE_ACCEPTED = 8, 32
#: Connections that the system keeps until they are accepted.
WAITING_CONNECTIONS = 1024

MOST_CONNECTIONS = 1000
LEAST_CONNECTIONS = 16
_WISHED_FILES = 4096  # descriptors; systems begin with 256 to 1024, and allow more when asked
_HEADERS_WITHIN = 10.0  # s, all of them
_BODY_WITHIN = 20.0  # s, from one piece to the next
_SLOW_WITHIN = 30.0  # s that a body may take however slow it is, then
_LEAST_RATE = 10_000.0  # bytes/s on the mean
_JUST_COME = 0.1  # s
_LOOKS = 3  # rounds of the event loop in which what has arrived on a new connection is read
_TAKEN_WITHIN = 60.0  # s in which nothing of an answer is taken

LEVELS = ("critical", "error", "warning", "info", "debug")
_MOST_ALIKE = 5  # lines of one message in a while
_WHILE = 10.0  # s
_TOKEN = re.compile(r"(?<=[?&])(token|once)=[^&\s]*")


def serving(
    app: FastAPI, settings: Settings, certificate: tuple[Path, Path | None] | None = None
) -> uvicorn.Config:
    """The configuration of uvicorn.

    Args:
        app: the application.
        settings: address and what is written to the terminal.
        certificate: files of a certificate and of its key (None = in the same file), for HTTPS.
    """
    files = open_files()
    access = not is_loopback(settings.host) if settings.access_log is None else settings.access_log
    config = uvicorn.Config(
        app,
        http=guarded(connections_for(files), app.state.requests.refused),
        ws="none",
        log_config=log_config(settings.log_level, as_json=settings.log_json),
        log_level=settings.log_level,
        access_log=access,
        server_header=False,
        proxy_headers=False,
        timeout_graceful_shutdown=_END_WITHIN,
        ssl_certfile=certificate and certificate[0],
        ssl_keyfile=certificate and certificate[1],
        # As many are accepted at once, before one of them is counted.
        backlog=max(_LEAST_ACCEPTED, files // _SHARE_ACCEPTED),
    )
    if access:  # at any level: it was asked for
        logging.getLogger("uvicorn.access").setLevel(logging.INFO)
    return config


def connections_for(files: int) -> int:
    """Connections that a process with so many descriptors takes; half stay for files and workers."""
    return min(MOST_CONNECTIONS, max(LEAST_CONNECTIONS, files // 2))


def open_files() -> int:
    """Descriptors that this process may open, after asking for more where there are few."""
    if sys.platform == "win32":
        return _WISHED_FILES
    import resource

    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    wished = _WISHED_FILES if hard == resource.RLIM_INFINITY else min(_WISHED_FILES, hard)
    if soft == resource.RLIM_INFINITY or soft >= wished:
        return _WISHED_FILES if soft == resource.RLIM_INFINITY else soft
    try:
        resource.setrlimit(resource.RLIMIT_NOFILE, (wished, hard))
    except (ValueError, OSError):  # macOS says "unlimited" and allows less
        return soft
    return wished


class GuardedProtocol(H11Protocol):
    """HTTP/1.1 of uvicorn, with limits.

    Attributes:
        most: connections at a time.
        headers_within, body_within, taken_within: time for all headers, for the next piece of a body, and for
            a piece of the answer to be taken [s].
        refused: connections that were ended, by why.
        slow_within, least_rate: time that a whole body may take however slow it is [s], and the mean rate of
            one that takes longer [bytes/s].
    """

    most = MOST_CONNECTIONS
    headers_within = _HEADERS_WITHIN
    body_within = _BODY_WITHIN
    slow_within = _SLOW_WITHIN
    least_rate = _LEAST_RATE
    taken_within = _TAKEN_WITHIN
    refused: ClassVar[Counter[str]] = Counter()

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self._timer: asyncio.TimerHandle | None = None
        self._taking: asyncio.TimerHandle | None = None
        self._heard, self._served = 0.0, False
        self._body_of: object = None
        self._body_since, self._body_size = 0.0, 0

    def connection_made(self, transport: asyncio.Transport) -> None:  # pyright: ignore - as uvicorn
        """Take the connection, in the place of another one if there are too many."""
        super().connection_made(transport)
        self._heard = self.loop.time()
        self._wait(self.headers_within)
        if len(self.connections) > self.most:
            self._make_room()

    def connection_lost(self, exc: Exception | None) -> None:
        """Forget it."""
        self._wait(None)
        self._stop_taking()
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Take a piece of a request."""
        self._heard = self.loop.time()
        super().data_received(data)
        if self._in_body():
            if self._body_of is not self.cycle:
                self._body_of, self._body_since, self._body_size = self.cycle, self._heard, 0
            self._body_size += len(data)
            left = self.slow_within + self._body_size / self.least_rate - (self._heard - self._body_since)
            if left < 0.0:
                self._too_slow()
            else:
                self._wait(min(self.body_within, left))
        elif self._at_work():
            self._wait(None)
        elif self._timer is None:
            self._wait(self.headers_within)  # of all headers: a further piece gives no further time

    def pause_writing(self) -> None:
        """The other side takes nothing at the moment."""
        super().pause_writing()
        if self._taking is None:
            self._taking = self.loop.call_later(self.taken_within, self._not_taken)

    def resume_writing(self) -> None:
        """It takes what is sent again."""
        super().resume_writing()
        self._stop_taking()

    def on_response_complete(self) -> None:
        """The next request may begin; what of it has arrived already counts."""
        super().on_response_complete()
        self._served = True
        if not self._at_work() and self.conn.trailing_data[0]:
            self._wait(self.headers_within)

    def _not_taken(self) -> None:
        self.refused["the answer was not taken"] += 1
        self.transport.abort()

    def _stop_taking(self) -> None:
        if self._taking is not None:
            self._taking.cancel()
            self._taking = None

    def _at_work(self) -> bool:
        return self.cycle is not None and not self.cycle.response_complete

    def _in_body(self) -> bool:
        return self._at_work() and self.cycle.more_body

    def _wait(self, seconds: float | None) -> None:
        if self._timer is not None:
            self._timer.cancel()
        self._timer = None if seconds is None else self.loop.call_later(seconds, self._too_slow)

    def _too_slow(self) -> None:
        self._end(b"408 Request Timeout", b"the request did not arrive in time")

    def _make_room(self, looks: int = _LOOKS) -> None:
        """End the connection that has been silent longest among those without a whole request.

        Only after what has arrived is read: on a busy machine a request may lie there longer than it takes.
        """
        if looks:
            self.loop.call_soon(self._make_room, looks - 1)
            return
        if len(self.connections) <= self.most or self.transport.is_closing():
            return
        now = self.loop.time()
        waiting = [
            other
            for other in self.connections
            if isinstance(other, GuardedProtocol)
            and other is not self
            and (not other._at_work() or other._in_body())
        ]
        if not waiting:
            self._end(b"503 Service Unavailable", b"too many connections")
            return
        victim = min(waiting, key=lambda other: other._worth(now))
        self.connections.discard(victim)  # pyright: ignore - a protocol of uvicorn
        victim.transport.abort()
        self.refused["made room"] += 1

    def _worth(self, now: float) -> tuple[int, bool, float]:
        """Of a connection that waits: the smallest is ended first.

        First who has sent no whole request in the time that one takes. Then who has been answered before:
        clients expect such an end and connect again. What has just come may be a request on its way.
        """
        rank = 1 if self._served else 0 if now - self._heard > _JUST_COME else 2
        return rank, self.cycle is not None, self._heard

    def send_400_response(self, msg: str) -> None:
        """Refuse what is no HTTP; uvicorn answers in plain text."""
        self._end(b"400 Bad Request", b"this is not a request of HTTP/1.1", b"bad_request")

    def _end(self, status: bytes, why: bytes, code: bytes = b"busy") -> None:
        if self.cycle is None or self.cycle.response_complete or not self.cycle.response_started:
            body = b'{"error":{"code":"%s","message":"%s","field":null,"hint":null}}' % (code, why)
            self.transport.write(
                b"HTTP/1.1 %s\r\ncontent-type: application/json\r\nconnection: close\r\nretry-after: 1\r\n"
                b"content-length: %d\r\n\r\n%s" % (status, len(body), body)
            )
        self.refused[why.decode()] += 1
        self.connections.discard(self)  # pyright: ignore - a protocol of uvicorn
        self.transport.close()


def guarded(most: int, refused: Counter[str]) -> type[GuardedProtocol]:
    """The protocol for a server that takes so many connections; it counts those that it ends."""
    return type("Guarded", (GuardedProtocol,), {"most": most, "refused": refused})


class Seldom(logging.Filter):
    """Lets a message through a few times in a while, and says how many were left out.

    Args:
        most: lines of one message in a while.
        seconds: how long a while is [s].
    """

    def __init__(self, most: int = _MOST_ALIKE, seconds: float = _WHILE) -> None:
        super().__init__()
        self._most, self._seconds = most, seconds
        self._seen: dict[str, tuple[float, int]] = {}

    def filter(self, record: logging.LogRecord) -> bool:
        """Whether it is written."""
        # What asyncio says of a socket differs in its number alone.
        key = f"{record.name} {record.levelno} {re.sub(r'[0-9]+', '#', str(record.msg))[:200]}"
        now = time.monotonic()
        since, count = self._seen.get(key, (now, 0))
        if now - since > self._seconds:
            if count > self._most:
                record.msg = f"{record.getMessage()} (and {count - self._most} more like it before)"
                record.args = ()
            since, count = now, 0
        self._seen[key] = since, count + 1
        return count < self._most


class WithoutToken(logging.Filter):
    """Takes the token out of the lines of requests."""

    def filter(self, record: logging.LogRecord) -> bool:
        """Always written."""
        if isinstance(record.args, tuple):
            record.args = tuple(
                _TOKEN.sub(r"\1=...", item) if isinstance(item, str) else item for item in record.args
            )
        return True


class JsonLines(logging.Formatter):
    """One JSON object a line: when, how bad, who, what; of a request method, path without its query, status.

    A query may hold names of files and tokens; bodies are never written.
    """

    def format(self, record: logging.LogRecord) -> str:
        """The line."""
        line: dict[str, object] = {
            "time": datetime.fromtimestamp(record.created, UTC).isoformat(timespec="milliseconds"),
            "level": record.levelname.lower(),
            "logger": record.name,
        }
        if record.name == "uvicorn.access" and isinstance(record.args, tuple) and len(record.args) == 5:
            client, method, path, _, status = record.args
            path = str(path).partition("?")[0]
            line |= {"client": client, "method": method, "path": path, "status": status}
        else:
            line["message"] = record.getMessage()
        if record.exc_info:
            line["traceback"] = "".join(traceback.format_exception(*record.exc_info))
        return json.dumps(line, ensure_ascii=False, default=str)


def log_config(level: str, *, as_json: bool = False) -> dict[str, Any]:
    """Configuration of the loggers of the server, for `logging.config.dictConfig`.

    Args:
        level: of `LEVELS`.
        as_json: whether each line is a JSON object.
    """
    config: dict[str, Any] = copy.deepcopy(LOGGING_CONFIG)
    if as_json:
        config["formatters"] = {name: {"()": JsonLines} for name in config["formatters"]}
    config["filters"] = {"seldom": {"()": Seldom}, "without_token": {"()": WithoutToken}}
    config["handlers"]["default"]["filters"] = ["seldom"]
    config["handlers"]["access"]["filters"] = ["without_token"]
    own = {"handlers": ["default"], "level": level.upper(), "propagate": False}
    # What others warn of is a matter of theirs.
    others = {**own, "level": "ERROR" if level in ("critical", "error", "warning") else level.upper()}
    config["loggers"] |= {"mckibben": own, "asyncio": others}
    return config
