"""How long a large measurement takes: one million rows of four columns, from bytes to what a fit needs.

python -m pytest tests/benchmarks --benchmark-only
"""

from __future__ import annotations

import io

import numpy as np
import pytest
from nptdms import ChannelObject, TdmsWriter
from pytest_benchmark.fixture import BenchmarkFixture
from scipy.io import savemat

from mckibben.measurement.measurement import Measurement
from mckibben.measurement.motion import motion_of
from mckibben.measurement.reading import read_measurement
from mckibben.measurement.reduction import reduced
from mckibben.measurement.sweeps import sweeps_of

ROWS = 1_000_000


def loops() -> dict[str, np.ndarray]:
    """Fifty loops at 3 bar with noise, rounded as a logger does."""
    random = np.random.default_rng(1)
    phase = (np.arange(ROWS) / ROWS * 50) % 1.0
    stroke = np.where(phase < 0.5, 2.0 * phase, 2.0 - 2.0 * phase)
    return {
        "time_s": np.round(np.arange(ROWS) * 1e-3, 3),
        "pressure_bar": np.round(3.0 + 1e-3 * random.standard_normal(ROWS), 4),
        "length_mm": np.round(300.0 - 50.0 * stroke + 0.05 * random.standard_normal(ROWS), 3),
        "force_N": np.round(1000.0 - 800.0 * stroke + 3.0 * random.standard_normal(ROWS), 2),
    }


def csv() -> bytes:
    table = np.column_stack(list(loops().values()))
    lines = [f"{t:.3f},{p:.4f},{x:.3f},{force:.2f}" for t, p, x, force in table.tolist()]
    return "\n".join([",".join(loops()), *lines]).encode()


def mat() -> bytes:
    stream = io.BytesIO()
    savemat(stream, loops(), do_compression=True)
    return stream.getvalue()


def tdms() -> bytes:
    stream = io.BytesIO()
    with TdmsWriter(stream) as writer:
        writer.write_segment([ChannelObject("run", name, values) for name, values in loops().items()])
    return stream.getvalue()


@pytest.fixture(scope="module")
def large() -> Measurement:
    """The loops, read."""
    return read_measurement(mat(), "large.mat")


@pytest.mark.parametrize("make", [csv, mat, tdms])
def test_a_million_rows(benchmark: BenchmarkFixture, make) -> None:
    data, name = make(), f"large.{make.__name__}"
    result = benchmark.pedantic(read_measurement, args=(data, name), rounds=3, warmup_rounds=1)
    assert result.rows == ROWS


def test_its_segments(benchmark: BenchmarkFixture, large: Measurement) -> None:
    result = benchmark.pedantic(sweeps_of, args=(large.columns, large.kind), rounds=3)
    assert result.sweeps == 100


def test_its_velocities(benchmark: BenchmarkFixture, large: Measurement) -> None:
    result = benchmark.pedantic(motion_of, args=(large, 0.3), rounds=3)
    assert np.median(np.abs(result.velocity)) == pytest.approx(0.005, rel=0.01)


def test_its_reduction(benchmark: BenchmarkFixture, large: Measurement) -> None:
    result = benchmark.pedantic(reduced, args=(large,), rounds=3)
    assert result.counts.sum() == large.usable.sum()
