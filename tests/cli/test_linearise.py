"""``mckibben linearise``: JSON, tables, one line for whatever is wrong."""

from __future__ import annotations

import json
import re

import pytest

from tests.cli.conftest import Run, write
from tests.simulation.linear.drives import DOCUMENTS


def test_a_document_gives_one_json_object(run: Run) -> None:
    path = write("lift.json", DOCUMENTS["regulator"])
    code, out, _ = run("linearise", path, "--at", "position 30 mm", "--amplitudes", "none", "--json")
    assert code == 0
    answer = json.loads(out)
    assert answer["point"]["position"] == pytest.approx(0.03)
    assert answer["describing"] == []
    assert [state["name"] for state in answer["models"][0]["states"]][:2] == ["stroke", "speed"]


@pytest.mark.examination("test_a_document_gives_one_json_object")
def test_the_tables_show_point_poles_loop_and_design(run: Run) -> None:
    goals = "overshoot 10 %, settling 2 s, step 3 mm"
    code, out, err = run("linearise", "paper-pid-triangle", "--amplitudes", "10 %", "--design", goals)
    assert code == 0
    for words in ("operating point", "sliding shorter", "Poles and zeros", "Phase margin", "refined", "own"):
        assert words in out
    assert "amplitude 10 %" in out
    # The drive's own controller as its document states it.
    assert re.search(r"Proportional gain +0\.3 %/mm", out)
    assert "not in the model: friction" in err
    assert "Tyreus and Luyben" in err


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("propneu-20", "--at", "position 4 m"), "propneu-20: --at: 4000 mm is not between"),
        (("propneu-20", "--at", "depth 4 mm"), "--at 'depth 4 mm' states no operating point"),
        (("propneu-20", "--input", "comand"), "Did you mean 'command'?"),
        (("propneu-20", "--design", "overshot 4 %"), "Did you mean 'overshoot'?"),
        (("propneu-20", "--amplitudes", "3 bar"), "--amplitudes"),
        (("propneu-20", "--sliding-speed", "0 m/s"), "--sliding-speed"),
        (("propneu-2O",), "propneu-2O"),
    ],
)
def test_bad_input_is_one_line(run: Run, arguments: tuple[str, ...], words: str) -> None:
    code, out, err = run("linearise", *arguments)
    assert (code, out) == (2, "")
    assert words in err
    assert len(err.strip().splitlines()) == 1
