"""PAPER.md has a row for each equation and figure of the paper; its places exist, its numbers are ours."""

from __future__ import annotations

import importlib
import re
from pathlib import Path
from typing import Any, get_type_hints

import pytest

from mckibben.application.curves.curves import CurvesResult
from tests.benchmarks.paper import equations, table
from tests.benchmarks.paper_figures import figures

ROOT = Path(__file__).parents[1]
PAPER = (ROOT / "backend/mckibben/physics/PAPER.md").read_text(encoding="utf-8")
ROWS = re.findall(r"^\| (\d+[ab]?) \| (.*) \| (.*) \| (.*) \|$", PAPER, re.MULTILINE)
PLACES = sorted({place for _, where, *_ in ROWS for place in re.findall(r"`([^`]+)`", where)})
MISPRINTS = {3, 10, 11, 12, 22, 23}  # explained in the first table of the page
NUMBER = re.compile(r"-?\d+(?:\.\d+)?")


def test_the_page_holds_both_tables_with_the_numbers_of_today() -> None:
    assert table("equation", equations()) in PAPER
    assert table("figure", figures()) in PAPER


def test_every_equation_and_figure_has_a_row() -> None:
    numbers = [int(number.rstrip("ab")) for number, *_ in ROWS]
    assert numbers[:25] == list(range(1, 26))
    assert set(numbers[25:]) == set(range(1, 25))


@pytest.mark.parametrize("place", PLACES)
def test_every_place_exists(place: str) -> None:
    if place.startswith("POST /api/curves "):
        found: Any = CurvesResult
        for name in place.removeprefix("POST /api/curves ").split("."):
            found = _class_of(get_type_hints(found)[name])
    elif place.startswith("mckibben."):
        parts = place.split(".")
        sizes = range(len(parts), 0, -1)
        found = ROOT / "backend"
        size = next(n for n in sizes if found.joinpath(*parts[:n]).with_suffix(".py").is_file())
        found = importlib.import_module(".".join(parts[:size]))
        for name in parts[size:]:
            found = getattr(found, name)
    else:
        assert (ROOT / place).exists()


def _class_of(annotation: Any) -> Any:
    """The class within ``list[X]`` or ``X | None``."""
    inner = [each for each in getattr(annotation, "__args__", ()) if each is not type(None)]
    return _class_of(inner[0]) if inner else annotation


def test_an_equation_that_is_printed_right_gives_the_printed_number() -> None:
    compared = 0
    for number, _, ours, printed in ROWS[:25]:
        theirs = NUMBER.search(printed)
        if int(number) in MISPRINTS or theirs is None:
            continue
        mine = NUMBER.search(ours)
        assert mine is not None
        assert float(mine.group()) == float(theirs.group()), number
        compared += 1
    assert compared == 14
