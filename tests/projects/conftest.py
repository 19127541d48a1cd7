"""Databases of the tests: SQLite, and a real PostgreSQL of its own where one is installed."""

from __future__ import annotations

import contextlib
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from uuid import uuid4

import pytest
from sqlalchemy import make_url

from mckibben.projects.database import Database
from mckibben.projects.store import ProjectStore

#: Address of a PostgreSQL in which the tests may make databases.
SERVER_VARIABLE = "MCKIBBEN_TEST_POSTGRESQL"


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


@contextlib.contextmanager
def _database_on(server: str) -> Iterator[str]:
    """A database of this process alone on a server that runs already: others test there at the same time."""
    import psycopg

    name = f"test_{uuid4().hex}"
    with psycopg.connect(server, autocommit=True) as connection:
        connection.execute(f'CREATE DATABASE "{name}"')
        yield make_url(server).set(database=name).render_as_string(hide_password=False)
        connection.execute(f'DROP DATABASE "{name}" WITH (FORCE)')


@pytest.fixture(scope="session")
def postgresql() -> Iterator[str]:
    """Address of a database on the server that `.ci/run` started, else on one of this test run alone."""
    if server := os.environ.get(SERVER_VARIABLE):
        with _database_on(server) as address:
            yield address
    else:
        yield from _server_of_its_own()


def _server_of_its_own() -> Iterator[str]:
    """A server that is reached through a socket in its own folder."""
    programs = None if sys.platform == "win32" else _programs()
    if programs is None:
        pytest.skip("PostgreSQL is not installed (Debian and Ubuntu: apt-get install postgresql)")
    folder = Path(tempfile.mkdtemp(prefix="mckibben-pg-"))  # short: of a socket's path at most 107 characters
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
