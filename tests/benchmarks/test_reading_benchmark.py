"""How long a large measurement file takes to read: one million rows of four columns.

python -m pytest tests/benchmarks --benchmark-only
"""

from __future__ import annotations

from pytest_benchmark.fixture import BenchmarkFixture

from mckibben.identification.read import read_measurement

ROW = b"0.00001,1.2345,250.1234,123.456\n2.00001,1.3345,251.1234,223.456\n"


def test_a_million_rows(benchmark: BenchmarkFixture) -> None:
    data = b"time_s,pressure_bar,length_mm,force_N\n" + ROW * 500_000
    result = benchmark.pedantic(read_measurement, args=(data, "large.csv"), rounds=3, warmup_rounds=1)
    assert result.rows == 1_000_000
