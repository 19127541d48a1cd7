"""A diagnosed model as documents: the file of the model, and of a transient the drive with it inside."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from datetime import UTC, datetime
from typing import Any

from mckibben.application.compare.compare import Compared, ComparisonResult, compared_whole
from mckibben.application.compare.question import ModelQuestion
from mckibben.application.compare.specimens import Specimen
from mckibben.application.diagnose.result import DiagnosisResult
from mckibben.application.envelope import MeasuredRange
from mckibben.application.measurement.experiment import stated_in
from mckibben.application.measurement.specimen_result import SpecimenResult
from mckibben.documents.saved_model import SavedModel, fit_record, read_saved_model
from mckibben.documents.start_model import stated_muscle
from mckibben.documents.studio import Studio
from mckibben.identification.fit.comparison import determined
from mckibben.identification.fit.least_squares import FittedCovariance
from mckibben.identification.predict.fit_model import LOAD, FitModel
from mckibben.measurement.experiment import place_of, shown_value, title_of
from mckibben.physics.custom import CUSTOM
from mckibben.physics.errors import InputError
from mckibben.physics.muscle import GEOMETRY, Muscle, assumption
from mckibben.presets import MusclePreset
from mckibben.version import __version__

_DECIDED = ("you", "suggested")  # origins of a value that the user has decided for
#: Condition of a measurement that takes precedence over the drive, and where a drive document has it.
_CONDITIONS = (
    ("load_mass", "load", "mass"), ("load_force", "load", "force"),
)  # fmt: skip

_UNITS = {name: "rad" if name == "braid_angle" else "m" for name in GEOMETRY}
_SAME = 1e-9  # relative difference below which a value is that of the preset it started from
_LONGEST_SOURCE = 300
_NOT_FITTED = "of the model, not fitted"
#: What a preset has from the one that its model started from: nothing of it was fitted.
_INHERITED = (
    "maker",
    "series",
    "tolerance",
    "limits",
    "data",
    "reference_curve",
    "measurement",
    "references",
)


def muscle_document(question: ModelQuestion, muscle: Muscle, studio: Studio) -> dict[str, Any]:
    """A fitted muscle with all its dimensions, and its preset if that is one of the program.

    A preset adds the limits and tolerances of the maker; one of the user would not be found elsewhere.

    Args:
        question: for the preset.
        muscle: the geometry.
        studio: presets.
    """
    preset = question.start.preset
    named = preset is not None and studio.library.is_built_in("muscles", preset.id)
    geometry = {name: float(value) for name, value in zip(GEOMETRY, muscle, strict=True) if value}
    return {"preset": preset.id, **geometry} if preset is not None and named else geometry


def drive_of_model(question: ModelQuestion, model: FitModel, studio: Studio) -> dict[str, object] | None:
    """The drive document of the first transient measurement with a model inside; None where there is none.

    Supply (or the fitted one) and load are those of the measurement, stops are stated. Its command was
    measured: it is the document's own, if that has one.

    Args:
        question: the measurements.
        model: muscle and effects.
        studio: presets.
    """
    specimen = question.specimens.each[0]
    if specimen.document is None or specimen.drive is None:
        return None
    drive, conditions = specimen.drive, specimen.points.measurement.conditions
    parts = specimen.document.to_document()
    stated = float(conditions.get("supply_pressure", drive.supply_pressure))
    parts["supply"] = {"pressure": model.supply_factor * stated}
    for condition, part, name in _CONDITIONS:
        if condition in conditions:
            own = parts.get(part)
            parts[part] = {**(own if isinstance(own, dict) else {}), name: float(conditions[condition])}
    own = parts.get("stops")
    parts["stops"] = {
        **(own if isinstance(own, dict) else {}),
        "min_contraction": float(drive.min_contraction),
        "max_contraction": float(drive.max_contraction),
    }
    parts["muscle"] = muscle_document(question, model.muscle, studio)
    parts["effects"] = question.effect_document(model)
    return {"schema": 1, **parts}


def saved_model(question: ModelQuestion, result: DiagnosisResult, studio: Studio) -> SavedModel:
    """The best model of a diagnosis as a document that stands alone.

    Args:
        question: of the diagnosis.
        result: its answer.
        studio: presets.

    Raises:
        InputError: a fitted value lies outside what a document may state.
    """
    last = result.path[-1]
    return _saved(
        question,
        result,
        studio,
        freed=result.freed,
        envelope=result.envelope,
        drive=result.model.drive,
        verdict=result.verdict.title,
        error=(last.rmse, last.holdout_rmse, result.noise_floor.rmse),
        covariance=result.covariance,
    )


def fitted_model(question: ModelQuestion, compared: Compared, studio: Studio) -> SavedModel:
    """The fitted model of a comparison as a document that stands alone.

    Args:
        question: of the comparison.
        compared: the comparison, with a fit.
        studio: presets.

    Raises:
        InputError: a fitted value lies outside what a document may state.
    """
    result = compared.result
    return _saved(
        question,
        result,
        studio,
        freed=question.freed,
        envelope=compared.envelope,
        drive=drive_of_model(question, compared.comparison.fit_model, studio),
        verdict="fitted, not diagnosed",
        error=(result.rmse, result.holdout_rmse, result.noise_floor),
        covariance=None if (fit := compared.comparison.fit) is None else fit.covariance,
    )


def present_model(question: ModelQuestion, studio: Studio) -> SavedModel:
    """The model of a question as it is, without a fit: its values were found by one before.

    Args:
        question: the model, and the data that it was fitted to.
        studio: presets.

    Raises:
        InputError: the data do not allow the comparison.
    """
    compared = compared_whole(question)
    fit = determined(
        compared.comparison.predictor,
        compared.comparison.fit_model,
        geometry=question.free_geometry(),
        freed=question.freed,
    )
    result = compared.result
    return _saved(
        question,
        result,
        studio,
        freed=question.freed,
        envelope=compared.envelope,
        drive=None,
        verdict="as it was kept",
        error=(result.rmse, result.holdout_rmse, result.noise_floor),
        covariance=None if fit is None else fit.covariance,
    )


def _corrected_length(question: ModelQuestion) -> dict[str, float]:
    """The rest length that was stated for the data if the user has decided for another one, now or before."""
    if not question.specimens.one_length:
        return {}
    stated, taken = set[float](), set[float]()
    for specimen in question.specimens.each:
        own = stated_in(specimen.points).get("rest_length")
        decided = specimen.experiment.get("rest_length")
        if own is not None and own.origin == "file" and decided is not None and decided.origin in _DECIDED:
            stated.add(float(own.value))
            taken.add(float(decided.value))
    if len(stated) == len(taken) == 1 and stated != taken:
        return {"nominal_length": stated.pop()}
    start = question.start
    before = start.corrected_length
    shown = start.muscle if start.stated or start.preset is None else start.preset.muscle
    same = abs(shown.nominal_length - start.muscle.nominal_length) < 1e-9
    return {} if before is None or not same else {"nominal_length": before}


def _saved(
    question: ModelQuestion,
    result: DiagnosisResult | ComparisonResult,
    studio: Studio,
    *,
    freed: Sequence[str],
    envelope: Mapping[str, MeasuredRange],
    drive: Mapping[str, object] | None,
    verdict: str,
    error: tuple[float, float | None, float | None],
    covariance: FittedCovariance | None,
) -> SavedModel:
    """The document; ``error``: rmse, hold-out rmse, noise."""
    of_geometry = result.parameters.get("geometry", {})
    # The summary has every dimension of the fitted muscle.
    fitted = Muscle(*(float(getattr(result.geometry, name)) for name in GEOMETRY))
    muscle = muscle_document(question, fitted, studio)
    if not question.specimens.one_length:
        del muscle["nominal_length"]
    document: dict[str, Any] = {
        "schema": 1,
        "kind": "model",
        "muscle": muscle,
        "effects": result.model.effects,
        "freed": list(freed),
        "free": [name for name in of_geometry if name in GEOMETRY],
        "stated": {
            name: float(getattr(question.start.muscle, name)) for name in of_geometry if name in muscle
        }
        | _corrected_length(question),
        "envelope": {
            name: {"least": found.least, "most": found.most, "unit": found.unit}
            for name, found in envelope.items()
        },
        "errors": {name: item.rmse for name, item in result.channels.items()} or {result.predicted: error[0]},
        "assumed": _assumed(question, result.model.effects, drive, fitted),
        "origin": {
            "program": f"mckibben {__version__}",
            "made": datetime.now(UTC).isoformat(timespec="seconds"),
            "kind": result.kind,
            "predicted": result.predicted,
            "verdict": verdict,
            "error": dict(zip(("rmse", "holdout_rmse", "noise"), error, strict=True)) | {"unit": result.unit},
            "files": [
                _file(specimen, shown)
                for specimen, shown in zip(question.specimens.each, result.specimens, strict=True)
            ],
        },
    }
    if covariance is not None:
        document["covariance"] = {"names": covariance.names, "matrix": covariance.matrix}
    if LOAD in of_geometry and question.predictor.unknown_load is not None:
        document["load_force"] = of_geometry[LOAD].value
    if drive is not None:
        document["drive"] = drive
    return read_saved_model(document, "the model")


def model_text(model: SavedModel) -> str:
    """The content of the file of a saved model."""
    return json.dumps(model.to_document(), indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def _assumed(question: ModelQuestion, effects: Iterable[str], document: object, muscle: Muscle) -> list[str]:
    """What nobody said: of the experiments, of the muscle, and which drive is shown."""
    specimens, start = question.specimens, question.start
    assumed = [
        one.words + (f" for {', '.join(one.files)}" if one.files else "") for one in question.assumptions
    ]
    needed = [name for name in GEOMETRY if not getattr(start.muscle, name) and getattr(muscle, name)]
    assumed += [assumption(muscle, name) for name in (*start.assumed, *needed)]
    drive, known = specimens.each[0].drive, start.catalogue
    if drive is not None and drive.tube is None and drive.assumed_tube is not None:
        tube = drive.assumed_tube
        if any(name in known and known[name].of_tube for name in effects):
            size = f"{1e3 * tube.inside_diameter:.3g} mm bore and {tube.length:.3g} m length"
            assumed.append(f"a tube of {size}, because an effect acts on it")
    if document is not None and specimens.several:
        assumed.append(f"the drive is that of {specimens.each[0].name}, the first of the measurements")
    return assumed


def _file(specimen: Specimen, shown: SpecimenResult) -> dict[str, Any]:
    points = specimen.points
    return {
        "name": specimen.name,
        "sha256": None if points.source else points.measurement.id,
        "rows": points.measurement.rows,
        "experiment": {
            title_of(name): f"{shown_value(name, value)}, {place_of(value)}"
            for name, value in shown.experiment.items()
        },
        "prepared": [step.step for step in points.measurement.prepared],
    }


def keep(saved: SavedModel, studio: Studio, *, id: str, title: str = "") -> MusclePreset:
    """Save a fitted model as a muscle of the user.

    Args:
        saved: the model.
        studio: presets.
        id: of the new preset; one of the user with this id is replaced.
        title: its name for display; "" = the id.

    Raises:
        InputError: a model with a typed term, or without a length; an id that cannot be used (``field`` id).
    """
    return studio.library.save_muscle(preset_document(saved, studio, id=id, title=title or id))


def preset_document(saved: SavedModel, studio: Studio, *, id: str, title: str) -> dict[str, Any]:
    """The muscle preset of a fitted model as a document.

    Geometry and parameters that the fit did not change keep their sources; limits are those of the preset
    that the model started from.

    Raises:
        InputError: as `keep`, but for the id.
    """
    if CUSTOM in saved.effects:
        raise InputError(
            "a model with a typed term cannot be a preset", field="effects.custom",
            hint="save it as a model (JSON), which keeps the term",
        )  # fmt: skip
    base = None if saved.muscle.preset is None else studio.library.muscle(saved.muscle.preset)
    if saved.muscle.nominal_length is None and base is None:
        raise InputError(
            "the model is one of muscles of several lengths and has none of its own",
            field="muscle.nominal_length",
            hint="state the length that the preset shall have",
        )
    start = studio.start_model(stated_muscle(saved.muscle), saved.effects)
    before = None if base is None else studio.facts(base.id)
    stated = {} if base is None else base.to_document()
    source = _source(saved)
    record = fit_record(saved)

    catalogue = start.catalogue

    def quantity(
        value: float, unit: str, old: float | None, said: Mapping[str, Any] | None, *, fitted: bool
    ) -> dict[str, Any]:
        """The value with its old source where it is unchanged, else with that of the model."""
        if said is not None and old is not None and abs(value - old) <= _SAME * abs(old):
            return dict(said)
        return {"value": value, "unit": unit, "source": source if fitted else _NOT_FITTED, "grade": "user"}

    return {
        "schema": 1,
        "kind": "muscle",
        "id": id,
        "title": title,
        **{name: stated[name] for name in _INHERITED if name in stated},
        "description": "A muscle by its geometry." if base is None else f"Based on {base.title}.",
        "geometry": {
            name: quantity(
                value,
                _UNITS[name],
                None if before is None else getattr(before.muscle, name),
                stated.get("geometry", {}).get(name),
                fitted=name in saved.free,
            )
            for name, value in start.muscle._asdict().items()
            if value
        },
        "effects": {
            effect: {
                name: quantity(
                    value,
                    catalogue[effect].parameter(name).unit,
                    None if before is None else before.effects.get(effect, {}).get(name),
                    stated.get("effects", {}).get(effect, {}).get(name),
                    fitted=catalogue[effect].parameter(name).fitted or f"{effect}.{name}" in saved.freed,
                )
                for name, value in values.items()
            }
            for effect, values in start.effects.items()
        },
        **({} if record is None else {"fit": record.model_dump(mode="json", exclude_none=True)}),
    }


def _source(saved: SavedModel) -> str:
    files = [] if saved.origin is None else [file.name for file in saved.origin.files]
    if not files:
        return "from a saved model"
    named = f"fitted to {', '.join(files)}"
    return named if len(named) <= _LONGEST_SOURCE else f"fitted to {len(files)} measurements"
