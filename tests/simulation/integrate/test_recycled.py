"""Memory that is used again, and only when nobody uses it any more."""

from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from mckibben.simulation.integrate import recycled as module
from mckibben.simulation.integrate.recycled import recycled

SHAPE = (40, 8, 512)  # 1.3 MB


@pytest.fixture(autouse=True)
def _nothing_kept(monkeypatch):
    monkeypatch.setattr(module, "_free", {})


def test_memory_comes_back_when_the_last_view_is_gone():
    first = recycled(*SHAPE)
    first[:] = 1.0
    address, view = first.ctypes.data, first[3].T[::2]
    assert address % 64 == 0
    del first
    other = recycled(*SHAPE)
    other[:] = 2.0
    assert not np.shares_memory(other, view)
    assert np.all(view == 1.0), "a view keeps its memory"
    del view
    assert recycled(*SHAPE).ctypes.data == address


def test_threads_never_share_memory():
    def work(number: int) -> bool:
        table = recycled(*SHAPE)
        table[:] = number
        return bool(np.all(table == number))

    with ThreadPoolExecutor(4) as pool:
        assert all(pool.map(work, range(200)))


def test_small_and_huge_arrays_are_ordinary():
    small, huge = recycled(3, 8), recycled(2**24, 1)
    assert small.shape == (3, 8)
    assert huge.shape == (2**24, 1)
    del small, huge
    assert recycled(2**15, 1).shape == (2**15, 1), "much smaller than what is free"
