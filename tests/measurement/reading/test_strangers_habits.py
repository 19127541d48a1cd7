"""Files as strangers write them: conditions in sentences, units in attributes, tests in JSON, empty cells.

Every value that is expected was put into the text by the test itself.
"""

from __future__ import annotations

import io
import json
from collections.abc import Mapping
from dataclasses import replace
from typing import Any

import h5py
import numpy as np
import pytest

from mckibben.measurement.measurement import Measurement
from mckibben.measurement.reading import preview, read_measurement
from mckibben.measurement.reading.correction import spoken_correction
from mckibben.physics.errors import InputError

PRESSURES = np.linspace(1.0, 6.0, 30)  # bar
POUND_FORCE = 4.4482216152605  # N, by definition
INCH = 0.0254  # m, by definition


def pull(length: float) -> np.ndarray:
    """A force [N] that grows with pressure and length [mm], all above zero."""
    return 60.0 * PRESSURES + (length - 200.0)


def hanging(seconds: float, preamble: str, *, jump: bool = False) -> bytes:
    """A weight lifted and lowered once within a time, or all at once, recorded at 20 Hz."""
    time = np.arange(0.0, seconds, 0.05)
    way = 1.0 - np.abs(2.0 * time / seconds - 1.0)
    way = (time > 0.5 * seconds).astype(float) if jump else way
    rows = zip(time, 10.0 + 60.0 * way, 11.0 - 2.0 * way, strict=True)
    lines = "\n".join("\t".join(f"{value:.5f}" for value in row) for row in rows)
    return f"{preamble}Time (s)\tPressure (psig)\tLength (in)\n{lines}\n".encode()


def document(content: Any) -> bytes:
    return json.dumps(content, default=lambda array: array.tolist()).encode()


def hdf5(
    root: Mapping[str, Any], columns: Mapping[str, Mapping[str, str]], group: Mapping[str, str]
) -> bytes:
    """A map of two lengths in a group of an HDF5 file with attributes."""
    data = io.BytesIO()
    values = (
        np.tile(PRESSURES, 2),
        np.repeat([300.0, 280.0], 30),
        np.concatenate([pull(300.0), pull(280.0)]),
    )
    with h5py.File(data, "w") as file:
        file.attrs.update(root)
        place = file.create_group("medida")
        place.attrs.update(group)
        for (name, attributes), numbers in zip(columns.items(), values, strict=True):
            place[name] = numbers
            place[name].attrs.update(attributes)
    return data.getvalue()


def of_lengths(result: Measurement, *lengths: float) -> None:
    """The measurement holds the readings of these lengths [mm], one group each."""
    np.testing.assert_allclose(result.columns["pressure"], np.tile(PRESSURES, len(lengths)) * 1e5)
    np.testing.assert_allclose(result.columns["length"], np.repeat(lengths, 30) / 1e3)
    np.testing.assert_allclose(result.columns["force"], np.concatenate([pull(length) for length in lengths]))
    assert len(np.unique(result.columns["group"])) == len(lengths)


SENTENCES = {
    "Muscle: DMSP-20, resting length 11 in (vented)": {"muscle": "DMSP-20", "nominal_length": "11 in"},
    "the muscle is 250 mm long when unpressurised": {"nominal_length": "250 mm"},
    "Länge bei 0 bar: 30 cm": {"nominal_length": "30 cm"},
    "longueur sans pression 0,3 m": {"nominal_length": "0.3 m"},
    "L_0 = 0.25 m, Masse angehängt 5 kg": {"nominal_length": "0.25 m", "load_mass": "5 kg"},
    "L0_mm: 250": {"nominal_length": "250 mm"},
    "stroke 30 mm rest length 250 mm": {"nominal_length": "250 mm"},
    "12 kg hung from the lower end": {"load_mass": "12 kg"},
    "shop air at 90 psi": {"supply_pressure": "90 psi"},
    "pressure swept from 0 bar to 6 bar, length 283 mm": {},
    "strain gauge amplifier, pressure sensor new": {},
}


PREAMBLES = [
    "# Muscle: DMSP-20, resting length 11.0 in\n# Test: 25 lb dead weight hung from it\n",
    "# student bench\n# the muscle is 11 in long at rest and carries a weight of 25 lb\n",
    "bench 3\nresting length 11 in\ndead weight 25 lb\n",
]


