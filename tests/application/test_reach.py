"""How far the runs of a compared model came."""

from __future__ import annotations

import pytest

from mckibben.application.compare.reach import reach_of
from mckibben.identification.predict.predictor import StoppedRun


def test_without_a_stop_all_rows_are_reached() -> None:
    found = reach_of([])
    assert (found.status, found.reason, found.until, found.share) == ("complete", None, None, 1.0)


@pytest.mark.parametrize(
    ("reached", "lost", "status", "until"),
    [(59.0, 0.18, "partial", 59.0), (float("nan"), 1.0, "failed", 0.0)],
)
def test_a_stop_says_where_and_how_much_is_left(
    reached: float, lost: float, status: str, until: float
) -> None:
    found = reach_of([StoppedRun("", 0, reached, 72.0, lost, "the steps are used up")])
    assert (found.status, found.reason, found.until) == (status, "the steps are used up", until)
    assert found.share == pytest.approx(1.0 - lost)
