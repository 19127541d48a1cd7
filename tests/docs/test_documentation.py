"""What README and documentation tell a newcomer to do works, on the examples, in an empty folder."""

from __future__ import annotations

import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from mckibben.application.listing import copy_examples, example_cards, examples_folder
from mckibben.documents.kinds import kind_of
from mckibben.documents.studio import Studio
from mckibben.physics.catalogue import EffectCatalogue
from mckibben.resources import presets_folder
from tests.cli.conftest import Run
from tests.test_readme import PAGES, ROOT

PACKAGE = ROOT / "docs" / "effect-package"
LONG = (
    "compare", "diagnose", "size", "study", "effect check", "linearise", "model.json", "export lift.json",
)  # fmt: skip


def commands() -> list[str]:
    """Every command of the pages that is a line of its own, in their order."""
    blocks = [block for text in PAGES.values() for block in re.findall(r"```sh\n(.*?)```", text, re.DOTALL)]
    return list(dict.fromkeys(line for block in blocks for line in block.strip().splitlines()))


def run_commands(run: Run, lines: list[str]) -> None:
    copy_examples([], Path())
    for line in lines:
        program, *words = shlex.split(line)
        assert program == "mckibben", line
        code, _, err = run(*words)
        assert code == 0, f"{line}: {err}"


def test_the_short_commands_run_on_the_examples(run: Run) -> None:
    short = [line for line in commands() if not any(word in line for word in LONG)]
    assert len(short) > 8
    run_commands(run, short)


@pytest.mark.examination("test_the_short_commands_run_on_the_examples")
def test_every_command_runs_on_the_examples(run: Run) -> None:
    run_commands(run, [*commands(), *(card.tried_by for card in example_cards().values()
                                      if card.tried_by.startswith("mckibben"))])  # fmt: skip


def test_the_programs_of_the_pages_run(capsys: pytest.CaptureFixture[str]) -> None:
    """Those that are whole: they import what they use."""
    copy_examples([], Path())
    blocks = [
        block for text in PAGES.values() for block in re.findall(r"```python\n(.*?)```", text, re.DOTALL)
    ]
    whole = [block for block in blocks if "import mckibben as mk" in block]
    assert len(whole) == 4
    for block in whole:
        exec(compile(block, "<page>", "exec"), {})
    assert float(re.findall(r"rms ([\d.]+) mm", capsys.readouterr().out)[0]) < 0.5


def test_every_example_is_listed_and_copied_whole(run: Run) -> None:
    cards = example_cards()
    assert {path.name for path in examples_folder().iterdir()} - {"index.json", "__pycache__"} == set(cards)
    code, out, _ = run("examples", "--json")
    assert code == 0
    assert [card["name"] for card in json.loads(out)["examples"]] == list(cards)
    assert run("examples", "study.json", "-o", "there")[0] == 0
    assert {path.name for path in Path("there").iterdir()} == {"study.json", "lift.json"}
    Path("there/lift.json").write_text("mine", "utf-8")
    code, _, err = run("examples", "-o", "there")
    assert code == 2
    assert "lift.json: exists and is not the example" in err
    assert Path("there/lift.json").read_text("utf-8") == "mine"
    for card in cards.values():
        assert (
            not card.tried_by.startswith("mckibben") or card.name in card.tried_by or "own/" in card.tried_by
        )


def test_every_document_says_its_kind() -> None:
    for path in examples_folder().glob("*.json"):
        content = json.loads(path.read_text("utf-8"))
        assert path.name == "index.json" or content["kind"] == kind_of(content)


def test_an_effect_of_an_installed_package_is_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The package to copy, as pip lays it down; its install by pip is an examination."""
    shutil.copytree(PACKAGE / "src" / "mckibben_seal", tmp_path / "mckibben_seal")
    project = tomllib.loads((PACKAGE / "pyproject.toml").read_text("utf-8"))["project"]
    info = tmp_path / "mckibben_seal-0.1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text(
        f"Metadata-Version: 2.1\nName: {project['name']}\nVersion: 0.1.0\n", "utf-8"
    )
    points = project["entry-points"]["mckibben.effects"]
    lines = ["[mckibben.effects]", *(f"{name} = {value}" for name, value in points.items())]
    (info / "entry_points.txt").write_text("\n".join(lines), "utf-8")
    monkeypatch.syspath_prepend(str(tmp_path))
    studio = Studio(presets=presets_folder())
    assert studio.catalogue.problems == []
    assert set(points) == set(studio.catalogue) - set(EffectCatalogue())
    assert not studio.is_built_in(None, points)


@pytest.mark.examination("test_an_effect_of_an_installed_package_is_found")
def test_the_package_to_copy_is_installed_by_pip_and_found(tmp_path: Path) -> None:
    into = ["--no-deps", "--target", str(tmp_path), str(PACKAGE)]
    pip = [sys.executable, "-m", "pip", "install", "-q", *into]
    subprocess.run(pip, check=True, capture_output=True, timeout=300)
    paths = os.pathsep.join([str(tmp_path), str(ROOT / "backend")])
    listed = [sys.executable, "-m", "mckibben", "effects", "seal_pressure_drag", "--json"]
    found = subprocess.run(
        listed, env={**os.environ, "PYTHONPATH": paths}, check=True, capture_output=True, timeout=120
    )
    assert json.loads(found.stdout)["effects"][0]["title"] == "Drag of a pressed seal"


def test_a_new_effect_is_complete_and_a_false_one_is_told(run: Run) -> None:
    assert run("effect", "new", "my_drag")[0] == 0
    code, _, err = run("effect", "new", "my_drag")
    assert code == 2
    assert "exists already" in err
    code, out, _ = run("effect", "check", "my_drag.py", "--trials", "1", "--json")
    assert code == 0
    found = json.loads(out)
    assert found["passed"]
    assert {picture["kind"] for picture in found["seen"]} >= {"isobaric", "transient"}
    assert found["trials"][0]["outcome"] in ("found", "as a twin")
    lying = (
        Path("my_drag.py").read_text("utf-8").replace("-5.0,", "999.0,").replace('"even", 0.0', '"odd", 1.0')
    )
    Path("my_drag.py").write_text(lying, "utf-8")
    code, out, _ = run("effect", "check", "my_drag.py", "--trials", "0")
    assert code == 3
    assert "force_change is -5, not 999" in out + _
    assert (out + _).count("broken:") >= 3
