"""The verdict in a report: every status has its colour, and rows that were set aside are named."""

from __future__ import annotations

from pathlib import Path
from typing import get_args

import pytest

from mckibben import cli
from mckibben.identification.diagnose.verdict import Status
from mckibben.report.diagnosis.verdict import _TONES
from tests.claims.test_bad_rows import spoilt
from tests.claims.test_verdicts import loops

EFFECTS = [
    part for name in ("bladder_elasticity", "prestress", "coulomb_friction") for part in ("--effect", name)
]


def test_every_status_has_a_colour() -> None:
    assert set(_TONES) == set(get_args(Status))


@pytest.mark.parametrize(("lasting", "text"), [(True, "cannot tell"), (False, "row 100")])
def test_a_report_says_what_the_data_cannot_tell_and_which_row_was_set_aside(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, lasting: bool, text: str
) -> None:
    monkeypatch.setenv("MCKIBBEN_DATA", str(tmp_path / "data"))
    file = tmp_path / "loops.csv"
    if lasting:
        loops(file, correlation=0.98, friction=0.0)
    else:
        spoilt(file, {100: 90.0})
    report = tmp_path / "report.html"
    muscle = ["--muscle", "DMSP-20:300mm"]
    assert cli.run(["diagnose", str(file), *muscle, *EFFECTS, "--report", str(report)]) == 0
    assert text in report.read_text()
