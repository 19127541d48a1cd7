"""A stroke that no head names: proposed from its unit and numbers where one column can be it, else asked."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

from mckibben.measurement.reading import preview, read_measurement, spoken_correction
from mckibben.physics.errors import InputError
from tests.measurement.reading.muscle_test import Array, isobaric, isotonic

R = isobaric(2e5, 3e5, 4e5)
REST = 0.25


def text(heads: str, *columns: Array, above: Sequence[str] = ()) -> bytes:
    """Columns in their units as lines of a text."""
    rows = [",".join(f"{value:.5f}" for value in row) for row in zip(*columns, strict=True)]
    return "\n".join([*above, heads, *rows]).encode()


def test_the_only_length_from_zero_on_is_the_displacement_and_said() -> None:
    data = text("time_s,pressure_bar,force_N,Kanal 7 [mm]", R.time, R.pressure / 1e5, R.force, R.stroke * 1e3)
    result = read_measurement(data, "a.csv")
    np.testing.assert_allclose(result.columns["displacement"], R.stroke, atol=1e-8)
    assert any(
        "'Kanal 7 [mm]' is read as displacement because of its unit" in said for said in result.messages
    )
    with pytest.raises(InputError, match="Kanal 7"):
        read_measurement(data, "a.csv", spoken_correction(strict=True))


def test_the_only_length_that_falls_with_the_pressure_is_the_length() -> None:
    up = isotonic()
    long = REST - up.stroke
    data = text(
        "time_s,3 <Wire> (in),p (kPa)", up.time, long / 0.0254, up.pressure / 1e3, above=["# L0_mm: 250"]
    )
    found = preview(data, "a.csv")
    assert found.measurement is not None
    np.testing.assert_allclose(found.measurement.columns["length"], long, atol=1e-6)
    (asked,) = [question for question in found.questions if question.column == "3 <Wire> (in)"]
    assert (asked.proposed, asked.stops) == ("length", False)


@pytest.mark.parametrize(
    ("extra", "why"),
    [
        (REST - R.stroke, "two columns of lengths"),
        (np.full(len(R.stroke), 0.012), "a constant shows nothing"),
        (R.stroke[::-1] + 3.0, "no muscle is that long"),
    ],
)
def test_anything_less_sure_is_asked(extra: Array, why: str) -> None:
    heads, columns = "time_s,pressure_bar,force_N,Kanal 8 [mm]", [R.time, R.pressure / 1e5, R.force]
    if why.startswith("two"):
        heads = heads.replace("Kanal 8", "Kanal 7 [mm],Kanal 8")
        columns.append(R.stroke * 1e3)
    columns.append(extra * 1e3)
    with pytest.raises(InputError, match="Kanal 8"):
        read_measurement(text(heads, *columns), "a.csv")


def test_a_statistic_behind_a_name_is_no_load() -> None:
    heads = "time_s,Line Last (bar),Cell Last (N),Wire Last (mm)"
    data = text(heads.replace("Line", "Muscle"), R.time, R.pressure / 1e5, R.force, R.stroke * 1e3)
    columns = read_measurement(data, "a.csv").columns
    np.testing.assert_allclose(columns["displacement"], R.stroke, atol=1e-8)
    np.testing.assert_allclose(columns["pressure"], R.pressure, atol=1.0)


def test_a_clock_without_a_head_is_the_time() -> None:
    stamps = [f"2025-02-03T08:00:{second:06.3f}+01:00" for second in R.time]
    rows = [
        f"{stamp},{p / 1e5:.5f},{f:.3f},{s * 1e3:.5f}"
        for stamp, p, f, s in zip(stamps, R.pressure, R.force, R.stroke, strict=True)
    ]
    data = "\n".join(['"",Pressure (bar),Force (N),Stroke (mm)', *rows]).encode()
    time = read_measurement(data, "a.csv").columns["time"]
    np.testing.assert_allclose(time, R.time, atol=1e-6)


@pytest.mark.parametrize(
    ("words", "kind"),
    [("Isotonic run with a weight", "isotonic"), ("isotonic or isometric, see the book", "transient")],
)
def test_a_text_says_the_kind(words: str, kind: str) -> None:
    up = isotonic()
    heads = "Zeit [s];Druck [bar];Hub [mm]"
    rows = np.column_stack([up.time, up.pressure / 1e5, up.stroke * 1e3])
    data = "\n".join([words, "", heads, *(";".join(f"{v:.5f}" for v in row) for row in rows)]).encode()
    result = read_measurement(data, "a.csv")
    assert result.kind == kind
    assert any("a text of the file says so" in said for said in result.messages) == (kind == "isotonic")
