"""Labels and definitions of figures stand in facts/ and nowhere else: not in the page, not in the backend."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from mckibben.facts.groups import FIGURES
from tests.frontend.test_words import of_javascript, of_python

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "backend" / "mckibben"
MODULES = ROOT / "frontend" / "app" / "js"

# Names of channels, columns and entries are ordinary words as well, and so are labels of one word and short
# definitions, such as "force" and "length of the muscle".
WORDS = {"channel", "measured", "task", "run", "joint", "geometry"}
SHORT = 45
# Labels that are names of entries in forms and documents, too.
ENTRIES = {
    "Rest length", "Supply pressure", "Tube length", "Pulley radius", "Outer diameter", "Standard deviation",
    "Braid diameter", "Braid angle", "Fixed length", "External force",
    "Sample time", "Lowest command", "Highest command",
}  # fmt: skip
LABELS = {
    figure.label: figure.key
    for figure in FIGURES.values()
    if figure.group not in WORDS and figure.label not in ENTRIES and " " in figure.label
}
DEFINITIONS = {
    figure.definition.rstrip("."): figure.key for figure in FIGURES.values() if len(figure.definition) > SHORT
}


def repeats(text: str) -> Iterator[str]:
    """Keys of the figures whose label is the text, or whose definition stands in it."""
    plain = re.sub(r"\s+", " ", text).strip().rstrip(".")
    if plain in LABELS:
        yield LABELS[plain]
    if len(plain) > SHORT:
        yield from (key for definition, key in DEFINITIONS.items() if definition in plain)


def texts() -> Iterator[tuple[str, str]]:
    for path in sorted(PACKAGE.rglob("*.py")):
        if "facts" not in path.relative_to(PACKAGE).parts:
            yield from (
                (path.relative_to(ROOT).as_posix(), text) for text in of_python(path.read_text("utf-8"))
            )
    for path in sorted(MODULES.rglob("*.js")):
        yield from (
            (path.relative_to(ROOT).as_posix(), text) for text in of_javascript(path.read_text("utf-8"))
        )


def test_no_label_or_definition_stands_a_second_time() -> None:
    found = [f"{place}: {key} in “{text}”" for place, text in texts() for key in repeats(text)]
    assert found == [], "take it from facts/:\n" + "\n".join(found)


@pytest.mark.parametrize(
    "planted",
    ["Positioning time", f"See: {FIGURES['timing.overshoot'].definition}"],
    ids=["label", "definition"],
)
def test_a_planted_one_is_found(planted: str) -> None:
    assert any(list(repeats(text)) for text in of_javascript(f'h("th", null, "{planted}")'))
    assert any(list(repeats(text)) for text in of_python(f'HEAD = "{planted}"'))


def test_every_figure_is_complete() -> None:
    assert len(FIGURES) > 50
    for key, figure in FIGURES.items():
        assert figure.label, key
        assert figure.definition.endswith("."), key
        assert figure.exists_when.name, key
        assert figure.shown_as is None or figure.scale.unit is not None, key
