"""Finished diagnoses that outlive page and server: asked again, one is answered as it was.

An answer is kept under a name of all that it depends on: the question, the measurements by their content, the
program, its presets and terms of the user. What was not finished is not kept.
"""

from __future__ import annotations

import hashlib
import os
import shutil
import uuid
from collections.abc import Iterable
from contextlib import suppress
from pathlib import Path

from mckibben.application.study.store import environment_of
from mckibben.documents.studio import Studio
from mckibben.folder import QUOTAS


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
            return content
        return None

    def keep(self, name: str, answer: bytes) -> None:
        """Keep an answer; a disk that takes none costs the keeping alone."""
        part = self._folder / f".{uuid.uuid4().hex}"
        try:
            self._folder.mkdir(parents=True, exist_ok=True)
            part.write_bytes(answer)
            part.replace(self._folder / f"{name}.json")
            self._tidy(name)
        except OSError:
            with suppress(OSError):
                part.unlink(missing_ok=True)

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
