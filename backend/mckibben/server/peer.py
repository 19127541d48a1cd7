"""Whose program is at the other end of a connection of this machine (Linux)."""

from __future__ import annotations

import os
import socket
import sys
from contextlib import suppress
from pathlib import Path

Address = tuple[str, int]


def is_own_account(client: Address | None, server: Address | None) -> bool:
    """Whether a connection comes from a program of the account that this server runs under.

    The kernel says who owns each socket of the machine. On other systems, through another network namespace,
    or where the connection is over, the answer is no.

    Args:
        client: address and port from which it comes.
        server: address and port to which it goes.
    """
    if client is None or server is None or sys.platform != "linux":
        return False
    with suppress(OSError, ValueError):
        for family, table in ((socket.AF_INET, "tcp"), (socket.AF_INET6, "tcp6")):
            here, there = _written(family, *client), _written(family, *server)
            if here is None or there is None:
                continue
            for line in Path(f"/proc/net/{table}").read_text("ascii").splitlines()[1:]:
                parts = line.split()
                if parts[1] == here and parts[2] == there:
                    return int(parts[7]) == os.geteuid()
    return False


def _written(family: socket.AddressFamily, host: str, port: int) -> str | None:
    """An address as the kernel writes it: words in the order of the processor, hexadecimal."""
    try:
        packed = socket.inet_pton(family, host)
    except OSError:
        return None
    words = [packed[i : i + 4] for i in range(0, len(packed), 4)]
    if sys.byteorder == "little":
        words = [word[::-1] for word in words]
    return f"{b''.join(words).hex().upper()}:{port:04X}"
