"""Models and drives from Python as files: the bytes of the command line."""

from __future__ import annotations

from pathlib import Path

import pytest

import mckibben as mk
from tests.cli.conftest import Run


def test_model_and_command_line_write_the_same(run: Run) -> None:
    model = mk.Model.preset("DMSP-20", length="250 mm")
    files = model.export("muscle.c", as_="c")
    assert [file.name for file in files] == ["muscle.c", "muscle.h"]
    kept = [file.read_bytes() for file in files]
    assert run("export", "DMSP-20:250mm", "--as", "c", "-o", "muscle.c")[0] == 0
    assert [file.read_bytes() for file in files] == kept


def test_a_drive_is_written_and_json_is_read_again() -> None:
    drive = mk.Drive.preset("propneu-20")
    (file,) = drive.export("lift.json", as_="json")
    again = mk.Drive.load(file)
    assert again.run(points=51).position.tolist() == drive.run(points=51).position.tolist()
    (file,) = mk.Model.preset("DMSP-10").with_effect("dahl").export("muscle.json", as_="json")
    assert mk.load(file).effects == mk.Model.preset("DMSP-10").with_effect("dahl").effects


def test_what_cannot_be_written_is_a_problem() -> None:
    model = mk.Model.preset("DMSP-20")
    for path, form, words in (
        ("x.f", "fortran", "no format 'fortran'"),
        ("my-model.m", "matlab", "cannot be the name"),
        ("none/x.c", "c", "no folder"),
    ):
        with pytest.raises(mk.Problem, match=words):
            model.export(path, as_=form)
    assert not list(Path().iterdir())
