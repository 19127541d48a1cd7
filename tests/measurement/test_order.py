"""Rows without time: those that go there and back step by step are in the order of the test."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.identification.predict.comparable_rows import comparable_rows, records_of
from mckibben.identification.predict.fit_model import FitModel
from mckibben.identification.predict.quasistatic import QuasistaticPredictor
from mckibben.measurement.order import order_of_rows
from mckibben.physics.catalogue import default_catalogue
from mckibben.simulation.statics.model import StaticModel
from tests.identification.synthetic import MUSCLE, csv

RNG = np.random.default_rng(3)
UP = np.arange(0.0, 11.0)
LOOP = np.concatenate([UP, UP[-2::-1]])


def weights(pressures: tuple[float, ...] = (2e5, 4e5)) -> dict[str, np.ndarray]:
    """Weights put on one by one and taken off again, at each pressure; 0.2 N and 0.02 mm of scatter."""
    force = np.concatenate([20.0 * LOOP + 30.0 for _ in pressures])
    pressure = np.repeat(pressures, len(LOOP))
    stroke = 0.06 - 1e-4 * (force - 30.0) + 1e-7 * pressure
    scatter = RNG.standard_normal((2, len(force)))
    return {
        "pressure": pressure + 50.0 * RNG.standard_normal(len(force)),
        "force": force + 0.2 * scatter[0],
        "displacement": stroke + 2e-5 * scatter[1],
    }


def test_weights_put_on_and_off_tell_the_direction() -> None:
    found = order_of_rows(weights())
    assert found is not None
    assert found.starts == (0, 21)
    # More weight stretches: lengthening on the way there, up to and with its last row.
    assert found.direction[:21].tolist() == [0.0] + 10 * [1.0] + 10 * [-1.0]


@pytest.mark.parametrize("rows", [20, 60, 200])
def test_rows_have_the_way_from_the_reversal_on(rows: int) -> None:
    """However finely a loop is read: not only once it has gone a part of the way back."""
    there = np.linspace(0.0, 0.05, rows)
    loop = np.concatenate([there, there[-2::-1]])
    found = order_of_rows({"pressure": np.full(len(loop), 3e5), "displacement": loop, "force": 100.0 - loop})
    assert found is not None
    assert found.direction.tolist() == [0.0] + (rows - 1) * [-1.0] + (rows - 1) * [1.0]


@pytest.mark.parametrize("swept", ["length", "contraction"])
def test_any_stroke_tells_it(swept: str) -> None:
    columns = weights()
    stroke = columns.pop("displacement")
    columns[swept] = 0.3 - stroke if swept == "length" else stroke / 0.3
    found = order_of_rows(columns)
    assert found is not None
    assert found.direction[5] == 1.0


def test_a_pressure_stepped_up_and_down_at_fixed_lengths() -> None:
    pressure = np.tile(5e4 * LOOP, 3)
    length = np.repeat([0.30, 0.28, 0.26], len(LOOP)) + 1e-5 * RNG.standard_normal(63)
    found = order_of_rows({"pressure": pressure, "length": length, "force": pressure * length})
    assert found is not None
    assert found.starts == (0, 21, 42)
    assert found.direction[[5, 15]].tolist() == [-1.0, 1.0]  # filling, venting


def test_lists_that_are_sorted_shuffled_or_noise_are_in_no_order() -> None:
    columns = weights()
    rows = {
        "sorted": np.lexsort((columns["displacement"], columns["pressure"] > 3e5)),
        "shuffled": RNG.permutation(len(columns["force"])),
    }
    for order in rows.values():
        assert order_of_rows({name: values[order] for name, values in columns.items()}) is None
    held = {name: float(np.mean(values)) * np.ones(400) for name, values in columns.items()}
    scatter = {name: values * (1.0 + 1e-3 * RNG.standard_normal(400)) for name, values in held.items()}
    assert order_of_rows(scatter) is None


def test_a_stated_direction_that_says_otherwise_counts() -> None:
    columns = weights()
    found = order_of_rows(columns)
    assert found is not None
    assert order_of_rows(columns | {"direction": found.direction}) is not None
    assert order_of_rows(columns | {"direction": -found.direction}) is None


def test_friction_of_ordered_rows_can_be_found() -> None:
    """The file has no time; what friction remembers of the way is known all the same, creep is not."""
    columns = weights()
    lines = [
        f"{p / 1e5:.5f},{f:.2f},{1e3 * s:.3f}"
        for p, f, s in zip(columns["pressure"], columns["force"], columns["displacement"], strict=True)
    ]
    measurement = csv(lines, "pressure_bar,force_N,displacement_mm")
    assert measurement.by_rows
    assert any("order is taken as that of the test" in message for message in measurement.messages)
    assert np.unique(records_of(measurement)).tolist() == [0, 1]
    predictor = QuasistaticPredictor(comparable_rows(measurement, MUSCLE))
    for effect in default_catalogue().values():
        hidden = predictor.why_hidden(effect)
        if effect.type == "hysteretic" and measurement.kind in effect.kinds:
            assert hidden == ""
        elif effect.type == "dynamic" and measurement.kind in effect.kinds:
            assert "no time" in hidden


def test_the_work_grows_with_the_rows(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where each row is a block of its own, none of them may look at all the others."""
    seen = 0
    widths = np.ptp

    def counted(values: np.ndarray) -> float:
        nonlocal seen
        seen += np.size(values)
        return widths(values)

    monkeypatch.setattr(np, "ptp", counted)
    rows = 4000
    there = np.arange(rows) % 2
    order_of_rows(
        {"pressure": 1e5 + 1e5 * there, "length": 0.28 + 1e-3 * there, "force": 10.0 + 10.0 * there}
    )
    assert rows <= seen < 50 * rows


