"""Runs of a study on a Dask cluster: the same rows, whichever worker makes them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache

import numpy as np
import orjson

from mckibben.application.cluster import Cluster, check_version
from mckibben.application.study.study import StudyQuestion, evaluator_of
from mckibben.documents.studio import Studio
from mckibben.documents.study import read_study
from mckibben.physics.errors import InputError
from mckibben.studies.run import Chunk, Workers
from mckibben.studies.table import Evaluate, Row
from mckibben.version import __version__

Array = np.ndarray
_AGAIN = "start it again with --resume when the scheduler is back"


def on_cluster(question: StudyQuestion, address: str, *, again: str = _AGAIN) -> Workers:
    """Workers of the cluster with this scheduler.

    A chunk goes out as its points and comes back as its rows. A chunk whose worker is lost is run again by
    another one; its rows are the same. Workers need the same version of mckibben as this process.

    Args:
        question: the study; muscle, parts and effects must come with the program, because a worker has no
            others.
        address: of the scheduler, "tcp://host:8786".
        again: how the study is continued when the scheduler was lost, for people.

    Raises:
        InputError: Dask is not installed, presets or effects of the user, no scheduler at the address.
    """
    _check_built_in(question)
    cluster = Cluster(address, again=again)
    text = _study_text(question)

    def work(chunks: Iterable[Chunk]) -> Iterator[tuple[Chunk, Sequence[Row]]]:
        calls = ((chunk, (text, __version__, chunk[1])) for chunk in chunks)
        for chunk, result in cluster.each(make_rows, calls):
            yield chunk, [Row(*row) for row in result()]

    return work


def make_rows(study: bytes, version: str, points: Array) -> list[tuple[str, tuple[float, ...], str]]:
    """Rows of points on a worker, as plain values.

    Raises:
        InputError: the worker has another version of the program.
    """
    check_version(version)
    return [(row.outcome, row.figures, row.message) for row in _evaluator(study)(points)]


@lru_cache(maxsize=4)
def _evaluator(study: bytes) -> Evaluate:
    """The function that runs points; kept, because presets and compiled equations are read once."""
    from mckibben.resources import presets_folder

    studio = Studio(presets=presets_folder())
    return evaluator_of(read_study(orjson.loads(study)), studio)


def _study_text(question: StudyQuestion) -> bytes:
    """The study as JSON, its subject complete."""
    whole = question.document.model_dump(mode="json", by_alias=True, exclude_unset=True, exclude={"subject"})
    whole["subject"] = {question.subject.kind: question.subject.content}
    return orjson.dumps(whole)


def _check_built_in(question: StudyQuestion) -> None:
    studio, content = question.studio, question.subject.content
    if question.subject.kind == "task":
        parts = content.get("catalogue") or {}
        named = [(kind, name) for kind in ("muscles", "valves", "tubes") for name in parts.get(kind) or ()]
        if not studio.is_built_in(None, studio.catalogue):
            raise InputError("a study on a cluster cannot use effects of your own")
    else:
        named = [("fittings", name) for name in content.get("fittings") or ()]
        for kind, part in (("muscles", "muscle"), ("valves", "valve"), ("tubes", "tube")):
            preset = (content.get(part) or {}).get("preset")
            if preset is not None:
                named.append((kind, preset))
        if not studio.is_built_in(None, content.get("effects") or {}):
            raise InputError("a study on a cluster cannot use effects of your own")
    for variable in question.variables:
        kind = {"muscle.preset": "muscles", "valve.preset": "valves", "tube.preset": "tubes"}.get(
            variable.path
        )
        named += [(kind, name) for name in variable.choices] if kind else []
    for kind, name in named:
        if not studio.library.is_built_in(kind, name):
            raise InputError(
                f"{name} is a preset of yours, which the workers of a cluster do not have",
                hint="state its values in the document",
            )
