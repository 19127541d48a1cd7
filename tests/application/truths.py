"""Measurements with known truth: plateaus with wrong clamps, and specimens of several lengths."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import radians

import numpy as np

from tests.truth import elastomer, sensors
from tests.truth.composition import Hidden, Truth
from tests.truth.experiments import isobaric
from tests.truth.laboratory import usual_noise
from tests.truth.muscle import ROOM, Muscle

ANGLE, DIAMETER, WALL, BORE = radians(26.5), 0.0218, 0.0018, 0.02


def muscle(length: float) -> Muscle:
    """A 20 mm muscle of a length [m]."""
    return Muscle(length, DIAMETER, ANGLE, WALL, BORE)


def document(length: float | None = None) -> dict[str, str]:
    """The same muscle as a user gives it, with or without its length."""
    own = {
        "braid_diameter": f"{DIAMETER * 1e3} mm",
        "braid_angle": f"{ANGLE!r} rad",
        "wall_thickness": f"{WALL * 1e3} mm",
        "inside_diameter": f"{BORE * 1e3} mm",
    }
    return own if length is None else {**own, "nominal_length": f"{length * 1e3} mm"}


def wall(of: Muscle) -> Hidden:
    """The rubber of the wall, a Yeoh material."""
    return elastomer.bladder(of, elastomer.yeoh(0.3e6, -0.012e6, 0.004e6))


def plateaus(
    errors: np.ndarray, *, hidden: bool = False, length: float = 0.3, noise: float = 0.8, seed: int = 0
) -> str:
    """A file of forces at rest over pressure, without time, at lengths that were set on a rule.

    The file has the length that the rule shows, which is off by ``errors`` [m].
    """
    of = muscle(length)
    truth = Truth(of, hidden=(wall(of),) if hidden else ())
    random = np.random.default_rng(seed)
    rows = [f"# nominal_length: {length * 1e3:g} mm", "# kind: isometric", "length_mm,pressure_bar,force_N"]
    shown = length * (1.0 - np.linspace(0.02, 0.17, len(errors)))
    for at, error in zip(shown, errors, strict=True):
        pressure = np.linspace(1.5e5, 6e5, 25)
        true = np.full_like(pressure, at - error)
        force = truth.force(pressure, true, np.full_like(pressure, ROOM)) + random.normal(0.0, noise, 25)
        rows += [f"{at * 1e3:.3f},{p * 1e-5:.5f},{f:.3f}" for p, f in zip(pressure, force, strict=True)]
    return "\n".join(rows) + "\n"


def specimen(
    length: float,
    *,
    zero: float = 0.0,
    seed: int = 0,
    said: bool = True,
    walled: bool = True,
    steeper: float = 0.0,
    levels: Sequence[float] = (2e5, 4e5, 6e5),
) -> str:
    """A file of a slow tensile test at held pressures of a muscle of this length with a rubber wall.

    Args:
        length: at rest [m].
        zero: error of the force sensor [N].
        seed: of the noise.
        said: whether the file says its rest length; the stroke is a displacement.
        walled: whether it has the wall.
        steeper: its braid angle over that of the document [rad].
        levels: the pressures [Pa].
    """
    of = replace(muscle(length), angle=ANGLE + steeper)
    parts = (*((wall(of),) if walled else ()), *((sensors.zero_error("force", zero),) if zero else ()))
    truth = Truth(of, hidden=parts)
    random = np.random.default_rng(seed)
    record = isobaric(truth, levels=levels, rows=60)
    noise = usual_noise(truth, random, force=0.001)
    keep = record.kept
    force = truth.force(record.pressure, record.length, record.temperature)[keep] + zero
    force = force + random.normal(0.0, noise.levels["force"], len(force))
    stroke = of.nominal - record.length[keep] + random.normal(0.0, 2e-5, len(force))
    rows = [f"# nominal_length: {length * 1e3:g} mm"] if said else []
    rows += ["# kind: isobaric", "time_s,pressure_bar,displacement_mm,force_N"]
    rows += [
        f"{t:.4f},{p * 1e-5:.5f},{x * 1e3:.4f},{f:.3f}"
        for t, p, x, f in zip(record.time[keep], record.pressure[keep], stroke, force, strict=True)
    ]
    return "\n".join(rows) + "\n"
