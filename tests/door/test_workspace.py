"""Presets and effects of the user's own."""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

import mckibben as mk
from mckibben.resources import presets_folder
from tests.cli.conftest import Run

OWN = presets_folder() / "examples" / "own"


@pytest.fixture(autouse=True)
def _as_before() -> Iterator[None]:
    yield
    mk.use_effects()
    mk.use_presets(None)


def test_own_presets_and_effects_are_those_of_the_command_line(run: Run) -> None:
    mk.use_presets(OWN / "presets")
    mk.use_effects(OWN / "effects")
    assert mk.presets("muscles")["bench-10"].own
    assert not mk.presets("muscles")["DMSP-20"].own
    assert mk.effects()["seal_drag"].parameters["drag"].default == 5.0
    plain = mk.Model.preset("bench-10")
    dragged = plain.with_effect("seal_drag", drag="7 N")
    state = {"pressure": "3 bar", "contraction": ["0 %", "10 %"]}
    assert plain.force(**state) - dragged.force(**state) == pytest.approx([7.0, 7.0])
    code, out, _ = run(
        "curves", "--muscle", "bench-10", "--presets", str(OWN / "presets"), "--pressure", "3 bar", "--json"
    )
    assert code == 0
    assert plain.curves("3 bar").force.tolist() == json.loads(out)["force"]
    dragged.save("dragged.json")
    assert mk.load("dragged.json").force(**state) == pytest.approx(dragged.force(**state))
    # A model keeps the effects it was made with; a new one has those of the session.
    mk.use_effects()
    assert dragged.force(**state) == pytest.approx(plain.force(**state) - 7.0)
    with pytest.raises(mk.Problem, match="seal_drag"):
        plain.with_effect("seal_drag")


def test_a_changed_effect_is_loaded_again(tmp_path: Path) -> None:
    shutil.copy(OWN / "effects" / "seal_drag.py", tmp_path / "seal_drag.py")
    mk.use_effects(tmp_path)
    text = (tmp_path / "seal_drag.py").read_text("utf-8")
    (tmp_path / "seal_drag.py").write_text(text.replace("default=5.0", "default=6.0"), "utf-8")
    mk.use_effects(tmp_path)
    assert mk.effects()["seal_drag"].parameters["drag"].default == 6.0


def test_files_that_cannot_be_used_are_told_as_the_command_line_tells_them(tmp_path: Path, run: Run) -> None:
    (tmp_path / "broken.py").write_text("EFFECT = 1\n", "utf-8")
    with pytest.warns(UserWarning, match=r"effect file broken\.py is not used") as told:
        mk.use_effects(tmp_path)
    _, _, err = run("curves", "--muscle", "DMSP-20", "--effects", str(tmp_path))
    assert err.splitlines()[0] == str(told[0].message)


@pytest.mark.parametrize("use", [mk.use_presets, mk.use_effects])
def test_a_folder_that_is_none_is_refused(use, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("", "utf-8")
    with pytest.raises(mk.Problem, match="does not exist"):
        use(tmp_path / "nowhere")
    with pytest.raises(mk.Problem, match="is not a folder"):
        use(tmp_path / "file")


def test_an_unknown_kind_has_a_near_one() -> None:
    with pytest.raises(mk.Problem, match="muscles"):
        mk.presets("muscle")
    assert {"muscles/DMSP-20", "drives/propneu-20", "tasks/lift-20kg"} <= set(mk.presets())
    assert mk.presets("drives").to_frame()["id"].tolist() == list(mk.presets("drives"))
