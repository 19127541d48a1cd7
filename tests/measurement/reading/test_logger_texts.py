"""Texts of data loggers: keys and values above, a list of channels, units in a row of their own."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.reading import read_measurement

PRESSURE = np.round(4.0 + 0.002 * np.sin(np.arange(40.0)), 3)
STROKE = np.round(np.linspace(0.0, 60.0, 40), 2)
FORCE = np.round(1500.0 * (1.0 - STROKE / 64.0) ** 2, 1)
GRAPH = [
    "Vendor,ACME", "Sampling interval,250ms", "Total data points,40", "Start time,2024/05/14,10:02:11",
    "CH,Signal name,Input,Range", "CH1,Pressure,DC,10V,bar", "CH2,Force,DC,10V,N", "CH3,Stroke,DC,10V,mm",
    "Number,Date&Time,ms,CH1,CH2,CH3,Alarm1-10", "NO.,Time,ms,bar,N,mm,A1234567890",
]  # fmt: skip
STAMPS = [(11 + n // 4, 250 * (n % 4)) for n in range(40)]


def graph_rows(sign: str) -> list[str]:
    return [
        f"{n + 1},2024/05/14 10:02:{s:02d},{ms:03d},{sign}{p},{sign}{f},{sign}{x},LLLL"
        for n, ((s, ms), p, f, x) in enumerate(zip(STAMPS, PRESSURE, FORCE, STROKE, strict=True))
    ]


def german() -> list[str]:
    """Another logger: channels listed with a key, a comma as decimal sign, units right below."""
    rows = [
        f"{n * 0.25:.2f};{p:.3f};{f:.1f};{x:.2f}".replace(".", ",")
        for n, (p, f, x) in enumerate(zip(PRESSURE, FORCE, STROKE, strict=True))
    ]
    above = [
        "Gerät;Logger 5",
        "Messwerte;40;",
        "AI0;Innendruck;0..10 V",
        "AI1;Kraft;0..10 V",
        "AI2;Hub;0..5 V",
    ]
    return [*above, "", "Zeit;AI0;AI1;AI2", "s;bar;N;mm", *rows]


@pytest.mark.parametrize("lines", [[*GRAPH, *graph_rows("+   ")], [*GRAPH, *graph_rows("")], german()])
def test_channels_are_named_by_the_list_above(lines: list[str]) -> None:
    columns = read_measurement("\n".join(lines).encode(), "log.csv").columns
    np.testing.assert_allclose(columns["pressure"], PRESSURE * 1e5)
    np.testing.assert_allclose(columns["force"], FORCE)
    np.testing.assert_allclose(columns["displacement"], STROKE * 1e-3)
    np.testing.assert_allclose(columns["time"], 0.25 * np.arange(40), atol=1e-9)


def test_a_clock_with_fractions_is_not_added_to() -> None:
    rows = [row.replace(",000,", ".000,000,") for row in graph_rows("")]
    rows = [row.replace(f",{ms},", f".{ms},{ms},") for row, (_, ms) in zip(rows, STAMPS, strict=True)]
    result = read_measurement("\n".join([*GRAPH, *rows]).encode(), "log.csv")
    np.testing.assert_allclose(result.columns["time"], 0.25 * np.arange(40), atol=1e-9)
