"""Conventions of the code base that no linter knows.

Docstrings (D1), prints (T20) and bare asserts (S101) are ruff's, layers are import-linter's: see
tests/test_toolchain.py.
"""

from __future__ import annotations

import ast
import doctest
import importlib
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "backend" / "mckibben"
FRONTEND = ROOT / "frontend" / "app"
PHYSICS = PACKAGE / "physics"
EFFECTS = sorted(file for file in (PHYSICS / "effects").glob("*.py") if file.stem != "__init__")

# Modules of physics/ that hold no formulas: their arguments are operands, texts and declarations.
NOT_FORMULAS = {
    "custom",
    "term_check",
    "ops",
    "units",
    "errors",
    "parameter",
    "effect",
    "slots",
    "catalogue",
    "model",
    "muscle",
    "drive",
    "driven",
    "__init__",
}

# Effect ids that are also the name of something else, which other files may well name.
ALSO_NAMES = {
    "temperature": "the channel, and the field of a request",
    "wall_thickness": "a measure of the muscle",
    "dead_volume": "the field of a curves request",
}

# Working papers that lie beside a developer's checkout; a reader of the project does not have them.
WORKING_PAPERS = (
    "architecture.md",
    "interfaces.md",
    "physics.md",
    "facts.md",
    "ux.md",
    "style.md",
    "contract.md",
)


def python_files(folder: Path) -> list[Path]:
    """Every Python file below a folder."""
    return sorted(folder.rglob("*.py"))


def name(file: Path) -> str:
    """Path relative to the checkout, for messages and test ids."""
    return file.relative_to(ROOT).as_posix()


def text_of(file: Path) -> str:
    """The content of a text file."""
    return file.read_text(encoding="utf-8")


def positional_arguments(file: Path) -> Iterator[str]:
    """Arguments of the module's functions that a caller could give without naming them."""
    for function in ast.parse(text_of(file)).body:
        if isinstance(function, ast.FunctionDef) and not function.name.startswith("_"):
            for argument in [*function.args.posonlyargs, *function.args.args]:
                yield f"{name(file)}:{function.lineno} {function.name}: {argument.arg}"


def string_constants(file: Path) -> Iterator[tuple[int, str]]:
    """Line and value of every string literal of a Python file; a docstring is one, but longer than an id."""
    for node in ast.walk(ast.parse(text_of(file))):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.lineno, node.value


def modules_with_examples() -> list[str]:
    """Dotted names of the modules whose docstrings hold examples."""
    files = [file for file in python_files(PACKAGE) if ">>>" in text_of(file)]
    return [".".join(file.relative_to(PACKAGE.parent).with_suffix("").parts) for file in files]


def test_physics_functions_take_their_arguments_by_name() -> None:
    formulas = [file for file in PHYSICS.glob("*.py") if file.stem not in NOT_FORMULAS]
    found = [argument for file in [*formulas, *EFFECTS] for argument in positional_arguments(file)]
    assert not found, (
        "a force for a length is an error that only keywords prevent; put '*,' before:\n" + "\n".join(found)
    )


def test_no_python_file_but_its_own_names_an_effect() -> None:
    ids = {file.stem for file in EFFECTS} - set(ALSO_NAMES)
    found = [
        f"{name(file)}:{line} '{value}'"
        for file in python_files(PACKAGE)
        if file not in EFFECTS
        for line, value in string_constants(file)
        if value in ids
    ]
    assert not found, "let the effect declare what is needed, and ask the catalogue:\n" + "\n".join(found)


def test_no_file_of_the_page_names_an_effect() -> None:
    ids = [file.stem for file in EFFECTS if file.stem not in ALSO_NAMES]
    pattern = re.compile(rf"\b(?:{'|'.join(ids)})\b")
    found = [
        f"{name(file)}:{number} {line.strip()}"
        for file in sorted(FRONTEND.rglob("*"))
        if file.suffix in (".js", ".html", ".css")
        for number, line in enumerate(text_of(file).splitlines(), start=1)
        if ids and pattern.search(line)
    ]
    assert not found, "the page shows what /api/effects declares; it must know no effect:\n" + "\n".join(
        found
    )


def test_nothing_refers_to_papers_a_reader_does_not_have() -> None:
    absent = [paper for paper in WORKING_PAPERS if not (ROOT / "docs" / paper).exists()]
    pattern = re.compile(rf"\.\./shared\b|/work/|(?<![\w/-])(?:{'|'.join(map(re.escape, absent))})")
    folders = [ROOT / folder for folder in ("backend", "frontend", "presets", "docs", ".ci")]
    files = [*ROOT.glob("*.*"), *(file for folder in folders for file in folder.rglob("*"))]
    suffixes = {".py", ".js", ".json", ".html", ".css", ".ts", ".md", ".toml", ""}
    found = [
        f"{name(file)}:{number} {line.strip()[:120]}"
        for file in sorted(files)
        if file.is_file() and file.suffix in suffixes and "_data" not in file.parts
        for number, line in enumerate(text_of(file).splitlines(), start=1)
        if pattern.search(line)
    ]
    assert not found, "cite the published source, not the working paper:\n" + "\n".join(found)


@pytest.mark.parametrize("module", modules_with_examples())
def test_examples_in_docstrings_hold(module: str) -> None:
    results = doctest.testmod(importlib.import_module(module))
    assert results.attempted > 0
    assert results.failed == 0, "see the captured output"


def marked_examinations() -> Iterator[tuple[str, str]]:
    """Place of each mark ``pytest.mark.examination``, and the short test that it names."""
    for file in python_files(ROOT / "tests"):
        if "mark.examination(" not in text_of(file):
            continue
        for node in ast.walk(ast.parse(text_of(file))):
            if isinstance(node, ast.Call) and ast.unparse(node.func) == "pytest.mark.examination":
                beside = ast.literal_eval(node.args[0])
                yield f"{name(file)}:{node.lineno}", beside if "::" in beside else f"{name(file)}::{beside}"


def in_the_suite(test: str) -> bool:
    """Whether ``tests/file.py::test_name`` exists and runs every time, some of its parameters at least."""
    path, _, function = test.partition("::")
    if not (ROOT / path).is_file():
        return False
    found = [node for node in ast.parse(text_of(ROOT / path)).body if isinstance(node, ast.FunctionDef)]
    marks = {node.name: [ast.unparse(mark) for mark in node.decorator_list] for node in found}
    return function in marks and not any(
        mark.startswith("pytest.mark.examination") for mark in marks[function]
    )


def test_every_examination_has_a_short_test_beside_it() -> None:
    marks = list(marked_examinations())
    assert marks
    missing = [f"{place}: {beside}" for place, beside in marks if not in_the_suite(beside)]
    assert not missing, "name a test that runs every time and makes the same claim:\n" + "\n".join(missing)
