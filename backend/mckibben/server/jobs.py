"""Work of the server, by name: from the body of a request to the bytes of the answer.

A job is prepared, which reads files and refuses what cannot be used, and then run with a watch. It knows
nothing of HTTP, so that it runs in a thread of the server or in another process alike.
"""

from __future__ import annotations

from collections.abc import Mapping

from mckibben.application.diagnose import diagnose
from mckibben.application.diagnose.kept import DiagnosisStore
from mckibben.application.json_text import to_json
from mckibben.application.linear import linearise
from mckibben.application.linear.linearise import LinearQuestion, checked, stated_condition
from mckibben.application.size import size
from mckibben.application.study import study
from mckibben.application.study.store import StudyStore
from mckibben.documents.drive_reading import drive_of, preset_document
from mckibben.documents.studio import Studio
from mckibben.documents.study import StudyDocument
from mckibben.documents.task import SizingTask
from mckibben.measurement.store import MeasurementStore
from mckibben.physics.errors import InputError, fields_inside
from mckibben.report.diagnosis import gather as diagnosis_report
from mckibben.report.sizing.gather import prepare_report
from mckibben.server.answer import answer_of
from mckibben.server.job import LONGEST, Job, Prepared
from mckibben.server.questions import model_question
from mckibben.server.schemas.drives import LinearisationRequest, LinearPointInput, SizingReportRequest
from mckibben.server.schemas.models import DiagnosisRequest, ReportRequest
from mckibben.server.short_jobs import SHORT_JOBS
from mckibben.simulation.linear.bound import SLIDING_SPEED
from mckibben.simulation.linear.point import Condition
from mckibben.simulation.linear.trials import Goals
from mckibben.simulation.outcome import Watch


def linear_question(body: LinearisationRequest, studio: Studio) -> LinearQuestion:
    """The question of a request.

    Raises:
        InputError: the drive cannot be used; its fields begin with ``drive``.
    """
    with fields_inside("drive"):
        document = body.drive if not isinstance(body.drive, str) else preset_document(body.drive, studio)
        annotated = drive_of(document, studio, measured=True)
    goals = None
    if body.design is not None:
        goals = checked(
            Goals(body.design.overshoot, body.design.settling, body.design.step, body.design.unsaturated)
        )
    return LinearQuestion(
        annotated,
        at=None if body.at is None else _condition(body.at),
        input=body.input,
        output=body.output,
        amplitudes=None if body.amplitudes is None else tuple(body.amplitudes),
        goals=goals,
        sliding_speed=SLIDING_SPEED if body.sliding_speed is None else body.sliding_speed,
    )


def _condition(at: LinearPointInput) -> Condition:
    stated = {name: value for name, value in at if value is not None}
    if len(stated) != 1:
        raise InputError(
            f"{len(stated)} values state the operating point; one does",
            field="at",
            hint='e.g. {"position": "40 mm"}',
        )
    ((kind, value),) = stated.items()
    return stated_condition(kind, value)


MOST_RUNS = 20_000  # of a study by a request: a minute of both cores, and a table that a page can hold
_STUDY_LIMIT = 900.0  # s


def _diagnosis(body: DiagnosisRequest, studio: Studio, store: MeasurementStore) -> Prepared:
    question = model_question(body, studio, store)
    work, kept = diagnose.prepare(question, studio), DiagnosisStore(store.data, quota=store.quotas.diagnoses)
    ids = [item.id for item in body.chosen()]
    name = kept.name(body.model_dump_json(), map(store.name_of, ids), studio)

    def diagnosed(watch: Watch) -> bytes:
        before = kept.answer(name)
        if before is not None:
            return before
        result = work(watch)
        answer = answer_of(result)
        if result.verdict.status != "unfinished":
            kept.keep(name, ids, answer)
        return answer

    return diagnosed


def _sizing(body: SizingTask, studio: Studio, _store: MeasurementStore) -> Prepared:
    work = size.prepare(size.sizing_question(body, studio))
    return lambda watch: to_json(work(watch))


def _sizing_report(body: SizingReportRequest, studio: Studio, _store: MeasurementStore) -> Prepared:
    work = prepare_report(body.task, studio, proposal=body.proposal, title=body.title)
    return lambda watch: work(watch).encode()


def _report(body: ReportRequest, studio: Studio, store: MeasurementStore) -> Prepared:
    question = model_question(body, studio, store)
    options = _report_options(body, studio, store)
    work = diagnosis_report.prepare(question, studio, options, diagnose=body.diagnose)
    return lambda watch: work(watch).encode()


def _report_options(
    body: ReportRequest, studio: Studio, store: MeasurementStore
) -> diagnosis_report.ReportOptions:
    history = []
    for place, step in enumerate(body.history):
        changed = {"effects": step.effects, "freed": step.freed, "muscle": step.muscle or body.muscle}
        try:
            history.append((step.label, model_question(body.model_copy(update=changed), studio, store)))
        except InputError as error:
            raise error.at(error.field or "effects").inside(f"history.{place}") from error
    unverified = {} if body.drive is None else drive_of(body.drive, studio, measured=True).unverified
    return diagnosis_report.ReportOptions(body.title, history, unverified, body.fit)


def _linear_view(body: LinearisationRequest, studio: Studio, _store: MeasurementStore) -> Prepared:
    work = linearise.prepare(linear_question(body, studio))
    return lambda watch: to_json(work(watch))


def _study(body: StudyDocument, studio: Studio, store: MeasurementStore) -> Prepared:
    question = study.study_question(body, studio, MOST_RUNS)
    work = study.prepare(question, journal=StudyStore(store.data, quota=store.quotas.studies).of(question))
    return lambda watch: to_json(work(watch))


#: The kinds of work.
JOBS: Mapping[str, Job] = {
    "diagnosis": Job(_diagnosis, diagnose.TIME_LIMIT, hint=diagnose.HINT),
    "linear view": Job(_linear_view, LONGEST, hint="ask for fewer amplitudes"),
    "report": Job(_report, diagnose.TIME_LIMIT, hint=diagnose.HINT),
    "study": Job(_study, _STUDY_LIMIT, hint="ask for fewer runs, or a shorter duration of each"),
    "sizing": Job(_sizing, size.TIME_LIMIT, hint=size.HINT),
    "sizing report": Job(_sizing_report, size.TIME_LIMIT, hint=size.HINT),
    **SHORT_JOBS,
}
