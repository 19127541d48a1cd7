"""A diagnosed model saved, compared with its own and other data, and fitted again."""

from __future__ import annotations

import json
from hashlib import sha256
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mckibben import __version__
from mckibben.documents.drive import DriveDocument
from mckibben.physics.catalogue import default_catalogue
from tests.application.truths import document, muscle, specimen
from tests.cli.conftest import Run, write
from tests.identification.synthetic import BRAID, CYCLE_HEADER, LIFT, MUSCLE, cycle_rows, length_under, text
from tests.truth.generate import case


def answer_of(result: tuple[int, str, str]) -> dict[str, Any]:
    code, out, err = result
    assert code == 0, err
    return json.loads(out)


def refused(result: tuple[int, str, str]) -> str:
    code, out, err = result
    assert (code, out) == (2, ""), err
    assert err.count("\n") == 1
    return err


def rubbing(name: str = "rubbing.csv", **options: Any) -> str:
    """Cycles with 15 N of friction over length."""
    rows = cycle_rows(lambda direction, **_: 15.0 * direction, noise=1.0, each=20, second=3.0, **options)
    return write(name, text(rows, CYCLE_HEADER, "kind: isobaric"))


def saved(run: Run, *arguments: str) -> tuple[dict[str, Any], dict[str, Any]]:
    """A diagnosis and the model that it wrote to model.json."""
    answer = answer_of(run("diagnose", *arguments, "--json", "--save", "model.json"))
    return answer, json.loads(Path("model.json").read_text("utf-8"))


def rmse(run: Run, *arguments: str) -> float:
    return answer_of(run("compare", *arguments, "--json"))["rmse"]


def true_case(name: str) -> tuple[str, str]:
    """The file and the start model of a case with hidden effects."""
    made = case(name)
    ((file, content),) = made.files.items()
    start = made.drive or {"muscle": made.muscle, "effects": made.effects}
    return write(file, content), write("start.json", start)


LONG = pytest.mark.examination("test_the_numbers_of_a_diagnosis_come_back_on_every_way")


@pytest.mark.parametrize(
    ("name", "freed"),
    [
        ("contraction-factor-diameter", ["contraction_factor.excess"]),
        pytest.param(
            "pair-bladder-prestress-isometric",
            ["bladder_elasticity.softening", "bladder_elasticity.stiffening"],
            marks=LONG,
        ),
        pytest.param("leak-rests", ["leak.laminar_share"], marks=LONG),
    ],
)
def test_the_numbers_of_a_diagnosis_come_back_on_every_way(run: Run, name: str, freed: list[str]) -> None:
    """A model with freed constants: as saved, as answered, fitted again, and fitted from the start model."""
    file, start = true_case(name)
    answer, model = saved(run, file, "--drive", start)
    assert answer["freed"] == model["freed"] == freed
    assert model["effects"] == answer["model"]["effects"]
    reached = answer["path"][-1]["rmse"]
    assert model["origin"]["error"]["rmse"] == reached
    write("answered.json", answer["model"])
    named = [word for effect in model["effects"] for word in ("--effect", effect)]
    free = [word for constant in freed for word in ("--free", constant)]
    for way in (
        ["--model", "model.json"],
        ["--drive", "model.json"],
        ["--drive", "answered.json"],
        ["--model", "model.json", "--fit"],
        ["--drive", start, *named, *free, "--fit"],
    ):
        assert rmse(run, file, *way) == pytest.approx(reached, rel=1e-4), way


def test_a_transient_brings_its_whole_drive(run: Run) -> None:
    file, start = true_case("leak-rests")
    stated = json.loads(Path(start).read_text("utf-8"))
    answer, model = saved(run, file, "--drive", start)
    drive = answer["model"]["drive"]
    assert model["drive"] == drive
    DriveDocument.model_validate(drive)
    assert drive["muscle"] == model["muscle"]
    assert drive["effects"] == model["effects"]
    assert drive["valve"] == stated["valve"]
    assert drive["supply"] == {"pressure": 6e5}
    assert drive["stops"] == stated["stops"]
    assert f"{drive['load']['mass']:.6g} kg" == stated["load"]["mass"]
    # It runs alone: the document has a command of its own.
    run_of_it = answer_of(run("simulate", write("whole.json", drive), "--json"))
    assert run_of_it["outcome"] == "completed"
    # Another drive takes its place, with the model's muscle and effects.
    lighter = {**stated, "effects": {}, "load": {"mass": 0.5 * drive["load"]["mass"]}}
    other = answer_of(
        run("compare", file, "--model", "model.json", "--drive", write("l.json", lighter), "--json")
    )
    assert set(other["parameters"]) == set(model["effects"])
    assert other["specimens"][0]["experiment"]["load"]["value"] == pytest.approx(0.5 * drive["load"]["mass"])
    assert other["rmse"] > 3.0 * answer["path"][-1]["rmse"]
    (told,) = [message for message in other["messages"] if message.startswith("moved mass ")]
    assert "the model was measured at" in told


