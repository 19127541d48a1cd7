"""A result of the door is that of the command line's ``--json``: its dictionary, its fields, their types."""

from __future__ import annotations

import copy
import json
import math
import pickle
from collections.abc import Iterator, Mapping
from dataclasses import fields, is_dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mckibben as mk
from mckibben.door.result import Holding, ResultOf
from mckibben.facts.result import described
from tests.application.study.test_study import STUDY
from tests.cli.conftest import Run
from tests.identification.synthetic import text, truth

VOLATILE = {"wall_ms", "made", "where"}  # times; an option has another name as an argument
DATA, OTHER = "martens-dmsp-10-250", "martens-dmsp-20-300"
TASK = {
    "load": {"mass": "20 kg"},
    "stroke": "60 mm",
    "time": "0.5 s",
    "limits": {"max_length": "600 mm", "max_parallel": 1},
    "catalogue": {"muscles": ["DMSP-20"], "valves": ["MPYE-5-1/8-HF"], "tube_length": "1 m"},
}


def differences(mine: Any, theirs: Any, path: str = "", *, near: float = 1e-12) -> list[str]:
    """Where two JSON values differ by more than ``near``."""
    if isinstance(theirs, dict) and isinstance(mine, dict):
        missing = [f"{path}: {key}" for key in mine.keys() ^ theirs.keys()]
        shared = [key for key in theirs if key in mine and key not in VOLATILE]
        return missing + [
            line for key in shared for line in differences(mine[key], theirs[key], f"{path}.{key}", near=near)
        ]
    if isinstance(theirs, list) and isinstance(mine, list):
        if len(mine) != len(theirs):
            return [f"{path}: {len(mine)} and {len(theirs)} values"]
        pairs = enumerate(zip(mine, theirs, strict=True))
        return [line for at, (a, b) in pairs for line in differences(a, b, f"{path}[{at}]", near=near)]
    if isinstance(theirs, float) and isinstance(mine, float):
        same = math.isclose(mine, theirs, rel_tol=near, abs_tol=near)
        return [] if same else [f"{path}: {mine!r} and {theirs!r}"]
    return [] if mine == theirs else [f"{path}: {mine!r} and {theirs!r}"]


def arrays(value: Any) -> Iterator[np.ndarray]:
    """All arrays inside of a value."""
    if isinstance(value, np.ndarray):
        yield value
    elif is_dataclass(value):
        for field in fields(value):
            yield from arrays(getattr(value, field.name))
    elif isinstance(value, Mapping | list | tuple):
        for item in value.values() if isinstance(value, Mapping) else value:
            yield from arrays(item)


def check_fields(mine: Holding[Any]) -> None:
    """Every field is a described attribute, the same object unless the class declares it in another form."""
    result, texts = mine.details, described(type(mine))
    other_form = vars(type(mine)).get("__annotations__", {})
    for field in fields(result):
        assert texts[field.name].text
        if field.name not in other_form:
            assert getattr(mine, field.name) is getattr(result, field.name), field.name
        with pytest.raises(AttributeError, match="does not change"):
            setattr(mine, field.name, None)
    assert not [array.shape for array in arrays(mine) if array.flags.writeable]
    with pytest.raises(AttributeError):
        _ = mine.no_such_field  # type: ignore


def check(mine: ResultOf[Any], theirs: dict[str, Any]) -> None:
    """A result of the door and what the command line prints."""
    check_fields(mine)
    assert differences(mine.to_dict(), theirs) == []
    assert list(theirs)[1:] == [field.name for field in fields(mine.details)]
    mine.save("result.json")
    assert json.loads(Path("result.json").read_text("utf-8")) == mine.to_dict()


def printed(run: Run, *arguments: str) -> dict[str, Any]:
    """The JSON that a command line prints."""
    code, out, err = run(*arguments, "--json")
    assert code == 0, err
    return json.loads(out)


def prestressed() -> str:
    """A map of a DMSP-20 of 300 mm, whose prestress is all that the ideal muscle lacks: quickly diagnosed."""
    random = np.random.default_rng(7)
    rows = [
        f"{pressure / 1e5},{1e3 * length},{truth(pressure, length, prestress=40.0) + random.normal()}"
        for pressure in (3e5, 5e5, 7e5)
        for length in np.linspace(0.255, 0.3, 12)
    ]
    return text(rows, "pressure_bar,length_mm,force_N", "kind: static")


def test_the_comparison_of_numbers_sees_a_difference() -> None:
    assert differences({"a": [1.0, 2.0]}, {"a": [1.0, 2.0 + 4e-12]}) != []
    assert differences({"a": 1.0}, {"b": 1.0}) != []


@pytest.mark.parametrize("ideal", [False, True])
def test_curves(run: Run, ideal: bool) -> None:
    options = ["--ideal"] if ideal else []
    theirs = printed(run, "curves", "--muscle", "DMSP-20:300mm", "--pressure", "1 bar,6 bar", *options)
    model = mk.Model.preset("DMSP-20", length="300 mm")
    curves = (model.ideal() if ideal else model).curves("1 bar, 6 bar")
    check(curves, theirs)
    frame = curves.to_frame()
    assert frame["force_N"].tolist() == [value for row in theirs["force"] for value in row]
    again = (model.ideal() if ideal else model).force(
        pressure=frame["pressure_Pa"].to_numpy(), length=frame["length_m"].to_numpy()
    )
    assert again == pytest.approx(frame["force_N"].to_numpy(), rel=1e-12, abs=1e-9)


