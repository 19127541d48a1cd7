"""The promises of README and documentation: links that lead somewhere, an example effect, own parts."""

from __future__ import annotations

import copy
import json
import re
from math import radians
from pathlib import Path

import pytest

from mckibben.application.run.simulate import SimulationQuestion, simulate
from mckibben.documents.drive_reading import drive_of, read_document
from mckibben.documents.studio import Studio
from mckibben.physics.catalogue import EffectCatalogue
from mckibben.physics.errors import InputError
from mckibben.physics.muscle import Muscle
from mckibben.resources import presets_folder
from mckibben.simulation.statics.model import StaticModel

ROOT = Path(__file__).parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
PAGES = {
    path: path.read_text("utf-8") for path in (ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md")))
}
OWN_PARTS = PAGES[ROOT / "docs" / "how-to" / "own-parts.md"]
MADE = {"first_steps.md", "missing_effect.md", "sizing_a_lift.md", "own_parts.md", "commands.md", "python.md"}
MADE |= {"presets.md", "paper.md", "index.md"}  # by docs/build.py


@pytest.fixture
def example_folder(tmp_path: Path) -> Path:
    blocks = re.findall(r"```python\n(.*?)```", OWN_PARTS, flags=re.DOTALL)
    (example,) = (block for block in blocks if "EFFECT = Effect(" in block)
    (tmp_path / "seal_drag.py").write_text(example, encoding="utf-8")
    return tmp_path


def test_exactly_two_commands():
    commands = re.findall(r"```bash\n(.*?)```", README, flags=re.DOTALL)
    assert len(commands) == 2
    assert all(len(command.strip().splitlines()) == 1 for command in commands)


def test_the_readme_is_read_in_a_minute() -> None:
    assert len(README.encode()) <= 6_000


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_links_and_files_named_exist(page: Path) -> None:
    for link in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", PAGES[page]):
        target = (page.parent / link).resolve()
        assert target.exists() or target.name in MADE, link
    for path in re.findall(r"`((?:backend|tests|frontend|presets|docs)/[\w./-]+)`", PAGES[page]):
        assert (ROOT / path).exists(), path


def test_the_example_effect_takes_its_force_off_every_curve(example_folder):
    catalogue = EffectCatalogue([example_folder])
    assert catalogue.problems == []
    muscle = Muscle(0.3, 0.02, radians(25))
    state = {"length": [0.25, 0.28], "pressure": [3e5, 5e5], "clipped": False}
    plain = StaticModel(muscle, catalogue=catalogue).force(**state)
    dragged = StaticModel(muscle, {"seal_drag": {}}, catalogue=catalogue).force(**state)
    assert dragged - plain == pytest.approx([-5.0, -5.0])


def test_the_example_effect_reaches_the_interface_with_no_other_edit(example_folder):
    from fastapi.testclient import TestClient

    from mckibben.server.app import create_app
    from mckibben.server.settings import Settings

    client = TestClient(create_app(Settings(effects=(example_folder,))), base_url="http://127.0.0.1")
    effects = {effect["id"]: effect for effect in client.get("/api/effects").json()["effects"]}
    assert effects["seal_drag"]["title"] == "Seal drag"
    assert "<math" in effects["seal_drag"]["equation_mathml"]
    request = {"muscle": {"preset": "DMSP-20"}, "pressures": [3e5], "points": 5, "unclipped": True}
    request |= {"contraction_from": 0.0, "contraction_to": 0.2}
    plain, dragged = (
        client.post("/api/curves", json={**request, "effects": effect}).json()["force"][0]
        for effect in ({}, {"seal_drag": {"drag": "7 N"}})
    )
    assert [a - b for a, b in zip(plain, dragged, strict=True)] == pytest.approx([7.0] * 5)


def test_the_folder_of_own_parts_is_read_and_nothing_in_it_can_be_left_out(tmp_path):
    section = OWN_PARTS
    layout = re.search(r"```\nmy-presets/\n(.*?)```", section, flags=re.DOTALL)
    assert layout
    names = layout[1].split()
    blocks = re.findall(r"```json\n(.*?)```", section, flags=re.DOTALL)
    assert [json.loads(block)["id"] for block in blocks] == [Path(name).stem for name in names]

    def library(folder, documents):
        for name, document in zip(names, documents, strict=True):
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text(json.dumps(document), "utf-8")
        return Studio(presets=presets_folder(), user_presets=folder)

    def ran(folder, documents):
        studio = library(folder, documents)
        if studio.library.problems():
            return None
        try:
            return simulate(SimulationQuestion(drive_of(read_document(drive, "the drive"), studio)))
        except InputError:
            return None

    muscle, valve = documents = [json.loads(block) for block in blocks]
    drive = {
        "muscle": {"preset": muscle["id"]}, "valve": {"preset": valve["id"]}, "tube": None,
        "supply": {"pressure": "6 bar"}, "load": {"mass": "5 kg"}, "duration": "2 s",
        "command": {"shape": "pulse", "on": "0 s", "off": "1 s"},
    }  # fmt: skip
    run = ran(tmp_path / "all", documents)
    assert run is not None
    assert run.outcome == "completed"
    assert run.timing.extend.rise_time > 0.0

    for index, document in enumerate(documents):  # minimal: without any of its values no drive runs
        for part in ("geometry", "limits", "data"):
            for key in document.get(part, {}):
                less = copy.deepcopy(documents)
                del less[index][part][key]
                assert ran(tmp_path / f"{index}-{key}", less) is None, f"{key} is not needed"
