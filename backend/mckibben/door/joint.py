"""Joints: muscles on levers about one axis."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

from collections.abc import Mapping, Sequence
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any

import numpy as np

from mckibben.application.joint.joint import JointQuestion, JointResult, joint_statics
from mckibben.documents.joint import JointDocument, StatedJoint, joint_of, named_joint, read_joint
from mckibben.documents.joint_question import read_joint_question
from mckibben.door.frames import frame_of
from mckibben.door.problem import reported
from mckibben.door.result import Frozen, ResultOf
from mckibben.door.values import FloatArray, Quantities, Quantity, array_of
from mckibben.door.workspace import studio
from mckibben.physics.errors import InputError
from mckibben.report.summary import Summary
from mckibben.report.summary.joint import summary_of

if TYPE_CHECKING:
    import pandas as pd
    from plotly.graph_objects import Figure


class JointStatics(ResultOf[JointResult], JointResult):
    """A joint at rest, from `Joint.statics`; SI. Arrays are read-only."""

    def to_frame(self) -> pd.DataFrame:
        """One row for each set of pressures and angle, SI.

        Columns: set, angle_rad, torque_N*m, stiffness_N*m/rad, stiffness_closed_N*m/rad, and of each muscle
        pressure, lever and length.
        """
        sets, angles = len(self.pressures), len(self.angle)
        columns: dict[str, FloatArray] = {
            "set": np.repeat(np.arange(float(sets)), angles),
            "angle_rad": np.tile(self.angle, sets),
            "torque_N*m": self.torque.ravel(),
            "stiffness_N*m/rad": self.stiffness.ravel(),
            "stiffness_closed_N*m/rad": self.stiffness_closed.ravel(),
        }
        for place, muscle in enumerate(self.muscles):
            columns[f"pressure_{place + 1}_Pa"] = np.repeat(self.pressures[:, place], angles)
            columns[f"lever_{place + 1}_m"] = np.tile(muscle.lever, sets)
            columns[f"length_{place + 1}_m"] = np.tile(muscle.length, sets)
        return frame_of(columns)

    def plot(self) -> Figure:
        """Torque over angle, one curve for each set of pressures."""
        from mckibben.door.figures import joint_figure

        return joint_figure(self, f"Torque of {self._name}")

    def _summary(self) -> Summary:
        return summary_of(self, self._name)

    def _title(self) -> str:
        return f"{self._name} at rest, {len(self.pressures)} sets of pressures"


class Joint(Frozen):
    """Muscles on paths about one axis, with springs, a link, its bearing and stops.

    Torque of a muscle: M = r F with its lever r = -dL/d angle (virtual work); positive turns to greater
    angles. Joints do not change.

    Args:
        muscles: one document each, ``{"path": {"lever": "30 mm", "contraction": "10 %"}}``; a path is a
            lever (constant or a formula of ``angle``), a length, ``points`` or a ``table``.
        muscle: the muscle of all that state no own one, "DMSP-20:300mm".
        stops: ``{"min_angle": "-60 deg", "max_angle": "60 deg"}``.
        parts: further parts: spring, link, friction, effects, temperature, title.

    Raises:
        Problem: an unknown part, preset or effect, or a path that cannot be; names the field.
    """

    __slots__ = ("_document", "_name", "_stated")

    _document: JointDocument
    _name: str
    _stated: StatedJoint

    @reported
    def __init__(
        self,
        muscles: Sequence[Mapping[str, Any]],
        *,
        muscle: str | Mapping[str, Any] | None = None,
        stops: Mapping[str, Any] | None = None,
        title: str = "",
        **parts: Any,
    ) -> None:
        stated = {"muscles": [dict(each) for each in muscles], "muscle": muscle, "stops": stops, **parts}
        document = read_joint(
            {name: value for name, value in stated.items() if value is not None} | {"title": title}
        )
        self._make(document, title or "the joint")

    def _make(self, document: JointDocument, name: str) -> None:
        self._set(_document=document, _name=name, _stated=joint_of(document, studio()))

    @classmethod
    @reported
    def load(cls, path: str | PathLike[str]) -> Joint:
        """The joint of a file, or that of a drive of two muscles: a file or the id of a preset.

        Raises:
            Problem: names the file, the field, what is wrong and what would be right.
        """
        name = fspath(path)
        joint = cls.__new__(cls)
        joint._make(named_joint(name, studio()), name)
        return joint

    @property
    def document(self) -> dict[str, Any]:
        """The joint as a JSON document."""
        return dict(self._document.to_document())

    @property
    def stops(self) -> tuple[float, float]:
        """Angles between which it turns [rad]."""
        return self._stated.joint.low, self._stated.joint.high

    @reported
    def torque(self, *, angle: Quantities, pressures: Sequence[Quantities]) -> FloatArray:
        """Torque [N m] at angles and gauge pressures, one of each muscle; all of them broadcast.

        NaN where a muscle would be longer than its braid allows.

        Raises:
            Problem: not a pressure for each muscle, or shapes that do not fit together.
        """
        joint = self._stated.joint
        given = [array_of(one, "Pa", "pressures", "gauge") for one in pressures]
        _one_each(len(given), len(joint.muscles))
        return joint.torque(angle=array_of(angle, "rad", "angle"), pressures=given)

    @reported
    def lever(self, angle: Quantities, muscle: int = 0) -> FloatArray:
        """Lever [m] of a muscle, by its place, at angles."""
        return self._stated.joint.muscles[muscle].path.lever(array_of(angle, "rad", "angle"))

    @reported
    def length(self, angle: Quantities, muscle: int = 0) -> FloatArray:
        """Length [m] of a muscle, by its place, at angles."""
        return self._stated.joint.muscles[muscle].path.length(array_of(angle, "rad", "angle"))

    @reported
    def statics(
        self,
        pressures: Sequence[Sequence[Quantity] | str] | None = None,
        *,
        angle: Quantity | None = None,
        stiffness: Quantity | None = None,
        torque: Quantity | None = None,
        highest_pressure: Quantity | None = None,
        direction: int | None = None,
        points: int | None = None,
    ) -> JointStatics:
        """Torque and stiffness over the angle, resting angles, and pressures for an angle and a stiffness.

        Args:
            pressures: sets of gauge pressures, one of each muscle: ``["4 bar, 2 bar", "3 bar, 3 bar"]``.
            angle, stiffness: that the joint is to have; `answer` holds the pressures.
            torque: external, positive to greater angles.
            highest_pressure: that the muscles can be given; "6 bar" where it is left out.
            direction: sign of the motion, for friction.
            points: number of angles.

        Raises:
            Problem: names the argument, what is wrong and what would be right.
        """
        sets = (
            None if pressures is None else [own if isinstance(own, str) else list(own) for own in pressures]
        )
        asked = read_joint_question(
            {
                "pressures": sets, "angle": angle, "stiffness": stiffness, "torque": torque,
                "highest_pressure": highest_pressure, "direction": direction, "points": points,
            }
        )  # fmt: skip
        return JointStatics.of(joint_statics(JointQuestion(self._stated, asked)), _name=self._name)

    def __repr__(self) -> str:
        names = ", ".join(muscle.name for muscle in self._stated.joint.muscles)
        return f"<Joint {self._name}: {names}>"


def _one_each(given: int, muscles: int) -> None:
    if given != muscles:
        raise InputError(f"pressures: {given} for {muscles} muscles", hint="one for each")