@pytest.mark.parametrize("options", [(), ("--fit",), ("--fit", "--free", "braid_angle")])
def test_comparisons(run: Run, options: tuple[str, ...]) -> None:
    theirs = printed(run, "compare", DATA, "--muscle", "DMSP-10", *options)
    mine = mk.Model.preset("DMSP-10").compare(
        mk.read(DATA), fit="--fit" in options, free="braid_angle" if "--free" in options else ()
    )
    check(mine, theirs)
    assert isinstance(mine.model, mk.Model)
    assert mine.rmse == pytest.approx(theirs["rmse"], rel=1e-12)
    frame = mine.to_frame()
    assert len(frame) == theirs["rows_used"]
    assert (frame["residual"] ** 2).mean() ** 0.5 == pytest.approx(mine.rmse, rel=1e-12)


def test_effects_and_files_mean_the_same(run: Run) -> None:
    mk.read(DATA).save("map.csv")
    theirs = printed(
        run, "compare", "map.csv", "--muscle", "DMSP-10", "--ideal", "--rest-length", "240 mm",
        "--experiment", "force_zero=2 N", "--accuracy", "length 0.5 mm",
    )  # fmt: skip
    data = mk.read(
        "map.csv", rest_length="240 mm", experiment={"force_zero": "2 N"}, accuracy="length 0.5 mm"
    )
    mine = mk.Model.preset("DMSP-10").ideal().compare(data)
    assert differences(mine.to_dict(), theirs) == []


def test_diagnoses_and_what_they_save(run: Run) -> None:
    Path("map.csv").write_text(prestressed(), "utf-8")
    theirs = printed(
        run, "diagnose", "map.csv", "--muscle", "DMSP-20:300mm", "--ideal", "--save", "theirs.json"
    )
    shares: list[float] = []
    ideal = mk.Model.preset("DMSP-20", length="300 mm").ideal()
    found = ideal.diagnose(mk.read("map.csv"), progress=shares.append)
    check(found, theirs)
    assert found.sentence == theirs["verdict"]["sentence"]
    assert found.probabilities == theirs["verdict"].get("probabilities", {})
    assert found.effects == tuple(theirs["verdict"]["effects"])
    assert all(0.0 <= share <= 1.0 for share in shares)
    found.model.save("mine.json")
    mine, saved = (json.loads(Path(name).read_text("utf-8")) for name in ("mine.json", "theirs.json"))
    del mine["origin"]["files"], saved["origin"]["files"]  # who says the muscle has another name
    assert differences(mine, saved) == []
    # On other data as well.
    other = printed(run, "compare", OTHER, "--model", "theirs.json")
    assert differences(mk.load("theirs.json").compare(OTHER).to_dict(), other) == []
    assert differences(found.model.compare(OTHER).rmse, other["rmse"]) == []


def test_simulations(run: Run) -> None:
    theirs = printed(run, "simulate", "propneu-20")
    mine = mk.Drive.preset("propneu-20").run()
    check(mine, theirs)
    assert mine.timing.extend.rise_time == pytest.approx(theirs["timing"]["extend"]["rise_time"], rel=1e-12)
    assert mine.to_frame()["load_position_m"].tolist() == theirs["position"]


def test_sizings(run: Run) -> None:
    Path("task.json").write_text(json.dumps(TASK), "utf-8")
    theirs = printed(run, "size", "task.json")
    mine = mk.size(TASK)
    check(mine, theirs)
    for proposal in mine.proposals:
        check_fields(proposal)
    assert mine.to_frame()["muscle"].tolist() == [item["muscle"] for item in theirs["proposals"]]
    best = mine.proposals[0]
    run_of_best = best.drive.run()
    assert best.time is not None
    assert run_of_best.timing.extend.positioning_time == pytest.approx(best.time, rel=0.01)


def test_linear_models(run: Run) -> None:
    options = ("--amplitudes", "5 %", "--design", "overshoot 5 %, settling 1 s")
    drive = mk.Drive(
        "DMSP-20:300mm", valve="VPPM-6", load={"mass": "10 kg"}, command={"shape": "step"},
        effects={"bladder_elasticity": {}, "viscous_damping": {"coefficient": "120 N*s/m"}},
    )  # fmt: skip
    drive.save("drive.json")
    theirs = printed(run, "linearise", "drive.json", "--at", "position 40 mm", *options)
    check(drive.linearise("position 40 mm", amplitudes=["5 %"], design=options[-1]), theirs)


def test_studies(run: Run) -> None:
    study = STUDY | {"method": {"type": "monte_carlo", "runs": 4, "seed": 3}}
    Path("study.json").write_text(json.dumps(study), "utf-8")
    check(mk.study(study), printed(run, "study", "study.json"))


def test_a_result_is_itself_and_its_copies_are_whole() -> None:
    curves = mk.Model.preset("DMSP-20", length="300 mm").curves("1 bar")
    run = mk.Drive.preset("propneu-20").run(points=11)
    assert curves in {curves}
    assert curves != mk.Model.preset("DMSP-20", length="300 mm").curves("1 bar")
    assert copy.copy(run).timing is run.timing
    assert str(pickle.loads(pickle.dumps(run))) == str(run)
    for again in (copy.copy(curves), copy.deepcopy(curves), pickle.loads(pickle.dumps(curves))):
        assert str(again) == str(curves)
        assert again.to_dict() == curves.to_dict()
        assert again.force.tolist() == curves.force.tolist()
