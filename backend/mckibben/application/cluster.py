"""A Dask cluster: calls of a function go out, their results come back, whichever worker makes them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import CancelledError
from itertools import islice
from typing import Any, TypeVar

from mckibben.physics.errors import InputError
from mckibben.version import __version__

T = TypeVar("T")
R = TypeVar("R")
_CONNECT, _FIRST_WORKER = 10.0, 30.0  # s
_AHEAD = 4  # calls sent for each thread of the workers: enough to hide the way there and back


class KilledError(InputError):
    """The same call ended several workers; the others are not affected."""


class Cluster:
    """The workers of a scheduler. They need the same version of mckibben as this process.

    Args:
        address: of the scheduler, "tcp://host:8786".
        again: how the work is continued when the scheduler was lost, for people.

    Raises:
        InputError: Dask is not installed, or no scheduler with a worker answers.
    """

    def __init__(self, address: str, *, again: str) -> None:
        self._address, self._again = address, again
        try:
            from distributed import Client  # pyright: ignore[reportMissingImports] - an extra
        except ImportError as error:
            raise InputError(
                "--scheduler needs Dask, which is not installed", hint='pip install "mckibben[cluster]"'
            ) from error
        try:
            self._client: Any = Client(address, timeout=_CONNECT, set_as_default=False)
            self._client.wait_for_workers(1, timeout=_FIRST_WORKER)
        except (OSError, ValueError, TimeoutError) as error:
            raise InputError(
                f"--scheduler {address}: no Dask scheduler with a worker answers",
                hint="dask scheduler and dask worker tcp://HOST:8786 start them",
            ) from error

    def each(
        self, function: Callable[..., R], calls: Iterable[tuple[T, tuple[Any, ...]]]
    ) -> Iterator[tuple[T, Callable[[], R]]]:
        """Call a function of this package for each tuple of arguments.

        A call whose worker is lost is made again by another one.

        Args:
            function: found by its name on the worker.
            calls: what a call is for, and its arguments; taken as workers become free.

        Returns:
            What the call was for and a function that gives its result, in the order in which they end. That
            function raises `KilledError`, what the call raised, or InputError when the scheduler is lost.
        """
        from distributed import as_completed  # pyright: ignore[reportMissingImports] - an extra

        source, sent = iter(calls), {}

        def send(count: int) -> list[Any]:
            futures = []
            for what, arguments in islice(source, count):
                future = self._client.submit(function, *arguments, pure=False)
                sent[future.key] = what
                futures.append(future)
            return futures

        running = as_completed(
            send(_AHEAD * max(1, sum(self._client.nthreads().values()))), loop=self._client.loop
        )
        for future in running:
            for more in send(1) if future.status in ("finished", "error") else ():
                running.add(more)
            yield sent.pop(future.key), lambda future=future: self._result(future)

    def _result(self, future: Any) -> Any:
        from distributed import KilledWorker  # pyright: ignore[reportMissingImports] - an extra

        try:
            return future.result()
        except InputError:
            raise
        except KilledWorker as error:
            raise KilledError(
                f"--scheduler {self._address}: the same work ended several workers",
                hint="see the logs of the workers",
            ) from error
        except (CancelledError, OSError, TimeoutError) as error:
            raise InputError(
                f"--scheduler {self._address}: the scheduler is lost", hint=self._again
            ) from error


def check_version(version: str) -> None:
    """Check on a worker that it has the version of the program that sent the work.

    Raises:
        InputError: it has another one.
    """
    if version != __version__:
        raise InputError(
            f"a worker has mckibben {__version__}, not {version}", hint="install the same version"
        )
