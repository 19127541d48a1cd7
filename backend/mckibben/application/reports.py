"""The report of a diagnosis: everything it tells, computed and looked up."""

from __future__ import annotations

import json
import shlex
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from datetime import datetime
from typing import NamedTuple

from mckibben.application.asked import Asked
from mckibben.application.comparisons import comparison_answer
from mckibben.application.diagnoses import prepare as prepare_diagnosis
from mckibben.application.json_text import to_json
from mckibben.application.measurements import measurement_answer
from mckibben.application.programs import versions
from mckibben.application.start import Json
from mckibben.documents.start_model import GivenMuscle, PresetFacts
from mckibben.documents.studio import Studio
from mckibben.identification.predict.fit_model import LOAD
from mckibben.measurement.points import Points
from mckibben.physics.effect import Effect
from mckibben.physics.muscle import GEOMETRY
from mckibben.presets.quantity import Quantity, quantities
from mckibben.report.diagnosis import (
    Command,
    Figure,
    Material,
    MuscleFacts,
    PastModel,
    Source,
    diagnosis_report,
)
from mckibben.simulation.outcome import Watch

_MODEL_FILE = "model.json"


class Told(NamedTuple):
    """What a report tells besides its question.

    Attributes:
        title: "" for the names of the measurements.
        history: label and question of each model before this one.
        unverified: preset figures of the drive that nobody verified: part -> names.
        fit: fit the model before it is compared.
    """

    title: str = ""
    history: Sequence[tuple[str, Asked]] = ()
    unverified: Mapping[str, Sequence[str]] = {}
    fit: bool = False


def prepare(asked: Asked, studio: Studio, told: Told, *, diagnose: bool) -> Callable[[Watch], str]:
    """The report of a question, ready to be computed and written.

    Raises:
        InputError: the measurement does not allow the comparison or diagnosis.
    """
    diagnosis = prepare_diagnosis(asked, studio) if diagnose else None

    def work(watch: Watch) -> str:
        return report_of(asked, studio, told, None if diagnosis is None else diagnosis(watch))

    return work


def report_of(asked: Asked, studio: Studio, told: Told, diagnosis: Json | None) -> str:
    """The HTML of a question and its diagnosis.

    Raises:
        InputError: the measurement does not allow the comparison.
    """
    comparison = comparison_answer(asked, fit=told.fit)
    parts = [*_sources(asked.points, "fit")]
    if asked.validation is not None:
        parts += _sources(asked.validation, "validation")
    names = [source.name for source in parts if source.use == "fit"]
    preset = asked.start.preset
    known = {} if preset is None else dict(quantities(studio.library.muscle(preset.id)))
    catalogue = {**studio.catalogue, **asked.start.catalogue}
    return diagnosis_report(
        Material(
            title=told.title.strip() or ", ".join(names),
            made=datetime.now().astimezone(),
            versions=versions(),
            sources=parts,
            muscle=_muscle_facts(asked, studio, known),
            catalogue=catalogue,
            comparison=comparison,
            figures=dict(_figures(asked, catalogue, preset, known)),
            command=_command(asked, comparison, names, diagnosed=diagnosis is not None),
            diagnosis=diagnosis,
            proposed=None if diagnosis is None else _proposed(asked, studio, diagnosis),
            history=[
                PastModel(label, tuple(past.start.effects), comparison_answer(past))
                for label, past in told.history
            ],
            drive=tuple(_drive(asked)),
            unverified=tuple(_unverified(asked, catalogue, preset, known, told.unverified)),
        )
    )


def _sources(points: Points, use: str) -> Iterator[Source]:
    for part in points.parts or (points,):
        measurement = part.measurement
        yield Source(
            name=measurement.name,
            identity="" if part.source else measurement.id,
            origin=part.source and f"built in; {part.source}",
            use=use,
            about=measurement_answer(measurement),
            left_out=part.left_out,
        )


def _muscle_facts(asked: Asked, studio: Studio, known: Mapping[str, Quantity]) -> MuscleFacts:
    preset, muscle = asked.start.preset, asked.start.muscle
    if preset is None:
        return MuscleFacts()
    figures = {
        name: Figure(found.source, found.grade)
        for name in GEOMETRY
        if (found := known.get(f"geometry.{name}")) and getattr(muscle, name) == getattr(preset.muscle, name)
    }
    units = {"max_pressure": "Pa", "max_force": "N", "max_contraction": "1", "max_pretension": "1"}
    limits = {
        name: (value, unit, Figure(found.source, found.grade))
        for name, unit in units.items()
        if (value := getattr(preset.limits, name)) is not None and (found := known.get(f"limits.{name}"))
    }
    return MuscleFacts(f"{preset.id} ({studio.library.muscle(preset.id).title})", figures, limits)


