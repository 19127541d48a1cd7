"""The diagnosis on real measurements, beside a formula from the literature fitted to the same points:

    python -m tests.benchmarks.measured [--data FOLDER]

Force maps of Martens & Boblan (Actuators 6 (2017) 33) from the ideal muscle with nominal geometry, and the slow
pressure-displacement loop of the paper's bench. The formula is Sarosi's with five parameters,
F = (p + a1) exp(a2 k) + a3 k p + a4 p + a5, p in bar, k in %.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

from mckibben.identification.diagnosis import Diagnosis, diagnose
from mckibben.identification.read import read_measurement
from mckibben.identification.setting import Setting, free_geometry
from mckibben.identification.subjects import subject_of
from mckibben.physics.catalogue import default_catalogue
from mckibben.resources import presets_folder
from mckibben.studio import Studio

DATA = Path(__file__).parents[3] / "shared" / "data"
MAPS = (("DMSP-20-300", "DMSP-20", 0.3), ("DMSP-10-250", "DMSP-10", 0.25))
LOOP = "dmsp_pressure_displacement_hysteresis.csv"


def sarosi(pressure: np.ndarray, contraction: np.ndarray, force: np.ndarray) -> tuple[float, float]:
    """Rms error of the formula [N]: fitted to all points, and over pressures that were left out."""
    p, k = pressure / 1e3, 100.0 * contraction

    def misfit(a: np.ndarray, rows: np.ndarray) -> np.ndarray:
        modelled = (p[rows] + a[0]) * np.exp(a[1] * k[rows]) + a[2] * k[rows] * p[rows] + a[3] * p[rows] + a[4]
        return modelled - force[rows]

    def fitted(rows: np.ndarray) -> np.ndarray:
        starts = ((200.0, -0.3, -0.04, 1.5, -100.0), (100.0, -0.1, -0.02, 0.5, 0.0), (20.0, -0.5, -0.05, 2.0, 0.0))
        ends = [least_squares(misfit, start, args=(rows,), x_scale=np.abs(start) + 1.0) for start in starts]
        return min(ends, key=lambda end: end.cost).x

    every = np.arange(len(force))
    levels = np.round(p / 10.0)
    left = [misfit(fitted(every[levels != level]), every[levels == level]) for level in np.unique(levels)]
    return float(np.std(misfit(fitted(every), every))), float(np.sqrt(np.mean(np.concatenate(left) ** 2)))


def on_map(studio: Studio, path: Path, preset: str, nominal_length: float, free: tuple[str, ...]) -> Diagnosis:
    """Diagnosis of a force map from the ideal muscle."""
    facts = studio.facts(preset)
    muscle = facts.muscle._replace(nominal_length=nominal_length)
    subject = subject_of(read_measurement(path.read_bytes(), path.name), muscle)
    geometry = free_geometry(muscle, free, facts.tolerance)
    return diagnose(subject, Setting(muscle), catalogue=default_catalogue(), geometry=geometry)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--data", type=Path, default=DATA)
    folder = parser.parse_args().data
    studio = Studio(presets=presets_folder())
    for sample, preset, length in MAPS:
        path = folder / f"{sample}_force_map.csv"
        for free in ((), ("braid_angle",)):
            found = on_map(studio, path, preset, length, free)
            scale = 100.0 / float(np.max(found.subject.measured))
            say(
                f"{sample}{' --free braid_angle' if free else '':22} ideal {scale * found.start.rmse:5.2f} % -> "
                f"{scale * found.best.rmse:.2f} %, pressures left out {scale * found.best.holdout_rmse:.2f} %, "
                f"{len(found.best.free)} numbers: {', '.join(found.added)} ({found.status})"
            )
        inputs = found.subject.inputs
        fit, hold = sarosi(inputs["pressure"], 1.0 - inputs["length"] / length, found.subject.measured)
        say(f"{sample}{'':22} Sarosi, 5 parameters {scale * fit:.2f} %, pressures left out {scale * hold:.2f} %")


def say(text: str) -> None:
    """Print."""
    print(text, flush=True)  # noqa: T201


if __name__ == "__main__":
    main()
