"""The paper's equations and figures: where each is in the product, our numbers beside the printed ones.

    python -m tests.benchmarks.paper

prints the tables of ``backend/mckibben/physics/PAPER.md``. The printed side is evaluated here as it stands in
the paper, misprints included, and shares no code with the physics.
"""

from __future__ import annotations

import sys
from math import cos, pi, radians, sin, sqrt, tan

import numpy as np

from mckibben.documents.start_model import StatedMuscle
from mckibben.physics import braid as geometry
from mckibben.physics import ideal
from tests.benchmarks.paper_figures import ANSWER, Row, cm3, figures, joule, mm, newton, per_mm, studio

# The muscle of figure 9: its blocked forces are the only static numbers that the paper prints.
D0, THETA, L0, P = 0.010, radians(25.0), 0.100, 6e5
B, N = L0 / cos(THETA), L0 * tan(THETA) / (pi * D0)
L_MIN = B / sqrt(3.0)
SIDE, ALONG = 1e-3, B / 2e-3  # rhombi of 1 mm
BRAID = geometry.Braid(B, N)
_GEOMETRY = {"braid_diameter": D0, "braid_angle": THETA, "nominal_length": L0}


def _muscle_force(
    length: float, pressure: float, velocity: float = 0.0, **effects: dict[str, float]
) -> float:
    """Force of the muscle above with effects [N]."""
    model = studio().static_model(studio().start_model(StatedMuscle(**_GEOMETRY), effects))
    direction = float(np.sign(velocity))
    return float(model.force(length=length, pressure=pressure, velocity=velocity, direction=direction)[0])


