"""Measurements named on the command line."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from mckibben.documents.studio import Studio
from mckibben.measurement.points import Points, find_preset, joined
from mckibben.measurement.read import read_measurement
from mckibben.physics.errors import InputError, did_you_mean

_MAX_BYTES = 200_000_000


def points_of(files: Sequence[str], studio: Studio) -> Points:
    """Files, or presets where there is no such file, as one measurement.

    Raises:
        InputError: names the file, the row or field, what is wrong and what would be right.
    """
    return joined([_read(name, studio) for name in files])


def _read(name: str, studio: Studio) -> Points:
    """A file, or a preset measurement or curve when there is no such file."""
    path = Path(name)
    try:
        if not path.exists():
            preset = find_preset(name, studio.library)
            if preset is not None:
                return preset
            raise InputError(f"{name}: there is no such file", hint=_near_file(path))
        if path.is_dir():
            raise InputError(f"{name}: is a folder", hint=f"name a file in it, e.g. {path / '*.csv'}")
        if path.stat().st_size > _MAX_BYTES:
            raise InputError(f"{name}: is larger than {_MAX_BYTES // 1_000_000} MB", hint="split the file")
        return Points(read_measurement(path.read_bytes(), path.name))
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
