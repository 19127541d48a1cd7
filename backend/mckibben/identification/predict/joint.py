r"""Torque of a joint over its angle, by the forces of its muscles at their levers.

.. math:: \tau = \sum_i r_i\,F_i(L_i, p_i) - \tau_{against}

A muscle that moves a load along a line is predicted by `QuasistaticPredictor` alone; a joint adds nothing to
its physics, only the levers of `mckibben.physics.joint`. So every row counts in torque, as it was measured: a
force that was made of a torque at a short lever is as uncertain as that lever makes it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import copy
from dataclasses import dataclass, replace

import numpy as np

from mckibben.identification.predict.comparable_rows import ComparableRows
from mckibben.identification.predict.evaluate import Evaluation
from mckibben.identification.predict.fit_model import FitModel, Free
from mckibben.identification.predict.predictor import PredictedChannel, Predictor, Reversals
from mckibben.identification.predict.quasistatic import QuasistaticPredictor
from mckibben.measurement.experiment import path_of_joint
from mckibben.measurement.measurement import Measurement
from mckibben.physics import joint
from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError
from mckibben.physics.joint import JOINT_SLOTS
from mckibben.physics.model import Model
from mckibben.physics.muscle_path import MusclePath

Array = np.ndarray


@dataclass(frozen=True, eq=False)
class JointRows:
    """What was measured of a joint, in all rows of the task of its first muscle.

    Attributes:
        angle: [rad]; 0 where none was measured.
        torque: [N m].
        lever: of the first muscle as stated, signed as its torque [m].
        direction: sign of the motion of the joint; 0 unknown or at rest.
        paths: of each muscle; empty where length and lever were measured in each row.
        angled: whether an angle was measured.
    """

    angle: Array
    torque: Array
    lever: Array
    direction: Array
    paths: tuple[MusclePath, ...]
    angled: bool

    @property
    def muscles(self) -> int:
        """Number of muscles."""
        return max(len(self.paths), 1)


def of_joint(measurement: Measurement) -> bool:
    """Whether a measurement is one of the torque of a joint whose levers are known.

    Raises:
        InputError: torque over angle without a lever.
    """
    columns = measurement.columns
    if "torque" not in columns:
        return False
    if "angle" in columns and "force" not in columns:
        raise InputError(
            f"{measurement.name}: the torque of a joint is compared by the lever of its muscle, which is not "
            f"stated",
            field="experiment.lever",
            hint='--experiment "lever=30 mm", or a formula, --experiment "lever=0.03 - 0.005*angle**2"; or a '
            "column 'moment arm [mm]'",
        )
    return "lever" in columns


def joint_rows(measurement: Measurement, task: ComparableRows) -> JointRows:
    """What was measured of a joint at the rows of a task."""
    state = task.state
    angled = "angle" in state
    angle = state.get("angle", np.zeros(len(task.measured)))
    torque, lever = state["torque"], state["lever"]
    path = path_of_joint(measurement.conditions, measurement.columns["angle"]) if angled else None
    paths: tuple[MusclePath, ...] = ()
    if path is not None:
        paths = (path,)
        if "counter_pressure" in state:
            paths = (path, mirrored(path))
    elif float(np.sum(torque * np.abs(lever) * task.measured)) < 0.0:
        lever = -np.abs(lever)  # a muscle pulls: levers without a sign have that of the torque
    else:
        lever = np.abs(lever)
    # The muscle shortens where the joint turns the way that it pulls.
    direction = -np.sign(lever) * state["direction"]
    return JointRows(angle, torque, lever, direction, paths, angled)


def mirrored(path: MusclePath) -> MusclePath:
    """The path of the second muscle of a pair: as that of the first one at the opposite angle."""
    return replace(
        path,
        length=lambda angle: path.length(-angle),
        lever=lambda angle: -path.lever(-angle),
        lever_slope=lambda angle: path.lever_slope(-angle),
        low=-path.high,
        high=-path.low,
    )


def stacked(task: ComparableRows, rows: JointRows) -> ComparableRows:
    """The rows of all muscles, one after the other, for the forces of them all."""
    if rows.muscles == 1:
        return task
    count = len(task.measured)
    second = rows.paths[1]
    state = {
        name: np.concatenate([values, values])
        for name, values in task.state.items()
        if name != "counter_pressure"
    }
    length = np.asarray(second.length(rows.angle), float)
    for name, own in (
        ("pressure", task.state["counter_pressure"]),
        ("length", length),
        ("direction", -task.state["direction"]),
        ("velocity", -task.state["velocity"]),
        ("lever", np.broadcast_to(np.asarray(second.lever(rows.angle), float), (count,))),
    ):
        state[name] = np.concatenate([task.state[name], own])

    def twice(values: Array) -> Array:
        return np.concatenate([values, values])

    def numbered(labels: Array) -> Array:
        return np.concatenate([labels, labels + int(labels.max()) + 1])

    return replace(
        task,
        measured=np.zeros(2 * count),  # no force was measured; a slack muscle has none
        state=state,
        time=None if task.time is None else twice(task.time),
        records=numbered(task.records),
        groups=numbered(task.groups),
        turning=twice(task.turning),
        rows=twice(task.rows),
        by_rest_length=0.0,
        corners=None,
        reversing=None,
    )


class JointPredictor(Predictor):
    """Predicts the torque of a joint.

    Args:
        task: the comparable rows of its first muscle, whose force is torque over lever.
        rows: what was measured of the joint at these rows.
        largest_load: see `QuasistaticPredictor`.
    """

    def __init__(self, task: ComparableRows, rows: JointRows, *, largest_load: float = 0.0) -> None:
        first = QuasistaticPredictor(task, largest_load=largest_load)
        both = stacked(task, rows)
        self._inner = first if both is task else QuasistaticPredictor(both, largest_load=largest_load)
        if both is not task:
            self._inner = self._inner.after(("rest",))
        self._rows = rows
        self._counted = first._counted
        self.kind = first.kind
        self.measured = rows.torque[self._counted]
        self.scale = np.ones(len(self.measured))
        full_scale = float(np.max(np.abs(self.measured)))
        self.channels = (PredictedChannel("torque", "N*m", slice(None), 1.0, full_scale),)
        self.folds, self.groups, self.records = first.folds, first.groups, first.records
        self.row_numbers, self.sweeps = first.row_numbers, first.sweeps
        self.inputs = {name: values for name, values in first.inputs.items() if name != "torque"}
        self.rows_used, self.excluded, self.messages = first.rows_used, first.excluded, first.messages

    def why_hidden(self, effect: Effect) -> str:
        """Effects of the joint show at a joint; its angle only where lever and length follow from it."""
        if not set(effect.slots) <= JOINT_SLOTS:
            return self._inner.why_hidden(effect)
        if "joint_angle" in effect.slots and not self._rows.paths:
            return "length and lever were measured in each row, so that an error of the angle changes neither"
        if "joint_torque" in effect.slots:
            wanted = effect.wanted("joint_torque")
            if "angle" in wanted and not self._rows.angled:
                return "it depends on the angle, and none was measured"
            if "direction" in wanted and not np.any(self._rows.direction):
                return "it depends on the direction of the motion, which the rows do not show"
        return ""

    def prepared(self, fit_model: FitModel, candidates: Sequence[Effect]) -> JointPredictor:
        """With one compiled model for the muscles of all candidates."""
        return self._of(self._inner.prepared(fit_model, [e for e in candidates if not _of_joint(e)]))

    def trial(self, fit_model: FitModel) -> Array:
        """As `predict`, by the quickest method."""
        inner, levers, against = self._at(fit_model)
        return self._folded(inner.trial(_of_muscles(fit_model)), levers) - against

    def predict(self, fit_model: FitModel, *, clipped: bool = True) -> Array:
        """Torque of each row [N m]."""
        inner, levers, against = self._at(fit_model)
        return self._folded(inner.predict(_of_muscles(fit_model), clipped=clipped), levers) - against

    def linearised(self, fit_model: FitModel, free: Sequence[Free]) -> tuple[Array, Array]:
        """Torques; exact derivatives by what acts on the muscles, differences by what acts on the joint."""
        ids = {effect.id for effect in fit_model.effects if _of_joint(effect)}
        of_muscles = [p for p in free if p.name.partition(".")[0] not in ids]
        inner, levers, against = self._at(fit_model)
        forces, slopes = inner.linearised(_of_muscles(fit_model), of_muscles)
        gradient = np.empty((len(self.measured), len(free)))
        for column, parameter in enumerate(free):
            if parameter in of_muscles:
                gradient[:, column] = self._folded(slopes[:, of_muscles.index(parameter)], levers)
                continue
            _, low, high = self.ends(fit_model, parameter, self.step)
            ends = [
                self.predict(fit_model.with_numbers([parameter.name], [end]), clipped=False)
                for end in (low, high)
            ]
            gradient[:, column] = (ends[1] - ends[0]) / (high - low)
        return self._folded(forces, levers) - against, gradient

    def slopes(self, fit_model: FitModel, free: Sequence[Free], here: Array | None = None) -> Array:
        """As of the base class, mostly exact ones."""
        del here
        return self.linearised(fit_model, free)[1]

    def input_slope(self, fit_model: FitModel, channel: str) -> Array:
        """That of the forces at their levers; of the lever itself the force."""
        inner, levers, _ = self._at(fit_model)
        if channel == "lever":
            forces = inner.predict(_of_muscles(fit_model)).reshape(self._rows.muscles, -1)
            return forces[0]
        return self._folded(inner.input_slope(_of_muscles(fit_model), channel), levers)

    def at_reversals(self, fit_model: FitModel) -> Reversals | None:
        """Those of a single muscle at its lever, with the friction of the bearing."""
        if self._rows.muscles > 1:
            return None
        inner, levers, _ = self._at(fit_model, every=True)
        found, rows = inner.at_reversals(_of_muscles(fit_model)), inner.task.reversing
        if found is None or rows is None:
            return None
        # The muscle shortens, and the joint turns the way that it pulls; or both the other way.
        lever, ends = levers[0][rows], []
        for force, way in ((found.low, 1.0), (found.high, -1.0)):
            against = self._against(fit_model, way * np.sign(self._rows.lever))[rows]
            ends.append(lever * force - against)
        return replace(
            found,
            measured=self._rows.torque[rows],
            low=np.minimum(*ends),
            high=np.maximum(*ends),
            unit="N*m",
        )

    def _against(self, fit_model: FitModel, direction: Array) -> Array:
        """Torque against the muscles in all rows, in a direction of the joint."""
        effects = [effect for effect in fit_model.effects if _of_joint(effect)]
        against = joint.torque_against(
            model=Model(effects), values=fit_model.values, angle=self._rows.angle, direction=direction
        )
        return np.broadcast_to(np.asarray(against, float), (len(self._rows.torque),))

    def reading(self, values: Array) -> JointPredictor:
        """This predictor of other torques at the same inputs."""
        torque = self._rows.torque.copy()
        torque[self._counted] = values
        rows = replace(self._rows, torque=torque)
        inner = self._inner
        if rows.muscles == 1:
            inner = inner.reading(values / rows.lever[self._counted])
        other = self._of(inner)
        other._rows, other.measured = rows, values
        return other

    def history(self, fit_model: FitModel) -> tuple[str, ...]:
        """Of the muscles."""
        return self._inner.history(_of_muscles(fit_model))

    def histories(self, effects: Sequence[Effect]) -> tuple[tuple[str, ...], ...]:
        """Of the muscles; the forces of two cannot tell one from the other."""
        if self._rows.muscles > 1:
            return (("rest",),)
        return self._inner.histories([effect for effect in effects if not _of_joint(effect)])

    def after(self, history: tuple[str, ...]) -> JointPredictor:
        """This predictor with a history that does not depend on the model."""
        return self._of(self._inner.after(history)) if history else self

    def lost(self, fit_model: FitModel) -> tuple[int, int]:
        """Those of the muscles."""
        return self._at(fit_model)[0].lost(_of_muscles(fit_model))

    def follows(self, fit_model: FitModel, free: Sequence[Free]) -> bool:
        """Forces are never followed row by row."""
        del fit_model, free
        return False

    def _of(self, inner: QuasistaticPredictor) -> JointPredictor:
        other = copy(self)
        other._inner = inner
        return other

    def _at(
        self, fit_model: FitModel, *, every: bool = False
    ) -> tuple[QuasistaticPredictor, list[Array], Array]:
        """The forces at the true lengths, the true levers of each muscle, and the torque against them.

        Args:
            fit_model: its effects of the joint say what is true.
            every: levers and torque of all rows, not only of those that are scored.
        """
        rows, count = self._rows, len(self._rows.torque)
        effects = [effect for effect in fit_model.effects if _of_joint(effect)]
        model, values = Model(effects), fit_model.values
        state = self._inner.task.state
        counted = np.ones(count, bool) if every else self._counted
        levers, lengths = [], []
        for place in range(rows.muscles):
            path = rows.paths[place] if rows.paths else None
            if not effects and not place:
                found = joint.Held(state["length"][:count], rows.lever)
            else:
                found = joint.held(
                    model=model, values=values, angle=rows.angle, path=path,
                    length=state["length"][place * count : (place + 1) * count], lever=rows.lever,
                )  # fmt: skip
            levers.append(np.broadcast_to(np.asarray(found.lever, float), (count,))[counted])
            lengths.append(np.broadcast_to(np.asarray(found.length, float), (count,)))
        against = self._against(fit_model, rows.direction)[counted]
        inner = self._inner
        if any({"joint_angle", "joint_lever"} & set(effect.slots) for effect in effects) and rows.paths:
            inner = _at_lengths(inner, np.concatenate(lengths))
        return inner, levers, against

    def _folded(self, forces: Array, levers: Sequence[Array]) -> Array:
        """Sum of forces times levers, of forces stacked over the muscles."""
        parts = zip(levers, np.split(forces, len(levers)), strict=True)
        return np.sum([lever * part for lever, part in parts], axis=0)


def _at_lengths(inner: QuasistaticPredictor, length: Array) -> QuasistaticPredictor:
    """The same rows at other lengths."""
    other = copy(inner)
    other._cornered = None
    state: Mapping[str, Array] = {**inner.task.state, "length": length}
    other.task = replace(inner.task, state=state)
    pinned = inner._evaluation._known_history
    other._evaluation = Evaluation(other.task)
    if pinned is not None:
        other._evaluation = other._evaluation.after(pinned)
    return other


def _of_joint(effect: Effect) -> bool:
    return set(effect.slots) <= JOINT_SLOTS


def _of_muscles(fit_model: FitModel) -> FitModel:
    """The model without what acts on the joint."""
    if not any(map(_of_joint, fit_model.effects)):
        return fit_model
    return replace(fit_model, effects=tuple(effect for effect in fit_model.effects if not _of_joint(effect)))
