"""Studies: many runs of a drive or a task with varied quantities."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from mckibben.application.study.file import prepare_file, table_text
from mckibben.application.study.study import StudyQuestion, StudyResult, prepare, study_question
from mckibben.documents.drive_reading import read_document
from mckibben.documents.study import in_file, read_study, read_study_file
from mckibben.door.drive import Drive
from mckibben.door.frames import frame_of
from mckibben.door.problem import reported
from mckibben.door.result import ResultOf
from mckibben.door.workspace import studio
from mckibben.physics.errors import InputError
from mckibben.report.summary import Summary
from mckibben.report.summary.study import notices, summary_of
from mckibben.simulation.outcome import Watch

if TYPE_CHECKING:
    import pandas as pd
    from plotly.graph_objects import Figure


class Study(ResultOf[StudyResult], StudyResult):
    """A finished study, from `study`; SI. One row for each run, also of those that failed."""

    _question: StudyQuestion

    @property
    def messages(self) -> Sequence[str]:
        """Runs that failed, figures that are missing, why the study ended early."""
        return tuple(notices(self))

    @reported
    def drive(self, run: int) -> Drive:
        """The drive of a run, by its number; of a study of a drive.

        Raises:
            Problem: there is no such run, or the study is one of a task.
        """
        if self._question.subject.kind != "drive":
            raise InputError("this is a study of a task, its runs have no drive", hint="see to_frame()")
        if run not in self.table["run"]:
            raise InputError(f"there is no run {run}", hint=f"0 to {self.planned - 1}")
        document = self._question.document_of(self._question_point(run))
        return Drive.of(read_document(document, "the drive"), f"run {run} of {self._name}", studio())

    def _question_point(self, run: int) -> Sequence[float]:
        place = self.table["run"].index(run)
        point: list[float] = []
        for variable in self._question.variables:
            value = self.table[variable.name][place]
            choices = variable.choices
            point.append(float(choices.index(str(value))) if choices else float(cast("float", value)))
        return point

    def to_frame(self) -> pd.DataFrame:
        """One row for each run: run, quantities, figures, outcome, message; NaN where a figure is missing."""
        return frame_of(self.table)

    def plot(self) -> Figure:
        """What the method asks for: the Pareto front, influences, or the distribution of the first figure."""
        from mckibben.door.figures import study_figure

        return study_figure(self, self.title or self._name)

    def _files(self, path: Path) -> str:
        return table_text(self) if path.suffix.lower() == ".csv" else super()._files(path)

    def _summary(self) -> Summary:
        return summary_of(self, self._name)

    def _title(self) -> str:
        return f"Study {self.title or self._name}: {self.runs} runs"


@reported
def study(
    study: str | PathLike[str] | Mapping[str, Any],
    *,
    out: str | PathLike[str] | None = None,
    resume: bool = False,
    scheduler: str | None = None,
    progress: Callable[[float], object] | None = None,
) -> Study:
    """Many runs of a drive or task: sweep, Monte Carlo, sensitivity, optimisation, robust design.

    Args:
        study: the study as a document, ``{"subject": {"drive": drive.document}, "quantities": [{"path":
            "load.mass", "from": "8 kg", "to": "12 kg"}], "figures": ["timing.extend.rise_time"], "method":
            {"type": "monte_carlo", "runs": 1000}}``, or the path of a file.
        out: file for the table, .csv, .json or .parquet; runs are kept beside it until it is complete.
        resume: continue a study of ``out`` that was interrupted.
        scheduler: address of a Dask scheduler whose workers make the runs, "tcp://host:8786"; the table is
            the same as without.
        progress: called with the share that is done, 0 to 1.

    Raises:
        Problem: names the field, what is wrong and what would be right.
    """
    name = "the study"
    if isinstance(study, Mapping):
        question = study_question(read_study(dict(study)), studio())
    else:
        document, name = read_study_file(Path(study)), Path(study).stem
        try:
            question = study_question(document, studio())
        except InputError as error:
            raise in_file(fspath(study), error) from error

    def tell(share: float) -> None:
        if progress is not None:
            progress(share)

    watch = Watch(progress=None if progress is None else tell)
    workers = None
    if scheduler is not None:
        from mckibben.application.study.cluster import on_cluster

        workers = on_cluster(question, scheduler, again="call it again with resume=True when it is back")
    if out is None:
        work = prepare(question, workers=workers)
    else:
        work = prepare_file(question, Path(out), resume=resume, workers=workers)
    return Study.of(work(watch), _question=question, _name=name)
