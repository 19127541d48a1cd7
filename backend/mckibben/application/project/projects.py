"""Projects with their data: a document names measurements, a project keeps their files and study tables.

What a project keeps does not depend on the folder of measurements: opening it brings the files back. As one
file (a ZIP archive) it goes to another machine, with its history.

Tables of studies are taken from the runs that are kept, and given back where they are missing. Rows hold for
a study together with the program, its presets and the files of the user. A table goes along with these named:
where they are others, it stays in the project and is not shown as a result.
"""

from __future__ import annotations

import json
import re
import zipfile
from collections.abc import Collection, Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, BinaryIO

from pydantic import ValidationError

from mckibben.application.study.store import StudyStore, environment_of, study_name
from mckibben.documents.studio import Studio
from mckibben.documents.study import StudyDocument
from mckibben.measurement.reading import Correction, read_correction
from mckibben.measurement.store import MeasurementStore, clean_name
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.projects.project import Document, Project, ProjectSummary, Revision, StoredFile, StoredStudy
from mckibben.studies.journal import checked_journal

if TYPE_CHECKING:
    from mckibben.projects.store import ProjectStore

SCHEMA = "mckibben-project/1"
_IDENTITY = re.compile(r"[0-9a-f]{64}")
_MOST_BYTES = 512_000_000  # of an unpacked project
_MOST_FILES = 1000

MOST_BYTES = 20_000_000  # of a table that goes along with a project


def measurements_in(document: Any) -> list[str]:
    """Ids of measurements that a document names, anywhere in it, in order."""
    return list(dict.fromkeys(_identities(document)))


def _identities(part: Any) -> Iterator[str]:
    if isinstance(part, str):
        if _IDENTITY.fullmatch(part):
            yield part
    elif isinstance(part, Mapping):
        for key, value in part.items():
            yield from _identities(key)
            yield from _identities(value)
    elif isinstance(part, list | tuple):
        for value in part:
            yield from _identities(value)


def texts_in(document: Any) -> set[str]:
    """All texts of a document that may be ids of measurements or presets."""
    found: set[str] = set()
    waiting = [document]
    while waiting:
        part = waiting.pop()
        if isinstance(part, str):
            if len(part) <= 64:
                found.add(part)
        elif isinstance(part, Mapping):
            waiting += [*part.keys(), *part.values()]
        elif isinstance(part, list | tuple):
            waiting += part
    return found


def files_of(
    document: Document, measurements: MeasurementStore, known: Collection[str] = ()
) -> Iterator[StoredFile]:
    """The stored files of the measurements that a document names, one after the other, without known ones."""
    for identity in measurements_in(document):
        if identity not in known and (original := measurements.original(identity)) is not None:
            yield StoredFile(identity, *original)


def restore_files(projects: ProjectStore, project: Project, measurements: MeasurementStore) -> Project:
    """The project, the files of its measurements stored again where they are missing."""
    missing = missing_files(project, measurements)
    if missing:
        for file in projects.files(project.summary.id):
            if file.measurement in missing:
                _store(file, measurements)
    return project


def missing_files(project: Project, measurements: MeasurementStore) -> list[str]:
    """Ids of the measurements of a project of which no file is stored."""
    return [each for each in project.measurements if not measurements.has(each)]


def _store(file: StoredFile, measurements: MeasurementStore) -> str:
    correction = Correction() if file.mapping is None else read_correction(file.mapping)
    return measurements.put(file.content, file.name, correction).id


class _Counted:
    """The parts of a packed project; what is written of them is counted, however often one is named."""

    def __init__(self, parts: Mapping[str, bytes]) -> None:
        self._parts, self._left = parts, _MOST_BYTES
        self._entries = 0

    @property
    def size(self) -> int:
        """What is written of them so far [bytes]."""
        return _MOST_BYTES - self._left

    def content(self, name: str) -> bytes:
        """A part that is written as it is."""
        return self._count(self._parts[name], len(self._parts[name]))

    def document(self, name: str) -> Document:
        """A document; it may be longer when it is written than it was in the file."""
        document = _document(self._parts[name], name)
        return self._count(document, len(json.dumps(document, ensure_ascii=False)))

    def _count(self, part: Any, size: int) -> Any:
        self._entries, self._left = self._entries + 1, self._left - size
        if self._left < 0 or self._entries > _MOST_FILES:
            raise _too_large()
        return part