@pytest.mark.examination("test_the_numbers_of_a_diagnosis_come_back_on_every_way")
def test_the_document_says_where_the_model_comes_from(run: Run) -> None:
    file = rubbing(c10=0.4e6)
    options = ("--muscle", write("m.json", BRAID), "--free", "braid_angle")
    answer, model = saved(run, file, *options)
    origin = model["origin"]
    assert origin["program"] == f"mckibben {__version__}"
    assert origin["files"][0]["sha256"] == sha256(Path(file).read_bytes()).hexdigest()
    assert origin["files"][0]["rows"] == answer["rows"]
    assert (origin["kind"], origin["predicted"]) == ("isobaric", "force")
    assert model["free"] == ["braid_angle"]
    assert model["muscle"]["braid_angle"] == answer["parameters"]["geometry"]["braid_angle"]["value"]
    ranges = answer["envelope"]
    assert model["envelope"] == ranges
    assert (ranges["pressure"]["least"], ranges["pressure"]["most"]) == (2e5, 6e5)
    # 20 rows each way to 16 %; the row where the motion turns does not count.
    assert ranges["contraction"]["most"] == pytest.approx(0.16 * 19 / 20)
    # 20 mm/s, and three times as fast in the second cycle of each pressure
    assert ranges["speed"]["most"] == pytest.approx(0.06, rel=0.05)
    assert "drive" not in model
    assert rmse(run, file, "--model", "model.json") == pytest.approx(answer["path"][-1]["rmse"], rel=1e-6)
    again = answer_of(run("diagnose", file, "--model", "model.json", "--json"))
    assert again["verdict"]["status"] == "adequate"
    assert "braid_angle" in again["parameters"]["geometry"]


@pytest.mark.examination("test_the_numbers_of_a_diagnosis_come_back_on_every_way")
def test_what_was_assumed_for_a_model_is_said_again(run: Run) -> None:
    """A preset's default length that nobody stated, and an assumed wall."""
    file = write("short.csv", "\n".join(
        line for line in specimen(0.3).splitlines() if not line.startswith("# nominal")) + "\n")  # fmt: skip
    _, model = saved(run, file, "--muscle", "DMSP-20", "--ideal")
    assert model["muscle"]["preset"] == "DMSP-20"
    assert any("rest length" in words for words in model["assumed"])
    code, _, err = run("compare", file, "--model", "model.json")
    assert code == 0
    assert "model.json: the model was fitted assuming a rest length" in err


def test_a_model_predicts_pressures_and_a_length_that_it_was_not_fitted_to(run: Run) -> None:
    """Trained at 2, 4 and 6 bar on 250 mm; other pressures, and 400 mm, are predicted to the noise."""
    write("train.csv", specimen(0.25, seed=1))
    write("pressures.csv", specimen(0.25, seed=2, levels=(3e5, 5e5)))
    write("length.csv", specimen(0.4, seed=3))
    answer, _ = saved(run, "train.csv", "--muscle", write("m.json", document()))
    assert answer["verdict"]["effects"] == ["bladder_elasticity"]
    assert answer["baseline"]["rmse"] > 10.0 * answer["path"][-1]["rmse"]
    noise = 0.001 * muscle(0.25).blocked  # of the force; that of the stroke adds a little
    assert rmse(run, "pressures.csv", "--model", "model.json") < 1.3 * noise
    # The file says 400 mm and the model 250 mm: the user decides.
    err = refused(run("compare", "length.csv", "--model", "model.json"))
    for word in ("length.csv", "400 mm", "--model model.json", "250 mm", "--rest-length"):
        assert word in err
    options = ("--model", "model.json", "--rest-length", "400 mm", "--json")
    longer = answer_of(run("compare", "length.csv", *options))
    assert longer["rmse"] < 1.3 * noise
    assert longer["geometry"]["nominal_length"] == 0.4
    assert "rest length up to 400 mm: the model was measured at 250 mm" in longer["messages"]


