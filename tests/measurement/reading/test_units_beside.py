"""Units beside a table: comments of columns, lists and pairs, signals with settings, shares in per mille."""

from __future__ import annotations

import io

import h5py
import numpy as np
import pytest
from scipy.io import savemat

from mckibben.measurement.measurement import Measurement
from mckibben.measurement.reading import read_measurement
from mckibben.measurement.reading.unit_lists import units_of_columns
from tests.measurement.reading.muscle_test import isobaric

R = isobaric(2e5, 3e5, 4e5)
ROWS = len(R.time)
NAMES = ("t", "p", "F", "x")
TABLE = np.column_stack([R.time, R.pressure / 1e5, R.force, R.stroke * 1e3])


def assert_read(found: Measurement) -> None:
    np.testing.assert_allclose(found.columns["pressure"], R.pressure, atol=2.0)
    np.testing.assert_allclose(found.columns["force"], R.force, atol=1e-3)
    np.testing.assert_allclose(found.columns["displacement"], R.stroke, atol=1e-7)


def hdf5(units: object, **said: object) -> bytes:
    """A table of named columns with its units in an attribute, as programs in Python write it."""
    kinds = np.dtype([("index", "i4"), *((name, "f8") for name in ("time", "pressure", "force", "stroke"))])
    rows = np.array([(i, *row) for i, row in enumerate(TABLE)], dtype=kinds)
    data = io.BytesIO()
    with h5py.File(data, "w") as file:
        table = file.create_group("run").create_dataset("table", data=rows)
        table.attrs["units"] = units
        for key, value in said.items():
            table.attrs[key] = value
    return data.getvalue()


@pytest.mark.parametrize(
    "units",
    [
        "index:-, time:s, pressure:bar, force:N, stroke:mm",
        "time = s; pressure = bar; force = N; stroke = mm",
        '{"time": "s", "pressure": "bar", "force": "N", "stroke": "mm"}',
        "-, s, bar, N, mm",
    ],
)
def test_units_of_a_table_in_one_text(units: str) -> None:
    found = read_measurement(hdf5(units, rest_length_mm=250.0, muscle="DMSP-20-250N"), "a.h5")
    assert_read(found)
    assert found.conditions["nominal_length"] == pytest.approx(0.25)
    assert found.conditions["muscle"] == "DMSP-20"


def test_units_that_do_not_belong_to_the_columns_are_no_units_of_theirs() -> None:
    assert units_of_columns(NAMES, {"units": "SI"}) == [None] * 4
    assert units_of_columns(NAMES, {"units": "s, bar"}) == [None] * 4
    assert units_of_columns(NAMES, {"F_unit": "N", "FIELD_1_UNITS": "bar"}) == [None, "bar", "N", None]


def test_signals_of_a_recorder_with_a_setting_of_two_numbers() -> None:
    labels = ("p_muscle [bar]", "F [N]", "stroke [mm]")
    titles = ("measured, gauge", "load cell", "shortening")
    signals = np.array(
        [
            (TABLE[:, [n]], 1.0, label, title, np.array([0.0, 1.0]))
            for n, (label, title) in enumerate(zip(labels, titles, strict=True), start=1)
        ],
        dtype=[(name, object) for name in ("values", "dimensions", "label", "title", "plotStyle")],
    )
    data = io.BytesIO()
    savemat(data, {"Scope": {"time": R.time, "signals": signals, "blockName": "rig/Scope"}})
    found = read_measurement(data.getvalue(), "a.mat")
    assert_read(found)
    assert not any("absolute" in message for message in found.messages)


def test_a_comment_of_each_column_holds_its_pressure_and_gaps_are_no_readings() -> None:
    loops = R.force.reshape(3, -1)
    stroke = R.stroke.reshape(3, -1)[0] * 1e3
    loops = np.where(loops < np.quantile(loops[0], 0.2), np.nan, loops)
    rows = [
        "\t".join([f"{x:.4f}", *("" if np.isnan(f) else f"{f:.4f}" for f in line)])
        for x, line in zip(stroke / 250.0 * 100.0, loops.T, strict=True)
    ]
    head = [
        "Contraction\tForce\tForce\tForce",
        "%\tN\tN\tN",
        "L0 = 250 mm\tp = 0.2 MPa\tp = 0.3 MPa\tp = 0.4 MPa",
    ]
    found = read_measurement("\n".join([*head, *rows]).encode(), "graph.dat")
    kept = ~np.isnan(loops)
    assert found.rows == np.count_nonzero(kept)
    for n, level in enumerate((2e5, 3e5, 4e5)):
        of_level = np.isclose(found.columns["pressure"], level)
        np.testing.assert_allclose(found.columns["force"][of_level], loops[n][kept[n]], atol=1e-3)
    assert found.conditions["nominal_length"] == pytest.approx(0.25)


def test_a_valve_in_per_mille() -> None:
    time = np.arange(40) * 0.01
    valve = np.where(time < 0.2, 1000, -500)
    rows = [f"{t:.2f};{v};{1000 * t:.0f};{50 * t:.3f}" for t, v in zip(time, valve, strict=True)]
    for head in ("t_s;iValve_promille;p_mbar;stroke_mm", "t_s;valve [‰];p_mbar;stroke_mm"):
        found = read_measurement("\n".join([head, *rows]).encode(), "trace.csv")
        np.testing.assert_allclose(found.columns["command"], valve / 1000.0)
