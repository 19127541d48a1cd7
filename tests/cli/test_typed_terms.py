"""Typed terms that cannot be computed, on the command line: exit 2 and one line."""

from __future__ import annotations

import pytest

from tests.cli.conftest import Run, write
from tests.documents.test_drive_reading import EXAMPLE

TERMS = {
    "c/t": "'c / t' has no finite value at t = 0",
    "tanh(v/(c-c))": "'v / (c - c)' in 'tanh(v/(c-c))' has no finite value",
    "abs(" * 24 + "c*v" + ")" * 24: "is too large",
    "c*P\n+ log(\nP": "'c*P + log( P' is not a formula",
}


@pytest.mark.parametrize("term", TERMS, ids=["quotient", "exponential", "nest", "lines"])
@pytest.mark.parametrize(
    "command",
    [
        ("simulate", "drive.json"),
        ("compare", "martens-dmsp-20-300", "--muscle", "DMSP-20", "--drive", "model.json"),
        ("diagnose", "martens-dmsp-20-300", "--muscle", "DMSP-20", "--drive", "model.json"),
    ],
    ids=lambda command: command[0],
)
def test_a_term_that_cannot_be_computed_is_one_line(run: Run, command: tuple[str, ...], term: str) -> None:
    effects = {"custom": {"term": term}}
    write("drive.json", {**EXAMPLE, "effects": effects})
    write("model.json", {"effects": effects})
    code, out, err = run(*command)
    assert (code, out) == (2, "")
    assert err.count("\n") == 1
    assert "effects.custom.term" in err
    assert TERMS[term] in err


def test_a_term_that_fails_in_a_drive_alone_is_one_line_too(run: Run) -> None:
    term = "c*(-2)**(kappa**(P - P))"
    code, out, err = run("simulate", write("drive.json", {**EXAMPLE, "effects": {"custom": {"term": term}}}))
    assert (code, out) == (2, "")
    assert err.count("\n") == 1
    assert f"effects.custom.term: '{term}' cannot be computed" in err
