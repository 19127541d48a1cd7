"""The Modelica text, which nothing compiles here: names are declared, each unknown has one equation."""

from __future__ import annotations

import re

import pytest

from mckibben.export.formats.modelica import write
from mckibben.export.language import MODELICA
from tests.export.models import subject
from tests.export.test_c import drive

WORDS = {
    *("if", "then", "else", "elseif", "and", "or", "not", "when", "elsewhen", "end", "der", "pre", "reinit"),
    *("true", "false", *MODELICA.functions.values()),
}
DECLARED = re.compile(r"^\s*(parameter |input |output |discrete )?(?:Real|Boolean) (\w+)", re.MULTILINE)


@pytest.mark.parametrize("name", ["typed", "together_1", "together_2", "lift", "valve", "regulated"])
def test_names_are_declared_and_unknowns_have_one_equation(name):
    model = drive(name) if name in ("lift", "valve", "regulated") else subject(name)
    text = write(model, "x")[0].content.decode()
    text = re.sub(r'"[^"\n]*"', "", re.sub(r"//.*", "", text))
    head, body = text.split("\nequation\n") if "\nequation\n" in text else text.split("  equation\n")
    declared = {own: (kind or "").strip() for kind, own in DECLARED.findall(head)}
    assert len(declared) == len(DECLARED.findall(head))
    body = body[: body.rindex("end X;")]
    used = set(re.findall(r"(?<![\w.])[A-Za-z]\w*", re.sub(r"\b\d[\d.]*(?:e[-+]?\d+)?", "", body)))
    assert used - WORDS <= declared.keys(), used - WORDS - declared.keys()
    equations = re.findall(r"^\s*(?:der\()?(\w+)\)? = ", body, re.MULTILINE)
    unknown = [own for own, kind in declared.items() if kind not in ("parameter", "input")]
    assert sorted(equations) == sorted(unknown)
    # A state may be set in one when-clause only.
    assert len(re.findall(r"^\s*when \w+ > 0\.5 then", body, re.MULTILINE)) <= 1
