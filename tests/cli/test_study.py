"""``mckibben study``: JSON, tables, files, one line for whatever is wrong."""

from __future__ import annotations

import json
from pathlib import Path

from mckibben.facts.study import WATCHED
from tests.application.study.test_study import STUDY
from tests.cli.conftest import Run, result_of, write


def test_a_study_gives_one_json_object_and_a_table(run: Run) -> None:
    code, out, err = run("study", write("study.json", STUDY), "--json", "--out", "table.csv")
    assert (code, out.count("\n"), err) == (0, 1, "table: table.csv\n")
    answer = result_of(out)
    assert answer["outcomes"] == {"completed": 20}
    assert len(Path("table.csv").read_text().splitlines()) == 21
    assert {item["figure"] for item in answer["summary"]} == set(STUDY["figures"])
    code, _, err = run("study", "study.json", "--out", "table.csv", "--resume")
    assert code == 2
    assert "nothing to resume" in err


def test_the_summary_has_statistics_and_probabilities(run: Run) -> None:
    study = STUDY | {"limits": [{"figure": "timing.extend.rise_time", "at_most": "1 s"}], "title": "Lift"}
    code, out, _ = run("study", write("study.json", study))
    assert code == 0
    assert "Lift: monte carlo, 20 runs" in out
    assert "100 % (83.2 … 100)" in out  # 0.025^(1/20)
    assert "Rank correlations" in out
    # Figures have their labels and units: the mean in ms is that of the result in s.
    code, text, _ = run("study", "study.json", "--json")
    assert code == 0
    mean = next(i["mean"]["value"] for i in result_of(text)["summary"] if i["figure"].endswith("rise_time"))
    row = next(line for line in out.splitlines() if WATCHED["timing.extend.rise_time"].label in line)
    assert f"{1e3 * mean:.4g}" in row.split()
    assert "ms" in row.split()
    assert "± (95 %)" in out


def test_what_is_wrong_is_one_line(run: Run) -> None:
    write("study.json", STUDY)
    for arguments, words in [
        (["none.json"], "none.json"),
        (["study.json", "--resume"], "--out"),
        (["study.json", "--out", "table.xls"], "not a known ending"),
        (["study.json", "--out", "no/table.csv"], "there is no folder"),
        ([write("bad.json", STUDY | {"method": {"type": "grid"}})], "bad.json: quantities.0.distribution"),
        ([write("broken.json", "{")], "mckibben: broken.json: line 1"),
    ]:
        code, out, err = run("study", *arguments)
        assert (code, out) == (2, "")
        assert words in err
        assert err.count("\n") == 1


def test_json_files_hold_the_whole_result(run: Run) -> None:
    code, _, _ = run("study", write("study.json", STUDY), "--out", "result.json")
    assert code == 0
    answer = json.loads(Path("result.json").read_text())
    assert answer["method"] == "monte_carlo"
    assert len(answer["table"]["run"]) == 20
