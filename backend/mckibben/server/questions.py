"""Conversion of request bodies to the questions of the use cases."""

from __future__ import annotations

from mckibben.application.compare.question import ModelQuestion, question_of
from mckibben.application.compare.stated_question import with_noise
from mckibben.application.curves.curves import CurvesQuestion
from mckibben.application.curves.inverse import InverseQuestion, question_of_document
from mckibben.application.diagnose.doubts import with_decisions
from mckibben.application.joint.joint import JointQuestion
from mckibben.application.measurement.experiment import QuestionMeasurement, QuestionModel
from mckibben.documents.drive import DriveDocument
from mckibben.documents.drive_reading import drive_of
from mckibben.documents.experiment import stated_accuracy, stated_experiment
from mckibben.documents.joint import joint_of
from mckibben.documents.joint_question import JointQuestionInput, read_joint_question
from mckibben.documents.muscle import MuscleInput
from mckibben.documents.start_model import StartModel, stated_muscle
from mckibben.documents.studio import Studio
from mckibben.measurement.experiment import ExperimentValue
from mckibben.measurement.points import find_points
from mckibben.measurement.preparation import prepared_points
from mckibben.measurement.store import MeasurementStore
from mckibben.physics.errors import InputError, fields_inside
from mckibben.server.schemas.curves import CurvesRequest, InverseRequest, JointRequest
from mckibben.server.schemas.models import ModelRequest
from mckibben.simulation.statics.characteristics import Conditions


def model_question(body: ModelRequest, studio: Studio, store: MeasurementStore) -> ModelQuestion:
    """The question of a request.

    Raises:
        InputError: an unknown preset, effect, parameter or measurement, no model or data, statements that
            contradict each other, or a value that nobody stated and that cannot be assumed.
    """
    model = model_of_question(body, studio)
    named = _named(body)
    # Errors of the model are reported before those of the data.
    if named is not None and (named.preset or named.nominal_length):
        studio.static_model(model.start("", None))
    measurements = measurements_of_question(body, studio, store)
    if all(each.validation for each in measurements):
        raise InputError("no measurement to fit to", field="measurements", hint='give one the use "fit"')
    question = question_of(
        model,
        measurements,
        studio,
        free=body.free,
        freed=body.freed,
        strict=body.strict,
    )
    return with_noise(with_decisions(question, use=body.use, keep=body.keep), body.noise)


def measurements_of_question(
    body: ModelRequest, studio: Studio, store: MeasurementStore
) -> list[QuestionMeasurement]:
    """The measurements of a request with what it says about each.

    Raises:
        InputError: an unknown measurement, or a value that cannot be used.
    """
    shared = stated_experiment(body.experiment) | stated_accuracy(body.accuracy, "accuracy")
    found = []
    for place, item in enumerate(body.chosen()):
        single = body.measurement is not None and place == 0
        number = place - (body.measurement is not None)
        field = "measurement" if single else f"measurements.{number}.id"
        inside = "" if single else f"measurements.{number}"
        try:
            points = find_points(item.id, library=studio.library, store=store)
        except InputError as error:
            raise error.at(field) from error
        steps = body.prepare if item.prepare is None else item.prepare
        try:
            points = prepared_points(points, steps)
        except InputError as error:
            own_steps = item.prepare is not None and inside
            raise error.at(f"{inside}.prepare" if own_steps else "prepare") from error
        own = stated_experiment(item.experiment, f"{inside}.experiment".removeprefix("."))
        found.append(QuestionMeasurement(points, shared | own, item.use == "validation", inside or "."))
    return found


def model_of_question(body: ModelRequest, studio: Studio) -> QuestionModel:
    """Muscle, effects and drive of a request; muscle and effects replace those of the drive.

    The length of a muscle is not said where it is the default of its preset: a form sends it unasked.
    """
    muscle = _named(body)
    document = None
    if body.drive is not None:
        overrides = {"muscle": body.muscle, "effects": body.effects}
        document = body.drive.model_copy(
            update={name: value for name, value in overrides.items() if value is not None}
        )
    where = "muscle" if body.muscle is not None else "drive.muscle"

    def start(named: str, length: float | None) -> StartModel:
        if document is not None:
            return _start_of_drive(document, studio)
        chosen = muscle
        if chosen is None:
            if not named:
                raise InputError(
                    "a muscle or a drive is needed", field="muscle", hint='e.g. {"preset": "DMSP-20"}'
                )
            chosen = MuscleInput.model_validate({"preset": named.partition(":")[0]})
        if chosen.nominal_length is None and chosen.preset is None:
            chosen = chosen.model_copy(update={"nominal_length": length})
        return studio.start_model(stated_muscle(chosen), body.effects)

    return QuestionModel(
        start,
        length=None if muscle is None else _said_length(muscle, where, studio),
        muscle=None
        if muscle is None or muscle.preset is None
        else ExperimentValue(muscle.preset, "", "you", f"{where}.preset"),
        drive=document,
        keep_length="rest_length" in body.keep,
    )


def _named(body: ModelRequest) -> MuscleInput | None:
    return body.muscle or (None if body.drive is None else body.drive.muscle)


def _said_length(muscle: MuscleInput, where: str, studio: Studio) -> ExperimentValue | None:
    length = muscle.nominal_length
    if length is None:
        return None
    if muscle.preset is not None:
        default = float(studio.facts(muscle.preset).muscle.nominal_length)
        if abs(length - default) < 1e-9:
            return None
    return ExperimentValue(length, "m", "you", f"{where}.nominal_length")


def _start_of_drive(document: DriveDocument, studio: Studio) -> StartModel:
    try:
        with fields_inside("drive"):
            return drive_of(document, studio, measured=True).start
    except InputError as error:
        field = (error.field or "").removeprefix("drive.")
        raise (error.at(field) if field.startswith(("muscle", "effects")) else error) from error


def curves_question(body: CurvesRequest, studio: Studio) -> CurvesQuestion:
    """The question of a request.

    Raises:
        InputError: an unknown preset, effect or parameter, or no complete muscle.
    """
    return CurvesQuestion(
        start=studio.start_model(stated_muscle(body.muscle), body.effects),
        pressures=tuple(body.pressures),
        points=body.points,
        unclipped=body.unclipped,
        contraction_from=body.contraction_from,
        contraction_to=body.contraction_to,
        load=body.load,
        fixed_length=body.fixed_length,
        further_stiffness=body.further_stiffness,
        at_pressure=body.at_pressure,
        at_contraction=body.at_contraction,
        conditions=Conditions(
            direction=body.direction,
            temperature=body.temperature,
            dead_volume=body.dead_volume,
            polytropic_exponent=body.polytropic_exponent,
        ),
    )


def joint_question(body: JointRequest, studio: Studio) -> JointQuestion:
    """The question of a request.

    Raises:
        InputError: a joint that cannot be; ``field`` is the path in the request.
    """
    asked = {name: getattr(body, name) for name in JointQuestionInput.model_fields}
    with fields_inside("joint"):
        stated = joint_of(body.joint, studio)
    return JointQuestion(stated, read_joint_question(asked))


def inverse_question(body: InverseRequest, studio: Studio) -> InverseQuestion:
    """The question of a request.

    Raises:
        InputError: an unknown preset, effect or parameter, or no complete muscle.
    """
    return question_of_document(body, studio.start_model(stated_muscle(body.muscle), body.effects))
