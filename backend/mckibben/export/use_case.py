"""The use case: a model and a format in, files out; the doors convert."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from mckibben.application.text_file import check_ending
from mckibben.documents.studio import Studio
from mckibben.export.language import words_of
from mckibben.export.registry import ExportedFile, Format, format_named, zipped
from mckibben.export.subject import Stated, subject_of
from mckibben.physics.errors import InputError

_STEM = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]{0,99}")
_IDENTIFIER = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,59}")


@dataclass(frozen=True, slots=True)
class ExportQuestion:
    """What is to be written.

    Attributes:
        stated: the model.
        format: id of the format.
        stem: beginning of the names of the files; None = the name of the model.
    """

    stated: Stated
    format: str
    stem: str | None = None


@dataclass(frozen=True)
class Export:
    """The files of a format, the main one first."""

    files: tuple[ExportedFile, ...]
    name: str

    @property
    def file(self) -> ExportedFile:
        """The one file; several as a zip file."""
        return self.files[0] if len(self.files) == 1 else zipped(self.files, f"{self.name}.zip")


def export(question: ExportQuestion, studio: Studio) -> Export:
    """The files of a question.

    Raises:
        InputError: a model that cannot be used, an unknown format, a name that cannot be one of a file, or
            what the format cannot carry.
    """
    form = format_named(question.format)
    stem = None if question.stem is None else checked_stem(question.stem, form)
    subject = subject_of(question.stated, studio)
    if subject.runnable is None and not form.muscles:
        raise InputError(
            f"{form.title} need a drive, and this is a muscle alone: without load and valve nothing moves",
            field="as",
            hint="name a drive, or take another format",
        )
    name = subject.name if stem is None else stem
    return Export(form.write(subject, name), name)


def checked_stem(stem: str, form: Format) -> str:
    """The beginning of file names, after checking that programs can read files of that name.

    Raises:
        InputError: names what would be right.
    """
    pattern = _IDENTIFIER if form.identifier else _STEM
    if pattern.fullmatch(stem) is None:
        why = (
            f"{form.title} reads a file by its name, which must be letters, digits and underscores"
            if form.identifier
            else "letters, digits, '-', '_' and '.' are usable everywhere"
        )
        raise InputError(
            f"'{stem[:60]}' cannot be the name of the file: {why}",
            field="name",
            hint=f"e.g. {words_of(stem)}",
        )
    if stem.lower() in form.reserved:
        raise InputError(
            f"'{stem}' cannot be the name of the file: it is a word of the language or of a library of it",
            field="name",
            hint=f"e.g. {stem}_model",
        )
    return stem


def write_export(
    question: ExportQuestion,
    path: Path,
    studio: Studio,
    *,
    named: str = "",
    remark: Callable[[str], None] | None = None,
) -> list[Path]:
    """Write the files of a question.

    Args:
        question: what; its stem is that of the path.
        path: of the main file, with the ending of the format; the others stand beside it under the same
            stem. An ending ``.zip`` packs several files into one. A folder takes them under the name of the
            model.
        studio: presets.
        named: how the user named the path, "-o muscle.c"; by default the path.
        remark: is told what the user should know of the files.

    Returns:
        the files written.

    Raises:
        InputError: as `export`, or a file cannot be written.
    """
    named = named or str(path)
    if path.is_dir():
        done = _told(export(question, studio), remark)
        return [_written(path / file.name, file.content, named) for file in done.files]
    if not path.parent.is_dir():
        raise InputError(f"{named}: there is no folder {path.parent}", hint="name an existing folder")
    form, stem = format_named(question.format), path.stem
    try:
        checked_stem(stem, form)
        done = export(ExportQuestion(question.stated, question.format, stem), studio)
    except InputError as error:
        if error.field != "name":
            raise
        raise InputError(f"{named}: {error.message}", hint=error.hint) from error
    done = _told(done, remark)
    endings = list(dict.fromkeys(Path(each.name).suffix for each in done.files))
    usable = endings if form.alternatives else endings[:1]
    check_ending(path, (*usable, ".zip") if len(done.files) > 1 else usable, named=named)
    if form.alternatives:
        wanted = [each for each in done.files if Path(each.name).suffix == path.suffix.lower()]
        done = replace(done, files=tuple(wanted) or done.files)
    if len(done.files) == 1:
        return [_written(path, done.files[0].content, named)]
    if path.suffix.lower() == ".zip":
        return [_written(path, done.file.content, named)]
    return [_written(path.parent / file.name, file.content, named) for file in done.files]


def _told(done: Export, remark: Callable[[str], None] | None) -> Export:
    if remark is not None:
        for sentence in (each for file in done.files for each in file.remarks):
            remark(sentence)
    return done


def _written(path: Path, content: bytes, named: str) -> Path:
    try:
        path.write_bytes(content)
    except OSError as error:
        raise InputError(
            f"{named}: cannot be written: {error.strerror or error}", hint="name a file in an existing folder"
        ) from error
    return path
