"""Request and answer of ``/api/simulations``: transient simulation of a drive."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from mckibben.documents.drive import LONGEST, DriveOrId
from mckibben.documents.quantity import QuantityField
from mckibben.documents.strict import Strict
from mckibben.server.schemas.common import streamed

Instant = Annotated[float, QuantityField("s", "0.5 s", at_least=0.0, at_most=LONGEST)]


class SimulationRequest(Strict):
    """A drive, and the part of its run to return."""

    drive: DriveOrId = Field(description="A drive document, or the id of a drive preset.")
    points: Annotated[int, Field(ge=2, le=20_001)] = Field(2001, description="Rows of the answer.")
    begin: Instant | None = Field(None, alias="from", description="First row; 0 when left out.")
    end: Instant | None = Field(None, alias="to", description="Last row; the end of the run when left out.")


SimulationEvents = streamed()
