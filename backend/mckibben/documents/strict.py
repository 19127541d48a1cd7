"""Common parts of all documents: no unknown fields, ids, fields with units."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field, StringConstraints


class Strict(BaseModel):
    """A request or answer without unknown fields."""

    model_config = ConfigDict(extra="forbid", allow_inf_nan=False, strict=True)

    def to_document(self) -> dict[str, object]:
        """The stated fields as JSON values; reading them again gives the same object."""
        return self.model_dump(mode="json", by_alias=True, exclude_unset=True)


Id = Annotated[
    str,
    StringConstraints(max_length=64, pattern=r"^[A-Za-z0-9][A-Za-z0-9./-]{0,63}$"),
    Field(description="Id of a preset.", examples=["DMSP-20"]),
]

Name = Annotated[str, StringConstraints(min_length=1, max_length=64, pattern=r"^[A-Za-z_][A-Za-z0-9_]*$")]
