"""A fitted model kept as a muscle of the user: sources, the fit, and what cannot be kept."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from mckibben.application.model.save_muscle import keep
from mckibben.documents.saved_model import read_saved_model
from mckibben.documents.start_model import StatedMuscle
from mckibben.documents.studio import Studio
from mckibben.physics.errors import InputError
from mckibben.presets import MusclePreset
from mckibben.resources import presets_folder

MODEL: dict[str, Any] = {
    "schema": 1,
    "kind": "model",
    "muscle": {"preset": "DMSP-20", "nominal_length": "250 mm", "braid_angle": "25.1 deg"},
    "effects": {"bladder_elasticity": {"shear_modulus": "0.5 MPa"}, "coulomb_friction": {}},
    "free": ["braid_angle"],
    "envelope": {"pressure": {"least": 1e5, "most": 5e5, "unit": "Pa"}},
    "errors": {"force": 8.0},
    "covariance": {
        "names": ["bladder_elasticity.shear_modulus", "braid_angle"],
        "matrix": [[1e8, 0.0], [0.0, 1e-6]],
    },
    "origin": {
        "program": "mckibben",
        "made": "2026-01-02T03:04:05+00:00",
        "kind": "isobaric",
        "predicted": "force",
        "verdict": "x",
        "error": {"rmse": 8.0, "holdout_rmse": 9.0, "noise": 7.0, "unit": "N"},
        "files": [{"name": "bench.csv", "sha256": None, "rows": 200}],
    },
}


@pytest.fixture
def studio(tmp_path: Path) -> Studio:
    return Studio(presets=presets_folder(), user_presets=tmp_path)


def kept(studio: Studio, **changes: Any) -> MusclePreset:
    return keep(read_saved_model(MODEL | changes, "the model"), studio, id="mine", title="Mine")


def test_fitted_values_name_the_data_and_the_others_keep_their_sources(studio: Studio) -> None:
    preset, base = kept(studio), studio.library.muscle("DMSP-20")
    assert preset.geometry.braid_angle.source == "fitted to bench.csv"
    assert preset.geometry.braid_angle.grade == "user"
    assert preset.geometry.inside_diameter == base.geometry.inside_diameter
    assert preset.geometry.nominal_length.source == "of the model, not fitted"
    assert preset.effects["bladder_elasticity"]["shear_modulus"].source == "fitted to bench.csv"
    assert preset.limits == base.limits
    assert preset.data == base.data
    assert (preset.id, preset.title, preset.origin) == ("mine", "Mine", "user")


def test_the_fit_comes_back_with_the_muscle_until_it_is_changed(studio: Studio) -> None:
    kept(studio)
    start = studio.start_model(StatedMuscle(preset="mine"), None)
    fit = start.fit
    assert fit is not None
    assert fit.covariance is not None
    assert fit.covariance.names == MODEL["covariance"]["names"]
    assert fit.errors == {"force": 8.0}
    assert fit.envelope["pressure"].most == 5e5
    assert start.muscle.nominal_length == 0.25
    # Another length is the same model; another dimension or effect is none that was fitted.
    assert studio.start_model(StatedMuscle(preset="mine", nominal_length=0.4), None).fit == fit
    assert studio.start_model(StatedMuscle(preset="mine", wall_thickness=2e-3), None).fit is None
    assert studio.start_model(StatedMuscle(preset="mine"), {}).fit is None
    effects = {name: dict(values) for name, values in start.effects.items()}
    assert studio.start_model(StatedMuscle(preset="mine"), effects).fit == fit
    effects["bladder_elasticity"]["shear_modulus"] *= 1.1
    assert studio.start_model(StatedMuscle(preset="mine"), effects).fit is None


def test_a_model_that_nobody_fitted_is_kept_without_a_fit(studio: Studio) -> None:
    document = {name: value for name, value in MODEL.items() if name not in ("origin", "covariance")}
    preset = keep(read_saved_model(document, "the model"), studio, id="plain")
    assert preset.fit is None
    assert preset.title == "plain"


def test_a_typed_term_is_refused(studio: Studio) -> None:
    typed = {"custom": {"term": "-c*sign(v)", "c": 3.0}}
    with pytest.raises(InputError, match="typed term") as refused:
        kept(studio, effects=typed)
    assert refused.value.hint is not None
    assert "JSON" in refused.value.hint


def test_a_model_without_any_length_is_refused(studio: Studio) -> None:
    muscle = {"inside_diameter": "20 mm", "braid_angle": "25 deg"}
    with pytest.raises(InputError, match="several lengths") as refused:
        kept(studio, muscle=muscle, free=[])
    assert refused.value.field == "muscle.nominal_length"


def test_an_id_of_the_program_is_refused(studio: Studio) -> None:
    with pytest.raises(InputError, match="taken by a built-in"):
        keep(read_saved_model(MODEL, "the model"), studio, id="DMSP-20")


@pytest.mark.parametrize(
    ("table", "words"),
    [
        ({"names": ["a.b"], "matrix": [[1.0, 2.0]]}, "1 rows of 1"),
        ({"names": ["a.b", "a.c"], "matrix": [[1.0, 0.5], [0.4, 1.0]]}, "symmetric"),
        ({"names": ["a.b", "a.c"], "matrix": [[1.0, 2.0], [2.0, 1.0]]}, "no covariance"),
        ({"names": ["a.b"], "matrix": [[-1.0]]}, "no covariance"),
        ({"names": ["a.b", "a.b"], "matrix": [[1.0, 0.0], [0.0, 1.0]]}, "twice"),
        (
            {"names": ["a", "b", "c"], "matrix": [[1.0, 0.9, -0.9], [0.9, 1.0, 0.9], [-0.9, 0.9, 1.0]]},
            "negative variance",
        ),
    ],
)
def test_what_is_no_covariance_is_refused(studio: Studio, table: dict[str, Any], words: str) -> None:
    with pytest.raises(InputError, match=words) as refused:
        read_saved_model(MODEL | {"covariance": table}, "the model")
    assert (refused.value.field or "").startswith("covariance")
    kept(studio)
    path = next(Path(studio.library.user_folder or "").rglob("mine.json"))
    document = json.loads(path.read_text("utf-8"))
    document["fit"]["covariance"] = table
    with pytest.raises(InputError, match=words):
        studio.library.save_muscle(document)
