"""The thresholds of the diagnosis: each says what it means, and something is decided by it."""

from __future__ import annotations

import ast
import re
from dataclasses import fields, is_dataclass
from pathlib import Path

from mckibben.identification import thresholds

SOURCE = Path(thresholds.__file__)
GROUPS = {name: group for name, group in vars(thresholds).items() if name.isupper() and is_dataclass(group)}


def test_each_threshold_says_what_it_means() -> None:
    classes = [node for node in ast.parse(SOURCE.read_text()).body if isinstance(node, ast.ClassDef)]
    assert len(classes) == len(GROUPS)
    for node in classes:
        body = node.body[1:]  # after the docstring of the class
        for declared, said in zip(body[::2], body[1::2], strict=True):
            assert isinstance(declared, ast.AnnAssign)
            assert isinstance(said, ast.Expr)
            assert isinstance(said.value, ast.Constant)
            assert str(said.value.value).strip().endswith(".")


def test_something_is_decided_by_each_threshold() -> None:
    used = set()
    for module in SOURCE.parents[1].rglob("*.py"):
        if module != SOURCE:
            used |= set(re.findall(r"\b([A-Z]+\.[a-z_]+)\b", module.read_text()))
    assert [
        f"{name}.{each.name}"
        for name, group in GROUPS.items()
        for each in fields(group)
        if f"{name}.{each.name}" not in used
    ] == []
