"""Units in which the errors of a comparison are shown."""

from __future__ import annotations

from mckibben.application.compare.compare import ComparisonResult
from mckibben.application.diagnose.result import DiagnosisResult
from mckibben.report.figures import Scale, variable

#: Unit of an error that combines several channels.
TIMES_NOISE = Scale("× noise")


def error_scale(answer: ComparisonResult | DiagnosisResult) -> Scale:
    """Unit in which the errors of a comparison or diagnosis are shown."""
    if answer.unit == "1" and "," in answer.predicted:
        return TIMES_NOISE
    return variable(answer.predicted)[1] if answer.unit != "1" else Scale("")
