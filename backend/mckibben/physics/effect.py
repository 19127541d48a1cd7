"""The contract of an effect: the declarations in a file of ``effects/``.

A file holds plain functions and one module-level ``EFFECT = Effect(...)``. All declarations are checked: the
form when the file is loaded, the physics by ``tests/physics/test_effect_contract.py``.
"""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

from mckibben.facts.result import result_class
from mckibben.physics.errors import InputError, error_text
from mckibben.physics.ops import Value
from mckibben.physics.parameter import MuscleSize, Parameter, Source
from mckibben.physics.slots import SLOTS

#: Where an effect shows: kinds of measurements; ``joint`` in those that were made at a joint.
Kind = Literal["isobaric", "isometric", "isotonic", "diameter", "transient", "static", "joint"]
#: Version of the contract: a file that states another one is refused. Additions do not change it.
INTERFACE = 1
KINDS: tuple[Kind, ...] = ("isobaric", "isometric", "isotonic", "diameter", "transient", "static", "joint")
TYPES = ("static", "rate", "hysteretic", "dynamic", "measurement")
FAMILIES = ("geometry", "elastomer", "friction", "gas", "valve", "tube", "supply", "load", "sensor")
# Named states in which an effect may claim to contribute nothing; test_effect_contract.py evaluates them.
ZERO_STATES = (
    "nominal_length",
    "zero_force_length",
    "zero_pressure",
    "shorter_than_nominal",
    "longer_than_nominal",
    "no_motion",
    "zero_force",
    "reference_temperature",
)


@dataclass(frozen=True, slots=True)
class StateVariable:
    """A state of an effect with memory; its rate comes from the slot ``rates`` or ``drive_rates``.

    Attributes:
        name: name of the argument in the effect's slot functions.
        symbol: LaTeX symbol.
        unit: SI unit as text.
        scale: typical magnitude, for error control.
        description: what it is, one sentence.
        initial: value at the start of a run, at which the effect is at rest; static curves use this value.
        settled: the state starts where its rate is zero instead of at ``initial``; all settled states are
            solved together, so their rates must be linear in them.
        sliding: value that it reaches in a long slow lengthening, its negative in a long shortening; 0 for a
            state without such a value. See `mckibben.physics.sliding`.
        applied: what it equals where a muscle at rest was filled or loaded at once: "pressure", its gauge
            pressure [Pa], "stroke", its length less the rest length [m], or "" for neither.
        lasting: of a change that no rest undoes, the parameter that says how much of it there was before.
        largest: of such a change, the measured quantity of which it is the largest value so far.
    """

    name: str
    symbol: str
    unit: str
    scale: float
    description: str
    initial: float = 0.0
    settled: bool = False
    sliding: float = 0.0
    applied: Literal["", "pressure", "stroke"] = ""
    lasting: str = ""
    largest: Literal["", "contraction"] = ""


@result_class
class Signature:
    """How the effect shows in the residual (measured minus ideal force), in words and as checkable claims.

    For an effect with states in the muscle the claims hold for a run from rest: "even" and "odd" refer to the
    mirrored motion (of length, or of pressure if that drives it). An effect of the drive alone changes no
    force at a given length and pressure, so it claims no parity, power or zeros.
    """

    text: str
    """The signature in words, one sentence."""
    direction: Literal["even", "odd"] | None
    """Parity of the contribution when the motion reverses: "even", "odd" or None (neither)."""
    pressure_power: float | None
    """n if the contribution to the force goes with P^n at constant length, else None."""
    zero_at: tuple[str, ...]
    """States (of `ZERO_STATES`) where the contribution to the force is exactly zero."""
    energy: Literal["conservative", "dissipative", "lumped", "reading"]
    """"conservative" (a closed loop returns its work), "dissipative" (a loop never gains work), "lumped" (a
    correction without an energy) or "reading" (changes what is read, not the muscle).
    """


@dataclass(frozen=True, slots=True)
class Twin:
    """Another effect that looks alike, and the experiment that separates the two.

    Attributes:
        effect: id of the other effect.
        separated_by: the experiment in words.
        by_muscle_test: False where no test of the muscle separates the two, only a check of the rig.
    """

    effect: str
    separated_by: str
    by_muscle_test: bool = True


