"""The variables of an FMU, of a drive or of a muscle alone, in the words of the catalogue."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mckibben.export.bounds import bounds_of
from mckibben.export.c_static import RESULT_MEMBERS
from mckibben.export.drive_equations import COUNTER_OPENING, FORCE, OPENING, SUPPLY
from mckibben.export.drive_words import Words
from mckibben.export.language import words_of
from mckibben.export.sources import PATH_WORDS
from mckibben.export.subject import RunnableDrive, Subject
from mckibben.physics.drive_terms import CONSTANTS, COUNTER
from mckibben.physics.model import ROOM_TEMPERATURE

#: First value reference of each kind; `access.h` knows them.
KIND = 100_000
STATE, RATE, PARAMETER, INPUT, OUTPUT, SWITCH, INDICATOR, TIME = (KIND * number for number in range(1, 9))
PLAY = "play_document_command"
_SEGMENT = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
# Inputs of a muscle alone.
_MUSCLE_INPUTS: Mapping[str, Words] = {
    "length": Words("m", "Length between the fittings, as a length sensor reads it."),
    "velocity": Words("m/s", "Its rate, positive = lengthening: it decides the direction of friction."),
    "pressure": Words("Pa", "Gauge pressure in the muscle, as a pressure sensor reads it."),
    "pressure_rate": Words("Pa/s", "Its rate, for effects with memory."),
    "temperature": Words("K", "Of the elastomer."),
}


@dataclass(frozen=True, slots=True)
class Variable:
    """A real variable.

    Attributes:
        key: name in the equations.
        name: in the FMU.
        start: value at the start; None for what is computed.
        least, most: bounds, where they are known.
        nominal: magnitude of a state.
    """

    key: str
    name: str
    unit: str
    meaning: str
    start: float | None = None
    least: float | None = None
    most: float | None = None
    nominal: float | None = None


@dataclass(frozen=True)
class Plant:
    """What the generated C and the description are made from.

    Attributes:
        subject: the model.
        prefix: of the functions of its equations.
    """

    subject: Subject
    prefix: str

    @property
    def drive(self) -> RunnableDrive | None:
        """The drive; None for a muscle alone."""
        return self.subject.runnable

    @cached_property
    def states(self) -> list[Variable]:
        """Continuous states, with start and nominal value."""
        drive = self.drive
        if drive is None:
            variables = self.subject.equations.state_variables
            return [
                Variable(
                    full, f"state.{_spelled(full)}", each.unit, each.description, float(each.initial),
                    nominal=each.scale,
                )
                for full, each in variables.items()
            ]  # fmt: skip
        words = drive.words("state")
        return [
            Variable(
                state.name, f"state.{_spelled(state.name)}", *words[state.name], float(start),
                nominal=state.scale,
            )
            for state, start in zip(drive.equations.states, drive.start, strict=True)
        ]  # fmt: skip

    @cached_property
    def parameters(self) -> list[Variable]:
        """All numbers that the equations depend on, with bounds and the source of each."""
        subject, drive = self.subject, self.drive
        said = {each.name: each for each in subject.about.constants}
        bounds = {
            f"{effect.id}.{p.name}": p.allowed(subject.statics.muscle.size)
            for effect in subject.statics.effects
            for p in effect.parameters
        }
        if drive is None:
            known = {full: Words(said[full].unit, said[full].description) for full in said}
            values = {full: subject.value(full) for full in subject.equations.constants}
        else:
            known, values = drive.words("parameter"), drive.parameters
        found = []
        for full, value in values.items():
            name = f"drive.{full}" if full in CONSTANTS or full in PATH_WORDS else full
            least, most = bounds.get(full) or bounds_of(full)
            if (least is not None and value < least) or (most is not None and value > most):
                least = most = None
            source = said.get(name)
            ground = (
                "Not used by this model." if source is None else f"Source: {source.source} [{source.grade}]"
            )
            meaning = f"{known[full].meaning} {ground}"
            found.append(Variable(full, _spelled(name), known[full].unit, meaning, float(value), least, most))
        return found

    @cached_property
    def inputs(self) -> list[Variable]:
        """Inputs with their values before the run."""
        if self.drive is None:
            starts = {"length": self.subject.value("nominal_length"), "temperature": ROOM_TEMPERATURE}
            return [
                Variable(name, name, *words, starts.get(name, 0.0)) for name, words in _MUSCLE_INPUTS.items()
            ]
        drive = self.drive.drive
        signal = self.drive.signals.get(FORCE)
        starts = {
            OPENING: drive.command.before,
            COUNTER_OPENING: drive.counter(drive.command.before),
            FORCE: 0.0 if signal is None else float(signal.start_values[0]),
            SUPPLY: self.drive.supply,
        }
        words = self.drive.words("input")
        return [
            Variable(name, name, *words[name], float(starts[name])) for name in self.drive.equations.inputs
        ]

    @cached_property
    def outputs(self) -> list[Variable]:
        """Outputs: the motion of the load, the gauge pressure, and those of the equations."""
        taken = {each.name for each in (*self.inputs, *self.parameters)}
        if self.drive is None:
            return [
                Variable(name, f"actual_{name}" if name in taken else name, *_split(name, text))
                for name, text in RESULT_MEMBERS.items()
            ]
        found = [
            Variable("position", "position", "m", "Position of the load, positive = shorter muscle."),
            Variable("velocity", "velocity", "m/s", "Velocity of the load."),
        ]
        for state in self.drive.equations.states:
            if state.name.partition("@")[0] == "pressure":
                which = "the second muscle of the pair" if COUNTER in state.name else "the muscle"
                found.append(Variable(state.name, _spelled(state.name), "Pa", f"Gauge pressure in {which}."))
        for name, words in self.drive.words("output").items():
            spelled = _spelled(name)
            found.append(Variable(name, f"actual_{spelled}" if spelled in taken else spelled, *words))
        return found

    @cached_property
    def switches(self) -> list[Variable]:
        """Discrete states."""
        if self.drive is None:
            return []
        return [
            Variable(name, f"switch.{_spelled(name)}", *words, float(start))
            for (name, words), start in zip(
                self.drive.words("switch").items(), self.drive.switches, strict=True
            )
        ]

    @cached_property
    def played(self) -> list[bool]:
        """Of each input whether the document has its course."""
        drive = self.drive
        return [drive is not None and drive.written(each.key) is not None for each in self.inputs]

    @cached_property
    def pieces(self) -> np.ndarray:
        """Courses of the document: rows of time and, of each input, value and slope; held at the end."""
        drive, inputs = self.drive, self.inputs
        signals = [None if drive is None else drive.written(each.key) for each in inputs]
        written = [signal for signal in signals if signal is not None]
        if not written:
            return np.zeros((1, 1 + 2 * len(inputs)))
        times = np.unique(np.concatenate([signal.times for signal in written]))
        rows = np.zeros((len(times), 1 + 2 * len(inputs)))
        rows[:, 0] = times
        for number, signal in enumerate(signals):
            if signal is not None:
                rows[:, 1 + 2 * number] = signal.value(times)
                place = np.clip(np.searchsorted(signal.times, times, "right") - 1, 0, len(signal.slopes) - 1)
                rows[:, 2 + 2 * number] = np.where(times < signal.times[-1], signal.slopes[place], 0.0)
        return rows

    @property
    def plays(self) -> bool:
        """Whether the document has a course of any input."""
        return any(self.played)

    def rates(self) -> Iterator[Variable]:
        """Rates of the states."""
        for state in self.states:
            unit = "1/s" if state.unit == "1" else _per_second(state.unit)
            yield Variable(state.key, f"der({state.name})", unit, f"Rate of {state.name}.")


def _per_second(unit: str) -> str:
    """The unit over a second, without a second division sign."""
    known = {"m": "m/s", "m/s": "m/s^2", "Pa": "Pa/s", "kg": "kg/s", "K": "K/s", "N": "N/s"}
    head, slash, below = unit.partition("/")
    if unit in known or not slash:
        return known.get(unit, f"{unit}/s")
    return f"{head}/({below.removeprefix('(').removesuffix(')')}*s)"


def _spelled(name: str) -> str:
    """A name of the equations as a structured name: "counter." for the second muscle of a pair."""
    own, counter, _ = name.partition(COUNTER)
    parts = [part if _SEGMENT.fullmatch(part) else words_of(part) for part in own.split(".")]
    return ".".join([*(["counter"] if counter else []), *parts])


def _split(name: str, text: str) -> tuple[str, str]:
    """Unit and meaning of a member of the C structure, "m, length" or "m^3/Pa"."""
    if text.startswith("1 = "):
        return "1", text
    unit, _, meaning = text.partition(", ")
    return unit, meaning or f"{name.replace('_', ' ').capitalize()}."
