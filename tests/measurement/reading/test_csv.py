"""Every way a measurement file may be written, every way it may be wrong, and the reference files."""

import hashlib
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mckibben.measurement.measurement import Measurement, lengths
from mckibben.measurement.reading import preview, read_measurement
from mckibben.physics.errors import InputError

DATA = Path(__file__).parents[4] / "shared" / "data"

#: Two rows of one isobaric table; every variant below must give exactly these numbers.
PRESSURE, LENGTH, FORCE = [1e5, 2.5e5], [0.3, 0.2505], [10.0, -1.5]
BASE = "pressure_bar,length_mm,force_N\n1,300,10\n2.5,250.5,-1.5\n"


def read(text, name="a.csv") -> Measurement:
    return read_measurement(text if isinstance(text, bytes) else text.encode(), name)


def refused(text, name="a.csv") -> InputError:
    with pytest.raises(InputError) as caught:
        read(text, name)
    error = caught.value
    assert error.message.startswith(f"{name}"), error.message
    assert error.field
    assert error.hint
    return error


VARIANTS = {
    "plain": BASE,
    "bom": "\ufeff" + BASE,
    "utf-16": BASE.encode("utf-16"),
    "utf-16 without mark": BASE.encode("utf-16-le"),
    "utf-16, other end": b"\xfe\xff" + BASE.encode("utf-16-be"),
    "crlf": BASE.replace("\n", "\r\n"),
    "old mac": BASE.replace("\n", "\r"),
    "no last line end": BASE.rstrip(),
    "empty lines": "\n\n" + BASE.replace("\n", "\n\n") + "\n\n",
    "empty spreadsheet rows": BASE + ",,\n,,\n , ,\n",
    "semicolon": BASE.replace(",", ";"),
    "tab": BASE.replace(",", "\t"),
    "decimal comma": BASE.replace(",", ";").replace(".", ","),
    "decimal comma, tab": BASE.replace(",", "\t").replace(".", ","),
    "decimal comma, quoted": 'pressure_bar,length_mm,force_N\n1,300,10\n"2,5","250,5","-1,5"\n',
    "quotes": '"pressure_bar","length_mm","force_N"\n"1","300","10"\n2.5,250.5,-1.5\n',
    "blanks": "pressure_bar , length_mm, force_N\n 1 , 300,\t10\n2.5,250.5 , -1.5\n",
    "exponents": "pressure_Pa,length_m,force_kN\n1e5,3E-1,.01\n+2.5e+05,0.2505,-1.5e-3\n",
    "spreadsheet hint": "sep=;\n" + BASE.replace(",", ";"),
    "comments": "# a plain comment\n#\n#: :\n" + BASE,
    "square brackets": "pressure [bar],length [mm],force [N]\n1,300,10\n2.5,250.5,-1.5\n",
    "round brackets": "Pressure (bar),LENGTH(mm),Force (N)\n1,300,10\n2.5,250.5,-1.5\n",
    "bare": "pressure,length,force\n1e5,0.3,10\n2.5e5,0.2505,-1.5\n",
    "letters": "p_kPa,L [cm],F (N)\n100,30,10\n250,25.05,-1.5\n",
    "small letters": "P [MPa],l_mm,f_N\n0.1,300,10\n0.25,250.5,-1.5\n",
    "load": "pressure bar,length mm,load_N\n1,300,10\n2.5,250.5,-1.5\n",
    "extra words": "muscle_pressure_bar,measured length [mm],force_mean_N\n1,300,10\n2.5,250.5,-1.5\n",
    "gauge": "pressure_barg,length_mm,force_N\n1,300,10\n2.5,250.5,-1.5\n",
    "gauge words": "pressure_gauge [bar (g)],length_mm,force_N\n1,300,10\n2.5,250.5,-1.5\n",
    "unknown columns": "note,p_bar,supply_pressure_bar,L_mm,F_N,\nx,1,7,300,10,\n,2.5,7,250.5,-1.5,\n",
    "other order": "force_N,length_mm,pressure_bar\n10,300,1\n-1.5,250.5,2.5\n",
}


