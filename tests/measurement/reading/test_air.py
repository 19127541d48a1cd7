"""The air that an absolute pressure contains: one value, one of each run or row, an impossible one."""

from __future__ import annotations

import io

import h5py
import numpy as np
import pytest

from mckibben.measurement.reading import Correction, read_measurement
from mckibben.physics.errors import InputError
from tests.measurement.reading.isobaric import FORCE, PRESSURE, STROKE, TIME, assert_is_the_test, read, table

AIR = 95_310.0  # Pa
HEAD = "t [s],p [bar abs],F [N],s [mm]\n"
ABSOLUTE = table(TIME, PRESSURE + AIR / 1e5, FORCE, STROKE)


@pytest.mark.parametrize(
    "said",
    [
        "barometer: 953.1 hPa",
        "barometer_Pa: 95310",
        "barometer: 953.1",
        "Luftdruck: 95.31",
        "p_atm_mbar: 953.1",
    ],
)
def test_what_a_barometer_showed_is_subtracted(said: str) -> None:
    assert_is_the_test(read(f"# rest length 300 mm\n# {said}\n{HEAD}{ABSOLUTE}"))


def test_a_barometer_of_each_run() -> None:
    data = io.BytesIO()
    with h5py.File(data, "w") as file:
        file.attrs["rest_length_mm"] = 300.0
        for pressure, air in ((2.0, 95_310.0), (4.0, 96_120.0)):
            rows = pressure == PRESSURE
            group = file.create_group(f"run_{pressure:g}")
            group.attrs["barometer_Pa"] = air
            group["p_abs_kPa"] = PRESSURE[rows] * 100.0 + air / 1e3
            group["force_N"], group["stroke_mm"] = FORCE[rows], STROKE[rows]
    assert_is_the_test(read(data.getvalue(), "a.h5"))


def test_a_barometer_in_a_column_counts_row_by_row() -> None:
    air = np.linspace(953.0, 961.0, len(PRESSURE))
    rows = table(TIME, PRESSURE + air / 1e3, FORCE, STROKE, air)
    found = read(f"# rest length 300 mm\nt [s],p [bar abs],F [N],s [mm],barometer [hPa]\n{rows}")
    assert_is_the_test(found)
    assert any("row by row" in message for message in found.messages)


def test_an_impossible_barometer_is_asked_about_and_answered() -> None:
    text = f"# rest length 300 mm\n# ambient_pressure: 300 kPa\n{HEAD}{ABSOLUTE}".encode()
    with pytest.raises(InputError, match=r"surrounding air.*impossible.*pressure_zero"):
        read_measurement(text, "a.csv")
    read_measurement(text, "a.csv", Correction(conditions={"pressure_zero": AIR - 101_325.0}))


def test_two_barometers_are_asked_about() -> None:
    with pytest.raises(InputError, match=r"surrounding air is stated as 953.1 hPa and as 972 hPa"):
        read(f"# L0: 300 mm\n# barometer at start: 953.1 hPa\n# barometer at end: 972 hPa\n{HEAD}{ABSOLUTE}")


def test_a_reference_behind_a_comma_in_the_unit() -> None:
    head = "Time [s]\tPressure [bar, gauge]\tForce [N]\tStroke [mm]\n"
    assert_is_the_test(read(f"# L0: 300 mm\n{head}" + table(TIME, PRESSURE, FORCE, STROKE, separator="\t")))
