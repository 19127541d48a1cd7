"""Readers of measurement files, one format a file, all giving the same Measurement."""

from __future__ import annotations

from mckibben.measurement.measurement import Measurement
from mckibben.measurement.read.assemble import assemble
from mckibben.measurement.read.correction import Correction, read_correction, spoken_correction
from mckibben.measurement.read.csv import read_csv
from mckibben.measurement.read.formats import open_source
from mckibben.measurement.read.preview import Preview, preview

__all__ = [
    "Correction", "Preview", "preview", "read_correction", "read_csv", "read_measurement",
    "spoken_correction",
]  # fmt: skip


def read_measurement(data: bytes, name: str, correction: Correction | None = None) -> Measurement:
    """The measurement in a file: CSV, JSON, .xlsx, .mat, HDF5 or .tdms, told apart by the content.

    Args:
        data: the file's bytes.
        name: file name, for messages.
        correction: what the user says beyond the file.

    Raises:
        InputError: whatever is wrong with the file, naming row, column or key, and the remedy.
    """
    correction = correction or Correction()
    source = open_source(data, name, correction)
    return assemble(source, name=name, id=correction.identity(data), correction=correction).measurement
