"""Assembles the sections of the report."""

from __future__ import annotations

from collections.abc import Iterator

from mckibben.report.command import command_section
from mckibben.report.document import Head, Section, document, paragraph, table
from mckibben.report.html import Html, html, tag
from mckibben.report.sizing.curves import curves_section
from mckibben.report.sizing.equations import equations_section
from mckibben.report.sizing.inputs import assumptions_section, task_section
from mckibben.report.sizing.material import SizingMaterial
from mckibben.report.sizing.motion import motion_section
from mckibben.report.sizing.others import alternatives_section, rejected_section
from mckibben.report.sizing.parts import figures_section, parts_section
from mckibben.report.sizing.result import result_section
from mckibben.report.sizing.safety import margins_section, uncertainty_section


def sizing_report(material: SizingMaterial) -> str:
    """The report as one self-contained HTML file."""
    return document(
        kind="sizing report",
        title=material.title,
        made=material.made,
        versions=material.versions,
        sections=_sections(material),
    )


def _sections(material: SizingMaterial) -> Iterator[Section]:
    chosen = material.chosen
    yield Section("Result", result_section(material))
    if chosen is not None:
        yield Section("Margins", margins_section(chosen))
        yield Section("Parts list", parts_section(material, chosen))
        yield Section("Curves and operating points", curves_section(material, chosen))
        yield Section("Motion", motion_section(material, chosen))
        yield Section("Uncertainty", uncertainty_section(chosen))
        yield Section("Alternatives", alternatives_section(material, chosen))
    yield Section("Rejected parts", rejected_section(material))
    yield Section("Task", task_section(material))
    yield Section("Assumptions", assumptions_section(material))
    if chosen is not None:
        yield Section("Figures and their grades", figures_section(chosen))
        yield Section("Equations", equations_section(material, chosen))
    yield Section("How to reproduce", html(_identity(material), command_section(material.command)))


def _identity(material: SizingMaterial) -> Html:
    """Versions and hashes, to check whether two reports agree."""
    rows = [
        *([name, version] for name, version in material.versions.items()),
        *(
            [f"SHA-256 of {name}", tag("code", value, class_="hash")]
            for name, value in material.hashes.items()
        ),
    ]
    return html(
        table([Head("Made with"), Head("")], rows),
        paragraph(
            "Hashes are computed from JSON with sorted keys and without spaces, so they do not depend on the "
            "formatting of the files. Specimens are drawn with a fixed seed: the same task, version and "
            "presets give the same figures.",
            note=True,
        ),
    )
