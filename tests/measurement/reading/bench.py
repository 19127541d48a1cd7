"""Readings of one muscle, written in many ways, and how they are read."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from mckibben.measurement.measurement import Measurement
from mckibben.measurement.reading import preview_here, read_here
from mckibben.measurement.reading.correction import Correction, spoken_correction
from mckibben.physics.errors import InputError

Array = NDArray[np.float64]
REST = 0.3  # m
RUN = np.repeat([0, 1, 2], 24)
PRESSURE = np.repeat([2e5, 3e5, 4e5], 24)  # Pa
STROKE = np.tile(np.concatenate([np.linspace(0.0, 0.06, 12), np.linspace(0.06, 0.0, 12)]), 3)  # m
TIME = 0.5 * np.arange(len(RUN))  # s
#: Force of a 20 mm muscle with a braid of 21 degrees: P A (3 cos^2 (1 - k)^2 - 1) / sin^2 [N].
FORCE = PRESSURE * 3.14e-4 * (3.0 * 0.8715 * (1.0 - STROKE / REST) ** 2 - 1.0) / 0.45
SI = {"time": TIME, "pressure": PRESSURE, "force": FORCE, "displacement": STROKE}
ABOVE = "# rest length 300 mm\n"


def table(*columns: Array, separator: str = ",", decimal: str = ".", digits: int = 6) -> str:
    """Rows of numbers."""
    rows = zip(*columns, strict=True)
    return "\n".join(separator.join(f"{v:.{digits}f}".replace(".", decimal) for v in row) for row in rows)


def plain(heads: str = "t [s],p [bar],F [N],s [mm]", *, above: str = ABOVE) -> str:
    """The readings as a usual text, under other heads."""
    return f"{above}{heads}\n{table(TIME, PRESSURE / 1e5, FORCE, STROKE * 1e3)}\n"


def said(columns: Sequence[str] = (), **options: str) -> Correction:
    """What a user says."""
    return spoken_correction(columns=columns, **options)  # type: ignore[arg-type]


def read(data: str | bytes, name: str = "a.csv", correction: Correction | None = None) -> Measurement:
    """The measurement in a text."""
    return read_here(data.encode() if isinstance(data, str) else data, name, correction or Correction())


def asked(data: str | bytes, name: str = "a.csv", correction: Correction | None = None) -> dict[str, bool]:
    """Subject of each question -> whether it stops the reading."""
    found = preview_here(data.encode() if isinstance(data, str) else data, name, correction)
    return {question.about: question.stops for question in found.questions}


def refusal(data: str | bytes, name: str = "a.csv", correction: Correction | None = None) -> str:
    """The refusal of a file; "" = it is read."""
    try:
        read(data, name, correction)
    except InputError as error:
        return error.message
    return ""


def assert_is(found: Measurement, wanted: Mapping[str, Array] = SI, *, rest: float | None = REST) -> None:
    """All readings in SI, row by row, and the rest length."""
    for channel, values in wanted.items():
        scale = float(np.max(np.abs(values)))
        np.testing.assert_allclose(
            found.columns[channel], values, rtol=0.0, atol=2e-5 * scale, err_msg=channel
        )
    if rest is not None:
        assert found.conditions["nominal_length"] == rest
