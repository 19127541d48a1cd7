"""The Python door with an empty data folder, and command lines beside it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

from mckibben.door import workspace
from tests.cli.conftest import run  # noqa: F401 - the fixture


@pytest.fixture(autouse=True)
def _own_folders(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Relative paths are of the test's folder."""
    monkeypatch.chdir(tmp_path)


@pytest.fixture(autouse=True, scope="module")
def _own_session(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """No test reads the user's own data folder; the presets are read once for a file of tests."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("MCKIBBEN_DATA", str(tmp_path_factory.mktemp("data")))
        patch.setattr(workspace, "_session", workspace._Session())
        yield