@pytest.mark.parametrize("preamble", PREAMBLES)
def test_a_weight_that_moves_slowly_is_isotonic_with_what_the_preamble_says(preamble: str) -> None:
    result = read_measurement(hanging(60.0, preamble), "run.tsv")
    assert result.kind == "isotonic"
    assert result.conditions["nominal_length"] == pytest.approx(11.0 * INCH)
    assert result.conditions["load_force"] == pytest.approx(25.0 * POUND_FORCE)


def test_a_weight_on_sines_of_some_seconds_is_isotonic_although_its_pressure_jumps_now_and_then() -> None:
    """40 kg, periods of 7 s: at most 0.6 % of the weight is inertia, and three steps are 4 % of the way."""
    time = np.arange(0.0, 150.0, 0.1)
    way = 0.03 * (1.0 - np.cos(2.0 * np.pi * time / 7.0)) + 0.01 * ((time > 50.0) ^ (time > 100.0))
    rows = "\n".join(f"{t:.1f}\t{1.0 + 50.0 * w:.3f}\t{0.6 - w:.5f}" for t, w in zip(time, way, strict=True))
    head = "# a mass of 40 kg hangs from the muscle, rest length 0.6 m\n"
    file = f"{head}time (s)\tpressure (bar)\tlength (m)\n{rows}\n".encode()
    assert read_measurement(file, "log.tsv").kind == "isotonic"
    rows = "\n".join(
        f"{t / 7.0:.4f}\t{1.0 + 50.0 * w:.3f}\t{0.6 - w:.5f}" for t, w in zip(time, way, strict=True)
    )
    faster = f"{head}time (s)\tpressure (bar)\tlength (m)\n{rows}\n".encode()
    assert read_measurement(faster, "log.tsv").kind == "transient"


@pytest.mark.parametrize(("step", "kind"), [(0.25, "isotonic"), (0.05, "transient")])
def test_stairs_under_a_weight_are_isotonic_where_no_row_could_show_its_inertia(
    step: float, kind: str
) -> None:
    """52 kg swing on a muscle with some hertz: four rows a second show nothing of it, twenty do."""
    time = np.arange(0.0, 300.0, step)
    pressure = np.interp(time % 60.0, [0.0, 29.0, 30.0, 59.0, 60.0], [1.1, 1.1, 4.2, 4.2, 1.1])
    rows = "\n".join(f"{t:.2f},{p:.4f},{470.0 - 25.0 * p:.3f}" for t, p in zip(time, pressure, strict=True))
    head = "# a mass of 52 kg hangs from the muscle, rest length 0.5 m\ntime_s,pressure_bar,length_mm\n"
    assert read_measurement(f"{head}{rows}\n".encode(), "stairs.csv").kind == kind


def test_a_weight_that_jumps_or_is_not_known_is_transient() -> None:
    jumping = read_measurement(hanging(60.0, PREAMBLES[0], jump=True), "run.tsv")
    assert jumping.kind == "transient"
    assert read_measurement(hanging(2.0, PREAMBLES[0]), "run.tsv").kind == "transient"
    assert read_measurement(hanging(60.0, "# no word of a load\n"), "run.tsv").kind == "transient"


UNITS = {
    "in a word of the language": (
        {}, {"pressao": {"unidade": "bar"}, "comprimento": {"unidade": "mm"}, "forca": {"unidade": "N"}}, {},
    ),
    "under any name": (
        {}, {"pressao": {"esc": "bar"}, "comprimento": {"esc": "mm"}, "forca": {"esc": "N", "in": "ai0"}}, {},
    ),
    "of the group": (
        {}, {"pressao": {}, "comprimento": {}, "forca": {}},
        {"pressao_unidade": "bar", "unidade_comprimento": "mm", "forca_unidade": "N"},
    ),
    "in one text of the file": (
        {"unidades": "pressao: bar, comprimento: mm, forca: N"},
        {"pressao": {}, "comprimento": {}, "forca": {}}, {},
    ),
}  # fmt: skip


@pytest.mark.parametrize("place", UNITS)
def test_units_stand_in_attributes(place: str) -> None:
    of_lengths(read_measurement(hdf5(*UNITS[place]), "m.h5"), 300.0, 280.0)


