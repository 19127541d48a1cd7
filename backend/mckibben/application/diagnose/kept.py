"""Finished diagnoses that outlive page and server: asked again, one is answered as it was.

An answer is kept under a name of all that it depends on: the question, the measurements by their content,
the program, its presets and terms of the user. So it can be kept elsewhere and brought back: nothing else
than its own question finds it. What was not finished is not kept.

A file of an answer begins with a line that names its measurements.
"""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import uuid
from collections.abc import Collection, Iterable, Iterator
from contextlib import suppress
from pathlib import Path

from mckibben.application.study.store import environment_of
from mckibben.documents.studio import Studio
from mckibben.folder import QUOTAS
from mckibben.projects.project import StoredAnswer

MOST_ANSWER = 20_000_000  # bytes of an answer that goes along with a project
_LONGEST_LINE = 10_000  # bytes


class DiagnosisStore:
    """Kept answers of diagnoses.

    Args:
        data: folder of the user's data; the answers are in ``diagnoses`` in it.
        quota: most bytes that they may take; those not used for longest go first.
    """

    def __init__(self, data: Path, *, quota: int = QUOTAS.diagnoses) -> None:
        self._folder, self.quota = data / "diagnoses", quota

    def name(self, question: str, measurements: Iterable[str], studio: Studio) -> str:
        """Names all that an answer depends on.

        Args:
            question: the request as text, alike for alike ones; measurements are named in it by content.
            measurements: how they are called, which the answer says.
            studio: for presets and terms of the user.
        """
        parts = (question, *measurements, environment_of(studio))
        return hashlib.sha256("\0".join(parts).encode("utf-8", "surrogatepass")).hexdigest()

    def answer(self, name: str) -> bytes | None:
        """A kept answer; None if there is none."""
        path = self._folder / f"{name}.json"
        with suppress(OSError):
            content = path.read_bytes()
            os.utime(path)
            return content.partition(b"\n")[2]
        return None

    def keep(self, name: str, measurements: Iterable[str], answer: bytes) -> None:
        """Keep an answer; a disk that takes none costs the keeping alone.

        Args:
            name: of `name`.
            measurements: ids of those that it is about.
            answer: its bytes.
        """
        self.bring(StoredAnswer(name, json.dumps(sorted(measurements)).encode() + b"\n" + answer))

    def about(self, measurements: Collection[str], known: Collection[str] = ()) -> Iterator[StoredAnswer]:
        """Kept answers about nothing but these measurements, without known ones, one after the other."""
        with suppress(OSError):
            for _, size, path in reversed(self._files()):
                if path.suffix == ".json" and path.stem not in known and size <= MOST_ANSWER:
                    with suppress(OSError, ValueError):
                        with path.open("rb") as file:
                            named = json.loads(file.readline(_LONGEST_LINE))
                        if named and set(named) <= set(measurements):
                            yield StoredAnswer(path.stem, path.read_bytes())

    def bring(self, stored: StoredAnswer) -> None:
        """Keep an answer that was kept elsewhere; one that is there stays."""
        name = stored.name
        if (self._folder / f"{name}.json").exists():
            return
        part = self._folder / f".{uuid.uuid4().hex}"
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
            part.write_bytes(stored.content)
            part.replace(self._folder / f"{name}.json")
            self._tidy(name)
        except OSError:
            with suppress(OSError):
                part.unlink(missing_ok=True)

    def names(self) -> set[str]:
        """Names of all."""
        with suppress(OSError):
            return {path.stem for _, _, path in self._files()}
        return set()

    def size(self) -> int:
        """What all take on the disk [bytes]."""
        with suppress(OSError):
            return sum(size for _, size, _ in self._files())
        return 0

    def erase(self) -> None:
        """Remove all; they are made again when they are asked for."""
        shutil.rmtree(self._folder, ignore_errors=True)

    def _files(self) -> list[tuple[float, int, Path]]:
        found = []
        for path in self._folder.iterdir() if self._folder.exists() else ():
            info = path.stat()
            found.append((info.st_mtime, info.st_size, path))
        return sorted(found)

    def _tidy(self, last: str) -> None:
        files = self._files()
        total = sum(size for _, size, _ in files)
        for _, size, path in files:
            if total <= self.quota:
                return
            if path.stem != last:
                path.unlink(missing_ok=True)
                total -= size
