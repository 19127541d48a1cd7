"""Bodies and answers of ``/api/kept``: what the user keeps on the disk."""

from __future__ import annotations

from pydantic import Field

from mckibben.documents.strict import Strict
from mckibben.measurement.store import MAX_NAME


class RenameRequest(Strict):
    """A new name."""

    name: str = Field(
        min_length=1, max_length=MAX_NAME, description="The new name.", examples=["bench 3, 300 mm"]
    )
    was: str | None = Field(
        None, max_length=MAX_NAME, description="The name that the user saw; refused if it is another by now."
    )
