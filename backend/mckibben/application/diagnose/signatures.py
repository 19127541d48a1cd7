"""The atlas: what an effect leaves in the residual of each kind of test, on the muscle in hand."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from mckibben.documents.start_model import StartModel
from mckibben.documents.studio import Studio
from mckibben.facts.result import result_class
from mckibben.identification.diagnose.atlas import TEMPERATURE, SignaturePicture, pictures, stand_ins
from mckibben.identification.predict.fit_model import FitModel
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.simulation.statics.model import StaticModel

#: Largest pressure of the tests where the muscle states no limit [Pa].
USUAL_PRESSURE = 6e5


@dataclass(frozen=True, slots=True)
class AtlasQuestion:
    """An effect on a muscle; SI.

    Attributes:
        start: the muscle in hand.
        effect: id of the effect.
        values: its parameters; missing ones take their usual size.
        pressure: largest gauge pressure of the tests; None for the muscle's limit.
    """

    start: StartModel
    effect: str
    values: Mapping[str, float] = field(default_factory=dict)
    pressure: float | None = None


@result_class
class Signatures:
    """The pictures of an effect; SI."""

    effect: str
    """Id of the effect."""
    values: dict[str, float]
    """All its parameters in SI."""
    pictures: list[SignaturePicture]
    """One for each kind of test that shows it."""
    hidden: list[str]
    """Kinds it names, but whose prediction does not contain it."""
    temperature: float
    """Temperature of the tests [K]."""
    pressure: float
    """Largest gauge pressure of the tests [Pa]."""


def signatures(question: AtlasQuestion, studio: Studio) -> Signatures:
    """The pictures of one effect.

    Raises:
        InputError: an unknown effect or parameter, a value outside its bounds, or a muscle that cannot pull.
    """
    start, catalogue = question.start, {**studio.catalogue, **question.start.catalogue}
    effect = catalogue.get(question.effect)
    if effect is None:
        raise InputError(
            f"there is no effect '{question.effect}'",
            code="unknown_effect",
            field="effect",
            hint=did_you_mean(question.effect, catalogue),
        )
    base = FitModel(start.muscle)
    for name in stand_ins(effect, catalogue, start.effects):  # it only changes what they do
        base = base.adding(catalogue[name], start.effects.get(name))
    # It checks names and bounds of the values, and the muscle.
    StaticModel(base.adding(effect).muscle, {effect.id: question.values}, catalogue=catalogue)
    limit = None if start.preset is None else start.preset.limits.max_pressure
    pressure = question.pressure or limit or USUAL_PRESSURE
    found = pictures(base, effect, question.values, pressure=pressure)
    return Signatures(
        effect=effect.id,
        values={**effect.defaults, **question.values},
        pictures=found,
        hidden=sorted(effect.kinds - {picture.kind for picture in found}),
        temperature=TEMPERATURE,
        pressure=pressure,
    )
