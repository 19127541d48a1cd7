"""Drives: a muscle with valve, tube, supply, load and command, simulated through time."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias, cast

from mckibben.application.linear.linearise import LinearQuestion, condition_of, goals_of, linear_view
from mckibben.application.run.simulate import (
    POINTS,
    SimulationQuestion,
    SimulationResult,
    prepare,
    trace_columns,
    trace_text,
)
from mckibben.application.text_file import check_ending, write_text
from mckibben.documents.drive import DriveDocument
from mckibben.documents.drive_reading import (
    AnnotatedDrive,
    drive_of,
    named_document,
    preset_document,
    read_document,
)
from mckibben.documents.shorthand import TUBE_TEXT, VALVE_TEXT
from mckibben.documents.studio import Studio
from mckibben.door.exported import Exportable
from mckibben.door.frames import frame_of
from mckibben.door.linear import LinearView
from mckibben.door.model import Model, model_of_document
from mckibben.door.problem import reported
from mckibben.door.rendering import notebook_cell, plain_text
from mckibben.door.result import ResultOf
from mckibben.door.stepper import Engine, Stepper, nonlinear_plant
from mckibben.door.values import Quantity, number_of
from mckibben.door.workspace import studio
from mckibben.export.source import of_drive
from mckibben.export.subject import Stated
from mckibben.physics.errors import InputError
from mckibben.presets import FittingPreset, TubePreset, ValvePreset
from mckibben.report.summary import Summary, Table
from mckibben.report.summary.simulation import notices, summary_of
from mckibben.simulation.linear.bound import SLIDING_SPEED
from mckibben.simulation.outcome import Watch

if TYPE_CHECKING:
    import pandas as pd
    from plotly.graph_objects import Figure


#: A part of a drive document, ``{"mass": "10 kg"}``.
Part: TypeAlias = Mapping[str, Any]


class Drive(Exportable):
    """A drive; each argument is a part of the drive document. Drives do not change; `changed` makes another.

    Args:
        muscle: a `Model`, the id of a preset ("DMSP-20", "DMSP-20:300mm"), or a document. To the effects of
            a model come those of the presets of valve, tube and fittings; a model that was fitted or loaded
            from a saved one has them all already.
        valve: id of a preset, or a document with its conductances.
        supply: gauge pressure, "6 bar".
        command: ``{"shape": "pulse", "on": "0 s", "off": "2 s"}``; also step, square, triangle, ramp, sine,
            chirp, random, table.
        controller: ``{"kp": 2.0, "ki": 10.0, "reference": {...}}`` instead of a command.
        effects: all effects of the drive, instead of those of muscle and parts.
        load: a mass or a force, "10 kg", or ``{"mass": "10 kg", "arrangement": "hanging"}``.
        tube: id of a preset, or ``{"inside_diameter": "4 mm", "length": "1 m"}``; None = none.
        duration: of a run, "4 s".
        title: for display.
        parts: further parts: regulator, fittings, gas, stops, start, start_pressure.

    Raises:
        Problem: an unknown part, preset or effect (with the nearest match), or impossible values.
    """

    __slots__ = ("_checked", "_document", "_measured", "_name", "_studio")

    _document: DriveDocument
    _name: str
    _studio: Studio
    _measured: bool
    _checked: AnnotatedDrive

    @reported
    def __init__(
        self,
        muscle: Model | str | Part,
        *,
        valve: str | Part,
        supply: Quantity | Part = "6 bar",
        command: Part | None = None,
        controller: Part | None = None,
        effects: Part | None = None,
        load: str | Part | None = None,
        tube: str | Part | None = None,
        duration: Quantity | None = None,
        title: str = "",
        **parts: Any,
    ) -> None:
        stated: dict[str, Any] = {
            "muscle": muscle, "valve": valve, "supply": supply, "command": command, "controller": controller,
            "effects": effects, "load": load, "tube": tube, "duration": duration, "title": title, **parts,
        }  # fmt: skip
        document = _document_of({name: value for name, value in stated.items() if value is not None})
        self._make(read_document(document, "the drive"), title or "the drive", studio())

    def _make(self, document: DriveDocument, name: str, of: Studio) -> None:
        measured = document.command is None and document.controller is None
        self._set(
            _document=document, _name=name, _studio=of, _measured=measured,
            _checked=drive_of(document, of, measured=measured),
        )  # fmt: skip

    @classmethod
    def of(cls, document: DriveDocument, name: str, of: Studio) -> Drive:
        """The drive of a checked document, for the rest of the door."""
        drive = cls.__new__(cls)
        drive._make(document, name, of)
        return drive

    @classmethod
    @reported
    def preset(cls, id: str) -> Drive:
        """A drive preset, "propneu-20-physical"; ``mckibben.presets("drives")`` lists them.

        Raises:
            Problem: an unknown preset, with the nearest match.
        """
        return cls.of(preset_document(id, studio()), id, studio())

    @classmethod
    @reported
    def load(cls, path: str | PathLike[str]) -> Drive:
        """The drive in a JSON file: a drive document or a drive preset.

        Raises:
            Problem: names the file, the field, what is wrong and what would be right.
        """
        name = fspath(path)
        document = named_document(name, studio())
        try:
            return cls.of(document, name, studio())
        except InputError as error:
            raise InputError(f"{name}: {error.message}", field=error.field, hint=error.hint) from error

    @property
    def _title(self) -> str:
        """Its name in titles."""
        return self._document.named(self._name)

    @property
    def document(self) -> dict[str, Any]:
        """The drive document, as `save` writes it."""
        return _document_of_file(self._document)

    @property
    def parsed(self) -> DriveDocument:
        """The drive document, checked."""
        return self._document

    @property
    def model(self) -> Model:
        """The muscle with all effects of the drive, those of its valve, tube and fittings too."""
        return model_of_document(self.document, self._studio)

    @reported
    def changed(self, **parts: Any) -> Drive:
        """The same drive with some parts replaced; None takes a part away.

        Raises:
            Problem: as for a new drive.
        """
        known = {**self.document, **_document_of(parts)}
        document = {name: value for name, value in known.items() if value is not None}
        return Drive.of(read_document(document, "the drive"), self._name, studio())

    @reported
    def run(
        self,
        *,
        points: int = POINTS,
        begin: Quantity | None = None,
        end: Quantity | None = None,
        progress: Callable[[float], object] | None = None,
    ) -> Run:
        """Simulate the drive.

        Args:
            points: rows of the result.
            begin, end: times of the first and last row; None = the whole run.
            progress: called with the share that is done, 0 to 1.

        Raises:
            Problem: a drive without a command, rows outside of the run, no equilibrium to start from.
        """
        if not 2 <= points <= 1_000_000:
            raise InputError(f"points: {points} is not between 2 and 1 000 000", hint="e.g. 2001")
        annotated = self._annotated()
        question = SimulationQuestion(
            annotated,
            points=points,
            begin=None if begin is None else number_of(begin, "s", "begin"),
            end=None if end is None else number_of(end, "s", "end"),
        )
        result = prepare(question)(Watch(progress=None if progress is None else _teller(progress)))
        return Run.of(result, _name=self._title)

    @reported
    def linearise(
        self,
        at: str | None = None,
        *,
        input: str = "command",
        output: str = "position",
        amplitudes: Sequence[Quantity] | None = None,
        design: str | None = None,
        sliding_speed: Quantity | None = None,
    ) -> LinearView:
        """Linear models of the drive at an operating point, and what they lose.

        Args:
            at: "position 40 mm", "contraction 10 %", "pressure 3 bar" or, of a regulator, "command 50 %";
                None = the middle of the positions that can be held.
            input: of the responses: "command", "supply_pressure" or "load_force".
            output: "position", "velocity", "pressure", "force", "mass_flow" or "position_reading".
            amplitudes: of sines for the nonlinear drive; None = 1, 5 and 20 % of the full command or of the
                tension, () = no sweep.
            design: goals of a position controller, "overshoot 5 %, settling 0.5 s, step 10 mm, no
                saturation"; None = no design.
            sliding_speed: of the load, at which models that slide against dry friction have the slopes of
                friction and damping, "20 mm/s"; None = they just slide.

        Raises:
            Problem: there is no equilibrium there (with those there are), or no such input, output or goal.
        """
        unit = "N" if input == "load_force" else "1"
        question = LinearQuestion(
            drive_of(self._document, self._studio, measured=True),
            at=None if at is None else condition_of(at),
            input=input,
            output=output,
            amplitudes=None
            if amplitudes is None
            else tuple(number_of(each, unit, "amplitudes") for each in amplitudes),
            goals=None if design is None else goals_of(design),
            sliding_speed=SLIDING_SPEED
            if sliding_speed is None
            else number_of(sliding_speed, "m/s", "sliding_speed"),
        )
        return LinearView.of(linear_view(question, Watch()), _name=self._title)

    @reported
    def stepper(self, dt: Quantity) -> Stepper:
        """The drive at its start, to be carried on step by step under commands of your own.

        Args:
            dt: step, "5 ms"; the command is held during it.

        Raises:
            Problem: a step that is not positive, pulse-width modulation, no equilibrium to start from.
        """
        drive = drive_of(self._document, self._studio, measured=True).drive
        return Stepper(Engine(drive, number_of(dt, "s", "dt")))

    @reported
    def to_control(self, at: str | None = None, *, dt: Quantity | None = None) -> Any:
        """The drive as a plant of python-control, with named inputs, states and outputs.

        Args:
            at: operating point of the linear state space, as for `linearise`; dead times are left out.
            dt: step; then it is the nonlinear drive in discrete time, a ``control.NonlinearIOSystem`` with
                the inputs command and load_force and the outputs position, velocity and pressure.

        Raises:
            Problem: python-control is not installed, no equilibrium there, or dead times with ``dt``.
        """
        if dt is None:
            return self.linearise(at, amplitudes=()).to_control()
        drive = drive_of(self._document, self._studio, measured=True).drive
        return nonlinear_plant(Engine(drive, number_of(dt, "s", "dt")))

    def _annotated(self) -> AnnotatedDrive:
        return drive_of(self._document, self._studio) if self._measured else self._checked

    def plot(self) -> Figure:
        """Position, pressure and force of a run; a Plotly figure."""
        return self.run().plot()

    @reported
    def save(self, path: str | PathLike[str]) -> None:
        """Write the drive document as JSON, for `Drive.load` and ``mckibben simulate``.

        Raises:
            Problem: the file cannot be written, or its ending is not .json.
        """
        check_ending(Path(path), (".json",))
        write_text(Path(path), _document_text(self._document))

    def _to_export(self) -> tuple[Stated, Studio]:
        title = self._document.title or self._name
        return of_drive(self._document, self._studio, "", title=title), self._studio

    def _summary(self) -> Summary:
        return _summary_of(self._document, self._title)

    def __str__(self) -> str:
        return plain_text(self._summary())

    def __repr__(self) -> str:
        return f"<Drive {self._title}>"

    def _repr_html_(self) -> str:
        return notebook_cell(f"Drive {self._title}", (), self._summary())


def _document_of(parts: Mapping[str, Any]) -> dict[str, Any]:
    """The parts as they stand in a document."""
    document = dict(parts)
    muscle = document.get("muscle")
    if isinstance(muscle, Model):
        document["muscle"] = muscle.document["muscle"]
    if isinstance(muscle, Model) and "effects" not in document and not muscle.has_preset_effects:
        own = muscle.document["effects"]
        document["effects"] = own if muscle.is_saved else {**_effects_of_parts(document), **own}
    return document


def _effects_of_parts(document: Mapping[str, Any]) -> dict[str, dict[str, float]]:
    """Default effects of the presets of valve, tube and fittings."""
    library = studio().library
    named: list[tuple[str, object]] = [("fittings", name) for name in document.get("fittings") or ()]
    for kind, name, text in (("valves", "valve", VALVE_TEXT), ("tubes", "tube", TUBE_TEXT)):
        part = text.document(document.get(name))
        if isinstance(part, Mapping):
            named.append((kind, cast("Mapping[str, object]", part).get("preset")))
    effects: dict[str, dict[str, float]] = {}
    for kind, name in named:
        preset = library.get(kind, name) if isinstance(name, str) else None
        if isinstance(preset, ValvePreset | TubePreset | FittingPreset):
            effects |= preset.effect_values()
    return effects


def _teller(progress: Callable[[float], object]) -> Callable[[float], None]:
    def tell(share: float) -> None:
        progress(share)

    return tell


class Run(ResultOf[SimulationResult], SimulationResult):
    """A run, from `Drive.run`; N rows, SI. Positions, speeds and accelerations are positive towards shorter.

    Arrays are read-only, shape (N,). A figure of `timing` that does not exist is None; its ``notes`` say why.
    """

    @property
    def messages(self) -> Sequence[str]:
        """Limits that are crossed, values that are assumed or not verified, why a run ended early."""
        return tuple(notices(self))

    def to_frame(self) -> pd.DataFrame:
        """One row for each time, SI: time_s, command, pressure_Pa, force_N, length_m and diameter_m are those
        of a measurement file; load_position_m, load_velocity_m/s and the other columns are not of the muscle.
        """
        return frame_of(trace_columns(self))

    def plot(self) -> Figure:
        """Position, pressure and force over time."""
        from mckibben.door.figures import run_figure

        return run_figure(self, self._name)

    def _files(self, path: Path) -> str:
        """``.csv``: the trace with the conditions that a measurement file has."""
        if path.suffix.lower() == ".csv":
            return trace_text(self)
        return super()._files(path)

    def _summary(self) -> Summary:
        return summary_of(self, self._name)

    def _title(self) -> str:
        return f"Run of {self._name}: {self.outcome}"


def _document_of_file(document: DriveDocument) -> dict[str, Any]:
    """The drive with what says in a file that it is one."""
    return {"schema": 1, "kind": "drive", **document.to_document()}


def _document_text(document: DriveDocument) -> str:
    """The content of the file of a drive."""
    return json.dumps(_document_of_file(document), indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def _summary_of(document: DriveDocument, name: str) -> Summary:
    """The stated parts, numbers in SI.

    Args:
        document: the drive.
        name: for the title.
    """
    parts = {
        key: part for key, part in document.to_document().items() if key not in ("schema", "kind", "title")
    }
    rows = [[key.replace("_", " "), _shown(part)] for key, part in parts.items()]
    title = f"{name}: {document.title}" if document.title and document.title != name else name
    return [Table(title, ["part", "stated (SI)"], rows)]


def _shown(part: object) -> str:
    if isinstance(part, Mapping):
        inside = (f"{key} ({_shown(value)})" if isinstance(value, Mapping) else f"{key} {_shown(value)}"
                  for key, value in part.items())  # fmt: skip
        return ", ".join(inside) or "as usual"
    if isinstance(part, list):
        return ", ".join(_shown(value) for value in part[:8]) + (", …" if len(part) > 8 else "")
    return f"{part:.6g}" if isinstance(part, float) else str(part)
