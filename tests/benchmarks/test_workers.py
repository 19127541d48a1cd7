"""An examination that is interrupted goes on where it was."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.benchmarks import workers
from tests.benchmarks.workers import Examined, examined, other_code


@pytest.fixture(autouse=True)
def alone(monkeypatch: pytest.MonkeyPatch) -> None:
    """In this process, without catalogues."""
    monkeypatch.setenv("MCKIBBEN_PROCESSES", "1")
    monkeypatch.setattr(workers, "own_studio", lambda: None)


def test_what_a_file_keeps_is_not_done_again(tmp_path: Path) -> None:
    asked: list[int] = []

    def work(item: int) -> int:
        asked.append(item)
        if item == 3 and len(asked) == 3:
            raise KeyboardInterrupt
        return item**2

    keep = tmp_path / "done"
    with pytest.raises(KeyboardInterrupt):
        list(examined(work, [1, 2, 3], keep=keep))
    again = list(examined(work, [1, 2, 3], keep=keep))
    assert {one.key: one.result for one in again} == {"1": 1, "2": 4, "3": 9}
    assert asked == [1, 2, 3, 3]
    assert all(one.seconds >= 0.0 for one in again)


def test_cases_of_another_program_are_told() -> None:
    same = Examined("a", 1, 0.1, workers.code_hash())
    assert other_code([same]) == ""
    assert "1 cases" in other_code([same, Examined("b", 1, 0.1, "of yesterday")])
