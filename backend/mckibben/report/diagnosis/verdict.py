"""Effects that were tried, those the data cannot distinguish, and what no effect explains."""

from __future__ import annotations

from mckibben.application.diagnose.result import DiagnosisResult, Verdict
from mckibben.facts.comparison import CHANNELS, error_scale
from mckibben.facts.diagnosis import DIAGNOSIS
from mckibben.report.chart import chart
from mckibben.report.diagnosis.material import DiagnosisMaterial
from mckibben.report.document import (
    Head,
    bullets,
    facts,
    figure_of,
    heading,
    mark,
    paragraph,
    table,
)
from mckibben.report.figures import Scale, figure, percent, plain, probability, variable
from mckibben.report.html import Child, Html, html, tag
from mckibben.report.marks import SECOND, Axis, Dots, Line

_HELPS = 1.0  # % of the error: candidates that gain less are only counted
_MOST_TWINS = 4
_NONE = 0.1  # sigma; experiments that are closer do not differ
_SHOWN = 8  # candidates listed with reasons; further useful ones are only named


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
                Axis(variable_name.capitalize(), scale.unit),
                Axis(CHANNELS["force"].label, CHANNELS["force"].scale.unit), marks,
                title="Residual and proposed term", height=200.0,
            ),
            "Residual and proposed term.",
        )
    )  # fmt: skip
    return html(parts)
