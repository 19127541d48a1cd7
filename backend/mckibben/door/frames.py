"""Data frames from columns; pandas is imported when the first is made."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from mckibben.door.problem import reported
from mckibben.extras import of_extra

if TYPE_CHECKING:
    import pandas as pd


@reported
def frame_of(columns: Mapping[str, Any]) -> pd.DataFrame:
    """A frame with these columns; scalars are repeated."""
    return of_extra("pandas").DataFrame({name: np.array(values) for name, values in columns.items()})


@reported
def frame_of_rows(names: Sequence[str], rows: Sequence[Sequence[Any]]) -> pd.DataFrame:
    """A frame of rows."""
    return of_extra("pandas").DataFrame(list(rows), columns=list(names))


def csv_of(frame: pd.DataFrame) -> str:
    """The frame as CSV; numbers are written so that reading gives exactly the same."""
    index = any(name is not None for name in frame.index.names)
    text: str = frame.to_csv(index=index)
    return text
