"""What a user says beyond a file, and the preview that asks for it."""

import hashlib
import json

import numpy as np
import pytest

from mckibben.measurement.reading import Correction, preview, read_correction, read_measurement
from mckibben.physics.errors import InputError

CSV = (
    b"# load_mass: 12 kg\ntime_s,p1,stroke_mm,F_N,note\n"
    + b"".join(b"%d,%d,%d,%d,x\n" % (n, n + 1, 5 * n, 100 - n) for n in range(20))
    + b"20,nan,100,1,x\n21,7,,1,x\n22,seven,100,1,x\n"
)
MAPPING = {
    "columns": {"p1": {"channel": "pressure", "unit": "bar"}, "F_N": None},
    "kind": "transient",
    "conditions": {"load_mass": "6 kg", "supply_pressure": "7 bar"},
    "bad_rows": "skip",
}


def correction(**parts: object) -> Correction:
    return read_correction(json.dumps(parts))


def test_columns_units_kind_and_conditions_are_taken() -> None:
    result = read_measurement(CSV, "a.csv", correction(**MAPPING))
    assert (result.kind, result.kind_detected, result.rows) == ("transient", False, 20)
    np.testing.assert_allclose(result.columns["pressure"], (np.arange(20) + 1) * 1e5)
    assert "force" not in result.columns
    assert result.ignored == ("F_N", "note")
    assert result.conditions == {"load_mass": 6.0, "supply_pressure": 7e5}
    assert result.skipped == {"not a finite number": 1, "an empty cell": 1, "not a number": 1}


def test_the_id_is_of_content_and_mapping() -> None:
    plain = hashlib.sha256(CSV).hexdigest()
    assert Correction().identity(CSV) == plain
    assert (
        correction().identity(CSV)
        == correction(columns={}, kind=None, bad_rows="refuse").identity(CSV)
        == plain
    )
    given = correction(**MAPPING)
    turned = json.dumps(MAPPING | {"columns": dict(reversed(MAPPING["columns"].items()))}, indent=2)
    assert read_correction(turned).identity(CSV) == given.identity(CSV) != plain
    assert read_correction(given.canonical()) == given
    assert read_measurement(CSV, "a.csv", given).id == given.identity(CSV)


def test_a_unit_may_say_absolute() -> None:
    found = correction(columns={"p1": {"channel": "pressure", "unit": "bar(a)"}}, bad_rows="skip")
    result = read_measurement(CSV, "a.csv", found)
    assert result.columns["pressure"][0] == pytest.approx(1e5 - 101325)


def test_a_unit_that_is_not_said_is_the_headers() -> None:
    found = correction(columns={"stroke_mm": {"channel": "length"}, "p1": None}, bad_rows="skip")
    text = CSV.replace(b"0,1,0,100", b"0,1,1,100")
    assert read_measurement(text, "a.csv", found).columns["length"].max() == pytest.approx(0.1)


def test_a_column_without_a_name_of_its_own_is_named_by_its_place() -> None:
    text = b"p_bar,,p_bar\n1,300,9\n2,290,9\n"
    named = {"column 2": {"channel": "length", "unit": "mm"}, "column 3": None}
    result = read_measurement(text, "a.csv", correction(columns=named))
    np.testing.assert_allclose(result.columns["length"], [0.3, 0.29])


def test_a_condition_can_be_taken_away() -> None:
    said = correction(columns={"p1": None}, conditions={"load_mass": None}, bad_rows="skip")
    found = read_measurement(CSV, "a.csv", said)
    assert "load_mass" not in found.conditions


WRONG = {
    "{": ("mapping", None),
    "[]": ("mapping", None),
    "[" * 5000: ("mapping", None),
    '{"colums": {}}': ("mapping.colums", "Did you mean 'columns'?"),
    '{"columns": {"p1": 7}}': ("mapping.columns.p1", None),
    '{"columns": {"p1": {}}}': ("mapping.columns.p1.channel", None),
    '{"columns": {"p1": {"channel": "presure"}}}': ("mapping.columns.p1.channel", "Did you mean 'pressure'?"),
    '{"columns": {"p1": {"channel": "pressure", "unit": "mm"}}}': ("mapping.columns.p1.unit", None),
    '{"columns": {"p1": {"channel": "pressure", "unit": 7}}}': ("mapping.columns.p1.unit", None),
    '{"columns": {"p1": {"channel": "pressure", "Unit": "bar"}}}': (
        "mapping.columns.p1.Unit",
        "Did you mean 'unit'?",
    ),
    '{"columns": {"p1": null, "p1": null}}': ("mapping.p1", None),
    '{"kind": "isobarik"}': ("mapping.kind", "Did you mean 'isobaric'?"),
    '{"kind": []}': ("mapping.kind", None),
    '{"bad_rows": "skipp"}': ("mapping.bad_rows", "Did you mean 'skip'?"),
    '{"conditions": {"load_mas": "6 kg"}}': ("mapping.conditions.load_mas", "Did you mean 'load_mass'?"),
    '{"conditions": {"load_mass": "6 mm"}}': ("mapping.conditions.load_mass", "e.g. '12 kg'"),
    '{"conditions": {"load_mass": true}}': ("mapping.conditions.load_mass", None),
    '{"conditions": {"load_mass": -1}}': ("mapping.conditions.load_mass", None),
    '{"conditions": {"load_mass": 1e999}}': ("mapping.conditions.load_mass", None),
}


