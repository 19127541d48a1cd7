"""Databases of the tests: SQLite, and a real PostgreSQL of its own where one is installed."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from mckibben.projects.database import Database
from mckibben.projects.store import ProjectStore


def _programs() -> Path | None:
    """Folder of PostgreSQL's programs; Debian keeps them off the PATH."""
    found = shutil.which("initdb")
    places = (
        [Path(found).parent] if found else sorted(Path("/usr/lib/postgresql").glob("*/bin"), reverse=True)
    )
    return next((place for place in places if (place / "initdb").exists()), None)


def _as_user(command: list[str]) -> None:
    """Run a program of PostgreSQL, which refuses to be root."""
    if os.getuid() == 0:
        command = ["runuser", "-u", "postgres", "--", *command]
    subprocess.run(command, check=True, capture_output=True, timeout=60)


@pytest.fixture(scope="session")
def postgresql(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Address of a server of this test run alone, reached through a socket in its own folder."""
    programs = None if sys.platform == "win32" else _programs()
    if programs is None:
        pytest.skip("PostgreSQL is not installed (Debian and Ubuntu: apt-get install postgresql)")
    import tempfile

    folder = Path(
        tempfile.mkdtemp(prefix="mckibben-pg-")
    )  # short: a socket's path has at most 107 characters
    if os.getuid() == 0:
        shutil.chown(folder, "postgres")
    data = folder / "data"
    _as_user([str(programs / "initdb"), "-D", str(data), "-U", "tester", "-A", "trust", "--no-sync"])
    settings = f"-c listen_addresses='' -c unix_socket_directories={folder} -c fsync=off"
    control = [str(programs / "pg_ctl"), "-D", str(data), "-w"]
    _as_user([*control, "-o", settings, "-l", str(folder / "log"), "start"])
    try:
        yield f"postgresql://tester@/postgres?host={folder}"
    finally:
        _as_user([*control, "-m", "immediate", "stop"])
        shutil.rmtree(folder, ignore_errors=True)


@pytest.fixture(params=["sqlite", "postgresql"])
def database(request: pytest.FixtureRequest, tmp_path: Path) -> Iterator[Database]:
    """An empty database of each kind."""
    if request.param == "sqlite":
        found = Database(tmp_path)
    else:
        found = Database(request.getfixturevalue("postgresql"))
        empty(found)
    yield found
    found.close()


def empty(database: Database) -> None:
    """Remove all tables of a PostgreSQL database."""
    from sqlalchemy import text

    with database._engine.begin() as connection:
        connection.execute(text("DROP SCHEMA public CASCADE"))
        connection.execute(text("CREATE SCHEMA public"))


@pytest.fixture
def store(database: Database) -> ProjectStore:
    """A store of each kind."""
    return ProjectStore(database)
