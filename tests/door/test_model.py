"""Models: statics against the closed form, other models from them, files, and one sentence for bad input."""

from __future__ import annotations

import json
from collections.abc import Callable
from math import pi, radians, sin, tan
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mckibben as mk
from mckibben.resources import presets_folder
from tests.cli.conftest import Run

DRAWN: dict[str, Any] = {"inside_diameter": "20 mm", "braid_angle": "25 deg", "nominal_length": "300 mm"}


def closed_form(pressure: Any, contraction: Any) -> Any:
    """Chou and Hannaford: F = pi D0^2 p / 4 (a (1 - k)^2 - b)."""
    angle = radians(25.0)
    a, b = 3.0 / tan(angle) ** 2, 1.0 / sin(angle) ** 2
    return pi * 0.02**2 / 4.0 * pressure * (a * (1.0 - contraction) ** 2 - b)


def test_force_is_the_closed_form_over_whole_arrays() -> None:
    pressure, contraction = np.array([[1e5], [3e5], [6e5]]), np.linspace(0.0, 0.2, 7)
    force = mk.Model(**DRAWN).force(pressure=pressure, contraction=contraction)
    assert force.shape == (3, 7)
    assert force == pytest.approx(closed_form(pressure, contraction), rel=1e-12)


def test_force_takes_texts_numbers_lists_and_lengths() -> None:
    model = mk.Model(**DRAWN)
    expected = closed_form(3e5, 0.1)
    assert model.force(pressure="3 bar", contraction="10 %") == pytest.approx(expected)
    assert model.force(pressure=3e5, length="270 mm") == pytest.approx(expected)
    assert model.force(pressure=["3 bar", 3e5], length=0.27) == pytest.approx([expected, expected])
    assert model.force(pressure="4.01325 bar(a)", contraction=0.1) == pytest.approx(expected)
    assert model.force(pressure=3e5, contraction=0.1).shape == ()


def test_a_slack_muscle_has_no_tension_unless_asked_for() -> None:
    model = mk.Model(**DRAWN)
    assert model.force(pressure="1 bar", contraction="40 %") == 0.0
    pushing = model.force(pressure="1 bar", contraction="40 %", unclipped=True)
    assert pushing == pytest.approx(closed_form(1e5, 0.4))
    assert pushing < 0.0


def test_stiffness_from_the_force_and_the_secant() -> None:
    plain = mk.Model(**DRAWN).curves("3 bar")
    assert plain.stiffness_from_force is None
    assert plain.stiffness_secant is None
    curves = mk.Model(**DRAWN).curves("3 bar", contraction_to="20 %", further_stiffness=True)
    assert curves.stiffness_from_force == pytest.approx(curves.stiffness, rel=1e-9)
    secant = curves.stiffness_secant
    assert secant is not None
    shortest = 0.3 / np.cos(radians(25.0)) / np.sqrt(3.0)
    assert secant[0] == pytest.approx(curves.force[0] / (curves.length - shortest), rel=1e-9)
    assert {"stiffness_from_force_N/m", "stiffness_secant_N/m"} <= set(curves.to_frame().columns)


def test_friction_has_a_direction() -> None:
    model = mk.Model(**DRAWN).with_effect("coulomb_friction", force="10 N")
    shorter, mean, longer = model.force(pressure="3 bar", contraction="10 %", direction=[-1, 0, 1])
    assert (shorter - mean, longer - mean) == pytest.approx((-10.0, 10.0))


def test_three_forms_of_geometry_are_the_same_muscle() -> None:
    geometry = mk.Model(**DRAWN).geometry
    by_thread = mk.Model(thread_length=geometry.thread_length, turns=geometry.turns, nominal_length="300 mm")
    assert by_thread.geometry.braid_angle == pytest.approx(radians(25.0))
    assert by_thread.force(pressure=3e5, contraction=0.1) == pytest.approx(closed_form(3e5, 0.1))


