"""Where tables stand in texts, workbooks and MATLAB files, and how their parts belong together."""

from __future__ import annotations

import io
from collections.abc import Callable, Sequence

import numpy as np
import openpyxl
import pytest
from scipy.io import savemat

from mckibben.measurement.measurement import Measurement
from mckibben.measurement.reading import read_measurement, spoken_correction
from mckibben.physics.errors import InputError
from tests.measurement.reading.muscle_test import Array, isobaric

R = isobaric(2e5, 3e5, 4e5)
REST = 0.25
TRUTH = {
    "time": R.time, "pressure": R.pressure, "force": R.force, "displacement": R.stroke,
    "length": REST - R.stroke,
}  # fmt: skip
#: Heads of the plain table that most files here hold, and the factor from SI to their units.
HEADS = ("Zeit [s]", "Druck [bar]", "Kraft [N]", "Länge [mm]")
CHANNELS = {"time": 1.0, "pressure": 1e-5, "force": 1.0, "length": 1e3}
DIGITS = {"time": 0.051, "pressure": 0.51, "force": 5.1e-4, "length": 5.1e-7}


def numbers(channels: Sequence[str] = tuple(CHANNELS), rows: slice = slice(None)) -> list[list[float]]:
    """The readings in the units of the heads, rounded."""
    scale = CHANNELS | {"displacement": 1e3}
    columns = [np.round(TRUTH[c][rows] * scale[c], {"time": 1, "pressure": 5}.get(c, 3)) for c in channels]
    return [list(map(float, row)) for row in zip(*columns, strict=True)]


def lines(separator: str = ";", decimal: str = ",", **options: object) -> list[str]:
    """The readings as lines of a text."""
    rows = numbers(**options)  # type: ignore[arg-type]
    return [separator.join(f"{cell:.5f}".replace(".", decimal) for cell in row) for row in rows]


def read(text: Sequence[str] | bytes, name: str = "a.csv", **options: object) -> Measurement:
    """Read a text, with options of the command line."""
    data = text if isinstance(text, bytes) else "\n".join(text).encode()
    return read_measurement(data, name, spoken_correction(**options))  # type: ignore[arg-type]


def assert_read(result: Measurement, *, but: Sequence[str] = (), order: Array | None = None) -> None:
    """All channels are those of the muscle."""
    for channel, digit in DIGITS.items():
        if channel not in but:
            wanted = TRUTH[channel] if order is None else TRUTH[channel][order]
            values = result.columns[channel]
            if channel == "time":
                values, wanted = values - values[0], wanted - wanted[0]
            np.testing.assert_allclose(values, wanted, atol=1.01 * digit)


HEAD = ";".join(HEADS)
TEXTS = {
    "preamble": ["Prüfprotokoll;Prüfstand 3", "Vorkraft;5;N", "Proben;1", "", HEAD, *lines()],
    "units in a row": ["Zeit;Druck;Kraft;Länge", "s;bar;N;mm", *lines()],
    "units in brackets in a row": ["Zeit;Druck;Kraft;Länge", "[s];[bar];[N];[mm]", *lines()],
    "devices between names and units": [
        "K1;K2;K3;K4", "Zeit;Druck;Kraft;Länge", "s;bar;N;mm", ";P15 10bar;2,0 mV/V;80 mV/V", *lines(),
    ],
    "units far above": ["Einheit;bar;N;mm", "***", "Zeit [s];Druck;Kraft;Länge", *lines()],
    "empty line below the head": [HEAD, "", *lines()],
    "head in a comment": ["# rig 4", "#   t[s]  p[bar]   F[N]   L[mm]", *lines(" ", ".")],
    "per cent comments": ["% made by hand", "% time/s pressure/bar force/N length/mm", *lines(" ", ".")],
    "bars between columns": [HEAD.replace(";", "|"), *lines("|", ".")],
    "trailing separators": [HEAD + ";", *[line + ";" for line in lines()]],
    "ragged remarks": [
        HEAD + ";Bemerkung", *[f"{line};Start" if n == 3 else line for n, line in enumerate(lines())],
    ],
    "running number": ["Nr.;" + HEAD, *[f"{n};{line}" for n, line in enumerate(lines(), start=1)]],
    "statistics below": [HEAD, *lines(), "", "Mittel;3,0;300;240", "Max;4,0;1000;250", "Ende 12:04 Uhr"],
    "statistics directly below": [
        "Nr;" + HEAD, *[f"{n};{line}" for n, line in enumerate(lines())], "Mean;1;2;3;4",
    ],
    "a table of results above": [
        "Ergebnisse", ";Kraft max;Druck max", ";N;bar", "1;1020;4,0", "", "Rohdaten", HEAD, *lines(),
    ],
    "remark between the readings": [HEAD, *lines()[:30], "Regler neu gestellt", *lines()[30:]],
    "keys and values": [
        "boot ok", "units: t[s] p[bar] F[N] L[mm]",
        *[f"12:00:01.5 -> t:{t},p:{p},F:{f},L:{x},adc:512" for t, p, f, x in numbers()],
        "WARN: retry", "done",
    ],
    "lines of JSON": [
        f'{{"t_s": {t}, "p_bar": {p}, "F_N": {f}, "L_mm": {x}}}' for t, p, f, x in numbers()
    ],
    "spreadsheet hint": ["sep=;", HEAD, *lines()],
}  # fmt: skip


@pytest.mark.parametrize("case", TEXTS)
def test_the_table_of_a_text_is_found(case: str) -> None:
    assert_read(read(TEXTS[case]))


@pytest.mark.parametrize("encoding", ["utf-8-sig", "latin-1", "utf-16"])
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_encodings_and_line_ends(encoding: str, end: str) -> None:
    assert_read(read(end.join(TEXTS["units in a row"]).encode(encoding)))


STYLES = ["{} [{}]", "{} ({})", "{} / {}", "{} in {}", "{}_{}", "{}, {}", "{}[{}]"]
NAMES = [
    ("Zeit", "Druck", "Kraft", "Länge"),
    ("Prüfzeit", "Innendruck", "Zugkraft", "Muskellänge"),
    ("t", "p", "F", "L"),
    ("Temps", "Pression", "Effort", "Longueur"),
    ("Tiempo", "Presión", "Fuerza", "Longitud"),
    ("Tempo", "Pressione", "Forza", "Lunghezza"),
    ("Elapsed Time", "Air pressure", "Load cell", "muscle length"),
]


@pytest.mark.parametrize("names", NAMES, ids=lambda names: names[1])
@pytest.mark.parametrize("style", STYLES)
def test_names_and_units_of_any_laboratory(names: Sequence[str], style: str) -> None:
    head = ";".join(
        style.format(name, unit) for name, unit in zip(names, ("s", "bar", "N", "mm"), strict=True)
    )
    assert_read(read(["Messung 4", "", head, *lines()]))


def test_texts_that_are_not_read_are_said() -> None:
    assert any("rows 72 to 74 below the table" in m for m in read(TEXTS["statistics below"]).messages)
    assert any("'Regler neu gestellt'" in m for m in read(TEXTS["remark between the readings"]).messages)


def test_a_broken_reading_is_no_footer() -> None:
    broken = lines()[-1].split(";")
    broken[1] = "kaputt"
    for text in (
        ["Messung 4", HEAD, *lines()[:-1], ";".join(broken)],
        ["Messung 4", HEAD, ";".join(broken), *lines()],
        ["Messung 4", HEAD, *lines()[:20], ";".join(broken), *lines()[20:]],
        [HEAD.replace("Zeit", "time"), *lines(), "abc;2,0;300;250"],
    ):
        with pytest.raises(InputError, match="is not a number"):
            read(text)


def test_thousands_marks_are_read() -> None:
    rows = [[t, p * 1e5, f, x] for t, p, f, x in numbers()]
    text = ["Zeit [s];Druck [Pa];Kraft [N];Länge [mm]"]
    text += [";".join(f"{cell:,.3f}".translate(str.maketrans(",.", ".,")) for cell in row) for row in rows]
    assert_read(read(text))
    english = ["time (s),pressure (Pa),force (N),length (mm)"]
    english += [",".join(f'"{cell:,.3f}"' for cell in row) for row in rows]
    assert_read(read(english))


def test_times_of_day_and_since_1970() -> None:
    clocks = [
        f"23:59:{50 + t:06.3f}".replace(".", ",") if t < 10 else f"00:00:{t - 10:06.3f}" for t in R.time
    ]
    rows = [line.split(";", 1)[1] for line in lines()]
    assert_read(
        read(["Uhrzeit;Druck [bar];Kraft [N];Länge [mm]", *map(";".join, zip(clocks, rows, strict=True))])
    )
    stamps = [f"{1_710_410_712_345 + round(t * 1e3)}" for t in R.time]
    result = read(
        ["timestamp_ms;Druck [bar];Kraft [N];Länge [mm]", *map(";".join, zip(stamps, rows, strict=True))]
    )
    assert_read(result)
    assert any("counts from 1970" in message for message in result.messages)


# Parts ------------------------------------------------------------------------------------------------------

RUN = len(R.time) // 3
HELD = np.repeat([2e5, 3e5, 4e5], RUN)


def assert_parts(result: Measurement, *, parts: int = 3) -> None:
    """Stroke and force are those of the muscle, and the pressure that of the titles."""
    np.testing.assert_allclose(result.columns["pressure"], HELD)
    np.testing.assert_allclose(result.columns["length"], TRUTH["length"], atol=6e-7)
    np.testing.assert_allclose(result.columns["force"], R.force, atol=6e-4)
    assert result.groups == parts


def blocks() -> list[list[list[float]]]:
    """Length and force of each held pressure."""
    return [numbers(("length", "force"), slice(n * RUN, (n + 1) * RUN)) for n in range(3)]


def below_each_other() -> bytes:
    text = ["Test of a muscle", ""]
    for pressure, rows in zip((2, 3, 4), blocks(), strict=True):
        text += [f"--- Run: pressure {pressure} bar ---", "length [mm], force [N]"]
        text += [", ".join(map(str, row)) for row in rows] + [""]
    return "\n".join(text).encode()


def side_by_side() -> bytes:
    text = [";".join(f"L bei {p} bar [mm];F bei {p} bar [N]" for p in (2, 3, 4))]
    text += [";".join(f"{cell}" for part in row for cell in part) for row in zip(*blocks(), strict=True)]
    return "\n".join(text).encode()


def wide() -> bytes:
    """One column of lengths for all, which are the same in each part here."""
    text = ["length [mm];" + ";".join(f"{p} bar" for p in (2, 3, 4)), ";" + ";".join(["Kraft [N]"] * 3)]
    text = ["Kraft [N]", *text[:1]]
    text += [f"{row[0][0]};" + ";".join(f"{part[1]}" for part in row) for row in zip(*blocks(), strict=True)]
    return "\n".join(text).encode()


def workbook(fill: Callable[[openpyxl.Workbook], None]) -> bytes:
    book = openpyxl.Workbook()
    book.remove(book.active)
    fill(book)
    stream = io.BytesIO()
    book.save(stream)
    return stream.getvalue()


def merged_titles() -> bytes:
    def fill(book: openpyxl.Workbook) -> None:
        sheet = book.create_sheet("Tabelle1")
        sheet.append([cell for p in (2, 3, 4) for cell in (f"p = {p} bar", None, None)])
        sheet.append(["L [mm]", "F [N]", None] * 3)
        for row in zip(*blocks(), strict=True):
            sheet.append([cell for part in row for cell in (*part, None)])

    return workbook(fill)


def a_sheet_per_pressure() -> bytes:
    def fill(book: openpyxl.Workbook) -> None:
        book.create_sheet("Deckblatt").append(["Prüfling", "DMSP-20-250N"])
        for pressure, rows in zip(("2", "3,0", "4"), blocks(), strict=True):
            sheet = book.create_sheet(f"{pressure} bar")
            for row in [["Länge [mm]", "Kraft [N]"], *rows]:
                sheet.append(row)

    return workbook(fill)


def structs() -> bytes:
    array = np.empty(3, object)
    for n, rows in enumerate(blocks()):
        table = np.array(rows)
        array[n] = {"p_bar": float(n + 2), "L_mm": table[:, 0], "F_N": table[:, 1]}
    stream = io.BytesIO()
    savemat(stream, {"data": array, "handles": np.eye(7)})
    return stream.getvalue()


PARTS = [below_each_other, side_by_side, wide, merged_titles, a_sheet_per_pressure, structs]


@pytest.mark.parametrize("write", PARTS, ids=lambda write: write.__name__)
def test_parts_by_their_pressure(write: Callable[[], bytes]) -> None:
    assert_parts(read_measurement(write(), "a"))


def test_shorter_parts_end_where_they_are_empty() -> None:
    text = ["x bei 2 bar [mm];F bei 2 bar [N];x bei 3 bar [mm];F bei 3 bar [N]", "# rest length: 250 mm"][:1]
    text += ["0;500;0;700", "1;480;1;680", "2;460;2;660", "3;440;;", "4;420;;", "5;400;;"]
    result = read(text)
    assert result.rows == 9
    assert np.count_nonzero(result.columns["pressure"] == 3e5) == 3


def test_a_map_across_and_down() -> None:
    text = ["Static force [N] of DMSP-20-300", "contraction [%] \\ pressure [bar];1;2;3"]
    text += [f"{k};{100 - k};{200 - k};{300 - k}" for k in range(0, 21, 4)]
    result = read(text)
    assert (result.kind, result.rows) == ("static", 18)
    assert result.columns["pressure"][:3].tolist() == [1e5, 2e5, 3e5]
    assert result.columns["contraction"][-1] == pytest.approx(0.2)
    assert result.columns["force"][-1] == 280.0
    assert result.conditions["nominal_length"] == pytest.approx(0.3)


def test_a_table_anywhere_in_a_sheet_and_a_bad_sheet_beside_it() -> None:
    def fill(book: openpyxl.Workbook) -> None:
        book.create_sheet("Breit").append([1] * 1500)
        sheet = book.create_sheet("Daten")
        for column, head in enumerate(HEADS, start=3):
            sheet.cell(5, column, head.replace(" ", "\n"))
        for row, cells in enumerate(numbers(), start=6):
            for column, cell in enumerate(cells, start=3):
                sheet.cell(row, column, cell)

    assert_read(read_measurement(workbook(fill), "a.xlsx"))


def test_a_head_of_two_rows() -> None:
    def fill(book: openpyxl.Workbook) -> None:
        sheet = book.create_sheet("Tab")
        sheet.append(["Zeit", "Druck", None, "Kraft", "Länge"])
        sheet.append(["[s]", "Soll [bar]", "Ist [bar]", "[N]", "[mm]"])
        for t, p, f, x in numbers():
            sheet.append([t, round(p), p, f, x])

    result = read_measurement(workbook(fill), "a.xlsx")
    assert_read(result)
    assert ("Druck Soll [bar]", "it is a set value") in result.unread


def test_sheets_by_length() -> None:
    def fill(book: openpyxl.Workbook) -> None:
        for length in (250, 240, 230):
            sheet = book.create_sheet(f"{length} mm")
            sheet.append(["p [bar]", "F [N]"])
            for pressure in np.linspace(0.5, 6.0, 12):
                sheet.append([float(pressure), float(pressure * 200 - 250 + length)])

    data = workbook(fill)
    assert np.unique(read_measurement(data, "map.xlsx").columns["length"]).tolist() == [0.23, 0.24, 0.25]
    one = read_measurement(data, "map.xlsx", spoken_correction(sheet="240 mm"))
    assert one.rows == 12


def signals() -> dict[str, object]:
    table = np.array(numbers())
    made = np.empty(3, object)
    for n, (name, unit) in enumerate([("Druck", "bar"), ("Kraft", "N"), ("Länge", "mm")]):
        made[n] = {"Name": name, "Unit": unit, "Data": table[:, n + 1]}
    return {
        "rec": {"X": {"Name": "Zeit", "Unit": "s", "Data": table[:, 0]}, "Y": made, "Capture": {"Type": "T"}}
    }


def matrix() -> dict[str, object]:
    return {
        "M": np.array(numbers()),
        "names": np.array(HEADS, object),
        "fs": 5.0,
        "set": {"gain": [1.0, 2.0, 4.0]},
    }


def with_units() -> dict[str, object]:
    table = np.array(numbers())
    fields = dict(zip("tpFL", table.T, strict=True))
    return {"S": {**fields, "units": {"t": "s", "p": "bar", "F": "N", "L": "mm"}}, "other": np.eye(4)}


@pytest.mark.parametrize("make", [signals, matrix, with_units], ids=lambda make: make.__name__)
def test_tables_of_matlab_files(make: Callable[[], dict[str, object]]) -> None:
    stream = io.BytesIO()
    savemat(stream, make())
    assert_read(read_measurement(stream.getvalue(), "a.mat"))


def test_a_matrix_without_names_takes_them_from_the_user() -> None:
    stream = io.BytesIO()
    savemat(stream, {"M": np.array(numbers())})
    with pytest.raises(InputError, match=r"'M\(:,1\)'") as caught:
        read_measurement(stream.getvalue(), "a.mat")
    assert '--column "length=M(:,4) [mm]"' in caught.value.message
    named = ["time=M(:,1) [s]", "pressure=M(:,2) [bar]", "force=M(:,3) [N]", "length=M(:,4) [mm]"]
    assert_read(read_measurement(stream.getvalue(), "a.mat", spoken_correction(columns=named)))


# The user's word --------------------------------------------------------------------------------------------


def test_the_head_and_unknown_names() -> None:
    text = ["Kanal 0;Kanal 1;Kanal 2;Kanal 3", *lines()]
    named = ["time=Kanal 0 [s]", "pressure=Kanal 1 [bar]", "force=-Kanal 2 [N]", "length=column 4 [mm]"]
    result = read(text, columns=named, head=1)
    assert_read(result, but=("force",))
    np.testing.assert_allclose(result.columns["force"], -R.force, atol=6e-4)
    with pytest.raises(InputError, match="row 99: there are no rows of numbers below it"):
        read(text, head=99)
    with pytest.raises(InputError) as caught:
        read(text, columns=["force=Kanal 9 [N]"])
    assert "Kanal" in str(caught.value.hint)


