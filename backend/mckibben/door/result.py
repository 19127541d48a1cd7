"""What all results of the Python door have: text, HTML, a dictionary, a frame, a figure, files."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

import json
from abc import ABC, abstractmethod
from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, Generic, Self, TypeVar

from mckibben.application.json_text import answer_json
from mckibben.application.text_file import check_ending, write_text
from mckibben.documents.doors import result_in_words_of
from mckibben.door.frames import csv_of
from mckibben.door.problem import reported
from mckibben.door.rendering import notebook_cell, plain_text
from mckibben.report.summary import Summary

if TYPE_CHECKING:
    import pandas as pd
    from plotly.graph_objects import Figure


class Frozen:
    """A value that does not change once it is made."""

    __slots__ = ()

    def _set(self, **values: object) -> None:
        """Set attributes while the value is made."""
        for name, value in values.items():
            object.__setattr__(self, name, value)

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"a {type(self).__name__} does not change; make another one")

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"a {type(self).__name__} does not change; make another one")

    def __getstate__(self) -> object:
        return object.__getstate__(self)  # all slots of all bases; a dataclass knows its fields alone

    def __setstate__(
        self, state: dict[str, object] | tuple[dict[str, object] | None, dict[str, object]]
    ) -> None:
        for values in state if isinstance(state, tuple) else (state,):
            self._set(**(values or {}))


#: The model of a comparison or diagnosis. `Model` makes these results, so they do not import it.
ModelT = TypeVar("ModelT")
#: The result class of a use case.
ResultT = TypeVar("ResultT")


class Holding(Frozen, Generic[ResultT]):
    """A result of a use case as an object of the door: all its fields, and what the door adds.

    A subclass also derives from the result class, after this one, so that fields, types and docstrings are
    declared there. It declares again what it has in another form, such as a model instead of its document.
    """

    __slots__ = ()

    _result: ResultT

    @classmethod
    def of(cls, result: ResultT, **more: object) -> Self:
        """The object with the fields of a result; arrays are shared, not copied.

        Args:
            result: of the use case.
            more: further attributes, and fields in another form.
        """
        made = cls.__new__(cls)
        made._set(_result=result_in_words_of("python", result), **more)
        return made

    if not TYPE_CHECKING:  # a checker would take any name for a field

        @reported  # what is computed when it is read
        def __getattr__(self, name: str) -> Any:
            if name not in type(self).__dataclass_fields__:
                raise AttributeError(f"{type(self).__name__} has no {name!r}", name=name, obj=self)
            value = getattr(self._result, name)
            self._set(**{name: value})
            return value

    @property
    def details(self) -> ResultT:
        """The result as the use case gave it, every field in the form of ``to_dict()``."""
        return self._result

    # Two of them with arrays cannot be compared; each is itself, and can be a key.
    __eq__ = object.__eq__
    __hash__ = object.__hash__


class Result(Frozen, ABC):
    """A finished result; SI throughout, pressures are gauge.

    ``print(result)`` gives what the command line prints, a notebook shows tables. ``to_dict()`` has the keys
    of the command line's ``--json``.
    """

    __slots__ = ()

    @abstractmethod
    def to_frame(self) -> pd.DataFrame:
        """The numbers as a pandas data frame, SI."""

    @abstractmethod
    def plot(self) -> Figure:
        """A Plotly figure with the look of the studio."""

    @abstractmethod
    def _answer(self) -> object:
        """What ``--json`` prints."""

    @abstractmethod
    def _summary(self) -> Summary:
        """Tables and sentences."""

    @abstractmethod
    def _title(self) -> str:
        """What it is, in one line."""

    def _lead(self) -> Sequence[str]:
        """The sentences to be read first."""
        return ()

    def to_dict(self) -> dict[str, Any]:
        """The result with the keys of ``--json``; NaN and infinity become None."""
        return json.loads(answer_json(self._answer()))

    @reported
    def save(self, path: str | PathLike[str]) -> None:
        """Write the result: ``.json`` as ``--json`` prints it, ``.csv`` the data frame.

        Raises:
            Problem: the file cannot be written, or its ending is neither.
        """
        write_text(Path(path), self._files(Path(path)))

    def _files(self, path: Path) -> str:
        """The content of a file with this ending."""
        if check_ending(path, (".json", ".csv")) == ".json":
            return answer_json(self._answer()).decode() + "\n"
        return csv_of(self.to_frame())

    def __str__(self) -> str:
        return plain_text(self._summary())

    def __repr__(self) -> str:
        return f"<{self._title()}>"

    def _repr_html_(self) -> str:
        return notebook_cell(self._title(), self._lead(), self._summary())


class ResultOf(Result, Holding[ResultT]):
    """A finished result with all fields of the result of a use case."""

    __slots__ = ()

    _name: str

    def _answer(self) -> object:
        return self._result
