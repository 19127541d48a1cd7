"""Uploaded measurements on disk, addressed by content: a file uploaded twice is stored once.

``<sha256>.data`` holds the bytes of a file, ``<id>.json`` its name. A file uploaded with a mapping of its
columns has a different id; its ``.json`` states the content and the mapping. Files are written atomically, so
that a crash never leaves an incomplete one. A deleted one can be restored until its room is needed; several
programs may use a folder at once.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import os
import re
import tempfile
import threading
from collections import OrderedDict
from collections.abc import Callable, Iterator
from contextvars import ContextVar
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mckibben.folder import DELETED, QUOTAS, Quotas, deleted, is_full, locked, no_space, restore
from mckibben.folder import delete as move_away
from mckibben.measurement.measurement import Measurement
from mckibben.measurement.reading import Correction, read_correction, read_measurement
from mckibben.physics.errors import InputError

_ID = re.compile(r"[0-9a-f]{64}")
_KEPT_IN_MEMORY = 8
_MOST_IN_MEMORY = 256_000_000  # bytes, of all but the last one
MAX_NAME = 200


def clean_name(name: str) -> str:
    """A file name for display only: the last part of a path, printable, limited in length."""
    last = name.replace("\\", "/").rpartition("/")[2]
    printable = "".join(character for character in last if character.isprintable()).strip()
    return printable[:MAX_NAME] or "measurement.csv"


@dataclass(frozen=True, slots=True)
class KeptFile:
    """A stored measurement.

    Attributes:
        id: of the measurement.
        name: of the file, for people.
        size: of the file [bytes].
        changed: when it was stored, renamed or deleted [s since 1970].
        corrected: whether it is read with corrections of the user.
        content: SHA-256 of the file.
    """

    id: str
    name: str
    size: int
    changed: float
    corrected: bool
    content: str


class MeasurementStore:
    """Measurements by content.

    Args:
        folder: where they are stored; created on the first upload.
        quotas: most bytes that each kind of what is kept in the folder of the user's data may take.
    """

    def __init__(self, folder: Path, *, quotas: Quotas = QUOTAS) -> None:
        self.quotas = quotas
        #: The folder of the user's data.
        self.data = folder
        self._folder = folder / "measurements"
        self._recent: OrderedDict[str, Measurement] = OrderedDict()
        self._lock = threading.Lock()
        #: What takes back each file that is stored within `all_or_none`, in its thread alone.
        self._undo: ContextVar[list[Callable[[], None]] | None] = ContextVar("undo", default=None)

    def put(self, content: bytes, name: str, correction: Correction | None = None) -> Measurement:
        """Read and store a file; storing the same content (and mapping) again only changes the name.

        Raises:
            InputError: it is not a measurement (nothing is stored), or the folder cannot be written.
        """
        name, correction = clean_name(name), correction or Correction()
        if (undo := self._undo.get()) is not None:
            undo.append(self._as_it_was(correction.identity(content), hashlib.sha256(content).hexdigest()))
        measurement = read_measurement(content, name, correction)
        digest = hashlib.sha256(content).hexdigest()
        about = {"name": name}
        if measurement.id != digest:
            about |= {"content": digest, "mapping": correction.canonical()}
        with self._changing("stored") as folder:
            _remove_stale(folder)
            data = folder / f"{digest}.data"

            def write() -> None:
                if not data.exists() or data.stat().st_size != len(content):
                    self._make_room(len(content))
                    _write(data, content)
                _write(folder / f"{measurement.id}.json", json.dumps(about).encode())

            try:
                write()
            except OSError as error:
                if not is_full(error):
                    raise
                self._forget(lambda _: True)
                write()
            (folder / DELETED / f"{measurement.id}.json").unlink(missing_ok=True)
        self._remember(measurement.id, measurement)
        return measurement

    @contextlib.contextmanager
    def all_or_none(self) -> Iterator[None]:
        """Store several files, or none: what the block has stored is as it was before if it raises."""
        undo: list[Callable[[], None]] = []
        token = self._undo.set(undo)
        try:
            yield
        except BaseException:
            with self._changing("removed"):
                for step in reversed(undo):
                    step()
            raise
        finally:
            self._undo.reset(token)

    def _as_it_was(self, identity: str, digest: str) -> Callable[[], None]:
        """What brings a measurement back to its present state: kept, deleted, or not there at all."""
        places = self._folder / f"{identity}.json", self._folder / DELETED / f"{identity}.json"
        were = [path.read_bytes() if path.is_file() else None for path in places]
        data = self._folder / f"{digest}.data"
        stored = data.is_file()

        def bring_back() -> None:
            for path, content in zip(places, were, strict=True):
                if content is None:
                    path.unlink(missing_ok=True)
                elif not path.is_file() or path.read_bytes() != content:
                    _write(path, content)
            if not stored and not self._is_named(digest):
                data.unlink(missing_ok=True)
            with self._lock:
                self._recent.pop(identity, None)

        return bring_back

    def get(self, identity: str) -> Measurement:
        """A measurement by its id.

        Raises:
            InputError: code ``not_found``, no file of this content was uploaded.
        """
        with self._lock:
            # Another program may have deleted it.
            if identity in self._recent and not self._is_deleted(identity):
                self._recent.move_to_end(identity)
                return self._recent[identity]
        measurement = self._read(identity)
        if measurement is None:
            raise _unknown(identity)
        self._remember(identity, measurement)
        return measurement

    def kept(self) -> list[KeptFile]:
        """What is stored, the last one first."""
        found = [self._kept(path) for path in self._folder.glob("*.json")]
        return sorted((file for file in found if file is not None), key=lambda file: -file.changed)

    def deleted(self) -> list[KeptFile]:
        """What can be restored, the last one first."""
        found = [self._kept(path) for path in deleted(self._folder)]
        return [file for file in found if file is not None]

    def size(self) -> int:
        """What all takes on the disk, with what can be restored [bytes]."""
        total = 0
        for path in (*self._folder.glob("*.data"), *self._folder.glob("*.json")):
            with contextlib.suppress(OSError):
                total += path.stat().st_size
        return total

    def restorable(self) -> int:
        """What erasing all that was deleted would free [bytes]."""
        kept = {file.content for file in self.kept()}
        return sum({file.content: file.size for file in self.deleted() if file.content not in kept}.values())

    def rename(self, identity: str, name: str, was: str | None = None) -> KeptFile:
        """Give a stored file another name.

        Args:
            identity: of the measurement.
            name: the new one.
            was: the name that the user saw; None = whatever it is.

        Raises:
            InputError: there is no such file; code ``conflict``: it has another name by now.
        """
        with self._changing("renamed") as folder:
            path = self._present(identity)
            about = _about(path)
            if was is not None and about.get("name") != was:
                raise InputError(
                    f"the file is now called '{about.get('name')}'", field="was",
                    hint="reload the list", code="conflict",
                )  # fmt: skip
            _write(folder / path.name, json.dumps({**about, "name": clean_name(name)}).encode())
        with self._lock:
            self._recent.pop(identity, None)  # it holds the old name
        return self._known(path)

    def delete(self, identity: str, *, erase: bool = False) -> KeptFile:
        """Delete a stored file; it can be restored until its room is needed.

        Args:
            identity: of the measurement.
            erase: whether it shall be gone now, also where it was deleted before.

        Raises:
            InputError: code ``not_found``, there is no such file.
        """
        with self._changing("deleted"):
            path = self._path(identity)
            binned = path.parent / DELETED / path.name
            place = binned if erase and not path.is_file() and binned.is_file() else self._present(identity)
            file = self._known(place)
            if erase:
                place.unlink()
                self._drop(file.content)
            else:
                move_away(place)
        with self._lock:
            self._recent.pop(identity, None)
        return file

    def empty_bin(self) -> None:
        """Erase what was deleted."""
        with self._changing("erased"):
            self._forget(lambda _: True)

    def restore(self, identity: str) -> KeptFile:
        """Bring a deleted file back; one that is there stays as it is.

        Raises:
            InputError: code ``not_found``, it cannot be restored.
        """
        with self._changing("restored") as folder:
            path = self._path(identity)
            if not path.is_file():
                try:
                    restore(folder, path.name)
                except FileNotFoundError:
                    raise _unknown(identity) from None
        return self._known(path)

    def _path(self, identity: str) -> Path:
        # Only a verified id ever becomes part of a path.
        if not _ID.fullmatch(identity):
            raise _unknown(identity)
        return self._folder / f"{identity}.json"

    def _is_deleted(self, identity: str) -> bool:
        # A content whose .json is lost is read nevertheless.
        path = self._path(identity)
        return not path.is_file() and (path.parent / DELETED / path.name).is_file()

    def _present(self, identity: str) -> Path:
        path = self._path(identity)
        if not path.is_file():
            raise _unknown(identity)
        return path

    def _kept(self, path: Path) -> KeptFile | None:
        """What a ``.json`` stands for; None if it is none of the store's, or gone."""
        about = _about(path)
        content = str(about.get("content", path.stem))
        if not (about and _ID.fullmatch(path.stem) and _ID.fullmatch(content)):
            return None
        try:
            size = (self._folder / f"{content}.data").stat().st_size
            changed = path.stat().st_mtime
        except OSError:
            return None
        name = clean_name(str(about.get("name", "")))
        return KeptFile(path.stem, name, size, changed, "content" in about, content)

    def _known(self, path: Path) -> KeptFile:
        file = self._kept(path)
        if file is None:
            raise _unknown(path.stem)
        return file

    @contextlib.contextmanager
    def _changing(self, what: str) -> Iterator[Path]:
        """The folder, which no other program changes meanwhile."""
        try:
            with locked(self._folder):
                yield self._folder
        except OSError as error:
            raise self.unusable(what, error) from error

    def unusable(self, what: str, error: OSError) -> InputError:
        """What there is to say of a folder that does not take or give a file.

        Args:
            what: that the measurement should have been.
            error: of the system.
        """
        if is_full(error):
            taken, quota = self.size(), self.quotas.measurements
            return no_space("measurements", taken=taken, quota=quota, folder=self.data)
        return InputError(
            f"the measurement cannot be {what}: {error.strerror or error}",
            hint="start the server with --data and a writable folder",
            code="conflict",
        )

    def _make_room(self, size: int) -> None:
        """Refuse a file for which there is no room, also without what was deleted."""
        if self.size() + size <= self.quotas.measurements:
            return
        self._forget(lambda _: self.size() + size > self.quotas.measurements)
        if (taken := self.size()) + size > self.quotas.measurements:
            raise no_space(
                "measurements", taken=taken, quota=self.quotas.measurements, needs=size, folder=self.data
            )

    def _forget(self, whether: Callable[[Path], bool]) -> None:
        """Remove deleted files for good, the oldest first, and contents that nothing names any more."""
        for path in reversed(deleted(self._folder)):
            if not whether(path):
                continue
            content = str(_about(path).get("content", path.stem))
            path.unlink(missing_ok=True)
            self._drop(content)

    def _drop(self, content: str) -> None:
        """Remove a content that nothing names any more."""
        if _ID.fullmatch(content) and not self._is_named(content):
            (self._folder / f"{content}.data").unlink(missing_ok=True)

    def _is_named(self, content: str) -> bool:
        """Whether a kept or deleted measurement is of this content."""
        others = (*self._folder.glob("*.json"), *deleted(self._folder))
        return any(content == str(_about(other).get("content", other.stem)) for other in others)

    def has(self, identity: str) -> bool:
        """Whether there is a measurement of this id, deleted or not."""
        about = _about(self._folder / f"{identity}.json") if _ID.fullmatch(identity) else {}
        content = str(about.get("content", identity))
        return bool(about and _ID.fullmatch(content)) and (self._folder / f"{content}.data").is_file()

    def name_of(self, identity: str) -> str:
        """How a stored file is called; empty if there is none."""
        about = _about(self._folder / f"{identity}.json") if _ID.fullmatch(identity) else {}
        return clean_name(str(about["name"])) if "name" in about else ""

    def original(self, identity: str) -> tuple[str, bytes, str | None] | None:
        """Name, content and mapping of a stored measurement, as uploaded; None if there is none."""
        if not _ID.fullmatch(identity):
            return None
        about = _about(self._folder / f"{identity}.json")
        content, mapping = str(about.get("content", identity)), about.get("mapping")
        if not about or not _ID.fullmatch(content):
            return None
        try:
            data = (self._folder / f"{content}.data").read_bytes()
        except OSError:
            return None
        name = clean_name(str(about.get("name", "measurement.csv")))
        return name, data, mapping if isinstance(mapping, str) else None

    def _read(self, identity: str) -> Measurement | None:
        """The stored measurement; None if it does not exist or has changed."""
        about = _about(self._path(identity))
        if self._is_deleted(identity):
            return None
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


def _unknown(identity: str) -> InputError:
    return InputError(
        f"there is no measurement {identity[:12]}…",
        field="measurement",
        hint="upload the file again",
        code="not_found",
    )


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
    """Remove temporary files of processes that were killed: whoever writes keeps the folder locked."""
    for path in folder.glob(".*.tmp"):
        path.unlink(missing_ok=True)


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
