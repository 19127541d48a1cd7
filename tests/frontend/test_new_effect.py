"""An effect file in a folder of its own reaches the page: panel and curves, with no other edit."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Page

from tests.frontend.views import add_effect, marked, redrawn
from tests.running_server import RunningServer

PAGE = Path(__file__).parents[2] / "docs" / "how-to" / "own-parts.md"


@pytest.fixture(scope="session")
def server(tmp_path_factory: pytest.TempPathFactory) -> Iterator[RunningServer]:
    """A server with the example effect of the documentation in a folder of the user's."""
    blocks = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), flags=re.DOTALL)
    (example,) = (block for block in blocks if "EFFECT = " in block)
    folder = tmp_path_factory.mktemp("new-effect")
    (folder / "effects").mkdir()
    strong = example.replace("default=5.0", "default=40.0")
    (folder / "effects" / "seal_drag.py").write_text(strong, encoding="utf-8")
    with RunningServer(folder, arguments=["--effects", str(folder / "effects")]) as running:
        yield running


def blocked_force(page: Page) -> int:
    """Blocked force at the last pressure [N], as the table of characteristics shows it."""
    page.evaluate("document.querySelector('.tables').open = true")
    row = page.locator("section", has_text="Blocked force").last.locator("tbody tr").last
    figures = [re.sub(r"[^\d.]", "", text) for text in row.locator("td").all_inner_texts()]
    return int(next(figure for figure in figures if len(figure) > 2 and "." not in figure))


@pytest.mark.examination(
    "tests/frontend/test_design.py::test_effects_are_one_sentence_and_the_others_a_search_away"
)
def test_the_example_of_the_readme_appears_and_acts(page: Page, server: RunningServer) -> None:
    page.goto(f"{server.url}/")  # in full: the base URL is that of the other tests' server
    marked(page, "[data-drawn]")
    before = blocked_force(page)
    redrawn(page, lambda: add_effect(page, "seal drag"))
    assert abs(before - blocked_force(page) - 40) <= 1
