"""Linear models as files: those of the linear view, the same in ``.mat`` and JSON."""

from __future__ import annotations

import io
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.io import loadmat

from mckibben.documents.drive_reading import preset_document
from mckibben.documents.saved_model import read_saved_model
from mckibben.export.source import of_drive, of_saved, stated_source
from mckibben.export.subject import subject_of
from mckibben.export.use_case import ExportQuestion, export, write_export
from mckibben.physics.errors import InputError
from tests.export.models import studio
from tests.export.test_formats import HOSTILE, SAVED, hostile

LIFT = "propneu-20"
STILL = ("paper-ramp",)  # drive presets whose load is fixed


def both(name: str) -> tuple[dict[str, Any], dict[str, Any]]:
    """Content of the MATLAB file and of the JSON file of a drive preset."""
    matlab, text = export(ExportQuestion(stated_source(name, studio()), "linear"), studio()).files
    return loadmat(io.BytesIO(matlab.content), simplify_cells=True), json.loads(text.content)


def test_both_files_hold_the_same_matrices():
    matlab, said = both(LIFT)
    assert len(matlab["points"]) == len(said["points"]) == 5
    for theirs, ours in zip(matlab["points"], said["points"], strict=True):
        assert theirs["position"] == ours["point"]["position"]
        for one, other in zip(theirs["models"], ours["models"], strict=True):
            assert one["name"] == other["name"]
            for letter in "ABCD":
                np.testing.assert_array_equal(one[letter], other[letter.lower()])
            assert list(one["states"]) == [each["name"] for each in other["states"]]
    middle = next(each for each in said["points"][2]["models"] if each["primary"])
    np.testing.assert_array_equal(matlab["A"], middle["a"])
    assert list(matlab["input_units"]) == ["1", "Pa", "N"]
    positions = [each["point"]["position"] for each in said["points"]]
    assert positions == sorted(positions)
    about = subject_of(stated_source(LIFT, studio()), studio()).about
    assert said["about"]["hash"] == about.hash
    for part in (about.hash, "Fitted to the printed figures", "end stops:", "dx/dt = A x + B u"):
        assert part in matlab["about"]


def test_the_file_is_that_of_the_linear_view():
    """The main model is that of `mckibben linearise` at the same place."""
    import mckibben as mk

    matlab, said = both(LIFT)
    position = said["points"][2]["point"]["position"]
    view = mk.Drive.preset(LIFT).linearise(at=f"position {position!r} m", amplitudes=())
    for theirs, ours in zip(view.matrices(), (matlab[letter] for letter in "ABCD"), strict=True):
        np.testing.assert_allclose(ours, theirs, rtol=1e-9, atol=1e-12 * np.max(np.abs(theirs)))
    assert matlab["dead_time"] == view.details.primary.dead_time


@pytest.mark.parametrize("name", [each.id for each in studio().library.list("drives")])
def test_every_drive_preset_has_models_or_says_why_not(name):
    question = ExportQuestion(stated_source(name, studio()), "linear")
    if name in STILL:
        with pytest.raises(InputError, match=r"no linear model: the load does not move.*40 mm"):
            export(question, studio())
        return
    matlab, text = export(question, studio()).files
    assert [each.content for each in export(question, studio()).files] == [matlab.content, text.content]
    told = json.loads(text.content)
    points = told["points"]
    assert len(points) + len(told["missing"]) == 5
    assert not told["missing"] or "out of reach" in told["missing"][0]  # a stiffness that no pressures give
    assert len(points) >= 3
    assert all(np.isfinite(model["a"]).all() for each in points for model in each["models"])


def test_the_ending_chooses_the_form(tmp_path: Path):
    stated = stated_source(LIFT, studio())
    for ending in ("mat", "json", "zip"):
        path = tmp_path / f"lift.{ending}"
        assert write_export(ExportQuestion(stated, "linear"), path, studio()) == [path]
    assert {each.name for each in tmp_path.iterdir()} == {"lift.mat", "lift.json", "lift.zip"}
    with pytest.raises(InputError, match=r"'\.m'") as refused:
        write_export(ExportQuestion(stated, "linear"), tmp_path / "lift.m", studio())
    assert refused.value.hint == "lift.mat or .json or .zip"


def test_a_muscle_alone_is_refused_by_name_and_hostile_texts_stay_texts():
    with pytest.raises(InputError, match="need a drive") as refused:
        export(ExportQuestion(stated_source("DMSP-20", studio()), "linear"), studio())
    assert refused.value.field == "as"
    with pytest.raises(InputError, match="need a drive"):
        export(ExportQuestion(of_saved(read_saved_model(SAVED, "m"), studio(), "m"), "linear"), studio())
    stated = of_drive(preset_document(LIFT, studio()), studio(), "x", title=HOSTILE[:200])
    matlab, text = export(ExportQuestion(stated, "linear", "x"), studio()).files
    assert not set(text.content.decode()) & set("\x00\x1b")
    assert matlab.content.startswith(b"MATLAB 5.0 MAT-file, written by mckibben ")
    assert export(ExportQuestion(hostile("linear"), "linear"), studio()).files
