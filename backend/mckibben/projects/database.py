"""The database of the projects: SQLite in the user's data folder, or PostgreSQL by its address."""

from __future__ import annotations

import contextlib
import errno
import sqlite3
import threading
import time
from collections.abc import Iterator
from importlib import resources
from pathlib import Path
from typing import Any

from sqlalchemy import Connection, create_engine, event, make_url, text
from sqlalchemy.exc import ArgumentError, DBAPIError, NoSuchModuleError, OperationalError
from sqlalchemy.exc import TimeoutError as PoolTimeoutError
from sqlalchemy.orm import Session

from mckibben.folder import DiskFullError, free_space, in_bytes
from mckibben.physics.errors import InputError

_WAIT = 10.0  # s; until a lock of another process is given up
_CONNECT = 2  # s; until a database that does not answer is given up
_AGAIN = 1.0  # s after which a database that did not answer is asked again
_FULL_SQLITE = {sqlite3.SQLITE_FULL, sqlite3.SQLITE_IOERR_WRITE}
_FULL_POSTGRES = "53100"  # disk_full
_INCREMENTAL = 2  # auto_vacuum of SQLite: space is given back when asked for
_LOCK = 0x6D636B69  # of a PostgreSQL database while it is migrated; any number of our own
_DIALECTS = ("sqlite", "postgresql")


class Database:
    """Sessions on a database whose tables are those of this version.

    Nothing is opened before the first session. A committed transaction survives the death of the process and
    of the machine: SQLite keeps a write-ahead log and waits for the disk.

    Args:
        address: a folder, in which ``projects.sqlite`` is kept, or an URL such as
            ``postgresql://user:secret@host/name``.

    Raises:
        InputError: it is neither, or of a database that is not supported.
    """

    def __init__(self, address: Path | str) -> None:
        if isinstance(address, Path):
            self._file = address / "projects.sqlite"
            url = make_url("sqlite://").set(database=str(self._file))
        else:
            self._file = None
            url = _url(address)
            if url.get_backend_name() == "sqlite" and url.database:
                self._file = Path(url.database)
        self._engine = create_engine(
            url,
            connect_args={"timeout": _WAIT} if self._file else _PATIENCE,
            pool_pre_ping=not self._file,
            # A connection of SQLite keeps the last content that it wrote: one may, the others are closed.
            **({"pool_size": 1} if self._file else {"pool_timeout": _CONNECT}),
        )
        self._ready = threading.Lock()
        self._migrated = False
        self._away: float | None = None  # when it did not answer last
        if self._file:
            event.listen(self._engine, "connect", _open_sqlite)
            event.listen(self._engine, "begin", _begin_sqlite)

    @property
    def place(self) -> str:
        """Where it is, without a password."""
        return str(self._file) if self._file else self._engine.url.render_as_string(hide_password=True)

    @contextlib.contextmanager
    def session(self, *, writes: bool = False) -> Iterator[Session]:
        """A transaction, committed at the end of the block and undone by an exception.

        Args:
            writes: whether it changes anything; writers of a SQLite database then wait for each other.

        Raises:
            InputError: code ``unavailable``, a database of a server cannot be reached; code ``no_space``, its
                disk is full; code ``conflict``, it cannot be read or written.
        """
        try:
            self._migrate()
            options = {"writes": writes}
            with self._engine.connect().execution_options(**options) as connection, Session(connection) as s:
                yield s
                s.commit()
        except (DBAPIError, PoolTimeoutError, OSError) as error:
            raise self._unusable(error) from error

    def taken(self, session: Session) -> int:
        """What all takes, with what this transaction has changed so far [bytes].

        SQLite keeps the pages of what was erased for what comes next; they are not counted.
        """
        if self._file:
            pages, free, size = (
                session.execute(text(f"PRAGMA {name}")).scalar_one()
                for name in ("page_count", "freelist_count", "page_size")
            )
            return (pages - free) * size
        sizes = (("contents", "data"), ("revisions", "document"), ("projects", "notes"))
        each = " + ".join(f"(SELECT coalesce(sum(octet_length({c})), 0) FROM {t})" for t, c in sizes)
        return int(session.execute(text(f"SELECT {each}")).scalar_one())

    @property
    def folder(self) -> Path:
        """On whose disk it is; of a server, that of this program."""
        return self._file.parent if self._file else Path()

    def shrink(self) -> None:
        """Give the space of what was erased back to the disk; of a server, it does so itself."""
        if not self._file:
            return
        with contextlib.suppress(DBAPIError, sqlite3.Error):
            connection = self._engine.raw_connection()
            try:
                cursor = connection.cursor()
                if cursor.execute("PRAGMA auto_vacuum").fetchone()[0] == _INCREMENTAL:
                    cursor.executescript("PRAGMA incremental_vacuum")  # `execute` ends after one page
                else:  # made by an earlier version
                    cursor.execute(f"PRAGMA auto_vacuum = {_INCREMENTAL}")
                    cursor.execute("VACUUM")
                cursor.execute("PRAGMA wal_checkpoint(TRUNCATE)").fetchall()
                cursor.close()
            finally:
                connection.close()

    def close(self) -> None:
        """Close all connections."""
        self._engine.dispose()

    def _migrate(self) -> None:
        if self._migrated:
            return
        # Who waits for another one to reach it knows as much after that time.
        if not self._ready.acquire(timeout=_WAIT if self._file else _CONNECT):
            raise self._unreachable("another request waits for it already")
        try:
            if self._migrated:
                return
            if self._away is not None and time.monotonic() - self._away < _AGAIN:
                raise self._unreachable("it did not a moment ago")
            if self._file:
                self._file.parent.mkdir(parents=True, exist_ok=True)
            with self._engine.connect().execution_options(writes=True) as connection, connection.begin():
                if not self._file:  # another server may do the same at this moment
                    connection.execute(text("SELECT pg_advisory_xact_lock(:key)"), {"key": _LOCK})
                migrate(connection)
            self._migrated = True
        finally:
            self._ready.release()

    def _unreachable(self, why: str) -> InputError:
        return InputError(
            f"the database of the projects does not answer: {why}",
            hint=f"try again; the database is {self.place}",
            code="unavailable",
        )

    def _unusable(self, error: Exception) -> InputError:
        cause = getattr(error, "orig", None) or error
        words = " ".join(str(cause).split())[:200]
        hint = f"the database is {self.place}"
        if _is_full(cause):
            free = free_space(self.folder) if self._file else None
            left = "" if free is None else f"; the disk has {in_bytes(free)} left"
            return DiskFullError(
                f"no space for the projects: {words}{left}",
                hint=f"erase what is deleted (Catalogue, Kept); {hint}",
                code="no_space",
            )
        if not self._file and isinstance(error, OperationalError | PoolTimeoutError):
            self._away = time.monotonic()
            return self._unreachable(words)
        return InputError(
            f"the projects cannot be read or written: {words}",
            hint=f"{hint}; look whether it can be read and written",
            code="conflict",
        )


