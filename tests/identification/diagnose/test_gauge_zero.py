"""A zero error of the pressure sensor that the vented rows show is read, not inferred."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.identification.diagnose.diagnosis import diagnose
from mckibben.identification.diagnose.gauge_zero import vented
from mckibben.identification.diagnose.words import sentence_of
from mckibben.identification.predict import predictor_of
from mckibben.identification.predict.fit_model import FitModel
from tests.identification.synthetic import CATALOGUE, MUSCLE, csv
from tests.identification.synthetic import truth as hidden_force

ZERO = -0.3e5


def test_the_zero_is_the_plateau_of_the_lowest_readings():
    rng = np.random.default_rng(1)
    readings = np.concatenate([np.full(6, ZERO), np.linspace(0.5e5, 6e5, 40)]) + rng.normal(0.0, 300.0, 46)
    found = vented(readings, CATALOGUE.values())
    assert found is not None
    assert (found.effect.id, found.rows) == ("pressure_offset", 6)
    assert found.value == pytest.approx(ZERO, abs=300.0)
    assert vented(readings - ZERO, CATALOGUE.values()) is None


def test_what_is_read_is_certain_and_is_stated_as_read():
    """Ramps whose sensor is 0.3 bar low, and a prestress that has to be inferred."""
    rng = np.random.default_rng(2)
    rows = []
    for length in (0.30, 0.28, 0.26):
        pressure = np.concatenate([np.zeros(4), np.linspace(0.5e5, 6e5, 12)])
        force = hidden_force(pressure, np.full(16, length), prestress=-40.0) + rng.normal(0.0, 1.0, 16)
        rows += [f"{(p + ZERO) / 1e5},{1e3 * length},{f}" for p, f in zip(pressure, force, strict=True)]
    data = csv(rows, "pressure_bar,length_mm,force_N", "kind: isometric")
    found = diagnose(predictor_of(data, MUSCLE), FitModel(MUSCLE, (), {}), catalogue=CATALOGUE)
    assert set(found.added) == {"pressure_offset", "prestress"}
    assert found.best.fit_model.number("pressure_offset.offset") == pytest.approx(ZERO, abs=1.0)
    assert found.probability_of("pressure_offset") >= 0.99
    sentence = sentence_of(found, CATALOGUE)
    assert "Pressure sensor: zero error (read from the data)" in sentence
    assert "perhaps" not in sentence
    assert sentence.count("probability") == 1
    # The rows have no time.
    assert {"pressure_creep", "sensor_lag"} <= {each.effect for each in found.not_tried if each.needs_time}
    assert not any(each.needs_time for each in found.not_tried if each.effect == "leak")
