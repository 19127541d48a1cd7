"""Summary of the diagnoses of a folder."""

from __future__ import annotations

from collections.abc import Sequence

from mckibben.application.diagnose.folder import FileVerdict
from mckibben.facts.comparison import error_scale
from mckibben.report.summary.parts import Summary, Table, in_unit


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
