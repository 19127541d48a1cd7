"""``mckibben simulate``: transient simulation of a drive."""

from __future__ import annotations

from pathlib import Path

from mckibben.application.run.drive_run import single_run_engine
from mckibben.application.run.simulate import SimulationQuestion, simulate, trace_text
from mckibben.application.text_file import write_text
from mckibben.cli.output import remark, write_json, write_summary
from mckibben.documents.drive_reading import drive_of, named_document
from mckibben.documents.located import located
from mckibben.documents.studio import Studio
from mckibben.physics.errors import InputError
from mckibben.report.summary.simulation import notices, summary_of


def run(studio: Studio, *, drive: str, out: Path | None, as_json: bool) -> None:
    """Run the drive, print the timing table or the answer, write the trace.

    Raises:
        InputError: names the file, the field, what is wrong and what would be right.
    """
    document = named_document(drive, studio)
    try:
        annotated = drive_of(document, studio)
        result = simulate(SimulationQuestion(annotated, engine=single_run_engine(annotated)))
    except InputError as error:
        raise InputError(f"{drive}: {located(error.field, error.message)}", hint=error.hint) from error
    if out is not None:
        write_text(out, trace_text(document, result), named=f"--out {out}")
    if not as_json:
        write_summary(summary_of(result, drive))
        return
    write_json(result)
    for sentence in notices(result):
        remark(sentence)
