"""Collects the content of a diagnosis report."""

from __future__ import annotations

import json
import shlex
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from datetime import datetime
from typing import NamedTuple

from mckibben.application.compare.compare import ComparisonResult, compare
from mckibben.application.compare.question import ModelQuestion, with_model
from mckibben.application.diagnose.diagnose import prepare as prepare_diagnosis
from mckibben.application.diagnose.result import DiagnosisResult
from mckibben.application.json_text import to_json
from mckibben.application.measurement.specimen_result import common_experiment
from mckibben.application.measurement.summary import summary_of
from mckibben.documents.start_model import PresetFacts, StatedMuscle
from mckibben.documents.studio import Studio
from mckibben.documents.value_names import value_names, value_words
from mckibben.facts.run import curve_fit_of
from mckibben.identification.predict.fit_model import LOAD
from mckibben.measurement.experiment import ACCURACY, FIELDS, FROM_DRIVE, LOAD_FORCE, Experiment, shown_value
from mckibben.measurement.points import Points
from mckibben.physics.effect import Effect
from mckibben.physics.muscle import GEOMETRY
from mckibben.presets.quantity import Quantity, quantities
from mckibben.report.command import Command
from mckibben.report.diagnosis.material import DataSource, DiagnosisMaterial, MuscleFacts, PastModel
from mckibben.report.diagnosis.writing import diagnosis_report
from mckibben.report.document import versions
from mckibben.report.sources import Figure
from mckibben.simulation.outcome import Watch

_MODEL_FILE = "model.json"


class ReportOptions(NamedTuple):
    """Options of a report that are not part of the question.

    Attributes:
        title: "" to use the names of the measurements.
        history: label and question of each model before this one.
        unverified: unverified preset figures of the drive: part -> names.
        fit: fit the model before it is compared.
    """

    title: str = ""
    history: Sequence[tuple[str, ModelQuestion]] = ()
    unverified: Mapping[str, Sequence[str]] = {}
    fit: bool = False


def prepare(
    question: ModelQuestion, studio: Studio, options: ReportOptions, *, diagnose: bool
) -> Callable[[Watch], str]:
    """The report of a question, ready to be computed and written.

    Raises:
        InputError: the measurement does not allow the comparison or diagnosis.
    """
    diagnosis = prepare_diagnosis(question, studio) if diagnose else None

    def work(watch: Watch) -> str:
        return report_of(question, studio, options, None if diagnosis is None else diagnosis(watch))

    return work


def report_of(
    question: ModelQuestion, studio: Studio, options: ReportOptions, diagnosis: DiagnosisResult | None
) -> str:
    """The HTML of a question and its diagnosis.

    Raises:
        InputError: the measurement does not allow the comparison.
    """
    comparison = compare(question, fit=options.fit)
    parts = [*_sources(question.points, "fit")]
    if question.validation is not None:
        parts += _sources(question.validation.points, "validation")
    names = [source.name for source in parts if source.use == "fit"]
    preset = question.start.preset
    known = {} if preset is None else dict(quantities(studio.library.muscle(preset.id)))
    catalogue = {**studio.catalogue, **question.start.catalogue}
    return diagnosis_report(
        DiagnosisMaterial(
            title=options.title.strip() or ", ".join(names),
            made=datetime.now().astimezone(),
            versions=versions(),
            sources=parts,
            muscle=_muscle_facts(question, studio, known),
            catalogue=catalogue,
            comparison=comparison,
            figures=dict(_figures(question, catalogue, preset, known)),
            command=_command(question, comparison, names, diagnosis),
            diagnosis=diagnosis,
            proposed=None if diagnosis is None else _proposed(question, studio, diagnosis),
            history=[
                PastModel(label, tuple(past.start.effects), compare(past.with_data_of(question)))
                for label, past in options.history
            ],
            drive=tuple(_drive(question)),
            unverified=tuple(_unverified(question, catalogue, preset, known, options.unverified)),
        )
    )


