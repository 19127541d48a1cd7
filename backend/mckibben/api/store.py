"""Uploaded measurements on disk: the id is the SHA-256 of the content, so sending a file twice keeps one."""

from __future__ import annotations

import json
import os
import re
import tempfile
import threading
from collections import OrderedDict
from pathlib import Path

from mckibben.identification.measurement import Measurement
from mckibben.identification.read import read_measurement
from mckibben.physics.errors import InputError

_ID = re.compile(r"[0-9a-f]{64}")
_KEPT_IN_MEMORY = 8
MAX_NAME = 200


def clean_name(name: str) -> str:
    """A file name for people: the last part of a path, printable, not too long. It never becomes a path."""
    last = name.replace("\\", "/").rpartition("/")[2]
    printable = "".join(character for character in last if character.isprintable()).strip()
    return printable[:MAX_NAME] or "measurement.csv"


class MeasurementStore:
    """Measurements by content.

    Args:
        folder: where they are kept; made on the first upload.
    """

    def __init__(self, folder: Path) -> None:
        self._folder = folder / "measurements"
        self._recent: OrderedDict[str, Measurement] = OrderedDict()
        self._lock = threading.Lock()

    def put(self, content: bytes, name: str) -> Measurement:
        """Read and keep a file; the same content again only changes the name.

        Raises:
            InputError: it is not a measurement (nothing is kept), or the folder cannot be written.
        """
        name = clean_name(name)
        measurement = read_measurement(content, name)
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
            data = self._folder / f"{measurement.id}.data"
            if not data.exists():
                _write(data, content)
            _write(data.with_suffix(".json"), json.dumps({"name": name}).encode())
        except OSError as error:
            raise InputError(
                f"the measurement cannot be kept: {error.strerror or error}",
                hint="start the server with --data and a folder that can be written",
                code="conflict",
            ) from error
        self._remember(measurement.id, measurement)
        return measurement

    def get(self, identity: str) -> Measurement:
        """A measurement by its id.

        Raises:
            InputError: code ``not_found``, no file of this content was sent.
        """
        with self._lock:
            if identity in self._recent:
                self._recent.move_to_end(identity)
                return self._recent[identity]
        # Only a verified id ever becomes part of a path.
        data = self._folder / f"{identity}.data" if _ID.fullmatch(identity) else None
        if data is None or not data.is_file():
            raise InputError(
                f"there is no measurement {identity[:12]}…",
                field="measurement",
                hint="send the file again with PUT /api/measurements",
                code="not_found",
            )
        measurement = read_measurement(data.read_bytes(), _kept_name(data))
        self._remember(identity, measurement)
        return measurement

    def _remember(self, identity: str, measurement: Measurement) -> None:
        with self._lock:
            self._recent[identity] = measurement
            self._recent.move_to_end(identity)
            while len(self._recent) > _KEPT_IN_MEMORY:
                self._recent.popitem(last=False)


def _kept_name(data: Path) -> str:
    """The name the file was sent under; the file can be read without it."""
    try:
        return clean_name(str(json.loads(data.with_suffix(".json").read_text("utf-8"))["name"]))
    except (OSError, ValueError, KeyError, TypeError):
        return "measurement.csv"


def _write(path: Path, content: bytes) -> None:
    """Write in one step: a reader sees the whole file or none."""
    handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=".", suffix=".tmp")
    try:
        with os.fdopen(handle, "wb") as stream:
            stream.write(content)
            stream.flush()
            os.fsync(stream.fileno())
        Path(temporary).replace(path)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise
