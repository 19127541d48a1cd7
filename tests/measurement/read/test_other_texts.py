"""The same readings as XML, a web page, YAML, TOML, LaTeX, a script, and tables that lie on their side."""

from __future__ import annotations

import json

import numpy as np
import pytest

from mckibben.measurement.read.html_file import text_of_html
from mckibben.measurement.read.reshape.transposed import turned
from mckibben.measurement.read.yaml_file import YamlError, document_of_yaml
from mckibben.physics.errors import InputError
from tests.measurement.read.bench import FORCE, PRESSURE, STROKE, TIME, assert_is_the_test, read

ROWS = list(zip(TIME, PRESSURE, FORCE, STROKE, strict=True))
NAMES = ("t", "p", "F", "s")
UNITS = ("s", "bar", "N", "mm")


def test_xml_with_readings_as_attributes_and_units_in_a_list_of_channels() -> None:
    channels = "".join(f'<channel name="{n}" unit="{u}"/>' for n, u in zip(NAMES, UNITS, strict=True))
    samples = "".join(
        "<sample " + " ".join(f'{n}="{v:g}"' for n, v in zip(NAMES, row, strict=True)) + "/>" for row in ROWS
    )
    text = (
        '<?xml version="1.0"?>\n<test><specimen restLength="300" restLengthUnit="mm"/>'
        f"<channels>{channels}</channels>\n<data>{samples}</data></test>"
    )
    assert_is_the_test(read(text, "a.xml"))


def test_xml_with_a_list_of_numbers_per_channel() -> None:
    columns = zip(("time", "pressure", "force", "shortening"), UNITS, zip(*ROWS, strict=True), strict=True)
    body = "".join(f'<{n} unit="{u}">{" ".join(f"{v:g}" for v in values)}</{n}>' for n, u, values in columns)
    assert_is_the_test(read(f'<test rest_length="300 mm"><data>{body}</data></test>', "a.xml"))


@pytest.mark.parametrize(
    "text",
    [
        "<a><b>1</a>",
        '<?xml version="1.0"?><!DOCTYPE a [<!ENTITY b "c">]><a>&b;</a>',
        "<a>" * 60 + "</a>" * 60,
    ],
)
def test_xml_that_is_damaged_or_holds_no_table_is_refused(text: str) -> None:
    with pytest.raises(InputError):
        read(text, "a.xml")


def test_a_web_page_with_a_table() -> None:
    rows = "".join("<tr>" + "".join(f"<td>{v:g}</td>" for v in row) + "</tr>" for row in ROWS)
    text = (
        "<!DOCTYPE html><html><head><style>td {color: red}</style></head><body><h1>Test</h1>"
        "<p>Rest length: 300&nbsp;mm, gauge pressure.</p><table><tr><th>t / s</th><th>p / bar</th>"
        f"<th>force / N</th><th>shortening / mm</th></tr>{rows}</table></body></html>"
    )
    assert_is_the_test(read(text, "a.html"))


def test_the_cells_of_a_web_page_that_span_columns() -> None:
    text = "<table><tr><td colspan=2>a</td><td>b</td></tr><tr><td>1<td>2<td>3</table>"
    assert text_of_html(text) == "a\t\tb\n1\t2\t3"


def test_yaml_with_a_list_of_objects_and_with_lists() -> None:
    records = "\n".join(
        f"  - {{t_s: {t:g}, p_bar: {p:g}, F_N: {f:g}, shortening_mm: {s:g}}}" for t, p, f, s in ROWS
    )
    head = "# a test\nmuscle:\n  rest_length: 300 mm\npressure: gauge\n"
    assert_is_the_test(read(f"{head}samples:\n{records}\n", "a.yaml"))
    lists = "\n".join(
        f"  {name}: [{', '.join(f'{v:g}' for v in values)}]"
        for name, values in zip(
            ("t_s", "p_bar", "F_N", "shortening_mm"), zip(*ROWS, strict=True), strict=True
        )
    )
    assert_is_the_test(read(f"{head}data:\n{lists}\n", "a.yml"))


def test_what_yaml_says_is_what_json_says() -> None:
    text = """
a: 1.5
b: "x: y"   # a remark
c:
  - 1
  - - 2
    - 3
d: {e: [1, {f: g}], h: null}
i: |
  one
  two
j:
- k: 1
  l: true
- k: 2
"""
    expected = json.loads(
        '{"a": 1.5, "b": "x: y", "c": [1, [2, 3]], "d": {"e": [1, {"f": "g"}], "h": null}, "i": "one two",'
        '"j": [{"k": 1, "l": true}, {"k": 2}]}'
    )
    assert document_of_yaml(text) == (expected, ["a remark"])


@pytest.mark.parametrize("text", ["a: [1, 2", "a:\n  - 1\n b: 2", "a: {b}"])
def test_yaml_that_is_not_understood_names_its_line(text: str) -> None:
    with pytest.raises(YamlError):
        document_of_yaml(text)
    with pytest.raises(InputError, match="row"):
        read(text, "a.yaml")


def test_toml() -> None:
    lists = "\n".join(
        f"{name} = [{', '.join(f'{float(v)!r}' for v in values)}]"
        for name, values in zip(
            ("t_s", "p_bar", "F_N", "shortening_mm"), zip(*ROWS, strict=True), strict=True
        )
    )
    assert_is_the_test(read(f'[muscle]\nrest_length = "300 mm"\n[data]\n{lists}\n', "a.toml"))


