"""The effect catalogue as an answer."""

from __future__ import annotations

from mckibben.physics.catalogue import EffectCatalogue
from mckibben.physics.effect import Effect
from mckibben.physics.parameter import Parameter
from mckibben.server.schemas.effects import EffectAnswer, EffectParameter, EffectsAnswer, Twin


def effects_answer(catalogue: EffectCatalogue) -> EffectsAnswer:
    """Every effect with its declarations, and the effect files that could not be loaded."""
    return EffectsAnswer(
        effects=[_effect(effect) for effect in catalogue.values()],
        problems=list(catalogue.problems),
    )


def _mathml(latex: str) -> str:
    from latex2mathml.converter import convert  # 0.05 s import, only when the catalogue is requested

    return convert(latex)


def _parameter(parameter: Parameter) -> EffectParameter:
    return EffectParameter(
        name=parameter.name,
        symbol=parameter.symbol,
        symbol_mathml=_mathml(parameter.symbol),
        unit=parameter.unit,
        default=parameter.default,
        lower=parameter.lower,
        upper=parameter.upper,
        grows=parameter.grows,
        off=parameter.off,
        fitted=parameter.fitted,
        description=parameter.description,
        source=parameter.source,
    )


def _effect(effect: Effect) -> EffectAnswer:
    return EffectAnswer(
        id=effect.id,
        title=effect.title,
        family=effect.family,
        type=effect.type,
        cause=effect.cause,
        equation=effect.equation,
        equation_mathml=_mathml(effect.equation),
        parameters=[_parameter(parameter) for parameter in effect.parameters],
        kinds=sorted(effect.kinds),
        signature=effect.signature,
        confused_with=[
            Twin(effect=twin.effect, separated_by=twin.separated_by) for twin in effect.confused_with
        ],
        references=list(effect.references),
        slots=list(effect.slots),
    )
