"""The command line says which of the user's own files it does not use, and why."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import pytest

from mckibben import cli
from mckibben.resources import presets_folder
from tests.cli.conftest import Run, write
from tests.running_server import RunningServer

MUSCLE = json.loads((presets_folder() / "muscles" / "DMSP-20.json").read_text("utf-8")) | {"id": "mine"}
MISSPELT = {("titel" if key == "title" else key): value for key, value in MUSCLE.items()}
CURVES = ("curves", "--muscle", "DMSP-20", "--json")


@pytest.fixture
def presets(tmp_path: Path) -> Path:
    """A folder of presets with room for muscles."""
    (tmp_path / "own" / "muscles").mkdir(parents=True)
    return tmp_path / "own"


def told(run: Run, *options: str) -> list[str]:
    """The lines on stderr about files, of a command that answers all the same."""
    code, out, err = run(*CURVES, *options)
    assert code == 0
    json.loads(out)
    return [line for line in err.splitlines() if "file " in line]


def test_a_misspelt_key_is_told_with_file_field_and_what_would_be_right(run: Run, presets: Path) -> None:
    write("own/muscles/mine.json", MISSPELT)
    assert told(run, "--presets", "own") == [
        "preset file own/muscles/mine.json is not used: 'titel' is not a known key (Did you mean 'title'?)",
        "preset file own/muscles/mine.json is not used: 'title' is missing",
    ]
    code, out, err = run("curves", "--muscle", "mine", "--presets", "own")
    assert (code, out) == (2, "")
    last = err.splitlines()[-1]
    assert last.startswith("mckibben: --muscle mine: the preset 'mine' cannot be used: ")
    assert last.endswith("mine.json, titel: 'titel' is not a known key (Did you mean 'title'?)")


def changed(**parts: Any) -> dict[str, Any]:
    """The muscle with other parts."""
    return MUSCLE | parts


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("mine.json", "{", "line 1, column 2: is not JSON"),
        ("mine.json", "", "line 1, column 1: is not JSON"),
        ("mine.json", '{"id": 1, "id": 2}', "'id' occurs twice in one object (each key once)"),
        ("mine.json", "[" * 100_000, "nested deeper than 32 levels"),
        ("mine.json", '{"x": ' + "9" * 5000 + "}", "a number of thousands of digits (a number below 9e18)"),
        ("mine.json", changed(title=float("nan")), "title: nan is not a number"),
        ("mine.json", changed(effects={"prestres": {}}), "effects.prestres: there is no effect"),
        ("mine.json", changed(id="other"), "id: 'other' does not match the file name (other.json)"),
        ("dmsp-20.json", changed(id="dmsp-20"), "the id 'dmsp-20' exists already (another id)"),
        ("mine.json", changed(kind="valve"), "kind: should be 'muscle' (not 'valve')"),
        ("mine.JSON", MUSCLE, "ends in '.JSON' (rename it to mine.json)"),
        ("../mine.json", MUSCLE, "lies in no folder of a kind (put it into muscles/)"),
        ("../muscle/mine.json", MUSCLE, "'muscle' is no kind of preset (put it into muscles/)"),
        ("../musles/mine.json", "{", "'musles' is no kind of preset (Did you mean 'muscles'?)"),
        ("../mine.json", "{", "lies in no folder of a kind (put it into one of muscles, valves, "),
    ],
)
def test_whatever_is_wrong_with_a_preset_file_is_told(
    run: Run, presets: Path, name: str, content: object, words: str
) -> None:
    path = presets / "muscles" / name
    path.parent.mkdir(exist_ok=True)
    write(str(path), content)
    line = told(run, "--presets", "own")[0]
    where = os.path.normpath(path.relative_to(presets.parent))
    assert line.startswith(f"preset file {where} is not used: ")
    assert words in line


def test_many_problems_of_a_file_are_counted(run: Run, presets: Path) -> None:
    write("own/muscles/mine.json", {f"k{number}": 1 for number in range(1000)})
    lines = told(run, "--presets", "own")
    assert len(lines) == 4
    assert lines[-1] == "preset file own/muscles/mine.json: and 17 more"


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="the system has no pipes in folders")
def test_a_pipe_among_the_files_is_not_waited_for(run: Run, presets: Path) -> None:
    (presets.parent / "effects").mkdir()
    for name in ("own/muscles/mine.json", "own/mine.json", "effects/mine.py"):
        os.mkfifo(name)
    lines = told(run, "--presets", "own", "--effects", "effects")
    assert [line.partition(" is not used")[0] for line in lines] == [
        "effect file mine.py",
        "preset file own/muscles/mine.json",
        "preset file own/mine.json",
    ]


@pytest.mark.parametrize("code", ["import sys\nsys.exit('bye')", "print('hello')\nraise SystemExit('bye')"])
def test_an_effect_file_cannot_end_the_program_or_join_in(run: Run, tmp_path: Path, code: str) -> None:
    (tmp_path / "effects").mkdir()
    write("effects/mine.py", code)
    (line,) = told(run, "--effects", "effects")
    assert line == (
        "effect file mine.py is not used: line 2: it ends the program (SystemExit: bye) when it is loaded; "
        "an effect file only defines functions and EFFECT"
    )


def test_a_function_that_ends_the_program_is_told_as_one_of_its_effect(run: Run, tmp_path: Path) -> None:
    source = (Path(cli.__file__).parents[1] / "physics" / "effects" / "prestress.py").read_text("utf-8")
    (tmp_path / "effects").mkdir()
    write("effects/mine.py", source.replace("return -force", "raise SystemExit"))
    code, out, err = run("curves", "--muscle", "DMSP-20", "--effects", "effects", "--effect", "mine")
    assert (code, out) == (2, "")
    assert "effect 'mine', slot 'elastomer': it ends the program (SystemExit)" in err


def test_the_server_says_it_when_it_starts(tmp_path: Path) -> None:
    effects, muscles = tmp_path / "effects", tmp_path / "presets" / "muscles"
    effects.mkdir()
    muscles.mkdir(parents=True)
    (effects / "mine.py").write_text("raise SystemExit", "utf-8")
    (muscles / "mine.json").write_text(json.dumps(MISSPELT), "utf-8")
    with RunningServer(tmp_path, arguments=["--effects", str(effects)]) as running:
        output = running.output
    assert "effect file mine.py is not used: line 1: it ends the program (SystemExit)" in output
    assert f"preset file {muscles / 'mine.json'} is not used: 'titel' is not a known key" in output
