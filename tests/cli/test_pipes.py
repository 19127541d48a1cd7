"""Standard input and output, progress, and what every answer carries."""

from __future__ import annotations

import io
import json
import re
import subprocess
import sys
import time
from pathlib import Path

import pytest

from mckibben.cli import output
from mckibben.resources import presets_folder
from tests.cli.conftest import Run, write
from tests.running_server import MAIN

CSV = "# kind: static\npressure_bar;length_mm;force_N\n" + "".join(
    f"{p};{length};{100 * p + length / 10:.1f}\n" for p in (1, 2, 3) for length in (270, 280, 290, 300)
)
MAP = presets_folder() / "measurements" / "martens-dmsp-20-300.json"
FITTED = ("--muscle", "DMSP-20", "--effect", "prestress")


def feed(monkeypatch: pytest.MonkeyPatch, text: str) -> None:
    """Let standard input be this text."""
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(text.encode())))


# --- standard input


def test_a_dash_reads_standard_input(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    by_file = json.loads(run("compare", write("a.csv", CSV), *FITTED, "--json")[1])
    feed(monkeypatch, CSV)
    code, out, err = run("compare", "-", *FITTED, "--json")
    assert code == 0, err
    assert json.loads(out)["rmse"] == by_file["rmse"]
    feed(monkeypatch, CSV)
    code, out, err = run("convert", "-")
    assert code == 0, err
    assert "# read from standard input " in out
    feed(monkeypatch, CSV.replace("2;290;", "2;abc;"))
    code, out, err = run("convert", "-")
    assert (code, out) == (2, "")
    assert re.search(r"standard input.*abc", err)


def test_standard_input_comes_once(run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    feed(monkeypatch, CSV)
    code, out, err = run("compare", "-", "-", *FITTED)
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert "once" in err


# --- presets as files


def test_a_preset_file_is_the_preset(run: Run) -> None:
    write("mine.json", MAP.read_text("utf-8"))
    named, own = (
        json.loads(run("compare", data, "--muscle", "DMSP-20", "--json")[1])
        for data in ("martens-dmsp-20-300", "mine.json")
    )
    assert own["rmse"] == named["rmse"]
    assert own["rows_used"] == named["rows_used"]


def test_a_preset_file_without_points_or_with_an_error_says_so(run: Run) -> None:
    muscle = (presets_folder() / "muscles" / "DMSP-20.json").read_text("utf-8")
    code, out, err = run("compare", write("muscle.json", muscle), "--muscle", "DMSP-20")
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert "kind 'muscle'" in err
    misspelt = MAP.read_text("utf-8").replace('"title"', '"titel"')
    code, out, err = run("compare", write("map.json", misspelt), "--muscle", "DMSP-20")
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert "map.json: titel" in err


# --- the noise


@pytest.mark.examination("tests/cli/test_diagnose.py::test_a_noise_is_above_zero_and_finite")
def test_a_noise_has_a_unit(run: Run) -> None:
    file = write("a.csv", CSV)
    answers = [
        json.loads(run("diagnose", file, *FITTED, "--noise", noise, "--json")[1])
        for noise in ("2", "0.002 kN")
    ]
    assert [answer["noise_floor"]["rmse"] for answer in answers] == pytest.approx([2.0] * 2)
    code, out, err = run("diagnose", file, *FITTED, "--noise", "2 mm")
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert "--noise 2 mm" in err


# --- answers


@pytest.mark.parametrize(
    "command",
    [
        ("curves", "--muscle", "DMSP-20"),
        ("compare", "a.csv", *FITTED),
        ("diagnose", "a.csv", *FITTED),
        ("simulate", "propneu-20"),
        ("size", str(presets_folder() / "tasks" / "lift-20kg.json")),
    ],
    ids=lambda command: command[0],
)
def test_every_answer_begins_with_its_schema(run: Run, command: tuple[str, ...]) -> None:
    write("a.csv", CSV)
    code, out, err = run(*command, "--json")
    assert code == 0, err
    assert out.startswith('{"schema":1,')
    assert out.count("\n") == 1


@pytest.mark.skipif(sys.platform == "win32", reason="head is not there")
@pytest.mark.parametrize("options", [("--json",), ()], ids=["json", "table"])
def test_a_closed_pipe_ends_it_quietly(tmp_path: Path, options: tuple[str, ...]) -> None:
    command = [*MAIN, "curves", "--muscle", "DMSP-20", *options]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, cwd=tmp_path) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        process.stdout.close()  # before anything is written
        said = process.stderr.read().decode()
    assert process.returncode == 0
    assert "Traceback" not in said
    assert "BrokenPipe" not in said


# --- progress


class Terminal(io.StringIO):
    """A stream that says it is a terminal."""

    def isatty(self) -> bool:
        return True


@pytest.fixture
def terminal(monkeypatch: pytest.MonkeyPatch) -> Terminal:
    """A terminal that a test lets standard error be, once pytest has set its own."""
    stream = Terminal()
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setattr(output, "_SHOWN_AFTER", 0.05)
    return stream


def until(stream: Terminal, words: str) -> bool:
    """Whether words appear, waiting for them."""
    end = time.monotonic() + 20.0
    while words not in stream.getvalue() and time.monotonic() < end:
        time.sleep(0.02)
    return words in stream.getvalue()


def test_long_work_shows_progress_and_short_work_nothing(
    terminal: Terminal, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "stderr", terminal)
    with output.progress("fitting") as watch:
        assert until(terminal, "fitting")
        assert watch.progress is not None
        watch.progress(0.4)
        assert until(terminal, "40%")
    seen = len(terminal.getvalue())
    with output.progress("reading"):
        pass
    assert terminal.getvalue()[seen:] == ""


@pytest.mark.parametrize(
    ("words", "command"),
    [
        ("searching drives", ("size", str(presets_folder() / "tasks" / "lift-20kg.json"))),
        ("fitting", ("compare", "a.csv", *FITTED, "--fit")),
        ("reading", ("convert", "a.csv")),
        ("trying effects", ("diagnose", "a.csv", *FITTED)),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_each_long_command_shows_it(
    run: Run, terminal: Terminal, monkeypatch: pytest.MonkeyPatch, words: str, command: tuple[str, ...]
) -> None:
    shown: list[str] = []

    class Recorded(output.Timer):
        """The timer of a bar, at once."""

        def start(self) -> None:
            self.function()
            shown.append(terminal.getvalue())

    monkeypatch.setattr(output, "Timer", Recorded)
    monkeypatch.setattr(Recorded, "join", lambda self: None)
    monkeypatch.setattr(sys, "stderr", terminal)
    write("a.csv", CSV)
    code, _, _ = run(*command)
    assert code == 0
    assert words in terminal.getvalue()
    assert shown