@pytest.mark.parametrize("variant", VARIANTS)
def test_variants_give_the_same(variant):
    result = read(VARIANTS[variant])
    np.testing.assert_allclose(result.columns["pressure"], PRESSURE, rtol=1e-14)
    np.testing.assert_allclose(result.columns["length"], LENGTH, rtol=1e-14)
    np.testing.assert_allclose(result.columns["force"], FORCE, rtol=1e-14)
    assert (result.name, result.rows) == ("a.csv", 2)


ABSOLUTE = {
    "name": "pressure_abs_bar",
    "word": "absolute pressure [bar]",
    "bara": "pressure [bara]",
    "bar(a)": "pressure (bar(a))",
    "bar(a) bare": "pressure_bar(a)",
    "bar abs": "p [bar abs]",
    "brackets": "pressure_bar (absolute)",
    "bar_abs": "pressure_bar_abs",
}


@pytest.mark.parametrize("variant", ABSOLUTE)
def test_absolute_pressure(variant):
    result = read(f"{ABSOLUTE[variant]},length_mm,force_N\n1.01325,300,1\n2,290,2\n")
    np.testing.assert_allclose(result.columns["pressure"], [0.0, 98675.0], atol=1e-9)
    assert any("is absolute pressure: 101325 Pa subtracted" in m for m in result.messages)


def test_absolute_by_comment_and_header_before_comment():
    result = read("# pressure: absolute\n" + BASE)
    np.testing.assert_allclose(result.columns["pressure"], [-1325.0, 148675.0])
    result = read("# pressure: absolute\n" + BASE.replace("_bar", "_barg"))
    np.testing.assert_allclose(result.columns["pressure"], PRESSURE)
    result = read("# pressure: gauge\n" + BASE)
    assert not any("read as gauge" in m for m in result.messages)
    assert "column 'pressure_bar' read as gauge pressure" in read(BASE).messages


#: header -> (channel, value in SI of the cell "0.5").
HEADERS = {
    "time_s": ("time", 0.5),
    "t [ms]": ("time", 5e-4),
    "t": ("time", 0.5),
    "T_s": ("time", 0.5),
    "Time (min)": ("time", 30.0),
    "T": ("temperature", 273.65),
    "T_degC": ("temperature", 273.65),
    "t [°C]": ("temperature", 273.65),
    "temperature_C": ("temperature", 273.65),
    "Temperature [K]": ("temperature", 0.5),
    "pressure_mbar": ("pressure", 50.0),
    "p": ("pressure", 0.5),
    "PRESSURE [psi]": ("pressure", 3447.3786465),
    "PRESSURE_KPA": ("pressure", 500.0),
    "TIME_S": ("time", 0.5),
    "STROKE_MM": ("displacement", 5e-4),
    "F": ("force", 0.5),
    "force_lbf": ("force", 2.22411080763),
    "load_kN": ("force", 500.0),
    "L": ("length", 0.5),
    "length_in": ("length", 0.0127),
    "muscle_length_cm": ("length", 0.005),
    "kappa": ("contraction", 0.5),
    "strain_%": ("contraction", 0.005),
    "contraction [pct]": ("contraction", 0.005),
    "contraction (1)": ("contraction", 0.5),
    "contraction [-]": ("contraction", 0.5),
    "κ_%": ("contraction", 0.005),
    "stroke_pct": ("contraction", 0.005),
    "contraction_mm": ("displacement", 5e-4),
    "displacement_mm": ("displacement", 5e-4),
    "x": ("displacement", 0.5),
    "position [m]": ("displacement", 0.5),
    "Stroke (mm)": ("displacement", 5e-4),
    "x_µm": ("displacement", 5e-7),
    "D_mm": ("diameter", 5e-4),
    "diameter": ("diameter", 0.5),
    "v [m/s]": ("velocity", 0.5),
    "velocity_mm/s": ("velocity", 5e-4),
    "u": ("command", 0.5),
    "command_%": ("command", 0.005),
    "valve": ("command", 0.5),
    "valve_command": ("command", 0.5),
}


