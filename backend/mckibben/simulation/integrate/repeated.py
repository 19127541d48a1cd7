"""A compiled function called many times without Python in between."""

from __future__ import annotations

import numpy as np
from numba import njit

from mckibben.simulation.integrate import switching
from mckibben.simulation.integrate.stamp import stamped_with
from mckibben.simulation.integrate.switching import call


@njit("void(int64,float64[:,:,::1],float64[:,:,::1])", error_model="numpy", cache=True, nogil=True)
@stamped_with(switching)
def call_blocks(address: int, given: np.ndarray, results: np.ndarray) -> None:
    """Call the function at an address for each block of arguments.

    Args:
        given: arguments, shape (blocks, size, lanes); lanes = 1 for a function of single numbers.
        results: written, shape (blocks, width, lanes).
    """
    for block in range(given.shape[0]):
        call(address, results[block].ctypes.data, given[block].ctypes.data)
