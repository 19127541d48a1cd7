"""How the values of a muscle were fitted to measurements: how sure they are, and where they were measured."""

from __future__ import annotations

from typing import Annotated

import numpy as np
from pydantic import Field, model_validator

from mckibben.physics.errors import InputError
from mckibben.presets.quantity import Number, PresetModel, Text

_MOST_PARAMETERS = 64
_ASYMMETRY = 1e-9  # share of the standard deviations by which rounding may make a matrix asymmetric
_NEGATIVE = 1e-6  # eigenvalue of the correlation matrix below which it is no covariance

ParameterName = Annotated[
    str,
    Field(
        max_length=130, pattern=r"^[a-z][a-z0-9_]*(\.[A-Za-z][A-Za-z0-9_]*)?$", examples=["effect.parameter"]
    ),
]
Channel = Annotated[str, Field(pattern=r"^[a-z][a-z0-9_]{0,63}$")]


class MeasuredSpan(PresetModel):
    """The range of a quantity in the data of a model."""

    least: Number = Field(description="Least value, SI.")
    most: Number = Field(description="Largest value, SI.")
    unit: Annotated[str, Field(min_length=1, max_length=40)] = Field(description="SI unit.")


class Covariance(PresetModel):
    """Covariance of fitted parameters: how sure each is, and how far one can replace another."""

    names: Annotated[list[ParameterName], Field(max_length=_MOST_PARAMETERS)] = Field(
        description="effect.parameter, or a dimension of the muscle; those that the data determine."
    )
    matrix: list[list[Number]] = Field(description="Products of their SI units, one row per name.")

    @model_validator(mode="after")
    def _is_covariance(self) -> Covariance:
        """Square, symmetric, and no combination of the parameters has a negative variance."""
        size = len(self.names)
        if len(set(self.names)) < size:
            raise InputError("a name stands there twice", field="names")
        if len(self.matrix) != size or any(len(row) != size for row in self.matrix):
            raise InputError(f"the matrix must have {size} rows of {size} numbers", field="matrix")
        if not size:
            return self
        matrix = np.array(self.matrix)
        deviations = np.sqrt(np.maximum(np.diag(matrix), 0.0))
        scale = np.outer(deviations, deviations)
        if np.any(np.abs(matrix - matrix.T) > _ASYMMETRY * scale):
            raise InputError("the matrix is not symmetric", field="matrix")
        if np.any(np.diag(matrix) < 0.0) or np.any(np.abs(matrix) > (1.0 + _NEGATIVE) * scale):
            raise InputError("the matrix is no covariance", field="matrix", hint="each |c_ij|² <= c_ii c_jj")
        correlation = np.divide(matrix, scale, out=np.eye(size), where=scale > 0.0)
        if float(np.min(np.linalg.eigvalsh(correlation))) < -_NEGATIVE * size:
            raise InputError("a combination of the parameters has a negative variance", field="matrix")
        return self


class FitRecord(PresetModel):
    """How the values of a muscle were fitted to measurements."""

    files: Annotated[list[Text], Field(max_length=1000)] = Field(description="Measurements it was fitted to.")
    made: Annotated[str, Field(max_length=40)] = Field(description="Date and time, ISO 8601, UTC.")
    errors: dict[Channel, Annotated[float, Field(ge=0.0, le=1e30)]] = Field(
        description="Predicted channel -> error left (rms), SI."
    )
    envelope: dict[Channel, MeasuredSpan] = Field(
        default_factory=dict, description="Quantity -> range in which it was measured."
    )
    covariance: Covariance | None = Field(
        default=None, description="Of the fitted values; null where the data cannot separate them."
    )
    stated: dict[Channel, Annotated[float, Field(gt=0.0, le=1e30)]] = Field(
        default_factory=dict, description="What was stated for geometry that the data corrected, SI."
    )
