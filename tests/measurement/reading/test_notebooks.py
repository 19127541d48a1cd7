"""Habits of notebooks and of programs: wide digits, deviations, quantities in records, metadata of fields."""

from __future__ import annotations

import io
import json

import numpy as np
import pyarrow as pa
import pyarrow.parquet as parquet
import pytest

from tests.measurement.reading.bench import FORCE, PRESSURE, STROKE, TIME, assert_is, read, table

MM, BAR = STROKE * 1e3, PRESSURE / 1e5
HELD = {"pressure": PRESSURE, "force": FORCE, "displacement": STROKE}


def test_wide_digits_are_digits() -> None:
    rows = table(TIME, BAR, FORCE, MM, separator="\t").splitlines()
    wide = str.maketrans("0123456789.", "０１２３４５６７８９．")
    rows[5:30] = [row.translate(wide) for row in rows[5:30]]
    assert_is(read("# rest length 300 mm\nt [s]\tp [bar]\tF [N]\ts [mm]\n" + "\n".join(rows)), HELD)


def test_readings_with_their_deviations_under_pressures() -> None:
    head = "Zugkraft in N (Mittelwert ± Standardabweichung, n = 5)\nAusgangslänge 145 mm; Überdruck\n\n"
    rows = [f"{k};{90 - 8 * k},2 ± 1,7;{180 - 9 * k},5 ± 2,4" for k in range(10)]
    found = read(head + "Kontraktion (%);100 kPa;200 kPa\n" + "\n".join([*rows, "10;–;85,1 ± 0,4"]))
    assert found.rows == 21
    assert found.conditions["nominal_length"] == 0.145
    assert (found.columns["force"].max(), found.columns["pressure"].max()) == (180.5, 2e5)


def test_quantities_in_the_records_of_a_log() -> None:
    lines = [json.dumps({"type": "head", "rest_length": {"value": 300, "unit": "mm"}})]
    for t, p, f, s in zip(TIME, BAR, FORCE, MM, strict=True):
        state = {"pressure": {"value": p, "unit": "bar"}, "tension": {"value": f, "unit": "N"}}
        lines.append(
            json.dumps({"type": "row", "t_s": t, "state": state | {"stroke": {"value": s, "unit": "mm"}}})
        )
    found = read("\n".join(lines).encode(), "log.jsonl")
    assert_is(found, HELD)
    assert found.conditions["nominal_length"] == 0.3


def test_units_in_the_metadata_of_fields() -> None:
    given = (("t", "s", TIME), ("p", "bar", BAR), ("tension", "N", FORCE), ("stroke", "mm", MM))
    fields = [pa.field(n, pa.float64(), metadata={"unit": u, "description": ""}) for n, u, _ in given]
    schema = pa.schema(fields, metadata={"rest_length": "300 mm"})
    stream = io.BytesIO()
    parquet.write_table(pa.table([pa.array(v) for *_, v in given], schema=schema), stream)
    assert_is(read(stream.getvalue(), "rig.parquet"), HELD)


@pytest.mark.parametrize("head", ["payload_kg", "Nutzlast [kg]"])
def test_a_payload_is_the_load(head: str) -> None:
    found = read(f"t_s,p_bar,length_mm,{head}\n" + table(TIME, BAR, 300.0 - MM, np.full(len(TIME), 5.0)))
    assert found.conditions["load_mass"] == 5.0
    assert "force" not in found.columns


def test_a_value_right_above_the_names_is_no_name() -> None:
    rows = [
        f"{cycle},{p},{300 - 10 * p - cycle}"
        for cycle in (1, 2, 3)
        for p in (0, 1, 2, 3, 4, 5, 4, 3, 2, 1, 0)
    ]
    found = read("L0 (mm),300,\nCycle,P (bar),L (mm)\n" + "\n".join(rows))
    assert found.conditions["nominal_length"] == 0.3
    assert set(found.columns["group"].tolist()) == {1, 2, 3}
