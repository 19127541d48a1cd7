"""What a comparison says of readings where the motion turns, with friction and forces written here."""

from __future__ import annotations

import numpy as np
import pytest

import mckibben as mk
from mckibben.identification.predict.comparable_rows import comparable_rows
from tests.identification.synthetic import BRAID, MUSCLE, csv, truth

FRICTION = 30.0  # N


def loops(at_turns: float, rows: int = 40) -> tuple[mk.Model, mk.Measurement, np.ndarray]:
    """Three loops at 2, 3 and 4 bar between 0 and 40 mm whose readings at the far end, taken while the
    machine turns, lie a share from the shortening branch (-1) to the lengthening one (1).
    """
    there = np.linspace(0.0, 0.04, rows)
    way = np.concatenate([there, there[-2::-1]])
    sign = np.concatenate([-np.ones(rows), np.ones(rows - 1)])
    sign[rows - 1] = at_turns
    stroke, pressure = np.tile(way, 3), np.repeat([2e5, 3e5, 4e5], len(way))
    force = truth(pressure, 0.3 - stroke) + FRICTION * np.tile(sign, 3)
    model = mk.Model(**BRAID, effects={"coulomb_friction": {"force": FRICTION}})
    columns = {"pressure": pressure, "displacement": stroke, "force": force}
    columns["time"] = np.arange(len(stroke)) * 0.1
    data = mk.Measurement.from_arrays(columns, rest_length="300 mm")
    return model, data, np.arange(3) * len(way) + rows - 1


@pytest.mark.parametrize("at", [-1.0, -0.4, 0.0, 0.7, 1.0])
def test_any_force_of_the_range_is_allowed_at_a_reversal(at: float) -> None:
    model, data, _ = loops(at)
    found = model.compare(data)
    assert found.rmse < 1e-6
    turning = found.reversals
    assert turning is not None
    assert turning.rows >= 3
    assert turning.outside == 0
    assert turning.distance < 1e-6
    assert np.asarray(turning.high) - np.asarray(turning.low) == pytest.approx(2.0 * FRICTION)
    assert any("all lie within it" in message for message in found.messages)


@pytest.mark.parametrize(("at", "beyond"), [(2.0, 30.0), (-3.0, 60.0)])
def test_a_reading_beyond_both_branches_is_told(at: float, beyond: float) -> None:
    model, data, _ = loops(at)
    found = model.compare(data)
    turning = found.reversals
    assert turning is not None
    assert turning.outside == 3
    assert turning.distance == pytest.approx(beyond, abs=1e-6)
    assert any(f"3 lie outside of it, by up to {beyond:.3g} N" in message for message in found.messages)


def test_without_dry_friction_nothing_is_said_of_a_range() -> None:
    _, data, _ = loops(0.0)
    found = mk.Model(**BRAID, effects={}).compare(data)
    assert found.reversals is not None
    assert found.reversals.outside == 0  # friction is missing everywhere, and no more there
    assert not any("reversals" in message for message in found.messages)


def test_rows_at_reversals_that_lie_off_a_model_without_friction_are_named_and_no_proof_holds() -> None:
    _, data, places = loops(0.0)
    columns = {name: np.array(values) for name, values in data.columns.items() if name != "group"}
    scatter = np.random.default_rng(5).normal(size=len(columns["force"]))
    columns["force"] = truth(columns["pressure"], 0.3 - columns["displacement"]) + scatter
    columns["force"][places] += 40.0
    found = mk.Model(**BRAID, effects={}).compare(mk.Measurement.from_arrays(columns, rest_length="300 mm"))
    assert found.rmse == pytest.approx(1.0, rel=0.1)
    rows = ", ".join(f"row {place + 1}" for place in places)
    assert any(
        "3 lie off the model, which has none, by up to 39.7 N" in text and rows in text
        for text in found.messages
    )
    assert found.verdict.status == "undecided"
    assert found.verdict.why_not["no_outliers"].startswith("3 of the rows at reversals")


@pytest.mark.parametrize("noise", [0.0, 2e-5, 1e-4])
@pytest.mark.parametrize("rows", [400, 4000])
def test_noise_of_the_length_turns_no_friction_round(noise: float, rows: int) -> None:
    """Up, hold, half down, hold, down, and again: hardly a scored row has the friction of the other way.

    A threshold of three standard deviations on the readings themselves would turn 3 to 10 % of them round
    in the holds.
    """
    times = [0.0, 8.0, 10.0, 14.0, 16.0, 20.0, 22.0, 24.0, 28.0, 30.0, 40.0]
    strokes = [0.0, 60.0, 60.0, 30.0, 30.0, 0.0, 0.0, 30.0, 30.0, 60.0, 0.0]
    time = np.linspace(0.0, 40.0, rows + 1)
    stroke = 1e-3 * np.interp(time, times, strokes)
    leg = np.clip(np.searchsorted(times, time, side="left"), 1, len(times) - 1)
    way = np.sign(np.diff(strokes))[leg - 1]
    for row in range(1, len(way)):
        way[row] = way[row] or way[row - 1]
    way[0] = way[1]
    scatter = np.random.default_rng(3).normal(size=(2, len(time)))
    force = truth(4e5, 0.3 - stroke) - FRICTION * way + scatter[0]
    lines = [
        f"{t:.6f},4,{1e3 * x:.6f},{f:.4f}"
        for t, x, f in zip(time, stroke + noise * scatter[1], force, strict=True)
    ]
    task = comparable_rows(csv(lines, "time_s,pressure_bar,displacement_mm,force_N"), MUSCLE)
    scored = ~task.turning
    wrong = scored & (task.state["direction"] != -way[task.rows])
    assert np.mean(scored) > 0.85
    assert np.count_nonzero(wrong) <= 0.002 * len(time)