def _sources(points: Points, use: str) -> Iterator[DataSource]:
    for part in points.parts or (points,):
        measurement = part.measurement
        yield DataSource(
            name=measurement.name,
            identity="" if part.source else measurement.id,
            origin=part.source and f"built in; {part.source}",
            use=use,
            about=summary_of(measurement),
            left_out=part.left_out,
        )


def _muscle_facts(question: ModelQuestion, studio: Studio, known: Mapping[str, Quantity]) -> MuscleFacts:
    preset, muscle = question.start.preset, question.start.muscle
    if preset is None:
        return MuscleFacts()
    figures = {
        name: Figure(quantity.source, quantity.grade)
        for name in GEOMETRY
        if (quantity := known.get(f"geometry.{name}"))
        and getattr(muscle, name) == getattr(preset.muscle, name)
    }
    units = {"max_pressure": "Pa", "max_force": "N", "max_contraction": "1", "max_pretension": "1"}
    limits = {
        name: (value, unit, Figure(quantity.source, quantity.grade))
        for name, unit in units.items()
        if (value := getattr(preset.limits, name)) is not None and (quantity := known.get(f"limits.{name}"))
    }
    return MuscleFacts(f"{preset.id} ({studio.library.muscle(preset.id).title})", figures, limits)


def _figures(
    question: ModelQuestion,
    catalogue: Mapping[str, Effect],
    preset: PresetFacts | None,
    known: Mapping[str, Quantity],
) -> Iterator[tuple[str, Figure]]:
    """Source of each effect parameter: the preset or the catalogue's default. None for the user's values."""
    for effect, values in question.start.effects.items():
        preset_values = {} if preset is None else preset.effects.get(effect, {})
        for parameter in catalogue[effect].parameters:
            name, value = parameter.name, values[parameter.name]
            quantity = known.get(f"effects.{effect}.{name}")
            if quantity is not None and preset_values.get(name) == value:
                yield f"{effect}.{name}", Figure(f"preset: {quantity.source}", quantity.grade)
            elif value == parameter.default:
                source = parameter.source
                yield f"{effect}.{name}", Figure(f"default: {source.text}", source.grade)


def _unverified(
    question: ModelQuestion,
    catalogue: Mapping[str, Effect],
    preset: PresetFacts | None,
    known: Mapping[str, Quantity],
    drive_figures: Mapping[str, Sequence[str]],
) -> Iterator[str]:
    if preset is not None:
        for path, quantity in known.items():
            if path in preset.unverified and not path.startswith("effects."):
                where = ", ".join(value_names([path], catalogue))
                value = f"{quantity.value:g} {quantity.unit}"
                yield f"{preset.id}, {where} = {value}: {quantity.source} (grade {quantity.grade})"
    for part, names in drive_figures.items():
        yield f"{part}: {', '.join(names)}"
    for path, figure in _figures(question, catalogue, preset, known):
        if figure.grade in ("M", "E"):
            effect, name = path.split(".")
            words = f"{catalogue[effect].title}, {value_words(name)}"
            yield f"{words}: {figure.source} (grade {figure.grade})"


def _drive(question: ModelQuestion) -> Iterator[tuple[str, str]]:
    """The drive of a transient measurement, in words."""
    drive = question.drive
    if drive is None:
        return
    valve, load = drive.valve, drive.load
    if drive.curve_fit:
        yield "Drive", curve_fit_of(drive.curve_fit)
    yield "Supply", f"{drive.supply_pressure / 1e5:.4g} bar"
    yield "Valve, filling", f"{valve.fill_conductance * 1e8:.4g} l/(s·bar)"
    yield "Valve, venting", f"{valve.exhaust_conductance * 1e8:.4g} l/(s·bar)"
    force = f"{load.force:.4g} N" if isinstance(load.force, float | int) else "a force over time"
    yield "Load", f"{load.mass:.4g} kg and {force}"
    yield "Fitting volume", f"{drive.fitting_volume * 1e6:.4g} cm³"
    yield "Air", drive.gas_closure
    yield "Start pressure", f"{(drive.start_pressure or 0.0) / 1e5:.4g} bar"


