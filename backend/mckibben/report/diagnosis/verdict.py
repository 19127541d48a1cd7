"""The verdict, the steps to it, indistinguishable effects, and what to measure next."""

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
_HELPS = 1.0  # % of the error: candidates that gain less are only counted
_SAME = 0.98  # ratio to the first error: below, the refitted error gets a tile of its own
_MOST_TWINS = 4
_SHOWN = 8  # candidates listed with reasons; further useful ones are only named


def verdict_section(material: DiagnosisMaterial) -> Html:
    """The verdict in one sentence, key figures, and what to measure next."""
    answer, diagnosis = material.comparison, material.diagnosis
    scale = error_scale(answer)
    figures: list[tuple[Child, Child]] = [("RMS error of the model", figure(answer.rmse, scale, 3))]
    if answer.nrmse_percent is not None and scale != TIMES_NOISE:
        figures.append(("… of the largest value", percent(answer.nrmse_percent / 100.0, 3)))
    if diagnosis is None:
        parts = [callout("Comparison", f"{sentence}.") for sentence in answer.sentences[-1:]]
        figures.append(("Noise of the data", figure(answer.noise_floor, scale, 3)))
        return html(parts, tiles(figures))
    verdict = diagnosis.verdict
    title, tone = verdict.title, _TONES[verdict.status]
    best = diagnosis.path[-1].rmse
    if verdict.effects:
        figures.append(("With the missing effects", figure(best, scale, 3)))
    elif best < _SAME * diagnosis.path[0].rmse:
        figures.append(("With its parameters refitted", figure(best, scale, 3)))
    figures.append(("Noise of the data", figure(diagnosis.noise_floor.rmse, scale, 3)))
    parts = [callout(title, verdict.sentence, tone=tone), tiles(figures)]
    if verdict.next_measurement:
        parts.append(callout("Next measurement", verdict.next_measurement))
    return html(parts)


def path_section(material: DiagnosisMaterial) -> Html:
    """The error step by step: earlier models, the given model, and what the diagnosis adds."""
    scale = error_scale(material.comparison)
    rows: list[list[Child]] = []
    drawn: list[Bar] = []

    def add(name: str, rmse: float | None, holdout: float | None, how: str, *, pale: bool = False) -> None:
        rows.append([name, figure(rmse, scale), figure(holdout, scale), how])
        if rmse is not None:
            value, tick = scale.of(rmse), None if holdout is None else scale.of(holdout)
            drawn.append(Bar(name, value, f"{plain(value, 3)} {scale.unit}".strip(), tick, pale))

    for past in material.history:
        add(past.label, past.comparison.rmse, past.comparison.holdout_rmse, "an earlier model")
    answer, diagnosis = material.comparison, material.diagnosis
    if diagnosis is None:
        add("this model", answer.rmse, answer.holdout_rmse, "as given")
    else:
        for number, step in enumerate(diagnosis.path):
            if number == 0:
                add("this model", step.rmse, step.holdout_rmse, "as given")
            elif step.added is None:
                add("refitted", step.rmse, step.holdout_rmse, "its parameters fitted", pale=True)
            else:
                name = f"+ {material.title_of(step.added)}"
                how = "kept as a correction" if step.correction else "added by the diagnosis"
                add(name, step.rmse, step.holdout_rmse, how, pale=True)
    floor = answer.noise_floor if diagnosis is None else diagnosis.noise_floor.rmse
    level = None if floor is None else (scale.of(floor), "noise")
    unit = f" [{scale.unit}]" if scale.unit else ""
    drawing = bars(drawn, axis=f"RMS error{unit}", title="RMS error of each model", level=level)
    columns = [
        Head("Model"), Head("RMS error", number=True),
        Head("On groups left out of the fit", number=True), Head(""),
    ]  # fmt: skip
    return html(
        figure_of(drawing, "RMS error; the black tick is the error on groups left out of the fit."),
        table(columns, rows),
    )


