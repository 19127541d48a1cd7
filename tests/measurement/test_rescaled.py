"""A channel read another way, against files written that way."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.measurement.measurement import Measurement
from mckibben.measurement.reading import read_measurement
from mckibben.measurement.rescaled import rescaled

PRESSURE = (1.0, 2.0, 3.0, 4.0, 5.0, 6.0)


def table(
    *, unit: float = 1.0, zero: float = 0.0, stroke: float = 1.0, kind: str = "isobaric"
) -> Measurement:
    """Six loops at constant pressure; pressure and stroke written in another way."""
    rows = [f"# kind: {kind}", "# pressure: gauge", "time_s,pressure_bar,displacement_mm,force_N"]
    time = 0.0
    for bar in PRESSURE:
        for way in (*range(20), *range(20, 0, -1)):
            time += 0.1
            force = 100.0 * bar * (1.0 - way / 30.0)
            rows.append(f"{time:.1f},{bar * unit + zero:.6f},{way * stroke:.6f},{force:.4f}")
    return read_measurement("\n".join(rows).encode(), "loops.csv")


@pytest.mark.parametrize(
    ("written", "channel", "factor", "offset"),
    [
        ({"zero": 1.01325}, "pressure", 1.0, -101325.0),
        ({"unit": 0.5}, "pressure", 2.0, 0.0),
        ({"stroke": 0.1}, "stroke", 10.0, 0.0),
    ],
)
def test_it_is_the_measurement_written_in_the_right_way(written, channel, factor, offset) -> None:
    changed = rescaled(table(**written), channel, factor=factor, offset=offset)
    right = table()
    assert set(changed.columns) == set(right.columns)
    for name, values in right.columns.items():
        np.testing.assert_allclose(
            changed.columns[name], values, rtol=1e-6, atol=1.0 if name == "pressure" else 1e-9
        )
    assert changed.kind == right.kind
    np.testing.assert_array_equal(changed.slack, right.slack)


def test_the_groups_and_the_id_of_the_file_stay() -> None:
    measurement = table()
    changed = rescaled(measurement, "force", factor=-1.0)
    np.testing.assert_array_equal(changed.columns["group"], measurement.columns["group"])
    assert changed.id == measurement.id
    np.testing.assert_allclose(changed.columns["force"], -measurement.columns["force"])


def test_another_time_changes_measured_speeds() -> None:
    rows = ["# kind: transient", "# load_mass: 5 kg", "time_s,pressure_bar,displacement_mm,velocity_m/s"]
    rows += [f"{0.01 * i:.2f},{2 + 0.01 * i:.3f},{0.1 * i:.2f},0.01" for i in range(50)]
    measurement = read_measurement("\n".join(rows).encode(), "run.csv")
    changed = rescaled(measurement, "time", factor=1e-3)
    np.testing.assert_allclose(changed.columns["velocity"], 1e3 * measurement.columns["velocity"])