@dataclass(frozen=True, slots=True)
class Prior:
    """How likely an effect is before any data.

    A diagnosis uses it only between effects that the data cannot tell apart, and for its probabilities.
    The values of the catalogue are engineering judgement (grade E); only their order matters much.

    Attributes:
        share: of the drives and rigs in which it reaches a measurable size, between 0 and 1.
        why: one clause, which a diagnosis repeats where it chooses this effect.
    """

    share: float
    why: str


@dataclass(frozen=True, slots=True)
class Example:
    """A worked example: ``quantity`` of the ideal muscle with only this effect equals ``expected``.

    ``quantity`` is an output of `mckibben.physics.model.State` ("force", "volume", "diameter", "area") or one
    of these with the suffix "_change": with the effect minus without. "slot:NAME" is the result of the
    effect's slot function, "slot:NAME:K" the K-th (from 0) of several results. The state then holds the
    arguments of the function, including states of the effect, and the muscle may be empty. All in SI.
    """

    quantity: str
    expected: float
    tolerance: float
    source: Source
    parameters: Mapping[str, float]
    muscle: Mapping[str, float]
    state: Mapping[str, float]


@dataclass(frozen=True, eq=False)
class Effect:
    """One physical effect, as declared by its file.

    Attributes:
        title: standard name in the field.
        family: group on screen (one of `FAMILIES`).
        type: static, rate, hysteretic, dynamic or measurement.
        cause: why it exists, two sentences.
        equation: LaTeX of the added or changed term.
        parameters: its parameters.
        slots: slot name -> function (see `mckibben.physics.slots`).
        kinds: measurement kinds that reveal it.
        signature: how it shows in the residual.
        confused_with: twins, with the experiments that separate them.
        references: literature.
        examples: worked examples, at least one.
        order: position in chained slots; lower acts first.
        needs: fields of the muscle that the effect multiplies; for an unknown (zero) one a typical value is
            assumed (`mckibben.physics.muscle.Muscle.assuming`).
        among_lengths: whether it shows only among muscles of several lengths; a search in the data of one
            muscle does not try it, because it would imitate other effects of the geometry.
        prior: how likely it is before any data.
        states: states of the effect; ``rates`` (of the muscle) or ``drive_rates`` gives their derivatives.
        interface: version of `mckibben.effects` that the file was written for.
        id: the file name, set by the catalogue.
    """

    title: str
    family: str
    type: str
    cause: str
    equation: str
    parameters: tuple[Parameter, ...]
    slots: Mapping[str, Callable[..., Value]]
    kinds: frozenset[Kind]
    signature: Signature
    confused_with: tuple[Twin, ...]
    references: tuple[Source, ...]
    examples: tuple[Example, ...]
    order: int = 0
    needs: tuple[str, ...] = ()
    among_lengths: bool = False
    prior: Prior = Prior(0.2, "it is not known how often it occurs")
    states: tuple[StateVariable, ...] = ()
    interface: int = INTERFACE
    id: str = ""
    _wanted: Mapping[str, tuple[str, ...]] = field(default_factory=dict, repr=False)

    def __post_init__(self) -> None:
        if self.interface != INTERFACE:
            raise ValueError(
                f"it is written for version {self.interface} of mckibben.effects, and this is {INTERFACE}"
            )
        for name, value, known in (("family", self.family, FAMILIES), ("type", self.type, TYPES)):
            if value not in known:
                raise ValueError(f"{name} '{value}' is not one of {', '.join(known)}")
        if unknown := self.kinds - set(KINDS):
            raise ValueError(f"unknown measurement kinds {sorted(unknown)}; known: {', '.join(KINDS)}")
        if unknown := set(self.signature.zero_at) - set(ZERO_STATES):
            raise ValueError(f"unknown zero_at {sorted(unknown)}; known: {', '.join(ZERO_STATES)}")
        if not (self.parameters and self.slots and self.kinds and self.references and self.examples):
            raise ValueError("parameters, slots, kinds, references and examples must not be empty")
        if not 0.0 < self.prior.share < 1.0:
            raise ValueError(f"prior.share is {self.prior.share}; it must lie between 0 and 1")
        names = [parameter.name for parameter in self.parameters]
        if len(set(names)) != len(names):
            raise ValueError(f"a parameter name occurs twice: {names}")
        if bool(self.states) != bool({"rates", "drive_rates"} & set(self.slots)):
            raise ValueError("states and a slot 'rates' or 'drive_rates' belong together")
        if unknown := {state.lasting for state in self.states} - {"", *names}:
            raise ValueError(f"no parameter says what lasts of a state: {sorted(unknown)}")
        if halves := [state.name for state in self.states if bool(state.lasting) != bool(state.largest)]:
            raise ValueError(f"'lasting' and 'largest' of a state belong together: {halves}")
        declared = [*names, *(state.name for state in self.states)]
        wanted = {slot: _wanted_arguments(slot, function, declared) for slot, function in self.slots.items()}
        if unused := set(declared) - {argument for arguments in wanted.values() for argument in arguments}:
            raise ValueError(f"no slot function takes {sorted(unused)}")
        object.__setattr__(self, "_wanted", wanted)

    def named(self, effect_id: str) -> Effect:
        """This effect under the id of its file."""
        return replace(self, id=effect_id)

    def call(self, slot: str, context: Mapping[str, Value], values: Mapping[str, Value]) -> Value:
        """Call the slot's function with the arguments it requests, from values, context or states at rest.

        Raises:
            InputError: the function fails; names the effect and the slot.
        """
        rest = {state.name: state.initial for state in self.states}
        sources = (values, context, rest)
        arguments = {
            name: next(source[name] for source in sources if name in source) for name in self._wanted[slot]
        }
        try:
            return self.slots[slot](**arguments)
        except (InputError, KeyboardInterrupt):
            raise
        except BaseException as error:  # the function may be a user's, and may even end the program
            raise InputError(
                f"effect '{self.id}', slot '{slot}': {error_text(error)}",
                field=f"effects.{self.id}",
                hint=f"correct the function in {self.id}.py, or take the file out of its folder",
            ) from error

    @property
    def shown_in(self) -> str:
        """The kinds of measurement that reveal it, in words."""
        *first, last = sorted(self.kinds)
        return f"{', '.join(first)} or {last}" if first else last

    @property
    def defaults(self) -> dict[str, float]:
        """Parameter name -> default, SI."""
        return {parameter.name: parameter.default for parameter in self.parameters}

    def defaults_of(self, size: MuscleSize) -> dict[str, float]:
        """The defaults for a muscle; see `mckibben.physics.parameter.Parameter.default_of`."""
        return {parameter.name: parameter.default_of(size) for parameter in self.parameters}

    @property
    def off(self) -> dict[str, float]:
        """Values at which the effect vanishes (parameters without an off value keep their default)."""
        return {p.name: p.default if p.off is None else p.off for p in self.parameters}

    @property
    def of_tube(self) -> bool:
        """Whether it acts on the tube between valve and muscle, so that it requires one."""
        return "tube_conductance" in self.slots or any(
            "tube_length" in names for names in self._wanted.values()
        )

    @property
    def between_sensor_and_muscle(self) -> bool:
        """Whether the pressure in the muscle follows the measured one with it."""
        return "pressure" in self.slots and bool(self.states)

    @property
    def dry_friction(self) -> bool:
        """Whether it is dry friction, of muscle or guide: odd, not zero however slow the motion is."""
        if "guide" in self.slots:
            return True
        slow = "friction" in self.slots and "direction" in self.wanted("friction")
        slow = slow or any(state.sliding for state in self.states)
        return self.family == "friction" and slow and "no_motion" in self.signature.zero_at

    def wanted(self, slot: str) -> tuple[str, ...]:
        """Names of the arguments that the slot's function requests."""
        return self._wanted[slot]

    def parameter(self, name: str) -> Parameter:
        """The parameter of that name; raises KeyError if there is none."""
        return {parameter.name: parameter for parameter in self.parameters}[name]


def _wanted_arguments(slot: str, function: Callable[..., Value], parameters: list[str]) -> tuple[str, ...]:
    if slot not in SLOTS:
        raise ValueError(f"unknown slot '{slot}'; known: {', '.join(SLOTS)}")
    context = SLOTS[slot].context
    arguments = inspect.signature(function).parameters.values()
    if clash := {argument.name for argument in arguments} & set(context) & set(parameters):
        raise ValueError(f"parameter(s) {sorted(clash)} have the name of an argument of slot '{slot}'")
    for argument in arguments:
        if argument.kind is not argument.KEYWORD_ONLY:
            raise ValueError(f"argument '{argument.name}' of slot '{slot}' must be keyword-only")
        if argument.name not in context and argument.name not in parameters:
            raise ValueError(
                f"slot '{slot}' asks for '{argument.name}', which is neither a parameter of the effect nor "
                f"offered there ({', '.join(context) or 'nothing is'})"
            )
    return tuple(argument.name for argument in arguments)
