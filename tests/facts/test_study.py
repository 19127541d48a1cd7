"""Every figure that a study can watch is declared, and two of one name say what differs."""

from __future__ import annotations

from mckibben.application.size.size import ProposedDrive
from mckibben.application.study.subject import TASK_FIGURES
from mckibben.facts.result import described
from mckibben.facts.study import BEST, WATCHED
from mckibben.studies.drive_runs import DRIVE_FIGURES


def test_what_can_be_watched_is_of_a_drive_or_of_a_task() -> None:
    assert not set(DRIVE_FIGURES) & set(TASK_FIGURES)
    assert set(DRIVE_FIGURES) | set(TASK_FIGURES) == set(WATCHED)


def test_figures_of_proposals_are_those_of_the_result() -> None:
    fields = described(ProposedDrive)
    for name in BEST:
        assert WATCHED[f"best.{name}"].unit == fields[name].unit, name


def test_no_two_watched_figures_have_one_label() -> None:
    for figures in (DRIVE_FIGURES, TASK_FIGURES):
        labels = [WATCHED[path].label for path in figures]
        assert len(set(labels)) == len(labels), labels
    # The air that each phase takes and lets out, and that of a cycle.
    air = {WATCHED[path].label for path in WATCHED if path.endswith("volume_anr")}
    assert len(air) == 5
