"""What a sizing says is the least, the smallest, or not to be had: against a search of its own."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mckibben as mk
from mckibben.cli import run
from mckibben.resources import presets_folder

TASK: dict[str, Any] = json.loads((presets_folder() / "tasks" / "lift-20kg.json").read_text())["document"]
ONE = {"muscles": ["DMSP-20"], "valves": ["MPYE-5-1/8-HF"], "tubes": ["PUN-H-6x1"], "tube_length": "1 m"}


def sized(**changes: Any) -> Any:
    return mk.size({**TASK, "uncertainty": {"specimens": 0}, **changes})


def test_the_least_air_is_that_of_a_brute_force_search() -> None:
    """Every drive of a grid is run by itself: none that fulfils the task takes less air, to 2 %."""
    found = sized(catalogue=ONE, rank_by="air", limits={**TASK["limits"], "max_parallel": 1}).proposals[0]
    assert found.drive.run().supplied_volume_anr == pytest.approx(found.air_volume_anr, rel=1e-3)
    least = np.inf
    for length in np.arange(0.44, 0.601, 0.02):
        drive = found.drive.changed(
            muscle={"preset": "DMSP-20", "nominal_length": float(length)},
            stops={"min_contraction": 0.0, "max_contraction": 0.06 / float(length)},
        )
        for pressure in np.arange(2.4e5, 3.4e5, 0.04e5):
            strokes = length - np.linspace(0.0, 0.06, 25)
            pull = drive.model.force(pressure=float(pressure), length=strokes, direction=-1.0)
            if np.min(pull) < 1.1 * 20.0 * 9.80665:
                continue
            run = drive.changed(supply=float(pressure)).run(points=201)
            fill = run.timing.extend
            if fill.state == "arrived_and_held" and fill.positioning_time <= 0.5:
                least = min(least, run.supplied_volume_anr)
            break  # a higher pressure takes more air
    assert 0.001 < least < 0.0012
    assert found.air_volume_anr <= 1.02 * least


def test_a_remedy_is_the_smallest_that_works_and_works() -> None:
    limits = {**TASK["limits"], "max_parallel": 1}
    one = {**ONE, "muscles": ["DMSP-10"]}
    refused = sized(catalogue=one, limits=limits)
    assert not refused.proposals
    text = refused.rejected[0].would_work_if
    bar, millimetres = (float(re.search(rf"([0-9.]+) {unit}", text)[1]) for unit in ("bar", "mm long"))  # type: ignore[index]

    def enough(**changes: Any) -> bool:
        other = sized(catalogue=one, **{"limits": limits, **changes})
        return not any(each.binding in ("force", "pressure", "length") for each in other.rejected)

    assert enough(supply_pressure=f"{bar} bar")
    assert not enough(supply_pressure=f"{bar - 0.02} bar")
    assert enough(limits={**limits, "max_length": f"{millimetres} mm"})
    assert not enough(limits={**limits, "max_length": f"{millimetres - 2} mm"})


def test_a_remedy_that_carries_the_load_is_quick_enough_or_says_how_slow_it_is() -> None:
    """A stroke of 200 mm in 0.5 s, with more room than there is: each remedy is made a task of its own."""
    parts = {**ONE, "muscles": ["DMSP-40"], "tubes": ["PUN-H-8x1.25"]}

    def of_stroke(**changes: Any) -> Any:
        return sized(catalogue=parts, stroke="200 mm", **changes)

    refused = of_stroke().rejected
    assert {(each.muscle, each.parallel) for each in refused} == {("DMSP-40", 1), ("DMSP-40", 2)}
    slower = 0
    for each in refused:
        assert each.why.startswith(("one ", "2 × ")), "the sentence has its subject"
        length = re.match(r"(\d+) mm long", each.would_work_if)
        late = re.match(r".*, and ([\d.]+) times the time allowed", each.would_work_if)
        assert length, each.would_work_if
        limits, time = (
            {**TASK["limits"], "max_length": f"{length[1]} mm"},
            0.5 * float(late[1] if late else 1.0),
        )

        def found(
            who: tuple[str, int] = (each.muscle, each.parallel), limits: Any = limits, **changes: Any
        ) -> bool:
            proposals = of_stroke(limits=limits, max_proposals=20, **changes).proposals
            return who in {(one.muscle, one.parallel) for one in proposals}

        assert found(time=time)
        slower += late is not None
        assert late is None or not found(time=0.97 * time)
    assert slower == 1  # two DMSP-40 share a valve


def test_no_drive_is_an_answer_with_an_exit_code_of_its_own(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / "task.json"
    file.write_text(json.dumps({**TASK, "time": "20 ms", "uncertainty": {"specimens": 0}}))
    assert run(["size", str(file), "--json"]) == 3
    answer = json.loads(capsys.readouterr().out)
    assert answer["proposals"] == []
    assert answer["rejected"]


def test_the_domain_of_the_search_is_said() -> None:
    found = sized(catalogue=ONE)
    assert "1 muscle, 1 valve, 1 tube" in found.searched
    assert f"{found.combinations} combinations" in found.searched
    assert "the least air of these" in " ".join(each.reason for each in found.proposals)
