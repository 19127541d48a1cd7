"""Sizing: from a task to ranked drives."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mckibben.application.size.size import (
    ProposedDrive,
    Searched,
    SizingResult,
    prepare_search,
    sizing_question,
)
from mckibben.application.size.task import heading_of
from mckibben.application.text_file import HTML, check_ending, write_text
from mckibben.documents.located import at_file
from mckibben.documents.studio import Studio
from mckibben.documents.task import SizingTask, named_task, read_task
from mckibben.door.drive import Drive
from mckibben.door.frames import frame_of_rows
from mckibben.door.problem import reported
from mckibben.door.result import Holding, ResultOf
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


class Proposal(Holding[ProposedDrive], ProposedDrive):
    """A drive that fulfils the task; SI."""

    drive: Drive  # type: ignore - its document is in `details`
    """The drive, ready to be run; of parallel muscles that of one of them."""

    def __repr__(self) -> str:
        return f"<Proposal {self.muscle}, {self.nominal_length * 1e3:.4g} mm, {self.valve}>"


class Sizing(ResultOf[SizingResult], SizingResult):
    """Drives for a task, the best first, and why the other parts were rejected; from `mckibben.size`."""

    proposals: list[Proposal]  # type: ignore
    """The drives, the best first; empty if no drive of the catalogue fulfils the task."""
    _search: Searched
    _studio: Studio

    @property
    def _heading(self) -> str:
        return heading_of(self.about, self._name)

    @property
    def messages(self) -> Sequence[str]:
        """Values that are not verified, and why a search did not complete."""
        return tuple(notices(self._result))

    def to_frame(self) -> pd.DataFrame:
        """One row for each proposal, the best first, SI."""
        rows = [[getattr(item, name) for name in _COLUMNS] for item in self.proposals]
        return frame_of_rows(_COLUMNS, rows)

    def plot(self) -> Figure:
        """Air per cycle over the time of the stroke, for all drives that fulfil the task."""
        from mckibben.door.figures import sizing_figure

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

        check_ending(Path(path), HTML)
        write_text(Path(path), report_of(self._search, self._studio, proposal=proposal, title=title))

    def _summary(self) -> Summary:
        return summary_of(self._result, self._name)

    def _title(self) -> str:
        return f"{self._heading}: {len(self.proposals)} proposals"

    def _lead(self) -> Sequence[str]:
        return () if self.ranking is None else (self.ranking,)


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
    proposals = [
        Proposal.of(item, drive=Drive.of(item.drive, f"{item.muscle}, proposal {rank}", of))
        for rank, item in enumerate(search.result.proposals, 1)
    ]
    return Sizing.of(search.result, proposals=proposals, _search=search, _name=name, _studio=of)


def _search(document: SizingTask, of: Studio, progress: Callable[[float], object] | None) -> Searched:
    def tell(share: float) -> None:
        if progress is not None:
            progress(share)

    # No time limit: whoever calls can interrupt, and the first search on a computer compiles for a while.
    watch = Watch(progress=None if progress is None else tell)
    return prepare_search(sizing_question(document, of))(watch)
