"""A joint at rest: torque and stiffness over its angle, where it rests, what its pressures can do."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from mckibben.application.muscle_summary import Notice, start_notices, stretch_notices
from mckibben.application.operating_limits import pressure_notices
from mckibben.documents.joint import StatedJoint
from mckibben.documents.joint_question import JointQuestionInput
from mckibben.facts.joint import JOINT_MUSCLE, JOINT_STATICS
from mckibben.facts.result import FiniteSeries, Rows, Series, result_class
from mckibben.physics.errors import InputError
from mckibben.simulation.statics.joint import Joint

_USUAL = (1e5, 2e5, 3e5, 4e5, 5e5, 6e5)
_HELD = 3e5  # of a third muscle where no pressures are stated
_REGION = 61  # angles of the reachable region


@dataclass(frozen=True, slots=True)
class JointQuestion:
    """A joint and what is asked of it."""

    stated: StatedJoint
    asked: JointQuestionInput


@result_class
class JointMusclePath:
    """A muscle along the angles of the joint."""

    FIGURES: ClassVar = JOINT_MUSCLE.name

    name: str
    """Name of the muscle."""
    lever: FiniteSeries
    length: FiniteSeries
    contraction: FiniteSeries


@result_class
class RestingAngle:
    """A stable angle of the joint under its pressures and the external torque."""

    pressures: FiniteSeries
    """Gauge pressures of the muscles [Pa]."""
    angle: float
    """The angle [rad]."""
    stiffness: float | None
    """Stiffness there, valves open [N*m/rad]; null beyond the braid lock of a muscle."""
    at_stop: bool
    """Whether a stop holds the joint there."""


@result_class
class JointRegion:
    """Stiffness that can be had at each angle, under the external torque."""

    FIGURES: ClassVar = JOINT_STATICS.name

    angle: FiniteSeries
    least_stiffness: Series
    most_stiffness: Series


@result_class
class JointPressures:
    """Pressures for the stated angle and stiffness."""

    angle: float
    """The stated angle [rad]."""
    stiffness: float | None
    """Stiffness with these pressures, valves open [N*m/rad]; null without an answer."""
    pressures: FiniteSeries | None
    """Gauge pressures of the muscles [Pa]; null where there are none."""
    least_stiffness: float | None
    """Least stiffness that can be had at this angle [N*m/rad]; null where the angle cannot be held."""
    most_stiffness: float | None
    """Largest stiffness that can be had at this angle [N*m/rad]; null where the angle cannot be held."""


@result_class
class JointResult:
    """A joint at rest; P sets of pressures, N angles, SI."""

    FIGURES: ClassVar = JOINT_STATICS.name

    muscles: list[JointMusclePath]
    """The muscles along the angles."""
    pressures: Rows
    """Gauge pressures of each set, shape (P, muscles) [Pa]."""
    angle: FiniteSeries
    torque: Rows
    stiffness: Rows
    stiffness_closed: Rows
    rests: list[RestingAngle]
    """Stable angles at each set of pressures; several where the joint can snap through."""
    region: JointRegion | None
    """Reachable stiffness over the angle; null of more than two muscles."""
    answer: JointPressures | None
    """Pressures for an angle and a stiffness; null where no angle is asked for."""
    flags: list[Notice]
    """Remarks: lengths and levers that disagree, limits that are crossed."""


def joint_statics(question: JointQuestion) -> JointResult:
    """The answer to a question about a joint.

    Raises:
        InputError: a set of pressures that is not one of each muscle, an angle beyond the stops, more than
            two muscles whose pressures are asked for.
    """
    joint, asked = question.stated.joint, question.asked
    sets = _pressures(joint, asked.pressures)
    angle = np.linspace(joint.low, joint.high, asked.points)
    states = [[joint.muscle_at(i, angle=angle, pressure=p) for i, p in enumerate(own)] for own in sets]
    region = None
    if len(joint.muscles) <= 2:
        at = np.linspace(joint.low, joint.high, _REGION)
        region = JointRegion(
            at, *joint.region(highest=asked.highest_pressure, angles=at, torque=asked.torque)
        )
    paths = [
        JointMusclePath(m.name, s.lever, s.length, 1.0 - s.length / float(m.model.muscle.nominal_length))
        for m, s in zip(joint.muscles, states[0], strict=True)
    ]
    return JointResult(
        muscles=paths,
        pressures=np.array(sets),
        angle=angle,
        torque=np.array(
            [joint.torque(angle=angle, pressures=own, direction=asked.direction) for own in sets]
        ),
        stiffness=np.array([joint.stiffness(angle=angle, pressures=own) for own in sets]),
        stiffness_closed=np.array([joint.stiffness(angle=angle, pressures=own, closed=True) for own in sets]),
        rests=[
            RestingAngle(np.array(own), rest.angle, _number(rest.stiffness), rest.at_stop)
            for own in sets
            for rest in joint.equilibria(pressures=own, torque=asked.torque)
        ],
        region=region,
        answer=None if asked.angle is None else _answer(joint, asked),
        flags=_flags(question, sets, paths),
    )


def _pressures(joint: Joint, stated: Sequence[Sequence[float]] | None) -> list[tuple[float, ...]]:
    count = len(joint.muscles)
    if stated is None:
        others = [_HELD] * (count - 2)
        return [
            ((one, two, *others) if count > 1 else (one,))
            for one, two in zip(_USUAL, _USUAL[::-1], strict=True)
        ]
    for place, own in enumerate(stated):
        if len(own) != count:
            raise InputError(
                f"{len(own)} pressures for {count} {'muscle' if count == 1 else 'muscles'}",
                field=f"pressures.{place}",
                hint=f"one for each of {', '.join(m.name for m in joint.muscles)}",
            )
    return [tuple(own) for own in stated]


def _answer(joint: Joint, asked: JointQuestionInput) -> JointPressures:
    angle = asked.angle
    assert angle is not None  # noqa: S101 - asked by its caller
    if not joint.low - 1e-12 <= angle <= joint.high + 1e-12:
        raise InputError(
            f"{np.degrees(angle):.4g} deg is beyond the stops, {np.degrees(joint.low):.4g} to "
            f"{np.degrees(joint.high):.4g} deg",
            field="angle",
        )
    if len(joint.muscles) > 2:
        raise InputError(
            "an angle and a stiffness do not determine the pressures of more than two muscles", field="angle"
        )
    found = joint.pressures_for(
        angle=angle, highest=asked.highest_pressure, stiffness=asked.stiffness, torque=asked.torque
    )
    pressures = np.array(found.pressures) if found.pressures else None
    value = None if pressures is None else float(joint.stiffness(angle=angle, pressures=found.pressures))
    return JointPressures(angle, _number(value), pressures, _number(found.least), _number(found.most))


def _number(value: float | None) -> float | None:
    return value if value is not None and np.isfinite(value) else None


def _flags(
    question: JointQuestion, sets: Sequence[Sequence[float]], paths: Sequence[JointMusclePath]
) -> list[Notice]:
    stated, asked = question.stated, question.asked
    found = [Notice("path", note, "muscles") for note in stated.notes]
    for place, (start, path) in enumerate(zip(stated.starts, paths, strict=True)):
        where = f"muscles.{place}.path"
        found += start_notices(start)
        found += stretch_notices(start, float(path.contraction.min()), where)
        most, longest = start.limits.max_contraction, stated.joint.muscles[place].model.longest
        if most is not None and path.contraction.max() > most + 1e-9:
            found.append(
                Notice(
                    "over_contraction_limit",
                    f"{path.name}: the path asks for a contraction of "
                    f"{100.0 * path.contraction.max():.3g} %, the maker's limit is {100.0 * most:.3g} %",
                    where,
                )
            )
        if path.length.max() > longest:
            beyond = path.length > longest
            found.append(
                Notice(
                    "beyond_lock",
                    f"{path.name}: at {np.count_nonzero(beyond)} of {len(beyond)} angles its path is longer "
                    f"than its braid allows ({1e3 * longest:.4g} mm): there is no torque",
                    where,
                )
            )
    found += pressure_notices({"pressures": min((p for own in sets for p in own if p > 0.0), default=0.0)})
    if asked.angle is not None and len(stated.joint.muscles) <= 2:
        found += _unanswered(question)
    unique = {(notice.code, notice.message): notice for notice in found}
    return list(unique.values())


def _unanswered(question: JointQuestion) -> list[Notice]:
    answer = _answer(question.stated.joint, question.asked)
    if answer.pressures is not None:
        return []
    degrees = np.degrees(answer.angle)
    if answer.least_stiffness is None:
        highest = f"{question.asked.highest_pressure / 1e5:.4g} bar"
        said = f"no pressures up to {highest} hold the joint at {degrees:.4g} deg"
        return [Notice("not_held", said, "angle")]
    said = (
        f"a stiffness of {question.asked.stiffness:.4g} N m/rad is out of reach at {degrees:.4g} deg: "
        f"{answer.least_stiffness:.4g} to {answer.most_stiffness:.4g} N m/rad"
    )
    return [Notice("stiffness_out_of_reach", said, "stiffness")]