def _nested() -> dict[str, Any]:
    def run(length: float) -> dict[str, Any]:
        signals = [("pressure", "bar", PRESSURES), ("force", "N", pull(length))]
        return {
            "length_mm": length, "signals": [{"name": n, "unit": u, "values": v} for n, u, v in signals],
        }  # fmt: skip

    def channels(length: float) -> dict[str, Any]:
        return {
            "conditions": {"length": {"value": length, "unit": "mm"}},
            "channels": {"p": PRESSURES, "F": pull(length)},
        }

    def records(length: float) -> list[dict[str, float]]:
        return [{"p_bar": float(p), "F_N": float(f)} for p, f in zip(PRESSURES, pull(length), strict=True)]

    return {
        "tests with data": {
            "tests": [{"length_mm": n, "data": {"p_bar": PRESSURES, "F_N": pull(n)}} for n in (300.0, 280.0)]
        },
        "records in tests": {
            "tests": [{"at": {"length_mm": n}, "readings": records(n)} for n in (300.0, 280.0)]
        },
        "rows below names in tests": {
            "tests": [
                {"length_mm": n, "columns": ["p [bar]", "F [N]"], "data": np.stack([PRESSURES, pull(n)]).T}
                for n in (300.0, 280.0)
            ]
        },
        "runs by name, units outside": {
            "units": {"p": "bar", "F": "N"}, "runs": {"a": channels(300.0), "b": channels(280.0)},
        },
        "runs in tests": {"tests": [{"runs": [run(300.0)]}, {"runs": [run(280.0)]}]},
    }  # fmt: skip


@pytest.mark.parametrize("shape", _nested())
def test_tests_are_nested_in_json_with_conditions_at_each_level(shape: str) -> None:
    content = {**_nested()[shape], "specimen": {"rest_length_mm": 310.0}}
    result = read_measurement(document(content), "a.json")
    of_lengths(result, 300.0, 280.0)
    assert result.conditions["nominal_length"] == pytest.approx(0.31)


def test_one_test_in_a_list_keeps_its_length() -> None:
    rows = [{"p_bar": float(p), "F_N": float(f)} for p, f in zip(PRESSURES, pull(300.0), strict=True)]
    of_lengths(read_measurement(document({"tests": [{"length_mm": 300.0, "rows": rows}]}), "a.json"), 300.0)


def test_runs_of_several_tests_are_groups_of_their_own() -> None:
    def run(length: float) -> dict[str, Any]:
        return {"length_mm": length, "p_bar": PRESSURES, "F_N": pull(length)}

    tests = [{"runs": [run(300.0), run(290.0)]}, {"runs": [run(280.0), run(270.0)]}]
    of_lengths(read_measurement(document({"tests": tests}), "a.json"), 300.0, 290.0, 280.0, 270.0)


def test_a_mostly_slack_muscle_is_read_without_its_empty_rows() -> None:
    forces = [(n, 260.0 - 10.0 * n) for n in range(60)]
    rows = [f"{300 - n},2,{force if force > 0 else ''}" for n, force in forces]
    result = read_measurement("\n".join(["length_mm,pressure_bar,force_N", *rows]).encode(), "a.csv")
    assert result.columns["force"].tolist() == [force for _, force in forces if force > 0]
    assert any("34 rows left out: an empty cell (first: row 28" in said for said in result.messages)
    with pytest.raises(
        InputError, match=r"row 6, column 'force_N': the cell is empty, and 8 rows have no number"
    ):
        read_measurement(
            "\n".join(["length_mm,pressure_bar,force_N", *rows[22:34]]).encode(), "a.csv"
        )  # too few are left


MAPS = {
    "names above the corner": "Force [N], empty where slack;;\nContraction [%];Pressure [bar];\n;1;2;3\n",
    "a sentence": "rows: contraction [%], columns: pressure [bar]\nForce [N]\n;1;2;3\n",
    "the value in the corner": "Contraction [%];Pressure [bar];\nForce [N];1;2;3\n",
}


@pytest.mark.parametrize("above", MAPS)
def test_a_map_says_its_axes_above(above: str) -> None:
    result = read_measurement(f"{MAPS[above]}0;100;200;300\n5;;120;180\n10;;;90\n".encode(), "map.csv")
    np.testing.assert_allclose(result.columns["force"], [100, 200, 300, 120, 180, 90])
    np.testing.assert_allclose(result.columns["pressure"], np.array([1, 2, 3, 2, 3, 3]) * 1e5)
    np.testing.assert_allclose(result.columns["contraction"], [0, 0, 0, 0.05, 0.05, 0.1])
    assert any("3 empty cells hold no reading" in said for said in result.messages)


