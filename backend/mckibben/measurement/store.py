"""Uploaded measurements on disk, addressed by content: a file uploaded twice is stored once.

``<sha256>.data`` holds the bytes of a file, ``<id>.json`` its name. A file uploaded with a mapping of its
columns has a different id; its ``.json`` states the content and the mapping. Files are written atomically, so
that a crash never leaves an incomplete one.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import re
import tempfile
import threading
import time
from collections import OrderedDict
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from mckibben.measurement.measurement import Measurement
from mckibben.measurement.read import Correction, read_correction, read_measurement
from mckibben.physics.errors import InputError

_ID = re.compile(r"[0-9a-f]{64}")
_KEPT_IN_MEMORY = 8
_MOST_IN_MEMORY = 256_000_000  # bytes, of all but the last one
_STALE = 3600.0  # s; the process of an older temporary file has ended
MAX_NAME = 200


def clean_name(name: str) -> str:
    """A file name for display only: the last part of a path, printable, limited in length."""
    last = name.replace("\\", "/").rpartition("/")[2]
    printable = "".join(character for character in last if character.isprintable()).strip()
    return printable[:MAX_NAME] or "measurement.csv"


class MeasurementStore:
    """Measurements by content.

    Args:
        folder: where they are stored; created on the first upload.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder / "measurements"
        self._recent: OrderedDict[str, Measurement] = OrderedDict()
        self._lock = threading.Lock()

    def put(self, content: bytes, name: str, correction: Correction | None = None) -> Measurement:
        """Read and store a file; storing the same content (and mapping) again only changes the name.

        Raises:
            InputError: it is not a measurement (nothing is stored), or the folder cannot be written.
        """
        name, correction = clean_name(name), correction or Correction()
        measurement = read_measurement(content, name, correction)
        digest = hashlib.sha256(content).hexdigest()
        about = {"name": name}
        if measurement.id != digest:
            about |= {"content": digest, "mapping": correction.canonical()}
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
            _remove_stale(self._folder)
            data = self._folder / f"{digest}.data"
            if not data.exists() or data.stat().st_size != len(content):
                _write(data, content)
            _write(self._folder / f"{measurement.id}.json", json.dumps(about).encode())
        except OSError as error:
            raise InputError(
                f"the measurement cannot be stored: {error.strerror or error}",
                hint="start the server with --data and a writable folder",
                code="conflict",
            ) from error
        self._remember(measurement.id, measurement)
        return measurement

    def get(self, identity: str) -> Measurement:
        """A measurement by its id.

        Raises:
            InputError: code ``not_found``, no file of this content was uploaded.
        """
        with self._lock:
            if identity in self._recent:
                self._recent.move_to_end(identity)
                return self._recent[identity]
        # Only a verified id ever becomes part of a path.
        measurement = self._read(identity) if _ID.fullmatch(identity) else None
        if measurement is None:
            raise InputError(
                f"there is no measurement {identity[:12]}…",
                field="measurement",
                hint="upload the file again with PUT /api/measurements",
                code="not_found",
            )
        self._remember(identity, measurement)
        return measurement

    def _read(self, identity: str) -> Measurement | None:
        """The stored measurement; None if it does not exist or has changed."""
        about = _about(self._folder / f"{identity}.json")
        content, mapping = str(about.get("content", identity)), about.get("mapping")
        if not _ID.fullmatch(content):
            return None
        data = self._folder / f"{content}.data"
        if not data.is_file():
            return None
        name = clean_name(str(about.get("name", "measurement.csv")))
        try:
            correction = read_correction(mapping) if isinstance(mapping, str) else Correction()
            measurement = read_measurement(data.read_bytes(), name, correction)
        except InputError:
            return None  # content that is only readable with a mapping
        return measurement if measurement.id == identity else None

    def _remember(self, identity: str, measurement: Measurement) -> None:
        with self._lock:
            self._recent[identity] = measurement
            self._recent.move_to_end(identity)
            while len(self._recent) > 1 and (
                len(self._recent) > _KEPT_IN_MEMORY
                or sum(_size(kept) for kept in self._recent.values()) > _MOST_IN_MEMORY
            ):
                self._recent.popitem(last=False)


def _size(measurement: Measurement) -> int:
    """Bytes that the columns of a measurement take."""
    return sum(values.nbytes for values in measurement.columns.values())


def _about(path: Path) -> dict[str, Any]:
    """Name and mapping stored with the content; empty if they cannot be read."""
    try:
        data = json.loads(path.read_text("utf-8"))
    except (OSError, ValueError):
        return {}
    return data if isinstance(data, dict) else {}


def _remove_stale(folder: Path) -> None:
    """Remove old temporary files of processes that were killed."""
    for path in folder.glob(".*.tmp"):
        with contextlib.suppress(OSError):
            if time.time() - path.stat().st_mtime > _STALE:
                path.unlink()


def _write(path: Path, content: bytes) -> None:
    """Write atomically and durably: a reader sees the whole file or none."""
    handle, temporary = _temporary(path.parent)
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(content)
            stream.flush()
            os.fsync(stream.fileno())
            if temporary is None:
                temporary = path.parent / f".{path.name}.{os.getpid()}.{threading.get_ident()}.tmp"
                with _opened(
                    path.parent
                ) as folder:  # by descriptor; otherwise os.link would link the symlink itself
                    source = f"/proc/self/fd/{stream.fileno()}"
                    os.link(source, temporary.name, dst_dir_fd=folder, follow_symlinks=True)
        temporary.replace(path)
    except BaseException:
        if temporary is not None:
            temporary.unlink(missing_ok=True)
        raise
    if hasattr(os, "O_DIRECTORY"):  # make the directory entry durable as well
        with _opened(path.parent) as folder:
            os.fsync(folder)


@contextlib.contextmanager
def _opened(folder: Path) -> Iterator[int]:
    """A folder as a descriptor."""
    handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        yield handle
    finally:
        os.close(handle)


def _temporary(folder: Path) -> tuple[int, Path | None]:
    """An open temporary file and its path; None for a nameless one, which disappears with the process."""
    if hasattr(os, "O_TMPFILE") and Path("/proc/self/fd").is_dir():
        with contextlib.suppress(OSError):
            return os.open(folder, os.O_TMPFILE | os.O_WRONLY, 0o600), None
    handle, name = tempfile.mkstemp(dir=folder, prefix=".", suffix=".tmp")
    return handle, Path(name)
