"""How a server listens: limits on connections, what it writes, how it ends."""

from __future__ import annotations

import logging

import uvicorn
from fastapi import FastAPI

from mckibben.server.guard import connections_for, guarded, open_files
from mckibben.server.logs import log_config
from mckibben.server.settings import Settings, is_loopback

_END_WITHIN = 2  # s for requests at work
_LEAST_ACCEPTED, _SHARE_ACCEPTED = 8, 32
#: Connections that the system keeps until they are accepted.
WAITING_CONNECTIONS = 1024


def serving(app: FastAPI, settings: Settings) -> uvicorn.Config:
    """The configuration of uvicorn.

    Args:
        app: the application.
        settings: address and what is written to the terminal.
    """
    files = open_files()
    access = not is_loopback(settings.host) if settings.access_log is None else settings.access_log
    config = uvicorn.Config(
        app,
        http=guarded(connections_for(files)),
        ws="none",
        log_config=log_config(settings.log_level),
        log_level=settings.log_level,
        access_log=access,
        server_header=False,
        proxy_headers=False,
        timeout_graceful_shutdown=_END_WITHIN,
        # As many are accepted at once, before one of them is counted.
        backlog=max(_LEAST_ACCEPTED, files // _SHARE_ACCEPTED),
    )
    if access:  # at any level: it was asked for
        logging.getLogger("uvicorn.access").setLevel(logging.INFO)
    return config
