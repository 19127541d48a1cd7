"""The server of the tests of routes, for claims that hold at every door."""

from tests.server.conftest import shared_client

__all__ = ["shared_client"]