@pytest.mark.parametrize("header", HEADERS)
def test_header(header):
    channel, value = HEADERS[header]
    others = {"time": "pressure_bar;length_mm", "pressure": "time_s;length_mm"}.get(
        channel, "time_s;pressure_bar"
    )
    result = read(f"{others};{header}\n1;1;0.5\n2;2;0.5\n")
    np.testing.assert_allclose(result.columns[channel], [value, value], rtol=1e-9)
    assert header in [c.column for c in result.channels]


@pytest.mark.parametrize(
    "header",
    [
        "inside_diameter_mm",
        "contraction_vs_longest_pct",
        "pressure_set_bar",
        "note",
        "length_0_mm",
        "load cell [mV]",
        "",
        "V_ml",
        "p_W",
        "x" * 300,
        "πressure",
    ],
)
def test_other_columns_are_ignored_and_listed(header):
    result = read(f"pressure_bar\tlength_mm\t{header}\n1\t300\tx\n2\t290\t5\n")
    assert result.ignored == (header or "column 3",)
    assert list(result.columns) == ["pressure", "length", "group"]


def test_a_column_of_one_supply_is_the_supply():
    result = read("pressure_bar\tlength_mm\tsupply_pressure_bar\n1\t300\t5\n2\t290\t5\n")
    assert (result.conditions["supply_pressure"], result.ignored) == (5e5, ())


def test_a_voltage_is_no_channel():
    result = read("pressure_sensor_V,valve_command_V,pressure_bar,length_mm\n1,5,1,300\n2,5,2,290\n")
    assert result.ignored == ("pressure_sensor_V", "valve_command_V")
    assert "column 'pressure_sensor_V' is not used: 'V' is a voltage, not a pressure" in result.messages
    assert "column 'valve_command_V' is not used: 'V' is a voltage, not a command" in result.messages


@pytest.mark.parametrize(
    ("first", "second", "winner", "why"),
    [
        (
            "pressure_bar_as_given_clipped", "pressure_bar_unclipped_0.9V-1", "second",
            "it is clipped, or a mark of slack",
        ),
        ("pressure_bar_filtered", "pressure_bar", "second", None),
        ("p_bar", "pressure_kPa", "second", None),
        ("pressure_bar", "pressure_kPa", "first", None),
        ("pressure_bar", "pressure_raw_bar", "first", "it is a raw signal"),
    ],
)  # fmt: skip
def test_the_plainer_of_two_columns_wins(first, second, winner, why):
    result = read(f"{first},{second},length_mm\n1,2,300\n3,4,290\n")
    used, other = (first, second) if winner == "first" else (second, first)
    assert result.channels[0].column == used
    assert result.ignored == (other,)
    why = why or f"pressure is read from '{used}'"
    assert f"column '{other}' is not used: {why}" in result.messages


def test_bare_contraction_and_temperature():
    result = read("pressure_bar,contraction,T\n1,0,20\n2,25,21\n")
    np.testing.assert_allclose(result.columns["contraction"], [0.0, 0.25])
    np.testing.assert_allclose(result.columns["temperature"], [293.15, 294.15])
    assert "column 'contraction' has no unit: read as %" in result.messages
    assert "column 'T' has no unit: read as degC" in result.messages
    result = read("pressure_bar,contraction,T\n1,0,293.15\n2,0.25,294.15\n")
    np.testing.assert_allclose(result.columns["contraction"], [0.0, 0.25])
    np.testing.assert_allclose(result.columns["temperature"], [293.15, 294.15])
    assert "column 'contraction' has no unit: read as 1" in result.messages


def test_command_must_be_a_share():
    result = read("time_s,command,pressure_bar\n0,1,1\n1,-1,2\n")
    np.testing.assert_array_equal(result.columns["command"], [1.0, -1.0])
    result = read("time_s,command,pressure_bar\n0,1,1\n1,10,2\n")
    assert "command" not in result.columns
    assert result.ignored == ("command",)


@pytest.mark.parametrize(
    ("header", "newton"), [("load_kg", 19.6133), ("weight [g]", 19.6133e-3), ("force_lb", 8.8964)]
)
def test_a_weight_may_be_given_as_a_mass(header, newton):
    result = read(f"pressure_bar,length_mm,{header}\n1,300,2\n2,290,2\n")
    assert result.columns["force"] == pytest.approx(newton, rel=1e-4)
    if header != "force_lb":  # which is a force in pounds
        assert f"column '{header}' is a mass: its weight is the force" in result.messages