def _proposed(question: ModelQuestion, studio: Studio, diagnosis: DiagnosisResult) -> ComparisonResult | None:
    """Comparison of the final model of the diagnosis; None if it adds no effect."""
    if not diagnosis.verdict.effects:
        return None
    model = diagnosis.model
    length = float(question.start.muscle.nominal_length)
    muscle = replace(StatedMuscle(), **{"nominal_length": length, **model.muscle})
    other = with_model(question, studio, muscle, model.effects, freed=tuple(diagnosis.freed))
    # A load missing in the measurement is not stored in the model, so it is fitted again.
    fit_load = LOAD in diagnosis.parameters.get("geometry", {})
    last = diagnosis.path[-1]
    return replace(compare(other, fit=fit_load), holdout_rmse=last.holdout_rmse, fitted=last.fitted)


def _command(
    question: ModelQuestion,
    comparison: ComparisonResult,
    names: Sequence[str],
    diagnosis: DiagnosisResult | None,
) -> Command:
    geometry = comparison.geometry
    model = {
        "muscle": {
            name: getattr(geometry, name)
            for name in GEOMETRY
            if getattr(geometry, name) and (name != "nominal_length" or question.specimens.one_length)
        },
        "effects": comparison.model.effects,
    }
    files = [_typed(name) for name in names]
    free = [f"--free {name}" for name in question.free]
    noise = [] if question.noise is None else [f"--noise {question.noise!r}"]
    checks = () if question.validation is None else question.validation.each
    files += [f"--validate {_typed(one.name)}" for one in checks]
    prepared = {tuple(step.step for step in one.points.measurement.prepared)
                for one in (*question.specimens.each, *checks)}  # fmt: skip
    steps = prepared.pop() if len(prepared) == 1 else ()
    files += [f"--prepare {shlex.quote(step)}" for step in steps]
    shared = [*files, f"--drive {_MODEL_FILE}", *_stated_options(common_experiment(question))]
    lines = [" ".join(["mckibben compare", *shared])]
    if diagnosis is not None:
        lines.append(" ".join(["mckibben diagnose", *shared, *free, *noise, "--report report.html"]))
    notes = []
    if question.drive is not None:
        notes.append(
            f"{_MODEL_FILE} holds muscle and effects; add valve, supply, load and the like of the drive "
            "document to reproduce a transient. The valve command comes from the measurement file."
        )
    if question.freed:
        notes.append(f"Constants fitted in addition: {', '.join(question.freed)}.")
    if prepared:
        notes.append("The files are prepared in different ways, which the command does not say.")
    results = {"comparison.json": to_json(comparison).decode()}
    if diagnosis is not None:
        results["diagnosis.json"] = to_json(diagnosis).decode()
    return Command(lines, {_MODEL_FILE: json.dumps(json.loads(to_json(model)), indent=2)}, notes, results)


def _stated_options(experiment: Experiment) -> Iterator[str]:
    """The options that state what the user said of all measurements."""
    accuracies = []
    for name, value in experiment.items():
        if value.origin not in ("you", "suggested") or name in ("muscle", LOAD_FORCE):
            continue
        if value.where == FROM_DRIVE:
            continue
        shown = shown_value(name, value)
        option = FIELDS[name].option.partition(" ")[0]
        if name.startswith(ACCURACY):
            accuracies.append(f"{name.removeprefix(ACCURACY)} {shown.partition(' of ')[0]}")
        elif option == "--experiment":
            yield f"--experiment {shlex.quote(f'{name}={shown}')}"
        else:
            yield f"{option} {shlex.quote(shown)}"
    if accuracies:
        yield f"--accuracy {shlex.quote(', '.join(accuracies))}"


def _typed(name: str) -> str:
    """A file name quoted for the shell; a leading dash does not make it an option."""
    return shlex.quote(f"./{name}" if name.startswith("-") else name)
