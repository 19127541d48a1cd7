"""``mckibben diagnose --report``: the diagnosis as a file."""

from __future__ import annotations

from pathlib import Path

import pytest

from mckibben import cli

CSV = "# kind: static\npressure_bar;length_mm;force_N\n" + "".join(
    f"{p};{length};{100 * p + length / 10:.1f}\n" for p in (1, 2, 3) for length in (280, 290, 300)
)


@pytest.fixture(autouse=True)
def _measurement(_own_folders: None) -> None:
    Path("-my run.csv").write_text(CSV, "utf-8")


def test_the_file_is_written_beside_the_tables(capsys: pytest.CaptureFixture[str]) -> None:
    assert cli.run(["diagnose", "./-my run.csv", "--muscle", "DMSP-20", "--ideal", "--report", "r.html"]) == 0
    captured = capsys.readouterr()
    assert "report: r.html" in captured.err
    assert "after adding" in captured.out
    text = Path("r.html").read_text("utf-8")
    assert text.startswith("<!DOCTYPE html>")
    assert "SHA-256" in text
    # A name that a shell or the command line would take for something else.
    assert "mckibben compare './-my run.csv' --drive model.json" in text


def test_a_file_that_cannot_be_written_is_one_line(capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["diagnose", "./-my run.csv", "--muscle", "DMSP-20", "--ideal", "--report", "no/r.html"]
    assert cli.run(arguments) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert "--report no/r.html: there is no folder no" in error
