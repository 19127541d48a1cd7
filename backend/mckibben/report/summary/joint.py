"""Summary of a joint at rest."""

from __future__ import annotations

import numpy as np

from mckibben.application.joint.joint import JointResult
from mckibben.facts.joint import JOINT_MUSCLE, JOINT_STATICS
from mckibben.report.summary import Summary, Table, figure, shown

_TABLE_ROWS = 9


def summary_of(result: JointResult, name: str) -> Summary:
    """Paths, torque and stiffness over the angle, resting angles, what was asked for, remarks.

    Args:
        result: the joint.
        name: of the joint, for the title.
    """
    chosen = np.unique(np.linspace(0, len(result.angle) - 1, _TABLE_ROWS).astype(int))
    angles = [shown(JOINT_STATICS["angle"], result.angle[row]) for row in chosen]
    sets = [" / ".join(f"{pressure / 1e5:g}" for pressure in own) + " bar" for own in result.pressures]
    tables: Summary = [
        Table(
            f"{JOINT_MUSCLE.title}: {muscle.name}",
            [JOINT_STATICS["angle"].label, *(figure.label for figure in JOINT_MUSCLE.values())],
            [
                [angle, *(shown(JOINT_MUSCLE[each], getattr(muscle, each)[row]) for each in JOINT_MUSCLE)]
                for angle, row in zip(angles, chosen, strict=True)
            ],
        )
        for muscle in result.muscles
    ]
    for what in ("torque", "stiffness", "stiffness_closed"):
        scale = JOINT_STATICS[what].scale
        rows = [
            [angle, *(figure(scale.of(values[row])) for values in getattr(result, what))]
            for angle, row in zip(angles, chosen, strict=True)
        ]
        title = f"{JOINT_STATICS[what].label}, {name} [{scale.unit}]"
        tables.append(Table(title, [JOINT_STATICS["angle"].label, *sets], rows))
    by_set = dict(zip((tuple(own) for own in result.pressures), sets, strict=True))
    rests = [
        [
            by_set[tuple(rest.pressures)],
            shown(JOINT_STATICS["angle"], rest.angle) + (", at the stop" if rest.at_stop else ""),
            shown(JOINT_STATICS["stiffness"], rest.stiffness),
        ]
        for rest in result.rests
    ]
    labels = [JOINT_STATICS[each].label for each in ("angle", "stiffness")]
    tables.append(Table("Where the joint rests", ["pressures", *labels], rests))
    if result.answer is not None and result.answer.pressures is not None:
        own = " / ".join(f"{pressure / 1e5:.4g}" for pressure in result.answer.pressures)
        tables.append(
            f"at {shown(JOINT_STATICS['angle'], result.answer.angle)}: {own} bar, stiffness "
            f"{shown(JOINT_STATICS['stiffness'], result.answer.stiffness)} "
            f"(can be had: {shown(JOINT_STATICS['least_stiffness'], result.answer.least_stiffness)} to "
            f"{shown(JOINT_STATICS['most_stiffness'], result.answer.most_stiffness)})"
        )
    return [*tables, *(notice.message for notice in result.flags)]
