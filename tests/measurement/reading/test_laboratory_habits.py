"""Files of other laboratories: their languages, lists of columns, signs, maps, loads, gaps and valves."""

from __future__ import annotations

import io
import json
from collections.abc import Sequence

import h5py
import numpy as np
import pytest

from mckibben.measurement.measurement import Measurement
from mckibben.measurement.reading import read_measurement
from tests.measurement.reading.muscle_test import isobaric

R = isobaric(2e5, 3e5, 4e5)
BAR, MM = R.pressure / 1e5, R.stroke * 1e3
ROWS = len(R.time)
PRESSURE = np.tile(np.concatenate([np.linspace(0.5, 6.0, 20), np.linspace(6.0, 0.5, 20)]), 3)  # bar
MASS = np.repeat([2.0, 5.0, 10.0], 40)  # kg
STROKE = np.maximum(0.0, PRESSURE * 10.0 - MASS * 2.0)  # mm
GRAVITY = 9.80665


def lines(separator: str, *columns: Sequence[float] | Sequence[str] | np.ndarray, decimal: str = ".") -> str:
    """Columns of numbers or words as rows."""
    rows = zip(*columns, strict=True)
    return "\n".join(
        separator.join(c if isinstance(c, str) else f"{c:.6f}".replace(".", decimal) for c in row)
        for row in rows
    )


def read(text: str | bytes, name: str = "a.csv") -> Measurement:
    """The measurement in a text."""
    return read_measurement(text.encode() if isinstance(text, str) else text, name)


def assert_all(found: Measurement, *, rest: float | None = 0.25, rows: int = ROWS) -> None:
    """Every reading in SI, and the rest length."""
    assert found.rows == rows
    if rows == ROWS:
        np.testing.assert_allclose(found.columns["pressure"], R.pressure, atol=2.0)
        np.testing.assert_allclose(found.columns["force"], R.force, atol=1e-3)
        np.testing.assert_allclose(found.columns["displacement"], R.stroke, atol=1e-7)
    if rest is not None:
        assert found.conditions["nominal_length"] == pytest.approx(rest)


@pytest.mark.parametrize(
    ("above", "heads", "scale"),
    [
        ("Nyugalmi hossz: 250 mm", "Idő [s];Nyomás (túlnyomás) [bar];Erő [N];Rövidülés [mm]", 1.0),
        ("Lepopituus: 250 mm", "Aika (s);Paine (kPa);Voima (N);Lyhenemä (mm)", 100.0),
        ("Hvilelængde 250 mm", "Tid [s];Tryk [bar];Kraft [N];Forkortning [mm]", 1.0),
        ("Lungime de repaus = 250 mm", "Timp [s];Presiune relativă [MPa];Forță [N];Scurtare [mm]", 0.1),
        ("Μήκος ηρεμίας: 250 mm", "Χρόνος [s];Πίεση [bar];Δύναμη [N];Μετατόπιση [mm]", 1.0),
        ("Початкова довжина: 250 мм", "Час, с;Тиск надлишковий, бар;Зусилля, Н;Укорочення, мм", 1.0),
        ("자연길이: 250 mm", "시간(s);압력(kPa);힘(N);변위(mm)", 100.0),
        ("自然长度 250 mm", "时间/s;表压/MPa;拉力/N;收缩量/mm", 0.1),
        ("Početna duljina: 250 mm", "Vrijeme [s];Tlak (pretlak) [bar];Sila [N];Skraćenje [mm]", 1.0),
        ("自然長 250 mm", "時間(s);圧力(㎪);荷重(Ｎ);収縮量(㎜)", 100.0),
    ],
)
def test_languages(above: str, heads: str, scale: float) -> None:
    text = f"{above}\n\n{heads}\n" + lines(";", R.time, BAR * scale, R.force, MM, decimal=",")
    assert_all(read(text))