def _too_large() -> InputError:
    return InputError(
        "the packed project is too large",
        hint=f"at most {_MOST_FILES} files and {_MOST_BYTES // 1_000_000} MB unpacked, "
        "each as often as it is named",
    )


def packed(projects: ProjectStore, identity: str, into: BinaryIO) -> str:
    """Write a project as one file, a ZIP archive of documents, history, measurements, studies; its name.

    Its measurements are in memory one after the other.
    """
    project = projects.open(identity)
    history, studies = projects.history(identity), projects.studies(identity)
    names: list[dict[str, Any]] = []
    about = {
        "schema": SCHEMA,
        "title": project.summary.title,
        "notes": project.summary.notes,
        "history": [
            {
                "version": each.version,
                "saved": each.saved,
                "label": each.label,
                "automatic": each.automatic,
                "file": f"history/{each.version}.json",
            }
            for each in history
        ],
        "files": names,
        "studies": [
            {"environment": study.environment, "runs": study.runs, "file": f"studies/{number}.jsonl"}
            for number, study in enumerate(studies, 1)
        ],
    }
    with zipfile.ZipFile(into, "w", zipfile.ZIP_DEFLATED) as archive:
        for each in history:
            document = projects.open(identity, each.version).document
            archive.writestr(f"history/{each.version}.json", json.dumps(document, ensure_ascii=False))
        for number, file in enumerate(projects.files(identity), 1):
            name = f"measurements/{number}-{_plain(file.name)}"
            archive.writestr(name, file.content)
            names.append(
                {"measurement": file.measurement, "name": file.name, "mapping": file.mapping, "file": name}
            )
        for entry, study in zip(about["studies"], studies, strict=True):
            archive.writestr(str(entry["file"]), study.content)
        archive.writestr("project.json", json.dumps(about, ensure_ascii=False, indent=1))
    return f"{_plain(project.summary.title)}.mckibben.zip"


def _plain(name: str) -> str:
    """A name for a file on any system."""
    return re.sub(r"[^A-Za-z0-9._-]+", "-", clean_name(name)).strip(".-")[:80] or "project"


def unpacked(source: BinaryIO, projects: ProjectStore, measurements: MeasurementStore) -> Project:
    """A packed project as a new one; its measurements are stored.

    Raises:
        InputError: it is not a packed project, or a part is missing, damaged or too large; code ``no_space``,
            what it would write has no room, and nothing was written.
    """
    try:
        with zipfile.ZipFile(source) as archive:
            about, parts = _parts(archive)
    except (zipfile.BadZipFile, NotImplementedError, RuntimeError, EOFError, OSError) as error:
        raise InputError(
            f"the file is not a packed project: {error}", hint="choose a file that 'Export project' wrote"
        ) from error
    counted = _Counted(parts)
    try:
        history = [
            (
                Revision(int(e["version"]), float(e["saved"]), str(e["label"]), bool(e["automatic"])),
                counted.document(str(e["file"])),
            )
            for e in about["history"]
        ]
        files = [
            StoredFile(
                str(e["measurement"]), clean_name(str(e["name"])), counted.content(str(e["file"])),
                None if e["mapping"] is None else str(e["mapping"]),
            )
            for e in about["files"]
        ]  # fmt: skip
        # Files of earlier versions have no studies.
        studies = [
            study_from(str(e["environment"]), counted.content(str(e["file"])))
            for e in about.get("studies", [])
        ]
        title, notes = str(about["title"]), str(about["notes"])
    except InputError:
        raise
    except (KeyError, TypeError, ValueError, OverflowError) as error:
        raise InputError(
            f"the packed project is damaged: {error}", hint="export it once more from where it came from"
        ) from error
    projects.check_room(counted.size)
    with measurements.all_or_none():
        for file in files:
            if _store(file, measurements) != file.measurement:
                raise InputError(
                    f"the measurement {file.name} in the packed project was changed", field="files"
                )
        return projects.revive(history, title=title, notes=notes, files=files, studies=studies)


