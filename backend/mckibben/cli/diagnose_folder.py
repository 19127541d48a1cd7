"""``mckibben diagnose FOLDER``: one verdict for each file, on this computer or on a cluster."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from mckibben.application.diagnose.folder import (
    Ask,
    FileVerdict,
    check_out,
    diagnose_each,
    diagnose_kept,
    files_of,
    fingerprint,
    finish,
    here,
)
from mckibben.application.study.file import journal_of
from mckibben.cli.options import ModelOptions
from mckibben.cli.output import progress, remark, write_json, write_summary
from mckibben.documents.studio import Studio
from mckibben.facts.comparison import error_scale
from mckibben.physics.errors import InputError
from mckibben.report.summary import Summary, Table, in_unit


@dataclass(frozen=True, slots=True)
class FolderOptions:
    """The options of ``diagnose`` for a folder: ``--out``, ``--resume``, ``--scheduler``."""

    out: Path | None = None
    resume: bool = False
    scheduler: str | None = None

    def refuse(self, files: Sequence[str]) -> None:
        """Refuse them for a diagnosis that is not of a folder.

        Raises:
            InputError: one of them is used.
        """
        used = {"--out": self.out, "--resume": self.resume or None, "--scheduler": self.scheduler}
        for option, value in used.items():
            if value is not None:
                raise InputError(f"{option} is for a folder, and {files[0]} is none", hint="name a folder")

    def check(self) -> None:
        """Check them before long work is done.

        Raises:
            InputError: the file cannot be written, or there is nothing to resume.
        """
        if self.out is not None:
            check_out(self.out, self.resume)
        elif self.resume:
            raise InputError(
                "--resume continues the table of --out, and none is named", hint="--out verdicts.csv"
            )

    @property
    def again(self) -> str:
        """How an interrupted work is continued, for people."""
        if self.out is None:
            return "start it again when the scheduler is back; with --out FILE, what is done would be kept"
        return "start it again with --resume when the scheduler is back"


def run_folder(
    files: Sequence[str],
    ask: Ask,
    studio: Studio,
    asked: tuple[ModelOptions, *tuple[object, ...]],
    options: FolderOptions,
    as_json: bool,
    writes: Mapping[str, object],
) -> None:
    """Print one verdict for each file of a folder, also of those made before the work was interrupted.

    Args:
        files: the folder.
        ask: the question of a file.
        studio: presets and effects.
        asked: the options that all files share, those of the model first.
        options: of the folder.
        as_json: JSON instead of a table.
        writes: options that write the result of one diagnosis.

    Raises:
        InputError: more than the folder is named, an option that writes the result of one diagnosis, no file
            that can be diagnosed, the scheduler is lost.
    """
    if len(files) > 1:
        raise InputError("a folder is diagnosed alone", hint="one folder, or the files of one diagnosis")
    for option, value in writes.items():
        if value is not None:
            raise InputError(
                f"{option} writes one diagnosis, and {files[0]} is a folder", hint="name one file"
            )
    options.check()
    found, out = files_of(Path(files[0])), options.out
    if out is not None:
        besides = {out.resolve(), journal_of(out).resolve()}
        found = [path for path in found if path.resolve() not in besides]
    if options.scheduler is None:
        diagnose = here(studio)
    else:
        from mckibben.application.diagnose.folder import on_cluster

        diagnose = on_cluster(studio, options.scheduler, again=options.again)
    each = partial(diagnose_each, found, ask, diagnose)
    if out is not None:
        mark = fingerprint((asked, _named(asked[0])))
        each = partial(diagnose_kept, found, ask, diagnose, out=out, asked=mark, resume=options.resume)
    order = {path.name: place for place, path in enumerate(found)}
    verdicts: list[FileVerdict] = []

    def show(*, complete: bool) -> None:
        verdicts.sort(key=lambda item: order[item.file])
        if out is not None:
            finish(verdicts, out, complete=complete)
            remark(f"table: {out}")
        if as_json:
            write_json({"files": verdicts})
        else:
            write_summary(folder_summary(files[0], verdicts))

    try:
        with progress("diagnosing the files") as watch:
            for verdict in each(watch):
                verdicts.append(verdict)
    except (InputError, KeyboardInterrupt):
        if verdicts:
            show(complete=False)
            remark(
                f"{len(verdicts)} of {len(found)} files are diagnosed; the others are missing in the table"
            )
        raise
    if all(item.refused is not None for item in verdicts):
        raise InputError(f"{files[0]}: none of its files can be diagnosed; {verdicts[0].refused}")
    show(complete=True)


def _named(model: ModelOptions) -> list[bytes]:
    """The contents of the files that the options of the model name."""
    named = [Path(name) for name in (model.muscle, model.drive, model.model) if name]
    return [path.read_bytes() for path in named if path.is_file()]


def folder_summary(folder: str, verdicts: Sequence[FileVerdict]) -> Summary:
    """One line for each file; then why files were refused."""
    rows = [
        [
            item.file,
            item.title or "refused",
            ", ".join(item.effects) or "–",
            *(_error(item, value) for value in (item.start, item.best, item.noise)),
        ]
        for item in verdicts
    ]
    columns = ["file", "verdict", "missing", "error before", "error after", "noise"]
    refused = [f"{item.file}: refused: {item.refused}" for item in verdicts if item.refused is not None]
    return [Table(f"Diagnoses of {folder}", columns, rows), *refused]


def _error(item: FileVerdict, value: float | None) -> str:
    return "–" if item.unit is None else in_unit(value, error_scale(item.unit))
