"""Studies from Python: the same results as the command line, as text, HTML, frame and figure."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import mckibben as mk
from mckibben.door.study import Study
from tests.application.study.test_study import SHORT, STUDY

GOALS = [
    {"figure": "timing.extend.rise_time"},
    {"figure": "timing.extend.impact_energy", "direction": "maximise"},
]


@pytest.fixture(scope="module")
def monte_carlo() -> Study:
    return mk.study(STUDY | {"title": "Lift"})


def test_it_prints_shows_and_has_a_frame(monte_carlo: Study) -> None:
    assert "Lift: monte carlo, 20 runs" in str(monte_carlo)
    assert "<table" in monte_carlo._repr_html_()
    frame = monte_carlo.to_frame()
    assert len(frame) == 20
    assert list(frame.columns)[:3] == ["run", "load.mass", "supply.pressure"]
    assert frame["load.mass"].std() == pytest.approx(1.0, rel=0.5)
    assert monte_carlo.to_dict()["outcomes"] == {"completed": 20}
    assert monte_carlo.messages == ()


def test_a_run_can_be_repeated_alone(monte_carlo: Study) -> None:
    alone = monte_carlo.drive(7).run().timing.extend.rise_time
    assert monte_carlo.to_frame()["timing.extend.rise_time"][7] == pytest.approx(alone, rel=1e-4)
    with pytest.raises(mk.Problem, match="no run 20"):
        monte_carlo.drive(20)


def test_each_method_has_its_figure(monte_carlo: Study) -> None:
    histogram = monte_carlo.plot()
    assert histogram.data[0].type == "histogram"
    assert len(histogram.layout.shapes) == 3
    ranges = [{"path": "load.mass", "from": "8 kg", "to": "12 kg", "points": 4}, STUDY["quantities"][1]]
    front = mk.study(
        STUDY | {"quantities": ranges, "goals": GOALS, "method": {"type": "latin_hypercube", "runs": 12}}
    )
    assert 1 < len(front.front) <= 12
    assert [trace.name for trace in front.plot().data] == ["runs", "Pareto front"]
    assert len(front.plot().data[1].x) == len(front.front)
    bars = mk.study(STUDY | {"quantities": ranges, "method": {"type": "sobol", "samples": 8}}).plot()
    assert [trace.name for trace in bars.data] == ["with all interactions", "alone"]


def test_files_and_progress(tmp_path: Path, monte_carlo: Study) -> None:
    (tmp_path / "drive.json").write_text(json.dumps(SHORT))
    (tmp_path / "study.json").write_text(json.dumps(STUDY | {"subject": {"drive": "drive.json"}}))
    again = mk.study(tmp_path / "study.json", out=tmp_path / "t.csv")
    assert again.to_frame().equals(monte_carlo.to_frame())
    monte_carlo.save(tmp_path / "saved.csv")
    assert (tmp_path / "saved.csv").read_bytes() == (tmp_path / "t.csv").read_bytes()
    with pytest.raises(mk.Problem, match=r"quantities\.0\.path"):
        mk.study(STUDY | {"quantities": [{"path": "load.mas", "values": [1]}]})
