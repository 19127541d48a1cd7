"""What instruments write instead of a number: such rows are left out and counted, unless most are such."""

from __future__ import annotations

import pytest

from mckibben.measurement.reading import read_measurement
from mckibben.measurement.reading.lexicon import marker_of
from mckibben.physics.errors import InputError

HEAD = "pressure_bar,length_mm,force_N\n"
ROWS = "1,300,10\n2,290,20\n3,280,30\n4,270,40\n"

MARKERS = {
    "": "an empty cell", "NaN": "not a finite number", "#N/A": "not a finite number",
    "∞": "not a finite number",
    "--": "no reading", "No Data": "no reading", "-": "no reading", "OL": "out of range",
    "+++++++": "out of range", "####": "out of range", "OVLD": "out of range", "Over range": "out of range",
}  # fmt: skip


@pytest.mark.parametrize("text", MARKERS)
def test_a_row_without_a_reading_is_left_out_and_said(text: str) -> None:
    result = read_measurement(f"{HEAD}{ROWS}5,{text},50\n".encode(), "a.csv")
    assert result.rows == 4
    assert result.skipped == {MARKERS[text]: 1}
    assert f"1 row left out: {MARKERS[text]} (first: row 6, column 'length_mm')" in result.messages


def test_the_large_table_does_the_same() -> None:
    rows = "".join(f"{1 + n % 5},{300 - n % 40},{n % 70}\n" for n in range(30_000))
    result = read_measurement(f"{HEAD}{rows}5,OL,50\n{rows}5,,50\n".encode(), "a.csv")
    assert result.rows == 60_000
    assert result.skipped == {"out of range": 1, "an empty cell": 1}


def test_a_column_that_is_mostly_empty_is_asked_about() -> None:
    with pytest.raises(InputError, match="row 2, column 'length_mm': the cell is empty") as caught:
        read_measurement(f"{HEAD}1,,10\n2,,20\n3,280,30\n".encode(), "a.csv")
    assert '--ignore "length_mm"' in str(caught.value.hint)


@pytest.mark.parametrize("text", ["x", "12", "F", "up", "A.", "300 mm"])
def test_other_texts_are_no_markers(text: str) -> None:
    assert marker_of(text) is None
