"""The answer on the first page, and its evidence: effects that were tried, twins, what no effect explains."""

from __future__ import annotations

from itertools import pairwise

from mckibben.application.compare.compare import ComparisonResult
from mckibben.application.diagnose.result import DiagnosisResult, PathPoint, Verdict
from mckibben.facts.comparison import CHANNELS, COMPARISON, TIMES_NOISE, error_scale
from mckibben.facts.diagnosis import DIAGNOSIS
from mckibben.identification.diagnose.design import APART
from mckibben.identification.diagnose.verdict import Status
from mckibben.report.bars import Bar, bars
from mckibben.report.chart import chart
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
from mckibben.report.figures import Scale, figure, percent, plain, probability, variable
from mckibben.report.html import Child, Html, html, tag
from mckibben.report.marks import SECOND, Axis, Dots, Line

_HELPS = 1.0  # % of the error: candidates that gain less are only counted
_MOST_TWINS = 4
_NONE = 0.1  # sigma; experiments that are closer do not differ
_SHOWN = 8  # candidates listed with reasons; further useful ones are only named

_TONES: dict[Status, Tone] = {
    "adequate": "good",
    "missing_effects": "warn",
    "ambiguous": "warn",
    "unknown_effect": "bad",
    "undecided": "warn",
    "unfinished": "warn",
}
_SAME = 0.98  # ratio to the first error: below, the refitted error gets a tile of its own


def candidates_section(material: DiagnosisMaterial, diagnosis: DiagnosisResult) -> Html:
    """Gain of each effect alone, indistinguishable effects, and experiments that distinguish them."""
    scale = error_scale(diagnosis.unit)
    verdict = diagnosis.verdict
    useful = [c for c in diagnosis.candidates if c.gain_percent >= _HELPS]
    useful.sort(key=lambda candidate: -candidate.gain_percent)
    shown = useful[:_SHOWN]
    some_twins = any(c.twins for c in shown)  # an empty column would narrow the one with the reasons
    rows: list[list[Child]] = [
        [
            c.title,
            figure(c.rmse, scale, 3),
            figure(c.gain_percent, DIAGNOSIS["gain_percent"].scale, 2),
            probability(c.probability),
            *([_twins([material.title_of(name) for name in c.twins])] if some_twins else []),
            c.why,
        ]
        for c in shown
    ]
    columns = [
        Head("Effect"),
        *(Head(DIAGNOSIS[name].label, number=True) for name in ("rmse", "gain_percent", "probability")),
        *([Head("Indistinguishable from")] if some_twins else []),
        Head("Why", wide=True),
    ]  # fmt: skip
    rest = len(diagnosis.candidates) - len(useful)
    parts: list[Child] = [heading("One effect alone, everything refitted")]
    parts.append(
        table(columns, rows, whole=False)
        if rows
        else paragraph("No single effect of the catalogue reduces the error.")
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
                _separation(item.separation),
                "–" if item.minutes is None else plain(max(item.minutes, 1.0), 2),
            ]
            for item in verdict.experiments
        ]
        parts.append(
            html(
                table(columns, experiments, whole=False),
                paragraph("σ: standard deviation of one reading.", note=True),
            )
        )
    if verdict.status == "unknown_effect":
        parts.append(_unknown(verdict))
    return html(parts)


def _separation(sigma: float) -> Html:
    return html("< 0.1\N{NO-BREAK SPACE}σ") if sigma < _NONE else figure(sigma, Scale("σ"), 2)


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
                    DIAGNOSIS["unexplained_share"].label,
                    percent(verdict.unexplained_share),
                ),
                ("It depends on", follows),
            ]
        ),
    ]
    if verdict.repeats is not None:
        parts.append(paragraph(f"{verdict.repeats.text[0].upper()}{verdict.repeats.text[1:]}."))
    term = verdict.proposed_term
    if term is None:
        return html([*parts, *([paragraph(verdict.where_to_look)] if verdict.where_to_look else [])])
    values = [f"{name} = {plain(value, 4)}" for name, value in term.coefficients.items()]
    parts += [
        paragraph(
            mark("Smooth description" if term.kind == "smooth" else "Proposed term"),
            " (in SI; a description, not a cause). It takes ", percent(term.share),
            " of the remaining squared error:",
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
                Axis(variable_name.capitalize(), scale.unit),
                Axis(CHANNELS["force"].label, CHANNELS["force"].scale.unit), marks,
                title="Residual and proposed term", height=200.0,
            ),
            "Residual and proposed term.",
        )
    )  # fmt: skip
    return html(parts)


def answer_section(material: DiagnosisMaterial) -> Html:
    """All that a reader needs who reads no further."""
    diagnosis = material.diagnosis
    assumptions = (diagnosis or material.comparison).assumptions
    stopped = [callout("Stopped", _sentence(run.sentence), tone="bad") for run in material.comparison.stopped]
    parts: list[Child] = [*stopped, _verdict(material)]
    if diagnosis is not None and diagnosis.verdict.effects:
        parts.append(_missing(material, diagnosis))
    parts.append(_steps(material))
    if assumptions:
        parts.append(paragraph(f"Assumed: {'; '.join(assumptions)}."))
    return html(parts)


