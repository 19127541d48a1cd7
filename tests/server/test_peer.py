"""Whose program is at the other end of a connection."""

from __future__ import annotations

import os
import socket
import sys
from collections.abc import Iterator

import pytest

from mckibben.server.peer import is_own_account

linux = pytest.mark.skipif(sys.platform != "linux", reason="the kernel's table of sockets is Linux's")


@pytest.fixture(params=[("127.0.0.1", socket.AF_INET), ("::1", socket.AF_INET6)], ids=["IPv4", "IPv6"])
def listening(request: pytest.FixtureRequest) -> Iterator[socket.socket]:
    host, family = request.param
    with socket.socket(family) as listener:
        try:
            listener.bind((host, 0))
        except OSError:
            pytest.skip(f"no {host} here")
        listener.listen()
        yield listener


@linux
def test_a_program_of_the_same_account_is_known(listening: socket.socket) -> None:
    with socket.create_connection(listening.getsockname()[:2]) as client:
        other, address = listening.accept()
        with other:
            assert is_own_account(address[:2], listening.getsockname()[:2])
            assert client.getsockname()[:2] == address[:2]


@linux
@pytest.mark.skipif(
    os.name != "posix" or os.geteuid() != 0, reason="only root runs programs as somebody else"
)
def test_a_program_of_another_account_is_not(listening: socket.socket) -> None:
    host, port = listening.getsockname()[:2]
    waiting, over = os.pipe()
    stranger = os.fork()
    if stranger == 0:
        try:
            os.close(over)
            os.setuid(65534)
            with socket.create_connection((host, port)):
                os.read(waiting, 1)
        finally:
            os._exit(0)
    os.close(waiting)
    try:
        other, address = listening.accept()
        with other:
            assert not is_own_account(address[:2], (host, port))
    finally:
        os.close(over)
        os.waitpid(stranger, 0)


def test_what_is_no_connection_is_nobody_s() -> None:
    assert not is_own_account(None, ("127.0.0.1", 8000))
    assert not is_own_account(("127.0.0.1", 1), ("127.0.0.1", 2))
    assert not is_own_account(("nobody", 1), ("127.0.0.1", 2))
