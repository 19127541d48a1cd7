"""Runs of a study on a Dask cluster: the same rows, whichever worker makes them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache
from itertools import islice
from typing import Any

import numpy as np
import orjson

from mckibben.application.study import StudyQuestion, evaluator_of
from mckibben.documents.studio import Studio
from mckibben.documents.study_files import read_study
from mckibben.physics.errors import InputError
from mckibben.studies.run import Chunk, Workers
from mckibben.studies.table import Evaluate, Row
from mckibben.version import __version__

Array = np.ndarray
_CONNECT, _FIRST_WORKER = 10.0, 30.0  # s
_AHEAD = 4  # chunks sent for each thread of the workers: enough to hide the way there and back
_HINT = "start it again with --resume when the scheduler is back"


def on_cluster(question: StudyQuestion, address: str) -> Workers:
    """Workers of the cluster with this scheduler.

    A chunk goes out as its points and comes back as its rows. A chunk whose worker is lost is run again by
    another one; its rows are the same. Workers need the same version of mckibben as this process.

    Args:
        question: the study; muscle, parts and effects must come with the program, because a worker has no
            others.
        address: of the scheduler, "tcp://host:8786".

    Raises:
        InputError: Dask is not installed, presets or effects of the user, no scheduler at the address.
    """
    _check_built_in(question)
    try:
        from distributed import Client  # pyright: ignore[reportMissingImports] - an extra
    except ImportError as error:
        raise InputError(
            "--scheduler needs Dask, which is not installed", hint='pip install "mckibben[cluster]"'
        ) from error
    try:
        client: Any = Client(address, timeout=_CONNECT, set_as_default=False)
        client.wait_for_workers(1, timeout=_FIRST_WORKER)
    except (OSError, ValueError, TimeoutError) as error:
        raise InputError(
            f"--scheduler {address}: no Dask scheduler with a worker answers",
            hint="dask scheduler and dask worker tcp://HOST:8786 start them",
        ) from error
    text = _study_text(question)

    def work(chunks: Iterable[Chunk]) -> Iterator[tuple[Chunk, Sequence[Row]]]:
        from distributed import as_completed  # pyright: ignore[reportMissingImports] - an extra

        source, sent = iter(chunks), {}

        def send(count: int) -> list[Any]:
            futures = []
            for chunk in islice(source, count):
                future = client.submit(make_rows, text, __version__, chunk[1], pure=False)
                sent[future.key] = chunk
                futures.append(future)
            return futures

        running = as_completed(send(_AHEAD * max(1, sum(client.nthreads().values()))), loop=client.loop)
        for future in running:
            rows = _rows_of(future, address)
            for more in send(1):
                running.add(more)
            yield sent.pop(future.key), rows

    return work


def _rows_of(future: Any, address: str) -> Sequence[Row]:
    """The rows of a finished chunk.

    Raises:
        InputError: the chunk cannot be run, or the scheduler is lost.
    """
    from concurrent.futures import CancelledError

    from distributed import KilledWorker  # pyright: ignore[reportMissingImports] - an extra

    try:
        return [Row(*row) for row in future.result()]
    except InputError:
        raise
    except KilledWorker as error:
        raise InputError(
            f"--scheduler {address}: the same runs ended several workers", hint="see the logs of the workers"
        ) from error
    except (CancelledError, OSError, TimeoutError) as error:
        raise InputError(f"--scheduler {address}: the scheduler is lost", hint=_HINT) from error


def make_rows(study: bytes, version: str, points: Array) -> list[tuple[str, tuple[float, ...], str]]:
    """Rows of points on a worker, as plain values.

    Raises:
        InputError: the worker has another version of the program.
    """
    if version != __version__:
        raise InputError(
            f"a worker has mckibben {__version__}, not {version}", hint="install the same version"
        )
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
