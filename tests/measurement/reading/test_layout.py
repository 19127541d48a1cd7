"""The shapes of tables: each is read as the same readings."""

from __future__ import annotations

import io
import json

import numpy as np
import openpyxl
import pytest

from mckibben.measurement.reading.containers import sheets_of
from mckibben.measurement.reading.layout import table_of
from mckibben.measurement.reading.text import best_delimiter
from tests.measurement.reading.bench import (
    ABOVE,
    FORCE,
    PRESSURE,
    RUN,
    SI,
    STROKE,
    TIME,
    assert_is,
    plain,
    read,
    refusal,
    table,
)

MM, BAR = STROKE * 1e3, PRESSURE / 1e5
HELD = {"pressure": PRESSURE, "force": FORCE, "displacement": STROKE}


def book(*sheets: tuple[str, list[list[object]]]) -> bytes:
    """A workbook."""
    made = openpyxl.Workbook()
    made.remove(made.active)  # type: ignore[arg-type]
    for title, rows in sheets:
        sheet = made.create_sheet(title)
        for row in rows:
            sheet.append(row)
    stream = io.BytesIO()
    made.save(stream)
    return stream.getvalue()


@pytest.mark.parametrize(
    ("separator", "decimal"), [(",", "."), (";", ","), ("\t", ","), ("  ", "."), ("|", ".")]
)
def test_delimiters_and_decimal_signs(separator: str, decimal: str) -> None:
    head = separator.join(("t[s]", "p[bar]", "F[N]", "s[mm]"))
    body = table(TIME, BAR, FORCE, MM, separator=separator, decimal=decimal)
    assert_is(read(f"{ABOVE}{head}\n{body}\n"))


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "latin-1"])
def test_encodings(encoding: str) -> None:
    head = "Ruhelänge 300 mm\nZeit [s];Druck [bar];Kraft [N];Verkürzung [mm]"
    text = f"{head}\n{table(TIME, BAR, FORCE, MM, separator=';')}\n"
    assert_is(read(text.encode(encoding)))


def test_units_below_the_names_and_statistics_below_the_table() -> None:
    head = f"{ABOVE}Time,Pressure,Load,Stroke\n(s),(bar),(N),(mm)"
    text = f"{head}\n{table(TIME, BAR, FORCE, MM)}\n\nMean,1,2,3\nMax,4,5,6\n"
    assert_is(read(text))


def test_a_head_of_two_rows() -> None:
    rows = table(TIME, BAR + 0.5, BAR, FORCE, MM)
    text = f"{ABOVE}Zeit,Druck,,Kraft,Hub\n[s],Soll [bar],Ist [bar],[N],[mm]\n{rows}\n"
    assert_is(read(text))


def test_blocks_one_below_the_other() -> None:
    blocks = [
        f"p = {2 + k} bar\ns [mm];F [N]\n{table(MM[k == RUN], FORCE[k == RUN], separator=';')}\n"
        for k in range(3)
    ]
    assert_is(read("Ruhelänge 300 mm\n\n" + "\n".join(blocks)), HELD)


def test_blocks_beside_each_other() -> None:
    heads = ";".join(f"s bei {2 + k} bar [mm];F bei {2 + k} bar [N]" for k in range(3))
    columns = [column for k in range(3) for column in (MM[k == RUN], FORCE[k == RUN])]
    assert_is(read(f"L0 = 300 mm\n{heads}\n{table(*columns, separator=';')}\n"), HELD)


def test_a_wide_table() -> None:
    heads = ";".join(f"F @ {2 + k} bar [N]" for k in range(3))
    columns = [FORCE[k == RUN] for k in range(3)]
    assert_is(read(f"L0 = 300 mm\ns [mm];{heads}\n{table(MM[RUN == 0], *columns, separator=';')}\n"), HELD)


def test_sheets_of_several_pressures() -> None:
    sheets = [
        (
            f"{2 + k} bar",
            [["Hub [mm]", "Kraft [N]"], *zip(MM[k == RUN].tolist(), FORCE[k == RUN].tolist(), strict=True)],
        )
        for k in range(3)
    ]
    data = book(("Info", [["Muskel"], ["Ruhelänge", 300, "mm"]]), *sheets)  # type: ignore[arg-type]
    assert_is(read(data, "a.xlsx"), HELD)


