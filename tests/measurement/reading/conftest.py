"""Readers are tested in the process of the test: a copy of it for each of thousands of files takes a minute.

`test_process.py` tests the copy and its limits, through which server, command line and Python door read.
"""

from __future__ import annotations

from collections.abc import Callable

import pytest

from mckibben.measurement import reading


def _in_place(work: Callable[[], object], name: str, load: Callable[[], object], *, size: int) -> object:
    return work()


@pytest.fixture(autouse=True)
def reading_in_place(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    if request.path.name != "test_process.py":
        monkeypatch.setattr(reading, "bounded", _in_place)
