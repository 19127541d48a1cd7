"""Sizing: from a task to ranked drives."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mckibben.application.size.size import (
    ProposedDrive,
    RejectedParts,
    Searched,
    SizingResult,
    prepare_search,
    sizing_question,
)
from mckibben.application.size.task import heading_of
from mckibben.application.text_file import write_text
from mckibben.documents.located import at_file
from mckibben.documents.studio import Studio
from mckibben.documents.task import SizingTask
from mckibben.documents.task_files import named_task, read_task
from mckibben.door.drive import Drive
from mckibben.door.frames import frame_of_rows
from mckibben.door.problem import reported
from mckibben.door.result import Frozen, Result
from mckibben.door.workspace import studio
from mckibben.physics.errors import InputError
from mckibben.presets.reading import BadDocumentError
from mckibben.report.summary import Summary
from mckibben.report.summary.sizing import notices, summary_of
from mckibben.simulation.outcome import Watch

if TYPE_CHECKING:
    import pandas as pd
    from plotly.graph_objects import Figure

_COLUMNS = (
    "muscle", "nominal_length", "parallel", "valve", "tube", "pressure", "time", "contraction",
    "force_reserve", "air_volume_anr", "impact_energy", "probability", "binding",
)  # fmt: skip


class Proposal(Frozen):
    """A drive that fulfils the task; SI."""

    __slots__ = ("_drive", "_proposed")

    _proposed: ProposedDrive
    _drive: Drive

    def __init__(self, proposed: ProposedDrive, drive: Drive) -> None:
        self._set(_proposed=proposed, _drive=drive)

    @property
    def drive(self) -> Drive:
        """The drive, ready to be run; of parallel muscles that of one of them."""
        return self._drive

    @property
    def muscle(self) -> str:
        """Id of the muscle."""
        return self._proposed.muscle

    @property
    def nominal_length(self) -> float:
        """Length of the muscle at rest [m]."""
        return self._proposed.nominal_length

    @property
    def parallel(self) -> int:
        """Number of muscles side by side."""
        return self._proposed.parallel

    @property
    def valve(self) -> str:
        """Id of the valve."""
        return self._proposed.valve

    @property
    def pressure(self) -> float:
        """Supply pressure, gauge [Pa]."""
        return self._proposed.pressure

    @property
    def time(self) -> float:
        """Time for the stroke [s]."""
        return self._proposed.time

    @property
    def contraction(self) -> float:
        """Contraction at the end of the stroke [-]."""
        return self._proposed.contraction

    @property
    def air_volume_anr(self) -> float:
        """Air per cycle at ANR [m³], of all muscles, for stroke and return."""
        return self._proposed.air_volume_anr

    @property
    def probability(self) -> float | None:
        """Share of the simulated specimens that succeed, 0 to 1; None where none were simulated."""
        return self._proposed.probability

    @property
    def reason(self) -> str:
        """Reason of its rank."""
        return self._proposed.reason

    @property
    def details(self) -> ProposedDrive:
        """All figures: margins of each limit, energy, stiffness, cost, notes for the builder."""
        return self._proposed

    def __repr__(self) -> str:
        return f"<Proposal {self.muscle}, {self.nominal_length * 1e3:.4g} mm, {self.valve}>"


class Sizing(Result):
    """Drives for a task, the best first, and why the other parts were rejected; from `mckibben.size`."""

    __slots__ = ("_name", "_search", "_studio")

    _search: Searched
    _name: str
    _studio: Studio

    def __init__(self, search: Searched, name: str, of: Studio) -> None:
        self._set(_search=search, _name=name, _studio=of)

    @property
    def _heading(self) -> str:
        return heading_of(self._result.about, self._name)

    @property
    def _result(self) -> SizingResult:
        return self._search.result

    @property
    def proposals(self) -> Sequence[Proposal]:
        """The drives, the best first; empty if no drive of the catalogue fulfils the task."""
        return tuple(
            Proposal(item, Drive.of(item.drive, f"{item.muscle}, proposal {rank}", self._studio))
            for rank, item in enumerate(self._result.proposals, 1)
        )

    @property
    def rejected(self) -> Sequence[RejectedParts]:
        """The other parts: why they do not fulfil the task, and what would help."""
        return tuple(self._result.rejected)

    @property
    def ranking(self) -> str | None:
        """Why the first proposal comes before the second."""
        return self._result.ranking

    @property
    def messages(self) -> Sequence[str]:
        """Values that are not verified, and why a search did not complete."""
        return tuple(notices(self._result))

    @property
    def details(self) -> SizingResult:
        """The whole result: also the explored alternatives and how many combinations were tried."""
        return self._result

    def to_frame(self) -> pd.DataFrame:
        """One row for each proposal, the best first, SI."""
        rows = [[getattr(item, name) for name in _COLUMNS] for item in self._result.proposals]
        return frame_of_rows(_COLUMNS, rows)

    def plot(self) -> Figure:
        """Air per cycle over the time of the stroke, for all drives that fulfil the task."""
        from mckibben.door.figures.others import sizing_figure

        return sizing_figure(self._result, self._heading)

    @reported
    def report(self, path: str | PathLike[str], *, proposal: int = 1, title: str = "") -> None:
        """Write the HTML report of one drive.

        Args:
            path: of the file.
            proposal: rank of the drive; 1 is the best.
            title: name beside the figures of the task in the heading; "" for that of the task.

        Raises:
            Problem: there is no such proposal, or the file cannot be written.
        """
        from mckibben.report.sizing.gather import report_of

        write_text(Path(path), report_of(self._search, self._studio, proposal=proposal, title=title))

    def _answer(self) -> object:
        return self._result

    def _summary(self) -> Summary:
        return summary_of(self._result, self._name)

    def _title(self) -> str:
        return f"{self._heading}: {len(self._result.proposals)} proposals"

    def _lead(self) -> Sequence[str]:
        return () if self._result.ranking is None else (self._result.ranking,)


@reported
def size(
    task: str | PathLike[str] | Mapping[str, Any], *, progress: Callable[[float], object] | None = None
) -> Sizing:
    """Drives from the catalogue that fulfil a task.

    Args:
        task: the task as a document, ``{"load": {"mass": "20 kg"}, "stroke": "60 mm", "time": "0.5 s"}``; the
            path of a file; or the id of a preset, "lift-20kg".
        progress: called with the share that is done, 0 to 1.

    Raises:
        Problem: names the file, the field, what is wrong and what would be right.
    """
    of, name = studio(), ""
    if isinstance(task, Mapping):
        document = read_task(dict(task))
        search, name = _search(document, of, progress), document.title
    else:
        name = fspath(task)
        try:
            search = _search(named_task(name, of), of, progress)
        except BadDocumentError as bad:
            finding = bad.findings[0]
            raise at_file(name, finding.field, finding.message, finding.hint) from bad
        except InputError as error:
            raise at_file(name, error.field, error.message, error.hint) from error
        name = Path(name).stem
    return Sizing(search, name, of)


def _search(document: SizingTask, of: Studio, progress: Callable[[float], object] | None) -> Searched:
    def tell(share: float) -> None:
        if progress is not None:
            progress(share)

    # No time limit: whoever calls can interrupt, and the first search on a computer compiles for a while.
    watch = Watch(progress=None if progress is None else tell, time_limit=float("inf"))
    return prepare_search(sizing_question(document, of))(watch)
