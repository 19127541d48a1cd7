"""The verdict, the way to it, what the data cannot tell apart, and what to measure next."""

from __future__ import annotations

from mckibben.application.diagnosis_result import DiagnosisResult, Verdict
from mckibben.identification.diagnose.verdict import Status
from mckibben.report.bars import Bar, bars
from mckibben.report.chart import chart
from mckibben.report.diagnosis.errors import TIMES_NOISE, error_scale
from mckibben.report.diagnosis.material import DiagnosisMaterial
from mckibben.report.document import (
    Head,
    Tone,
    bullets,
    callout,
    facts,
    figure_of,
    heading,
    mark,
    paragraph,
    table,
    tiles,
)
from mckibben.report.figures import Scale, figure, percent, plain, variable
from mckibben.report.html import Child, Html, html, tag
from mckibben.report.marks import SECOND, Axis, Dots, Line

_TONES: dict[Status, Tone] = {
    "adequate": "good",
    "missing_effects": "warn",
    "ambiguous": "warn",
    "unknown_effect": "bad",
}
_HELPS = 1.0  # percent of the error: candidates that gain less are only counted
_SAME = 0.98  # of an error: less is worth a figure of its own
_MOST_TWINS = 4
_SHOWN = 8  # candidates with their reasons; the others that help are named


def verdict_section(material: DiagnosisMaterial) -> Html:
    """The answer first: sentence, the figures that matter, what to measure next."""
    answer, found = material.comparison, material.diagnosis
    scale = error_scale(answer)
    figures: list[tuple[Child, Child]] = [("RMS error of the model", figure(answer.rmse, scale, 3))]
    if answer.nrmse_percent is not None and scale != TIMES_NOISE:
        figures.append(("… of the largest value", percent(answer.nrmse_percent / 100.0, 3)))
    if found is None:
        parts = [callout("Comparison", f"{sentence}.") for sentence in answer.sentences[-1:]]
        figures.append(("Noise of the data", figure(answer.noise_floor, scale, 3)))
        return html(parts, tiles(figures))
    verdict = found.verdict
    title, tone = verdict.title, _TONES[verdict.status]
    best = found.path[-1].rmse
    if verdict.effects:
        figures.append(("With what is missing", figure(best, scale, 3)))
    elif best < _SAME * found.path[0].rmse:
        figures.append(("With its numbers refitted", figure(best, scale, 3)))
    figures.append(("Noise of the data", figure(found.noise_floor.rmse, scale, 3)))
    parts = [callout(title, verdict.sentence, tone=tone), tiles(figures)]
    if verdict.next_measurement:
        parts.append(callout("Next measurement", verdict.next_measurement))
    return html(parts)


def path_section(material: DiagnosisMaterial) -> Html:
    """The error step by step: the history, the model as given, and what the diagnosis adds."""
    scale = error_scale(material.comparison)
    rows: list[list[Child]] = []
    drawn: list[Bar] = []

    def add(name: str, rmse: float | None, holdout: float | None, how: str, *, pale: bool = False) -> None:
        rows.append([name, figure(rmse, scale), figure(holdout, scale), how])
        if rmse is not None:
            value, tick = scale.of(rmse), None if holdout is None else scale.of(holdout)
            drawn.append(Bar(name, value, f"{plain(value, 3)} {scale.unit}".strip(), tick, pale))

    for past in material.history:
        add(past.label, past.comparison.rmse, past.comparison.holdout_rmse, "a model before this one")
    answer, found = material.comparison, material.diagnosis
    if found is None:
        add("this model", answer.rmse, answer.holdout_rmse, "as given")
    else:
        for number, step in enumerate(found.path):
            if number == 0:
                add("this model", step.rmse, step.holdout_rmse, "as given")
            elif step.added is None:
                add("refitted", step.rmse, step.holdout_rmse, "its numbers fitted", pale=True)
            else:
                name = f"+ {material.title_of(step.added)}"
                add(name, step.rmse, step.holdout_rmse, "added by the diagnosis", pale=True)
    floor = answer.noise_floor if found is None else found.noise_floor.rmse
    level = None if floor is None else (scale.of(floor), "noise")
    unit = f" [{scale.unit}]" if scale.unit else ""
    drawing = bars(drawn, axis=f"RMS error{unit}", title="RMS error of each model", level=level)
    columns = [
        Head("Model"), Head("RMS error", number=True),
        Head("With whole groups left out of the fit", number=True), Head(""),
    ]  # fmt: skip
    return html(
        figure_of(drawing, "RMS error; the black tick is the error on groups that were left out of the fit."),
        table(columns, rows),
    )