@pytest.mark.parametrize(
    "options",
    [
        {"columns": ["force"]},
        {"columns": ["forze=Kraft"]},
        {"columns": ["force=Kraft [mm]"]},
        {"columns": ["force=Kraft [parsnip]"]},
        {"rest_length": "5 bar"},
        {"load": "5 mm"},
        {"supply": "-3 bar"},
        {"head": 0},
    ],
)
def test_a_wrong_option_is_named(options: dict[str, object]) -> None:
    with pytest.raises(InputError) as caught:
        spoken_correction(**options)  # type: ignore[arg-type]
    option = next(iter(options)).replace("columns", "column").replace("_", "-")
    assert str(caught.value.field).startswith(f"--{option}")
    assert caught.value.hint


def test_names_that_occur_twice() -> None:
    head = "Zeit [s];Druck [bar];Kraft [N];Länge [mm];Kraft [N]"
    text = [head, *[f"{line};{7 * n},0" for n, line in enumerate(lines())]]
    with pytest.raises(
        InputError, match=r"'Kraft \[N\]' and 'Kraft \[N\] #2' are both force and differ"
    ) as caught:
        read(["Messung 4", *text])
    assert '--column "force=column 3" or --column "force=column 5"' in caught.value.message
    assert_read(read(["Messung 4", *text], columns=["force=column 3"]))
    assert_read(read(["Messung 4", *text], ignore=["Kraft #2"]))
    assert_read(read([text[0].replace("Kraft", "force"), *text[1:]], ignore=["column 5"]))


def _beside(heads: Sequence[str], parts: Sequence[Sequence[str]], shared: Sequence[str] = ()) -> list[str]:
    """A text with the readings cut in as many pieces as there are parts, each in columns of its own."""
    rows = numbers(["pressure", "force", "length"])
    count = len(rows) // len(parts)
    index = {"pressure": 0, "force": 1, "length": 2}
    result = [";".join([*shared, *heads])]
    for row in range(count):
        cells = [rows[row + count * n][index[c]] for n, part in enumerate(parts) for c in part]
        result.append(";".join(f"{cell:.5f}".replace(".", ",") for cell in cells))
    return result


@pytest.mark.parametrize("run", ["Run #{}", "Versuch {}", "trial no. {}"])
def test_runs_side_by_side_are_parts(run: str) -> None:
    heads = [f"{name} {run.format(n)}" for n in (1, 2) for name in ("Druck (bar)", "Kraft (N)", "Länge (mm)")]
    result = read(_beside(heads, [["pressure", "force", "length"]] * 2))
    count = len(R.time) // 2
    assert len(result.columns["group"]) == 2 * count
    np.testing.assert_array_equal(result.columns["group"], np.repeat([0, 1], count))
    assert_read(result, but=("time",), order=np.arange(2 * count))


def test_the_way_there_and_back_in_two_columns_beside_one_pressure() -> None:
    pressure = np.linspace(1.0, 6.0, 26)
    filling, venting = 200.0 - 8.0 * pressure, 198.0 - 8.0 * pressure
    rows = [f"{p:.1f};{f:.2f};{v:.2f}" for p, f, v in zip(pressure, filling, venting, strict=True)]
    for ways in (("inflating", "deflating"), ("(mm) auf", "(mm) ab")):
        heads = [f"Länge {way}" if "mm" in way else f"Länge (mm) {way}" for way in ways]
        result = read([";".join(["Druck (bar)", *heads]), *rows])
        # In the order of the test: down from the pressure that was reached, and the muscle becomes longer.
        np.testing.assert_allclose(
            result.columns["length"], np.concatenate([filling, venting[::-1]]) * 1e-3, atol=1e-5
        )
        np.testing.assert_allclose(
            result.columns["pressure"], np.concatenate([pressure, pressure[::-1]]) * 1e5, atol=1.0
        )
        assert result.columns["direction"].tolist() == 26 * [-1.0] + 26 * [1.0]


def test_two_ways_beside_one_time_are_two_sensors() -> None:
    rows = [f"{n / 10:.1f};{1 + n / 20:.2f};{200 - n / 3:.2f};{199 - n / 3:.2f}" for n in range(40)]
    with pytest.raises(InputError, match="both length and differ"):
        read(["Zeit (s);Druck (bar);Länge (mm) auf;Länge (mm) ab", *rows])
