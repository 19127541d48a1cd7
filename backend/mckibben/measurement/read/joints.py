"""Joints of two muscles: how they show in a file, and what can be done with them."""

from __future__ import annotations

from mckibben.measurement.question import Question
from mckibben.measurement.read.evidence import Evidence, bare_name
from mckibben.measurement.read.head_text import taken_apart
from mckibben.measurement.read.header import HeaderColumn
from mckibben.measurement.read.questions import column_option, ignore_option
from mckibben.measurement.read.unit_words import dimension_of

TORQUE = "an energy or a torque"
#: What stands on the rim of a pulley of 30 mm.
TORQUE_ON_RIM, ANGLE_ON_RIM = "0 to 3 Nm = 0 to 100 N", "0 to 90 deg = 0 to 47.1 mm"


def column_of(evidence: Evidence, dimension: str) -> str | None:
    """Name of the first column of numbers whose unit measures this and that nothing is read from."""
    used = {column.place for column in evidence.used.values()}
    for index, header in enumerate(evidence.headers):
        apart = evidence.apart[index] if index < len(evidence.apart) else None
        head = taken_apart(header, apart)
        unread = index not in used and index not in evidence.meaning.dismissed
        if unread and dimension_of(head.unit) == dimension and evidence.numeric(index):
            return head.name or header
    return None


def joint_message(evidence: Evidence, first: HeaderColumn, second: HeaderColumn) -> str:
    """What two pressures that run against each other are, and what to do instead of comparing them."""
    torque = column_of(evidence, TORQUE)
    angle = column_of(evidence, "an angle")
    rims = [
        column_option(channel, name, rim)
        for channel, name, rim in (("force", torque, TORQUE_ON_RIM), ("displacement", angle, ANGLE_ON_RIM))
        if name is not None
    ]
    read = f" ({', '.join(rims)} on a pulley of 30 mm)" if rims else ""
    return (
        f"'{bare_name(first)}' and '{bare_name(second)}' are pressures that run against each other, as in a "
        "joint of two muscles. What turns it is the difference of two forces of which neither was read, so a "
        'joint is not compared; its drive can be simulated (load arrangement "antagonist"). To compare its '
        "muscles, turn the joint with one of them vented and slack: torque over radius is then the force of "
        f"the other, radius times angle its stroke{read}"
    )


def beside_chosen(chosen: HeaderColumn, other: HeaderColumn) -> Question:
    """What is to be said where the user chose one of two pressures that run against each other."""
    return Question(
        "second pressure",
        f"'{bare_name(other)}' runs against '{bare_name(chosen)}', which you chose: if it is the pressure of "
        "a second muscle on the same joint, the force is that of both, and what is found here is none of one "
        "muscle",
        ignore_option(bare_name(other)),
        other.header,
        stops=False,
    )