@pytest.mark.examination("test_a_model_predicts_pressures_and_a_length_that_it_was_not_fitted_to")
def test_a_transient_model_predicts_a_motion_that_it_was_not_fitted_to(run: Run) -> None:
    """Trained on the filling and the rest after it; the whole trace, with the venting, is predicted."""
    file, start = true_case("leak-rests")
    lines = Path(file).read_text("utf-8").splitlines(keepends=True)
    write("filling.csv", "".join(lines[: len(lines) - 1201]))  # 2501 rows in 5 s; it vents from 2.6 s on
    answer, model = saved(run, "filling.csv", "--drive", start)
    assert "leak" in answer["verdict"]["effects"]
    whole = answer_of(run("compare", file, "--model", "model.json", "--json"))
    noise = case("leak-rests").noise
    assert set(whole["channels"]) == set(noise)
    for name, channel in whole["channels"].items():
        assert channel["rmse"] < 1.3 * noise[name], name
    code, out, _ = run("compare", file, "--model", "model.json")
    assert code == 0
    assert f"{model['effects']['leak']['conductance']:.5g}" in out


@pytest.mark.examination("test_the_numbers_of_a_diagnosis_come_back_on_every_way")
def test_several_lengths_and_a_typed_term_come_back(run: Run) -> None:
    """The length is that of each file; the text of the term is part of the model."""
    write("a.csv", specimen(0.25, seed=1))
    write("b.csv", specimen(0.4, seed=2))
    typed = {"muscle": document(), "effects": {"custom": {"term": "-c*kappa", "c": 5.0}}}
    answer, model = saved(run, "a.csv", "b.csv", "--drive", write("d.json", typed))
    assert "nominal_length" not in model["muscle"]
    assert model["effects"]["custom"]["term"] == "-c*kappa"
    assert model["envelope"]["rest_length"] == {"least": 0.25, "most": 0.4, "unit": "m"}
    assert [each["name"] for each in model["origin"]["files"]] == ["a.csv", "b.csv"]
    again = answer_of(run("compare", "a.csv", "b.csv", "--model", "model.json", "--json"))
    assert again["rmse_beyond_accuracy"] == pytest.approx(answer["path"][-1]["rmse"], rel=0.01)
    assert rmse(run, "b.csv", "--model", "model.json") < 1.3 * 0.001 * muscle(0.4).blocked


def test_data_beyond_the_pressures_of_the_model_are_told(run: Run) -> None:
    file = rubbing()
    high = rubbing("high.csv", levels=(5e5, 7e5), seed=8)
    saved(run, file, "--muscle", write("m.json", BRAID))
    words = "pressure up to 7 bar: the model was measured up to 6 bar"
    for command in ("compare", "diagnose"):
        assert words in answer_of(run(command, high, "--model", "model.json", "--json"))["messages"]
        inside = answer_of(run(command, file, "--model", "model.json", "--json"))
        assert not [message for message in inside["messages"] if "the model was measured" in message]
    code, _, err = run("compare", high, "--model", "model.json")
    assert code == 0
    assert words in err


def test_a_load_that_nobody_stated_is_that_of_the_fit(run: Run) -> None:
    """Lengths under a hanging load that the file does not state."""
    random = np.random.default_rng(4)
    rows = [
        f"{pressure},{length_under(150.0, pressure) + random.normal(0.0, 2e-5):.9g}"
        for pressure in np.linspace(2e5, 6e5, 40)
    ]
    file = write("hung.csv", text(rows, "pressure_Pa,length_m", "kind: isotonic"))
    answer, model = saved(run, file, "--muscle", write("m.json", BRAID))
    assert model["load_force"] == pytest.approx(150.0, abs=1.0)
    again = answer_of(run("compare", file, "--model", "model.json", "--json"))
    assert again["rmse"] == pytest.approx(answer["path"][-1]["rmse"], rel=1e-3)
    assert any("150" in message and "load is not stated" in message for message in again["messages"])
    # A stated load is not added to it.
    heavier = rmse(run, file, "--model", "model.json", "--load", "150 N")
    assert heavier == pytest.approx(answer["path"][-1]["rmse"], rel=0.05)


@pytest.mark.examination("test_a_named_effect_keeps_the_numbers_of_preset_or_document")
def test_options_override_the_saved_model(run: Run) -> None:
    file = rubbing(c10=0.4e6)
    _, model = saved(run, file, "--muscle", write("m.json", BRAID))
    assert set(model["effects"]) == {"bladder_elasticity", "coulomb_friction"}

    def used(*options: str) -> dict[str, Any]:
        return answer_of(run("compare", file, "--model", "model.json", *options, "--json"))

    assert used("--ideal")["parameters"] == {}
    one = used("--effect", "coulomb_friction")["parameters"]
    assert {name: item["value"] for name, item in one["coulomb_friction"].items()} == (
        model["effects"]["coulomb_friction"]
    )
    assert set(one) == {"coulomb_friction"}
    other = used("--muscle", "DMSP-10:300mm")
    assert other["geometry"]["inside_diameter"] == pytest.approx(0.01)
    assert set(other["parameters"]) == set(model["effects"])


