"""Linear models of a drive at operating points: ``.mat`` and JSON."""

from __future__ import annotations

import json
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from mckibben.application.linear.matlab import mat_file, matrices_of, point_fields, structures
from mckibben.application.linear.result import ModelResult, PointResult, model_result, point_of
from mckibben.export.registry import ExportedFile, Format
from mckibben.export.subject import RunnableDrive, Subject
from mckibben.physics.errors import InputError
from mckibben.simulation.linear.bound import BoundDrive
from mckibben.simulation.linear.equations import COMMAND, POSITION
from mckibben.simulation.linear.linearise import linearise
from mckibben.simulation.linear.point import Condition, held_positions
from mckibben.simulation.linear.response import frequencies_for

# Places between the lowest and the highest position that can be held; the first that has one is the main one.
SHARES = (0.5, 0.1, 0.3, 0.7, 0.9)


@dataclass(frozen=True)
class LinearPoint:
    """An operating point with its models, the main one first marked as ``primary``.

    Attributes:
        share: place between the lowest and the highest position that can be held.
        lost: what the models do not contain, sentences.
    """

    share: float
    point: PointResult
    smooth: bool
    models: list[ModelResult]
    lost: tuple[str, ...]

    @property
    def primary(self) -> ModelResult:
        """The model that loop and design use."""
        return next(model for model in self.models if model.primary)


def linear_points(runnable: RunnableDrive) -> tuple[list[LinearPoint], list[str]]:
    """Models at the places of `SHARES` in rising order, and why one is missing.

    Raises:
        InputError: the load does not move, or no place has an equilibrium.
    """
    drive = runnable.drive
    try:
        with np.errstate(all="ignore"):
            low, high = held_positions(BoundDrive(drive))
    except InputError as error:
        raise _refused(error) from error
    found: list[LinearPoint] = []
    missing: list[str] = []
    last: InputError | None = None
    for share in sorted(SHARES):
        position = low + share * (high - low)
        try:
            linear = linearise(drive, Condition("position", position))
        except InputError as error:
            missing.append(f"A model at {position * 1e3:.4g} mm: {error.message}.")
            last = error
            continue
        with np.errstate(all="ignore"):
            axis = frequencies_for(linear.primary)
            models = [model_result(linear, each, COMMAND.name, POSITION.name, axis) for each in linear.models]
        found.append(LinearPoint(share, point_of(linear), linear.smooth, models, linear.lost))
    if last is not None and not found:
        raise _refused(last)
    return found, missing


def _refused(error: InputError) -> InputError:
    return InputError(f"there is no linear model: {error.message}", field="as", hint=error.hint)


def main_point(points: list[LinearPoint]) -> LinearPoint:
    """The point in the middle, or the next one that there is."""
    return min(points, key=lambda each: SHARES.index(each.share))


_MEANT = "Deviations from an operating point in SI: dx/dt = A x + B u, y = C x + D u; poles in rad/s."
_RESPONSES = ("gain", "phase", "zeros", "static_gain", "bandwidth", "bandwidth_note")


def write(subject: Subject, stem: str) -> tuple[ExportedFile, ...]:
    """The same models as a MATLAB file and as JSON."""
    drive = subject.runnable
    assert drive is not None  # noqa: S101 - `Format.muscles`
    points, missing = linear_points(drive)
    main = main_point(points)
    # What all points lose is said with each of them: their numbers differ.
    left_out = [f"At {main.point.position * 1e3:.4g} mm: {sentence}" for sentence in main.lost] + missing
    notes = [_MEANT, *subject.about.lines(left_out)]
    matlab: dict[str, Any] = {
        "about": "\n".join(notes),
        "model": f"{main.primary.name} at {main.point.position * 1e3:.4g} mm: {main.primary.text}",
        **matrices_of(main.primary),
        "points": structures(point_fields(each.point, each.models, each.lost) for each in points),
    }
    content = {
        "schema": 1,
        "kind": "linear",
        "about": asdict(subject.about),
        "meaning": _MEANT,
        "missing": missing,
        "points": [_point(each) for each in points],
    }
    text = json.dumps(content, indent=1, ensure_ascii=False, allow_nan=False)
    return (
        ExportedFile(f"{stem}.mat", mat_file(matlab), "application/x-matlab-data"),
        ExportedFile.of_text(f"{stem}.json", text, "application/json"),
    )


def _point(each: LinearPoint) -> dict[str, Any]:
    return {
        "point": asdict(each.point),
        "smooth": each.smooth,
        "lost": list(each.lost),
        "models": [_model(model) for model in each.models],
    }


def _model(model: ModelResult) -> dict[str, Any]:
    """Without the responses of a channel: the matrices have all channels."""
    content = {name: value for name, value in asdict(model).items() if name not in _RESPONSES}
    return {**content, **{name: getattr(model, name).tolist() for name in ("a", "b", "c", "d")}}


FORMAT = Format(
    title="Linear models",
    note="matrices of a drive at five positions, .mat and JSON",
    write=write,
    muscles=False,
    alternatives=True,
)
