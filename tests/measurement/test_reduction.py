"""A reduced measurement gives the fit of the whole one."""

import numpy as np
import pytest

from mckibben.measurement.measurement import Measurement, build
from mckibben.measurement.reduction import reduced

RANDOM = np.random.default_rng(4)
NOISE = 5.0


def triangle(rows: int, cycles: float) -> np.ndarray:
    phase = (np.arange(rows) / rows * cycles) % 1.0
    return np.where(phase < 0.5, 2.0 * phase, 2.0 - 2.0 * phase)


def loops(rows: int = 100_000, *, clip: float = np.inf) -> Measurement:
    """Loops at four pressures, the force linear in five parameters, with noise."""
    pressure = np.repeat([1e5, 2e5, 4e5, 6e5], rows // 4)
    length = 0.3 - 0.05 * triangle(rows, 8)
    side = np.where(np.diff(length, append=length[0]) > 0.0, 1.0, -1.0)
    force = basis(pressure, length, side) @ [300.0, 3e-3, -200.0, 1e-2, 8.0]
    force = np.minimum(force + NOISE * RANDOM.standard_normal(rows), clip)
    columns = {"time": np.arange(rows) * 1e-3, "pressure": pressure, "length": length, "force": force}
    return build(columns, name="a.csv", id="0" * 64)


def basis(pressure: np.ndarray, length: np.ndarray, side: np.ndarray) -> np.ndarray:
    one = np.ones_like(pressure)
    return np.stack([one, pressure, (length - 0.27) * 10, pressure * (length - 0.27), side], axis=1)


def fitted(measurement: Measurement, weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Weighted least squares: (parameters, standard errors)."""
    columns = measurement.columns
    rows = basis(columns["pressure"], columns["length"], measurement.segments.direction.astype(float))
    use = measurement.usable
    root = np.sqrt(weights[use])
    values = np.linalg.lstsq(rows[use] * root[:, None], columns["force"][use] * root, rcond=None)[0]
    normal = rows[use].T @ (rows[use] * weights[use][:, None])
    return values, NOISE * np.sqrt(np.diag(np.linalg.inv(normal)))


@pytest.mark.parametrize("rows", [1000, 4000])
def test_the_fit_is_that_of_all_rows(rows: int) -> None:
    whole = loops()
    few = reduced(whole, rows)
    assert 0.95 * rows <= few.measurement.rows <= 1.1 * rows + 50
    assert few.counts.sum() == whole.rows
    all_values, all_errors = fitted(whole, np.ones(whole.rows))
    values, errors = fitted(few.measurement, few.counts)
    np.testing.assert_allclose((values - all_values) / all_errors, 0.0, atol=0.1)
    np.testing.assert_allclose(errors / all_errors, 1.0, atol=0.02)


def test_unusable_rows_are_gone_and_nothing_crosses_them() -> None:
    whole = loops(clip=1500.0)
    bad = whole.excluded_rows["force saturated"]
    assert bad.any()
    few = reduced(whole)
    assert few.counts.sum() == np.count_nonzero(whole.usable)
    assert few.measurement.usable.all()
    times = few.measurement.columns["time"]
    assert (np.diff(times) > 0.0).all()
    gaps = np.flatnonzero(np.diff(np.flatnonzero(whole.usable)) > 1)
    before = whole.columns["time"][np.flatnonzero(whole.usable)[gaps]]
    for instant in before[:20]:
        assert times[times > instant].min() > instant + 2e-3, "a mean reaches into the clipped rows"


def test_sweeps_and_groups_stay_apart() -> None:
    whole = loops()
    few = reduced(whole).measurement
    assert few.segments.sweeps == whole.segments.sweeps
    assert set(np.unique(few.columns["pressure"])) == {1e5, 2e5, 4e5, 6e5}
    assert few.groups == whole.groups
    assert few.kind == whole.kind


def test_edges_of_a_transient_stay_where_they_are() -> None:
    rows, rise = 200_000, 0.02
    time = np.arange(rows) * 1e-3
    command = np.where((time // 5.0) % 2 == 1.0, 1.0, -1.0)
    since = time % 5.0
    up = 1.0 - np.exp(-since / rise)
    pressure = 5e5 * np.where(command > 0.0, up, 1.0 - up) * (time >= 5.0)
    columns = {
        "time": time, "command": command, "displacement": pressure * 1e-7,
        "pressure": pressure + 200.0 * RANDOM.standard_normal(rows),
    }  # fmt: skip
    few = reduced(build(columns, name="a.csv", id="0" * 64, kind="transient"))
    taken = few.measurement.columns
    assert set(np.unique(taken["command"])) == {-1.0, 1.0}, "no mean crosses an edge of the command"
    # The means lie on the true curve, also in the edge, where it changes by a third in 8 ms.
    since = taken["time"] % 5.0
    edge = (since < 5.0 * rise) & (taken["time"] > 5.0)
    assert np.count_nonzero(edge) > 30 * 39
    up = 1.0 - np.exp(-since / rise)
    true = 5e5 * np.where(taken["command"] > 0.0, up, 1.0 - up)
    error = (taken["pressure"] - true)[edge] / (200.0 / np.sqrt(few.counts[edge]))
    assert np.sqrt(np.mean(error**2)) < 1.5


def test_a_small_measurement_is_left_as_it_is() -> None:
    whole = loops(2000)
    few = reduced(whole)
    assert few.measurement is whole
    assert (few.counts == 1.0).all()
    assert few.message == ""


def test_it_says_what_was_done() -> None:
    few = reduced(loops())
    assert "all with the same weight, instead of 100000 rows" in few.message
    assert few.message in few.measurement.messages
    assert few.measurement.id != loops().id
