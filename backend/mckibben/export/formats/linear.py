"""Linear models of a drive at operating points: ``.mat`` and JSON."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import Any

from mckibben.application.linear.matlab import mat_file, matrices_of, point_fields, structures
from mckibben.application.linear.result import ModelResult
from mckibben.export.linear_models import LinearPoint, linear_points, main_point
from mckibben.export.registry import ExportedFile, Format
from mckibben.export.subject import Subject

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
