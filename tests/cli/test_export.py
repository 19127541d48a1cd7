"""``mckibben export``: files for other programs, one line for whatever is wrong, a story of the pages."""

from __future__ import annotations

import csv
import json
import re
import shlex
import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import mckibben as mk
from mckibben.physics.muscle import Muscle
from mckibben.simulation.statics.model import StaticModel
from tests.cli.conftest import Run, write
from tests.export.test_formats import SAVED

PAGE = (Path(__file__).parents[2] / "docs/how-to/take-a-model-along.md").read_text("utf-8")


def test_a_preset_a_file_and_a_saved_model_are_written(run: Run) -> None:
    model = write("model.json", SAVED)
    muscle = write("muscle.json", {"preset": "DMSP-10", "nominal_length": "200 mm"})
    for source, form, out, files in (
        ("DMSP-20:250mm", "c", "a.c", ["a.c", "a.h"]),
        ("propneu-20", "python", "b.py", ["b.py"]),
        (model, "matlab", "bench.m", ["bench.m"]),
        (muscle, "json", "d.json", ["d.json"]),
        (model, "c", "e.zip", ["e.zip"]),
        ("propneu-20", "linear", "f.mat", ["f.mat"]),
        ("propneu-20", "fmu3", "g.fmu", ["g.fmu"]),
    ):
        code, printed, err = run("export", source, "--as", form, "-o", out)
        assert (code, printed) == (0, "")
        named = [line for line in err.splitlines() if "The FMU" not in line]
        assert [line.rpartition(": ")[2] for line in named] == files
        assert all(Path(file).stat().st_size > 500 for file in files)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("DMSP-20", "--as", "fortran", "-o", "x.f"), ("--as fortran", "Known: c, fmu, fmu3, json")),
        (("DMSP-21", "--as", "c", "-o", "x.c"), ("DMSP-21", "DMSP-20")),
        (("none.json", "--as", "c", "-o", "x.c"), ("none.json", "cannot be read")),
        (("DMSP-20", "--as", "c", "-o", "none/x.c"), ("-o none/x.c", "there is no folder")),
        (("DMSP-20", "--as", "matlab", "-o", "my-model.m"), ("-o my-model.m", "my_model")),
        (("DMSP-20", "--as", "c"), ("-o",)),
        (("DMSP-20", "--as", "linear", "-o", "x.mat"), ("need a drive", "muscle alone")),
        (("paper-ramp", "--as", "linear", "-o", "x.mat"), ("paper-ramp", "the load does not move")),
        (("propneu-20", "--as", "linear", "-o", "x.txt"), ("-o x.txt", "'.txt'", ".mat or .json")),
    ],
)
def test_one_line_says_what_is_wrong(run: Run, arguments: tuple[str, ...], words: tuple[str, ...]) -> None:
    code, out, err = run("export", *arguments)
    assert (code, out) == (2, "")
    assert err.count("\n") == 1
    for word in words:
        assert word in err
    assert not list(Path().glob("x.*"))


def test_errors_of_a_document_name_the_file(run: Run) -> None:
    broken = write("broken.json", {**SAVED, "effects": {"dahl": {"force": "1 m"}}})
    code, _, err = run("export", broken, "--as", "c", "-o", "x.c")
    assert code == 2
    assert "broken.json: '1 m' is a length, a force is needed" in err


LIFT = {
    "muscle": {"preset": "DMSP-20", "nominal_length": "300 mm"},
    "supply": {"pressure": "6 bar"}, "valve": {"preset": "MPYE-5-1/8-HF"}, "load": {"mass": "20 kg"},
    "command": {"shape": "step", "level": 1.0, "at": "0.1 s"},
}  # fmt: skip


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"load": {"mass": '1 kg"); system("id"); //'}}, ("load.mass", "is not a unit")),
        ({"load": {"mass": "1 " + "kg*" * 100_000 + "kg"}}, ("a mass is needed",)),
        ({"effects": {"../../etc": {}}}, ("effects.../../etc", "cannot be")),
        ({"effects": {"custom": {"term": "__import__('os').system('id')"}}}, ("cannot be part of a term",)),
        ({"effects": {"custom": {"term": "c*P", "c; system('id')": 1e-6}}}, ("c; system('id')", "cannot be")),
        ({"effects": {"custom": {"term": "+".join(["c*P"] * 20_000), "c": 1e-6}}}, ("effects.custom.term",)),
        ({"title": "x" * 2_000_000}, ("larger than 1 MB",)),
        (
            {"command": {"shape": "table", "points": [[n, 0.5] for n in range(200_000)]}},
            ("larger than 1 MB",),
        ),
        ({"notes": json.loads("[" * 200 + "]" * 200)}, ("notes is not a known field",)),
    ],
)
def test_hostile_and_huge_documents_are_refused_in_one_line(run: Run, change: Any, words: Any) -> None:
    for form in ("fmu3", "linear"):
        document = write("lift.json", {**LIFT, **change})
        code, out, err = run("export", document, "--as", form, "-o", "x.fmu")
        assert (code, out) == (2, "")
        assert err.count("\n") == 1
        assert len(err) < 400
        for word in ("lift.json", *words):
            assert word in err
    assert {each.name for each in Path().iterdir()} == {"lift.json"}


def test_from_a_measurement_to_a_file_in_three_commands(run: Run) -> None:
    """The story of the documentation: a hidden loss of 90 N is found, and is in the exported file."""
    block = re.search(r"```sh\n(mckibben convert .*?)```", PAGE, re.DOTALL)
    assert block is not None
    commands = [shlex.split(line)[1:] for line in block[1].strip().splitlines()]
    assert len(commands) == 3
    muscle = Muscle(0.3, 0.0218, np.radians(26.53), 1.8e-3, 0.02)
    lost = StaticModel(muscle, {"prestress": {"force": 90.0}})
    grid = [(p, x) for p in (2e5, 3e5, 4e5, 5e5) for x in np.linspace(0.0, 0.12, 25)]
    noise = np.random.default_rng(5).normal(0.0, 1.0, len(grid))
    with Path(commands[0][1]).open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["pressure [bar]", "length [mm]", "force [N]"])
        for (pressure, contraction), error in zip(grid, noise, strict=True):
            length = 0.3 * (1.0 - contraction)
            force = float(lost.force(pressure=pressure, length=length)[0]) + error
            writer.writerow([pressure / 1e5, 1e3 * length, force])
    for command in commands:
        code, _, err = run(*command)
        assert code == 0, err
    with zipfile.ZipFile(commands[-1][-1]) as archive:
        text = " ".join(archive.read("sources/muscle.c").decode().split())
        xml = archive.read("modelDescription.xml").decode()
    saved = mk.load(commands[2][1])
    assert saved.effects["prestress"]["force"] == pytest.approx(90.0, abs=2.0)
    assert repr(saved.effects["prestress"]["force"]) in text
    assert f'start="{saved.effects["prestress"]["force"]!r}"' in xml
    assert "fitted to clean.csv" in xml
    assert "fitted to clean.csv" in text
    assert "pressure from 200000 to 500000 Pa (measured)" in text
