"""Tables that are no columns below a head: one value per line, units in cells, labels, merged cells."""

from __future__ import annotations

import io

import numpy as np
import openpyxl
import pytest

from mckibben.physics.errors import InputError
from tests.measurement.reading.isobaric import (
    FORCE,
    PRESSURE,
    ROWS,
    STROKE,
    TIME,
    assert_is_the_test,
    read,
    table,
)

READINGS = list(zip(PRESSURE, FORCE, STROKE, strict=True))


def tall(head: str, line: str, names: tuple[str, str, str], units: tuple[str, ...] = ("", "", "")) -> str:
    rows = [
        line.format(i=i, t=0.5 * i, tag=name, value=value, unit=unit)
        for i, values in enumerate(READINGS)
        for name, value, unit in zip(names, values, units, strict=True)
    ]
    return "\n".join([head, *rows])


TALL = {
    "units in names": tall(
        "# L0: 300 mm\nsample,sensor,value", "{i},{tag},{value}",
        ("Pressure [bar]", "Force [N]", "Stroke [mm]"),
    ),
    "a column of units": tall(
        "rest length 300 mm\ntime_s;channel;reading;unit", "{t};{tag};{value};{unit}",
        ("P_muscle", "F_tension", "X_stroke"), ("bar", "N", "mm"),
    ),
    "explained above": tall(
        "# PT1 = muscle pressure, bar(g); FT1 = tension, N; ZT1 = shortening, mm; L0 300 mm\n"
        "Time;Tag;Value;Quality",
        "2024-06-11T14:03:{i:02d}.250Z;{tag};{value};Good", ("PT1", "FT1", "ZT1"),
    ),
    "japanese": tall(
        "自然長 300 mm\n時刻,項目,値", "{t},{tag},{value}", ("圧力(bar)", "荷重(N)", "変位(mm)")
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", TALL)
def test_one_value_per_line_becomes_a_column_per_signal(case: str) -> None:
    found = read(TALL[case])
    assert_is_the_test(found)
    assert any("one value per line" in message for message in found.messages)


def test_a_reading_that_is_judged_bad_or_not_there_is_none() -> None:
    text = TALL["explained above"].replace(f"FT1;{FORCE[3]};Good", f"FT1;{FORCE[3]};Bad", 1)
    text = text.replace(f"FT1;{FORCE[5]};Good", "FT1;No Data;Bad", 1)
    found = read(text)
    assert found.rows == ROWS - 2
    assert sum(found.skipped.values()) == 2


def test_a_signal_with_few_readings_is_not_read() -> None:
    extra = "\n2024-06-11T14:03:39.250Z;TT1;21.4;Good"
    found = read(TALL["explained above"] + extra)
    assert_is_the_test(found)
    assert any(name.startswith("TT1") for name, _ in found.unread)


def test_units_in_cells_are_read_and_brought_to_one() -> None:
    cells = [
        f"{p:.2f} bar;{f'{f:.1f} N' if f < 100 else f'{f / 1000:.5f} kN'};{s:.2f} mm".replace(".", ",")
        for p, f, s in READINGS
    ]
    assert_is_the_test(read("Ruhelänge 300 mm\nDruck;Kraft;Hub\n" + "\n".join(cells)))


def test_labels_before_each_channel_are_heads() -> None:
    head = (
        "Name;rP;Name;rF;Name;rX\nComment;Druck (Überdruck);Comment;Kraft;Comment;Verkürzung ab Ruhelänge\n"
        "SampleTime[ms];4;SampleTime[ms];4;SampleTime[ms];4\nUnit;bar;Unit;N;Unit;mm\n"
    )
    found = read(f"L0 = 300 mm\n\n{head}\n{table(TIME, PRESSURE, TIME, FORCE, TIME, STROKE, separator=';')}")
    assert_is_the_test(found)
    assert found.columns["time"][-1] == pytest.approx(TIME[-1] / 1e3)


@pytest.mark.parametrize("numbers", [("ScaleFactor", "1"), ("Port", "851"), ("Rate", "100")])
def test_a_number_among_the_labels_is_no_unit(numbers: tuple[str, str]) -> None:
    label, value = numbers
    rows = "\n".join(
        f"{1e3 * t:g};{p};{1e3 * t:g};{f};{1e3 * t:g};{x}"
        for t, p, f, x in zip(TIME, PRESSURE, FORCE, STROKE, strict=True)
    )
    text = (
        "Name;rP;Name;rF;Name;rX\nComment;Druck (Überdruck);Comment;Kraft;Comment;Hub, positiv = Verkürzung\n"
        f"SampleTime[ms];4;SampleTime[ms];4;SampleTime[ms];4\n{label};{value};{label};{value};{label};{value}\n"
        f"Unit;bar;Unit;N;Unit;mm\n\n{rows}\n"
    )
    result = read(text)
    assert_is_the_test(result, rest=False)


def test_two_equal_names_of_forces_are_asked_about() -> None:
    with pytest.raises(InputError, match="Force"):
        read(f"Force,Pressure,Force,Stroke\nN,bar,N,mm\n{table(FORCE, PRESSURE, 0.8 * FORCE, STROKE)}")


def test_signals_with_times_of_their_own_are_asked_about() -> None:
    head = "Time [s];Pressure [bar];Time [s];Force [N];Time [s];Stroke [mm]\n"
    same = read(head + table(TIME, PRESSURE, TIME, FORCE, TIME, STROKE, separator=";"))
    assert_is_the_test(same, rest=False)
    with pytest.raises(InputError, match="times of different signals"):
        read(head + table(TIME, PRESSURE, 1.3 * TIME, FORCE, TIME, STROKE, separator=";"))


def blocks(title: str, head: str, between: str, separator: str) -> str:
    parts = []
    for pressure in (2.0, 4.0):
        own = pressure == PRESSURE
        parts.append(f"{title.format(pressure)}\n{head}{table(STROKE[own], FORCE[own], separator=separator)}")
    return between.join(parts)


BLOCKS = {
    "heads in comments": "# L0=300 mm\n" + blocks("# p = {} bar", "# stroke[mm] force[N]\n", "\n\n\n", " "),
    "one head": "# L0=300 mm\n# stroke[mm] force[N]\n" + blocks("# Druck: {} bar", "", "\n\n\n", " "),
    "titles": "rest length,300 mm\n" + blocks("Test at {} bar,", "Stroke (mm),Force (N)\n", "\n", ","),
    "one head, titles": "rest length;300 mm\nStroke (mm);Force (N)\n"
    + blocks("Pressure {} bar;", "", "\n", ";"),
}


@pytest.mark.parametrize("case", BLOCKS)
def test_a_text_between_blocks_says_their_pressure(case: str) -> None:
    assert_is_the_test(read(BLOCKS[case]))


def test_columns_there_and_back_are_parts() -> None:
    head = "rest length 300 mm\nStroke [mm];F up 2 bar [N];F down 2 bar [N];F up 4 bar [N];F down 4 bar [N]\n"
    columns = (STROKE[:20], FORCE[:20], FORCE[:20] + 1.0, FORCE[20:], FORCE[20:] + 1.0)
    found = read(head + table(*columns, separator=";"))
    assert found.rows == 80
    assert sorted(set(found.columns["pressure"])) == [2e5, 4e5]


def merged_book() -> bytes:
    book = openpyxl.Workbook()
    sheet = book.active
    assert sheet is not None
    for row in (["初始长度", "300 mm"], [], ["压力 (bar)", "收缩量 (mm)", "拉力 (N)"]):
        sheet.append(row)
    for index, (pressure, force, stroke) in enumerate(READINGS):
        sheet.append([pressure if index % 20 == 0 else None, stroke, force])
    sheet.merge_cells("A4:A23")
    sheet.merge_cells("A24:A43")
    stream = io.BytesIO()
    book.save(stream)
    return stream.getvalue()


def test_the_value_of_a_merged_cell_counts_for_its_rows() -> None:
    found = read(merged_book(), "a.xlsx")
    assert_is_the_test(found)
    assert any("value of merged cells counts for each" in message for message in found.messages)


def test_a_column_of_single_values_in_a_text_counts_for_the_rows_below() -> None:
    rows = [f"{p if i % 20 == 0 else ''},{s},{f}" for i, (p, f, s) in enumerate(READINGS)]
    assert_is_the_test(read("rest length 300 mm\nPressure (bar),Stroke (mm),Force (N)\n" + "\n".join(rows)))


def test_a_notebook_table() -> None:
    rows = "\n".join(f"| {p} | {f} | {s} | |" for p, f, s in READINGS)
    head = (
        "- rest length: 30.0 cm\n\n| pressure (bar) | force (N) | stroke (mm) | note |\n|--:|--:|:--|---|\n"
    )
    assert_is_the_test(read(f"# Notebook\n\n{head}{rows}\n\nNice curve!\n", "a.md"))


def test_newest_first_is_turned() -> None:
    rows = table(TIME[::-1], PRESSURE[::-1], FORCE[::-1], STROKE[::-1])
    found = read(f"rest length 300 mm\ntime_s,pressure_bar,force_N,stroke_mm\n{rows}")
    assert_is_the_test(found)
    assert found.columns["time"].tolist() == TIME.tolist()
    assert any("backwards in time" in message for message in found.messages)


def test_rows_in_no_order_are_sorted_by_their_time() -> None:
    order = np.random.default_rng(1).permutation(len(TIME))
    rows = table(TIME[order], PRESSURE[order], FORCE[order], STROKE[order])
    found = read(f"rest length 300 mm\ntime_s,pressure_bar,force_N,stroke_mm\n{rows}")
    assert_is_the_test(found)
    assert found.columns["time"].tolist() == TIME.tolist()
    assert any("in no order of time" in message for message in found.messages)


def test_runs_that_begin_at_0_stay_as_they_are() -> None:
    time = np.tile([0.0, 1.0], len(TIME) // 2)
    rows = table(time, *(values[: len(time)] for values in (PRESSURE, FORCE, STROKE)))
    found = read(f"rest length 300 mm\ntime_s,pressure_bar,force_N,stroke_mm\n{rows}")
    assert found.columns["time"].tolist() == time.tolist()


def test_statistics_above_and_below_are_no_readings() -> None:
    body = f"Mean,30,100\nMax,60,200\n{table(PRESSURE, STROKE, FORCE)}\nMean,30,100\nStd.Dev.,1,2\nN,40,40\n"
    assert_is_the_test(read(f"rest length 300 mm\nPressure (bar),Stroke (mm),Force (N)\n{body}"))


def test_very_many_blocks_are_judged_by_what_they_hold() -> None:
    """They cost in proportion: their number is no reason to refuse a file, what they lack is."""
    with pytest.raises(InputError, match="no kind of measurement fits the columns pressure, force"):
        read("Pressure (bar)  x\n" + "Pressure (bar) Force (N)\n1 2\n4 5\n" * 1500)


@pytest.mark.parametrize("head", [",sweep,time_s", "sweep,sample,time_s", "run,sample"])
def test_one_value_per_line_in_blocks_of_a_signal(head: str) -> None:
    signals = {"pressure_gauge": ("bar", PRESSURE), "force": ("N", FORCE), "contraction": ("%", STROKE / 3.0)}
    lines = [f"{head},quantity,unit,value"]
    for name, (unit, values) in signals.items():
        for row, value in enumerate(values):
            key = {"": len(lines) - 1, "sweep": row // 20, "run": row // 20, "sample": row}
            key |= {"time_s": f"{0.5 * row:.1f}"}
            lines.append(
                ",".join(str(key[part]) for part in head.split(",")) + f",{name},{unit},{value:.10g}"
            )
    found = read("\n".join(lines))
    np.testing.assert_allclose(found.columns["pressure"], PRESSURE * 1e5, rtol=1e-6)
    np.testing.assert_allclose(found.columns["force"], FORCE, rtol=1e-6)
    np.testing.assert_allclose(found.columns["contraction"], STROKE / 300.0, rtol=1e-6)
    assert found.columns["group"].tolist() == [0] * 20 + [1] * 20