def test_a_force_without_unit_is_asked_unless_the_file_is_in_si() -> None:
    rows = [f"{p},{300 - n},{f}" for n, (p, f) in enumerate(zip(PRESSURES, pull(300.0), strict=True))]
    found = preview("\n".join(["Pressure (bar),Length (mm),Force", *rows]).encode(), "a.csv")
    (asked,) = [question for question in found.questions if question.stops]
    assert asked.about == "unit of force"
    assert {"N", "lbf", "kgf"} <= set(asked.choices)
    rows = [
        f"{1e5 * p},{0.3 - n / 1e3},{f}" for n, (p, f) in enumerate(zip(PRESSURES, pull(300.0), strict=True))
    ]
    result = read_measurement("\n".join(["pressure,length,force", *rows]).encode(), "a.csv")
    np.testing.assert_allclose(result.columns["force"], pull(300.0))


def test_the_length_of_a_muscle_beside_a_stroke_is_no_channel() -> None:
    stroke = np.linspace(0.0, 29.0, 30)
    held, force = np.full(30, 3.0), 600.0 - 15.0 * stroke
    entry = {"length_mm": 300.0, "p_bar": held, "displacement_mm": stroke, "F_N": force}
    for tests in ([entry], [entry, entry]):
        result = read_measurement(document({"tests": tests}), "a.json")
        assert "length" not in result.columns
        np.testing.assert_allclose(result.columns["displacement"], np.tile(stroke, len(tests)) / 1e3)


def test_units_behind_names_without_brackets() -> None:
    """Blocks under a caption, their heads parted by blanks: each name is followed by its unit."""
    blocks = [
        f"P = {pressure:.1f} bar (gauge)\nstroke mm   force N\n"
        + "\n".join(f"{stroke:8.2f}   {300.0 - 2.0 * stroke:8.2f}" for stroke in range(10))
        for pressure in (1.0, 2.0)
    ]
    found = read_measurement(("rest length 250 mm\n\n" + "\n\n".join(blocks)).encode(), "blocks.txt")
    assert found.columns["pressure"] == pytest.approx(np.repeat([1e5, 2e5], 10))
    assert found.columns["displacement"] == pytest.approx(np.tile(1e-3 * np.arange(10.0), 2))
    assert found.columns["force"] == pytest.approx(np.tile(300.0 - 2.0 * np.arange(10.0), 2))


def test_a_scale_that_the_muscle_pulls_is_asked_about() -> None:
    """Its name is not that of a force; what it reads with nothing on it is its tare, and no load."""
    text = (
        "L0 = 300 mm\nscale reads 0.850 kg with nothing attached\nt [s]\tp [bar]\tstroke [mm]\tscale [kg]\n"
    )
    text += "\n".join(f"{k}\t{1 + k % 3}\t{2 * k}\t{0.85 + 9.0 - 0.2 * k:.3f}" for k in range(30))
    with pytest.raises(InputError, match=r"'scale \[kg\]' .*force=scale"):
        read_measurement(text.encode(), "scale.txt")
    force = {"columns": ["force=scale"]}
    with pytest.raises(InputError, match=r"force_zero=8\.33565 N"):
        read_measurement(text.encode(), "scale.txt", spoken_correction(**force))
    zeroed = replace(spoken_correction(**force), conditions={"force_zero": 0.85 * 9.80665})
    found = read_measurement(text.encode(), "scale.txt", zeroed)
    assert "load_mass" not in found.conditions
    assert found.columns["force"][0] == pytest.approx(9.85 * 9.80665)


def test_a_commanded_pressure_is_no_second_reading() -> None:
    text = "# rest length 300 mm\n%time,field.pressure_kPa,field.cmd_kPa,field.position_mm\n"
    text += "\n".join(
        f"{1571923456_000000000 + k * 10**8},{150 + 5 * k},{150 + 50 * (k // 10)},{2 * k}" for k in range(30)
    )
    found = read_measurement(text.encode(), "log.csv")
    assert found.columns["pressure"] == pytest.approx(1e3 * (150.0 + 5.0 * np.arange(30)))


def test_numbered_pages_with_the_same_head_are_one_table() -> None:
    """The number of the first page stood above the columns as if it were the unit of the second one."""
    rows = [
        f"{0.5 * k:.1f}  {1 + k // 40:.2f}  {k % 40:.2f}  {300.0 - 2.0 * (k % 40):.2f}" for k in range(120)
    ]
    pages = [
        f"Page {number + 1}\nSpecimen: muscle 7, free length 250 mm\nt/s  p/bar  s/mm  F/N\n"
        + "\n".join(rows[30 * number : 30 * number + 30])
        for number in range(4)
    ]
    found = read_measurement("\n\n".join(pages).encode(), "pages.txt")
    assert found.rows == 120
    assert found.columns["pressure"] == pytest.approx(np.repeat([1e5, 2e5, 3e5], 40))
    assert found.conditions["nominal_length"] == 0.25