def test_other_models_leave_the_first_as_it_is() -> None:
    model = mk.Model.preset("DMSP-20", length="300 mm")
    assert set(model.ideal().effects) == set()
    assert set(model.without("dahl").effects) == set(model.effects) - {"dahl"}
    stiffer = model.with_effect("bladder_elasticity", shear_modulus="0.5 MPa")
    assert stiffer.effects["bladder_elasticity"]["shear_modulus"] == 0.5e6
    assert stiffer.effects["prestress"] == model.effects["prestress"]
    assert model.effects["bladder_elasticity"]["shear_modulus"] == 468e3
    assert stiffer != model
    assert mk.Model.preset("DMSP-20", length=0.3) == model
    with pytest.raises(AttributeError, match="does not change"):
        model.effects_ = {}  # type: ignore[attr-defined]
    with pytest.raises(AttributeError, match="does not change"):
        model._stated = None  # type: ignore[assignment]
    model.effects["bladder_elasticity"]["shear_modulus"] = 0.0  # type: ignore[index]
    assert model.effects["bladder_elasticity"]["shear_modulus"] == 468e3
    with pytest.raises(ValueError, match="read-only"):
        model.curves("1 bar").force[0, 0] = 0.0


def test_a_typed_term_is_kept_in_files() -> None:
    model = mk.Model(**DRAWN).with_effect("custom", term="-c*P", c=1e-4)
    lost = mk.Model(**DRAWN).force(pressure=3e5, contraction=0.1) - model.force(pressure=3e5, contraction=0.1)
    assert lost == pytest.approx(30.0)
    model.save("typed.json")
    assert mk.load("typed.json") == model


def test_a_saved_model_is_the_same_model_here_and_on_the_command_line(run: Run) -> None:
    model = mk.Model.preset("DMSP-20", length="250 mm").without("dahl", "viscous_damping")
    model.save("model.json")
    again = mk.load("model.json")
    assert again == model
    assert hash(again) == hash(model)
    data = "martens-dmsp-20-300"
    other = mk.read(data).to_frame()
    other = mk.Measurement.from_frame(other[other["force_N"] > 0.0], name="map")
    other.save("map.csv")
    code, out, err = run("compare", "map.csv", "--model", "model.json", "--json")
    assert code == 0, err
    assert model.compare("map.csv").rmse == pytest.approx(json.loads(out)["rmse"], rel=1e-12)


def test_files_of_every_kind_are_models() -> None:
    Path("geometry.json").write_text(json.dumps(DRAWN), "utf-8")
    Path("drive.json").write_text(json.dumps({"muscle": DRAWN, "effects": {"prestress": {}}}), "utf-8")
    assert mk.load("geometry.json") == mk.Model(**DRAWN)
    assert mk.load("drive.json") == mk.Model(**DRAWN).with_effect("prestress")
    preset = mk.load(presets_folder() / "muscles" / "DMSP-20.json")
    assert preset.effects == mk.Model.preset("DMSP-20").effects
    state: dict[str, Any] = {"pressure": "6 bar", "contraction": "10 %"}
    assert preset.force(**state) == mk.Model.preset("DMSP-20").force(**state)


def test_a_fit_and_a_diagnosis_can_be_changed_and_saved() -> None:
    data = mk.read("martens-dmsp-10-250")
    compared = mk.Model.preset("DMSP-10").compare(data, fit=True, free="braid_angle")
    fitted = compared.model
    assert fitted.compare(data).rmse == pytest.approx(compared.rmse, rel=1e-9)
    assert "geometry" in compared.parameters
    assert fitted.document["origin"]["verdict"] == "fitted, not diagnosed"
    changed = fitted.without("prestress")
    changed.save("changed.json")
    assert "origin" not in mk.load("changed.json").document  # its error was another model's
    assert changed.compare(data).rmse != compared.rmse


WRONG: list[tuple[Callable[[], object], tuple[str, ...]]] = [
    (lambda: mk.Model.preset("DMSP-21"), ("curves", "--muscle", "DMSP-21")),
    (
        lambda: mk.Model.preset("DMSP-20", effects={"blader_elasticity": {}}),
        ("curves", "--muscle", "DMSP-20", "--effect", "blader_elasticity"),
    ),
    (
        lambda: mk.Model.preset("DMSP-20").curves("1 bar, 3 mm"),
        ("curves", "--muscle", "DMSP-20", "--pressure", "1 bar,3 mm"),
    ),
    (lambda: mk.read("nowhere.csv"), ("convert", "nowhere.csv")),
    (lambda: mk.load("nowhere.json"), ("curves", "--muscle", "nowhere.json")),
    (lambda: mk.Drive.load("nowhere.json"), ("simulate", "nowhere.json")),
    (lambda: mk.size("nowhere.json"), ("size", "nowhere.json")),
    (
        lambda: mk.Model.preset("DMSP-20").compare("martens-dmsp-20-300", fit=True, free="braid_angel"),
        ("compare", "martens-dmsp-20-300", "--muscle", "DMSP-20", "--fit", "--free", "braid_angel"),
    ),
    (
        lambda: mk.Model.preset("DMSP-20").compare("martens-dmsp-20-300", use="lenght"),
        ("compare", "martens-dmsp-20-300", "--muscle", "DMSP-20", "--use", "lenght"),
    ),
]


