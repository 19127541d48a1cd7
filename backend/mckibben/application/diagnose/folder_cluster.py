"""Diagnoses of the files of a folder on a Dask cluster: the same verdicts, whichever worker makes them."""

from __future__ import annotations

import io
import pickle
from collections.abc import Iterable, Iterator
from functools import cache
from types import MappingProxyType
from typing import Any

from mckibben.application.cluster import Cluster, KilledError, check_version
from mckibben.application.compare.question import ModelQuestion
from mckibben.application.diagnose.folder import Diagnose, FileVerdict, diagnosed
from mckibben.documents.located import one_line
from mckibben.documents.studio import Studio
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError
from mckibben.version import __version__

_NO_OWN = "a diagnosis on a cluster cannot use effects of your own"


def on_cluster(studio: Studio, address: str, *, again: str) -> Diagnose:
    """Diagnoses by the workers of the cluster with this scheduler.

    This process reads the files; a worker gets the question of one with its data, and answers with its
    verdict. A file that ends several workers is refused, the others go on.

    Args:
        studio: its effects must come with the program, because a worker has no others.
        address: of the scheduler, "tcp://host:8786".
        again: how the diagnoses are continued when the scheduler was lost, for people.

    Raises:
        InputError: Dask is not installed, effects of the user, no scheduler at the address.
    """
    if studio.catalogue is not default_catalogue():
        raise InputError(_NO_OWN, hint="omit --effects, or --scheduler")
    cluster = Cluster(address, again=again)

    def work(questions: Iterable[tuple[str, ModelQuestion]]) -> Iterator[FileVerdict]:
        calls = ((file, (file, packed(question), __version__)) for file, question in questions)
        for file, verdict in cluster.each(make_verdict, calls):
            try:
                yield verdict()
            except KilledError as error:
                yield FileVerdict(file, refused=one_line(error))

    return work


def make_verdict(file: str, question: bytes, version: str) -> FileVerdict:
    """The verdict of a file on a worker.

    Raises:
        InputError: the worker has another version of the program.
    """
    check_version(version)
    return diagnosed(file, unpacked(question), _studio())


@cache
def _studio() -> Studio:
    from mckibben.resources import presets_folder

    return Studio(presets=presets_folder())


def packed(question: ModelQuestion) -> bytes:
    """A question as bytes; effects of the program go by their names, so that they are the worker's own.

    Raises:
        InputError: it holds a term or an effect of the user.
    """
    stream = io.BytesIO()
    try:
        _Pickler(stream, protocol=pickle.HIGHEST_PROTOCOL).dump(question)
    except (pickle.PicklingError, AttributeError, TypeError) as error:
        raise InputError(_NO_OWN, hint="diagnose it without --scheduler") from error
    return stream.getvalue()


def unpacked(content: bytes) -> ModelQuestion:
    """The question again."""
    return _Unpickler(io.BytesIO(content)).load()


class _Pickler(pickle.Pickler):
    def persistent_id(self, obj: Any) -> tuple[str, str] | None:
        if obj is default_catalogue():
            return "catalogue", ""
        if isinstance(obj, Effect) and default_catalogue().get(obj.id) is obj:
            return "effect", obj.id
        return None

    def reducer_override(self, obj: Any) -> Any:
        return (_frozen, (dict(obj),)) if isinstance(obj, MappingProxyType) else NotImplemented


class _Unpickler(pickle.Unpickler):
    def persistent_load(self, pid: tuple[str, str]) -> Any:
        kind, name = pid
        return default_catalogue() if kind == "catalogue" else default_catalogue()[name]


def _frozen(content: dict[Any, Any]) -> MappingProxyType[Any, Any]:
    return MappingProxyType(content)
