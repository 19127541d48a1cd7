"""``print(result)`` says what the command line prints; a notebook cell escapes all texts."""

from __future__ import annotations

import re
from html.parser import HTMLParser
from xml.etree import ElementTree

import pytest

import mckibben as mk
from mckibben.door.result import Result
from tests.cli.conftest import Run

RULES = re.compile("[─━╶╴]+")


def words(text: str) -> list[str]:
    """The words of a text without the lines of its tables."""
    return [word for word in RULES.sub(" ", text).split() if word]


@pytest.mark.parametrize(
    ("result", "command"),
    [
        (
            lambda: mk.Model.preset("DMSP-20", length="300 mm").curves("1 bar, 6 bar"),
            ("curves", "--muscle", "DMSP-20:300mm", "--pressure", "1 bar,6 bar"),
        ),
        (
            lambda: mk.Model.preset("DMSP-10").ideal().compare("martens-dmsp-10-250"),
            ("compare", "martens-dmsp-10-250", "--muscle", "DMSP-10", "--ideal"),
        ),
        (lambda: mk.Drive.preset("propneu-20").run(), ("simulate", "propneu-20")),
    ],
)
def test_the_text_is_what_the_command_line_prints(run: Run, result, command) -> None:
    code, out, err = run(*command)
    assert code == 0
    mine = " ".join(words(str(result())))
    for line in (*out.splitlines(), *err.splitlines()):
        line = line.replace("DMSP-20:300mm", "DMSP-20, 300 mm").replace("--muscle", "the model")
        for cell in re.split(r"\s{2,}", RULES.sub(" ", line).strip()):
            assert " ".join(cell.split()) in mine, cell


class _Tags(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.seen: set[str] = set()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.seen.add(tag)


def hostile() -> list[Result]:
    """Results of data and drives whose names are markup."""
    name = "<script>alert('x')</script>&\"<b>"
    data = mk.Measurement.from_frame(mk.read("martens-dmsp-10-250").to_frame(), name=name)
    data = data.stating(rest_length="250 mm")
    model = mk.Model.preset("DMSP-10")
    drive = mk.Drive.preset("propneu-20").changed(title=name)
    return [data, model.compare(data), drive.run(points=11), model.curves("1 bar")]


def test_a_notebook_cell_is_well_formed_and_escaped() -> None:
    for result in hostile():
        cell = result._repr_html_()
        ElementTree.fromstring(cell)
        tags = _Tags()
        tags.feed(cell)
        assert "script" not in tags.seen
        assert "table" in tags.seen
        figure = result.plot()
        assert "<script" not in str(figure.layout.title.text)
        assert all("<script" not in str(trace.name) for trace in figure.data)


def test_models_drives_and_listings_have_cells_and_texts() -> None:
    for value in (
        mk.Model.preset("DMSP-20"),
        mk.Drive.preset("propneu-20"),
        mk.presets("muscles"),
        mk.effects(),
    ):
        ElementTree.fromstring(value._repr_html_())
        assert len(str(value).splitlines()) > 3
        assert repr(value).startswith("<")
    assert "that of the data" in str(mk.Model(inside_diameter="20 mm", braid_angle="25 deg"))


@pytest.mark.examination("test_the_text_is_what_the_command_line_prints")
def test_a_diagnosis_leads_with_its_verdict() -> None:
    found = mk.Model.preset("DMSP-10").ideal().diagnose("martens-dmsp-10-250")
    assert found.sentence in " ".join(str(found).split())
    cell = "".join(ElementTree.fromstring(found._repr_html_()).itertext())
    assert cell.index(found.sentence) < cell.index("RMS error")
    assert len(found.to_frame()) == len(found.candidates)
    steps = found.plot().data[0]
    assert list(steps.y) == pytest.approx([step.rmse for step in found.path])
    found.save("report.html")
    with open("report.html", encoding="utf-8") as file:
        assert "martens-dmsp-10-250" in file.read()
