"""One line in, one answer out: what a muscle does with a load, against the inverse questions."""

from __future__ import annotations

import pytest

from tests.cli.conftest import Run, result_of

LINE = "How far does a DMSP-20 of 300 mm at 6 bar lift 20 kg, which pressure for 15 %?"


def test_a_question_of_one_line_is_answered_as_the_inverse_questions_are(run: Run) -> None:
    code, out, err = run("ask", LINE, "--json")
    assert (code, err) == (0, "")
    answer = result_of(out)
    assert answer["load"] == pytest.approx(20.0 * 9.80665, rel=1e-12)
    muscle = ("--muscle", "DMSP-20:300mm", "--force", f"{answer['load']!r} N", "--direction", "-1", "--json")
    rest = result_of(run("inverse", "contraction", *muscle, "--pressure", "6 bar")[1])
    assert answer["contraction"] == pytest.approx(rest["value"], rel=1e-9)
    needed = result_of(run("inverse", "pressure", *muscle, "--contraction", "15 %")[1])
    assert answer["pressure_filling"] == pytest.approx(needed["value"], rel=1e-9)


def test_it_is_shown_with_its_definitions(run: Run) -> None:
    code, out, _ = run("ask", LINE)
    assert code == 0
    assert "DMSP-20:300mm: 196.1 N at 6 bar" in out
    assert "73.36 mm" in out
    assert "From where the load hangs without pressure" in out


def test_what_is_not_read_and_what_is_missing_are_named(run: Run) -> None:
    code, out, err = run("ask", "How far does a DMSP-20 lift 20 bananas at 6 bar")
    assert (code, out) == (2, "")
    assert "'bananas' is not read" in err or "'20 bananas' is not read" in err
    assert 'the question states no load ("20 kg")' in err


def test_a_load_below_zero_is_none(run: Run) -> None:
    """A muscle does not push."""
    code, out, err = run("ask", "DMSP-20 300 mm 6 bar -20 kg")
    assert (code, out) == (2, "")
    assert "'-20 kg' is not read: below zero" in err
