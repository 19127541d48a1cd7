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
