"""A diagnosis of each file of a folder: one verdict for each."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from mckibben.application.compare.question import ModelQuestion
from mckibben.application.diagnose.diagnose import prepare
from mckibben.application.diagnose.result import DiagnosisResult
from mckibben.documents.located import one_line
from mckibben.documents.studio import Studio
from mckibben.physics.errors import InputError
from mckibben.simulation.outcome import Watch

#: From the name of a file to its question; raises InputError for one that is refused.
Ask = Callable[[str], ModelQuestion]
#: From the names of files and their questions to their verdicts, in any order.
Diagnose = Callable[[Iterable[tuple[str, ModelQuestion]]], Iterator["FileVerdict"]]


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