def test_a_table_of_latex() -> None:
    rows = "\n".join(" & ".join(f"{v:g}" for v in row) + r" \\" for row in ROWS)
    text = (
        r"\begin{table}\caption{A muscle of \SI{300}{mm} rest length, gauge pressure}" + "\n"
        r"\begin{tabular}{cccc}\toprule" + "\n"
        r"$t$ [s] & $p$ [bar] & force $F$ [N] & shortening [mm] \\ \midrule"
        f"\n{rows}\n" + r"\bottomrule\end{tabular}\end{table}"
    )
    assert_is_the_test(read(text, "a.tex"))


@pytest.mark.parametrize("form", ["matlab", "python", "r"])
def test_a_script_with_vectors(form: str) -> None:
    begin, separator, end, sign = {
        "matlab": (" = [", " ", "];", "%"), "python": (" = np.array([", ", ", "])", "#"),
        "r": (" <- c(", ", ", ")", "#"),
    }[form]  # fmt: skip
    lines = [f"{sign} rest length 300 mm, s is the shortening"]
    for name, unit, values in zip(("t", "p", "F", "s"), UNITS, zip(*ROWS, strict=True), strict=True):
        lines.append(f"{name}{begin}{separator.join(f'{v:g}' for v in values)}{end}  {sign} {unit}")
    assert_is_the_test(read("\n".join(lines), "a.m"))


def test_a_table_on_its_side() -> None:
    lines = ["# rest length 300 mm"]
    heads = ("time [s]", "pressure [bar]", "force [N]", "shortening [mm]")
    lines += [
        f"{n};" + ";".join(f"{v:g}" for v in values)
        for n, values in zip(heads, zip(*ROWS, strict=True), strict=True)
    ]
    found = read("\n".join(lines))
    assert_is_the_test(found)
    assert any("transposed" in message for message in found.messages)


def test_a_plain_table_is_not_turned() -> None:
    from mckibben.measurement.read.grid import TextGrid

    lines = ["force;1;2;3", "length;1;2;3"]
    assert turned(TextGrid([f"sample;{line}" for line in lines], "a", ";")) is None
    assert turned(TextGrid(["speed;1;2;3", "voltage;1;2;3"], "a", ";")) is None
    assert turned(TextGrid(lines, "a", ";")) is not None


def test_a_page_of_mean_values_with_deviations() -> None:
    rows = "\n".join(f"{t:g};{p:g};{f:g} ± 1.5;{s:g}" for t, p, f, s in ROWS)
    assert_is_the_test(read(f"# rest length 300 mm\nt [s];p [bar];F [N];shortening [mm]\n{rows}\n"))


def test_units_told_in_a_sentence() -> None:
    rows = "\n".join(";".join(f"{v:g}" for v in row) for row in ROWS)
    text = "muscle of 300 mm rest length\ntime in s, pressure in bar, force in N, shortening in mm\n"
    assert_is_the_test(read(f"{text}time;pressure;force;shortening\n{rows}\n"))


def test_columns_told_in_a_sentence_over_two_lines() -> None:
    rows = "\n".join(" ".join(f"{v:9g}" for v in row) for row in ROWS)
    text = (
        "A muscle of 300 mm rest length.\nThe four columns are: time in seconds, gauge pressure in bar,\n"
        f"force in newtons, and shortening in millimetres.\n\n{rows}\n"
    )
    assert_is_the_test(read(text))


def test_names_that_go_on_in_the_next_line() -> None:
    rows = "\n".join("".join(f"{v:12g}" for v in row) for row in ROWS)
    text = (
        "   RELAXED LENGTH 300 MM   GAUGE PRESSURE\n\n"
        "        TIME    PRESSURE       FORCE     MUSCLE\n"
        "                                     SHORTENING\n"
        f"         SEC         BAR           N          MM\n{rows}\n"
    )
    assert_is_the_test(read(text))


def test_numbers_kept_with_a_scale() -> None:
    channels = [
        {"name": "time", "unit": "s", "data": TIME.tolist()},
        {
            "name": "pressure",
            "unit": "bar",
            "scale": 0.001,
            "offset": 0.0,
            "data": np.round(PRESSURE * 1e3).tolist(),
        },
        {
            "name": "force",
            "unit": "N",
            "scale": 0.1,
            "offset": -50.0,
            "data": np.round(FORCE * 10 + 500).tolist(),
        },
        {"name": "shortening", "unit": "mm", "data": STROKE.tolist()},
    ]
    assert_is_the_test(read(json.dumps({"rest_length": "300 mm", "channels": channels}), "a.json"))


def test_thousands_of_remarks_are_not_all_searched() -> None:
    remarks = "".join(f"# run {number} was quiet\n" for number in range(3000))
    rows = "".join(f"{p},{10 * k},{100 - k}\n" for p in (1, 2) for k in range(5))
    found = read(f"# rest length 300 mm\n{remarks}p [bar],x [mm],F [N]\n{rows}")
    assert found.conditions["nominal_length"] == pytest.approx(0.3)
    assert any("first 2000 of 3001 remarks" in message for message in found.messages)
