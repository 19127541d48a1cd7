"""Exports of testing machines, oscilloscopes and loggers of strangers: summaries, discs, volts, two heads.

Every value that is expected was put into the text by the test itself.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

import mckibben as mk
from mckibben.measurement.measurement import Measurement
from mckibben.measurement.reading import read_correction, read_measurement, spoken_correction
from mckibben.physics.errors import InputError

GRAVITY = 9.80665  # m/s2, standard
WAY = np.concatenate([np.linspace(0.0, -50.0, 20), np.linspace(-50.0, 0.0, 20)])  # mm
FORCE = 254.9 + 3.8 * WAY  # N
MACHINE_HEAD = [
    "testXpert III",
    "Einspannlänge L0 (drucklos, kraftlos);250,00;mm",
    "Prüfdruck (Überdruck, geregelt);3,0;bar",
    "Bemerkung;Weg = 0 bei L0, Verkürzung negativ",
    "",
    "Prüfzeit;Traversenweg;Standardkraft",
    "s;mm;N",
]
MACHINE_ROWS = [
    f"{0.1 * n:.1f};{way:.3f};{force:.2f}".replace(".", ",")
    for n, (way, force) in enumerate(zip(WAY, FORCE, strict=True))
]
EXTREMES = ["Fmax;;254,9", "Fmin;;64,5"]
VOLTS = 1.0 + 4.0 * np.sin(np.linspace(0.0, np.pi, 60)) ** 2
SCOPE_COLUMNS = ("pressure=CH1 pressure (V)", "force=CH2 force (V)")


def machine(below: Sequence[str], rows: Sequence[str] = MACHINE_ROWS) -> Measurement:
    text = "\r\n".join([*MACHINE_HEAD, *rows, *below]) + "\r\n"
    return read_measurement(text.encode("latin-1"), "probe.txt")


@pytest.mark.parametrize(
    "below",
    [
        ["", "Statistik;;", *EXTREMES],
        ["Ergebnisse;;", *EXTREMES],
        ["", *EXTREMES],
        ["", "", "Werte", "", *EXTREMES],
    ],
)
def test_a_summary_below_the_table_is_left_out_and_said(below: list[str]) -> None:
    found = machine(below)
    assert len(found.columns["force"]) == len(MACHINE_ROWS)
    assert any("below the table" in m and "not read" in m and "'Fmax: 254,9'" in m for m in found.messages)


@pytest.mark.parametrize(
    "rows",
    [
        [*MACHINE_ROWS, "abc;-1,0;200,0"],
        [*MACHINE_ROWS[:20], "Pause;;", "abc;-1,0;200,0", *MACHINE_ROWS[20:]],
    ],
)
def test_a_word_where_a_reading_stands_is_an_error(rows: list[str]) -> None:
    with pytest.raises(InputError, match="'abc' is not a number"):
        machine([], rows)


def test_labels_of_rows_below_a_remark_are_no_summary() -> None:
    rows = [f"probe{n};{100 + n};{2 + 0.1 * n:.1f};{200 - n}" for n in range(12)]
    text = "\n".join(["label;F [N];p [bar];L [mm]", *rows[:6], "Umbau;;;", *rows[6:]])
    assert len(read_measurement(text.encode(), "a.csv").columns["force"]) == 12


def test_a_titled_summary_below_a_plain_table() -> None:
    rows = [f"{n},{2 + 0.1 * n:.1f},{100 + n}" for n in range(12)]
    text = "\n".join(["time_s,pressure_bar,force_N", *rows, "Results,,", "Fpeak,,111"])
    found = read_measurement(text.encode(), "a.csv")
    assert len(found.columns["force"]) == 12
    assert any("'Fpeak: 111'" in m for m in found.messages)


def test_pressure_rest_length_and_sign_of_a_machine_stand_in_its_head() -> None:
    found = machine(["", "Statistik;;", *EXTREMES])
    assert found.kind == "isobaric"
    assert found.conditions["nominal_length"] == pytest.approx(0.25)
    np.testing.assert_allclose(found.columns["pressure"], 3e5)
    np.testing.assert_allclose(found.columns["displacement"], -WAY / 1e3, atol=1e-6)
    assert any("sign reversed" in m for m in found.messages)
    assert any("pressure is taken from line 3" in m for m in found.messages)


def discs(head: str = "Masse disques [kg]") -> bytes:
    rows = [f"{p};{m};{12 + 5 * p - 2 * m}" for p in (1, 2, 3, 4) for m in (2, 4, 6)]
    return "\n".join([f"Pression [bar];{head};Course [mm]", *rows]).encode()


@pytest.mark.parametrize("word", ["load", "mass", "weight", "force"])
@pytest.mark.parametrize("head", ["Masse disques [kg]", "Masse disques", "m2"])
def test_a_load_of_each_row_is_the_force_of_its_weight(word: str, head: str) -> None:
    column = f"{word}={head.partition(' [')[0]} [kg]"
    found = read_measurement(discs(head), "paliers.csv", spoken_correction(columns=[column]))
    np.testing.assert_allclose(found.columns["force"], np.tile([2.0, 4.0, 6.0], 4) * GRAVITY)
    assert any(f"'{head}' is a mass: its weight is the force" in m for m in found.messages)


@pytest.mark.parametrize(
    "mapping",
    [
        '{"column": ["load=Masse disques [kg]"]}',
        '{"columns": {"Masse disques": {"channel": "load", "unit": "kg"}}}',
        '{"columns": {"Masse disques [kg]": {"channel": "mass"}}}',
    ],
)
def test_a_load_in_a_mapping(mapping: str) -> None:
    found = read_measurement(discs(), "paliers.csv", read_correction(mapping))
    np.testing.assert_allclose(found.columns["force"], np.tile([2.0, 4.0, 6.0], 4) * GRAVITY)


def test_a_load_from_python(tmp_path) -> None:
    (tmp_path / "paliers.csv").write_bytes(discs("m2"))
    found = mk.read(tmp_path / "paliers.csv", columns=["load=m2 [kg]"], rest_length="200 mm")
    force = np.asarray(found.to_frame().filter(like="force"))
    assert force.max() == pytest.approx(6.0 * GRAVITY)


def test_a_mass_has_a_unit_of_mass() -> None:
    with pytest.raises(InputError, match="'N' is not a unit of mass"):
        spoken_correction(columns=["mass=m2 [N]"])
    with pytest.raises(InputError, match="has no unit"):
        read_measurement(discs("m2"), "paliers.csv", spoken_correction(columns=["load=m2"]))


def scope(
    line: str,
    columns: Sequence[str] = SCOPE_COLUMNS,
    head: str = "Time (s),CH1 pressure (V),CH2 force (V),CH3 valve (V)",
) -> Measurement:
    rows = [f"{0.02 * n:.2f},{volts:.6f},{volts / 2:.6f},0.01" for n, volts in enumerate(VOLTS)]
    text = "\n".join(["Model,TDS2024C", line, head, *rows])
    correction = spoken_correction(columns=columns, ignore=["CH3 valve (V)"])
    return read_measurement(text.encode(), "blocked_L450mm.csv", correction)


@pytest.mark.parametrize(
    ("line", "zero"),
    [
        ("Calibration,CH1: 0.5 bar/V (0 V = 0 bar gauge),CH2: 400 N/V (0 V = 0 N)", 0.0),
        ("Calibration,CH1 50 kPa/V,CH2 0.4 kN/V", 0.0),
        ("Scale,pressure 0.5 bar/V,force 400 N/V", 0.0),
        ("pressure: 0.5 bar per volt, force: 400 N per volt", 0.0),
        ("CH1: 1 V = 0.5 bar\nCH2: 1 V = 400 N", 0.0),
        ("CH1: 0.5 bar/V (U - 1 V)\nCH2: 400 N/V", 1.0),
        ("CH1: 0.5 bar/V * (U + 0.25 V), CH2: 400 N/V", -0.25),
        ("CH1: 0.5 bar/V (1 V = 0 bar)\nCH2: 400 N/V", 1.0),
    ],
)
@pytest.mark.parametrize("columns", [SCOPE_COLUMNS, ()])
def test_volts_are_converted_by_the_line_that_names_their_channel(
    line: str, zero: float, columns: Sequence[str]
) -> None:
    found = scope(line, columns)
    np.testing.assert_allclose(found.columns["pressure"], 0.5e5 * (VOLTS - zero), rtol=1e-4, atol=1.0)
    np.testing.assert_allclose(found.columns["force"], 200.0 * VOLTS, rtol=1e-4)
    assert any("'CH1 pressure (V)' is scaled: " in m and "(line 2)" in m for m in found.messages)


@pytest.mark.parametrize("columns", [SCOPE_COLUMNS, ()])
def test_volts_without_a_calibration_are_asked_for(columns: Sequence[str]) -> None:
    with pytest.raises(InputError, match=r"is a signal in V.*CH1 pressure \[0 to 10 V = 0 to 10 bar\]"):
        scope("Remark,none", columns)


@pytest.mark.parametrize(
    ("head", "brackets"),
    [
        ("Time (s),CH1 pressure (V),CH2 force (V),CH3 valve (V)", "[]"),
        ("Time [s],CH1 pressure [V],CH2 force [V],CH3 valve [V]", "()"),
        ("Time,CH1 pressure,CH2 force,CH3 valve\ns,V,V,V", "()"),
        ("Time,CH1 pressure,CH2 force,CH3 valve\ns,V,V,V", "[]"),
    ],
)
def test_a_name_is_accepted_with_its_unit_as_it_stands_in_the_file(head: str, brackets: str) -> None:
    columns = [column.replace("(", brackets[0]).replace(")", brackets[1]) for column in SCOPE_COLUMNS]
    found = scope("Scale,CH1: 0.5 bar/V,CH2: 400 N/V", columns, head)
    np.testing.assert_allclose(found.columns["pressure"], 0.5e5 * VOLTS, rtol=1e-4)
    assert [reason for name, reason in found.unread if "valve" in name] == ["you do not want it"]


def test_a_name_that_is_not_in_the_file_is_refused() -> None:
    with pytest.raises(InputError, match=r"no column 'CH4 force \(V\)'"):
        scope("Scale,CH1: 0.5 bar/V,CH2: 400 N/V", ["force=CH4 force (V)"])


LOGGER_HEAD = [
    "Arduino serial log",
    "// columns: millis ; abs pressure kPa ; length mm ; valve command -100..100 %",
    "init... ok",
]


def logger(head: str, ignore: Sequence[str] = ()) -> Measurement:
    pressures = 200.0 + 100.0 * np.sin(np.linspace(0.0, 9.0, 80)) ** 2
    rows = [f"{49224 + 5 * n};{p:.2f};{190 - 0.1 * p:.2f};{n % 7}" for n, p in enumerate(pressures)]
    text = "\n".join([*LOGGER_HEAD, *([head] if head else []), *rows])
    correction = spoken_correction(ignore=ignore, rest_length="220 mm", load="6 kg")
    return read_measurement(text.encode(), "log.txt", correction)


def test_the_names_right_above_the_rows_win_over_a_comment() -> None:
    found = logger("ms;p_abs_kPa;len_mm;valve_pct", ["valve_pct"])
    assert found.kind == "transient"
    assert "command" not in found.columns
    assert ("valve_pct", "you do not want it") in found.unread
    np.testing.assert_allclose(np.diff(found.columns["time"]), 0.005)
    assert found.columns["pressure"][0] == pytest.approx(200e3 - 101325.0)
    assert found.columns["length"][0] == pytest.approx(0.170)


@pytest.mark.parametrize("head", ["", "a;b;c;d"])
def test_a_comment_names_columns_where_the_row_above_says_less(head: str) -> None:
    found = logger(head, ["valve command -100..100 %"])
    assert found.columns["length"][0] == pytest.approx(0.170)
    assert "command" not in found.columns


@pytest.mark.parametrize(("head", "step"), [("ms", 5e-3), ("millis()", 5e-3), ("micros", 5e-6)])
def test_ticks_without_another_name_are_the_time(head: str, step: float) -> None:
    rows = [f"{5 * n},{100 + n},{200 - 0.5 * n}" for n in range(40)]
    text = "\n".join([f"{head},p_kPa,length_mm", *rows])
    found = read_measurement(text.encode(), "a.csv")
    np.testing.assert_allclose(np.diff(found.columns["time"]), step)
    assert any(f"'{head}' is read as time by its unit" in m for m in found.messages)


def test_a_staircase_by_hand_with_times_of_the_day_is_not_asked_for_their_unit() -> None:
    """Fifty readings a minute apart, 14h02: as seconds they are long, but nobody writes milliseconds so."""
    minutes = range(2, 52)
    rows = [
        f"14h{minute:02d};{1.0 + 0.1 * (minute % 30):.1f};{400.0 - 1.2 * (minute % 30):.1f};20"
        for minute in minutes
    ]
    head = "Heure;Pression [bar];Longueur [mm];Masse [kg]"
    measurement = read_measurement("\n".join([head, *rows]).encode(), "paliers.csv")
    assert measurement.columns["time"].tolist() == [60.0 * (minute - 2) for minute in minutes]
