"""The study document: what is refused, with which field, and fields by their paths."""

from __future__ import annotations

import json
from math import pi
from pathlib import Path
from typing import Any

import pytest

from mckibben.application.study.study import StudyQuestion, study_question
from mckibben.documents.studio import Studio
from mckibben.documents.study import read_study, read_study_file
from mckibben.documents.study_fields import with_values
from mckibben.physics.errors import InputError
from mckibben.resources import presets_folder
from tests.application.model.test_saved import MODEL
from tests.shipped import shipped_studio

MASS: dict[str, Any] = {"path": "load.mass", "from": "8 kg", "to": "12 kg"}
STUDY: dict[str, Any] = {
    "subject": {"drive": "propneu-20"},
    "quantities": [MASS],
    "figures": ["timing.extend.rise_time"],
    "method": {"type": "monte_carlo", "runs": 4},
}


@pytest.fixture(scope="module")
def studio() -> Studio:
    return shipped_studio()


def question(studio: Studio, **changes: Any) -> StudyQuestion:
    return study_question(read_study({**STUDY, **changes}), studio, most_runs=1000)


def normal(**values: Any) -> dict[str, Any]:
    return {"path": "load.mass", "distribution": {"type": "normal", **values}}


@pytest.mark.parametrize(
    ("changes", "field", "message", "hint"),
    [
        ({"figure": []}, "figure", "not a known field", "figures"),
        ({"subject": {"drive": "propneu-2"}}, "subject.drive", "among the drives", "propneu-20"),
        ({"subject": {}}, "subject", "no subject", "drive"),
        ({"subject": {"drive": "propneu-20", "task": "lift-20kg"}}, "subject", "one subject", None),
        ({"quantities": [{**MASS, "path": "load.mas"}]}, "quantities.0.path", "no field load.mas", "mass"),
        ({"quantities": [{**MASS, "path": "load"}]}, "quantities.0.path", "not one value", "load.mass"),
        ({"quantities": [{**MASS, "to": "7 kg"}]}, "quantities.0.to", "not above 8", None),
        ({"quantities": [{**MASS, "to": "7 bar"}]}, "quantities.0.to", "a mass is needed", None),
        ({"quantities": [MASS, MASS]}, "quantities.1.path", "varied twice", None),
        ({"quantities": [{"path": "load.mass"}]}, "quantities.0", "one of them", None),
        ({"quantities": [{**MASS, "values": [1]}]}, "quantities.0", "one of them", None),
        ({"quantities": [{**MASS, "relative": True}]}, "quantities.0.from", "plain number", None),
        ({"quantities": [{**MASS, "scale": "logarithmic", "from": 0}]}, "quantities.0.from", "above 0", None),
        ({"quantities": [{"path": "effects.e.x", "values": [1]}]}, "quantities.0.path", "no effect", None),
        ({"quantities": [{"path": "command.of", "values": [1]}]}, "quantities.0.path", "no quantity", "off"),
        ({"quantities": [{"path": "load.mass", "values": [1]}]}, "quantities.0.values", "range or a", "from"),
        (
            {"quantities": [normal(mean=9, deviation=0)]}, "quantities.0.distribution.deviation", "above 0",
            None,
        ),
        (
            {"quantities": [normal(mean=9, deviation=1, least=30)]},
            "quantities.0.distribution.least", "of the distribution lies between", "bounds",
        ),
        (
            {"quantities": [{**MASS, "points": 2}, normal(mean=1, deviation=1)], "method": {"type": "grid"}},
            "quantities.1.distribution", "a grid needs values", "points",
        ),
        ({"method": {"type": "grid"}}, "quantities.0.points", "without points", "values"),
        ({"method": {"type": "monte_carlo", "runs": 5000}}, "method", "at most 1000", "fewer"),
        ({"method": {"type": "sobol", "samples": 100}}, "method.samples", "power of two", "64 or 128"),
        ({"method": {"type": "optimisation"}}, "goals", "needs a goal", "figure"),
        ({"method": {"type": "robust"}}, "limits", "needs limits", "at_most"),
        ({"figures": ["timing.extend.risetime"]}, "figures", "no figure", "rise_time"),
        ({"figures": []}, "figures", "watches no figure", "rise_time"),
        ({"limits": [{"figure": "largest.force"}]}, "limits.0", "at_least, at_most", None),
        ({"limits": [{"figure": "largest.force", "at_most": "3 bar"}]}, "limits.0.at_most", "a force", None),
        (
            {"limits": [{"figure": "largest.force", "at_most": 1, "at_least": 2}]}, "limits.0.at_most",
            "nothing", None,
        ),
    ],
)  # fmt: skip
def test_what_is_wrong_and_where(studio, changes, field, message, hint):
    with pytest.raises(InputError) as found:
        question(studio, **changes)
    assert found.value.field == field
    assert message in found.value.message
    assert hint is None or hint in (found.value.hint or "")


