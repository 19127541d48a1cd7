"""The report of a diagnosis: data, model, error, where it fails, what is missing, and how to repeat it."""

from mckibben.report.command import Command
from mckibben.report.diagnosis.material import Material, MuscleFacts, PastModel, Source
from mckibben.report.diagnosis.writing import diagnosis_report
from mckibben.report.sources import Figure

__all__ = ["Command", "Figure", "Material", "MuscleFacts", "PastModel", "Source", "diagnosis_report"]