@pytest.mark.parametrize(
    "preamble",
    [
        "# Ruhelänge 250 mm\n# Spalte 1: Zeit in s, Spalte 2: Druck in bar, Spalte 3: Kraft in N, "
        "Spalte 4: Verkürzung in mm",
        "# Longueur au repos 250 mm\n# colonne 1 = temps (s)\n# colonne 2 = pression relative (bar)\n"
        "# colonne 3 = effort (N)\n# colonne 4 = raccourcissement (mm)",
        "% L0 = 250 mm\n% 1: time (s)\n% 2: pressure (bar)\n% 3: force (N)\n% 4: shortening (mm)",
        "# rest length 250 mm\n# Columns: time [s], pressure [bar], force [N], shortening [mm]",
        "# rest length 250 mm\n# $1 = time [s]; $2 = pressure [bar]; $3 = force [N]; $4 = shortening [mm]",
    ],
)
@pytest.mark.parametrize("separator", [" ", "\t"])
def test_columns_that_the_preamble_lists(preamble: str, separator: str) -> None:
    assert_all(read(f"{preamble}\n" + lines(separator, R.time, BAR, R.force, MM), "a.dat"))


def test_rows_with_names_in_front_and_a_shorter_head() -> None:
    head = '"t_s" "p_bar" "F_N" "x_mm" "sens"'
    ways = ['"gonflage"' if n % 24 < 12 else '"dégonflage"' for n in range(ROWS)]
    names = [f'"{n + 1}"' for n in range(ROWS)]
    found = read(f"{head}\n" + lines(" ", names, R.time, BAR, R.force, MM, ways), "a.txt")
    assert_all(found, rest=None)
    np.testing.assert_array_equal(found.columns["direction"], [-1.0 if "dé" not in w else 1.0 for w in ways])


@pytest.mark.parametrize(
    ("there", "back"),
    [
        ("inflating", "deflating"), ("Druckaufbau", "Druckabbau"), ("加圧", "減圧"), ("plnění", "vypouštění"),
        ("llenado", "vaciado"), ("Fill ramp", "vent ramp"),
    ],
)  # fmt: skip
def test_words_for_filling_and_exhausting(there: str, back: str) -> None:
    ways = [there if n % 24 < 12 else back for n in range(ROWS)]
    found = read("t [s];p [bar];F [N];x [mm];phase\n" + lines(";", R.time, BAR, R.force, MM, ways))
    assert found.columns["direction"].tolist() == [-1.0 if way == there else 1.0 for way in ways]


def test_loading_is_what_the_stroke_shows() -> None:
    ways = np.where(np.diff(R.stroke, prepend=-1.0) > 0.0, "entlasten", "belasten")
    found = read(
        "t [s];p [bar];F [N];x [mm];Richtung\n" + lines(";", R.time, BAR, R.force, MM, ways.tolist())
    )
    np.testing.assert_array_equal(found.columns["direction"], np.where(ways == "entlasten", -1.0, 1.0))


def test_a_word_that_is_not_known_gives_no_direction() -> None:
    found = read("t [s];p [bar];F [N];x [mm];phase\n" + lines(";", R.time, BAR, R.force, MM, ["xyz"] * ROWS))
    assert "direction" not in found.columns
    assert any("'phase' is not used" in message for message in found.messages)


@pytest.mark.parametrize("gap", ["NA", "NaN", "-", "---", "", "Err", "OL", "#N/A"])
def test_a_gap_in_a_column_that_is_not_needed_costs_no_row(gap: str) -> None:
    warm = [gap if n % 7 == 0 else "22.5" for n in range(ROWS)]
    for heads in (
        "t [s],p [bar],F [N],x [mm],T [°C]",
        "time_s,pressure_bar,force_N,stroke_mm,temperature_degC",
    ):
        found = read(f"{heads}\n" + lines(",", R.time, BAR, R.force, MM, warm))
        assert_all(found, rest=None)
        assert "temperature" not in found.columns
        assert any("is not used: it holds no number in 10 rows" in message for message in found.messages)


def test_a_gap_in_a_column_that_is_needed_costs_its_row() -> None:
    force = ["---" if n in (5, 9) else f"{value:.4f}" for n, value in enumerate(R.force)]
    warm = ["OL" if n % 7 == 0 else "22.5" for n in range(ROWS)]
    found = read("t [s],p [bar],F [N],x [mm],T [°C]\n" + lines(",", R.time, BAR, force, MM, warm))
    assert found.rows == ROWS - 2
    assert found.skipped == {"no reading": 2}


