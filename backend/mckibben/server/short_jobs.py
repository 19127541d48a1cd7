"""Short work that does not stay in the server: files that are read, models with what the user typed.

A file or a typed term may keep native code busy that nothing in the same process can end.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from mckibben.application.compare.compare import compare
from mckibben.application.curves.curves import curves
from mckibben.application.curves.inverse import answer
from mckibben.application.joint.joint import joint_statics
from mckibben.application.json_text import to_json
from mckibben.application.measurement.form import experiment_forms, preview_form
from mckibben.application.measurement.summary import details_of, preview_of, summary_of
from mckibben.application.model.saved import present_model
from mckibben.application.project.projects import restore_files, unpacked
from mckibben.application.run import simulate
from mckibben.documents.studio import Studio
from mckibben.export.use_case import export
from mckibben.measurement.preparation import prepared
from mckibben.measurement.reading import Correction, preview
from mckibben.measurement.reading.limits import MOST_SECONDS
from mckibben.measurement.reading.process import PATIENCE
from mckibben.measurement.store import MeasurementStore, clean_name
from mckibben.physics.errors import InputError, fields_inside
from mckibben.server.answer import answer_of
from mckibben.server.job import LONGEST, Job, Prepared
from mckibben.server.questions import (
    curves_question,
    inverse_question,
    joint_question,
    measurements_of_question,
    model_question,
)
from mckibben.server.schemas.curves import CurvesRequest, InverseRequest, JointRequest
from mckibben.server.schemas.drives import SimulationRequest
from mckibben.server.schemas.exports import ExportRequest
from mckibben.server.schemas.models import ComparisonRequest, DiagnosisRequest
from mckibben.server.schemas.presets import FittedMuscleRequest
from mckibben.simulation.outcome import Watch

if TYPE_CHECKING:
    from mckibben.projects.store import ProjectStore
from dataclasses import replace

from mckibben.application.run.simulate import SimulationQuestion
from mckibben.documents.drive_reading import drive_of, preset_document
from mckibben.documents.start_model import stated_muscle
from mckibben.export.source import of_drive, of_saved, stated_source
from mckibben.export.subject import Stated
from mckibben.export.use_case import ExportQuestion


def simulation_question(body: SimulationRequest, studio: Studio) -> SimulationQuestion:
    """The question of a request.

    Raises:
        InputError: the drive cannot be used; fields begin with ``drive``.
    """
    with fields_inside("drive"):
        document = body.drive if not isinstance(body.drive, str) else preset_document(body.drive, studio)
        annotated = drive_of(document, studio)
    return SimulationQuestion(
        annotated, points=body.points, begin=body.begin, end=body.end, static=body.static
    )


def export_question(body: ExportRequest, studio: Studio) -> ExportQuestion:
    """The question of a request.

    Raises:
        InputError: not exactly one of muscle, model and drive, or one that cannot be used.
    """
    subjects = [name for name in ("muscle", "model", "drive") if getattr(body, name) is not None]
    if len(subjects) != 1:
        what = "nothing to take along" if not subjects else f"{' and '.join(subjects)} at once"
        raise InputError(
            what, field=subjects[1] if subjects else "muscle", hint="give muscle, model or drive"
        )
    if body.effects is not None and body.muscle is None:
        raise InputError(f"the {subjects[0]} has its own effects", field="effects", hint="leave it out")
    stated = _stated(body, studio)
    if body.title:
        stated = replace(stated, title=body.title)
    return ExportQuestion(stated, body.format_id, body.name)


def _stated(body: ExportRequest, studio: Studio) -> Stated:
    if body.muscle is not None:
        return Stated(studio.start_model(stated_muscle(body.muscle), body.effects))
    if body.model is not None:
        with fields_inside("model"):
            return of_saved(body.model, studio, "")
    assert body.drive is not None  # noqa: S101 - one of the three is given
    with fields_inside("drive"):
        if isinstance(body.drive, str):
            if body.drive not in {preset.id for preset in studio.library.list("drives")}:
                studio.library.get("drives", body.drive)  # raises with the nearest match
            return stated_source(body.drive, studio)
        return of_drive(body.drive, studio, "")


#: s; the process that reads a file ends sooner, at the processor time that its size allows.
_READ_WITHIN = float(PATIENCE * MOST_SECONDS)
_COMPARE_WITHIN = 120.0  # s
_COMPUTE_WITHIN = 20.0  # s
_COMPILE_WITHIN = 1800.0  # s; the first FMU of a machine compiles the libraries of three systems
_SMALLER = "split the file, or keep every second row"
_FEWER = "give fewer rows of the measurement, or compare with fewer effects"
_SMALLER_PROJECT = "import a project with smaller files"
_SIMPLER = "use fewer factors and functions in the term"


@dataclass(frozen=True, slots=True)
class FileRequest:
    """A file and what the user says of it.

    Attributes:
        path: where its bytes are, as long as the request lasts.
        name: for people.
        correction: of how it is read.
        muscle: id of the preset that is chosen, None without one; for the questions of a preview.
    """

    path: Path
    name: str
    correction: Correction
    muscle: str | None = None


@dataclass(frozen=True, slots=True)
class FilesOfProject:
    """A project whose measurements are to be stored again where they are missing.

    Attributes:
        project: its id.
        version: of its document, None = the last one.
        database: of the projects: an address, or the folder of an SQLite file.
    """

    project: str
    version: int | None
    database: str | Path


@dataclass(frozen=True, slots=True)
class PackedProject:
    """A project of another machine.

    Attributes:
        path: where its file is, as long as the request lasts.
        database: of the projects: an address, or the folder of an SQLite file.
    """

    path: Path
    database: str | Path


def _upload(body: FileRequest, _studio: Studio, store: MeasurementStore) -> Prepared:
    return lambda _: answer_of(summary_of(store.put(body.path.read_bytes(), body.name, body.correction)))


def _preview(body: FileRequest, studio: Studio, _store: MeasurementStore) -> Prepared:
    def read(_: Watch) -> bytes:
        found = preview(body.path.read_bytes(), clean_name(body.name), body.correction)
        return answer_of(preview_of(found, preview_form(found, studio, body.muscle)))

    return read


@dataclass(frozen=True, slots=True)
class StoredMeasurement:
    """A stored measurement, and the steps that prepare it."""

    id: str
    prepare: tuple[str, ...] = ()


def _details(body: StoredMeasurement, _studio: Studio, store: MeasurementStore) -> Prepared:
    return lambda _: answer_of(details_of(prepared(store.get(body.id), body.prepare)))


def _comparison(body: ComparisonRequest, studio: Studio, store: MeasurementStore) -> Prepared:
    return lambda _: answer_of(
        compare(
            model_question(body, studio, store),
            fit=body.fit,
            within=body.within,
            explain=body.explain,
            ties=body.ties,
            judge=body.judge,
        )
    )


def _experiments(body: DiagnosisRequest, studio: Studio, store: MeasurementStore) -> Prepared:
    measurements = measurements_of_question(body, studio, store)
    ids = [item.id for item in body.chosen()]
    pairs = list(zip(ids, measurements, strict=True))
    return lambda _: answer_of(experiment_forms(pairs, lambda: model_question(body, studio, store), studio))


def _fitted_model(body: FittedMuscleRequest, studio: Studio, store: MeasurementStore) -> Prepared:
    return lambda _: to_json(present_model(model_question(body, studio, store), studio).to_document())


def _project_import(body: PackedProject, _studio: Studio, store: MeasurementStore) -> Prepared:
    projects = _projects(body.database, store)

    def unpack(_: Watch) -> bytes:
        with body.path.open("rb") as source:
            return to_json({"id": unpacked(source, projects, store).summary.id})

    return unpack


def _project_files(body: FilesOfProject, _studio: Studio, store: MeasurementStore) -> Prepared:
    projects = _projects(body.database, store)

    def bring_back(_: Watch) -> bytes:
        restore_files(projects, projects.open(body.project, body.version), store)
        return b"{}"

    return bring_back


def _projects(database: str | Path, store: MeasurementStore) -> ProjectStore:
    # Imported here: the database of the projects is nothing that the other files need.
    from mckibben.projects.database import Database
    from mckibben.projects.store import ProjectStore

    return ProjectStore(Database(database), quota=store.quotas.projects)


def _curves(body: CurvesRequest, studio: Studio, _store: MeasurementStore) -> Prepared:
    return lambda _: to_json(curves(curves_question(body, studio), studio))


def _inverse(body: InverseRequest, studio: Studio, _store: MeasurementStore) -> Prepared:
    return lambda _: to_json(answer(inverse_question(body, studio), studio))


def _joint(body: JointRequest, studio: Studio, _store: MeasurementStore) -> Prepared:
    return lambda _: to_json(joint_statics(joint_question(body, studio)))


def _simulation(body: SimulationRequest, studio: Studio, _store: MeasurementStore) -> Prepared:
    run = simulate.prepare(simulation_question(body, studio))

    def work(watch: Watch) -> bytes:
        with fields_inside("drive"):
            return to_json(run(watch))

    return work


# The first line of the answer is about the file, the rest is its content.
def _export(body: ExportRequest, studio: Studio, _store: MeasurementStore) -> Prepared:
    question = export_question(body, studio)
    inside = "drive" if body.drive is not None else "model" if body.model is not None else None

    def write(_: Watch) -> bytes:
        try:
            file = export(question, studio).file
            return to_json({"name": file.name, "media_type": file.media_type}) + b"\n" + file.content
        except InputError as error:
            if inside is not None and error.field not in ("as", "name"):
                raise error.inside(inside) from error
            raise

    return write


SHORT_JOBS: Mapping[str, Job] = {
    "file upload": Job(_upload, _READ_WITHIN, "files", hint=_SMALLER),
    "preview": Job(_preview, _READ_WITHIN, "files", hint=_SMALLER),
    "project import": Job(_project_import, _READ_WITHIN, "files", looks=False, hint=_SMALLER_PROJECT),
    "project files": Job(_project_files, _READ_WITHIN, "files", looks=False, hint=_SMALLER),
    "measurement": Job(_details, _READ_WITHIN, "files", hint=_SMALLER),
    "comparison": Job(_comparison, _COMPARE_WITHIN, "models", looks=False, hint=_FEWER),
    "experiment form": Job(_experiments, _READ_WITHIN, "models", looks=False, hint=_SMALLER),
    "fitted model": Job(_fitted_model, _COMPARE_WITHIN, "models", looks=False, hint=_FEWER),
    "computation of curves": Job(_curves, _COMPUTE_WITHIN, "models", looks=False, hint=_SIMPLER),
    "inverse question": Job(_inverse, _COMPUTE_WITHIN, "models", looks=False, hint=_SIMPLER),
    "joint": Job(_joint, _COMPUTE_WITHIN, "models", looks=False, hint=_SIMPLER),
    "simulation": Job(_simulation, LONGEST, lane="models", hint=_SIMPLER),
    "export": Job(_export, _COMPARE_WITHIN, "models", looks=False, hint=_SIMPLER),
    "compiled export": Job(_export, _COMPILE_WITHIN, looks=False, hint="take the C sources"),
}
