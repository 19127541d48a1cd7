"""Summary of the answer to an inverse question."""

from __future__ import annotations

from mckibben.application.curves.inverse import InverseFinding
from mckibben.facts.muscle import INVERSE, INVERSE_DETAILS
from mckibben.report.summary import Summary, Table, shown


def summary_of(result: InverseFinding, muscle: str) -> Summary:
    """The answer with its details, and remarks.

    Args:
        result: the answer.
        muscle: name of the muscle, for the title.
    """
    rows = [[INVERSE[result.question].label, shown(INVERSE[result.question], result.value)]]
    rows += [[INVERSE_DETAILS[name].label, shown(INVERSE_DETAILS[name], value)]
             for name, value in result.details.items()]  # fmt: skip
    return [
        Table(f"{INVERSE.title}, {muscle} {result.branch}", ["", ""], rows),
        *(notice.message for notice in result.flags),
    ]