def test_a_pressure_that_is_none_is_asked_about():
    result = read("pressure_Pa,length_mm,force_N\n1,300,500\n6,290,3000\n")
    assert "the pressure reaches only 6 Pa: check its unit" in result.messages


@pytest.mark.parametrize(
    ("shorter", "longer"),
    [
        ("up", "down"),
        ("P", "N"),
        ("P", "D"),
        ("filling", "venting"),
        ("Filling", "VENTING"),
        ("-1", "+1"),
        ("-1.0", "1"),
    ],
)
def test_direction_words(shorter, longer):
    result = read(f"pressure_bar,length_mm,direction\n1,300,{shorter}\n2,290,{longer}\n1,300, {shorter}\n")
    np.testing.assert_array_equal(result.columns["direction"], [-1.0, 1.0, -1.0])
    assert any(m.startswith("direction read: ") for m in result.messages)


@pytest.mark.parametrize(
    ("header", "loaded", "direction"),
    [
        ("length_mm", (250, 260, 270), 1.0),  # a weight pulls: longer
        ("length_mm", (270, 260, 250), -1.0),
        ("contraction_pct", (0, 5, 10), -1.0),
        ("displacement_mm", (10, 5, 0), 1.0),
    ],
)
def test_load_and_unload_follow_the_stroke(header, loaded, direction):
    rows = [f"3,{x},load" for x in loaded] + [f"3,{x},unload" for x in reversed(loaded)]
    result = read(f"pressure_bar,{header},direction\n" + "\n".join(rows))
    np.testing.assert_array_equal(result.columns["direction"], [direction] * 3 + [-direction] * 3)


def test_load_at_held_length_is_rising_pressure():
    result = read("pressure_bar,length_mm,direction\n1,300,load\n2,300,load\n1,300,unload\n")
    np.testing.assert_array_equal(result.columns["direction"], [-1.0, -1.0, 1.0])


def test_unknown_directions():
    result = read("pressure_bar,length_mm,direction\n1,300,unknown\n2,290,0\n1,300,\n")
    np.testing.assert_array_equal(result.columns["direction"], [0.0, 0.0, 0.0])
    result = read("pressure_bar,length_mm,direction\n1,300,north\n2,290,south\n")
    assert result.ignored == ("direction",)


@pytest.mark.parametrize("header", ["group", "run", "Cycle", "sweep", "run_no"])
def test_groups(header):
    assert read(f"pressure_bar,length_mm,{header}\n1,3,4\n2,2,4\n1,3,7\n").columns["group"].tolist() == [
        4,
        4,
        7,
    ]
    assert read(f"pressure_bar,length_mm,{header}\n1,3,b\n2,2,b\n1,3,a\n").columns["group"].tolist() == [
        0,
        0,
        1,
    ]


@pytest.mark.parametrize("header", ["force_clipped_zero", "slack", "clipped"])
def test_marked_slack(header):
    text = f"pressure_bar,length_mm,force_N,{header}\n1,300,0,1\n2,290,5,0\n3,280,6,1\n"
    assert read(text).slack.tolist() == [True, False, True]
    result = read(text.replace(",1\n", ",7\n"))
    assert result.ignored == (header,)
    assert not result.slack.any()


def test_exact_zeros_are_slack():
    text = "pressure_bar,length_mm,force_N\n1,300,0\n2,290,{}\n3,280,6\n"
    assert read(text.format("0")).slack.tolist() == [True, True, False]
    assert read(text.format("0.01")).slack.tolist() == [False, False, False]


def test_conditions():
    result = read(
        "# kind: Isometric\n# muscle: DMSP-20\n# load_mass: 12 kg\n# load force: 60 N\n"
        "# Supply_Pressure: 6 bar;;\n"
        '# sample: DMSP-20-300\n"# nominal_length: 0,3 m"\n# temperature: 20 °C\n# a note: at 12:30\n' + BASE
    )
    assert (result.kind, result.kind_detected) == ("isometric", False)
    conditions = dict(result.conditions)
    assert conditions.pop("temperature") == pytest.approx(293.15)
    assert conditions == {
        "muscle": "DMSP-20",
        "load_mass": 12.0,
        "load_force": 60.0,
        "supply_pressure": 6e5,
        "sample": "DMSP-20-300",
        "nominal_length": 0.3,
        "a_note": "at 12:30",
    }
    result = read("# load_mass: 12\n# supply_pressure: 7 bar abs\n" + BASE)
    assert result.conditions["load_mass"] == 12.0
    assert "load_mass: no unit given, read as 12 kg" in result.messages
    assert result.conditions["supply_pressure"] == 7e5 - 101325.0


