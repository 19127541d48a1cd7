"""The runs of a plan: chunks, threads, cancelling, and the journal."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mckibben.physics.errors import InputError
from mckibben.simulation.outcome import Outcome, Watch
from mckibben.studies.journal import Journal
from mckibben.studies.optimise import FigureGoal, OptimisationPlan
from mckibben.studies.plan import grid, listed, monte_carlo, robust
from mckibben.studies.run import in_threads, run_plan
from mckibben.studies.table import COMPLETED, Figure, Row, StudyTable
from mckibben.studies.variable import Variable, normal
from tests.studies.subjects import Y, ranged, rows_of, table_of

X = [ranged("x", -10.0, 10.0), ranged("y", 0.0, 1.0)]


def function(points: np.ndarray) -> np.ndarray:
    return np.column_stack([np.sin(points[:, 0]) * points[:, 1], points[:, 0] ** 2])


TWO = (*Y, Figure("z", "1"))
PLANS = [
    monte_carlo(X, 101, seed=1),
    OptimisationPlan(tuple(X), TWO, (FigureGoal("y"), FigureGoal("z")), (), 16, 5, 1),
]


def same(one: StudyTable, other: StudyTable) -> bool:
    return one.columns() == other.columns()


def test_grids_and_lists_in_order():
    a = Variable("a", "a", "1", np.array([1.0, 2.0]))
    b = Variable("b", "b", None, np.arange(3.0), ("p", "q", "r"))
    assert grid([a, b]).points.tolist() == [[1, 0], [1, 1], [1, 2], [2, 0], [2, 1], [2, 2]]
    assert listed([a, a]).points.tolist() == [[1, 1], [2, 2]]
    table = table_of(grid([a, b]), lambda p: p[:, :1])
    assert table.columns()["b"] == ["p", "q", "r", "p", "q", "r"]


@pytest.mark.parametrize("plan", PLANS, ids=["fixed", "optimisation"])
@pytest.mark.parametrize("chunk", [1, 7, 1000])
def test_the_table_does_not_depend_on_the_chunk(plan, chunk):
    assert same(table_of(plan, function, TWO, chunk=chunk), table_of(plan, function, TWO, chunk=64))


@pytest.mark.parametrize("plan", PLANS, ids=["fixed", "optimisation"])
def test_a_study_that_was_interrupted_gives_the_same_table(plan, tmp_path: Path):
    whole, path = table_of(plan, function, TWO), tmp_path / "study.journal"
    stop = len(whole.runs) // 2
    made = 0

    def slow(points: np.ndarray) -> list[Row]:
        nonlocal made
        made += len(points)
        return list(rows_of(function)(points))

    journal = Journal(path, "study 1", resume=False)
    table, outcome = run_plan(
        plan, TWO, in_threads(slow, 1), Watch(cancelled=lambda: made >= stop), chunk=5,
        finished=lambda runs, _, rows: journal.add_rows(runs, rows),
    )  # fmt: skip
    journal.close()
    assert outcome is Outcome.CANCELLED
    assert 0 < len(table.runs) < len(whole.runs)
    # A crash in the middle of a line.
    path.write_bytes(path.read_bytes()[:-9])
    made = 0
    with Journal(path, "study 1", resume=True) as journal:
        known = len(journal.known)
        table, outcome = run_plan(
            plan, TWO, in_threads(slow, 2), Watch(), chunk=11, known=journal.known,
            finished=lambda runs, _, rows: journal.add_rows(runs, rows),
        )  # fmt: skip
    assert outcome is Outcome.COMPLETED
    assert same(table, whole)
    assert known > 0
    assert made == len(whole.runs) - known
    with Journal(path, "study 1", resume=True) as journal:
        assert len(journal.known) == len(whole.runs)


def test_a_journal_keeps_missing_figures_and_messages(tmp_path: Path):
    path = tmp_path / "j"
    row = Row("stuck", (float("nan"), 1.0 / 3.0), "why; “quoted”\nline")
    with Journal(path, "a", resume=False) as journal:
        journal.add_rows([7], [row])
    with Journal(path, "a", resume=True) as journal:
        kept = journal.known[7]
    assert (kept.outcome, kept.message) == (row.outcome, row.message)
    assert np.isnan(kept.figures[0])
    assert kept.figures[1] == row.figures[1]


def test_journals_that_cannot_be_used(tmp_path: Path):
    path = tmp_path / "j"
    Journal(path, "a", resume=False).close()
    with pytest.raises(InputError, match="unfinished study") as found:
        Journal(path, "a", resume=False)
    assert "--resume" in str(found.value.hint)
    with pytest.raises(InputError, match="another study"):
        Journal(path, "b", resume=True)
    path.write_text(path.read_text() + '{"rows":[[1,2]]}\n')
    with pytest.raises(InputError, match="line 2 is damaged"):
        Journal(path, "a", resume=True)
    path.write_text("time,force\n1,2\n")
    with pytest.raises(InputError, match="not the journal"):
        Journal(path, "a", resume=True)
    with pytest.raises(InputError, match="cannot be written"):
        Journal(tmp_path / "none" / "j", "a", resume=False)


def test_progress_and_the_time_limit():
    shares: list[float] = []
    plan = monte_carlo(X, 40, seed=1)
    table, outcome = run_plan(
        plan, Y, in_threads(rows_of(lambda p: p[:, :1])), Watch(time_limit=-1.0, progress=shares.append)
    )
    assert outcome is Outcome.TIMED_OUT
    assert len(table.runs) == 0
    assert table.columns()["y"] == []


def test_every_design_gets_the_same_specimens():
    design = Variable("size", "size", "m", np.array([1.0, 2.0, 3.0]))
    spread = Variable("e", "e", "1", quantile=normal(mean=0.0, deviation=1.0), tolerance=True)
    plan = robust([design, spread], 30, seed=2)
    table = table_of(plan, lambda p: p[:, :1] + p[:, 1:])
    errors = table.points[:, 1].reshape(3, 30)
    assert (errors == errors[0]).all()
    assert table.points[:, 0].reshape(3, 30)[:, 0].tolist() == [1.0, 2.0, 3.0]
    assert set(table.outcomes) == {COMPLETED}
