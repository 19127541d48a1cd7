"""The model's figures against literature, catalogue curves and measured maps, printed by one command.

    python -m tests.benchmarks.figures

Blocked force of the source paper's muscle; the two force maps of Martens & Boblan with three physical
parameters fitted (from the built-in presets); the presets against the maker's sizing curves.
"""

from __future__ import annotations

from math import radians

import numpy as np
from rich.console import Console
from rich.table import Table

from mckibben.documents.start_model import StatedMuscle
from mckibben.documents.studio import Studio
from mckibben.measurement.points import find_preset
from mckibben.physics.ideal import blocked_force
from mckibben.physics.muscle import Muscle
from mckibben.resources import presets_folder
from tests.identification.comparing import compare

# The 6 bar blocked force of the maker's curves [N], by size.
FULL_SCALE = {"10": 473.3, "20": 1515.0, "40": 6203.0}
MAPS = (
    ("martens-dmsp-20-300", 0.296, 0.020),
    ("martens-dmsp-20-300", 0.300, 0.020),
    ("martens-dmsp-10-250", 0.250, 0.010),
)


def main() -> None:
    """Print the three tables."""
    studio = Studio(presets=presets_folder())
    console = Console(width=140)
    console.print(_blocked())
    console.print(_maps(studio))
    console.print(_sizing_curves(studio))


def _blocked() -> Table:
    table = Table("pressure", "blocked force", title="Ideal muscle, D0 10 mm, 25°")
    for pressure in (1e5, 3e5, 6e5):
        force = blocked_force(diameter=0.01, braid_angle=radians(25), pressure=pressure)
        table.add_row(f"{pressure / 1e6:g} MPa", f"{force:.2f} N")
    return table


def _maps(studio: Studio) -> Table:
    columns = ("map", "L0", "points", "ideal", "fitted", "left-out pressures", "C10", "F0", "braid angle")
    table = Table(*columns, title="Measured maps, neo-Hookean bladder + prestress + braid angle fitted")
    for name, length, bore in MAPS:
        points = find_preset(name, studio.library)
        if points is None:
            raise LookupError(f"no preset {name}")
        muscle = Muscle(length, bore + 0.0018, radians(25.5), 0.0018, bore)
        ideal = compare(points.measurement, muscle, {}, catalogue=studio.catalogue)
        effects = {"bladder_elasticity": {}, "prestress": {}}
        fitted = compare(
            points.measurement, muscle, effects, catalogue=studio.catalogue, fit=True, free=["braid_angle"]
        )
        values = fitted.fit_model.values
        table.add_row(
            name,
            f"{length * 1e3:.0f} mm",
            f"{len(fitted.predicted)} of {fitted.rows}",
            f"{ideal.nrmse_percent:.2f} %",
            f"{fitted.nrmse_percent:.3f} %",
            f"{100 * (fitted.holdout_rmse or 0) / fitted.full_scale:.2f} %",
            f"{values['bladder_elasticity']['shear_modulus'] / 1e6:.4f} MPa",
            f"{values['prestress']['force']:.1f} N",
            f"{np.degrees(fitted.fit_model.muscle.braid_angle):.2f}°",
        )
    return table


def _sizing_curves(studio: Studio) -> Table:
    columns = ("preset", "pulling points", "all, clipped at 0", "all, unclipped")
    table = Table(
        *columns, title="Presets against the maker's sizing curves, 0-25 %, RMS of the 6 bar blocked force"
    )
    for size, full_scale in FULL_SCALE.items():
        start = studio.start_model(StatedMuscle(preset=f"DMSP-{size}"), None)
        model = studio.static_model(start)
        curve = studio.library.get("curves", f"musclesim-{size}")
        data, used = curve.si_columns(), curve.used
        chosen = used & (data["contraction"] >= 0.0) & (data["contraction"] <= 0.25)
        state = {
            "pressure": data["pressure"][chosen],
            "length": start.muscle.nominal_length * (1.0 - data["contraction"][chosen]),
        }
        given, free = data["force"][chosen], model.force(**state, clipped=False)
        pulled = np.maximum(free, 0.0)
        errors = ((pulled - given)[given > 0.0], pulled - np.maximum(given, 0.0), free - given)
        table.add_row(f"DMSP-{size}", *(f"{100 * np.sqrt(np.mean(e**2)) / full_scale:.2f} %" for e in errors))
    return table


if __name__ == "__main__":
    main()
