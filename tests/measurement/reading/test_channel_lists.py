"""Loggers name their channels above the table, in rows, columns or behind labels; pages; messages."""

from __future__ import annotations

import pytest

from mckibben.physics.errors import InputError
from tests.measurement.reading.isobaric import FORCE, PRESSURE, STROKE, TIME, assert_is_the_test, read, table

REST = "Comment,rest length 300 mm; stroke is shortening\n"
ROWS = table(TIME, PRESSURE, FORCE, STROKE)

LOGGERS = {
    "a row for each, behind the module": (
        "Unit,CH,Name,Range\nNR-08,(1)A1,muscle pressure,10 V\nNR-04,(2)B1,tensile force,5 V\n"
        "NR-08,(1)A2,stroke,10 V\n\nTime,(1)A1,(2)B1,(1)A2\ns,bar,N,mm\n"
    ),
    "a column for each": (
        "CH,U1-1,U1-2,U1-3\nMode,volt,strain,volt\nNote,muscle pressure,tensile force,stroke\n\n"
        "Time[s],U1-1[bar],U1-2[N],U1-3[mm]\n"
    ),
}


@pytest.mark.parametrize("list_of_channels", LOGGERS)
def test_what_a_list_above_calls_a_channel(list_of_channels: str) -> None:
    assert_is_the_test(read(f"{REST}{LOGGERS[list_of_channels]}{ROWS}\n"))


def test_labels_before_rows_of_names_units_and_spans() -> None:
    head = "Tag,,PT-1 pressure,WT-1 force,ZT-1 stroke\nUnit,,bar,N,mm\nSpan,,0,0,0\nTime,ms,,,\n"
    rows = "".join(
        f"10:00:{int(t):02d},{1000 * (t % 1):g},{p:g},{f:g},{s:g}\n"
        for t, p, f, s in zip(TIME, PRESSURE, FORCE, STROKE, strict=True)
    )
    found = read(f"{REST}{head}{rows}")
    assert_is_the_test(found)
    assert found.columns["time"].tolist() == TIME.tolist()


def test_a_logger_in_shift_jis_beside_english_names() -> None:
    head = (
        "型名,GL840\nサンプル間隔,500ms\nコメント,自然長 300mm  変位は伸びを正とする\n\n"
        "CH,信号名,入力,EU単位\nCH1,供試体圧力(ゲージ圧),DC,bar\nCH2,引張荷重,DC,N\nCH3,変位,DC,mm\n\n"
        "番号,日時,ms,CH1,CH2,CH3,アラーム\nNO.,Time,ms,bar,N,mm,A123\n"
    )
    rows = "".join(
        f"{n},2024/02/06 13:40:{int(t):02d},{1000 * (t % 1):g},+ {p:g},+ {f:g},- {s:g},LLL\n"
        for n, (t, p, f, s) in enumerate(zip(TIME, PRESSURE, FORCE, STROKE, strict=True), 1)
    )
    assert_is_the_test(read((head + rows).encode("cp932")))


def test_pages_with_units_in_brackets_below_the_names() -> None:
    head = "{}PAGE {}\r\nREST LENGTH 300 MM\r\nSTROKE IS SHORTENING\r\n\r\n"
    names = "  TIME  PRESSURE   FORCE  STROKE   TEMP\r\n"
    units = names + " (SEC)     (BAR)     (N)    (MM)  (DEG F)\r\n\r\n"
    lines = [f"{t:6.1f} {p:9.2f} {f:7.1f} {s:7.2f} {68.0:6.1f}\r\n"
             for t, p, f, s in zip(TIME, PRESSURE, FORCE, STROKE, strict=True)]  # fmt: skip
    text = "".join([head.format("", 1), units, *lines[:25], head.format("\f", 2), units, *lines[25:]])
    found = read(text, "RUN.PRN")
    assert_is_the_test(found)
    assert found.columns["temperature"][0] == pytest.approx(293.15)  # 68 °F


def test_the_mass_of_the_load_in_every_row_is_a_condition() -> None:
    text = "time_s,pressure_bar,contraction_pct,load_mass_kg\n"
    found = read(text + table(TIME, PRESSURE, STROKE / 3.0, 0.0 * TIME + 12.0))
    assert found.conditions["load_mass"] == 12.0
    assert "force" not in found.columns


def test_rows_of_two_lists_of_different_keys_stay_a_question() -> None:
    points = "[[0, 1], [1, 2], [2, 3]]"
    text = f'{{"point": ["stroke_mm", "force_N"], "a": {points}, "b": {points}}}'
    with pytest.raises(InputError):
        read(text, "a.json")
