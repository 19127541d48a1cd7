"""The effects of a model: equations, parameters, and what a fit could not determine."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from mckibben.application.compare.compare import ComparisonResult
from mckibben.application.compare.question import EffectDocument
from mckibben.application.diagnose.result import DiagnosisResult
from mckibben.facts.comparison import PARAMETER
from mckibben.identification.fit.comparison import ParameterTable, ParameterValue
from mckibben.physics.effect import Effect
from mckibben.physics.parameter import Parameter
from mckibben.report.diagnosis.material import DiagnosisMaterial
from mckibben.report.document import Head, bullets, heading, mark, paragraph, table
from mckibben.report.figures import Scale, figure, scale_of, with_error
from mckibben.report.formula import equation, formula
from mckibben.report.html import Child, Html, html, tag
from mckibben.report.sources import Figure, source_text

_VAGUE = 0.5  # standard error over value from which a fitted value is marked as hardly determined
_NEGLIGIBLE = 1e-6  # share of the bounds that counts as zero


def model_cards(
    parameters: ParameterTable,
    material: DiagnosisMaterial,
    *,
    figures: Mapping[str, Figure] | None = None,
    added: Sequence[str] = (),
    terms: EffectDocument | None = None,
) -> Html:
    """Every effect with its equation and parameters.

    Args:
        parameters: every parameter as used or fitted.
        figures: "effect.parameter" -> source of a given value; the others were fitted.
        added: effects that the diagnosis added.
        terms: effect id -> its document in the request, which has the formula of a typed term.
    """
    if not parameters:
        return paragraph(
            "The ideal model: the gas acts on a cylinder with the diameter of the braid; no wall thickness, "
            "no friction, no elasticity."
        )
    return html(
        _card(name, values, material, figures or {}, name in added, (terms or {}).get(name, {}))
        for name, values in parameters.items()
    )


def _card(
    name: str,
    values: Mapping[str, ParameterValue],
    material: DiagnosisMaterial,
    figures: Mapping[str, Figure],
    new: bool,
    document: Mapping[str, float | str],
) -> Html:
    effect = material.catalogue.get(name)
    declared = {p.name: p for p in effect.parameters} if effect else {}
    rows = [
        [
            _symbol(declared.get(key), key),
            html(_words(declared.get(key), key)),
            with_error(_settled(declared.get(key), item), item.stderr, _scale(declared.get(key), item)),
            _bounds(declared.get(key), item),
            _origin(item, figures.get(f"{name}.{key}")),
        ]
        for key, item in values.items()
    ]
    columns = [
        Head("Symbol"), Head("Parameter"),
        Head(f"{PARAMETER['value'].label} {PARAMETER['stderr'].label}", number=True),
        Head("Bounds", number=True), Head("Source"),
    ]  # fmt: skip
    if effect is None:
        return html(heading("Geometry and load"), table(columns, rows, whole=False))
    title = html(effect.title, " ", mark("added by the diagnosis")) if new else html(effect.title)
    return html(
        heading(title),
        paragraph(effect.cause),
        _equation(effect, document),
        table(columns, rows, whole=False) if rows else None,
    )


def _equation(effect: Effect, document: Mapping[str, float | str]) -> Html:
    term = document.get("term")
    if isinstance(term, str):  # a formula as the user typed it, not LaTeX
        return tag("div", "F = ", tag("code", term), class_="equation")
    return equation(effect.equation)


def _symbol(parameter: Parameter | None, key: str) -> Html:
    return formula(parameter.symbol) if parameter and parameter.symbol != key else tag("code", key)


def _words(parameter: Parameter | None, key: str) -> str:
    return parameter.description if parameter else key.replace("_", " ")


def _scale(parameter: Parameter | None, item: ParameterValue) -> Scale:
    """Unit for a value and its bounds, chosen by the bound if the value is practically zero."""
    size = abs(item.value)
    if parameter is not None and size < _NEGLIGIBLE * abs(parameter.upper):
        size = abs(parameter.upper)
    return scale_of(item.unit, size, "" if parameter is None else parameter.name)


def _settled(parameter: Parameter | None, item: ParameterValue) -> float:
    """The value, rounded to the bound if the fit stopped next to it."""
    value = item.value
    if parameter is not None and item.at_bound:
        nearest = min((parameter.lower, parameter.upper), key=lambda bound: abs(bound - value))
        if abs(nearest - value) < _NEGLIGIBLE * (parameter.upper - parameter.lower):
            return nearest
    return value


def _bounds(parameter: Parameter | None, item: ParameterValue) -> Html:
    if parameter is None:
        return html("–")
    scale = _scale(parameter, item)
    low = figure(parameter.lower, scale._replace(unit=""), 3, exact=True)
    return html(low, " to ", figure(parameter.upper, scale, 3, exact=True))


def _origin(item: ParameterValue, source: Figure | None) -> Html:
    if not item.fitted:
        return html("given") if source is None or source.grade == "user" else source_text(source)
    remarks: list[Child] = ["fitted to these data"]
    if item.at_bound:
        remarks += ["; ", mark("stopped at its bound")]
    if item.stderr is None:
        remarks += ["; ", mark("not determined by these data")]
    elif item.stderr > _VAGUE * abs(item.value):
        remarks += ["; ", mark("hardly determined: its error is as large as the value")]
    return html(remarks)


def correlations(answer: ComparisonResult | DiagnosisResult, material: DiagnosisMaterial) -> Html:
    """Pairs of strongly correlated fitted parameters."""
    strong = [item for item in answer.correlations if abs(item.value) > 0.9]
    if not strong:
        return html()
    lines = [
        f"{named(item.a, material)} and {named(item.b, material)}: "
        f"correlation {item.value:.3f}; the data determine only a combination of the two"
        for item in sorted(strong, key=lambda item: -abs(item.value))
    ]
    return html(heading("Strongly correlated parameters"), bullets(lines))


def named(path: str, material: DiagnosisMaterial) -> str:
    """A parameter "effect.parameter" (or of the geometry) in words."""
    effect, _, name = path.rpartition(".")
    words = name.replace("_", " ")
    return f"{words} ({material.title_of(effect)})" if effect else words
