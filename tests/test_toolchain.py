"""The checks a person would run by hand before a commit, each one test with the tool's own report."""

from __future__ import annotations

import subprocess
import sys
import sysconfig
from collections.abc import Sequence
from pathlib import Path

import pytest
from deno import find_deno_bin

from tests.pyright_environment import pyright_environment
from tests.server import typescript

ROOT = Path(__file__).parents[1]
FRONTEND = ROOT / "frontend"
DENO_CONFIG = ("--config", str(FRONTEND / "deno.json"))
PYTHON = ("backend", "tests")


def check(command: Sequence[str], tmp_path: Path) -> None:
    """Run a tool at the root of the checkout, offline and with caches of its own; fail with its report."""
    environment = {
        **pyright_environment(),
        "NO_COLOR": "1",
        "DENO_DIR": str(tmp_path / "deno"),
        "DENO_NO_UPDATE_CHECK": "1",
    }
    run = subprocess.run(
        command,
        cwd=ROOT,
        env=environment,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
        timeout=300,
        check=False,
    )
    if run.returncode != 0:
        pytest.fail(f"$ {' '.join(command)}\n{run.stdout}", pytrace=False)


def test_ruff_lint(tmp_path: Path) -> None:
    check([sys.executable, "-m", "ruff", "check", "--no-cache", *PYTHON], tmp_path)


def test_ruff_format(tmp_path: Path) -> None:
    check([sys.executable, "-m", "ruff", "format", "--check", "--no-cache", *PYTHON], tmp_path)


def test_types(tmp_path: Path) -> None:
    check([sys.executable, "-m", "ty", "check", "--python", sys.prefix, "--no-progress"], tmp_path)


def test_types_of_the_public_names(tmp_path: Path) -> None:
    """By pyright, strict where pyproject.toml says so; `python -m tests.benchmarks.types` does all files."""
    public = ("backend/mckibben/__init__.py", "tests/door/script.py", "tests/door/typed.py")
    check([sys.executable, "-m", "pyright", "--pythonpath", sys.executable, *public], tmp_path)


def test_layers(tmp_path: Path) -> None:
    lint_imports = Path(sysconfig.get_path("scripts")) / "lint-imports"
    check([str(lint_imports), "--config", "pyproject.toml", "--no-cache"], tmp_path)


def test_javascript_types(tmp_path: Path) -> None:
    typescript.write()
    modules = sorted(str(file) for file in (FRONTEND / "app" / "js").rglob("*.js"))
    check([find_deno_bin(), "check", "--no-remote", "--no-npm", *DENO_CONFIG, *modules], tmp_path)


def test_javascript_lint(tmp_path: Path) -> None:
    check([find_deno_bin(), "lint", *DENO_CONFIG, "frontend/app/js"], tmp_path)


def test_javascript_format(tmp_path: Path) -> None:
    check([find_deno_bin(), "fmt", "--check", *DENO_CONFIG, "frontend/app"], tmp_path)