def test_muscle_column_names_the_sample():
    text = "muscle,pressure_bar,length_mm\n{},1,300\nB,2,290\n"
    assert read(text.format("B")).conditions["sample"] == "B"
    assert read("# sample: C\n" + text.format("B")).conditions["sample"] == "C"
    with pytest.raises(InputError, match="names 2 specimens, 'A', 'B'"):
        read(text.format("A"))


def test_latin1_header():
    result = read("pressure_bar,length_mm,T [°C]\n1,300,20\n2,290,21\n".encode("latin-1"))
    np.testing.assert_allclose(result.columns["temperature"], [293.15, 294.15])
    assert "the file is not UTF-8: read as Latin-1" in result.messages


def test_id_is_the_hash_of_the_bytes():
    assert read(BASE).id == hashlib.sha256(BASE.encode()).hexdigest()


ERRORS = {
    "no bytes": ("", "a.csv, row 1: the file is empty"),
    "blank": (" \n\n", "a.csv, row 1: the file is empty"),
    "bom only": ("\ufeff", "a.csv, row 1: the file is empty"),
    "comments only": ("# kind: static\n", "a.csv: no table: no rows of numbers"),
    "no columns": ('"",""\n1,2\n', "a.csv: the file has no heads: say what its columns are"),
    "separators only": (",,,\n,,\n", "a.csv: no table: no rows of numbers"),
    "header only": (
        "pressure_bar,length_mm\n",
        "a.csv, row 1: there are no rows of numbers below the header",
    ),
    "header and empty rows": (
        "pressure_bar,length_mm\n,\n\n",
        "a.csv, row 1: there are no rows of numbers below the header",
    ),
    "no channel": ("foo,bar\n1,2\n", "a.csv, row 1: no known channel among the columns 'foo', 'bar'"),
    "no header": ("1,2\n3,4\n", "a.csv: the file has no heads: say what its columns are"),
    "groups only": (
        "run,direction\n1,up\n",
        "a.csv, row 1: there are no rows of numbers below the header 'run, direction'; line 2 is '1; up'",
    ),
    "ragged short": (BASE + "3,4\n", "a.csv, row 4: 2 cells, the header has 3"),
    "ragged long": (BASE + "3,4,5,6\n", "a.csv, row 4: 4 cells, the header has 3"),
    "row numbers count comments": ("# a\n\n" + BASE + "3\n", "a.csv, row 6: 1 cell, the header has 3"),
    "comma as both": (BASE + "1,5,2,5,3,5\n", "a.csv, row 4: 6 cells, the header has 3"),
    "text": (BASE + "3,x,5\n", "a.csv, row 4, column 'length_mm': 'x' is not a number"),
    "unit in cell": (BASE + "3,300 mm,5\n", "a.csv, row 4, column 'length_mm': '300 mm' is not a number"),
    "python number": (BASE + "1_0,3,5\n", "a.csv, row 4, column 'pressure_bar': '1_0' is not a number"),
    "hexadecimal": (BASE + "0x1,3,5\n", "a.csv, row 4, column 'pressure_bar': '0x1' is not a number"),
    "arabic digits": (BASE + "٣,3,5\n", "a.csv, row 4, column 'pressure_bar': '٣' is not a number"),
    "true": (
        "pressure_bar,length_mm\nTrue,1\nTrue,1\n",
        "a.csv, row 1: there are no rows of numbers below the header 'pressure_bar, length_mm'; line 2 is",
    ),
    "empty cell": (BASE + 3 * "3,,5\n", "a.csv, row 4, column 'length_mm': the cell is empty"),
    "nan": (
        BASE + 3 * "3,4,NaN\n",
        "a.csv, row 4, column 'force_N': 'NaN' is not a finite number, and 3 rows",
    ),
    "inf": (
        BASE + 3 * "3,4,-inf\n",
        "a.csv, row 4, column 'force_N': '-inf' is not a finite number, and 3 rows",
    ),
    "too large": (BASE + "3,4,1e999\n", "a.csv, row 4, column 'force_N': '1e999' is too large"),
    "too large in SI": (
        "pressure_bar,length_mm,force_MN\n1,3,1e308\n",
        "a.csv, row 2, column 'force_MN': 1e+308 MN is too large",
    ),
    "thousands with the sign of the decimals": (
        "pressure_Pa;length_mm\n1,5;3\n1,000,000,5;3\n",
        "a.csv, row 3, column 'pressure_Pa': '1,000,000,5' is not a number",
    ),
    "mixed decimals": (
        "pressure_bar;length_mm\n1,5;300\n1.6;290\n",
        "a.csv, row 2, column 'pressure_bar': '1,5' has another decimal sign than the cells around it",
    ),
    "many": (
        "pressure_bar,length_mm\n" + "1,300\n" * 3000 + "x,1\n" * 3000,
        "a.csv, row 3002, column 'pressure_bar': 'x' is not a number (and 2999 more such rows)",
    ),
    "words": (
        "pressure_bar,force_N,length_mm\n1,20,300\n" + "x,1,290\n" * 3000,
        "a.csv: column 'pressure_bar' is called like the pressure and is not read: row 3 holds 'x'",
    ),
    "duplicate": (
        "pressure_bar,length_mm,force_N,Force_N\n"
        + "".join(f"{n},{300 - n},{n},{9 - n}\n" for n in range(9)),
        "a.csv: columns 'Force_N' and 'force_N' are both force and differ; which one acts",
    ),
    "dimension": (
        "pressure_bar,length_kg\n1,2\n",
        "a.csv: column 'length_kg': the unit 'kg' is a mass, a unit of length is needed",
    ),
    "unit": (
        "pressure [parsnip],length_mm\n1,2\n",
        "a.csv: column 'pressure [parsnip]': 'parsnip' is not a known unit",
    ),
    "vacuum": (
        "pressure_abs_bar,length_mm\n1,300\n-0.1,300\n-0.2,300\n",
        "a.csv, row 3, column 'pressure_abs_bar': -0.1 bar is a negative absolute pressure (and 1 more",
    ),
    "gauge vacuum": (
        "pressure_bar,length_mm\n-1.5,300\n",
        "a.csv, row 2, column 'pressure_bar': -1.5 bar is a negative absolute",
    ),
    "length": (
        "pressure_bar,length_mm\n1,300\n\n1,0\n",
        "a.csv, row 4, column 'length_mm': 0 mm is not a length",
    ),
    "diameter": ("pressure_bar,D_mm\n1,-3\n", "a.csv, row 2, column 'D_mm': -3 mm is not a diameter"),
    "contraction": (
        "pressure_bar,contraction_pct\n1,100\n",
        "a.csv, row 2, column 'contraction_pct': 100 % is not possible",
    ),
    "temperature": (
        "pressure_bar,L_mm,T_degC\n1,1,-300\n",
        "a.csv, row 2, column 'T_degC': -300 degC is not a temperature",
    ),
    "open quote": (
        'pressure_bar,length_mm\n1,300\n"2,290\n3,1\n',
        'a.csv, row 3: a quote (") is opened and never clos',
    ),
    "open quote in header": ('"pressure_bar,length_mm\n1,300\n', "a.csv, row 1: a quote"),
    "quote within": ('pressure_bar,length_mm\n"1"2,300\n', "a.csv, row 2: the quotes are wrong"),
    "nul": (BASE.encode() + b"1,\x002,3\n", "a.csv, row 4: the file holds NUL bytes"),
    "control": (BASE.encode() + b"1,\x022,3\n", "a.csv, row 4: the file holds control characters"),
    "damaged utf-16": (BASE.encode("utf-16")[:-1], "a.csv, row 3: the UTF-16 text is damaged"),
    "kind": ("# kind: isobar\n" + BASE, "a.csv: kind 'isobar' is not known"),
    "kind without force": (
        "# kind: isobaric\npressure_bar,length_mm\n1,2\n",
        "a.csv: a measurement of kind 'isobaric' needs a column force",
    ),
    "no kind": (
        "time_s,force_N\n1,2\n",
        "a.csv: no kind of measurement fits the columns time, force",
    ),
    "condition": (
        "# load_mass: 12 mm\n" + BASE,
        "a.csv, line 1, load_mass: '12 mm' is a length, a mass is needed",
    ),
    "negative condition": ("\n# load_mass: -3 kg\n" + BASE, "a.csv, line 2, load_mass: '-3 kg' is negative"),
}


