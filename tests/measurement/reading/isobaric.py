"""Readings of an isobaric test, written by the tests of this folder in many ways."""

from __future__ import annotations

import numpy as np

from mckibben.measurement import measurement
from mckibben.measurement.reading import Correction, read_measurement

ROWS = 40
STROKE = np.concatenate([np.linspace(0.0, 60.0, 20), np.linspace(60.0, 0.0, 20)]).round(2)  # mm
PRESSURE = np.repeat([2.0, 4.0], 20)  # bar
FORCE = (PRESSURE * 40.0 * ((1.0 - STROKE / 300.0) ** 2 * 2.0 - 0.6) * 2.0 + 30.0).round(1)  # N
TIME = np.arange(ROWS) * 0.5  # s


def table(*columns: np.ndarray, separator: str = ",") -> str:
    """Rows of numbers."""
    return "\n".join(separator.join(f"{value:.10g}" for value in row) for row in zip(*columns, strict=True))


def read(
    data: str | bytes, name: str = "a.csv", correction: Correction | None = None
) -> measurement.Measurement:
    """The measurement in a text."""
    return read_measurement(data.encode() if isinstance(data, str) else data, name, correction)


def assert_is_the_test(found: measurement.Measurement, *, rest: bool = True) -> None:
    """All readings, in SI, row by row; the rest length of 300 mm."""
    np.testing.assert_allclose(found.columns["pressure"], PRESSURE * 1e5, rtol=1e-6)
    np.testing.assert_allclose(found.columns["force"], FORCE, rtol=1e-6)
    np.testing.assert_allclose(found.columns["displacement"], STROKE / 1e3, rtol=1e-6, atol=1e-9)
    if rest:
        assert found.conditions["nominal_length"] == 0.3
