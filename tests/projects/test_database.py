"""The database itself: migrations, addresses, failures, and what a killed process leaves."""

from __future__ import annotations

import contextlib
import hashlib
import os
import signal
import socket
import sqlite3
import subprocess
import sys
import threading
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest
from sqlalchemy import text

from mckibben.physics.errors import InputError
from mckibben.projects.database import Database, migrate
from mckibben.projects.migrations import versions
from mckibben.projects.store import ProjectStore
from mckibben.projects.tables import Base
from tests.projects.conftest import empty

SCHEMAS = Path(__file__).with_name("schemas")
VERSIONS = sorted(path.stem[1:5] for path in Path(versions.__path__[0]).glob("v[0-9]*.py"))
WRITER = Path(__file__).with_name("writer.py")


def test_the_migrations_end_at_the_tables(database: Database) -> None:
    from alembic.autogenerate import compare_metadata
    from alembic.migration import MigrationContext

    with database.session() as session:
        context = MigrationContext.configure(session.connection(), opts={"compare_type": True})
        assert compare_metadata(context, Base.metadata) == []


@pytest.mark.parametrize("version", VERSIONS)
def test_a_database_of_each_earlier_version_is_brought_forward(tmp_path: Path, version: str) -> None:
    """As a program of that time has left it; whoever adds a version leaves its database here."""
    with contextlib.closing(sqlite3.connect(tmp_path / "projects.sqlite")) as old:
        old.executescript((SCHEMAS / f"{version}.sql").read_text("utf-8"))
    store = ProjectStore(Database(tmp_path))
    lift, binned = "a" * 32, "b" * 32
    (file,) = store.files(lift)
    assert store.open(lift).document == {"case": file.measurement}
    assert store.open(lift, 1).document == {"step": 1}
    assert hashlib.sha256(file.content).hexdigest() == file.measurement
    assert [each.runs for each in store.studies(lift)] == ([3] if version > "0001" else [])
    assert [each.id for each in store.list(deleted=True)] == [binned]
    store.erase(binned)  # with it, the file learns to give space back
    assert store.save(lift, {"step": 3}, base_version=2).summary.version == 3
    store.close()


def test_a_database_that_is_away_is_told_at_once_and_found_again() -> None:
    with socket.create_server(("127.0.0.1", 0)) as silent:  # takes connections and says nothing
        database = Database(f"postgresql://tester:secret@127.0.0.1:{silent.getsockname()[1]}/x")
        with ThreadPoolExecutor(3) as threads:  # nobody waits for the time of the others as well
            refused = [threads.submit(ProjectStore(database).list) for _ in range(3)]
            errors = [future.exception() for future in refused]
    assert all(isinstance(error, InputError) and error.code == "unavailable" for error in errors)
    assert "secret" not in "".join(f"{error} {getattr(error, 'hint', '')}" for error in errors)
    database.close()


def test_connections_that_a_restart_has_ended_are_replaced(postgresql: str) -> None:
    database = Database(postgresql)
    empty(database)
    store = ProjectStore(database)
    store.create({}, title="Lift")
    with database._engine.begin() as connection:  # not those of other tests, which go on beside this one
        own = connection.execute(text("SELECT pg_backend_pid()")).scalar_one()
    with contextlib.closing(Database(postgresql)) as other, other._engine.begin() as connection:
        connection.execute(text("SELECT pg_terminate_backend(:own)"), {"own": own})
    assert len(store.list()) == 1
    database.close()


def test_servers_that_start_together_migrate_once(tmp_path: Path) -> None:
    stores = [ProjectStore(Database(tmp_path)) for _ in range(4)]
    start = threading.Barrier(4)

    def create(store: ProjectStore) -> str:
        start.wait(10.0)
        return store.create({}, title="Lift").summary.id

    with ThreadPoolExecutor(4) as pool:
        made = set(pool.map(create, stores))
    assert {each.id for each in stores[0].list()} == made
    assert len(made) == 4
    for store in stores:
        store.close()


def test_a_new_file_that_another_program_writes_is_waited_for(tmp_path: Path) -> None:
    """SQLite itself waits, but not where it would have to switch the file to its write-ahead log."""
    holder = sqlite3.connect(tmp_path / "projects.sqlite", isolation_level=None, check_same_thread=False)
    holder.execute("BEGIN IMMEDIATE")
    held = threading.Timer(0.3, lambda: holder.execute("ROLLBACK"))
    held.start()
    store = ProjectStore(Database(tmp_path))
    assert store.create({}, title="Lift").summary.title == "Lift"
    held.join()
    store.close()
    holder.close()


def test_a_database_of_a_later_version_is_left_alone(database: Database) -> None:
    with database.session(writes=True) as session:
        session.execute(text("UPDATE alembic_version SET version_num = '9999'"))
    database._migrated = False
    with pytest.raises(InputError, match="later version of this program"), database.session():
        pass
    with database._engine.begin() as connection:
        assert connection.scalar(text("SELECT version_num FROM alembic_version")) == "9999"
        with pytest.raises(InputError, match="later version"):
            migrate(connection)


@pytest.mark.parametrize(
    ("address", "words"),
    [
        ("nonsense", "not the address of a database"),
        ("mysql://localhost/x", "mysql are not supported|not the address"),
        ("oracle+none://localhost/x", "not the address"),
        ("postgresql://user:secret@host:no/x", "not the address"),
    ],
)
def test_addresses_that_are_none_are_refused(address: str, words: str) -> None:
    with pytest.raises(InputError, match=words) as caught:
        Database(address)
    assert "secret" not in str(caught.value)
    assert "postgresql://" in (caught.value.hint or "")


def test_a_database_that_cannot_be_reached_is_said() -> None:
    database = Database("postgresql://tester:secret@/postgres?host=/nowhere-at-all")
    with pytest.raises(InputError, match="does not answer") as caught, database.session():
        pass
    assert caught.value.code == "unavailable"
    assert "secret" not in f"{caught.value} {caught.value.hint}"
    database.close()


def test_a_file_that_is_no_database_is_said(tmp_path: Path) -> None:
    (tmp_path / "projects.sqlite").write_bytes(b"a text, not a database" * 100)
    database = Database(tmp_path)
    with pytest.raises(InputError, match="cannot be read or written"), database.session():
        pass
    database.close()


@pytest.mark.skipif(sys.platform == "win32", reason="kill -9 is of POSIX")
def test_nothing_acknowledged_is_lost_by_kill_9(database: Database, tmp_path: Path) -> None:
    """A process that saves and says so is killed; `tests.benchmarks.projects` does it fifty times."""
    address = str(tmp_path) if database._file else database._engine.url.render_as_string(hide_password=False)
    for _ in range(3):
        acknowledged = killed_while_saving(address, after=5)
        store = ProjectStore(database)
        identity, version = acknowledged[-1]
        opened = store.open(identity)
        assert opened.summary.version in (version, version + 1)
        assert opened.document == {"version": opened.summary.version, "filling": "x" * 20_000}


def killed_while_saving(address: str, *, after: int) -> list[tuple[str, int]]:
    """What a process acknowledged, with SIGKILL after some saves."""
    said = []
    with subprocess.Popen(
        [sys.executable, str(WRITER), address], stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None
        for line in process.stdout:
            identity, version = line.split()
            said.append((identity, int(version)))
            if len(said) == after:
                os.kill(process.pid, signal.SIGKILL)
                break
        said += [(line.split()[0], int(line.split()[1])) for line in process.stdout if line.endswith("\n")]
    return said