@pytest.mark.parametrize(("call", "command"), WRONG, ids=range(len(WRONG)))
def test_bad_input_is_the_sentence_of_the_command_line(
    run: Run, call: Callable[[], object], command: tuple[str, ...]
) -> None:
    with pytest.raises(mk.Problem) as caught:
        call()
    assert caught.value.__cause__ is None
    assert caught.value.__context__ is None  # no inner traceback is printed
    code, _, err = run(*command)
    assert code == 2
    sentence = err.removeprefix("mckibben: ").rstrip("\n")
    # Options are arguments here: "--pressure: ..." is "pressure: ...". What an option repeats is left out.
    for option in ("--muscle DMSP-21: ", "--effect blader_elasticity: ", "--"):
        sentence = sentence.replace(option, "")
    mine = str(caught.value).replace("effects.blader_elasticity: ", "")
    words = mine.replace("there is no effect 'blader_elasticity'", "there is no such effect")
    assert words.replace('"', "'") == sentence.replace('"', "'")


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda m: m.force(pressure="3 bar"), ["contraction", "length"]),
        (lambda m: m.force(pressure="3 bar", contraction=0.1, length=0.2), ["either"]),
        (lambda m: m.force(pressure="3 mm", contraction=0.1), ["pressure", "a length", "6 bar"]),
        (lambda m: m.force(pressure=[1e5, float("nan")], contraction=0.1), ["value 2", "finite"]),
        (lambda m: m.force(pressure=-1e5, contraction=0.1), ["0 and 1000 bar"]),
        (lambda m: m.force(pressure=1e5, length="1 m"), ["1000 mm", "braid lock"]),
        (lambda m: m.force(pressure=[1e5, 2e5], contraction=[0.1, 0.1, 0.1]), ["shapes", "(2,)", "(3,)"]),
        (lambda m: m.force(pressure=[[1e5], [1e5, 2e5]], contraction=0.1), ["pressure", "equal length"]),
        (lambda m: m.force(pressure=None, contraction=0.1), ["pressure", "empty"]),
        (lambda m: m.curves([]), ["0 pressures"]),
        (lambda m: m.curves(points=1), ["points"]),
        (lambda m: m.without("dahl"), ["no effect 'dahl'"]),
        (lambda m: m.with_effect("prestress", forse=3), ["forse", "force"]),
        (lambda m: m.with_effect("prestress", force="1 m"), ["force"]),
        (lambda m: m.with_geometry(braid_angel="25 deg"), ["braid_angel", "braid_angle"]),
        (lambda m: m.compare(3), ["int", "mk.read"]),
        (lambda m: m.compare([]), ["at least one"]),
        (lambda m: m.diagnose("martens-dmsp-20-300", noise=-1.0), ["noise"]),
        (lambda m: m.save("no/folder/model.json"), ["no/folder", "cannot be written"]),
        (lambda m: m.curves().save("curves.txt"), [".json", ".csv"]),
        (lambda m: mk.Model(braid_angle="25 deg", nominal_length="300 mm"), ["diameter"]),
        (lambda m: mk.Model(inside_diameter=[1], braid_angle=0.4, nominal_length=0.3), ["inside_diameter"]),
    ],
)
def test_bad_arguments_are_one_sentence(call: Callable[[mk.Model], object], words: list[str]) -> None:
    with pytest.raises(mk.Problem) as caught:
        call(mk.Model(**DRAWN))
    assert "\n" not in str(caught.value)
    for word in words:
        assert word in str(caught.value)


def test_a_fitted_model_is_kept_as_a_muscle_with_intervals() -> None:
    data = mk.read("martens-dmsp-20-300")
    fitted = mk.Model.preset("DMSP-20", length="300 mm").compare(data, fit=True).model
    mine = fitted.keep("bench-4", title="Bench 4")
    assert mine.name.startswith("bench-4")
    interval = mine.curves("3 bar").interval
    assert interval is not None
    low, high = interval
    assert (low <= high).all()
    assert low.shape == high.shape == mine.curves("3 bar").force.shape
    assert mk.Model.preset("DMSP-20").curves("3 bar").interval is None
    assert fitted.with_effect("creep").curves("3 bar").interval is None
    with pytest.raises(mk.Problem, match="taken by a built-in"):
        fitted.keep("DMSP-20")
