"""Equations are compiled by one thread at a time.

Two compilations side by side give other machine code than one alone, and the results of a run then differ in
their last digits.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from functools import update_wrapper
from typing import ParamSpec, TypeVar

P = ParamSpec("P")
T = TypeVar("T")

#: Held while equations are compiled; a compilation may begin another one.
COMPILING = threading.RLock()


def one_at_a_time(function: Callable[P, T]) -> Callable[P, T]:
    """The function of `functools.lru_cache`, called by one thread at a time: nothing is compiled twice."""

    def alone(*args: P.args, **kwargs: P.kwargs) -> T:
        with COMPILING:
            return function(*args, **kwargs)

    update_wrapper(alone, function)
    alone.__wrapped__ = getattr(function, "__wrapped__", function)  # type: ignore
    return alone