def test_of_two_like_sheets_one_is_asked_for() -> None:
    rows: list[list[object]] = [
        ["p [bar]", "L [mm]", "F [N]"],
        *map(list, zip(BAR.tolist(), (300 - MM).tolist(), FORCE.tolist(), strict=True)),
    ]
    assert "which one is meant" in refusal(book(("new", rows), ("after", rows)), "a.xlsx")


def test_a_tall_table() -> None:
    lines = [
        f"{t:.1f},{name},{value:.6f},{unit}"
        for t, p, f, s in zip(TIME, BAR, FORCE, MM, strict=True)
        for name, value, unit in (("pressure", p, "bar"), ("force", f, "N"), ("shortening", s, "mm"))
    ]
    assert_is(read(f"{ABOVE}t,variable,value,unit\n" + "\n".join(lines)))


def test_a_table_on_its_side() -> None:
    rows = [("Time [s]", TIME), ("Pressure [bar]", BAR), ("Force [N]", FORCE), ("Stroke [mm]", MM)]
    text = "\n".join(";".join([head, *(f"{v:.6f}" for v in values)]) for head, values in rows)
    assert_is(read("rest length 300 mm\n" + text))


def test_a_map_and_its_corner() -> None:
    pressures, lengths = np.array([1.0, 2.0, 3.0, 4.0]), np.array([300.0, 290.0, 280.0, 270.0, 260.0])
    force = np.outer((lengths / 300.0) ** 2 - 0.6, pressures) * 100.0
    rows = "\n".join(
        ";".join([f"{length:g}", *(f"{v:.3f}" for v in row)])
        for length, row in zip(lengths, force, strict=True)
    )
    head = "Length [mm] \\ Pressure [bar];" + ";".join(f"{p:g}" for p in pressures)
    found = read(f"Force [N]\n{head}\n{rows}\n")
    assert found.kind == "static"
    order = np.lexsort((found.columns["pressure"], -found.columns["length"]))
    np.testing.assert_allclose(found.columns["force"][order], force.ravel(), atol=1e-3)


def test_two_ways_in_columns() -> None:
    up, down = MM[:12], MM[:12] + 1.0
    head = "rest length 300 mm, load 5 kg\nPressure [bar];Stroke up [mm];Stroke down [mm]"
    text = f"{head}\n{table(np.linspace(2, 6, 12), up, down, separator=';')}\n"
    found = read(text)
    assert found.rows == 24
    assert found.columns["direction"].tolist() == [-1.0] * 12 + [1.0] * 12
    np.testing.assert_allclose(found.columns["displacement"][12:], down[::-1] / 1e3, atol=1e-6)


def test_a_clock_with_milliseconds_beside() -> None:
    lines = [
        f"10:00:{int(t):02},{round(1000 * (t % 1)):03},{p},{f},{s}"
        for t, p, f, s in zip(TIME, BAR, FORCE, MM, strict=True)
    ]
    assert_is(read(f"{ABOVE}Time,ms,p [bar],F [N],s [mm]\n" + "\n".join(lines)))


def test_a_text_without_heads_is_asked_about_and_no_reading_becomes_a_name() -> None:
    text = table(TIME, BAR, FORCE, MM)
    found = table_of(sheets_of(text.encode(), "a.csv"), "a.csv")
    assert (found.rows, found.headless) == (len(TIME), True)
    assert refusal(text)


def test_json_in_several_forms() -> None:
    named = [
        {"name": name, "unit": unit, "values": values.tolist()}
        for name, unit, values in (
            ("time", "s", TIME),
            ("pressure", "bar", BAR),
            ("force", "N", FORCE),
            ("stroke", "mm", MM),
        )
    ]
    records = [
        {"t_s": t, "p_bar": p, "force_N": f, "stroke_mm": s}
        for t, p, f, s in zip(TIME, BAR, FORCE, MM, strict=True)
    ]
    rest = {"rest_length": {"value": 300, "unit": "mm"}}
    for document in (
        {**rest, "channels": named},
        {**rest, "rows": records},
        {"sample": rest, "data": records},
    ):
        assert_is(read(json.dumps(document), "a.json"))
    lines = "\n".join(json.dumps(record) for record in records)
    assert_is(read(lines, "a.jsonl"), rest=None)


def test_cells_with_their_units() -> None:
    lines = [f"{p:.4f} bar;{f:.4f} N;{s:.4f} mm" for p, f, s in zip(BAR, FORCE, MM, strict=True)]
    assert_is(read("Ruhelänge 300 mm\nDruck;Kraft;Hub\n" + "\n".join(lines)), HELD)


