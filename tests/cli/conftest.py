"""Command lines run in this process, in folders of the test's own."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from mckibben import cli

Run = Callable[..., tuple[int, str, str]]


@pytest.fixture(autouse=True)
def _own_folders(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """No test reads or writes the user's own data folder; relative paths are of the test's folder."""
    monkeypatch.setenv("MCKIBBEN_DATA", str(tmp_path / "data"))
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def run(capsysbinary: pytest.CaptureFixture[bytes]) -> Run:
    """Run a command line in this process: exit code, stdout, stderr."""

    def call(*arguments: str) -> tuple[int, str, str]:
        code = cli.run([*arguments])
        captured = capsysbinary.readouterr()
        return code, captured.out.decode(), captured.err.decode()

    return call


def result_of(out: str) -> dict[str, Any]:
    """The result in what ``--json`` printed, without the schema that it begins with."""
    answer = json.loads(out)
    assert answer.pop("schema") == 1
    return answer


def write(name: str, content: object) -> str:
    """Write a text, or anything else as JSON; its name."""
    Path(name).write_text(content if isinstance(content, str) else json.dumps(content), "utf-8")
    return name
