"""What is exported: a muscle with effects or a whole drive, with its identity, as every format takes it."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from hashlib import sha256
from typing import Any

import numpy as np

from mckibben.documents.drive import DriveDocument
from mckibben.documents.drive_reading import AnnotatedDrive, drive_of
from mckibben.documents.saved_model import SavedModel
from mckibben.documents.start_model import StartModel
from mckibben.documents.studio import Studio
from mckibben.export.about import About, ValidRange
from mckibben.export.drive_equations import (
    COUNTER_OPENING,
    FORCE,
    OPENING,
    DriveEquations,
    drive_equations,
)
from mckibben.export.drive_words import Words, words_for
from mckibben.export.language import words_of
from mckibben.export.sources import CONSTANT_WORDS, Sources
from mckibben.export.static_equations import StaticEquations, static_equations
from mckibben.physics.custom import CUSTOM
from mckibben.physics.model import Model
from mckibben.physics.muscle import GEOMETRY, assumption
from mckibben.simulation.command.segments import Segments
from mckibben.simulation.drive.initial_state import Start, start_of
from mckibben.simulation.drive.parts import Drive
from mckibben.simulation.drive.transient import (
    before_of,
    constants_of,
    dead_times,
    external_force,
    parameters_of,
    segments_of,
)
from mckibben.simulation.integrate.system import compiled_drive
from mckibben.simulation.statics.model import StaticModel
from mckibben.version import __version__

# Signals of more pieces are not written: a hundred bytes each.
MOST_PIECES = 5000


@dataclass(frozen=True)
class Stated:
    """A model as it was stated.

    Attributes:
        start: muscle and effects.
        title: of the document; "" where it has none.
        saved: the fitted model, if it is one.
        document: of the drive, if there is one.
        grounds: of a drive preset: path in its document -> source.
    """

    start: StartModel
    title: str = ""
    saved: SavedModel | None = None
    document: DriveDocument | None = None
    grounds: Mapping[str, Any] | None = None


@dataclass(frozen=True)
class RunnableDrive:
    """A drive as code needs it.

    Attributes:
        drive: in SI.
        equations: its equations.
        parameters: values of ``equations.parameters``.
        start: states in the order of ``equations.states``, and switches, at t = 0.
        why: why it starts there.
        signals: input -> its course in the document, None where that has none or too many pieces to be
            written; openings are those after all dead times.
        dead_times: of opening and closing [s].
    """

    drive: Drive
    equations: DriveEquations
    parameters: dict[str, float]
    start: np.ndarray
    switches: np.ndarray
    why: str
    signals: dict[str, Segments | None]
    dead_times: tuple[float, float]

    def words(self, kind: str) -> dict[str, Words]:
        """Unit and meaning of the states, inputs, outputs, switches or parameters, in their order."""
        equations = self.equations
        if kind == "parameter":
            effects = {
                f"{effect.id}.{p.name}": Words(p.unit, p.description)
                for effect in self.drive.model.effects
                for p in effect.parameters
            }
            known = {**{name: Words(*each[:2]) for name, each in CONSTANT_WORDS.items()}, **effects}
            return {name: known[name] for name in equations.parameters}
        names = {
            "state": [state.name for state in equations.states],
            "input": list(equations.inputs),
            "output": list(equations.output_names),
            "switch": [switch.name for switch in equations.switches],
        }
        return words_for(kind, names[kind], self.drive.model.effects)

    def written(self, name: str) -> Segments | None:
        """The course of an input, if it is written."""
        signal = self.signals.get(name)
        return None if signal is None or len(signal.slopes) > MOST_PIECES else signal

    @property
    def supply(self) -> float:
        """Absolute pressure of the supply [Pa]."""
        return self.drive.supply_pressure + self.drive.ambient_pressure


@dataclass(frozen=True)
class Subject:
    """A model that is written down.

    Attributes:
        about: what every file says of it.
        name: of functions, an identifier.
        statics: the checked static model.
        slow: the same with friction that has memory fully built up in its direction.
        start: muscle and effects as stated.
        document: JSON that stands alone; reading it gives the same model.
        runnable: the drive; None for a muscle alone.
    """

    about: About
    name: str
    statics: StaticModel
    slow: StaticModel
    start: StartModel
    document: dict[str, Any]
    runnable: RunnableDrive | None

    @cached_property
    def equations(self) -> StaticEquations:
        """The static model as named expressions."""
        return static_equations(self.statics.effects)

    def value(self, name: str) -> float:
        """A constant of the muscle or of an effect by its name in the equations."""
        effect, dot, parameter = name.partition(".")
        if not dot:
            return float(getattr(self.statics.muscle, name))
        return float(self.statics.values[effect][parameter])


def subject_of(stated: Stated, studio: Studio) -> Subject:
    """A stated model, ready to be written.

    Raises:
        InputError: a muscle, effect or drive that cannot be used.
    """
    start, document = stated.start, stated.document
    annotated = None
    if document is not None:
        free = document.command is None and document.controller is None
        annotated = drive_of(document, studio, measured=free)
        start = annotated.start
    statics = studio.static_model(start)
    runnable = None if annotated is None else runnable_of(annotated, commanded=_commanded(document))
    sources = Sources(studio, start, stated.saved, document, stated.grounds)
    drive_constants = None if runnable is None else constants_of(runnable.drive)
    used = (
        None
        if drive_constants is None
        else {name: value for name, value in drive_constants.items() if _used(name, runnable)}
    )
    title = stated.title or _title(stated, start)
    digest = _digest(statics, start, runnable, drive_constants)
    name = words_of(title)
    about = About(
        id=f"{name}-{digest[:12]}",
        hash=digest,
        title=title if document is None else document.named(title),
        program=f"mckibben {__version__}",
        effects=tuple(_effects(start)),
        constants=sources.constants(used),
        valid=tuple(_valid(stated, start, statics)),
        left_out=tuple(_left_out(static_equations(statics.effects), start, runnable)),
        assumed=tuple(_assumed(stated, start, annotated)),
        origin=tuple(_origin(stated)),
    )
    slow = studio.slow_model(start)
    return Subject(about, name, statics, slow, start, _document(stated, start, studio), runnable)


def runnable_of(annotated: AnnotatedDrive, *, commanded: bool) -> RunnableDrive:
    """The equations of a drive with their numbers.

    Args:
        annotated: the drive.
        commanded: whether its document has a command.

    Raises:
        InputError: there is no place where it rests.
    """
    drive = annotated.drive
    compiled, equations = compiled_drive(drive.structure), drive_equations(drive.structure)
    table = constants_of(drive)
    parameters = parameters_of(drive, compiled)
    times, inputs, command = segments_of(drive)
    start: Start = start_of(drive, compiled, parameters, before_of(drive, inputs))
    of_start = {state.name: value for state, value in zip(compiled.model.states, start.state, strict=True)}
    counter = Segments(times, inputs[:, 2], inputs[:, 3]) if drive.pair else None
    return RunnableDrive(
        drive=drive,
        equations=equations,
        parameters={name: table[name] for name in equations.parameters},
        start=np.array([of_start[state.name] for state in equations.states]),
        switches=start.switches,
        why=start.why.value,
        signals={
            OPENING: command if commanded else None,
            **({COUNTER_OPENING: counter if commanded else None} if drive.pair else {}),
            FORCE: external_force(drive),
        },
        dead_times=dead_times(drive),
    )


def _commanded(document: DriveDocument | None) -> bool:
    return document is not None and document.command is not None and document.controller is None


def _used(name: str, runnable: RunnableDrive | None) -> bool:
    """Whether the equations depend on a constant of the drive."""
    if runnable is None:
        return False
    equations = runnable.equations
    symbol = equations.parameters.get(name)
    return symbol is None or any(symbol in constant.free_symbols for constant in equations.prepare)


def _title(stated: Stated, start: StartModel) -> str:
    bore = start.muscle.inside_diameter or start.muscle.braid_diameter
    name = f"muscle of {bore * 1e3:.3g} mm" if start.preset is None else start.preset.id
    kind = "drive with " if stated.document is not None else ""
    return f"{kind}{name}, {start.muscle.nominal_length * 1e3:.4g} mm"


def _digest(
    statics: StaticModel, start: StartModel, runnable: RunnableDrive | None, drive: Mapping[str, float] | None
) -> str:
    """sha256 of every number that the model computes with."""
    content: dict[str, Any] = {
        "muscle": {name: float(getattr(statics.muscle, name)) for name in GEOMETRY},
        "effects": {name: dict(values) for name, values in statics.values.items()},
        "term": start.term,
    }
    if runnable is not None:
        content["drive"] = dict(drive or {})
        content["start"] = [*runnable.start.tolist(), *runnable.switches.tolist()]
        content["signals"] = {
            name: None if signal is None else [part.tolist() for part in signal]
            for name, signal in runnable.signals.items()
        }
        content["restitution"] = runnable.drive.restitution
    text = json.dumps(content, sort_keys=True, separators=(",", ":"))
    return sha256(text.encode()).hexdigest()


def _effects(start: StartModel) -> Iterator[str]:
    for effect in start.effects:
        term = f": {start.term}" if effect == CUSTOM and start.term is not None else ""
        yield f"{start.catalogue[effect].title} ({effect}){term}"


def _valid(stated: Stated, start: StartModel, statics: StaticModel) -> Iterator[ValidRange]:
    if stated.saved is not None:
        for quantity, found in stated.saved.envelope.items():
            yield ValidRange(quantity.replace("_", " "), found.least, found.most, found.unit, "measured")
    limits, maker = start.limits, "limit of the maker"
    if limits.max_pressure is not None:
        yield ValidRange("pressure", 0.0, limits.max_pressure, "Pa", maker)
    if limits.max_contraction is not None:
        stretch = None if limits.max_pretension is None else -limits.max_pretension
        yield ValidRange("contraction", stretch, limits.max_contraction, "1", maker)
    if limits.max_force is not None:
        yield ValidRange("force", None, limits.max_force, "N", maker)
    yield ValidRange("length", None, statics.longest, "m", "the braid locks there")


def _left_out(equations: StaticEquations, start: StartModel, runnable: RunnableDrive | None) -> Iterator[str]:
    for effect in equations.left_out:
        title = start.catalogue[effect].title
        if runnable is None:
            yield f"{title} ({effect}): acts in a drive only, not on the force at a given pressure."
    if runnable is None:
        return
    drive = runnable.drive
    if drive.controller is not None:
        yield (
            f"The controller (sampled PID, every {drive.controller.sample_time:g} s): the opening is an "
            "input, to be computed by your own controller."
        )
    if drive.pwm is not None:
        own = "" if drive.controller is not None else "The command of the document is written as its pulses. "
        yield (
            f"The pulse-width modulation ({drive.pwm.frequency:g} Hz): the opening is that of the switching "
            f"valves. {own}Modulate your own commands."
        )
    if any(runnable.dead_times):
        on, off = runnable.dead_times
        yield (
            f"The dead times of the valve, {on:g} s for a rising and {off:g} s for a falling command: the "
            "opening is that after the dead time. The command of the document is written with its dead times "
            "applied; delay your own ones."
        )
    for name, signal in runnable.signals.items():
        what = f"The {name.replace('_', ' ')} over time"
        if signal is None and drive.controller is None:
            yield f"{what}: the document has none, so the input is 0 until it is set."
        elif signal is not None and len(signal.slopes) > MOST_PIECES:
            yield f"{what}, of {len(signal.slopes)} pieces: set the input yourself."
    skew = float(Model(drive.model.effects).sum("skew", drive.model.values, {}))
    if skew:
        yield f"The delay of the force reading by {skew:g} s."


def _assumed(stated: Stated, start: StartModel, annotated: AnnotatedDrive | None) -> Iterator[str]:
    if stated.saved is not None:
        yield from stated.saved.assumed
        if stated.saved.muscle.nominal_length is None:
            yield (
                f"the length, {start.muscle.nominal_length:g} m, is that of the preset: the model is one of "
                "muscles of several lengths"
            )
    yield from (assumption(start.muscle, name) for name in start.assumed)
    if annotated is not None and (text := annotated.drive.tube_assumption) is not None:
        yield text


def _origin(stated: Stated) -> Iterator[str]:
    origin = None if stated.saved is None else stated.saved.origin
    if origin is None:
        return
    yield f"{origin.verdict}: {origin.kind} measurements, {origin.predicted} predicted, by {origin.program}."
    unit = "" if origin.error.unit == "1" else f" {origin.error.unit}"
    yield f"Error of the fit {origin.error.rmse:.4g}{unit} (root mean square)."
    for file in origin.files:
        digest = "" if file.sha256 is None else f", sha256 {file.sha256}"
        yield f"{file.name}: {file.rows} rows{digest}"


def _document(stated: Stated, start: StartModel, studio: Studio) -> dict[str, Any]:
    """JSON that stands alone: the muscle with all its dimensions, the effects with all their numbers."""
    if stated.saved is not None:
        return stated.saved.to_document()
    preset = start.preset
    geometry: dict[str, Any] = {
        name: float(value) for name, value in zip(GEOMETRY, start.muscle, strict=True) if value
    }
    if preset is not None and studio.library.is_built_in("muscles", preset.id):
        geometry = {"preset": preset.id, **geometry}
    effects: dict[str, Any] = {name: dict(values) for name, values in start.effects.items()}
    if CUSTOM in effects and start.term is not None:
        effects[CUSTOM] = {"term": start.term, **effects[CUSTOM]}
    if stated.document is None:
        return {"schema": 1, "kind": "model", "muscle": geometry, "effects": effects}
    return {"schema": 1, **stated.document.to_document(), "muscle": geometry, "effects": effects}
