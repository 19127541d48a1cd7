"""Answer of ``/api/simulations``: a run as columns, timing table, limits and remarks."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager

import numpy as np

from mckibben.application.runs import Grid, answer_of, grid_of
from mckibben.application.start import Json
from mckibben.documents.drive import DriveDocument
from mckibben.documents.drive_reading import GivenDrive, drive_of
from mckibben.documents.problems import first_problem
from mckibben.documents.studio import Studio
from mckibben.physics.errors import InputError
from mckibben.presets import DrivePreset
from mckibben.server.schemas.simulations import SimulationRequest
from mckibben.simulation.drive.controlled import simulate_controlled
from mckibben.simulation.drive.transient import Run, simulate
from mckibben.simulation.outcome import Watch

POINTS = 2001


def prepare(request: SimulationRequest, studio: Studio) -> Callable[[Watch], Json]:
    """The run a request means, ready to start.

    Raises:
        InputError: the drive or the window cannot be used; its field begins with ``drive`` where it is
            the drive's.
    """
    with inside("drive"):
        document = request.drive
        if isinstance(document, str):
            document = preset_document(document, studio)
        given = drive_of(document, studio)
    begin = 0.0 if request.begin is None else request.begin
    end = document.duration if request.end is None else request.end
    if not 0.0 <= begin < end <= document.duration:
        raise InputError(
            f"the rows from {begin:g} s to {end:g} s do not lie within the run",
            field="from" if request.begin is not None else "to",
            hint=f"0 to {document.duration:g} s",
        )
    grid = grid_of(duration=document.duration, begin=begin, end=end, points=request.points)

    def work(watch: Watch) -> Json:
        with inside("drive"):
            return simulation_answer(given, grid, watch)

    return work


def simulation_answer(
    given: GivenDrive, grid: Grid, watch: Watch | None = None, engine: str = "auto"
) -> Json:
    """Run the drive and tell what happened; see `run_drive`."""
    return answer_of(given, grid, run_drive(given, grid, watch, engine))


def run_drive(given: GivenDrive, grid: Grid, watch: Watch | None = None, engine: str = "auto") -> Run:
    """The run on the fine grid; with a controller it waits for the kernel, whatever the engine."""
    with np.errstate(all="ignore"):  # a diverging run ends with an outcome, not with warnings
        if given.drive.controller is not None:
            return simulate_controlled(given.drive, grid=grid.time, watch=watch)
        return simulate(given.drive, grid=grid.time, watch=watch, engine=engine)


def preset_document(preset_id: str, studio: Studio) -> DriveDocument:
    """The document of a drive preset.

    Raises:
        InputError: there is no such preset, or its document cannot be used.
    """
    try:
        preset = studio.library.get("drives", preset_id)
    except InputError as error:
        raise InputError(error.message, hint=error.hint, code="unknown_preset") from error
    assert isinstance(preset, DrivePreset)  # noqa: S101 - of its folder
    return read_document(preset.document, f"the drive preset {preset.id}")


def read_document(document: object, subject: str) -> DriveDocument:
    """A drive document from JSON.

    Raises:
        InputError: says what is wrong, its ``field`` the path in the document.
    """
    from pydantic import ValidationError

    try:
        return DriveDocument.model_validate(document)
    except ValidationError as error:
        problem = first_problem(error.errors(), DriveDocument, document, subject)
        raise InputError(
            problem.message, field=problem.field, hint=problem.hint, code=problem.code
        ) from error


@contextmanager
def inside(part: str) -> Iterator[None]:
    """Errors inside name their field within this part of the request."""
    try:
        yield
    except InputError as error:
        field = f"{part}.{error.field}" if error.field else part
        raise InputError(error.message, field=field, hint=error.hint, code=error.code) from error