def test_a_named_effect_keeps_the_numbers_of_preset_or_document(run: Run) -> None:
    file = rubbing()

    def values(effect: str, *options: str) -> dict[str, float]:
        table = answer_of(run("compare", file, *options, "--json"))["parameters"]
        return {name: item["value"] for name, item in table[effect].items()}

    preset = values("prestress", "--muscle", "DMSP-20:300mm")
    assert preset != default_catalogue()["prestress"].defaults
    named = ("--effect", "prestress", "--effect", "coulomb_friction")
    assert values("prestress", "--muscle", "DMSP-20:300mm", *named) == preset
    defaults = default_catalogue()["coulomb_friction"].defaults
    assert values("coulomb_friction", "--muscle", "DMSP-20:300mm", *named) == defaults
    first = next(iter(defaults))
    stated = {"muscle": BRAID, "effects": {"coulomb_friction": {first: "7 N"}}}
    of_document = values("coulomb_friction", "--drive", write("d.json", stated), *named)
    assert of_document[first] == pytest.approx(7.0)


# --- one line for whatever is wrong

MODEL = {"schema": 1, "kind": "model", "muscle": BRAID, "effects": {}}
WRONG = {
    "no file": (None, ["model.json", "No such file"]),
    "no model": ({"muscle": BRAID, "effects": {}}, ["model.json", '"kind": "model"', "--save"]),
    "list": ([], ["model.json", "object"]),
    "other version": ({**MODEL, "schema": 2}, ["model.json", "schema", "1"]),
    "unknown key": ({**MODEL, "efects": {}}, ["model.json", "efects", "Did you mean 'effects'?"]),
    "unknown effect": ({**MODEL, "effects": {"prestres": {}}}, ["model.json", "Did you mean 'prestress'?"]),
    "unknown constant": (
        {**MODEL, "effects": {"dahl": {}}, "freed": ["dahl.forse"]},
        ["model.json", "freed.0", "dahl.forse", "Did you mean 'dahl.force'?"],
    ),
    "constant of no effect": ({**MODEL, "freed": ["dahl.force"]}, ["model.json", "no effect dahl"]),
    "no geometry": ({**MODEL, "free": ["braid"]}, ["model.json", "free.0", "braid", "braid_angle"]),
    "effect that is no object": ({**MODEL, "effects": {"dahl": 5}}, ["model.json", "effects.dahl", "object"]),
    "two muscles": (
        {**MODEL, "drive": {**LIFT, "muscle": {**BRAID, "braid_angle": "25 deg"}}},
        ["model.json", "drive.muscle", "not the muscle of the model"],
    ),
    "two models": (
        {**MODEL, "drive": {**LIFT, "effects": {"prestress": {}}}},
        ["model.json", "drive.effects", "not the effects of the model"],
    ),
}  # fmt: skip


@pytest.mark.parametrize(("content", "words"), list(WRONG.values()), ids=list(WRONG))
def test_a_file_that_is_no_model_is_told_in_one_line(run: Run, content: object, words: list[str]) -> None:
    file = rubbing()
    if content is not None:
        write("model.json", content)
    err = refused(run("compare", file, "--model", "model.json", "--fit"))
    for word in words:
        assert word in err


def test_a_drive_with_an_effect_that_is_no_object_is_told(run: Run) -> None:
    drive = write("d.json", {"muscle": BRAID, "effects": {"dahl": 5}})
    for options in ((), ("--effect", "dahl")):
        err = refused(run("compare", rubbing(), "--drive", drive, *options))
        assert "effects.dahl must be an object" in err


@pytest.mark.parametrize(
    ("name", "word"),
    [
        ("dahl.forse", "Did you mean 'dahl.force'?"),
        ("braid", "no such geometry"),
        ("dahl.force", "--effect dahl"),
    ],
)
def test_what_cannot_be_freed_is_told(run: Run, name: str, word: str) -> None:
    err = refused(run("compare", rubbing(), "--muscle", write("m.json", BRAID), "--free", name, "--fit"))
    assert name in err
    assert word in err


@pytest.mark.parametrize("place", ["none/model.json", "."])
def test_a_place_that_takes_no_file_is_told_before_the_search(run: Run, place: str) -> None:
    err = refused(run("diagnose", "not-even-read.csv", "--muscle", "DMSP-20", "--save", place))
    assert "--save" in err