@pytest.mark.parametrize("case", ERRORS)
def test_error(case):
    text, message = ERRORS[case]
    assert refused(text).message.startswith(message)


def test_errors_say_what_would_be_right():
    assert refused("presure,lenght\n1,2\n").hint == "Did you mean 'pressure'?"
    assert '--column "length=length [m]"' in refused("pressure_bar,length_kg\n1,2\n").message
    assert "with decimal commas ';' or tabs" in refused(BASE + "1,5,2,5,3,5\n").hint
    assert refused("# load_mass: 12 mm\n" + BASE).hint == "e.g. '12 kg'"
    error = refused(BASE + "3,x,5\n")
    assert error.field == "row 4, column length_mm"


def test_extensions():
    for name in ("a.csv", "A.CSV", "folder/a.txt"):
        assert read_measurement(BASE.encode(), name).rows == 2
    assert read_measurement(BASE.replace(",", "\t").encode(), "a.tsv").rows == 2
    for name in ("a", "a.dat", "a.xlsx"):  # the content counts, not the name
        assert read_measurement(BASE.encode(), name).rows == 2
    assert "the file is text, not an Excel workbook: read as CSV" in (
        read_measurement(BASE.encode(), "a.xlsx").messages
    )


# The fast and the careful way ------------------------------------------------------------------------------


