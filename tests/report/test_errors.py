"""The map of the residual by measured level, against sums done by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest

from mckibben.application.compare.series import ComparedSeries
from mckibben.report.diagnosis.errors import level_map

NOISE = 0.01  # N
LEVELS = (2e5, 1e5, 4e5)
ROWS = 64


def sweep(level: float, loss: float, *, use: str = "fit", channel: str = "force") -> ComparedSeries:
    """There and back at a pressure: residual = level in bar + 10 contraction + loss * direction [N]."""
    contraction = np.concatenate([np.linspace(0.0, 0.16, ROWS), np.linspace(0.16, 0.0, ROWS)])
    direction = np.repeat([-1.0, 1.0], ROWS)
    unknown = np.full(2 * ROWS, np.nan)
    residual = level / 1e5 + 10.0 * contraction + loss * direction
    return ComparedSeries(
        label="", channel=channel, unit="N", use=use, pressure=level, time=None, contraction=contraction,
        length=0.3 * (1.0 - contraction), x_pressure=np.full(2 * ROWS, level), velocity=unknown,
        direction=direction, measured=residual, predicted=0.0 * residual, residual=residual,
    )  # fmt: skip


def test_each_level_is_a_row_and_directions_part_where_friction_is() -> None:
    for loss in (0.0, 3.0):
        found = level_map([sweep(level, loss) for level in LEVELS], NOISE)
        assert found is not None
        assert [row.level for row in found.rows] == sorted(LEVELS)
        assert found.split is (loss > 0.0)
        edges = np.linspace(0.0, 0.16, 9)
        assert found.x_edges == pytest.approx(edges)
        for row in found.rows:
            # 64 rows in 8 columns: the mean of each is the middle of its own 8 rows.
            middle = np.linspace(0.0, 0.16, ROWS).reshape(8, 8).mean(axis=1)
            base = row.level / 1e5 + 10.0 * middle
            assert row.mean == pytest.approx(base)
            assert row.lengthening == pytest.approx(base + loss)
            assert row.shortening == pytest.approx(base - loss)
        assert found.largest == pytest.approx(4.0 + 10.0 * middle[-1] + loss)


def test_levels_of_one_pressure_are_one_row_and_other_data_have_no_map() -> None:
    twice = level_map([sweep(2e5, 0.0), sweep(2.01e5, 0.0), sweep(3e5, 0.0, use="validation")], NOISE)
    assert twice is not None
    assert [row.level for row in twice.rows] == [2e5]
    assert level_map([sweep(1e5, 0.0), sweep(math.nan, 0.0, channel="pressure")], NOISE) is None
    assert level_map([sweep((1 + k) * 1e5, 0.0) for k in range(15)], NOISE) is None
