"""Assembles the sections of the report."""

from __future__ import annotations

from collections.abc import Iterator

from mckibben.facts.comparison import COMPARISON, error_scale
from mckibben.report.command import command_section
from mckibben.report.diagnosis.errors import error_table, where_it_fails
from mckibben.report.diagnosis.inputs import (
    assumptions_section,
    data_section,
    experiment_section,
    muscle_section,
)
from mckibben.report.diagnosis.material import DiagnosisMaterial
from mckibben.report.diagnosis.model import correlations, model_cards
from mckibben.report.diagnosis.pictures import pictures
from mckibben.report.diagnosis.verdict import answer_section, candidates_section
from mckibben.report.document import Head, Section, bullets, document, table
from mckibben.report.figures import figure
from mckibben.report.html import Child, Html, html


def diagnosis_report(material: DiagnosisMaterial) -> str:
    """The report as one self-contained HTML file."""
    return document(
        kind="diagnosis report",
        title=material.title,
        made=material.made,
        versions=material.versions,
        sections=_sections(material),
    )


def _sections(material: DiagnosisMaterial) -> Iterator[Section]:
    answer, diagnosis, proposed = material.comparison, material.diagnosis, material.proposed
    first = material.history[0].comparison if material.history else answer
    yield Section("Verdict" if diagnosis else "Result", answer_section(material))
    fitted = any(item.fitted for values in answer.parameters.values() for item in values.values())
    name = "fitted model" if fitted else "model as given"
    columns = [(f"the {name}", answer), *([("the proposed model", proposed)] if proposed else [])]
    yield Section("Error", html(error_table(columns), pictures(answer, name)))
    yield Section("Where it fails", where_it_fails(answer, first))
    if diagnosis is not None:
        yield Section("Effects that were tried", candidates_section(material, diagnosis))
        yield Section("Proposed model" if proposed else "Refitted model", _proposed(material))
    cards = model_cards(answer.parameters, material, figures=material.figures, terms=answer.model.effects)
    yield Section("Model as given", html(cards, correlations(answer, material)))
    if material.history:
        yield Section("History", _history(material))
    yield Section("Data", data_section(material))
    yield Section("Experiment", experiment_section(material))
    yield Section("Muscle", muscle_section(material))
    yield Section("Assumptions", assumptions_section(material))
    yield Section("How to reproduce", command_section(material.command))


def _proposed(material: DiagnosisMaterial) -> Html:
    diagnosis = material.diagnosis
    assert diagnosis is not None  # noqa: S101 - only called with a diagnosis
    cards = model_cards(
        diagnosis.parameters, material, added=diagnosis.verdict.effects, terms=diagnosis.model.effects
    )
    parts: list[Child] = [cards, correlations(diagnosis, material)]
    if material.proposed is not None:
        sentences = [f"{sentence}." for sentence in material.proposed.sentences]
        # Last: on paper tables fill the page before a picture.
        parts = [bullets(sentences), *parts, pictures(material.proposed, "proposed model")]
    return html(parts)


def _history(material: DiagnosisMaterial) -> Html:
    scale = error_scale(material.comparison.unit)
    rows = [
        [
            past.label,
            ", ".join(material.title_of(name) for name in past.effects) or "ideal model",
            figure(past.comparison.rmse_beyond_accuracy, scale, 3),
        ]
        for past in material.history
    ]
    columns = [Head("Step"), Head("Effects"), Head(COMPARISON["rmse_beyond_accuracy"].label, number=True)]
    return table(columns, rows, caption="Earlier models, the oldest first.")
