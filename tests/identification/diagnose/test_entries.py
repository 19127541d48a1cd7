"""Which statements of a measurement can be doubted, and how accepted ones change the data."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.identification.diagnose.entries import Statements, read_otherwise, statements
from mckibben.identification.predict import predictor_of
from mckibben.identification.predict.fit_model import FitModel
from mckibben.measurement.measurement import Measurement
from mckibben.measurement.reading import read_measurement
from mckibben.physics.errors import InputError
from mckibben.physics.units import STANDARD_ATMOSPHERE
from tests.identification.synthetic import MUSCLE, truth

PRESSURES = (2e5, 4e5, 6e5)


def loops(*, absolute: bool = False, stroke: bool = True) -> Measurement:
    """Loops of the muscle of these tests at three pressures, without noise."""
    head = "displacement_mm" if stroke else "length_mm"
    rows = ["# kind: isobaric", f"time_s,pressure_bar,{head},force_N"]
    time = 0.0
    for pressure in PRESSURES:
        for share in (*np.linspace(0.0, 0.15, 20), *np.linspace(0.15, 0.0, 20)):
            time += 0.1
            length = 0.3 * (1.0 - share)
            shown = 300.0 - 1e3 * length if stroke else 1e3 * length
            bar = (pressure + (STANDARD_ATMOSPHERE if absolute else 0.0)) / 1e5
            rows.append(f"{time:.1f},{bar:.6f},{shown:.6f},{float(truth(pressure, length)):.6f}")
    return read_measurement("\n".join(rows).encode(), "loops.csv")


def stated(measurement: Measurement) -> Statements:
    return statements(
        measurement,
        FitModel(MUSCLE),
        lambda readings: predictor_of(read_otherwise(measurement, readings), MUSCLE),
    )


def ids(found: Statements) -> set[str]:
    return {entry.hypothesis for entry in found.entries}


def test_dimensions_and_plausible_readings_are_doubted() -> None:
    found = ids(stated(loops()))
    assert {"rest_length", "braid_diameter", "braid_angle", "absolute_pressure", "force_in_kgf"} <= found
    # 6 bar read as psi would be 0.4 bar, as MPa 60 bar: only the first may be meant.
    assert "pressure_in_psi" in found
    assert "pressure_in_MPa" not in found
    assert "load" not in found, "the force is measured"
    assert "force_sign" not in found, "no force is below zero"


def test_the_sign_of_a_length_is_not_doubted_but_that_of_a_stroke_is() -> None:
    assert "stroke_sign" in ids(stated(loops()))
    assert "stroke_sign" not in ids(stated(loops(stroke=False)))


def test_an_accepted_reading_gives_the_data_written_in_the_right_way() -> None:
    wrong, (entry,) = stated(loops(absolute=True)).using(["absolute_pressure"])
    assert entry.reading is not None
    np.testing.assert_allclose(
        wrong.predictor(wrong.readings).inputs["pressure"],
        predictor_of(loops(), MUSCLE).inputs["pressure"],
        rtol=0,
        atol=1.0,
    )
    assert not {"absolute_pressure", "pressure_in_psi"} & ids(wrong), "the pressure is settled"


def test_an_accepted_quantity_is_no_longer_doubted() -> None:
    left, (entry,) = stated(loops()).using(["rest_length"])
    assert entry.free is not None
    assert (entry.free.lower, entry.free.upper) == pytest.approx((0.18, 0.51))
    assert "rest_length" not in ids(left)


@pytest.mark.parametrize("call", [Statements.using, Statements.keeping])
def test_an_unknown_hypothesis_names_the_nearest(call) -> None:
    with pytest.raises(InputError) as error:
        call(stated(loops()), ["rest_lenght"])
    assert "rest_length" in str(error.value.hint)


@pytest.mark.parametrize(
    ("use", "keep", "words"),
    [
        (["force_in_kgf", "force_in_lbf"], [], "are both about the force"),
        (["rest_length"], ["rest_length"], "is both used and kept"),
    ],
)
def test_decisions_that_contradict_each_other_are_refused(use, keep, words) -> None:
    with pytest.raises(InputError) as error:
        stated(loops()).keeping(keep).using(use)
    assert error.value.field == "use"
    assert words in str(error.value)
