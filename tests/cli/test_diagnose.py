"""``mckibben diagnose``: the promised JSON, tables, transients, models that go back in, bad input."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mckibben.application.diagnose.result import DiagnosisResult
from tests.cli.conftest import Run, result_of, write
from tests.identification.synthetic import BRAID, CYCLE_HEADER, LIFT, cycle_rows, text, truth
from tests.server.answers import valid

DRIVE = {"schema": 1, **LIFT}


def rubbing(name: str = "rubbing.csv", **options: Any) -> str:
    """Cycles with 15 N of friction; a bladder where asked for."""
    rows = cycle_rows(lambda direction, **_: 15.0 * direction, noise=1.0, each=20, second=3.0, **options)
    return write(name, text(rows, CYCLE_HEADER, "kind: isobaric"))


def refused(result: tuple[int, str, str]) -> str:
    code, out, err = result
    assert code == 2, err
    assert out == ""
    assert err.count("\n") == 1
    assert "Traceback" not in err
    return err


def answer_of(result: tuple[int, str, str]) -> dict[str, Any]:
    code, out, err = result
    assert code == 0, err
    assert out.count("\n") == 1
    answer = result_of(out)
    valid(DiagnosisResult, answer)
    return answer


def test_a_rest_that_repeats_is_told_with_its_pitch_and_not_as_chance(run: Run) -> None:
    """Three files of pulls; the force has a ripple of 3 mm that grows with the pressure."""
    way = 0.3 - 1e-3 * np.concatenate([np.linspace(0.0, 45.0, 120), np.linspace(45.0, 0.0, 120)])
    noise, files = np.random.default_rng(3), []
    for bar in (2, 4, 6):
        force = truth(bar * 1e5, way) + 3.0 * bar * np.sin(2.0 * np.pi * way / 3e-3)
        force += noise.standard_normal(len(way))
        rows = [f"{0.1 * i:.1f},{bar},{1e3 * way[i]:.3f},{force[i]:.3f}" for i in range(len(way))]
        files.append(
            write(f"pull_{bar}bar.csv", text(rows, "time_s,pressure_bar,length_mm,force_N", "kind: isobaric"))
        )
    options = ("--muscle", write("m.json", BRAID), "--json", "--report", "r.html")
    verdict = answer_of(run("diagnose", *files, *options))["verdict"]
    assert verdict["status"] == "unknown_effect"
    found = verdict["repeats"]
    assert (found["over"], found["unit"]) == ("length", "m")
    assert (found["parts"], found["shown"], found["grows_with_pressure"]) == (3, 3, True)
    assert found["period"] == pytest.approx(3e-3, rel=0.01)
    assert found["amplitude"] == pytest.approx(12.0, rel=0.1)
    assert found["share"] > 0.5
    assert "it repeats every 3.0" in found["text"] or "it repeats every 2.99 mm" in found["text"]
    assert found["text"] in verdict["sentence"]
    assert "no measured variable" not in verdict["sentence"]
    assert found["text"][1:] in Path("r.html").read_text("utf-8")


@pytest.mark.parametrize("noise", ["0", "-1", "inf", "nan"])
def test_a_noise_is_above_zero_and_finite(run: Run, noise: str) -> None:
    err = refused(run("diagnose", rubbing(), "--muscle", write("m.json", BRAID), "--noise", noise))
    assert "--noise" in err
    assert "leave it out to have it estimated" in err


def test_the_json_has_the_promised_shape(run: Run) -> None:
    answer = answer_of(run("diagnose", rubbing(c10=0.4e6), "--muscle", write("m.json", BRAID), "--json"))
    assert answer["kind"] == "isobaric"
    assert answer["rows"] == 240
    assert (answer["predicted"], answer["unit"]) == ("force", "N")
    assert {"rmse", "nrmse_percent", "holdout_rmse"} <= answer["baseline"].keys()
    assert {"rmse", "how"} <= answer["noise_floor"].keys()
    for place in answer["where"]:
        assert {"over", "share_explained", "worst", "rmse"} <= place.keys()
    assert answer["candidates"]
    for candidate in answer["candidates"]:
        assert {
            "effect", "rmse", "holdout_rmse", "gain_percent", "score_change",
            "parameters", "twins", "why"
        } <= candidate.keys()  # fmt: skip
        for parameter in candidate["parameters"].values():
            assert {"value", "stderr", "unit", "at_bound"} <= parameter.keys()
    for step in answer["path"]:
        assert {"added", "rmse", "holdout_rmse"} <= step.keys()
    assert answer["path"][0]["added"] is None
    assert answer["path"][0]["rmse"] == answer["baseline"]["rmse"]
    verdict = answer["verdict"]
    assert {
        "status", "effects", "indistinguishable", "unexplained_share", "proposed_term", "next_measurement"
    } <= verdict.keys()  # fmt: skip
    assert verdict["status"] == "ambiguous"  # the friction has twins of short travel
    assert set(verdict["effects"]) == {"bladder_elasticity", "coulomb_friction"}
    assert set(answer["model"]["effects"]) == {"bladder_elasticity", "coulomb_friction"}


def test_tables_and_the_verdict(run: Run) -> None:
    code, out, err = run("diagnose", rubbing(), "--muscle", write("m.json", BRAID))
    assert code == 0
    for word in ("start model", "coulomb_friction", "noise", "One effect alone", "Parameters", "Gain over"):
        assert word in out
    assert "Missing: " in err
    assert "Traceback" not in err


def test_what_cannot_be_told_apart_comes_with_an_experiment(run: Run) -> None:
    rows = cycle_rows(noise=1.0, each=20, prestress=40.0)
    file = write("shifted.csv", text(rows, CYCLE_HEADER, "kind: isobaric"))
    code, _, err = run("diagnose", file, "--muscle", write("m.json", BRAID))
    assert code == 0
    assert "cannot tell" in err
    assert "to tell " in err
    assert " sigma): " in err


@pytest.mark.examination("test_a_freed_geometry_and_a_stated_noise")
def test_the_start_model_is_ideal_named_or_the_presets(run: Run) -> None:
    file, muscle = rubbing(), write("m.json", BRAID)

    def start(*options: str) -> tuple[set[str], str]:
        answer = answer_of(run("diagnose", file, *options, "--json"))
        return set(answer["path"][0]["model"]["effects"]), answer["verdict"]["status"]

    assert start("--muscle", muscle) == (set(), "ambiguous")  # with the friction's twins of short travel
    assert start("--muscle", muscle, "--effect", "coulomb_friction") == ({"coulomb_friction"}, "adequate")
    nothing_to_search = ("--noise", "1 kN")
    own = start("--muscle", "DMSP-20", *nothing_to_search)[0]
    assert own == {"bladder_elasticity", "prestress", "lost_stroke", "dahl", "viscous_damping"}
    assert start("--muscle", "DMSP-20", "--ideal", *nothing_to_search)[0] == set()


def test_a_freed_geometry_and_a_stated_noise(run: Run) -> None:
    rows = cycle_rows(noise=1.0, each=20, angle=25.5)
    file = write("bent.csv", text(rows, CYCLE_HEADER, "kind: isobaric"))
    options = ("--muscle", write("m.json", BRAID), "--free", "braid_angle", "--noise", "1.2", "--json")
    answer = answer_of(run("diagnose", file, *options))
    assert answer["noise_floor"] == {"rmse": 1.2, "how": "given", "interval": [1.2, 1.2]}
    assert answer["verdict"]["status"] == "adequate"
    angle = answer["parameters"]["geometry"]["braid_angle"]
    assert np.degrees(angle["value"]) == pytest.approx(25.5, abs=0.05)


@pytest.mark.examination(
    "tests/cli/test_saved_model.py::test_the_numbers_of_a_diagnosis_come_back_on_every_way"
)
def test_the_model_goes_back_into_compare(run: Run) -> None:
    file, muscle = rubbing(c10=0.4e6), write("m.json", BRAID)
    answer = answer_of(run("diagnose", file, "--muscle", muscle, "--free", "braid_angle", "--json"))
    write("model.json", answer["model"])
    code, out, _ = run("compare", file, "--drive", "model.json", "--json")
    assert code == 0
    assert json.loads(out)["rmse"] == pytest.approx(answer["path"][-1]["rmse"], rel=1e-6)
    # Its muscle can be overridden; the effects stay.
    code, out, _ = run("compare", file, "--drive", "model.json", "--muscle", "DMSP-20:300mm", "--json")
    assert code == 0
    assert set(json.loads(out)["parameters"]) == set(answer["model"]["effects"])
    again = answer_of(run("diagnose", file, "--drive", "model.json", "--json"))
    assert again["verdict"]["status"] == "adequate"
    assert again["baseline"]["rmse"] == pytest.approx(answer["path"][-1]["rmse"], rel=1e-6)


@pytest.mark.examination(
    "tests/server/test_diagnoses.py::test_an_unknown_effect_brings_a_term_that_can_be_sent_back"
)
def test_a_proposed_term_goes_back_into_compare(run: Run) -> None:
    def growing(*, kappa: float, direction: float, **_: float) -> float:
        return 3000.0 * kappa**2 * direction

    rows = cycle_rows(growing, noise=1.0, each=40, second=3.0)
    file, muscle = (
        write("rough.csv", text(rows, CYCLE_HEADER, "kind: isobaric")),
        write("m.json", BRAID),
    )
    answer = answer_of(run("diagnose", file, "--muscle", muscle, "--json"))
    term = answer["verdict"]["proposed_term"]
    assert answer["verdict"]["status"] == "unknown_effect"
    write("term.json", {"muscle": BRAID, **term["model"]})
    code, out, err = run("compare", file, "--drive", "term.json", "--json")
    assert code == 0, err
    left = answer["path"][-1]["rmse"] * np.sqrt(1.0 - term["share"])
    assert json.loads(out)["rmse"] == pytest.approx(left, rel=0.05)


def test_several_files_are_diagnosed_together(run: Run) -> None:
    first, second = rubbing(), rubbing("other.csv", levels=(3e5, 5e5), seed=8)
    answer = answer_of(run("diagnose", first, second, "--muscle", write("m.json", BRAID), "--json"))
    assert answer["rows"] == 400
    assert answer["verdict"]["effects"] == ["coulomb_friction"]


# --- transients


@pytest.fixture
def lifted(run: Run) -> str:
    """A trace of the drive with a damping that the document does not have."""
    damped = {**DRIVE, "effects": {"viscous_damping": {"coefficient": "300 N*s/m"}}}
    code, _, err = run("simulate", write("damped.json", damped), "--out", "trace.csv")
    assert code == 0, err
    return "trace.csv"


def test_a_trace_is_compared_with_its_drive(run: Run, lifted: str) -> None:
    write("drive.json", DRIVE)
    code, out, _ = run("compare", lifted, "--drive", "damped.json", "--json")
    assert code == 0
    same = json.loads(out)
    assert same["unit"] == "1"
    assert {"pressure", "displacement", "force"} == set(same["channels"])
    for channel in same["channels"].values():
        assert {"rmse", "unit", "noise_floor"} <= channel.keys()
        assert channel["rmse"] < 2e-3 * channel["full_scale"]
    code, out, _ = run("compare", lifted, "--drive", "drive.json", "--json")
    assert code == 0
    assert json.loads(out)["rmse"] > 3 * same["rmse"]
    code, out, _ = run("compare", lifted, "--drive", "drive.json")
    assert code == 0
    assert "× noise" in out
    rows = sum(not line.startswith("#") for line in Path(lifted).read_text("utf-8").splitlines()) - 1
    assert f"1000 of {rows} rows, {rows - 1000} left out: in between (1000 rows of each run" in out


def test_beside_a_measured_command_the_drive_needs_none(run: Run, lifted: str) -> None:
    silent = {name: part for name, part in DRIVE.items() if name != "command"}
    answers = []
    for name, drive in (("drive.json", DRIVE), ("silent.json", silent)):
        code, out, err = run("compare", lifted, "--drive", write(name, drive), "--json")
        assert code == 0, err
        answers.append(json.loads(out))
    assert answers[0] == answers[1]
    # A run has nothing else to go by.
    assert "command is missing" in refused(run("simulate", "silent.json"))
    # Neither the file nor, as far as it would count, the document says what moved the drive.
    write("still.csv", "# kind: transient\ntime_s,displacement_mm\n0,0\n0.1,1\n0.2,2\n0.3,2\n")
    for name in ("drive.json", "silent.json"):
        line = refused(run("compare", "still.csv", "--drive", name))
        assert "neither command nor pressure was measured" in line
        assert "add a command column" in line


@pytest.mark.examination("tests/server/test_diagnoses.py::test_a_transient_is_told_channel_by_channel")
def test_a_trace_is_diagnosed_with_its_drive(run: Run, lifted: str) -> None:
    """Every fifth row with the noise of sensors: the damping is found, or a twin of it is named with it."""
    lines = Path(lifted).read_text("utf-8").splitlines()
    head = next(number for number, line in enumerate(lines) if not line.startswith("#"))
    names = lines[head].split(",")
    kept = [names.index(name) for name in ("time_s", "command", "pressure_Pa", "length_m")]
    random = np.random.default_rng(5)
    rows = []
    for line in lines[head + 1 :: 10]:
        values = [float(line.split(",")[column]) for column in kept]
        values[2] += random.normal(0.0, 500.0)
        values[3] += random.normal(0.0, 5e-5)
        rows.append(",".join(f"{value:.7g}" for value in values))
    conditions = [line.lstrip("# ") for line in lines[:head]]
    write("noisy.csv", text(rows, "time_s,command,pressure_Pa,length_m", *conditions))
    write("drive.json", DRIVE)
    answer = answer_of(run("diagnose", "noisy.csv", "--drive", "drive.json", "--json"))
    assert (answer["kind"], answer["predicted"], answer["unit"]) == (
        "transient",
        "pressure, displacement",
        "1",
    )
    assert set(answer["channels"]) == {"pressure", "displacement"}
    for channel in answer["channels"].values():
        assert {"rmse", "unit", "noise_floor"} <= channel.keys()
    assert answer["noise_floor"]["rmse"] == 1.0
    verdict = answer["verdict"]
    alike = {name for group in verdict["indistinguishable"] for name in group}
    assert "viscous_damping" in {*verdict["effects"], *alike}
    assert answer["path"][-1]["rmse"] < 1.3 < answer["baseline"]["rmse"]
    # The drive with the effects found predicts the run as well as the diagnosis said.
    write("found.json", {**DRIVE, "effects": answer["model"]["effects"]})
    code, out, err = run("compare", "noisy.csv", "--drive", "found.json", "--json")
    assert code == 0, err
    assert json.loads(out)["rmse"] == pytest.approx(answer["path"][-1]["rmse"], rel=1e-3)


# --- one line for whatever is wrong

WRONG = {
    "missing file": (["rubbin.csv", "--muscle", "m.json"], ["rubbin.csv", "Did you mean 'rubbing.csv'?"]),
    "folder and file": ([".", "rubbing.csv", "--muscle", "m.json"], ["a folder is diagnosed alone"]),
    "wrong option for all files": ([".", "--muscle", "DMSP-21"], ["none of its files", "bad.csv"]),
    "no data": (["--muscle", "m.json"], ["DATA"]),
    "no muscle": (["rubbing.csv"], ["--muscle is missing"]),
    "unknown preset": (["rubbing.csv", "--muscle", "DMSP-21"], ["DMSP-21", "Did you mean 'DMSP-20'?"]),
    "wrong effect": (
        ["rubbing.csv", "--muscle", "m.json", "--effect", "prestres"], ["Did you mean 'prestress'?"]
    ),
    "both": (
        ["rubbing.csv", "--muscle", "m.json", "--ideal", "--effect", "prestress"], ["--ideal", "--effect"]
    ),
    "wrong geometry": (
        ["rubbing.csv", "--muscle", "m.json", "--free", "braid_angel"], ["braid_angel", "braid_angle"]
    ),
    "geometry that is not known": (
        ["rubbing.csv", "--muscle", "thin.json", "--free", "wall_thickness"], ["wall thickness"]
    ),
    "negative noise": (["rubbing.csv", "--muscle", "m.json", "--noise", "-1"], ["--noise"]),
    "noise in words": (["rubbing.csv", "--muscle", "m.json", "--noise", "much"], ["--noise", "number"]),
    "missing drive": (["rubbing.csv", "--drive", "none.json"], ["none.json", "No such file"]),
    "drive that is a list": (["rubbing.csv", "--drive", "list.json"], ["list.json", "object"]),
    "unknown key": (["rubbing.csv", "--drive", "key.json", "--muscle", "m.json"], ["key.json", "effects"]),
    "wrong term": (
        ["rubbing.csv", "--drive", "term.json", "--muscle", "m.json"], ["log", "custom"]
    ),
    "bad row": (["bad.csv", "--muscle", "m.json"], ["bad.csv", "abc", "4"]),
    "no table": (["text.csv", "--muscle", "m.json"], ["text.csv"]),
    "two kinds": (["rubbing.csv", "lift.csv", "--muscle", "m.json"], ["lift.csv", "isotonic", "isobaric"]),
    "command without a drive": (["trace.csv", "--muscle", "m.json"], ["trace.csv", "--drive"]),
    "transient without a load": (["pull.csv", "--muscle", "m.json"], ["pull.csv", "load_mass"]),
    "noise of several channels": (["trace.csv", "--drive", "drive.json", "--noise", "5"], ["noise"]),
    "unknown option": (["rubbing.csv", "--muscel", "m.json"], ["--muscel", "--muscle"]),
}  # fmt: skip


FILES = {
    "bad.csv": "# kind: static\npressure_bar,length_mm,force_N\n1,290,100\nabc,290,200\n",
    "text.csv": "just a text\n",
    "map.csv": "# kind: static\npressure_bar,length_mm,force_N\n1,290,100\n2,290,200\n3,280,210\n",
    "lift.csv": "# kind: isotonic\n# load_mass: 5 kg\npressure_bar,length_mm\n1,290\n2,280\n3,270\n",
    "pull.csv": "time_s,pressure_bar,displacement_mm\n0,0,0\n0.1,1,2\n0.2,2,3\n0.3,2,3\n",
    "trace.csv": "time_s,command,pressure_bar,displacement_mm\n0,1,0,0\n0.1,1,1,2\n0.2,0,2,3\n0.3,0,2,3\n",
}


@pytest.mark.parametrize("name", WRONG)
def test_bad_input_is_one_line_that_says_what_would_be_right(run: Run, name: str) -> None:
    arguments, words = WRONG[name]
    rubbing(levels=(4e5, 6e5))
    write("m.json", BRAID)
    write("thin.json", {**BRAID, "wall_thickness": 0})
    write("list.json", [])
    write("key.json", {"effect": {}})
    write("term.json", {"effects": {"custom": {"term": "c*log(P)"}}})
    write("drive.json", DRIVE)
    for file, content in FILES.items():
        write(file, content)
    line = refused(run("diagnose", *arguments))
    for word in words:
        assert word in line


@pytest.mark.examination(
    "tests/identification/diagnose/test_contest.py"
    "::test_a_wrong_rest_length_beside_an_elastic_wall_is_asked_about_first"
)
def test_a_wrong_rest_length_is_asked_about_and_answered(run: Run) -> None:
    file, long = rubbing(), write("long.json", {**BRAID, "nominal_length": "345 mm"})
    code, _, err = run("diagnose", file, "--muscle", long)
    assert code == 0
    assert "Check an entry first: Rest length 300" in err
    used = answer_of(run("diagnose", file, "--muscle", long, "--use", "rest_length", "--json"))
    assert used["verdict"]["effects"] == ["coulomb_friction"]
    err = refused(run("diagnose", file, "--muscle", long, "--keep", "length"))
    assert "--keep: 'length' is not a doubtful statement" in err


@pytest.mark.examination("test_several_files_are_diagnosed_together")
def test_a_folder_gives_one_line_for_each_file(run: Run) -> None:
    muscle = write("m.json", BRAID)
    Path("tests").mkdir()
    Path(rubbing()).rename("tests/a-rubbing.csv")
    Path("tests/b-notes.txt").write_text("nothing to read\n", "utf-8")
    code, out, err = run("diagnose", "tests", "--muscle", muscle, "--json")
    assert code == 0, err
    rubbed, notes = result_of(out)["files"]
    assert rubbed["file"] == "a-rubbing.csv"
    assert rubbed["effects"] == ["coulomb_friction"]
    assert rubbed["best"] < 0.5 * rubbed["start"]
    assert rubbed["best"] == pytest.approx(1.0, rel=0.2)  # the noise of the data, 1 N
    assert notes["effects"] == []
    assert "b-notes.txt" in notes["refused"]

    code, out, err = run("diagnose", "tests", "--muscle", muscle, "--out", "verdicts.csv")
    assert code == 0
    assert "coulomb_friction" in out
    table = list(csv.DictReader(Path("verdicts.csv").read_text("utf-8").splitlines()))
    assert [row["file"] for row in table] == ["a-rubbing.csv", "b-notes.txt"]
    assert float(table[0]["best"]) == rubbed["best"]
    assert not Path("verdicts.csv.journal").exists()
    for options, words in [
        (["tests", "--out", "verdicts.csv", "--resume"], "nothing to resume"),
        (["tests", "--resume"], "--out"),
        (["tests", "--out", "verdicts.xls"], "not a known ending"),
        (["tests/a-rubbing.csv", "--scheduler", "tcp://127.0.0.1:1"], "name a folder"),
    ]:
        assert words in refused(run("diagnose", *options, "--muscle", muscle))
    assert "b-notes.txt: refused" in err
    assert "name one file" in refused(run("diagnose", "tests", "--muscle", muscle, "--save", "x.json"))
    Path("none").mkdir()
    assert "there is no file in it" in refused(run("diagnose", "none", "--muscle", muscle))
