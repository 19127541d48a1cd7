"""The inputs of a comparison: data, experiment, muscle, assumptions."""

from __future__ import annotations

import re
from collections.abc import Sequence

from mckibben.application.measurement.specimen_result import SpecimenResult
from mckibben.application.measurement.summary import ChannelSummary
from mckibben.facts.comparison import PARAMETER, READING_ERROR, SPECIMEN, error_scale
from mckibben.identification.predict.reading_errors import AbsorbedError
from mckibben.measurement.experiment import place_of, shown_value, title_of
from mckibben.report.diagnosis.material import DataSource, DiagnosisMaterial
from mckibben.report.diagnosis.model import named
from mckibben.report.document import Head, bullets, facts, heading, paragraph, table
from mckibben.report.figures import Scale, figure, pretty, scale_of, variable, with_error
from mckibben.report.html import Child, Html, html, tag
from mckibben.report.sources import source_text


def data_section(material: DiagnosisMaterial) -> Html:
    """Kind, rows and channels of every measurement."""
    return html(_measurement(source) for source in material.sources)


def _measurement(source: DataSource) -> Html:
    about = source.about
    left_out = dict(source.left_out) | dict(about.excluded)
    rows = about.rows + sum(source.left_out.values())
    used = about.usable_rows
    kind = about.kind + (f" (detected: {about.kind_reason})" if about.kind_detected else "")
    pairs: list[tuple[Child, Child]] = [
        ("Kind", kind),
        ("Used to", "fit the model" if source.use == "fit" else "judge the model only (validation)"),
        ("Rows", f"{rows}, of which {used} are usable"),
    ]
    pairs += [("Prepared", f"{step.step}: {step.done}") for step in about.prepared]
    if left_out:
        reasons = "; ".join(f"{count} {reason.replace('_', ' ')}" for reason, count in left_out.items())
        pairs.append(("Left out", reasons))
    if source.identity:
        pairs.append(("SHA-256", tag("code", source.identity, class_="hash")))
    if source.origin:
        pairs.append(("Source", source.origin))
    conditions = [_condition(name, value) for name, value in about.conditions.items()]
    if conditions:
        pairs.append(("Conditions", "; ".join(conditions)))
    columns = [
        Head("Channel"),
        Head("Smallest", number=True),
        Head("Largest", number=True),
    ]
    channels = [_channel(channel) for channel in about.channels]
    if source.identity:  # a built-in measurement has no file
        columns += [Head("Column in the file"), Head("Unit")]
        for row, channel in zip(channels, about.channels, strict=True):
            row += [channel.column, pretty(channel.unit) if channel.unit != "1" else "–"]
    return html(heading(source.name), facts(pairs), table(columns, channels))


def _channel(channel: ChannelSummary) -> list[Child]:
    words, scale = variable(channel.name)
    low, high = (figure(getattr(channel, end), scale, exact=True) for end in ("minimum", "maximum"))
    return [words, low, high]


#: Condition -> (factor from SI, unit) in which it is shown.
_CONDITIONS = {
    "nominal_length": (1e3, " mm"),
    "load_mass": (1.0, " kg"),
    "load_force": (1.0, " N"),
    "supply_pressure": (1e-5, " bar"),
}


def _condition(name: str, value: float | str) -> str:
    factor, unit = _CONDITIONS.get(name, (1.0, ""))
    text = value if isinstance(value, str) else f"{factor * value:.6g}{unit}"
    words = "rest length" if name == "nominal_length" else name.replace("_", " ")
    return f"{words} {text}"


_GEOMETRY = (
    ("nominal_length", "Rest length", "m"),
    ("braid_diameter", "Braid diameter at the braid angle", "m"),
    ("braid_angle", "Braid angle to the axis", "rad"),
    ("wall_thickness", "Wall thickness", "m"),
    ("inside_diameter", "Bore", "m"),
    ("thread_length", "Length of a thread", "m"),
    ("turns", "Turns of a thread", "1"),
)


def muscle_section(material: DiagnosisMaterial) -> Html:
    """Geometry at rest and limits with their sources, and the rest of the drive."""
    facts_of_muscle = material.muscle
    geometry = material.comparison.geometry
    fitted = material.comparison.parameters.get("geometry", {})
    rows = []
    for name, words, unit in _GEOMETRY:
        if name in fitted:
            value, origin = (
                with_error(getattr(geometry, name), fitted[name].stderr, scale_of(unit)),
                html("fitted to these data"),
            )
        elif name in ("thread_length", "turns"):
            value, origin = (
                figure(getattr(geometry, name), scale_of(unit), 5, exact=True),
                html("computed from the above"),
            )
        elif not getattr(geometry, name):
            value, origin = html("not known"), html("")
        else:
            source = facts_of_muscle.figures.get(name)
            value = figure(getattr(geometry, name), scale_of(unit), 5, exact=True)
            origin = html("given") if source is None else source_text(source)
        rows.append([words, value, origin])
    parts: list[Child] = []
    if facts_of_muscle.preset:
        parts.append(paragraph(f"Based on the preset {facts_of_muscle.preset}."))
    value = " ".join(PARAMETER[name].label for name in ("value", *(["stderr"] if fitted else [])))
    parts.append(table([Head("At rest"), Head(value, number=True), Head("Source")], rows))
    if facts_of_muscle.limits:
        limits = [
            [
                name.replace("_", " ").capitalize(),
                figure(value, _limit_scale(unit), exact=True),
                source_text(source),
            ]
            for name, (value, unit, source) in facts_of_muscle.limits.items()
        ]
        parts.append(table([Head("Limit"), Head("Value", number=True), Head("Source")], limits))
    if material.drive:
        parts += [heading("Rest of the drive"), facts(material.drive)]
    return html(parts)


def _limit_scale(unit: str) -> Scale:
    """A limit is a pressure, a force or a contraction."""
    return variable({"Pa": "pressure", "1": "contraction"}.get(unit, "force"))[1]


def _in_words(message: str, material: DiagnosisMaterial) -> str:
    """A message in which parameters have the names used in the report."""
    return re.sub(
        r"\b([a-z_]+)\.([a-z_]+)\b",
        lambda match: named(match[0], material) if match[1] in material.catalogue else match[0],
        message,
    )


def assumptions_section(material: DiagnosisMaterial) -> Html:
    """Assumptions and unverified figures."""
    lines: list[str] = []
    for answer in (material.comparison, material.diagnosis):
        lines += [] if answer is None else answer.messages
    for source in material.sources:
        lines += [f"{source.name}: {message}" for message in source.about.messages]
    messages = list(dict.fromkeys(_in_words(line, material) for line in lines))
    from_files = {line.partition(": ")[2] for line in messages}
    messages = [line for line in messages if line not in from_files]  # keep the one with the file name
    parts: list[Child] = [bullets(f"{line}." for line in messages)] if messages else [paragraph("None.")]
    parts.append(heading("Unverified figures"))
    if material.unverified:
        parts += [
            paragraph(
                "General knowledge or estimates (grades M and E). Results that depend on them may be wrong."
            ),
            bullets(material.unverified),
        ]
    else:
        parts.append(paragraph("This model uses none."))
    return html(parts)


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