# Any bytes -------------------------------------------------------------------------------------------------


def reads_or_refuses(data):
    try:
        result = read_measurement(data, "a.csv")
    except InputError as error:
        refusal = error
    else:
        refusal = None
    if refusal is not None:
        assert refusal.message.startswith("a.csv")
        assert refusal.field
        return
    assert isinstance(result, Measurement)
    for values in result.columns.values():
        assert len(values) == result.rows > 0
        assert np.isfinite(values).all()


def test_a_unit_of_another_quantity_names_file_and_row():
    with pytest.raises(InputError, match=r"^a\.csv: column 'pressure': the unit 'kg' is a mass"):
        read_measurement(b"pressure,length\nkg,mm\n1,300\n2,290\n", "a.csv")


@settings(deadline=None)
@given(st.binary(max_size=400))
def test_any_bytes(data):
    reads_or_refuses(data)


CELLS = st.one_of(
    st.sampled_from(
        ["1", "2.5", "-3", "0", "1e5", "", "nan", "x", '"', '"1"', "1,5", "1e308", "up", " ", "#", "９"]
    ),
    st.text(max_size=4),
    st.floats().map(repr),
)
WORDS = st.one_of(
    st.sampled_from(
        [*HEADERS, *ABSOLUTE.values(), "force_clipped", "slack", "run", "direction", "muscle", "", "L [[]"]
    ),
    st.text(max_size=12),
)


# The reference files ---------------------------------------------------------------------------------------


def reference(name) -> Measurement:
    path = DATA / name
    if not path.exists():
        pytest.skip(f"reference file {name} is not beside this checkout")
    return read_measurement(path.read_bytes(), name)


@pytest.mark.parametrize(
    ("name", "rows", "groups", "slack", "longest", "sample"),
    [
        ("DMSP-20-300_force_map.csv", 126, 21, 66, 0.296, "DMSP-20-300N"),
        ("DMSP-10-250_force_map.csv", 85, 17, 45, 0.25, "DMSP-10-250N"),
    ],
)
def test_force_maps(name, rows, groups, slack, longest, sample):
    result = reference(name)
    assert (result.kind, result.kind_detected) == ("static", True)
    assert (result.rows, result.groups, np.count_nonzero(result.slack)) == (rows, groups, slack)
    assert lengths(result, 1.0).max() == longest
    assert result.conditions["sample"] == sample
    assert result.ignored == ("contraction_vs_longest_pct",)
    assert (result.columns["force"][result.slack] == 0.0).all()


