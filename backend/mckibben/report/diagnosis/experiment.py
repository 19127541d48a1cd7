"""The experiment: what the test was made with, who says each value, and what the accuracy took up."""

from __future__ import annotations

from collections.abc import Sequence

from mckibben.application.measurement.specimen_result import SpecimenResult
from mckibben.facts.comparison import READING_ERROR, SPECIMEN, error_scale
from mckibben.identification.predict.reading_errors import AbsorbedError
from mckibben.measurement.experiment import place_of, shown_value, title_of
from mckibben.report.diagnosis.material import DiagnosisMaterial
from mckibben.report.document import Head, bullets, heading, paragraph, table
from mckibben.report.figures import figure, scale_of, with_error
from mckibben.report.html import Child, Html, html


def experiment_section(material: DiagnosisMaterial) -> Html:
    """Every value with its origin, per measurement; assumptions first."""
    answer = material.diagnosis or material.comparison
    parts: list[Child] = []
    if answer.assumptions:
        parts.append(bullets(f"{text[0].upper()}{text[1:]}." for text in answer.assumptions))
    for specimen in answer.specimens:
        parts.append(_specimen(specimen, material, named=len(answer.specimens) > 1))
    if answer.absorbed:
        parts += [heading("Errors of reading within the accuracy"), _absorbed(answer.absorbed, material)]
    return html(parts)


def _specimen(specimen: SpecimenResult, material: DiagnosisMaterial, *, named: bool) -> Html:
    rows = [
        [title_of(name), shown_value(name, value), place_of(value)]
        for name, value in specimen.experiment.items()
    ]
    parts: list[Child] = [heading(specimen.file)] if named else []
    if named and specimen.rmse is not None:
        scale = error_scale(material.comparison.unit)
        parts.append(paragraph(SPECIMEN["rmse"].label, " on it: ", figure(specimen.rmse, scale, 3), "."))
        if specimen.left_out_rmse is not None:
            error = figure(specimen.left_out_rmse, scale, 3)
            parts.append(paragraph(SPECIMEN["left_out_rmse"].label, ": ", error, "."))
    parts.append(table([Head("Experiment"), Head("Value", number=True), Head("Who says it")], rows))
    return html(parts)


def _absorbed(errors: Sequence[AbsorbedError], material: DiagnosisMaterial) -> Html:
    scale = error_scale(material.comparison.unit)
    rows = [
        [
            f"{error.channel}{f', {error.of}' if error.of else ''}",
            with_error(error.value, error.stderr, scale_of(error.unit)),
            figure(error.accuracy, scale_of(error.unit), 2),
            figure(error.rms, scale, 2),
        ]
        for error in errors
    ]
    value, accuracy, rms, stderr = (
        READING_ERROR[name].label for name in ("value", "accuracy", "rms", "stderr")
    )
    columns = [
        Head("Reading"), *(Head(label, number=True) for label in (f"{value} {stderr}", accuracy, rms)),
    ]  # fmt: skip
    return table(
        columns,
        rows,
        caption="The fit allows for these errors, with the accuracy as their standard deviation.",
    )
