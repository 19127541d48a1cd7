"""The answer on the first page: verdict, what is missing, the error of each step, what to measure next."""

from __future__ import annotations

from itertools import pairwise

from mckibben.application.compare.compare import ComparisonResult
from mckibben.application.diagnose.result import DiagnosisResult, PathPoint, Verdict
from mckibben.facts.comparison import COMPARISON, TIMES_NOISE, error_scale
from mckibben.facts.diagnosis import DIAGNOSIS
from mckibben.identification.diagnose.design import APART
from mckibben.identification.diagnose.verdict import Status
from mckibben.report.bars import Bar, bars
from mckibben.report.diagnosis.material import DiagnosisMaterial
from mckibben.report.document import Head, Tone, callout, paragraph, table, tiles
from mckibben.report.figures import figure, probability
from mckibben.report.html import Child, Html, html

_TONES: dict[Status, Tone] = {
    "adequate": "good",
    "missing_effects": "warn",
    "ambiguous": "warn",
    "unknown_effect": "bad",
    "unfinished": "warn",
}
_SAME = 0.98  # ratio to the first error: below, the refitted error gets a tile of its own


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
        parts = [callout("Comparison", f"{sentence}.") for sentence in answer.sentences[-1:]]
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
