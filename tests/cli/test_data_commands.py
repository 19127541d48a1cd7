"""Any laboratory's file on the command line: what it asks, the options that answer, the canonical file."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.cli.conftest import Run, write
from tests.measurement.reading.open_files import WRITERS, OpenFile
from tests.measurement.reading.sealed_files import italian, stacked_workbook

MUSCLE = ("--muscle", "DMSP-20", "--ideal")


def put(name: str, data: bytes) -> str:
    """Write a file; its name."""
    Path(name).write_bytes(data)
    return name


@pytest.mark.parametrize("writer", WRITERS, ids=lambda writer: writer.__name__)
def test_a_file_asks_and_the_option_answers(run: Run, writer: Callable[[], OpenFile]) -> None:
    file = writer()
    put(file.name, file.data)
    code, out, err = run("convert", file.name)
    if file.stops:
        assert (code, out) == (2, "")
        assert len(err.strip().splitlines()) == 1
        assert err.startswith(f"mckibben: {file.name}: ")
        assert file.options[0] in err
    else:
        assert code == 0
        assert "--" in err  # what is open is said, with its option
        code, _, err = run("convert", file.name, "--strict")
        assert code == 2
    code, out, err = run("convert", file.name, *file.options)
    assert code == 0, err
    assert out.startswith("# kind: ")


def test_the_rest_length_of_the_file_is_the_muscles(run: Run) -> None:
    file = italian()
    put(file.name, file.data)
    for options, length in (((), 0.3), (("--rest-length", "310 mm"), 0.31)):
        code, out, err = run("compare", file.name, *MUSCLE, *options, "--json")
        assert code == 0, err
        assert json.loads(out)["geometry"]["nominal_length"] == pytest.approx(length)


def test_the_rest_length_of_the_file_is_that_of_a_diagnosis(run: Run) -> None:
    file = italian()
    lines = file.data.splitlines(keepends=True)
    head = next(n for n, line in enumerate(lines) if line.startswith(b"Tempo")) + 1
    put(file.name, b"".join([*lines[:head], *lines[head::10]]))
    code, out, err = run("diagnose", file.name, *MUSCLE, "--noise", "1 kN", "--json")  # nothing to search
    assert code == 0, err
    answer = json.loads(out)
    assert answer["experiment"]["rest_length"]["value"] == pytest.approx(0.3)
    assert answer["model"]["muscle"]["nominal_length"] == pytest.approx(0.3)


def test_files_of_different_rest_lengths_are_specimens(run: Run) -> None:
    for name, file in (("a.csv", italian()), ("b.xlsx", stacked_workbook())):
        put(name, file.data)
    code, out, err = run("compare", "a.csv", "b.xlsx", *MUSCLE, "--json")
    assert code == 0, err
    answer = json.loads(out)
    lengths = {each["file"]: each["experiment"]["rest_length"] for each in answer["specimens"]}
    assert lengths["a.csv"]["value"] == pytest.approx(0.3)
    assert lengths["b.xlsx"]["value"] == pytest.approx(0.25)
    assert {each["origin"] for each in lengths.values()} == {"file"}
    assert "rest_length" not in answer["experiment"]  # they do not agree


def test_convert_writes_what_it_prints(run: Run) -> None:
    file = italian()
    put(file.name, file.data)
    code, out, err = run("convert", file.name)
    assert code == 0, err
    assert "# nominal_length: 0.3 m" in out
    assert "# nominal_length is said by the file at prova_7.csv, line 3" in out
    assert "# pressure is read from 'Pressione relativa [mbar]' in mbar" in out
    code, nothing, err = run("convert", file.name, "-o", "clean.csv")
    assert (code, nothing) == (0, "")
    assert Path("clean.csv").read_text("utf-8") == out
    code, again, err = run("convert", "clean.csv")
    assert code == 0, err
    rows = [line for line in out.splitlines() if not line.startswith("#")]
    assert [line for line in again.splitlines() if not line.startswith("#")] == rows


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["convert", "none.csv"], ["none.csv", "no such file"]),
        (["convert", "a.csv", "-o", "no/folder/x.csv"], ["--out", "no/folder/x.csv"]),
        (["convert", "a.csv", "--column", "force"], ["--column", "channel=name"]),
        (["convert", "a.csv", "--column", "fource=Forza"], ["fource", "Did you mean 'force'?"]),
        (["convert", "a.csv", "--column", "force=Forze [N]"], ["Forze", "Did you mean"]),
        (["convert", "a.csv", "--ignore", "Traverse"], ["Traverse"]),
        (["convert", "a.csv", "--head", "77777"], ["--head", "77777"]),
        (["convert", "b.xlsx", "--sheet", "Versuch"], ["Versuch", "Did you mean 'Versuche'?"]),
        (["convert", "a.csv", "--rest-length", "5 bar"], ["--rest-length", "5 bar"]),
        (["convert", "a.csv", "--load", "x"], ["--load", "x"]),
        (
            ["compare", "DMSP-20-300-force-map", "--muscle", "DMSP-20", "--head", "3"],
            ["DMSP-20-300-force-map"],
        ),
    ],
    ids=lambda value: " ".join(value)[:50] if isinstance(value, list) else "",
)
def test_a_bad_option_is_told_in_a_line(run: Run, arguments: list[str], words: list[str]) -> None:
    put("a.csv", italian().data)
    put("b.xlsx", stacked_workbook().data)
    code, out, err = run(*arguments)
    assert (code, out) == (2, "")
    assert len(err.strip().splitlines()) == 1
    for word in words:
        assert word in err


def test_readings_in_json_may_be_larger_than_a_list_of_files(run: Run) -> None:
    rows = [
        {"pressure_bar": 1 + n % 5, "length_mm": 300 - n % 60, "force_N": round(900.0 - 12.5 * (n % 60), 6)}
        for n in range(24_000)
    ]
    assert len(json.dumps(rows)) > 1_100_000
    write("large.json", rows)
    write("small.json", rows[:300])
    errors = []
    for name in ("small.json", "large.json"):
        code, out, err = run("compare", name, *MUSCLE, "--rest-length", "300 mm", "--json")
        assert code == 0, err
        errors.append(json.loads(out)["rmse"])
    assert errors[0] == pytest.approx(errors[1])  # the same rows, eighty times
