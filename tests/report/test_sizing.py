"""The sizing report from made-up material: what is told of a task, margins and specimens."""

from __future__ import annotations

import re
from dataclasses import replace
from datetime import UTC, datetime
from typing import Any
from xml.etree import ElementTree

import pytest

from mckibben.application.size.size import RejectedParts, SizingResult
from mckibben.documents.task import TaskOperation
from mckibben.report.command import Command
from mckibben.report.sizing.inputs import task_section
from mckibben.report.sizing.material import Entry, Margin, SizingMaterial, SpecimenSpread
from mckibben.report.sizing.others import rejected_section
from mckibben.report.sizing.safety import margins_section, uncertainty_section
from mckibben.report.sizing.words import entry_value
from mckibben.report.sizing.writing import sizing_report

NASTY = "<script>alert(1)</script>\"'&</title>"
REJECTED = RejectedParts(
    muscle="A", parallel=1, valve=None, tube=None, why="one A is too weak", binding="force",
    would_work_if="half the load", combinations=3,
)  # fmt: skip
NOTHING = SizingResult(
    about="Lift 1 kg", proposals=[], searched="Searched: 3 combinations.", ranking=None, rejected=[REJECTED],
    explored=[], combinations=3, pruned=3, simulated=0, specimens=0, outcome="completed", message=None,
    flags=[], wall_ms=1.0,
)  # fmt: skip


def material(**changes: Any) -> SizingMaterial:
    """Of a task that nothing does."""
    given: dict[str, Any] = {
        "title": "A title", "made": datetime(2026, 1, 2, tzinfo=UTC), "versions": {"mckibben": "1"},
        "entries": [], "pair": False,
        "operation": TaskOperation.model_validate({}), "profile": ((), ()),
        "result": NOTHING,
        "chosen": None, "catalogue": {}, "hashes": {"task.json": "ab" * 32},
        "command": Command(["mckibben size task.json"], {"task.json": "{}"}),
    }  # fmt: skip
    return SizingMaterial(**(given | changes))


MARGINS = [
    Margin("time", 0.5, 0.4, True, 0.25),
    Margin("force", 1.1, 1.65, False, 0.5),
    Margin("life", 1e5, 1e6, False, 9.0),
]


class Picked:
    """The fields of a chosen proposal that a section reads."""

    def __init__(self, **fields: Any) -> None:
        self.__dict__.update(fields)


def text_of(part: str) -> str:
    return re.sub("<[^>]*>", "", part)


def cells(part: str) -> list[list[str]]:
    """Rows of the bodies of all tables."""
    root = ElementTree.fromstring(f"<r>{part}</r>")
    return [["".join(cell.itertext()) for cell in row] for body in root.iter("tbody") for row in body]


@pytest.mark.parametrize(
    ("path", "value", "shown"),
    [
        ("stroke", 0.06, "60 mm"),
        ("supply_pressure", 6e5, "6 bar"),
        ("ambient_temperature", 293.15, "20 °C"),
        ("limits.max_contraction", 0.2, "20 %"),
        ("load.pair.angle", 1.0471975511965976, "60°"),
        ("stiffness", 2000.0, "2 N/mm"),
        ("load.pair.torque", 2.0, "2 N·m"),
        ("load.pair.inertia", 0.02, "0.02 kg·m²"),
        ("load.lever_ratio", 0.5, "0.5"),
        ("limits.max_parallel", 2.0, "2"),
        ("operation.cycles_per_year", 1e6, "1·10⁶"),
        ("rank_by", "balanced", "balanced"),
        ("time", None, "none"),
    ],
)
def test_values_are_shown_as_people_write_them(path: str, value: float | str | None, shown: str) -> None:
    entry = Entry(path, value, True, "")
    assert text_of(entry_value(entry)).replace("\xa0", " ") == shown