def candidates_section(material: DiagnosisMaterial, found: DiagnosisResult) -> Html:
    """What one effect alone would do, what looks alike, and which experiment would tell."""
    scale = error_scale(found)
    verdict = found.verdict
    useful = [c for c in found.candidates if c.gain_percent >= _HELPS]
    useful.sort(key=lambda candidate: -candidate.gain_percent)
    rows = [
        [
            c.title,
            figure(c.rmse, scale, 3),
            percent(c.gain_percent / 100.0),
            _twins([material.title_of(name) for name in c.twins]),
            c.why,
        ]
        for c in useful[:_SHOWN]
    ]
    columns = [
        Head("Effect"), Head("RMS error with it alone", number=True), Head("Gain", number=True),
        Head("Cannot be told from"), Head("Why"),
    ]  # fmt: skip
    rest = len(found.candidates) - len(useful)
    parts: list[Child] = [heading("One effect alone, everything refitted")]
    parts.append(table(columns, rows) if rows else paragraph("No catalogued effect alone lowers the error."))
    if useful[_SHOWN:]:
        others = ", ".join(f"{c.title} ({plain(c.gain_percent, 2)} %)" for c in useful[_SHOWN:])
        parts.append(paragraph(f"Others that help alone: {others}.", note=True))
    if rows and rest:
        parts.append(paragraph(f"{rest} more were tried; alone they gain less than 1 %.", note=True))
    if found.not_tried:
        reasons: dict[str, list[str]] = {}
        for item in found.not_tried:
            reasons.setdefault(item.why, []).append(material.title_of(item.effect))
        parts.append(heading("Effects that were not tried"))
        parts.append(bullets(f"{', '.join(names)}: {why}." for why, names in reasons.items()))
    if verdict.indistinguishable:
        parts.append(heading("What these data cannot tell apart"))
        groups = [[material.title_of(name) for name in group] for group in verdict.indistinguishable]
        parts.append(bullets(f"{group[0]} from {_alternatives(group[1:])}" for group in groups))
    if verdict.experiments:
        parts.append(heading("Experiments that would tell"))
        columns = [
            Head("Pair"), Head("The catalogue says"), Head("Best simulated experiment"),
            Head("Apart by", number=True),
        ]  # fmt: skip
        told = [
            [
                " or ".join(material.title_of(name) for name in item.pair),
                item.declared or "–",
                item.protocol or "–",
                figure(item.separation, Scale("σ"), 2),
            ]
            for item in verdict.experiments
        ]
        parts.append(table(columns, told, caption="σ: standard deviation of one reading."))
    if verdict.status == "unknown_effect":
        parts.append(_unknown(verdict))
    return html(parts)


def _twins(names: list[str]) -> str:
    more = len(names) - _MOST_TWINS
    shown = ", ".join(names[:_MOST_TWINS]) or "–"
    return f"{shown} and {more} more" if more > 0 else shown


def _alternatives(names: list[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} or {names[-1]}"


def _unknown(verdict: Verdict) -> Html:
    """What is left when the catalogue is exhausted, and a formula for it."""
    follows = ", ".join(variable(name)[0] for name in verdict.unexplained_in) or "no variable in particular"
    parts: list[Child] = [
        heading("What no catalogued effect explains"),
        facts(
            [
                (
                    "Share of the remaining squared error that still has structure",
                    percent(verdict.unexplained_share),
                ),
                ("It follows", follows),
            ]
        ),
    ]
    term = verdict.proposed_term
    if term is None:
        return html(parts)
    values = [f"{name} = {plain(value, 4)}" for name, value in term.coefficients.items()]
    parts += [
        paragraph(
            mark("Proposed term"), " (in SI; a description, not a cause), which takes away ",
            percent(term.share), " of the squared error that is left:",
        ),
        tag("div", tag("code", term.formula), class_="equation"),
        paragraph(", ".join(values), note=True),
    ]  # fmt: skip
    curve = term.curve
    words, scale = variable(curve.x)
    x = scale.all(curve.values)
    marks = [Dots(x, curve.residual, "residual"), Line(x, curve.term, "term", SECOND)]
    parts.append(
        figure_of(
            chart(
                Axis(words.capitalize(), scale.unit), Axis("Force", "N"), marks,
                title="The proposed term and the residual it is for", height=240.0,
            ),
            "The residual and the proposed term.",
        )
    )  # fmt: skip
    return html(parts)
