"""A diagnosis of each file of a folder: one verdict for each."""

from __future__ import annotations

import csv
import hashlib
import io
import os
import pickle
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import asdict, dataclass, fields
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import Any

from mckibben.application.cluster import Cluster, KilledError, check_version
from mckibben.application.compare.question import ModelQuestion
from mckibben.application.diagnose.diagnose import prepare
from mckibben.application.diagnose.result import DiagnosisResult
from mckibben.application.json_text import answer_json
from mckibben.application.study.file import journal_of
from mckibben.application.text_file import check_ending
from mckibben.documents.located import one_line
from mckibben.documents.studio import Studio
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError
from mckibben.simulation.outcome import Watch
from mckibben.studies.journal import JournalFile, damaged
from mckibben.version import __version__

#: From the name of a file to its question; raises InputError for one that is refused.
Ask = Callable[[str], ModelQuestion]
#: From the names of files and their questions to their verdicts, in any order.
Diagnose = Callable[[Iterable[tuple[str, ModelQuestion]]], Iterator["FileVerdict"]]

ENDINGS = (".csv", ".json")

_NO_OWN = "a diagnosis on a cluster cannot use effects of your own"


@dataclass(frozen=True, slots=True)
class FileVerdict:
    """What a diagnosis of one file found; figures in SI.

    All but ``file`` and ``refused`` are None, or empty, if it was refused.

    Attributes:
        file: its name.
        status, title: of the verdict.
        effects: the missing effects; empty if none is.
        predicted, unit: channel of the errors and its SI unit.
        start, best: RMS error of the start model, and of the best one.
        noise: of the data; None where it cannot be estimated.
        sentence: the verdict in one to four sentences.
        refused: why the file could not be diagnosed; None if it was.
    """

    file: str
    status: str | None = None
    title: str | None = None
    effects: Sequence[str] = ()
    predicted: str | None = None
    unit: str | None = None
    start: float | None = None
    best: float | None = None
    noise: float | None = None
    sentence: str | None = None
    refused: str | None = None


def files_of(folder: Path) -> list[Path]:
    """The files of a folder by name, without hidden ones and those of its folders.

    Raises:
        InputError: there are none, or the folder cannot be read.
    """
    try:
        found = sorted(path for path in folder.iterdir() if path.is_file() and not path.name.startswith("."))
    except OSError as error:
        raise InputError(f"{folder}: cannot be read: {error.strerror}") from error
    if not found:
        raise InputError(f"{folder}: there is no file in it", hint="name a folder with measurements")
    return found


def here(studio: Studio) -> Diagnose:
    """Diagnoses by this process, one after the other."""

    def work(questions: Iterable[tuple[str, ModelQuestion]]) -> Iterator[FileVerdict]:
        for file, question in questions:
            yield diagnosed(file, question, studio)

    return work


def diagnosed(file: str, question: ModelQuestion, studio: Studio) -> FileVerdict:
    """The verdict on a file; also that it is refused."""
    try:
        return verdict_on(file, prepare(question, studio)(Watch()))
    except InputError as error:
        return FileVerdict(file, refused=one_line(error))


def diagnose_each(
    files: Sequence[Path], ask: Ask, diagnose: Diagnose, watch: Watch, *, before: int = 0
) -> Iterator[FileVerdict]:
    """One verdict for each file, in the order in which they end; a refused file does not end the others.

    Args:
        files: what is diagnosed.
        ask, diagnose: how the question of a file is made, and who answers it.
        watch: is told the share that is done.
        before: number of further files that were diagnosed before.
    """
    refused: deque[FileVerdict] = deque()
    done = before

    def questions() -> Iterator[tuple[str, ModelQuestion]]:
        for path in files:
            try:
                question = ask(str(path))
            except InputError as error:
                refused.append(FileVerdict(path.name, refused=one_line(error)))
            else:
                yield path.name, question

    def all_of_them() -> Iterator[FileVerdict]:
        for verdict in diagnose(questions()):
            while refused:
                yield refused.popleft()
            yield verdict
        yield from refused

    for verdict in all_of_them():
        yield verdict
        done += 1
        if watch.progress is not None:
            watch.progress(done / (before + len(files)))


def verdict_on(file: str, result: DiagnosisResult) -> FileVerdict:
    """The row of a diagnosis."""
    return FileVerdict(
        file,
        result.verdict.status,
        result.verdict.title,
        result.verdict.effects,
        result.predicted,
        result.unit,
        result.path[0].rmse,
        result.path[-1].rmse,
        result.noise_floor.rmse,
        result.verdict.sentence,
    )


def check_out(out: Path, resume: bool) -> None:
    """Check that verdicts can be written there, before long work is done for them.

    Raises:
        InputError: an unknown ending, no such folder, nothing to resume.
    """
    check_ending(out, ENDINGS, named=f"--out {out}")
    if out.is_dir() or not out.parent.is_dir():
        what = "is a folder" if out.is_dir() else f"there is no folder {out.parent}"
        raise InputError(f"--out {out}: {what}", hint="name a file in an existing folder")
    if resume and out.exists() and not journal_of(out).exists():
        raise InputError(f"--out {out}: is complete, there is nothing to resume", hint="omit --resume")


def fingerprint(asked: object) -> str:
    """Of what is asked about every file: options and the files that they name."""
    return hashlib.sha256(f"{__version__}\n{asked!r}".encode()).hexdigest()