@pytest.mark.parametrize("text", WRONG, ids=lambda text: text[:50])
def test_a_bad_mapping_names_its_key(text: str) -> None:
    field, hint = WRONG[text]
    with pytest.raises(InputError) as caught:
        read_correction(text)
    assert caught.value.field == field
    assert caught.value.hint
    assert hint is None or caught.value.hint == hint


def test_a_column_that_is_not_there() -> None:
    with pytest.raises(InputError, match="there is no column 'p11'") as caught:
        read_measurement(CSV, "a.csv", correction(columns={"p11": None}))
    assert caught.value.field == "column p11"
    assert caught.value.hint == "Did you mean 'p1'?"


def test_preview_of_what_can_be_guessed() -> None:
    found = preview(CSV.replace(b"21,7,,1,x", b"21,7,seven,1,x"), "a.csv", correction(columns={"p1": None}))
    by_header = {column.header: column for column in found.columns}
    assert list(by_header) == ["time_s", "p1", "stroke_mm", "F_N", "note"]
    assert [column.channel for column in found.columns] == ["time", None, "displacement", "force", None]
    assert by_header["stroke_mm"].unit == "mm"
    assert by_header["F_N"].unit == "N"
    assert (by_header["stroke_mm"].minimum, by_header["stroke_mm"].maximum) == (0.0, 0.1)
    assert found.sample[0] == ("0", "1", "0", "100", "x")
    assert len(found.sample) == 8
    assert (found.rows, found.valid) == (23, 22)
    assert {reason: skip.first for reason, skip in found.skipped.items()} == {
        "not a number": "row 24, column 'stroke_mm'"
    }
    assert found.refused
    assert found.problem is not None
    assert found.problem.field == "row 24, column stroke_mm"


def test_preview_with_the_users_word() -> None:
    found = preview(CSV, "a.csv", correction(**MAPPING))
    assert (found.rows, found.valid, found.problem, found.refused) == (23, 20, None, False)
    assert found.measurement is not None
    assert found.measurement.id == correction(**MAPPING).identity(CSV)
    assert found.missing == ()


@pytest.mark.parametrize(
    ("content", "missing"),
    [
        (b"time_s,command,pressure_bar\n0,1,1\n1,1,2\n", ["load_mass", "supply_pressure"]),
        (b"# load_force: 5 N\ntime_s,command,x_mm\n0,1,1\n1,1,2\n", ["supply_pressure"]),
        (b"pressure_bar,length_mm\n1,300\n2,290\n", ["load_mass"]),
        (b"pressure_bar,length_mm,load_N\n1,300,5\n2,290,5\n3,280,5\n", []),
        (b"pressure_bar,diameter_mm\n1,30\n2,29\n", []),
    ],
)
def test_conditions_are_asked_for(content: bytes, missing: list[str]) -> None:
    assert [condition.key for condition in preview(content, "a.csv").missing] == missing


def test_preview_tells_a_bad_unit_and_goes_on() -> None:
    found = preview(b"time_s,pressure_kg,length_mm\n0,1,300\n1,2,290\n", "a.csv")
    assert "the unit 'kg' is a mass" in str(found.columns[1].why)
    assert found.problem is not None
    assert found.measurement is None
    mended = preview(
        b"time_s,pressure_kg,length_mm\n0,1,300\n1,2,290\n",
        "a.csv",
        correction(columns={"pressure_kg": {"channel": "pressure", "unit": "bar"}}),
    )
    assert mended.problem is None


def test_preview_of_unknown_columns_lets_the_user_map_them() -> None:
    content = b"alpha,beta,gamma\n1,300,5\n2,290,6\n"
    found = preview(content, "a.csv")
    assert [column.channel for column in found.columns] == [None, None, None]
    assert found.problem is not None
    assert "no known channel" in found.problem.message
    mapped = {
        "alpha": {"channel": "pressure", "unit": "bar"},
        "beta": {"channel": "length", "unit": "mm"},
        "gamma": {"channel": "force", "unit": "N"},
    }
    assert preview(content, "a.csv", correction(columns=mapped)).problem is None