def equations() -> list[Row]:
    """A row for each of the 25 equations, of the muscle with D0 = 10 mm, 25°, 100 mm at 6 bar."""
    volume = float(geometry.volume(braid=BRAID, length=L0))
    force = float(ideal.force(braid=BRAID, pressure=P, length=L0))
    work = float(ideal.max_work(braid=BRAID, pressure=P, length=L0))
    length = np.linspace(L_MIN, L0, 20001)
    pull = np.asarray(ideal.force(braid=BRAID, pressure=P, length=length))
    work_out = float(np.sum(0.5 * (pull[1:] + pull[:-1]) * np.diff(length)))
    step = 1e-6
    by_length = [float(geometry.volume(braid=BRAID, length=L0 + s)) for s in (step, -step)]
    tangent = float(ideal.stiffness(braid=BRAID, pressure=P, length=L0))
    from_force = float(ideal.stiffness_from_force(braid=BRAID, force=force, length=L0))
    secant = float(ideal.stiffness_secant(force=force, length=L0, shortest=L_MIN))
    rhombus = geometry.braid_from_rhombus(side=SIDE, along=ALONG, around=ALONG / N)
    closed = float(ideal.stiffness_closed(braid=BRAID, pressure=P, length=L0))
    printed_10 = P * B**2 * (2.0 * cos(THETA) ** 2 - sin(THETA) ** 2) / (4.0 * pi * N)
    printed_18 = P * B**2 / (4.0 * pi * N**2) * (3.0 * L0**2 / B**2 - 1.0)
    spring, damper, coulomb, speed = 25.2e3, 10.0, 5.0, 0.1
    stretched = L0 + 1e-3
    braided = {"braid_stiffening": {"stiffness": spring, "onset": 0.0}}
    taut, slack = (_muscle_force(at, P, **braided) - _muscle_force(at, P) for at in (stretched, 0.095))
    weaker = _muscle_force(L0, P, effectiveness={"factor": 0.9, "threshold": 0.0})
    outside = _muscle_force(0.99 * L_MIN, P)
    cosine = cos(float(geometry.angle(braid=BRAID, length=L0)))
    sine = sin(float(geometry.angle(braid=BRAID, length=L0)))
    expelled = P * (float(geometry.volume(braid=BRAID, length=L_MIN)) - volume)
    by_area = P * float(ideal.area(braid=BRAID, length=L0))
    by_volume = -P * (by_length[0] - by_length[1]) / (2.0 * step)
    moving = _muscle_force(
        L0, P, speed, viscous_damping={"coefficient": damper}, coulomb_friction={"force": coulomb}
    )
    braid_, ideal_ = "mckibben.physics.braid", "mckibben.physics.ideal"
    return [
        Row("1", (f"{braid_}.angle", f"{ANSWER} length"), mm(B * cosine), mm(B * cos(THETA))),
        Row(
            "2",
            (f"{braid_}.diameter", f"{ANSWER} diameter"),
            mm(geometry.diameter(braid=BRAID, length=L0)),
            mm(B * sin(THETA) / (N * pi)),
        ),
        Row(
            "3",
            (f"{braid_}.volume", f"{ANSWER} volume"),
            cm3(volume),
            f"{B**2 / (N * pi) * sin(THETA) ** 2 * cos(THETA) * 1e4:.3f} cm², no volume",
        ),
        Row("4", (f"{ideal_}.max_work",), joule(work), "the same integral, with scalars for vectors"),
        Row("5", (f"{ideal_}.max_work",), f"{joule(expelled)}, P ΔV from L to L_min", "the same, no number"),
        Row(
            "6",
            (f"{ANSWER} characteristics.max_work",),
            f"{joule(work_out)}, ∫F dL over the same way",
            "the same, no number",
        ),
        Row("7", (f"{ANSWER} characteristics.max_work",), f"{joule(work - work_out)} apart", "0"),
        Row("8", (f"{ideal_}.area",), f"{newton(by_area)}, P times −dV/dL", "the same, no number"),
        Row(
            "9",
            (f"{ideal_}.area", "mckibben.physics.model.Model"),
            f"{newton(by_volume)}, by differences of V",
            "the same, no number",
        ),
        Row("10", (f"{ideal_}.force", f"{ANSWER} force"), newton(force), f"{newton(printed_10)}: n for n²"),
        Row(
            "11",
            (f"{braid_}.braid_from_rhombus", f"{ANSWER} geometry.rhombus.along"),
            mm(rhombus.thread_length * cos(THETA)),
            f"{2.0 * ALONG * cos(THETA):.2f} without unit: ℓ is missing",
        ),
        Row(
            "12",
            (f"{braid_}.braid_from_rhombus", f"{ANSWER} geometry.rhombus.around"),
            mm(pi * float(geometry.diameter(braid=rhombus, length=L0))),
            f"{2.0 * ALONG / N * sin(THETA):.2f} without unit: ℓ is missing",
        ),
        Row(
            "13",
            (f"{braid_}.braid_from_rhombus", f"{ANSWER} geometry.thread_length"),
            mm(rhombus.thread_length),
            mm(2.0 * ALONG * SIDE),
        ),
        Row(
            "14",
            (f"{braid_}.braid_from_rhombus", f"{ANSWER} geometry.turns"),
            f"{rhombus.turns:.4f}",
            f"{ALONG / (ALONG / N):.4f}",
        ),
        Row("15", (f"{braid_}.angle", f"{ANSWER} braid_angle"), f"{cosine:.4f}", f"{L0 / B:.4f}"),
        Row(
            "16", (f"{braid_}.angle", f"{ANSWER} braid_angle"), f"{sine:.4f}", f"{sqrt(B**2 - L0**2) / B:.4f}"
        ),
        Row(
            "17",
            (f"{braid_}.volume", f"{ANSWER} volume"),
            cm3(volume),
            cm3(L0 * (B**2 - L0**2) / (4.0 * pi * N**2)),
        ),
        Row("18", (f"{ideal_}.force", f"{ANSWER} force"), newton(force), newton(printed_18)),
        Row(
            "19",
            (f"{ideal_}.stiffness", f"{ANSWER} stiffness", f"{ANSWER} stiffness_closed"),
            f"{per_mm(tangent)}; valve closed {per_mm(closed)}",
            per_mm(3.0 * L0 * P / (2.0 * pi * N**2)),
        ),
        Row(
            "20",
            (
                f"{ideal_}.stiffness_from_force",
                f"{ANSWER} stiffness_from_force",
                "mckibben.door.curves.Curves.stiffness_from_force",
            ),
            per_mm(from_force),
            per_mm(6.0 * L0 / (3.0 * L0**2 - B**2) * printed_18),
        ),
        Row(
            "21",
            ("backend/mckibben/physics/effects/effectiveness.py",),
            f"{newton(weaker)} with E_f = 0.9",
            newton(0.9 * printed_18),
        ),
        Row(
            "22",
            (
                "backend/mckibben/physics/effects/effectiveness.py",
                "backend/mckibben/physics/effects/braid_stiffening.py",
            ),
            f"{newton(outside)} below L_min",
            "0; above it F_max is not defined",
        ),
        Row(
            "23",
            ("backend/mckibben/physics/effects/braid_stiffening.py",),
            f"{newton(taut)} at L_max + 1 mm, {newton(slack)} at L_max − 5 mm (25.2 N/mm)",
            f"{newton(spring * 1e-3)} and {newton(spring * -5e-3)}: it pushes",
        ),
        Row(
            "24",
            (
                "backend/mckibben/physics/effects/viscous_damping.py",
                "backend/mckibben/physics/effects/coulomb_friction.py",
            ),
            f"{newton(moving)} lengthening at 0.1 m/s (c = 10 N·s/m, Q_k = 5 N)",
            f"{newton(printed_18 + damper * speed + coulomb)} with Q_k for Q·k, which is no force",
        ),
        Row(
            "25",
            (
                f"{ideal_}.stiffness_secant",
                f"{ANSWER} stiffness_secant",
                "mckibben.door.curves.Curves.stiffness_secant",
            ),
            per_mm(secant),
            per_mm((printed_18 - 0.0) / (L0 - L_MIN)),
        ),
    ]


def table(head: str, rows: list[Row]) -> str:
    """The rows in Markdown."""
    lines = [f"| {head} | where it is | ours | printed |", "|---|---|---|---|"]
    for row in rows:
        where = ", ".join(f"`{place}`" for place in row.where)
        lines.append(f"| {row.number} | {where} | {row.ours} | {row.printed} |")
    return "\n".join(lines)


def main() -> int:
    """Print both tables."""
    sys.stdout.write(table("equation", equations()) + "\n\n" + table("figure", figures()) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
