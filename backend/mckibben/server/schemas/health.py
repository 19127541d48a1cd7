"""Answer of ``/api/health``."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from mckibben.documents.strict import Strict


class LaneState(Strict):
    """Processes for one sort of work."""

    name: Literal["long", "files", "models"] = Field(
        description="Diagnoses and the like; files that are read; comparisons and models with typed terms."
    )
    processes: int = Field(description="Jobs that run at a time.")
    running: int = Field(description="Jobs that run.")
    waiting: int = Field(description="Jobs that wait.")


class Health(Strict):
    """The server is up."""

    status: Literal["ok"] = Field(description="The word 'ok'.")
    version: str = Field(description="Version of mckibben.", examples=["0.1.0"])
    plotly: str = Field(description="Version of the plotly bundle, for its link's ``?v=``.")
    workers: int = Field(
        description="Processes for diagnoses, sizings and reports; 0 = threads of the server."
    )
    running: int = Field(description="Jobs in these processes.")
    waiting: int = Field(description="Jobs in the queue.")
    queue: int = Field(description="Jobs that may wait; further ones are refused with status 429.")
    lanes: list[LaneState] = Field(description="The processes by sort of work; empty without workers.")
    memory: int | None = Field(
        description="Most memory that the server itself took so far [bytes]; null on Windows."
    )
    versions: dict[str, str] = Field(description="Program -> version.")
    compiling: bool = Field(
        description="Whether the integrators are being compiled for this machine: once after an "
        "installation, about 20 s of a core. What needs them waits."
    )
    can_save_presets: bool = Field(description="Whether the server has a folder for the user's presets.")