def test_a_diagnosed_model_becomes_a_muscle_of_the_user(run: Run) -> None:
    data, mine = rubbing(), ["--data", "data"]
    muscle = write("muscle.json", BRAID)
    _, model = saved(run, data, "--muscle", muscle, "--save-preset", "bench-3", *mine)
    by_id = answer_of(run("curves", "--muscle", "bench-3", "--json", *mine))
    by_file = answer_of(run("curves", "--model", "model.json", "--json"))
    assert by_id["force"] == by_file["force"]
    assert by_id["interval"] == by_file["interval"]
    # 1 N of noise; friction is known to far less than that.
    width = np.array(by_id["interval"]["high"]) - np.array(by_id["force"])
    assert float(np.median(width)) == pytest.approx(1.645, rel=0.25)
    assert any("the model was measured up to" in flag["message"] for flag in by_id["flags"])
    changed = answer_of(run("curves", "--model", "model.json", "--ideal", "--json"))
    assert changed["interval"] is None
    lift = {name: part for name, part in LIFT.items() if name != "effects"} | {
        "muscle": {"preset": "bench-3"}
    }
    moved = answer_of(run("simulate", write("lift.json", lift), "--json", *mine))
    assert len(moved["interval"]["low"]) == len(moved["position"])
    assert "90 % of new readings lie within about ±" in "".join(
        run("curves", "--muscle", "bench-3", *mine)[1:]
    )
    assert model["covariance"]["names"]


def test_a_preset_id_that_cannot_be_used_is_told(run: Run) -> None:
    muscle, mine = write("muscle.json", BRAID), ["--data", "data"]
    told = refused(run("diagnose", rubbing(), "--muscle", muscle, "--save-preset", "DMSP-20", *mine))
    assert "--save-preset DMSP-20" in told
    assert "taken by a built-in preset" in told


def test_a_rest_length_that_data_have_corrected_is_not_typed_back_in(run: Run) -> None:
    """Loops of a muscle of 300 mm that was typed as 330: the saved model says both, and uses its own."""
    rows = cycle_rows(lambda **_: 0.0, noise=0.5, each=20, second=3.0)
    data = write("loops.csv", text(rows, CYCLE_HEADER, "kind: isobaric"))
    typed = ("--rest-length", "330 mm")
    geometry = {"braid_diameter": MUSCLE.braid_diameter, "braid_angle": MUSCLE.braid_angle}
    start = write("muscle.json", {"nominal_length": 0.33, **geometry})
    found, model = saved(run, data, "--muscle", start, "--ideal", *typed, "--use", "rest_length")
    assert model["muscle"]["nominal_length"] == pytest.approx(0.3, abs=1e-3)
    assert model["stated"] == {"nominal_length": 0.33}
    lengths = model["envelope"]["rest_length"]
    assert lengths["least"] == lengths["most"] == pytest.approx(0.3, abs=1e-3)
    again = answer_of(run("compare", data, "--model", "model.json", *typed, "--json"))
    assert again["rmse"] == pytest.approx(found["path"][-1]["rmse"], rel=1e-3)
    assert any("330 mm was stated" in message and "300 mm" in message for message in again["messages"])
    assert rmse(run, data, "--model", "model.json", "--rest-length", "310 mm") > 5.0 * again["rmse"]
    # A muscle kept with its fit does the same, also for a file that states the length itself.
    kept = ("--save-preset", "mine-330", "--data", "data")
    saved(run, data, "--muscle", start, "--ideal", *typed, "--use", "rest_length", *kept)
    stating = write("stating.csv", text(rows, CYCLE_HEADER, "kind: isobaric\nnominal_length: 330 mm"))
    mine = ("--muscle", "mine-330", "--data", "data")
    told = answer_of(run("compare", stating, *mine, "--json"))
    assert told["rmse"] == pytest.approx(again["rmse"], rel=1e-3)
    assert any("330 mm was stated" in message for message in told["messages"])
    assert rmse(run, stating, *mine, "--effect", "leak") == pytest.approx(again["rmse"], rel=1e-3)
    # So does what is kept of it in its turn.
    _, later = saved(run, stating, *mine, "--free", "nominal_length")
    assert later["stated"] == {"nominal_length": 0.33}
    # Another muscle may really have that length: then the user's word is the last one.
    assert rmse(run, stating, *mine, "--rest-length", "330 mm") > 50.0
    assert rmse(run, data, "--model", "model.json", *typed, "--keep", "rest_length") > 50.0
    both = run("compare", stating, "--muscle", "mine-330:310mm", "--data", "data")
    assert "330 mm" in refused(both)
    assert "310 mm" in refused(both)
