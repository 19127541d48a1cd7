"""The effect catalogue as JSON."""

from __future__ import annotations

from typing import Any

from mckibben.physics.catalogue import EffectCatalogue
from mckibben.physics.effect import Effect
from mckibben.physics.parameter import Parameter, Source


def effects_answer(catalogue: EffectCatalogue) -> dict[str, Any]:
    """Every effect with its declarations, and the effect files that could not be loaded."""
    return {
        "effects": [_effect(effect) for effect in catalogue.values()],
        "problems": [{"file": problem.file, "message": problem.message} for problem in catalogue.problems],
    }


def _mathml(latex: str) -> str:
    from latex2mathml.converter import convert  # 0.05 s import, only when the catalogue is requested

    return convert(latex)


def _source(source: Source) -> dict[str, Any]:
    return {"text": source.text, "grade": source.grade}


def _parameter(parameter: Parameter) -> dict[str, Any]:
    return {
        "name": parameter.name,
        "symbol": parameter.symbol,
        "symbol_mathml": _mathml(parameter.symbol),
        "unit": parameter.unit,
        "default": parameter.default,
        "lower": parameter.lower,
        "upper": parameter.upper,
        "off": parameter.off,
        "fitted": parameter.fitted,
        "description": parameter.description,
        "source": _source(parameter.source),
    }


def _effect(effect: Effect) -> dict[str, Any]:
    signature = effect.signature
    return {
        "id": effect.id,
        "title": effect.title,
        "family": effect.family,
        "type": effect.type,
        "cause": effect.cause,
        "equation": effect.equation,
        "equation_mathml": _mathml(effect.equation),
        "parameters": [_parameter(parameter) for parameter in effect.parameters],
        "kinds": sorted(effect.kinds),
        "signature": {
            "text": signature.text,
            "direction": signature.direction,
            "pressure_power": signature.pressure_power,
            "zero_at": list(signature.zero_at),
            "energy": signature.energy,
        },
        "confused_with": [
            {"effect": twin.effect, "separated_by": twin.separated_by} for twin in effect.confused_with
        ],
        "references": [_source(source) for source in effect.references],
        "slots": list(effect.slots),
    }