def candidates_section(material: DiagnosisMaterial, diagnosis: DiagnosisResult) -> Html:
    """Gain of each effect alone, indistinguishable effects, and experiments that distinguish them."""
    scale = error_scale(diagnosis)
    verdict = diagnosis.verdict
    useful = [c for c in diagnosis.candidates if c.gain_percent >= _HELPS]
    useful.sort(key=lambda candidate: -candidate.gain_percent)
    rows = [
        [
            c.title,
            figure(c.rmse, scale, 3),
            percent(c.gain_percent / 100.0),
            "–" if c.probability is None else percent(c.probability),
            _twins([material.title_of(name) for name in c.twins]),
            c.why,
        ]
        for c in useful[:_SHOWN]
    ]
    columns = [
        Head("Effect"), Head("RMS error with this effect alone", number=True), Head("Gain", number=True),
        Head("Missing with probability", number=True), Head("Indistinguishable from"), Head("Why"),
    ]  # fmt: skip
    rest = len(diagnosis.candidates) - len(useful)
    parts: list[Child] = [heading("One effect alone, everything refitted")]
    parts.append(
        table(columns, rows) if rows else paragraph("No single effect of the catalogue reduces the error.")
    )
    if useful[_SHOWN:]:
        others = ", ".join(f"{c.title} ({plain(c.gain_percent, 2)} %)" for c in useful[_SHOWN:])
        parts.append(paragraph(f"Further effects that help alone: {others}.", note=True))
    if rows and rest:
        parts.append(paragraph(f"{rest} more were tried; each alone gains less than 1 %.", note=True))
    if diagnosis.not_tried:
        reasons: dict[str, list[str]] = {}
        for item in diagnosis.not_tried:
            reasons.setdefault(item.why, []).append(material.title_of(item.effect))
        parts.append(heading("Effects that were not tried"))
        parts.append(bullets(f"{', '.join(names)}: {why}." for why, names in reasons.items()))
    if verdict.indistinguishable:
        parts.append(heading("Effects these data cannot distinguish"))
        groups = [[material.title_of(name) for name in group] for group in verdict.indistinguishable]
        parts.append(bullets(f"{group[0]} from {_alternatives(group[1:])}" for group in groups))
    if verdict.experiments:
        parts.append(heading("Experiments that would distinguish them"))
        columns = [
            Head("Pair"), Head("Suggested in the catalogue"), Head("Best simulated experiment"),
            Head("Separation", number=True), Head("Minutes", number=True),
        ]  # fmt: skip
        experiments = [
            [
                " or ".join(material.title_of(name) for name in item.pair),
                item.declared or "–",
                item.protocol or "–",
                figure(item.separation, Scale("σ"), 2),
                "–" if item.minutes is None else plain(max(item.minutes, 1.0), 2),
            ]
            for item in verdict.experiments
        ]
        parts.append(table(columns, experiments, caption="σ: standard deviation of one reading."))
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
    """Remaining error that no catalogued effect explains, and a formula that describes it."""
    follows = ", ".join(variable(name)[0] for name in verdict.unexplained_in) or "no variable in particular"
    parts: list[Child] = [
        heading("What no catalogued effect explains"),
        facts(
            [
                (
                    "Structured share of the remaining squared error",
                    percent(verdict.unexplained_share),
                ),
                ("It depends on", follows),
            ]
        ),
    ]
    term = verdict.proposed_term
    if term is None:
        return html([*parts, *([paragraph(verdict.where_to_look)] if verdict.where_to_look else [])])
    values = [f"{name} = {plain(value, 4)}" for name, value in term.coefficients.items()]
    parts += [
        paragraph(
            mark("Proposed term"), " (in SI; a description, not a cause). It explains ",
            percent(term.share), " of the remaining squared error:",
        ),
        tag("div", tag("code", term.formula), class_="equation"),
        paragraph(", ".join(values), note=True),
    ]  # fmt: skip
    curve = term.curve
    variable_name, scale = variable(curve.x)
    x = scale.all(curve.values)
    marks = [Dots(x, curve.residual, "residual"), Line(x, curve.term, "term", SECOND)]
    parts.append(
        figure_of(
            chart(
                Axis(variable_name.capitalize(), scale.unit), Axis("Force", "N"), marks,
                title="Residual and proposed term", height=240.0,
            ),
            "Residual and proposed term.",
        )
    )  # fmt: skip
    return html(parts)