def _figures(
    asked: Asked, catalogue: Mapping[str, Effect], preset: PresetFacts | None, known: Mapping[str, Quantity]
) -> Iterator[tuple[str, Figure]]:
    """Where the given values of the effects come from: the preset, the catalogue's default, or the user."""
    for effect, values in asked.start.effects.items():
        own = {} if preset is None else preset.effects.get(effect, {})
        for parameter in catalogue[effect].parameters:
            name, value = parameter.name, values[parameter.name]
            found = known.get(f"effects.{effect}.{name}")
            if found is not None and own.get(name) == value:
                yield f"{effect}.{name}", Figure(f"preset: {found.source}", found.grade)
            elif value == parameter.default:
                source = parameter.source
                yield f"{effect}.{name}", Figure(f"default: {source.text}", source.grade)


def _unverified(
    asked: Asked,
    catalogue: Mapping[str, Effect],
    preset: PresetFacts | None,
    known: Mapping[str, Quantity],
    of_drive: Mapping[str, Sequence[str]],
) -> Iterator[str]:
    if preset is not None:
        for path, found in known.items():
            if not found.verified and path.rpartition(".")[2].replace("_", " ") in preset.unverified:
                where = path.replace("_", " ").replace(".", ": ")
                value = f"{found.value:g} {found.unit}"
                yield f"{preset.id}, {where} = {value}: {found.source} (grade {found.grade})"
    for part, names in of_drive.items():
        yield f"{part}: {', '.join(names)}"
    for path, found in _figures(asked, catalogue, None, {}):
        if found.grade in ("M", "E"):
            effect, name = path.split(".")
            yield f"{catalogue[effect].title}, {name.replace('_', ' ')}: {found.source} (grade {found.grade})"


def _drive(asked: Asked) -> Iterator[tuple[str, str]]:
    """Valve, tube and load that a transient was compared with."""
    drive = asked.drive
    if drive is None:
        return
    valve, load = drive.valve, drive.load
    yield "Supply", f"{drive.supply_pressure / 1e5:.4g} bar"
    yield "Valve, filling", f"{valve.fill_conductance * 1e8:.4g} l/(s·bar)"
    yield "Valve, venting", f"{valve.exhaust_conductance * 1e8:.4g} l/(s·bar)"
    yield "Load", f"{load.mass:.4g} kg and {load.force:.4g} N"
    yield "Fitting volume", f"{drive.fitting_volume * 1e6:.4g} cm³"
    yield "Polytropic exponent", f"{drive.polytropic_exponent:.4g}"
    yield "Start pressure", f"{(drive.start_pressure or 0.0) / 1e5:.4g} bar"


def _proposed(asked: Asked, studio: Studio, diagnosis: Json) -> Json | None:
    """The comparison of the model that the diagnosis ends with; None when it is the given one."""
    if not diagnosis["verdict"]["effects"]:
        return None
    model = diagnosis["model"]
    other = with_model(asked, studio, GivenMuscle(**model["muscle"]), model["effects"])
    # A load that the measurement does not say is no part of a model: it has to be fitted again.
    again = LOAD in diagnosis["parameters"].get("geometry", {})
    comparison = comparison_answer(replace(other, freed=tuple(diagnosis["freed"])), fit=again)
    return comparison | {"holdout_rmse": diagnosis["path"][-1]["holdout_rmse"]}


def with_model(
    asked: Asked, studio: Studio, muscle: GivenMuscle, effects: Mapping[str, Mapping[str, float | str]]
) -> Asked:
    """The same question about another model.

    Raises:
        InputError: a geometry, effect or value that cannot be used.
    """
    start = replace(studio.start_model(muscle, effects), preset=asked.start.preset)
    drive = None if asked.drive is None else replace(asked.drive, model=studio.static_model(start))
    return replace(asked, start=start, drive=drive, free=())


def _command(asked: Asked, comparison: Json, names: Sequence[str], *, diagnosed: bool) -> Command:
    geometry = comparison["geometry"]
    model = {
        "muscle": {name: geometry[name] for name in GEOMETRY if geometry[name]},
        "effects": comparison["model"]["effects"],
    }
    files = [_typed(name) for name in names]
    free = [f"--free {name}" for name in asked.free]
    noise = [] if asked.noise is None else [f"--noise {asked.noise!r}"]
    shared = [*files, f"--drive {_MODEL_FILE}"]
    lines = [" ".join(["mckibben compare", *shared])]
    if diagnosed:
        lines.append(" ".join(["mckibben diagnose", *shared, *free, *noise, "--report report.html"]))
    notes = []
    if asked.drive is not None:
        notes.append(
            f"{_MODEL_FILE} holds muscle and effects; add valve, supply, load and the like of the drive "
            "document to repeat a transient. The command is that of the file."
        )
    if asked.freed:
        notes.append(f"Constants that were freed in addition: {', '.join(asked.freed)}.")
    if asked.validation is not None:
        notes.append("The validation data are not part of the command.")
    return Command(lines, {_MODEL_FILE: json.dumps(json.loads(to_json(model)), indent=2)}, notes)


def _typed(name: str) -> str:
    """A file name as a shell takes it, never as an option."""
    return shlex.quote(f"./{name}" if name.startswith("-") else name)
