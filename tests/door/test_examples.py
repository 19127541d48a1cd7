"""The stories in presets/examples run, and README and documentation show them."""

from __future__ import annotations

import re
import runpy
from pathlib import Path

import pytest

from mckibben.resources import presets_folder

ROOT = Path(__file__).parents[2]
STORIES = sorted((presets_folder() / "examples").glob("*.py"))


def test_there_are_four() -> None:
    names = {story.stem for story in STORIES}
    assert names == {"first_steps", "missing_effect", "own_parts", "sizing_a_lift"}


@pytest.mark.parametrize("story", STORIES, ids=lambda story: story.stem)
def test_a_story_runs(story: Path, capsys: pytest.CaptureFixture[str]) -> None:
    found = runpy.run_path(str(story), run_name="__main__")
    out = capsys.readouterr().out
    assert out
    if story.stem == "missing_effect":  # the model found below 4 bar predicts what is above
        assert found["new"].rmse < 0.2 * found["ideal"].compare(found["high"]).rmse
    elif story.stem == "sizing_a_lift":  # the full run keeps the promise of the proposal
        assert found["run"].position.max() == pytest.approx(0.06, rel=0.01)
        assert found["run"].timing.extend.positioning_time <= 0.5
    elif story.stem == "own_parts":
        assert found["after"].rmse < 0.5 * found["before"].rmse
        assert found["after"].parameters["geometry"]["braid_angle"].fitted
    else:
        assert found["lost"] > 0.0
        assert found["lifted"].position.max() > 0.05


@pytest.mark.parametrize("story", STORIES, ids=lambda story: story.stem)
def test_a_story_opens_as_a_notebook(story: Path) -> None:
    text = story.read_text("utf-8")
    cells = re.findall(r"^# %%(.*)$", text, re.MULTILINE)
    assert text.startswith("# %% [markdown]\n# # ")
    assert {cell.strip() for cell in cells} == {"", "[markdown]"}
    imports = set(re.findall(r"^(?:import|from) .*$", text, re.MULTILINE))
    assert imports <= {"import mckibben as mk", "from pathlib import Path"}


def test_the_readme_shows_the_first_ten_lines() -> None:
    story = (presets_folder() / "examples" / "first_steps.py").read_text("utf-8")
    lines = [line for line in story.splitlines() if line and not line.startswith("#")]
    readme = (ROOT / "README.md").read_text("utf-8")
    (block,) = re.findall(r"```python\n(.*?)```", readme, flags=re.DOTALL)
    shown = [line for line in block.splitlines() if line]
    assert shown == lines[:10]


def test_the_effect_of_the_documentation_is_the_one_of_the_story() -> None:
    own = presets_folder() / "examples" / "own" / "effects" / "seal_drag.py"
    assert own.read_text("utf-8") in (ROOT / "docs" / "how-to" / "own-parts.md").read_text("utf-8")