def test_catalogue_curves():
    result = reference("musclesim_curves.csv")
    assert (result.kind, result.rows) == ("isobaric", 254)
    assert result.ignored == ("inside_diameter_mm",)
    assert result.columns["contraction"].min() == pytest.approx(-0.05)
    assert np.count_nonzero(result.slack) == 3


def test_hysteresis():
    result = reference("static_hysteresis_0p10V_600ms.csv")
    assert (result.kind, result.rows, result.groups) == ("isotonic", 607, 3)
    assert result.columns["pressure"][0] == pytest.approx(-29260.0)
    assert result.columns["displacement"].max() == pytest.approx(0.039063)
    assert result.columns["direction"][0] == -1.0
    assert set(result.ignored) == {"valve_command_V", "pressure_sensor_V", "pressure_bar_as_given_clipped"}


def test_excitation():
    result = reference("excitation_100Hz_first638rows.csv")
    assert (result.kind, result.rows, result.groups) == ("transient", 638, 2)
    assert result.ignored == ("valve_command_V",)
    assert result.columns["time"][-1] == pytest.approx(6.37)


def test_a_table_larger_than_the_careful_reader_takes():
    row = b"0.00001,1.2345,250.1234,123.456\n2.00001,1.3345,251.1234,223.456\n"
    result = read(b"time_s,pressure_bar,length_mm,force_N\n" + row * 50_000)
    assert result.rows == 100_000
    assert result.columns["pressure"][-1] == pytest.approx(1.3345e5)


@pytest.mark.parametrize("beyond", [-1, 0, 1, 1_000_000])
def test_a_control_character_is_found_wherever_it_is(beyond: int) -> None:
    lines = b"pressure_bar,length_mm,force_N\n" + b"1,280,100\n" * 250_000
    at = 1_000_000 + beyond  # the file is searched in pieces of a million bytes
    content = lines[:at] + b"\x07" + lines[at:]
    row = lines.count(b"\n", 0, at) + 1
    with pytest.raises(InputError, match=f"row {row}: the file holds control characters"):
        read_measurement(content, "a.csv")


LVM = (
    "LabVIEW Measurement\t\n"
    "Separator\tTab\n"
    "Decimal_Separator\t,\n"
    "***End_of_Header***\t\n"
    "\n"
    "X_Value\tPressure (bar)\tMuscle length (mm)\tForce (N)\n"
    "0,000000\t3,00\t300,0\t600,0\n"
    "0,400000\t3,01\t299,0\t590,0\n"
    "0,800000\t2,99\t298,0\t580,0\n"
    "1,200000\t3,00\t297,0\t570,0\n"
    "\n"
)


def test_the_x_values_of_labview_are_seconds() -> None:
    found = read(LVM, "a.lvm")
    assert found.columns["time"].tolist() == [0.0, 0.4, 0.8, 1.2]
    assert any("'X_Value' is the time in s" in text for text in found.messages)


@pytest.mark.parametrize(
    "change",
    [("LabVIEW Measurement\t", "X_Dimension\tPosition"), ("Separator\tTab", "X_Dimension\tPosition")],
)
def test_x_values_that_the_file_calls_something_else_are_no_time(change: tuple[str, str]) -> None:
    found = read(LVM.replace(*change), "a.lvm")
    assert "time" not in found.columns
    assert ("X_Value", "it is an axis of something else than time") in found.unread


def test_names_with_an_address_behind_their_quotes_are_taken_as_they_stand() -> None:
    text = '"p":IW64 [bar];"Länge":IW66 [mm]\n1,5;300\n2;290\n3;280\n'
    found = preview(text.encode(), "a.csv")
    assert [column.header for column in found.columns] == ["p:IW64 [bar]", "Länge:IW66 [mm]"]
    np.testing.assert_allclose(found.points["pressure"], [1.5e5, 2e5, 3e5])
