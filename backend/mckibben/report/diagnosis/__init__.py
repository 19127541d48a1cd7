"""The report of a diagnosis: data, model, error, where it fails, what is missing, and how to repeat it."""

from mckibben.report.diagnosis.material import Command, Figure, Material, MuscleFacts, PastModel, Source
from mckibben.report.diagnosis.writing import diagnosis_report

__all__ = ["Command", "Figure", "Material", "MuscleFacts", "PastModel", "Source", "diagnosis_report"]
