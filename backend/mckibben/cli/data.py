"""Measurements named on the command line."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from mckibben.documents.studio import Studio
from mckibben.measurement.measurement import Measurement
from mckibben.measurement.points import Points, find_preset, joined
from mckibben.measurement.read import Correction, read_measurement
from mckibben.physics.errors import InputError, did_you_mean

_MAX_BYTES = 200_000_000


def points_of(files: Sequence[str], studio: Studio, correction: Correction | None = None) -> Points:
    """Files, or presets where there is no such file, as one measurement.

    The correction says how the files are to be read; it is for files, not for presets.

    Raises:
        InputError: names the file, the row or field, what is wrong and what would be right.
    """
    correction = correction or Correction()
    return joined([_read(name, studio, correction) for name in files])


def _read(name: str, studio: Studio, correction: Correction) -> Points:
    """A file, or a preset measurement or curve when there is no such file."""
    if not _exists(name):
        preset = find_preset(name, studio.library)
        if preset is not None:
            if correction != Correction():
                raise InputError(
                    f"{name}: a preset states how it is read", hint="leave --column, --sheet and the like out"
                )
            return preset
    measurement = read_file(name, correction)
    rest = measurement.conditions.get("nominal_length")
    return Points(measurement, nominal_length=rest if isinstance(rest, float) else None)


def _exists(name: str) -> bool:
    try:
        return Path(name).exists()
    except (OSError, ValueError):  # no name of a file
        return False


def read_file(name: str, correction: Correction) -> Measurement:
    """The measurement in a file.

    Raises:
        InputError: names the file, the row or field, what is wrong and what would be right.
    """
    path = Path(name)
    try:
        if not path.exists():
            raise InputError(f"{name}: there is no such file", hint=_near_file(path))
        if path.is_dir():
            raise InputError(f"{name}: is a folder", hint=f"name a file in it, e.g. {path / '*.csv'}")
        if path.stat().st_size > _MAX_BYTES:
            raise InputError(f"{name}: is larger than {_MAX_BYTES // 1_000_000} MB", hint="split the file")
        return read_measurement(path.read_bytes(), path.name, correction)
    except (OSError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        reason = getattr(error, "strerror", None) or error
        raise InputError(f"{name[:200]!r}: cannot be read: {reason}", hint="name a readable file") from error


def _near_file(path: Path) -> str | None:
    folder = path.parent
    if not folder.is_dir():
        return f"there is no folder {folder}"
    names = [entry.name for entry in folder.iterdir() if entry.suffix == path.suffix]
    return did_you_mean(path.name, names)
