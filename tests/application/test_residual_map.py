"""The map of the residual by measured level, against sums done by hand."""

from __future__ import annotations

import numpy as np
import pytest

from mckibben.application.compare.residual_map import ResidualMap, level_map
from mckibben.application.compare.series import KnownInputs

NOISE = 0.01  # N
LEVELS = (2e5, 1e5, 4e5)
ROWS = 64


def mapped(levels: tuple[float, ...], loss: float = 0.0, noise: float | None = NOISE) -> ResidualMap | None:
    """There and back at each pressure: residual = level in bar + 10 contraction + loss * direction [N]."""
    once = np.concatenate([np.linspace(0.0, 0.16, ROWS), np.linspace(0.16, 0.0, ROWS)])
    contraction = np.tile(once, len(levels))
    direction = np.tile(np.repeat([-1.0, 1.0], ROWS), len(levels))
    pressure = np.repeat(levels, 2 * ROWS)
    known = KnownInputs(
        time=None, length=0.3 * (1.0 - contraction), contraction=contraction, pressure=pressure,
        velocity=np.full(len(pressure), np.nan), direction=direction,
    )  # fmt: skip
    groups = np.repeat(np.arange(len(levels)), 2 * ROWS)
    return level_map(known, groups, pressure / 1e5 + 10.0 * contraction + loss * direction, noise=noise)


def test_each_level_is_a_row_and_directions_part_where_friction_is() -> None:
    # 64 rows in 8 columns: the mean of each is the middle of its own 8 rows.
    eighths = np.linspace(0.0, 0.16, ROWS).reshape(8, 8)
    middle = eighths.mean(axis=1)
    for loss in (0.0, 3.0):
        found = mapped(LEVELS, loss)
        assert found is not None
        assert [row.level for row in found.rows] == sorted(LEVELS, reverse=True)
        assert found.split is (loss > 0.0)
        assert found.edges == pytest.approx(np.linspace(0.0, 0.16, 9))
        for row in found.rows:
            assert (row.low, row.high, row.channel, row.within_noise) == (row.level, row.level, None, False)
            base = row.low / 1e5 + 10.0 * middle
            cells = [cell for cell in row.cells if cell is not None]
            assert [cell.count for cell in cells] == [16] * 8
            assert [cell.mean for cell in cells] == pytest.approx(base)
            assert [cell.lengthening for cell in cells] == pytest.approx(base + loss)
            assert [cell.shortening for cell in cells] == pytest.approx(base - loss)
            squares = [np.mean((row.low / 1e5 + 10.0 * part) ** 2) + loss**2 for part in eighths]
            assert [cell.rms for cell in cells] == pytest.approx(np.sqrt(squares))
        assert found.largest == pytest.approx(4.0 + 10.0 * middle[-1] + loss)


def test_a_row_of_noise_is_known_as_such() -> None:
    quiet, loud = mapped(LEVELS, noise=10.0), mapped(LEVELS, noise=None)
    assert quiet is not None
    assert loud is not None
    assert [row.within_noise for row in quiet.rows] == [True] * 3
    assert [row.within_noise for row in loud.rows] == [False] * 3


def test_levels_of_one_pressure_are_one_row_and_other_data_have_no_levels() -> None:
    twice = mapped((2e5, 2.01e5))
    assert twice is not None
    assert [(row.level, row.low, row.high) for row in twice.rows] == [(2e5, 2e5, 2.01e5)]
    assert mapped((1e5, np.nan)) is None
    assert mapped(tuple((1 + k) * 1e5 for k in range(15))) is None