def _parts(archive: zipfile.ZipFile) -> tuple[Any, dict[str, bytes]]:
    entries = archive.infolist()
    if len(entries) > _MOST_FILES or sum(entry.file_size for entry in entries) > _MOST_BYTES:
        raise _too_large()
    if "project.json" not in archive.namelist():
        raise InputError("the archive has no project.json", hint="choose a file that 'Export project' wrote")
    parts, left = {}, _MOST_BYTES
    for entry in entries:
        with archive.open(entry) as stream:
            parts[entry.filename] = stream.read(left + 1)  # the stated size may be wrong
        left -= len(parts[entry.filename])
        if left < 0:
            raise _too_large()
    about = _document(parts["project.json"], "project.json")
    if about.get("schema") != SCHEMA:
        raise InputError(
            f"the packed project is of the kind {str(about.get('schema'))[:40]!r}", hint=f"known: {SCHEMA}"
        )
    return about, parts


def _document(content: bytes, name: str) -> dict[str, Any]:
    try:
        document = json.loads(content)
    except (ValueError, RecursionError) as error:
        raise InputError(f"{name} in the packed project is not JSON: {error}", field=name) from error
    if not isinstance(document, dict):
        raise InputError(f"{name} in the packed project is not a document", field=name)
    return document


def found_project(projects: ProjectStore, name: str, *, deleted: bool = False) -> ProjectSummary:
    """The project of a title, an id or the first characters of an id.

    Raises:
        InputError: there is none, or there are several.
    """
    every = projects.list(deleted=deleted)
    found = [each for each in every if name in (each.id, each.title)]
    if not found and len(name) >= 4:
        found = [each for each in every if each.id.startswith(name)]
    if len(found) == 1:
        return found[0]
    if found:
        ids = ", ".join(each.id[:8] for each in found[:5])
        raise InputError(
            f"{len(found)} projects are called '{name}'", field="project", hint=f"say which: {ids}"
        )
    place = "in the bin" if deleted else f"in {projects.place}"
    raise InputError(
        f"there is no project '{name}' {place}",
        field="project",
        hint=did_you_mean(name, [each.title for each in every]) or "list them with 'mckibben project list'",
        code="not_found",
    )


def table_of(
    study: Mapping[str, Any] | None, kept: StudyStore, studio: Studio
) -> tuple[list[StoredStudy], list[str]]:
    """The kept rows of a study document, to be stored with a project, and what there is to say about them.

    A study that cannot be used has no rows: it must not keep a project from being saved.
    """
    if study is None:
        return [], []
    try:
        found = kept.stored(StudyDocument.model_validate(study), studio)
    except (ValidationError, InputError):
        return [], []
    if found is None:
        return [], []
    if len(found.content) > MOST_BYTES:
        words = (
            f"The table of the study ({found.runs} runs, {len(found.content) / 1e6:.0f} MB) is not kept with "
            f"the project, which takes tables up to {MOST_BYTES / 1e6:.0f} MB: save it as CSV or Parquet."
        )
        return [], [words]
    return [found], []


def give_back(studies: Iterable[StoredStudy], kept: StudyStore, studio: Studio) -> list[str]:
    """Keep the tables of a project here again, as far as they hold; what there is to say of the others."""
    here, foreign = environment_of(studio), 0
    for study in studies:
        if study.environment == here:
            kept.bring(study)
        else:
            foreign += 1
    if not foreign:
        return []
    what = (
        "A study table of this project is" if foreign == 1 else f"{foreign} study tables of this project are"
    )
    return [
        f"{what} from another version of the program, or from other presets or terms of your own; not shown "
        "here, but still in the project. Run the study again for results of this version."
    ]


def study_from(environment: str, content: bytes) -> StoredStudy:
    """The study table of a packed project.

    Raises:
        ValueError: it is damaged or too large.
    """
    if len(content) > MOST_BYTES:
        raise ValueError(f"a study table of more than {MOST_BYTES / 1e6:.0f} MB")
    if len(environment) != 64:
        raise ValueError("a study table without its origin")
    fingerprint, runs = checked_journal(content)
    return StoredStudy(study_name(fingerprint, environment), environment, runs, content)
