"""Constants that the data do not tell take their usual value, which is said."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.identification.diagnose.diagnosis import Diagnosis, diagnose
from mckibben.identification.predict import predictor_of
from mckibben.identification.predict.fit_model import FitModel
from mckibben.physics import ideal
from tests.identification.synthetic import CATALOGUE, MUSCLE, csv

WAY = 0.9e-3  # over which the friction builds up [m]
NOTE = "Dahl friction: the pressure power is taken as 1, as usual; these data do not tell it"


def swept(pressures: tuple[float, ...], *, power: float, seed: int = 0) -> Diagnosis:
    """The diagnosis of triangles between 300 and 255 mm with Dahl friction of 20 N (P/3 bar)^power.

    The friction is that of the closed form after each reversal, z = s - (s - z0) exp(-way/x_b).
    """
    generator, rows, start = np.random.default_rng(seed), [], 0.0
    corners = np.array([300.0, 255.0, 290.0, 265.0, 285.0, 255.0, 300.0]) / 1e3
    for bar in pressures:
        share, length, now = 0.0, corners[0], start
        for corner in corners[1:]:
            sign, begin, first = float(np.sign(corner - length)), share, length
            for place in np.linspace(first, corner, 46)[1:]:
                now += 0.5
                share = sign - (sign - begin) * np.exp(-abs(place - first) / WAY)
                force = ideal.force(braid=MUSCLE.braid, pressure=bar * 1e5, length=place)
                force += 20.0 * (bar / 3.0) ** power * share + 0.5 * generator.standard_normal()
                rows.append(f"{now:.3f},{bar},{1e3 * place:.6f},{float(force):.4f}")
            length = corner
        start = now + 60.0
    measurement = csv(rows, "time_s,pressure_bar,length_mm,force_N", "kind: isobaric")
    predictor = predictor_of(measurement, MUSCLE)
    return diagnose(predictor, FitModel(MUSCLE), catalogue=CATALOGUE)


@pytest.mark.parametrize(
    ("pressures", "power", "expected"),
    [
        ((4.0,), 0.0, 1.0),  # one pressure does not tell it
        ((2.0, 4.0), 0.0, 0.0),
        ((2.0, 4.0), 1.0, 1.0),
    ],
)
def test_a_power_of_the_pressure_is_told_by_two_pressures(
    pressures: tuple[float, ...], power: float, expected: float
) -> None:
    found = swept(pressures, power=power)
    assert found.added == ("dahl",)
    values = found.best.fit_model.values["dahl"]
    assert values["pressure_power"] == pytest.approx(expected, abs=0.03)
    assert (NOTE in found.messages) is (len(pressures) == 1)
    if len(pressures) == 1:  # the force is stated for 3 bar, and at the pressure of the test it is the same
        assert values["force"] == pytest.approx(20.0 * 3.0 / 4.0, rel=0.02)
