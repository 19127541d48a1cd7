"""A run of the model that stops early: said, and no figure is made of what it did not reach."""

from __future__ import annotations

import re

import numpy as np
import pytest

from tests.cli.conftest import Run, result_of, write
from tests.stopping import ROWS, SECONDS, STEPS, record, stop_runs

STATED = ("--muscle", "hand-made", "--rest-length", "400 mm", "--load", "5 kg")
STOPPED = re.compile(rf"stopped at [0-9.]+ of {SECONDS:.0f} s: the solver needed more than {STEPS} steps")


def rows_of(answer: dict) -> dict[str, np.ndarray]:
    """Time, measured, predicted and residual of all rows of an answer."""
    return {
        name: np.concatenate([series[name] for series in answer["series"]])
        for name in ("time", "measured", "predicted", "residual")
    }


def test_the_error_is_of_the_rows_that_ran(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    name = write("record.csv", record())
    whole = result_of(run("compare", name, *STATED, "--json")[1])
    assert whole["stopped"] == []
    stop_runs(monkeypatch)
    code, out, _ = run("compare", name, *STATED, "--json")
    assert code == 0
    answer = result_of(out)
    (stopped,) = answer["stopped"]
    used = answer["rows_used"]
    assert 3 < used < ROWS
    assert stopped["share"] == pytest.approx(1.0 - used / ROWS)
    assert answer["excluded"]["after the run of the model stopped"] == ROWS - used
    assert used + sum(answer["excluded"].values()) == answer["rows"]
    all_rows, shown = rows_of(whole), rows_of(answer)
    for column, values in shown.items():
        assert values == pytest.approx(all_rows[column][:used], rel=1e-9, abs=1e-12)
    assert answer["rmse"] == pytest.approx(np.sqrt(np.mean(all_rows["residual"][:used] ** 2)))
    assert STOPPED.search(answer["sentences"][0])
    assert f"{100.0 * stopped['share']:.0f} % of the rows were not reached" in answer["sentences"][0]


def test_the_table_says_it(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    stop_runs(monkeypatch)
    code, out, err = run("compare", write("record.csv", record()), *STATED)
    assert code == 0
    assert STOPPED.search(" ".join(err.split()))
    assert "after the run of the model stopped" in " ".join(out.split()), "beside the error"


def test_no_diagnosis_is_made_of_a_part_of_a_run(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """Neither an entry nor an effect is doubted for rows that the model did not reach."""
    stop_runs(monkeypatch)
    name = write("record.csv", record())
    code, out, err = run("diagnose", name, *STATED)
    assert code != 0
    said = " ".join((out + err).split())
    assert "no diagnosis can be made" in said
    assert STOPPED.search(said)
    assert "--use" not in said
    assert "probability" not in said
