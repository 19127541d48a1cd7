"""``mckibben study``: many runs with varied quantities."""

from __future__ import annotations

from pathlib import Path

from mckibben.application.study.file import check_out, journal_of, prepare_file
from mckibben.application.study.study import prepare, study_question
from mckibben.cli.output import progress, remark, write_json, write_summary
from mckibben.documents.studio import Studio
from mckibben.documents.study import in_file, read_study_file
from mckibben.physics.errors import InputError
from mckibben.report.summary.study import notices, summary_of
from mckibben.simulation.outcome import Outcome


def run(
    studio: Studio,
    *,
    study: str,
    out: Path | None,
    resume: bool,
    scheduler: str | None,
    chunk: int | None,
    as_json: bool,
) -> None:
    """Run the study; print its summary or the JSON answer, write its table if requested.

    Raises:
        InputError: names the file, the field, what is wrong and what would be right.
    """
    if resume and out is None:
        raise InputError("--resume continues the table of --out, and none is named", hint="--out table.csv")
    document = read_study_file(Path(study))
    if out is not None:
        check_out(out, resume)
    try:
        question = study_question(document, studio)
    except InputError as error:
        raise in_file(study, error) from error
    workers = None
    if scheduler is not None:
        from mckibben.application.study.cluster import on_cluster

        workers = on_cluster(question, scheduler)
    if out is None:
        work = prepare(question, workers=workers, chunk=chunk)
    else:
        work = prepare_file(question, out, resume=resume, workers=workers, chunk=chunk)
    try:
        with progress("running the study") as watch:
            result = work(watch)
    except KeyboardInterrupt:
        if out is not None:
            remark(f"stopped; the runs made so far are in {journal_of(out)}: --resume continues")
        raise
    if out is not None:
        remark(f"table: {out}")
        if result.outcome != Outcome.COMPLETED.label:
            remark(f"the study is not complete: --resume continues it from {journal_of(out)}")
    if not as_json:
        write_summary(summary_of(result, Path(study).name))
        return
    write_json(result)
    for sentence in notices(result):
        remark(sentence)
