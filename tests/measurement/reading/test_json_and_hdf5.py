"""JSON, JSON lines and HDF5: records, vectors by name, groups with attributes; limits."""

from __future__ import annotations

import io
import json
from collections.abc import Callable

import h5py
import numpy as np
import pytest

from mckibben.physics.errors import InputError
from tests.measurement.reading.isobaric import FORCE, PRESSURE, STROKE, TIME, assert_is_the_test, read

ROWS = [{"p_bar": p, "force_N": f, "stroke_mm": s} for p, f, s in zip(PRESSURE, FORCE, STROKE, strict=True)]
BY_PRESSURE = {p: (FORCE[p == PRESSURE].tolist(), STROKE[p == PRESSURE].tolist()) for p in (2.0, 4.0)}

JSON = {
    "vectors": {
        "rest_length_mm": 300, "p_bar": PRESSURE.tolist(), "force_N": FORCE.tolist(),
        "stroke_mm": STROKE.tolist(),
    },
    "records": {"specimen": {"L0": {"value": 300, "unit": "mm"}}, "data": ROWS},
    "columns and rows": {
        "meta": {"L0": "300 mm"}, "columns": ["p_bar", "force_N", "stroke_mm"],
        "data": [list(row.values()) for row in ROWS],
    },
    "points of runs whose names stand once": {
        "rest_length_mm": 300, "point": ["stroke_mm", "force_N"],
        "runs": [
            {"p_bar": p, "points": [list(pair) for pair in zip(stroke, force, strict=True)]}
            for p, (force, stroke) in BY_PRESSURE.items()
        ],
    },
    "signals": {
        "rest_length": {"value": 300, "unit": "mm"},
        "signals": [
            {"name": name, "unit": unit, "values": values.tolist()}
            for name, unit, values in (
                ("pressure", "bar", PRESSURE), ("force", "N", FORCE), ("stroke", "mm", STROKE),
            )
        ],
    },
    "runs": {
        "rest_length_mm": 300,
        "runs": [
            {"pressure": {"value": p, "unit": "bar"}, "force_N": force, "stroke_mm": stroke}
            for p, (force, stroke) in BY_PRESSURE.items()
        ],
    },
    "units apart": {
        "units": {"p": "bar", "F": "N", "s": "mm shortening"}, "l0_mm": 300,
        "samples": [dict(zip("pFs", row.values(), strict=True)) for row in ROWS],
    },
}  # fmt: skip


@pytest.mark.parametrize("case", JSON)
def test_json(case: str) -> None:
    assert_is_the_test(read(json.dumps(JSON[case]), "a.json"))


def test_json_lines_with_other_lines_between() -> None:
    lines = [{"type": "meta", "rest_length_mm": 300, "baro_hPa": 1000.0, "units": {"p": "hPa absolute"}}]
    lines += [
        {"t": t, "d": {"p": 1000 * p + 1000, "force_N": f, "stroke_mm": s}}
        for t, p, f, s in zip(TIME, PRESSURE, FORCE, STROKE, strict=True)
    ]
    lines.insert(9, {"type": "alive", "uptime_s": 7})
    found = read("\n".join(map(json.dumps, lines)), "a.jsonl")
    assert_is_the_test(found)
    assert found.conditions["ambient_pressure"] == 1e5
    assert any("2 of 42 records hold no readings" in message for message in found.messages)


def test_json_without_readings_is_refused() -> None:
    with pytest.raises(InputError):
        read('{"a": "b", "c": [{"d": 1}]}', "a.json")


def hdf5(fill: Callable[[h5py.File], None]) -> bytes:
    stream = io.BytesIO()
    with h5py.File(stream, "w") as file:
        fill(file)
    return stream.getvalue()


def attributes(file: h5py.File) -> None:
    file.attrs["L0"], file.attrs["L0_unit"] = 300.0, "mm"
    for name, values, unit in (("p", PRESSURE, "bar"), ("force", FORCE, "N"), ("stroke", STROKE, "mm")):
        file.create_dataset(name, data=values).attrs["units"] = unit


def groups(file: h5py.File) -> None:
    for number, (pressure, (force, stroke)) in enumerate(BY_PRESSURE.items()):
        group = file.create_group(f"runs/run_{number}")
        group.attrs["pressure"], group.attrs["pressure_unit"] = pressure, "bar"
        group.attrs["rest_length_mm"] = 300.0
        group["force_N"], group["stroke_mm"] = force, stroke
        group["adc_raw"] = np.arange(len(force))


def matrix(file: h5py.File) -> None:
    file.attrs["rest_length"] = "300 mm"
    readings = file.create_dataset("readings", data=np.column_stack([PRESSURE, FORCE, STROKE]))
    readings.attrs["columns"], readings.attrs["units"] = ["pressure", "force", "stroke"], ["bar", "N", "mm"]


def compound(file: h5py.File) -> None:
    file.attrs["L0_mm"] = 300.0
    table = np.zeros(len(TIME), dtype=[("pressure_bar", "f8"), ("force_N", "f8"), ("stroke_mm", "f8")])
    table["pressure_bar"], table["force_N"], table["stroke_mm"] = PRESSURE, FORCE, STROKE
    file["table"] = table


@pytest.mark.parametrize("fill", [attributes, groups, matrix, compound], ids=lambda fill: fill.__name__)
def test_hdf5(fill: Callable[[h5py.File], None]) -> None:
    assert_is_the_test(read(hdf5(fill), "a.h5"))


def test_hdf5_of_too_many_objects_is_refused() -> None:
    def many(file: h5py.File) -> None:
        for number in range(2001):
            file.create_group(f"g{number}")

    with pytest.raises(InputError, match=r"more than 2000"):
        read(hdf5(many), "a.h5")
