"""The report of a diagnosis: data, model, error, where it fails, what is missing, how to reproduce it."""

from mckibben.report.command import Command
from mckibben.report.diagnosis.material import DataSource, DiagnosisMaterial, MuscleFacts, PastModel
from mckibben.report.diagnosis.writing import diagnosis_report
from mckibben.report.sources import Figure

__all__ = [
    "Command",
    "DataSource",
    "DiagnosisMaterial",
    "Figure",
    "MuscleFacts",
    "PastModel",
    "diagnosis_report",
]
