"""Habits of theses: results and notes beside tables, repeats of a run, matrices, values with units."""

from __future__ import annotations

import io
import json

import h5py
import numpy as np
import openpyxl
import pytest
import scipy.io

from mckibben.measurement.reading import preview, read_measurement
from tests.measurement.reading.strangers_rows import LENGTH, PRESSURE, PULL, ROWS, table


def workbook(**sheets: list[list[object]]) -> bytes:
    book = openpyxl.Workbook()
    book.remove(book.active)
    for name, rows in sheets.items():
        sheet = book.create_sheet(name.replace("_", " "))
        for row in rows:
            sheet.append(row)
    data = io.BytesIO()
    book.save(data)
    return data.getvalue()


def test_the_pressure_of_a_run_stands_in_a_table_of_results() -> None:
    runs = {
        f"Run_{n}": [["x", "F"], ["mm", "N"], *[[x / 10, 200.0 * n - x] for x in range(60)]]
        for n in (1, 2, 3)
    }
    results = [
        ["", "Test pressure", "Fmax"],
        ["", "bar", "N"],
        *[[f"Run {n}", n + 0.5, 200.0 * n] for n in (1, 2, 3)],
    ]
    found = read_measurement(workbook(Results=results, **runs), "a.xlsx")
    assert found.kind == "isobaric"
    np.testing.assert_allclose(np.unique(found.columns["pressure"]), [1.5e5, 2.5e5, 3.5e5])


def test_notes_beside_a_table_are_texts() -> None:
    rows: list[list[object]] = [["p [bar]", "L [mm]", "F [N]", None, "Notes"]]
    notes = {0: "L at rest, vented: 300 mm", 2: "muscle DMSP-20", 4: "supply 6 bar"}
    rows += [
        [p, L, F, None, notes.get(n)] for n, (p, L, F) in enumerate(zip(PRESSURE, LENGTH, PULL, strict=True))
    ]
    found = read_measurement(workbook(Sheet=rows), "a.xlsx")
    assert found.rows == ROWS
    assert found.conditions["nominal_length"] == pytest.approx(0.3)
    assert found.conditions["supply_pressure"] == pytest.approx(6e5)
    assert found.conditions["muscle"] == "DMSP-20"


def test_repeats_are_runs_and_their_mean_is_none() -> None:
    rows: list[list[object]] = [["Series at a pressure of 3 bar"], ["", "Force in N"]]
    rows.append(["Stroke in mm", "1. Run", "2. Run", "Mean", "Std"])
    rows += [[float(x), 700.0 - 9 * x, 702.0 - 9 * x, 701.0 - 9 * x, 1.4] for x in range(40)]
    found = read_measurement(workbook(A=rows), "a.xlsx")
    assert found.rows == 80
    np.testing.assert_allclose(sorted(found.columns["force"])[-2:], [700.0, 702.0])


def test_matrices_hold_runs_one_after_another() -> None:
    data = io.BytesIO()
    forces = np.array([[100.0 * k - n for n in range(50)] for k in (3, 6, 9)])
    strokes = np.tile(np.arange(50.0) / 2.0, (3, 1))
    scipy.io.savemat(
        data,
        {
            "time_s": np.arange(50.0),
            "force_N": forces,
            "stroke_mm": strokes,
            "pressure_bar": np.array([1.0, 2.0, 3.0]),
        },
    )
    found = read_measurement(data.getvalue(), "a.mat")
    np.testing.assert_allclose(found.columns["force"], forces.ravel())
    np.testing.assert_allclose(found.columns["pressure"], np.repeat([1e5, 2e5, 3e5], 50))
    assert len(set(found.columns["group"].tolist())) == 3


def test_a_value_and_its_unit_in_two_attributes() -> None:
    data = io.BytesIO()
    with h5py.File(data, "w") as file:
        file.attrs["L0"], file.attrs["L0_unit"] = 0.3, "m"
        for k in (1, 2, 3):
            group = file.create_group(f"pull{k}")
            group.attrs["p"], group.attrs["p_unit"] = 1.5 * k, "bar"
            group["stroke [m]"] = np.arange(50.0) / 1000.0
            group["force [N]"] = 300.0 * k - 5 * np.arange(50.0)
            group["force_fit [N]"] = 301.0 * k - 5 * np.arange(50.0)
    found = read_measurement(data.getvalue(), "a.h5")
    np.testing.assert_allclose(np.unique(found.columns["pressure"]), [1.5e5, 3e5, 4.5e5])
    assert found.conditions["nominal_length"] == pytest.approx(0.3)
    assert {c.column for c in found.channels if c.name == "force"} == {"force [N]"}


def test_columns_and_rows_of_json_with_words_among_them() -> None:
    rows = [[L, p, F, "up"] for L, p, F in zip(LENGTH, PRESSURE, PULL, strict=True)]
    text = json.dumps(
        {"columns": ["L_mm", "p_bar", "F_N", "direction"], "index": list(range(ROWS)), "data": rows}
    )
    found = read_measurement(text.encode(), "a.json")
    np.testing.assert_allclose(found.columns["force"], PULL)


def test_blanks_between_thousands_do_not_hide_the_delimiter() -> None:
    rows = "\n".join(
        f"{p:.1f}".replace(".", ",") + f";1 {600 - 9 * n};{300 - n}" for n, p in enumerate(PRESSURE[:30])
    )
    found = read_measurement(f"Text, with commas, in it\np [bar];F [N];L [mm]\n{rows}".encode(), "a.csv")
    assert found.columns["force"][0] == pytest.approx(1600.0)


def test_two_transducers_leave_the_reference_open() -> None:
    text = table("p [bar];x [mm];F [N]", [2.6] * ROWS, [300 - L for L in LENGTH], PULL[::-1]).decode()
    said = "pressure sensor: absolute or relative, see the book\nL0 = 300 mm\n"
    asked = {q.about for q in preview((said + text).encode(), "a.csv").questions if q.stops}
    assert "reference of pressure" in asked