def test_rows_at_a_shared_reversal_are_not_scored() -> None:
    """A machine reads each end twice, once from either side: which friction acts there no row says."""
    way = np.concatenate([np.arange(0.0, 46.0, 3.0), np.arange(45.0, -1.0, -3.0)])
    stroke, pressure = np.tile(way, 3), np.repeat([2e5, 3e5, 4e5], len(way))
    lengthening = np.concatenate([np.zeros(16, bool), np.ones(16, bool)])
    force = 2e-3 * pressure - 4.0 * stroke + 25.0 * np.where(np.tile(lengthening, 3), 1.0, -1.0)
    lines = [f"{p / 1e5:.3f},{s:.3f},{f:.2f}" for p, s, f in zip(pressure, stroke, force, strict=True)]
    rows = comparable_rows(csv(lines, "pressure_bar,displacement_mm,force_N"), MUSCLE)
    scored = rows.rows[~rows.turning]
    # Where the direction is told it is the true one; the second rows of the three ends are among the others.
    told = np.where(np.tile(lengthening, 3), 1.0, -1.0)[scored]
    assert np.all(rows.state["direction"][~rows.turning] * told >= 0.0)
    assert {16, 48, 80} <= set(rows.rows[rows.turning].tolist())
    assert len(scored) > 80
    assert rows.excluded["turning points"] == np.count_nonzero(rows.turning)


@pytest.mark.parametrize("wrong", [0.0, 30.0])
def test_what_lies_outside_of_the_range_at_a_reversal_is_told(wrong: float) -> None:
    """Between both branches friction may have any value; a reading beyond them is none of its."""
    way = np.concatenate([np.arange(0.0, 46.0, 3.0), np.arange(45.0, -1.0, -3.0)])
    length, pressure = 0.3 - 1e-3 * np.tile(way, 3), np.repeat([2e5, 3e5, 4e5], len(way))
    model = StaticModel(MUSCLE, {"coulomb_friction": {"force": 25.0}})
    direction = np.tile(np.where(np.arange(32) < 16, -1.0, 1.0), 3)
    force = model.force(length=length, pressure=pressure, direction=direction)
    force[[16, 48, 80]] -= [20.0, 35.0, 50.0 + wrong]  # on their way from one branch to the other
    lines = [
        f"{p / 1e5:.3f},{1e3 * (0.3 - x):.3f},{f:.4f}"
        for p, x, f in zip(pressure, length, force, strict=True)
    ]
    measurement = csv(lines, "pressure_bar,displacement_mm,force_N")
    predictor = QuasistaticPredictor(comparable_rows(measurement, MUSCLE))
    friction = default_catalogue()["coulomb_friction"]
    fit_model = FitModel(MUSCLE, (friction,), {"coulomb_friction": {**friction.defaults, "force": 25.0}})
    found = predictor.at_reversals(fit_model)
    assert found is not None
    told, rows = found.sentence(0.01, 0.01), np.count_nonzero(predictor.task.reversing)
    assert found.outside(0.01, 0.01) == (1 if wrong else 0)
    assert np.max(found.distance) == pytest.approx(wrong, abs=1e-3)
    assert found.high - found.low == pytest.approx(np.full(rows, 50.0))
    assert told.startswith(f"{rows} rows at reversals are counted apart")
    assert told.endswith("1 lie outside of it, by up to 30 N: row 81" if wrong else "all lie within it")
    bare = predictor.at_reversals(FitModel(MUSCLE))
    assert bare is not None
    assert np.array_equal(bare.low, bare.high)
    assert bare.sentence(0.01, 100.0) == ""  # no farther off than all other rows are without friction
