"""A constant that changes its sign is told, with the sensor error that moved it."""

from __future__ import annotations

import numpy as np

from mckibben.identification.diagnose.diagnosis import Diagnosis, diagnose
from mckibben.identification.predict import predictor_of
from mckibben.identification.predict.fit_model import FitModel
from mckibben.measurement.reading import read_measurement
from tests.identification.synthetic import CATALOGUE, MUSCLE, truth

PRESTRESS = CATALOGUE["prestress"]


def diagnosed(*, zero: float) -> Diagnosis:
    """A muscle with 13 N of prestress, as stated; its load cell reads ``zero`` [N] too much."""
    random = np.random.default_rng(5)
    rows = ["# kind: isobaric", "time_s,pressure_bar,length_mm,force_N"]
    for row, (pressure, share) in enumerate(
        (pressure, share)
        for pressure in (3e5, 4e5, 5e5, 6e5)
        for share in (*np.linspace(0.0, 0.15, 20), *np.linspace(0.15, 0.0, 20))
    ):
        length = 0.3 * (1.0 - share)
        force = float(truth(pressure, length, prestress=13.0)) + zero + random.standard_normal()
        rows.append(f"{0.1 * row:.1f},{pressure / 1e5:g},{1e3 * length:.4f},{force:.4f}")
    measurement = read_measurement("\n".join(rows).encode(), "zero.csv")
    start = FitModel(MUSCLE, (PRESTRESS,), {"prestress": PRESTRESS.defaults | {"force": 13.0}})
    return diagnose(predictor_of(measurement, MUSCLE), start, catalogue=CATALOGUE)


def test_a_turned_sign_is_told_with_what_could_have_moved_it() -> None:
    found = diagnosed(zero=29.0)
    (note,) = [message for message in found.messages if "reversed the sign" in message]
    assert "prestress.force" in note
    assert "from 13 to" in note
    assert CATALOGUE["force_offset"].title in note


def test_a_constant_that_keeps_its_sign_is_not_mentioned() -> None:
    assert not [message for message in diagnosed(zero=3.0).messages if "reversed the sign" in message]