def _missing(material: DiagnosisMaterial, diagnosis: DiagnosisResult) -> Html:
    """The missing effects in the order of their steps."""
    scale = error_scale(diagnosis.unit)
    verdict = diagnosis.verdict
    rows: list[list[Child]] = []
    for before, step in pairwise(diagnosis.path):
        name = step.added
        if name is None or step.correction:
            continue
        group = next((group for group in verdict.indistinguishable if name in group), [])
        others = [material.title_of(other) for other in group if other != name]
        rows.append(
            [
                material.title_of(name),
                probability(verdict.probabilities.get(name)),
                html(figure(before.rmse, scale, 3), " → ", figure(step.rmse, scale, 3)),
                figure(step.holdout_rmse, scale, 3),
                ", ".join(others) or ("not tried" if verdict.status == "unfinished" else "none"),
                _experiment(verdict, name) if others else "–",
            ]
        )
    found = "Found so far" if verdict.status == "unfinished" else "Missing"
    columns = [
        Head(found),
        *(
            Head(DIAGNOSIS[name].label.replace("-", "\N{NON-BREAKING HYPHEN}"), number=True)
            for name in ("probability", "rmse", "holdout_rmse")
        ),
        Head("Indistinguishable from"),
        Head("What would tell", wide=True),
    ]  # fmt: skip
    return table(columns, rows, whole=False)


def _experiment(verdict: Verdict, name: str) -> str:
    """The experiment that would tell this effect from the others of its group."""
    for split in verdict.next_experiments:
        if any(name in one.pair and one.separation >= APART for one in split.separations):
            return f"{split.protocol} ({max(split.minutes, 1.0):.0f} min)"
    found = next((item for item in verdict.experiments if name in item.pair), None)
    if found is None:
        return "not known"
    simulated = found.protocol if found.separation >= APART else ""
    return simulated or found.declared or "no experiment of this rig"


def _sentence(clause: str) -> str:
    return f"{clause[:1].upper()}{clause[1:].removesuffix('.')}."


def _verdict(material: DiagnosisMaterial) -> Html:
    """The verdict in one sentence, key figures, and what to measure next."""
    answer, diagnosis = material.comparison, material.diagnosis
    scale = error_scale(answer.unit)
    start = None if diagnosis is None else diagnosis.baseline
    counted = answer.rmse_beyond_accuracy if start is None else start.rmse
    share = answer.nrmse_percent if start is None else start.nrmse_percent
    figures: list[tuple[Child, Child]] = [
        (f"{DIAGNOSIS['rmse'].label} of the model", figure(counted, scale, 3))
    ]
    if share is not None and scale != TIMES_NOISE:
        of = COMPARISON if start is None else DIAGNOSIS
        figures.append((of["nrmse_percent"].label, figure(share, of["nrmse_percent"].scale, 3)))
    noise = COMPARISON["noise_floor"].label
    if diagnosis is None:
        parts = [callout("Comparison", f"{each.removesuffix('.')}.") for each in answer.sentences[-1:]]
        figures.append((noise, figure(answer.noise_floor, scale, 3)))
        return html(parts, tiles(figures))
    verdict = diagnosis.verdict
    title, tone = verdict.title, _TONES[verdict.status]
    best = diagnosis.path[-1].rmse
    if verdict.effects:
        which = "effects found so far" if verdict.status == "unfinished" else "missing effects"
        figures.append((f"With the {which}", figure(best, scale, 3)))
    elif best < _SAME * diagnosis.path[0].rmse:
        figures.append(("With its parameters refitted", figure(best, scale, 3)))
    figures.append((noise, figure(diagnosis.noise_floor.rmse, scale, 3)))
    parts = [callout(title, verdict.sentence, tone=tone), tiles(figures)]
    if verdict.next_measurement:
        parts.append(callout("Next measurement", _sentence(verdict.next_measurement)))
    return html(parts)


def _steps(material: DiagnosisMaterial) -> Html:
    """The error step by step: earlier models, the given model, and what the diagnosis adds."""
    scale = error_scale(material.comparison.unit)
    rows: list[list[Child]] = []
    drawn: list[Bar] = []

    def add(name: str, step: PathPoint | ComparisonResult, how: str, *, pale: bool = False) -> None:
        rmse = step.rmse_beyond_accuracy if isinstance(step, ComparisonResult) else step.rmse
        holdout = step.holdout_rmse
        rows.append([name, how, figure(rmse, scale, 3), figure(holdout, scale, 3)])
        value, tick = (None if number is None else scale.of(number) for number in (rmse, holdout))
        drawn.append(Bar(f"{DIAGNOSIS['rmse'].label} of {name}", value or 0.0, tick, pale))

    for past in material.history:
        add(past.label, past.comparison, "an earlier model")
    answer, diagnosis = material.comparison, material.diagnosis
    if diagnosis is None:
        add("this model", answer, "as given")
    else:
        for number, step in enumerate(diagnosis.path):
            if number == 0:
                add("this model", step, "as given")
            elif step.added is None:
                add("refitted", step, "its parameters fitted", pale=True)
            else:
                name = f"+ {material.title_of(step.added)}"
                how = "kept as a correction" if step.correction else "added by the diagnosis"
                add(name, step, how, pale=True)
    noise = COMPARISON["noise_floor"]
    floor = answer.noise_floor if diagnosis is None else diagnosis.noise_floor.rmse
    level = None if floor is None else scale.of(floor)
    columns = [
        Head("Model"), Head(""), Head(DIAGNOSIS["rmse"].label, number=True),
        Head(DIAGNOSIS["holdout_rmse"].label, number=True), Head("", bar=True),
    ]  # fmt: skip
    caption = (
        f"Bars: {DIAGNOSIS['rmse'].words}; black tick: {DIAGNOSIS['holdout_rmse'].words}, on groups left out "
        "of the fit (a model without fitted values predicts all groups, so it is the error)"
        + ("." if level is None else f"; dashed line: {noise.words}.")
    )
    cells = [[*row, bar] for row, bar in zip(rows, bars(drawn, level=level), strict=True)]
    return table(columns, cells, caption=caption)