def test_a_task_tells_what_is_given_and_names_what_is_open() -> None:
    entries = [
        Entry("load.mass", 20.0, True, "Moved mass. 0: only what is stated is moved."),
        Entry("limits.force_reserve", 0.1, False, "Share. 10 %: so much do specimens differ."),
        Entry("time_down", None, False, "For the way back."),
    ]
    section = task_section(material(entries=entries))
    assert cells(section) == [["Mass", "20\xa0kg", "Moved mass."]]
    assert "Not stated: time for the return." in section


def test_margins_are_drawn_to_scale_and_the_nearest_is_named() -> None:
    section = margins_section(Picked(margins=MARGINS))  # pyright: ignore[reportArgumentType]
    bars = [e for e in ElementTree.fromstring(f"<r>{section}</r>").iter() if e.tag.endswith("rect")]
    widths = [float(bar.attrib["width"]) for bar in bars]
    assert widths[1] == pytest.approx(2 * widths[0], rel=1e-3)
    assert widths[2] == pytest.approx(4 * widths[0], rel=1e-3)  # cut at 100 %
    assert bars[0].attrib["fill"] != bars[1].attrib["fill"]
    assert "The nearest limit is time for the stroke" in section
    assert section.count("&gt; 100 %") == 2  # the table reads like the name of its bar
    rows = {row[0]: row[1:] for row in cells(section)}
    assert rows["Force beyond the reserve"] == [
        "at least 1.10 × the load",
        "1.65 × the load",
        "50 %",
        "Margin 50 %",
    ]
    assert rows["Time for the stroke"] == ["at most 0.5\xa0s", "0.4\xa0s", "25 %", "Margin 25 %"]


def test_a_probability_says_what_it_is_a_share_of() -> None:
    spread = SpecimenSpread(0.1, 0.004, None, 0.0, 0.03, ["arrives"])
    proposal = Picked(probability=0.9, probability_error=0.03, specimens=100)
    section = uncertainty_section(Picked(proposal=proposal, spread=spread, margins=MARGINS))  # pyright: ignore[reportArgumentType]
    words = text_of(section).replace("\xa0", " ")
    assert "90 % of 100 simulated specimens succeed" in words
    assert "between 84 and 96 %" in words  # two standard errors
    assert "± 0.80 % of the length" in words  # two standard deviations of the shift
    assert "wear and failures are not part of it" in words
    # What no specimen is asked for is named; the times are not among it.
    assert "Limits at rest that no specimen is asked for: force beyond the reserve, load" in words
    assert "unknown for this muscle" in words
    none = uncertainty_section(Picked(proposal=proposal, spread=None))  # pyright: ignore[reportArgumentType]
    assert "is unknown" in none


def test_rejections_of_the_same_muscles_are_told_once_and_counted() -> None:
    many = [
        replace(REJECTED, valve=valve, binding="time", why=f"{valve} is slow") for valve in ("V1", "V2", "V3")
    ]
    result = replace(NOTHING, rejected=[*many, REJECTED])
    rows = cells(rejected_section(material(result=result)))
    assert [row[0] for row in rows] == [
        "V1 is slow. And 2 more with other valves and tubes.",
        "one A is too weak.",
    ]
    assert [row[1] for row in rows] == ["time for the stroke", "force beyond the reserve"]


def test_a_report_without_a_drive_is_well_formed_and_takes_texts_as_texts() -> None:
    entry = Entry("load.mass", NASTY, True, NASTY)
    rejected = replace(REJECTED, why=NASTY, would_work_if=NASTY)
    result = replace(NOTHING, about=NASTY, rejected=[rejected], message=NASTY)
    command = Command([NASTY], {NASTY: NASTY}, [NASTY])
    page = sizing_report(material(title=NASTY, entries=[entry], result=result, command=command))
    root = ElementTree.fromstring(page.removeprefix("<!DOCTYPE html>\n"))
    assert "script" not in {element.tag for element in root.iter()}
    assert root.findtext("head/title") == f"{NASTY} – sizing report"
    assert ["".join(h.itertext()) for h in root.iter("h2")] == [
        "1 Result", "2 Rejected parts", "3 Task", "4 Assumptions", "5 How to reproduce",
    ]  # fmt: skip
    assert "ab" * 32 in page
