"""Settings of a server."""

from __future__ import annotations

import ipaddress
from dataclasses import dataclass, field
from pathlib import Path

from mckibben.folder import QUOTAS, Quotas
from mckibben.measurement.reading.limits import MOST_MEMORY
from mckibben.resources import frontend_folder, presets_folder, user_folder

LOOPBACK_NAMES = frozenset({"localhost", "127.0.0.1", "::1"})


def is_loopback(host: str) -> bool:
    """Whether an address is reachable from this machine only."""
    name = host.strip("[]").lower()
    try:
        return ipaddress.ip_address(name).is_loopback
    except ValueError:
        return name in LOOPBACK_NAMES


def is_every_interface(host: str) -> bool:
    """Whether binding to this address listens on every network of the machine (``0.0.0.0``, ``::``)."""
    try:
        return ipaddress.ip_address(host.strip("[]")).is_unspecified
    except ValueError:
        return host == ""


@dataclass(frozen=True, slots=True)
class Settings:
    """Address, access token and folders of the server.

    Attributes:
        host, port: the address it listens on.
        token: secret that every request must contain; required when ``host`` is not loopback. None where
            another one decides who may connect, as the file of a Unix socket does.
        once: secret of a link that works once, in the minutes after the start.
        own_account: whether what the account that it runs under starts needs no token (Linux, loopback); a
            browser needs it for what other pages want.
        presets: folder of the built-in presets.
        user_presets: folder of the user's presets, where new ones are saved; None = saving is refused.
        effects: folders with further effect files.
        data: folder for uploaded measurements.
        projects: address of the projects' database; None = SQLite in the data folder.
        frontend: the folder served at ``/``.
        workers: processes for long work, and as many again, two at most, that read files and that hold
            models with what the user typed; 0 = threads of the server, which share one interpreter.
        queue: jobs that may wait for a worker; more are refused.
        worker_memory: bytes that one of them may take.
        reader_memory: bytes that one that reads files may take.
        quotas: bytes that each kind of what is kept may take on the disk.
        log_level: of what the server writes to the terminal.
        log_json: whether each line of it is a JSON object.
        access_log: whether it writes a line for each request; None = only when it is reachable from outside.
    """

    host: str = "127.0.0.1"
    port: int = 8000
    token: str | None = None
    once: str | None = None
    own_account: bool = False
    presets: Path = field(default_factory=presets_folder)
    user_presets: Path | None = None
    effects: tuple[Path, ...] = ()
    data: Path = field(default_factory=user_folder)
    projects: str | None = None
    frontend: Path = field(default_factory=frontend_folder)
    workers: int = 0
    queue: int = 16
    worker_memory: int = 3_000_000_000
    reader_memory: int = MOST_MEMORY
    quotas: Quotas = QUOTAS
    log_level: str = "warning"
    log_json: bool = False
    access_log: bool | None = None

    def __post_init__(self) -> None:
        if not is_loopback(self.host) and not self.token:
            raise ValueError(f"a server on {self.host} is reachable from outside and needs a token")
