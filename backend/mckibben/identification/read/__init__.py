"""Readers of measurement files, one format a file, all giving the same Measurement."""

from __future__ import annotations

from pathlib import PurePath

from mckibben.identification.measurement import Measurement
from mckibben.identification.read.csv import read_csv
from mckibben.physics.errors import InputError

__all__ = ["read_csv", "read_measurement"]

_READERS = {".csv": read_csv, ".txt": read_csv, ".tsv": read_csv}


def read_measurement(data: bytes, name: str) -> Measurement:
    """The measurement in a file, read by the extension of its name.

    Raises:
        InputError: no reader for the extension, or whatever is wrong with the file.
    """
    extension = PurePath(name).suffix.lower()
    reader = _READERS.get(extension)
    if reader is None:
        what = f"{extension[1:]} files are" if len(extension) > 1 else "files without an extension are"
        raise InputError(f"{name}: {what} not read yet, save as CSV", field="name", hint="e.g. 'test.csv'")
    return reader(data, name)
