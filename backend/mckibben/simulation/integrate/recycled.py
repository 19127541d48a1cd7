"""Large arrays whose memory is used again.

Memory that is new to a process comes zeroed from the system, page by page: the first write to it takes
several times as long as the next.
"""

from __future__ import annotations

import math

import numpy as np

from mckibben.simulation.integrate.lane_code import aligned

_LEAST, _MOST = 2**18, 2**26  # bytes; smaller arrays stay with malloc, larger ones with the system

# Memory that nothing refers to, by identity: a dict, because its methods need no lock.
_free: dict[int, np.ndarray] = {}


class _Loan:
    """The owner of an array's memory; when the last view of it is gone the memory is free again."""

    def __init__(self, memory: np.ndarray) -> None:
        self._memory = memory
        self.__array_interface__ = memory.__array_interface__

    def __del__(self) -> None:
        if self._memory.nbytes + sum(other.nbytes for other in _free.copy().values()) <= _MOST:
            _free[id(self._memory)] = self._memory


def recycled(*shape: int) -> np.ndarray:
    """An array of any content at an aligned address; at most 64 MB are kept for further calls."""
    size = math.prod(shape)
    if not _LEAST <= 8 * size <= _MOST:
        return aligned(*shape, zeros=False)
    for memory in sorted(_free.copy().values(), key=len):
        # Much larger memory is left to those that need it.
        if size <= len(memory) <= 2 * size and _free.pop(id(memory), None) is not None:
            break
    else:
        memory = aligned(size, zeros=False)
    return np.asarray(_Loan(memory))[:size].reshape(shape)
