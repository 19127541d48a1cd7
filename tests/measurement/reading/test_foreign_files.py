"""Files in other encodings and languages, with paths for names, pages, and times since 1970."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.reading import read_measurement
from tests.measurement.reading.muscle_test import isobaric

R = isobaric(2e5, 3e5, 4e5)


def rows(separator: str = ",", **columns: np.ndarray) -> list[str]:
    """Columns as lines."""
    return [separator.join(f"{v:.5f}" for v in row) for row in zip(*columns.values(), strict=True)]


READINGS = {"t": R.time, "p": R.pressure / 1e5, "f": R.force, "s": R.stroke * 1e3}


@pytest.mark.parametrize(
    ("encoding", "heads", "first"),
    [
        ("cp1250", "Czas [s],Ciśnienie [bar],Siła [N],Skrócenie [mm]", "Próbka: mięsień, łożysko"),
        ("cp932", "時間 [s],圧力 [bar],荷重 [N],変位 [mm]", "試験: 引張"),
        ("latin-1", "Tempo [s],Pressão [bar],Força [N],Encurtamento [mm]", "Ensaio: tração, 20 mm² em cm³"),
    ],
)
def test_encodings_and_languages(encoding: str, heads: str, first: str) -> None:
    data = "\n".join([first, "", heads, *rows(**READINGS)]).encode(encoding)
    result = read_measurement(data, "a.csv")
    np.testing.assert_allclose(result.columns["pressure"], R.pressure, atol=1.0)
    np.testing.assert_allclose(result.columns["force"], R.force, atol=1e-4)
    np.testing.assert_allclose(result.columns["displacement"], R.stroke, atol=1e-8)
    assert result.columns["time"][-1] == pytest.approx(R.time[-1])


def test_paths_with_units_in_comments() -> None:
    above = ["# /rig/t dtype=f8 units=ms", "# /rig/p: kPa", "# /rig/f  unit = daN", "# /rig/eps [%]"]
    table = rows(run=R.run, t=R.time * 1e3, p=R.pressure / 1e3, f=R.force / 10, eps=R.stroke / 0.25 * 100)
    data = "\n".join([*above, "/rig/run,/rig/t,/rig/p,/rig/f,/rig/eps", *table]).encode()
    columns = read_measurement(data, "a.csv").columns
    np.testing.assert_allclose(columns["time"], R.time, atol=1e-6)
    np.testing.assert_allclose(columns["pressure"], R.pressure, atol=0.02)
    np.testing.assert_allclose(columns["force"], R.force, atol=1e-3)
    np.testing.assert_allclose(columns["contraction"], R.stroke / 0.25, atol=1e-6)


def test_pages_of_fixed_width_are_one_table() -> None:
    page = ["        P       EPS         F", "    [MPa]       [%]       [N]", "-" * 34]
    lines = [
        f"{p / 1e6:9.4f} {s / 0.25 * 100:9.3f} {f:9.2f}"
        for p, s, f in zip(R.pressure, R.stroke, R.force, strict=True)
    ]
    text: list[str] = []
    for number in range(0, len(lines), 25):
        text += [f"BENCH 7      PAGE {number // 25 + 1}", "", *page, *lines[number : number + 25], "\f"]
    result = read_measurement("\r\n".join(text).encode(), "a.prn")
    assert result.rows == len(lines)
    assert any("are read as runs" in said for said in result.messages)
    np.testing.assert_allclose(result.columns["pressure"], R.pressure, atol=51.0)
    np.testing.assert_allclose(result.columns["force"], R.force, atol=5.1e-3)


def test_times_in_nanoseconds_since_1970() -> None:
    stamps = [f"{1_700_000_000_000_000_000 + round(t * 1e9)}" for t in R.time]
    table = [f"{stamp},{row}" for stamp, row in zip(stamps, rows(**READINGS), strict=True)]
    heads = "stamp time,ticks,pressure_bar,force_N,displacement_mm"
    time = read_measurement("\n".join([heads, *table]).encode(), "a.csv").columns["time"]
    np.testing.assert_allclose(time, R.time, atol=1e-6)
