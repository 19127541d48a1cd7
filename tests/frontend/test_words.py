"""One name for one thing: no text of page, reports and messages uses a word that WORDS.md rules out."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from mckibben.facts.groups import FIGURES
from mckibben.physics.catalogue import default_catalogue

ROOT = Path(__file__).resolve().parents[2]
WORDS = ROOT / "frontend" / "WORDS.md"
MODULES = ROOT / "frontend" / "app" / "js"
BACKEND = ROOT / "backend" / "mckibben"
MOST_LINES = 60

_COMMENT = re.compile(r"/\*.*?\*/|(?<![:\"'`])//[^\n]*", re.DOTALL)
_INSIDE = re.compile(r"\$\{[^{}]*(?:\{[^{}]*\}[^{}]*)*\}")
_LITERAL = re.compile(r'"((?:[^"\\\n]|\\.)*)"|\'((?:[^\'\\\n]|\\.)*)\'|`((?:[^`\\]|\\.)*)`')
#: Literals that a reader never sees: names of files, attributes, classes, keys.
_CODE = re.compile(r"[\w./:#\[\]=>*()-]*")
#: Modules whose words are those of programming languages or of files.
_LANGUAGES = {"export/language.py", "measurement/reading/plain_head.py"}


def table() -> list[tuple[str, str]]:
    """The word of each row, and its last column."""
    rows = [
        line.strip("| ").split(" | ") for line in WORDS.read_text("utf-8").splitlines() if line[:2] == "| "
    ]
    return [(row[0], row[-1]) for row in rows[2:]]


def forbidden() -> list[str]:
    """Every word that no text may hold."""
    text = WORDS.read_text("utf-8")
    listed = text.partition("## Not in any text")[2].partition("##")[0]
    lines = [line.removeprefix("- ") for line in listed.splitlines() if line.startswith("- ")]
    return [word.strip() for line in [*(last for _, last in table()), *lines] for word in line.split(",")]


def pattern(words: list[str]) -> re.Pattern[str]:
    """Any of the words; one in capitals only as it is written."""
    ways = [rf"(?-i:{re.escape(word)})" if word != word.lower() else re.escape(word) for word in words]
    return re.compile(rf"(?<![\w-])(?:{'|'.join(ways)})(?![\w-])", re.IGNORECASE)


def of_javascript(text: str) -> Iterator[str]:
    """Literals that can be seen: with a space inside, or a capital at the front."""
    for match in _LITERAL.finditer(_COMMENT.sub("", text)):
        literal = _INSIDE.sub(" ", next(part for part in match.groups() if part is not None))
        if not _CODE.fullmatch(literal) or (literal[:1].isupper() and not literal.isupper()):
            yield literal


def of_python(text: str) -> Iterator[str]:
    """String constants other than docstrings."""
    tree = ast.parse(text)
    docs = {
        id(node.body[0].value)
        for node in ast.walk(tree)
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef)
        and node.body
        and isinstance(node.body[0], ast.Expr)
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in docs:
            yield node.value


def texts() -> Iterator[tuple[str, str]]:
    """Where a text stands, and the text."""
    for path in MODULES.rglob("*.js"):
        yield from (
            (path.relative_to(ROOT).as_posix(), text) for text in of_javascript(path.read_text("utf-8"))
        )
    for path in BACKEND.rglob("*.py"):
        if path.relative_to(BACKEND).as_posix() in _LANGUAGES:
            continue
        seen = (text for text in of_python(path.read_text("utf-8")) if not _CODE.fullmatch(text))
        yield from ((path.relative_to(ROOT).as_posix(), text) for text in seen)
    for figure in FIGURES.values():
        yield from (
            (figure.key, text) for text in (figure.label, figure.definition, figure.exists_when.otherwise)
        )
    for effect in default_catalogue().values():
        twins = (twin.separated_by for twin in effect.confused_with)
        described = (parameter.description for parameter in effect.parameters)
        for text in (effect.title, effect.cause, effect.signature.text, *twins, *described):
            yield effect.id, text


def test_no_text_uses_a_word_that_is_ruled_out() -> None:
    words = pattern(forbidden())
    found = [f"{place}: “{match[0]}” in “{text}”" for place, text in texts() if (match := words.search(text))]
    assert found == [], "see frontend/WORDS.md:\n" + "\n".join(found)


def test_a_word_names_one_thing() -> None:
    names = [name.strip().lower() for word, _ in table() for name in word.split(",")]
    assert len(names) > 30
    assert len(set(names)) == len(names)
    assert not set(names) & {word.lower() for word in forbidden()}
    assert len(WORDS.read_text("utf-8").splitlines()) <= MOST_LINES


@pytest.mark.parametrize(
    ("source", "seen"),
    [
        ('h("p", null, "The misfit is small.")', True),
        ("`It was told ${count} times`", True),
        ('const told = 1; // the misfit is "told here"', False),
        ('import { misfit } from "./misfit.js"', False),
    ],
)
def test_ruled_out_words_are_found_where_they_are_seen(source: str, seen: bool) -> None:
    words = pattern(forbidden())
    assert any(words.search(text) for text in of_javascript(source)) is seen
