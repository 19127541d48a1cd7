"""Answer of ``/api/effects``: the catalogue of physical effects."""

from __future__ import annotations

from pydantic import Field

from mckibben.documents.strict import Strict
from mckibben.physics.catalogue import EffectProblem
from mckibben.physics.effect import Signature
from mckibben.physics.parameter import Source


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
        description="Whether the bounds are those of usual muscles, and grow with the force of a large one."
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
