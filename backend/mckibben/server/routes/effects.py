"""The catalogue of physical effects."""

from __future__ import annotations

import hashlib
import threading

from fastapi import APIRouter, Request, Response
from pydantic import Field

from mckibben.application.diagnose.signatures import AtlasQuestion, Signatures, signatures
from mckibben.application.json_text import to_json
from mckibben.documents.muscle import Muscle
from mckibben.documents.quantity import PositivePressure
from mckibben.documents.start_model import stated_muscle
from mckibben.documents.strict import Strict
from mckibben.physics.catalogue import EffectCatalogue, EffectProblem
from mckibben.physics.effect import Effect, Signature
from mckibben.physics.parameter import Parameter, Source
from mckibben.server import request_examples
from mckibben.server.answer import JsonAnswer, StrictRoute
from mckibben.server.context import StudioDep
from mckibben.server.schemas.common import errors


class EffectParameter(Strict):
    """One number of an effect, in SI."""

    name: str = Field(examples=["shear_modulus"], description="Its key in a request.")
    symbol: str = Field(description="LaTeX.", examples=["C_{10}"])
    symbol_mathml: str = Field(description="The symbol as MathML.")
    unit: str = Field(description="SI unit of all figures here.", examples=["Pa"])
    default: float = Field(description="A typical value.")
    lower: float = Field(description="Lower bound of the plausible range.")
    upper: float = Field(description="Upper bound of the plausible range.")
    grows: bool = Field(
        description="Whether the bounds are those of a usual muscle, and go with the size of another one."
    )
    off: float | None = Field(description="The value at which the effect vanishes.")
    fitted: bool = Field(description="Whether a fit frees it by default.")
    description: str = Field(description="What it is.")
    source: Source = Field(description="Source of the typical value.")


class Twin(Strict):
    """Another effect that looks alike."""

    effect: str = Field(description="Its id.")
    separated_by: str = Field(description="The experiment that separates the two.")


class EffectAnswer(Strict):
    """One physical effect, as its file declares it."""

    id: str = Field(description="The name of the file that declares it.")
    title: str = Field(description="Its name.")
    family: str = Field(
        examples=["elastomer"], description="Part of the drive or branch of physics that it belongs to."
    )
    type: str = Field(description="static, rate, hysteretic, dynamic or measurement.")
    cause: str = Field(description="Why it exists.")
    equation: str = Field(description="LaTeX.")
    equation_mathml: str = Field(description="The equation as MathML.")
    parameters: list[EffectParameter] = Field(description="Its numbers.")
    kinds: list[str] = Field(description="Measurement kinds that reveal it.")
    signature: Signature = Field(description="How it shows in the residual.")
    confused_with: list[Twin] = Field(description="Effects that look alike.")
    references: list[Source] = Field(description="Where it is described.")
    slots: list[str] = Field(description="The places in the model where it acts.")


class EffectsAnswer(Strict):
    """All known effects, and the effect files that could not be loaded."""

    effects: list[EffectAnswer] = Field(description="All known effects.")
    problems: list[EffectProblem] = Field(description="Effect files that could not be loaded.")


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


effects_router = APIRouter(prefix="/api/effects", tags=["effects"], route_class=StrictRoute)


class EffectsDocument:
    """The answer as bytes, written once: the catalogue does not change while the server runs."""

    def __init__(self, catalogue: EffectCatalogue) -> None:
        self._catalogue = catalogue
        self._lock = threading.Lock()
        self._content: tuple[bytes, str] | None = None

    def content(self) -> tuple[bytes, str]:
        """The JSON text and its ETag."""
        with self._lock:
            if self._content is None:
                body = to_json(effects_answer(self._catalogue))
                self._content = body, f'"{hashlib.sha256(body).hexdigest()[:32]}"'
            return self._content


@effects_router.get("", response_model=EffectsAnswer, responses=errors())
def list_effects(request: Request) -> Response:
    """Every effect with its equation, parameters, sources and what it is confused with."""
    body, etag = request.app.state.effects.content()
    headers = {"etag": etag, "cache-control": "no-cache"}
    if request.headers.get("if-none-match") == etag:
        return Response(status_code=304, headers=headers)
    return JsonAnswer(body, headers=headers)


class SignatureRequest(Strict):
    """An effect on a muscle."""

    muscle: Muscle = Field(description="The muscle.")
    effect: str = Field(description="Id of the effect.")
    values: dict[str, float] = Field(
        default_factory=dict, description="Its parameters in SI; missing ones take their usual size."
    )
    pressure: PositivePressure | None = Field(
        None, description="Largest gauge pressure of the tests; null: the muscle's limit, else 6 bar."
    )


signatures_router = APIRouter(prefix="/api/signatures", tags=["effects"], route_class=StrictRoute)


@signatures_router.post(
    "",
    response_model=Signatures,
    responses=errors(400, 413, 415, 422),
    openapi_extra=request_examples.worked("signatures"),
)
def draw_signatures(body: SignatureRequest, studio: StudioDep) -> JsonAnswer:
    """What an effect leaves in the residual of each kind of test that shows it, on this muscle."""
    start = studio.start_model(stated_muscle(body.muscle), {})
    question = AtlasQuestion(start, body.effect, body.values, body.pressure)
    return JsonAnswer(signatures(question, studio))
