"""Readers of measurement files, one format a file, all giving the same Measurement."""

from __future__ import annotations

from mckibben.measurement.measurement import Measurement
from mckibben.measurement.read.assemble import assemble
from mckibben.measurement.read.correction import Correction, read_correction, spoken_correction
from mckibben.measurement.read.formats import open_source
from mckibben.measurement.read.preview import Preview, preview_here
from mckibben.measurement.read.process import bounded

__all__ = [
    "Correction", "Preview", "load_readers", "preview", "read_correction", "read_measurement",
    "spoken_correction",
]  # fmt: skip

_ANY_FILE = b"# kind: static\npressure_bar;length_mm;force_N\n1;300;10\n1;290;5\n1;280;1\n"


def read_measurement(data: bytes, name: str, correction: Correction | None = None) -> Measurement:
    """The measurement in a file: CSV, JSON, .xlsx, .mat, HDF5 or .tdms, told apart by the content.

    Args:
        data: the file's bytes.
        name: file name, for messages.
        correction: what the user says beyond the file.

    Raises:
        InputError: whatever is wrong with the file, naming row, column or key, and the remedy; also that it
            takes too much time or memory.
    """
    return bounded(lambda: _read_here(data, name, correction or Correction()), name, load_readers)


def preview(data: bytes, name: str, correction: Correction | None = None) -> Preview:
    """What a file would be read as; bad rows are counted, not refused.

    Raises:
        InputError: no table can be found in the file at all, the correction names what is not there, or the
            file takes too much time or memory.
    """
    return bounded(lambda: preview_here(data, name, correction), name, load_readers)


def load_readers() -> None:
    """Import what every measurement file needs."""
    _read_here(_ANY_FILE, "any.csv", Correction())


def _read_here(data: bytes, name: str, correction: Correction) -> Measurement:
    """The measurement in a file, read in this process."""
    source = open_source(data, name, correction)
    return assemble(source, name=name, id=correction.identity(data), correction=correction).measurement