@pytest.mark.parametrize(
    ("title", "heads", "kind", "channel", "values"),
    [
        ("Fuerza isométrica F [N]", "Presión [bar];κ = 0 %;κ = 5 %;κ = 10 %", "isometric", "contraction",
         [0.0, 0.05, 0.1]),
        ("Static force (N)", "Pressure (bar);300 mm;285 mm;270 mm", "static", "length", [0.27, 0.285, 0.3]),
        ("Hub s [mm]", "Druck [bar];m = 2 kg;m = 5 kg;m = 10 kg", "isotonic", "force",
         [2 * GRAVITY, 5 * GRAVITY, 10 * GRAVITY]),
    ],
)  # fmt: skip
def test_values_across_in_the_heads(
    title: str, heads: str, kind: str, channel: str, values: list[float]
) -> None:
    pressure = np.arange(0.5, 6.1, 0.5)
    cells = [pressure * slope for slope in (30.0, 20.0, 10.0)]
    found = read(f"{title}\n\n{heads}\n" + lines(";", pressure, *cells))
    assert (found.kind, found.rows) == (kind, 3 * len(pressure))
    np.testing.assert_allclose(np.unique(found.columns[channel]), values, rtol=1e-6)
    value = "displacement" if channel == "force" else "force"
    unit = 1e-3 if value == "displacement" else 1.0
    np.testing.assert_allclose(
        np.sort(found.columns[value]), np.sort(np.concatenate(cells)) * unit, rtol=1e-5
    )


def test_a_head_that_is_a_value_is_no_channel() -> None:
    found = read("p [bar];L = 280 mm;F [N];x [mm]\n" + lines(";", BAR, R.time, R.force, MM))
    assert "length" not in found.columns
    assert any("'L = 280 mm' is not used: it is the name of a value" in message for message in found.messages)


@pytest.mark.parametrize("head", ["Hanging mass [kg]", "Masse [kg]", "load_mass_kg", "Teret [kg]"])
def test_a_load_that_changes_is_the_force(head: str) -> None:
    found = read(f"L0: 250 mm\nPressure [bar],Stroke [mm],{head}\n" + lines(",", PRESSURE, STROKE, MASS))
    assert found.kind == "isotonic"
    np.testing.assert_allclose(found.columns["force"], MASS * GRAVITY, rtol=1e-6)


@pytest.mark.parametrize("title", ["# mass = {:g} kg", "# Last: {:g} kg", "# charge {:g} kg"])
@pytest.mark.parametrize("repeated", [True, False])
def test_a_load_for_each_block(title: str, repeated: bool) -> None:
    text = "# L0 = 250 mm\n" + ("" if repeated else "pressure [bar];stroke [mm]\n")
    for block in range(3):
        part = slice(40 * block, 40 * block + 40)
        text += f"\n{title.format(MASS[part][0])}\n" + ("pressure [bar];stroke [mm]\n" if repeated else "")
        text += lines(";", PRESSURE[part], STROKE[part]) + "\n"
    found = read(text)
    assert found.kind == "isotonic"
    np.testing.assert_allclose(found.columns["force"], MASS * GRAVITY, rtol=1e-6)


def test_a_load_for_each_run_of_a_container() -> None:
    data = io.BytesIO()
    with h5py.File(data, "w") as file:
        file.attrs["rest_length_mm"] = 250.0
        for run in range(3):
            part = slice(40 * run, 40 * run + 40)
            group = file.create_group(f"run_{run}")
            group.attrs["mass_kg"] = MASS[part][0]
            for name, values, unit in (("pressure", PRESSURE, "bar"), ("shortening", STROKE, "mm")):
                group.create_dataset(name, data=values[part]).attrs["units"] = unit
    found = read(data.getvalue(), "a.h5")
    np.testing.assert_allclose(found.columns["force"], MASS * GRAVITY, rtol=1e-6)
    assert "load_mass" not in found.conditions


def test_signs_that_the_file_says_are_turned() -> None:
    above = "Ruhelänge 250 mm\nVorzeichen: Zug negativ, Verlängerung positiv\n\n"
    found = read(above + "Zeit [s];Druck [bar];Kraft [N];Weg [mm]\n" + lines(";", R.time, BAR, -R.force, -MM))
    assert_all(found)
    assert sum("has its sign reversed: 'Vorzeichen: Zug" in message for message in found.messages) == 2


