"""Sources of figures, their grades, and what the grades mean."""

from __future__ import annotations

from typing import NamedTuple

from mckibben.physics.parameter import GRADES, UNVERIFIED_GRADES
from mckibben.report.document import Head, mark, table
from mckibben.report.html import Html, html


class Figure(NamedTuple):
    """Short source and grade of a figure."""

    source: str
    grade: str

    @property
    def verified(self) -> bool:
        """Whether the figure was read in a source or computed from one."""
        return self.grade not in UNVERIFIED_GRADES


def source_text(figure: Figure) -> Html:
    """Source and grade of a figure, marked if it was not verified."""
    text = f"{figure.source} (grade {figure.grade}: {GRADES.get(figure.grade, 'unknown')})"
    return html(text) if figure.verified else html(text, " ", mark("not verified"))


def grades_table() -> Html:
    """What each grade means."""
    rows = [
        [grade, meaning, mark("no") if grade in UNVERIFIED_GRADES else "yes"]
        for grade, meaning in GRADES.items()
    ]
    return table([Head("Grade"), Head("Meaning"), Head("Verified")], rows)
