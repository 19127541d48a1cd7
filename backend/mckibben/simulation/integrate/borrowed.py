"""Arrays in compiled code without a count of their references.

numba counts references to an array with atomic instructions, at every unpacking of a tuple and every call.
In a kernel that took a sixth of the time. The arrays of a kernel live as long as its call.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from llvmlite import ir
from numba import njit, types
from numba.extending import intrinsic
from numba.np.numpy_support import carray


def _pointer(_typing: Any, _address: Any) -> Any:
    """``pointer_at(address)``, for numba's ``carray``."""

    def generate(_context: Any, builder: Any, _signature: Any, args: Any) -> Any:
        return builder.inttoptr(args[0], ir.IntType(8).as_pointer())

    return types.voidptr(types.uintp), generate


pointer_at: Any = intrinsic(_pointer)


@njit(inline="always")
def borrowed(array: np.ndarray) -> np.ndarray:
    """The same contiguous array, without a count of its references."""
    return carray(pointer_at(array.ctypes.data), array.shape, array.dtype)