@pytest.mark.parametrize(
    "said",
    [
        "Válvula: 0 V = vaciado, 5 V = cerrada, 10 V = llenado",
        "valve MPYE: exhaust at 0 V, closed at 5 V, fill at 10 V",
        "Ventil: 5 V geschlossen, 10 V Belüften",
    ],
)
def test_a_valve_in_volts_with_its_states(said: str) -> None:
    time = np.arange(200) * 0.01
    volts = np.where(time < 0.2, 5.0, np.where(time < 1.0, 10.0, 0.0))
    pressure = np.where(
        time < 1.0, 6.0 * np.clip((time - 0.2) / 0.5, 0.0, 1.0), 6.0 * np.exp(-(time - 1.0) / 0.2)
    )
    above = f"{said}\nload 8 kg, supply 6 bar, L0 = 250 mm\n\n"
    text = above + "Time [s],Pressure [bar],Stroke [mm],Valve voltage [V]\n"
    found = read(text + lines(",", time, pressure, pressure * 8.0, volts))
    np.testing.assert_allclose(found.columns["command"], (volts - 5.0) / 5.0, atol=1e-9)
    assert found.conditions["load_mass"] == 8.0
    assert found.conditions["supply_pressure"] == pytest.approx(6e5)


def test_a_valve_whose_states_do_not_lie_on_a_line_is_not_read() -> None:
    above = "valve: exhaust at 0 V, closed at 2 V, fill at 10 V\n\n"
    found = read(above + "t [s],p [bar],x [mm],valve [V]\n" + lines(",", R.time, BAR, MM, BAR))
    assert "command" not in found.columns


def test_marks_beside_the_values_of_a_tall_table() -> None:
    text = '"Name";"Zeit";"Wert";"Gültig";"Nr"\n'
    number = 0
    for n in range(ROWS):
        stamp = f"2024-03-01 10:00:{n // 10:02d}.{n % 10}00"
        for name, value in (("Druck_bar", BAR[n]), ("Kraft_N", R.force[n]), ("Weg_mm", MM[n])):
            number += 1
            text += f'"{name}";"{stamp}";{value:.6f};1;{number}\n'
    found = read(text)
    assert_all(found, rest=None)
    np.testing.assert_allclose(found.columns["time"], np.arange(ROWS) * 0.1, atol=1e-6)


def test_a_json_name_with_unit_and_reference_in_brackets() -> None:
    document = {
        "sample": {"rest_length": {"value": 250, "unit": "mm", "note": "no pressure"}},
        "channels": [
            {"name": "time", "unit": "s", "values": R.time.tolist()},
            {"name": "muscle pressure [kPa] (gauge)", "unit": "kPa", "values": (BAR * 100.0).tolist()},
            {"name": "force", "unit": "N", "values": R.force.tolist()},
            {"name": "shortening", "unit": "mm", "values": MM.tolist()},
        ],
    }
    assert_all(read(json.dumps(document), "a.json"))


@pytest.mark.parametrize("stamped", [True, False])
def test_many_lines_of_json_are_read_as_few_are(stamped: bool) -> None:
    count = 6000
    times = [
        f"2024-03-01T10:{n // 600:02d}:{n % 600 / 10:06.3f}Z" if stamped else n / 10 for n in range(count)
    ]
    records = [
        {
            "time" if stamped else "time_s": times[n],
            "pressure_bar": 2.0 + n % 50 / 25.0, "force_N": 100.0 + n % 50, "length_mm": 250.0 - n % 50 / 2.0,
        }
        for n in range(count)
    ]  # fmt: skip
    meta = json.dumps({"rest_length_mm": 250})

    def written(rows: list[dict[str, object]]) -> Measurement:
        return read("\n".join([meta, *map(json.dumps, rows)]), "a.jsonl")

    many, few = written(records), written(records[:400])
    assert many.rows == count
    assert many.conditions["nominal_length"] == few.conditions["nominal_length"] == 0.25
    for channel in ("time", "pressure", "force", "length"):
        np.testing.assert_allclose(many.columns[channel][:400], few.columns[channel], rtol=1e-12, atol=1e-12)