#: Of libpq: what a database that is away may take.
_PATIENCE = {"connect_timeout": _CONNECT, "tcp_user_timeout": 1000 * _CONNECT}


def _is_full(cause: BaseException) -> bool:
    """Whether the disk of the database is full."""
    if isinstance(cause, sqlite3.Error):
        return getattr(cause, "sqlite_errorcode", None) in _FULL_SQLITE
    full = isinstance(cause, OSError) and cause.errno == errno.ENOSPC
    return full or getattr(cause, "sqlstate", None) == _FULL_POSTGRES


def migrate(connection: Connection) -> None:
    """Bring the database of a connection, within its transaction, to the tables of this program.

    Raises:
        InputError: a later version of this program has changed it.
    """
    from alembic import command
    from alembic.config import Config
    from alembic.util import CommandError

    configuration = Config()
    with resources.as_file(resources.files("mckibben.projects") / "migrations") as folder:
        configuration.set_main_option("script_location", str(folder).replace("%", "%%"))
        configuration.set_main_option("path_separator", "os")
        configuration.attributes["connection"] = connection
        try:
            command.upgrade(configuration, "head")
        except CommandError as error:
            raise InputError(
                "the database of the projects was made by a later version of this program",
                hint="install that version, or name another folder with --data",
                code="conflict",
            ) from error


def _url(address: str) -> Any:
    problem = f"'{address.partition('@')[2] or address}' is not the address of a database"
    hint = "e.g. 'postgresql://user:secret@host/name', or 'sqlite:///C:/data/projects.sqlite'"
    try:
        url = make_url(address)
        backend = url.get_backend_name()
        if backend == "postgresql" and url.drivername == "postgresql":
            url = url.set(drivername="postgresql+psycopg")
        url.get_dialect()
    except (ArgumentError, NoSuchModuleError, ValueError) as error:
        raise InputError(problem, field="projects", hint=hint) from error
    if backend not in _DIALECTS:
        raise InputError(f"databases of {backend} are not supported", field="projects", hint=hint)
    if backend == "postgresql":
        try:
            import psycopg  # noqa: F401
        except ImportError as error:
            raise InputError(
                "the driver of PostgreSQL is not installed",
                field="projects",
                hint="pip install 'mckibben[postgres]'",
            ) from error
    return url


def _open_sqlite(connection: Any, _: object) -> None:
    connection.isolation_level = None  # transactions begin where `_begin_sqlite` says so
    cursor = connection.cursor()
    if not cursor.execute("PRAGMA page_count").fetchone()[0]:  # a new file
        cursor.execute(f"PRAGMA auto_vacuum = {_INCREMENTAL}")
    _keep_log(cursor)
    for setting in ("synchronous = FULL", "foreign_keys = ON"):
        cursor.execute(f"PRAGMA {setting}")
    cursor.close()


def _keep_log(cursor: sqlite3.Cursor) -> None:
    """Switch a new file to its write-ahead log; nothing to do in one that has it.

    SQLite waits for other locks, but not for this one: while another connection is about to write to the
    file, it calls it locked at once, as happens where servers start together.
    """
    end = time.monotonic() + _WAIT
    while True:
        try:
            cursor.execute("PRAGMA journal_mode = WAL")
        except sqlite3.OperationalError as error:
            is_busy = error.sqlite_errorcode & 0xFF == sqlite3.SQLITE_BUSY  # its extended codes, too
            if not is_busy or time.monotonic() > end:
                raise
            time.sleep(0.01)
        else:
            return


def _begin_sqlite(connection: Connection) -> None:
    writes = connection.get_execution_options().get("writes", False)
    connection.exec_driver_sql("BEGIN IMMEDIATE" if writes else "BEGIN")
