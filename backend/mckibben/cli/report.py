"""``--report``: a diagnosis or a sizing as an HTML file."""

from __future__ import annotations

from pathlib import Path

from mckibben.application.compare.question import ModelQuestion
from mckibben.application.diagnose.result import DiagnosisResult
from mckibben.cli.output import write_file
from mckibben.documents.studio import Studio
from mckibben.report.diagnosis.gather import ReportOptions, report_of


def write(path: Path, studio: Studio, question: ModelQuestion, diagnosis: DiagnosisResult) -> None:
    """Write the report of a diagnosis.

    Raises:
        InputError: the file cannot be written.
    """
    save(path, report_of(question, studio, ReportOptions(), diagnosis))


def save(path: Path, text: str) -> None:
    """Write a finished report, and print its path.

    Raises:
        InputError: the file cannot be written.
    """
    write_file(path, "--report", "report", text)
