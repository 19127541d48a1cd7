"""Corrections in the words of each door, and that every option which a message names is known."""

from __future__ import annotations

import ast
import re
from pathlib import Path
from typing import ClassVar

import numpy as np
import pytest

import mckibben
from mckibben.documents.doors import CORRECTIONS, in_words_of, result_in_words_of
from mckibben.facts.result import result_class

PACKAGE = Path(mckibben.__file__).parent
#: Options of commands alone: no other door gives the messages that name them, or they start the server.
COMMANDS_ALONE = frozenset({
    "out", "resume", "scheduler", "effects", "data", "quota", "host", "json", "save", "report", "proposal",
    "as", "help", "model", "presets", "stiffness",
})  # fmt: skip
NAMED = re.compile(r"(?<![\w-])--([a-z]+(?:-[a-z]+)*)")
SAID = {
    '--ignore "force_N"': ('"ignore": ["force_N"]', 'ignore=["force_N"]'),
    '--column "force=-Kraft [kN]"': (
        '"column": ["force=-Kraft [kN]"]', 'columns={"force": "-Kraft [kN]"}'
    ),
    '--experiment "force_zero=2 N"': (
        '"experiment": {"force_zero": "2 N"}', 'experiment={"force_zero": "2 N"}'
    ),
    "--load '6 kg'": ('"load": "6 kg"', 'load="6 kg"'),
    "--rest-length decides": ("rest_length decides", "rest_length decides"),
    "'--keep rest_length' takes it": (
        """'"keep": ["rest_length"]' takes it""", """'keep=["rest_length"]' takes it"""
    ),
    "a drive document (--drive DRIVE.json)": ("a drive document (drive)", "a drive document (drive)"),
    "the file of: mckibben diagnose DATA --save MODEL.json": (
        "the file of: mckibben diagnose DATA --save MODEL.json",
        'the file of: model.diagnose(data).model.save("model.json")',
    ),
    "start it with --host and that name": ("start it with --host and that name",) * 2,
}  # fmt: skip


@pytest.mark.parametrize("text", SAID)
def test_a_correction_is_said_in_the_words_of_the_door(text: str) -> None:
    assert (in_words_of("http", text), in_words_of("python", text)) == SAID[text]


@result_class
class Entry:
    """A result inside of another."""

    CORRECTING: ClassVar = ("where",)

    where: str
    """A place."""
    name: str
    """A name that is no correction."""


@result_class
class Answer:
    """A result with corrections at every depth."""

    CORRECTING: ClassVar = ("messages",)

    messages: list[str]
    """Remarks."""
    entries: dict[str, Entry]
    """By name."""
    more: list[Entry]
    """Others."""
    column: np.ndarray
    """Numbers."""


def test_a_result_says_its_corrections_in_the_words_of_the_door() -> None:
    text, column = '--ignore "F2"', np.zeros(3)
    plain = Entry("row 3", text)
    answer = Answer([f"leave it out: {text}", "read"], {"a": Entry(text, text)}, [plain], column)
    said = result_in_words_of("http", answer)
    assert said.messages == ['leave it out: "ignore": ["F2"]', "read"]
    assert said.entries == {"a": Entry('"ignore": ["F2"]', text)}, "a name stays as it is"
    assert said.more is answer.more
    assert np.shares_memory(said.column, column)
    assert result_in_words_of("python", said) is said


def options_of(code: str) -> set[str]:
    """The options in the texts of a module, without its docstrings."""
    tree = ast.parse(code)
    told = {
        id(node.body[0].value)
        for node in ast.walk(tree)
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef | ast.AsyncFunctionDef)
        and node.body
        and isinstance(node.body[0], ast.Expr)
    }
    texts = [
        node.value
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in told
    ]
    return {name for text in texts for name in NAMED.findall(text)}


def test_every_option_that_a_message_names_has_words_in_each_door() -> None:
    """A report's commands and styles are no messages, and the command line speaks its own words."""
    assert options_of('hint = "--colour decides"') == {"colour"}, "a planted one is found"
    known = {*CORRECTIONS, *COMMANDS_ALONE}
    found = {
        str(path.relative_to(PACKAGE)): options_of(path.read_text("utf-8")) - known
        for path in PACKAGE.rglob("*.py")
        if path.relative_to(PACKAGE).parts[0] not in ("cli", "report")
    }
    assert {path: names for path, names in found.items() if names} == {}
