"""What a run is said to do: impacts, sticking and breaking away, in words, with instants."""

from __future__ import annotations

import pytest

from mckibben.application.run.simulate import SimulationQuestion, simulate
from mckibben.documents.drive_reading import drive_of, read_document
from mckibben.facts.run import EVENTS
from mckibben.report.summary.simulation import summary_of
from tests.shipped import shipped_studio
from tests.simulation.drive.test_dry_friction import held


def answer(document: dict):
    annotated = drive_of(read_document(document, "the drive"), shipped_studio())
    return simulate(SimulationQuestion(annotated))


def test_sticking_and_breaking_away_are_events_with_their_instants() -> None:
    result = answer(held())
    kinds = [event.kind for event in result.events]
    assert kinds[-4:] == ["breaks_away_down", "sticks", "breaks_away_up", "sticks"]
    assert "turns_down" in kinds
    assert "hits_low" not in kinds
    assert [event.text for event in result.events] == [EVENTS[kind] for kind in kinds]
    # It is pulled from 10 s on, hardest at 12 s, and let go until 14 s.
    times = [event.time for event in result.events[-4:]]
    assert 10.0 < times[0] < 12.0 < times[1] < times[2] < times[3] < 14.3
    for event in result.events[-4:]:
        assert event.speed == pytest.approx(0.0, abs=1e-5)
    stuck = result.stuck & (result.time > 14.3)
    assert stuck.sum() == (result.time > 14.3).sum()
    assert not result.stuck[(result.time > 11.0) & (result.time < 12.0)].any()


def test_a_load_that_friction_holds_says_how_much_it_still_takes() -> None:
    result = answer(held())
    assert result.rest is not None
    # 50 N each way: what is left on one side is used on the other.
    up, down = (float(word) for word in result.rest.split() if word[0].isdigit())
    assert up + down == pytest.approx(100.0, abs=0.1)
    assert float(result.friction[-1]) == pytest.approx(0.5 * (up - down), abs=0.1)
    lines = summary_of(result, "lift")
    assert any(isinstance(line, str) and result.rest in line for line in lines)


def test_without_dry_friction_nothing_sticks() -> None:
    document = held(duration="4 s")
    del document["effects"]["coulomb_friction"]
    result = answer(document)
    assert result.rest is None
    assert not result.stuck.any()
    assert {event.kind for event in result.events} <= {"goes_taut", "goes_slack", "leaves_low", "hits_high"}
