"""Command lines in folders of the test's own."""

from __future__ import annotations

from tests.cli.conftest import _own_folders, run  # noqa: F401 - the fixtures