def test_a_long_table_keeps_every_row() -> None:
    count = 400
    data = f"{ABOVE}t [s],p [bar],F [N],s [mm]\n" + "\n".join([table(TIME, BAR, FORCE, MM)] * count)
    found = read(data.replace("nan", ""))
    assert found.rows == count * len(TIME)
    np.testing.assert_allclose(found.columns["force"], np.tile(FORCE, count), atol=1e-5)


def test_ragged_rows_are_named() -> None:
    lines = plain().splitlines()
    lines[9] += ",7"
    assert "row 10" in refusal("\n".join(lines))
    lines[9] = "1,2"
    assert "row 10" in refusal("\n".join(lines[:40]))


def test_a_line_that_breaks_off_among_many_is_left_out() -> None:
    lines = plain().splitlines()
    lines[9] = "1,2"
    found = read("\n".join(lines))
    assert found.rows == len(TIME) - 1
    assert any("the line is cut off (first: row 10" in message for message in found.messages)


def test_a_head_that_is_printed_again_on_each_page_ends_no_run() -> None:
    lines = plain().splitlines()
    lines = [*lines[:30], lines[1], *lines[30:-1], lines[1], lines[-1]]
    assert_is(read("\n".join(lines)), HELD)


def test_a_monitor_writes_its_time_before_each_line() -> None:
    lines = ["10:22:30.810 -> " + line for line in plain().splitlines()]
    found = read("\n".join(lines))
    assert_is(found, HELD)
    assert any("'received' is not used" in message for message in found.messages)


def test_the_delimiter_with_most_numbers_wins() -> None:
    assert best_delimiter(["1,5;2,5", "1,7;2,9"]) == ";"
    assert best_delimiter(["1.5 2.5", "1.7 2.9"]) is None
    assert best_delimiter(["a, b", "1,2", "3,4"]) == ","


def test_every_form_of_the_time_is_read() -> None:
    stamps = [f"2024-05-02 10:{int(t) // 60:02}:{int(t) % 60:02}.{round(1000 * (t % 1)):03}" for t in TIME]
    lines = [f"{stamp},{p},{f},{s}" for stamp, p, f, s in zip(stamps, BAR, FORCE, MM, strict=True)]
    assert_is(read(f"{ABOVE}Timestamp,p [bar],F [N],s [mm]\n" + "\n".join(lines)), SI)


@pytest.mark.parametrize("label", ["Desv. típ.", "Streubreite", "s (n-1)"])
def test_one_statistic_beside_another_is_no_reading(label: str) -> None:
    count = np.arange(1.0, len(TIME) + 1.0)
    head = "N.;t [s];p [bar];F [N];s [mm]"
    below = f"\nMedia;1;2;3;4\n{label};1;2;3;4\nMáximo;1;2;3;4\n"
    assert_is(read(f"{ABOVE}{head}\n{table(count, TIME, BAR, FORCE, MM, separator=';')}\n{below}"))


def test_a_sentence_over_a_wide_table_is_no_row_of_names() -> None:
    title = "Force (N) read on the way up by the cell"  # as many words as columns
    levels = [f"{0.5 * (k + 1):g} bar" for k in range(len(title.split()) - 2)]
    rows = [[1.0 * k, *(100.0 * (j + 2) - 9.0 * k for j in range(len(levels)))] for k in range(9)]
    found = read(book(("Data", [[title], ["Shortening (%)", *levels], *rows, ["Rest length: 300 mm"]])))
    assert set(found.columns) >= {"contraction", "pressure", "force"}
    assert found.rows == len(levels) * len(rows)
    np.testing.assert_allclose(np.max(found.columns["contraction"]), 0.08)


def test_the_values_of_a_map_are_named_further_above() -> None:
    rows = "\n".join(f"{300 - 10 * k}\t{300 - 40 * k}\t{500 - 45 * k}\t{700 - 50 * k}" for k in range(5))
    above = "Force map (N) - muscle 7, braid 30 mm\nlength at rest: 300 mm\nread on 3 October, J. Doe\n\n"
    found = read(f"{above}L (mm)\\p (bar)\t1,0\t2,0\t3,0\n{rows}\n")
    assert found.rows == 15
    assert float(np.max(found.columns["force"])) == 700.0
