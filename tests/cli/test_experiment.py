"""The experiment on the command line: contradictions, assumptions, --strict, several specimens."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from mckibben.application.compare.compare import ComparisonResult
from mckibben.application.diagnose.result import DiagnosisResult
from tests.application.truths import document, plateaus, specimen
from tests.cli.conftest import Run, result_of
from tests.server.answers import valid


@pytest.fixture
def files(run: Run) -> dict[str, str]:
    """Specimens of 250 and 400 mm whose files say so, and one that does not say that it is 250 mm long."""
    del run  # changes into the folder of the test
    texts = {
        "a.csv": specimen(0.25, seed=1),
        "b.csv": specimen(0.4, seed=2),
        "silent.csv": specimen(0.25, seed=1, said=False),
        "m.json": json.dumps(document()),
        "long.json": json.dumps(document(0.451)),
    }
    for name, text in texts.items():
        Path(name).write_text(text, encoding="utf-8")
    return texts


@pytest.mark.parametrize("command", ["compare", "diagnose"])
@pytest.mark.parametrize("muscle", ["DMSP-20:451mm", "long.json"])
def test_a_file_and_a_muscle_of_different_lengths_are_a_conflict(
    run: Run, files: dict[str, str], command: str, muscle: str
) -> None:
    code, out, err = run(command, "a.csv", "--muscle", muscle, "--ideal")
    assert (code, out) == (2, "")
    assert len(err.strip().splitlines()) == 1
    for word in ("a.csv", "250 mm", "451 mm", muscle, "--rest-length", "line 1"):
        assert word in err


def test_the_option_decides_the_conflict(run: Run, files: dict[str, str]) -> None:
    for length, value in (("250 mm", 0.25), ("451 mm", 0.451), ("0.26 m", 0.26)):
        code, out, err = run(
            "compare", "a.csv", "--muscle", "DMSP-20:451mm", "--ideal", "--rest-length", length, "--json"
        )
        assert code == 0, err
        rest = json.loads(out)["experiment"]["rest_length"]
        assert rest == {"value": pytest.approx(value), "unit": "m", "origin": "you", "where": "--rest-length"}
        assert json.loads(out)["geometry"]["nominal_length"] == pytest.approx(value)


def test_a_fitted_length_is_no_conflict(run: Run, files: dict[str, str]) -> None:
    """A fit moves a length by up to 2 %; its model goes back into a comparison, and both lengths are said."""
    code, out, err = run("compare", "a.csv", "--muscle", "DMSP-20:253mm", "--ideal", "--json")
    assert code == 0, err
    answer = json.loads(out)
    assert answer["experiment"]["rest_length"]["value"] == pytest.approx(0.253)
    assert "250 mm" in answer["messages"][0]
    assert "253 mm" in answer["messages"][0]


@pytest.mark.parametrize("muscle", ["DMSP-20", "m.json"])
def test_the_default_length_of_a_preset_is_not_said(run: Run, files: dict[str, str], muscle: str) -> None:
    code, out, err = run("compare", "a.csv", "--muscle", muscle, "--ideal", "--json")
    assert code == 0, err
    answer = json.loads(out)
    assert answer["experiment"]["rest_length"]["origin"] == "file"
    assert answer["geometry"]["nominal_length"] == pytest.approx(0.25)
    assert answer["assumptions"] == []


@pytest.mark.examination("test_strict_refuses_what_would_be_assumed")
def test_an_answer_begins_with_what_it_assumes(run: Run, files: dict[str, str]) -> None:
    code, out, err = run("diagnose", "silent.csv", "--muscle", "DMSP-20", "--ideal", "--json")
    assert code == 0, err
    answer = valid(DiagnosisResult, result_of(out))
    assert answer.messages[0] == (
        "assuming a rest length of 300 mm, the preset's: --rest-length says otherwise"
    )
    assert answer.assumptions == answer.messages[:1]
    assert answer.verdict.sentence.startswith("Assuming a rest length of 300 mm, the preset's. ")
    rest = answer.experiment["rest_length"]
    assert (rest.origin, rest.where) == ("assumed", "the preset DMSP-20")
    code, out, err = run("compare", "silent.csv", "--muscle", "DMSP-20", "--ideal")
    assert code == 0
    assert err.index("assuming a rest length of 300 mm") < err.index("grouped by")


def test_strict_refuses_what_would_be_assumed(run: Run, files: dict[str, str]) -> None:
    code, out, err = run("compare", "silent.csv", "--muscle", "DMSP-20", "--strict")
    assert (code, out) == (2, "")
    assert "silent.csv" in err
    assert "--rest-length" in err
    code, _, err = run("compare", "silent.csv", "--muscle", "DMSP-20", "--strict", "--rest-length", "250 mm")
    assert code == 0, err
    Path("p.csv").write_text(plateaus(np.zeros(5)), encoding="utf-8")
    code, out, err = run("compare", "p.csv", "--muscle", "m.json", "--strict")
    assert (code, out) == (2, "")
    assert "--accuracy" in err
    accuracy = ("--accuracy", "steel rule, force load cell, pressure 10 mbar")
    code, out, err = run("compare", "p.csv", "--muscle", "m.json", "--strict", *accuracy, "--json")
    assert code == 0, err
    told = valid(ComparisonResult, result_of(out)).experiment
    assert {name: told[name].origin for name in told if name.startswith("accuracy_")} == dict.fromkeys(
        ("accuracy_length", "accuracy_force", "accuracy_pressure"), "you"
    )


def test_a_list_states_the_experiment_of_each_file(run: Run, files: dict[str, str]) -> None:
    Path("sub").mkdir()
    Path("sub/silent.csv").write_text(files["silent.csv"], encoding="utf-8")
    Path("sub/list.json").write_text(
        json.dumps(
            [
                {"file": "silent.csv", "rest_length": "250 mm", "force_zero": "2 N"},
                {"file": "b.csv", "accuracy": {"value": "length caliper", "origin": "preset"}},
            ]
        ),
        encoding="utf-8",
    )
    code, out, err = run("compare", "sub/list.json", "--muscle", "m.json", "--json")
    assert code == 0, err
    first, second = json.loads(out)["specimens"]
    assert first["experiment"]["rest_length"]["where"] == "sub/list.json"
    assert first["experiment"]["force_zero"]["value"] == 2.0
    assert second["experiment"]["rest_length"]["origin"] == "file"
    assert second["experiment"]["accuracy_length"]["origin"] == "preset"


@pytest.mark.parametrize(
    ("entries", "words"),
    [
        ([], ["no list of measurements"]),
        ([{"rest_length": "250 mm"}], ["entry 1 names no file"]),
        (
            [{"file": "a.csv", "rest_lenght": "1 m"}],
            ["entry 1", "rest_lenght", "Did you mean 'rest_length'?"],
        ),
        ([{"file": "a.csv", "load": 3}], ["load", "unit"]),
        ([{"file": "a.csv", "rest_length": {"value": "1 m", "origin": "assumed"}}], ["origin", "suggested"]),
        ([{"file": "a.csv", "accuracy": "speed 3 %"}], ["accuracy", "speed"]),
        ([{"file": "none.csv"}], ["none.csv", "no such file"]),
    ],
    ids=lambda value: json.dumps(value)[:40],
)
def test_a_bad_list_is_told_in_a_line(
    run: Run, files: dict[str, str], entries: list[object], words: list[str]
) -> None:
    Path("list.json").write_text(json.dumps(entries), encoding="utf-8")
    code, out, err = run("compare", "list.json", "--muscle", "m.json")
    assert (code, out) == (2, "")
    assert len(err.strip().splitlines()) == 1
    for word in words:
        assert word in err


@pytest.mark.parametrize(
    ("option", "words"),
    [
        (("--accuracy", "length foo"), ["--accuracy", "foo", "steel rule"]),
        (("--accuracy", "length 3"), ["--accuracy", "no unit"]),
        (("--accuracy", "force 30 %"), ["--accuracy", "30 %"]),
        (("--experiment", "force_zer=3 N"), ["force_zer", "Did you mean 'force_zero'?"]),
        (("--experiment", "force_zero=3 bar"), ["--experiment force_zero", "pressure"]),
        (("--experiment", "fixed_end=left"), ["fixed_end", "left"]),
        (("--experiment", "stops"), ["--experiment", "field=value"]),
    ],
    ids=lambda value: " ".join(value)[:40],
)
def test_a_bad_statement_is_told_in_a_line(
    run: Run, files: dict[str, str], option: tuple[str, str], words: list[str]
) -> None:
    code, out, err = run("compare", "a.csv", "--muscle", "m.json", *option)
    assert (code, out) == (2, "")
    assert len(err.strip().splitlines()) == 1
    for word in words:
        assert word in err


def test_the_zero_of_the_force_is_subtracted(run: Run, files: dict[str, str]) -> None:
    Path("off.csv").write_text(specimen(0.25, seed=1, zero=30.0), encoding="utf-8")
    errors = []
    for options in ((), ("--experiment", "force_zero=30 N")):
        code, out, err = run("compare", "off.csv", "--muscle", "m.json", "--json", *options)
        assert code == 0, err
        errors.append(json.loads(out)["residual_mean"])
    assert errors[0] - errors[1] == pytest.approx(30.0, abs=1e-6)
    # The canonical file says it too.
    code, out, err = run("convert", "off.csv", "-o", "c.csv", "--experiment", "force_zero=30 N")
    assert code == 0, err
    code, out, err = run("compare", "c.csv", "--muscle", "m.json", "--json")
    answer = json.loads(out)
    assert answer["residual_mean"] == pytest.approx(errors[1], abs=1e-3)
    assert answer["experiment"]["force_zero"]["origin"] == "file"


def test_a_drive_can_be_stated_in_options(run: Run, files: dict[str, str]) -> None:
    rows = ["time_s,command,pressure_bar,displacement_mm"]
    rows += [f"{0.01 * n},{int(n > 9)},{min(n, 60) / 10},{min(n, 50)}" for n in range(120)]
    Path("run.csv").write_text("\n".join(rows), encoding="utf-8")
    code, _, err = run("compare", "run.csv", "--muscle", "DMSP-20")
    assert code == 2
    for word in ("valve", "--load", '--experiment "valve=', "--drive"):
        assert word in err
    stated = ("--load", "6 kg", "--experiment", "valve=MPYE-5-1/8-HF", "--experiment", "tube=4 mm x 1 m")
    code, out, err = run("compare", "run.csv", "--muscle", "DMSP-20", *stated, "--json")
    assert code == 0, err
    answer = json.loads(out)
    assert [each.partition(":")[0] for each in answer["assumptions"]] == [
        "assuming a rest length of 300 mm, the preset's",
        "assuming a supply pressure of 6 bar",
    ]
    assert answer["experiment"]["tube"]["value"] == "4 mm x 1 m"
    bad = (*stated[:2], "--experiment", "valve=MPYE")
    code, _, err = run("compare", "run.csv", "--muscle", "DMSP-20", *bad)
    assert code == 2
    assert "--experiment valve" in err