def test_fields_have_the_units_of_the_document(studio):
    drive = {
        "muscle": {"preset": "DMSP-20", "nominal_length": "800 mm"}, "supply": {"pressure": "6 bar"},
        "valve": {"preset": "MPYE-5-1/8-HF"}, "load": {"mass": "10 kg"},
        "controller": {"kp": "20 1/m", "ki": 5, "reference": {"shape": "step", "at": 0, "level": "20 mm"}},
    }  # fmt: skip
    subject = question(studio, subject={"drive": drive}).subject
    table = {
        "muscle.nominal_length": ("m", 0.8),
        "load.inclination": ("rad", None),
        "load.force": ("N", 0.0),
        "gas.temperature": ("K", 293.15),
        "controller.kp": ("1/m", 20.0),
        "controller.ki": ("1/(m*s)", None),
        "controller.reference.level": ("m", 0.02),
        "valve.preset": (None, None),
    }
    for path, (unit, stated) in table.items():
        field = subject.field(path, studio)
        assert (field.unit, field.stated) == (unit, stated), path


def test_a_gain_is_written_with_its_unit(studio):
    """A plain number would be percent per mm."""
    drive = {
        "muscle": {"preset": "DMSP-20", "nominal_length": "800 mm"}, "supply": {"pressure": "6 bar"},
        "valve": {"preset": "MPYE-5-1/8-HF"}, "load": {"mass": "10 kg"},
        "controller": {"kp": 2.0, "reference": {"shape": "step", "at": 0, "level": "20 mm"}},
    }  # fmt: skip
    asked = question(
        studio,
        subject={"drive": drive},
        quantities=[{"path": "controller.kp", "values": ["20 1/m", "1 %/mm"]}],
        method={"type": "list"},
    )
    assert asked.document_of([20.0])["controller"]["kp"] == "20.0 1/m"
    assert asked.plan.points.ravel().tolist() == pytest.approx([20.0, 10.0])


def test_a_factor_multiplies_the_stated_value_or_the_design(studio):
    tolerance = {
        "path": "load.mass",
        "relative": True,
        "distribution": {"type": "uniform", "least": 0.9, "most": 1.1},
    }
    asked = question(studio, quantities=[tolerance])
    assert asked.document_of([1.1])["load"]["mass"] == pytest.approx(1.1 * 9.321)
    limits = [{"figure": "timing.extend.rise_time", "at_most": "1 s"}]
    asked = question(
        studio,
        quantities=[tolerance, {**MASS, "points": 3}],
        limits=limits,
        method={"type": "robust", "runs": 5},
    )
    assert [item.name for item in asked.variables] == ["load.mass", "load.mass (factor)"]
    assert asked.plan.runs == 15
    assert asked.document_of([8.0, 1.1])["load"]["mass"] == pytest.approx(8.8)


def test_effects_of_a_preset_stay_when_one_of_them_is_varied(studio):
    drive = {
        "muscle": {"preset": "DMSP-20", "nominal_length": "800 mm"}, "supply": {"pressure": "6 bar"},
        "valve": {"preset": "MPYE-5-1/8-HF"}, "load": {"mass": "10 kg"},
        "command": {"shape": "step", "at": 0},
    }  # fmt: skip
    first = question(studio, subject={"drive": drive})
    effects = first.subject.content["effects"]
    assert effects
    name, parameters = next((name, values) for name, values in effects.items() if values)
    path = f"effects.{name}.{next(iter(parameters))}"
    asked = question(
        studio,
        subject={"drive": drive},
        quantities=[{"path": path, "values": [0.5]}],
        method={"type": "grid"},
    )
    assert set(asked.document_of([0.5])["effects"]) == set(effects)


def test_a_saved_model_replaces_muscle_and_effects(studio):
    asked = question(studio, subject={"drive": "propneu-20", "model": MODEL})
    assert asked.subject.content["effects"] == MODEL["effects"]
    assert asked.subject.content["load"] == question(studio).subject.content["load"]


def test_values_at_paths_leave_the_original_alone():
    document = {"load": {"mass": 1.0, "spring": 2.0}, "stops": {}}
    changed = with_values(document, {"load.mass": 3.0, "gas.temperature": 300.0, "load.inclination": pi})
    assert changed["load"] == {"mass": 3.0, "spring": 2.0, "inclination": pi}
    assert changed["gas"] == {"temperature": 300.0}
    assert document == {"load": {"mass": 1.0, "spring": 2.0}, "stops": {}}


def test_a_study_file_names_other_files(tmp_path: Path):
    drive = json.loads((presets_folder() / "drives" / "propneu-20.json").read_text("utf-8"))
    (tmp_path / "lift.json").write_text(json.dumps(drive))
    (tmp_path / "study.json").write_text(json.dumps({**STUDY, "subject": {"drive": "lift.json"}}))
    found = read_study_file(tmp_path / "study.json")
    assert not isinstance(found.subject.drive, str)
    (tmp_path / "study.json").write_text(json.dumps({**STUDY, "subject": {"drive": "no.json"}}))
    with pytest.raises(InputError, match=r"study\.json: no\.json"):
        read_study_file(tmp_path / "study.json")