def diagnose_kept(
    files: Sequence[Path],
    ask: Ask,
    diagnose: Diagnose,
    watch: Watch,
    *,
    out: Path,
    asked: str,
    resume: bool,
) -> Iterator[FileVerdict]:
    """As `diagnose_each`; verdicts are kept in a journal beside ``out``, and not made again from there.

    A file whose content has changed since is diagnosed again. The journal stays: `finish` ends it.

    Args:
        files, ask, diagnose, watch: as there.
        out: where the table of verdicts will be.
        asked: the `fingerprint` of the options.
        resume: continue the journal that is there.

    Raises:
        InputError: the journal belongs to other options, or cannot be written.
    """
    contents = {path.name: _digest(path) for path in files}
    with JournalFile(journal_of(out), "diagnosis", asked, resume=resume) as journal:
        known: dict[str, FileVerdict] = {}
        for number, entry in enumerate(journal.entries, start=2):
            verdict, content = _read(entry, journal.path, number)
            if contents.get(verdict.file) == content:
                known[verdict.file] = verdict
        yield from known.values()
        left = [path for path in files if path.name not in known]
        for verdict in diagnose_each(left, ask, diagnose, watch, before=len(known)):
            journal.add({"verdict": asdict(verdict), "content": contents[verdict.file]})
            yield verdict


def _digest(path: Path) -> str:
    try:
        return hashlib.sha256(path.read_bytes()).hexdigest()
    except OSError:
        return ""  # told when it is read as a measurement


def _read(entry: Any, path: Path, number: int) -> tuple[FileVerdict, str]:
    try:
        return FileVerdict(**entry["verdict"]), entry["content"]
    except (KeyError, TypeError) as error:
        raise damaged(path, number) from error


def finish(verdicts: Sequence[FileVerdict], out: Path, *, complete: bool) -> None:
    """Write the table of verdicts, SI; an existing file is replaced when all is written.

    Args:
        verdicts: in the order of the table.
        out: .csv or .json.
        complete: nothing is missing; the journal is removed.

    Raises:
        InputError: it cannot be written.
    """
    part = out.with_name(f"{out.name}.part")
    try:
        if out.suffix.lower() == ".csv":
            part.write_text(verdicts_text(verdicts), encoding="utf-8", newline="\n")
        else:
            part.write_bytes(answer_json({"files": verdicts}) + b"\n")
        os.replace(part, out)
    except OSError as error:
        raise InputError(f"--out {out}: cannot be written: {error.strerror or error}") from error
    if complete:
        journal_of(out).unlink(missing_ok=True)


def verdicts_text(verdicts: Sequence[FileVerdict]) -> str:
    """The table as CSV, SI; effects are separated by spaces, nothing where a figure is missing."""
    names = [field.name for field in fields(FileVerdict)]
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(names)
    for verdict in verdicts:
        row = asdict(verdict) | {"effects": " ".join(verdict.effects)}
        writer.writerow([row[name] for name in names])
    return text.getvalue()


def on_cluster(studio: Studio, address: str, *, again: str) -> Diagnose:
    """Diagnoses by the workers of the cluster with this scheduler.

    This process reads the files; a worker gets the question of one with its data, and answers with its
    verdict. A file that ends several workers is refused, the others go on.

    Args:
        studio: its effects must come with the program, because a worker has no others.
        address: of the scheduler, "tcp://host:8786".
        again: how the diagnoses are continued when the scheduler was lost, for people.

    Raises:
        InputError: Dask is not installed, effects of the user, no scheduler at the address.
    """
    if studio.catalogue is not default_catalogue():
        raise InputError(_NO_OWN, hint="omit --effects, or --scheduler")
    cluster = Cluster(address, again=again)

    def work(questions: Iterable[tuple[str, ModelQuestion]]) -> Iterator[FileVerdict]:
        calls = ((file, (file, packed(question), __version__)) for file, question in questions)
        for file, verdict in cluster.each(make_verdict, calls):
            try:
                yield verdict()
            except KilledError as error:
                yield FileVerdict(file, refused=one_line(error))

    return work


def make_verdict(file: str, question: bytes, version: str) -> FileVerdict:
    """The verdict of a file on a worker.

    Raises:
        InputError: the worker has another version of the program.
    """
    check_version(version)
    return diagnosed(file, unpacked(question), _studio())


@cache
def _studio() -> Studio:
    from mckibben.resources import presets_folder

    return Studio(presets=presets_folder())


def packed(question: ModelQuestion) -> bytes:
    """A question as bytes; effects of the program go by their names, so that they are the worker's own.

    Raises:
        InputError: it holds a term or an effect of the user.
    """
    stream = io.BytesIO()
    try:
        _Pickler(stream, protocol=pickle.HIGHEST_PROTOCOL).dump(question)
    except (pickle.PicklingError, AttributeError, TypeError) as error:
        raise InputError(_NO_OWN, hint="diagnose it without --scheduler") from error
    return stream.getvalue()


def unpacked(content: bytes) -> ModelQuestion:
    """The question again."""
    return _Unpickler(io.BytesIO(content)).load()


class _Pickler(pickle.Pickler):
    def persistent_id(self, obj: Any) -> tuple[str, str] | None:
        if obj is default_catalogue():
            return "catalogue", ""
        if isinstance(obj, Effect) and default_catalogue().get(obj.id) is obj:
            return "effect", obj.id
        return None

    def reducer_override(self, obj: Any) -> Any:
        return (_frozen, (dict(obj),)) if isinstance(obj, MappingProxyType) else NotImplemented


class _Unpickler(pickle.Unpickler):
    def persistent_load(self, pid: tuple[str, str]) -> Any:
        kind, name = pid
        return default_catalogue() if kind == "catalogue" else default_catalogue()[name]


def _frozen(content: dict[Any, Any]) -> MappingProxyType[Any, Any]:
    return MappingProxyType(content)
