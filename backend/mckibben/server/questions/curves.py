"""Conversion of a curves request."""

from __future__ import annotations

from mckibben.application.curves.curves import CurvesQuestion
from mckibben.documents.start_model import stated_muscle
from mckibben.documents.studio import Studio
from mckibben.server.schemas.curves import CurvesRequest
from mckibben.simulation.statics.characteristics import Conditions


def curves_question(body: CurvesRequest, studio: Studio) -> CurvesQuestion:
    """The question of a request.

    Raises:
        InputError: an unknown preset, effect or parameter, or no complete muscle.
    """
    return CurvesQuestion(
        start=studio.start_model(stated_muscle(body.muscle), body.effects),
        pressures=tuple(body.pressures),
        points=body.points,
        unclipped=body.unclipped,
        contraction_from=body.contraction_from,
        contraction_to=body.contraction_to,
        load=body.load,
        fixed_length=body.fixed_length,
        further_stiffness=body.further_stiffness,
        conditions=Conditions(
            direction=body.direction,
            temperature=body.temperature,
            dead_volume=body.dead_volume,
            polytropic_exponent=body.polytropic_exponent,
        ),
    )
