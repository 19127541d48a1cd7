"""The diagnosis on measured force maps, beside a formula from the literature fitted to the same points:

    python -m tests.benchmarks.measured [--data FOLDER]

Maps of Martens & Boblan (Actuators 6 (2017) 33), from the ideal muscle with nominal geometry; and Sarosi's
formula with five parameters, F = (p + a1) exp(a2 k) + a3 k p + a4 p + a5, p in kPa and k in %.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

from mckibben.documents.studio import Studio
from mckibben.identification.diagnose.diagnosis import Diagnosis, diagnose
from mckibben.identification.predict import predictor_of
from mckibben.identification.predict.fit_model import FitModel, free_geometry
from mckibben.measurement.read import read_measurement
from mckibben.physics.catalogue import default_catalogue
from mckibben.resources import presets_folder

DATA = Path(__file__).parents[3] / "shared" / "data"
MAPS = (("DMSP-20-300", "DMSP-20", 0.3), ("DMSP-10-250", "DMSP-10", 0.25))
STARTS = (
    (200.0, -0.3, -0.04, 1.5, -100.0),
    (100.0, -0.1, -0.02, 0.5, 0.0),
    (20.0, -0.5, -0.05, 2.0, 0.0),
)


def sarosi(pressure: np.ndarray, contraction: np.ndarray, force: np.ndarray) -> tuple[float, float]:
    """Rms error of the formula [N]: fitted to all points, and over pressures that were left out."""
    p, k = pressure / 1e3, 100.0 * contraction

    def misfit(a: np.ndarray, rows: np.ndarray) -> np.ndarray:
        linear = a[2] * k[rows] * p[rows] + a[3] * p[rows] + a[4]
        return (p[rows] + a[0]) * np.exp(a[1] * k[rows]) + linear - force[rows]

    def fitted(rows: np.ndarray) -> np.ndarray:
        ends = [least_squares(misfit, start, args=(rows,), x_scale=np.abs(start) + 1.0) for start in STARTS]
        return min(ends, key=lambda end: end.cost).x

    every = np.arange(len(force))
    levels = np.round(p / 10.0)
    left = [misfit(fitted(every[levels != level]), every[levels == level]) for level in np.unique(levels)]
    whole = misfit(fitted(every), every)
    return float(np.sqrt(np.mean(whole**2))), float(np.sqrt(np.mean(np.concatenate(left) ** 2)))


def on_map(
    studio: Studio, path: Path, preset: str, nominal_length: float, free: tuple[str, ...]
) -> Diagnosis:
    """Diagnosis of a force map from the ideal muscle."""
    facts = studio.facts(preset)
    muscle = facts.muscle._replace(nominal_length=nominal_length)
    predictor = predictor_of(read_measurement(path.read_bytes(), path.name), muscle)
    geometry = free_geometry(muscle, free, facts.tolerance)
    return diagnose(predictor, FitModel(muscle), catalogue=default_catalogue(), geometry=geometry)


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--data", type=Path, default=DATA)
    folder = parser.parse_args().data
    studio = Studio(presets=presets_folder())
    say(f"{'rms error, % of the largest force':36}{'start':>7}{'end':>7}{'left out':>10}  numbers")
    for sample, preset, length in MAPS:
        path = folder / f"{sample}_force_map.csv"
        for free in ((), ("braid_angle",)):
            found = on_map(studio, path, preset, length, free)
            scale = 100.0 / float(np.max(found.predictor.measured))
            errors = [scale * error for error in (found.start.rmse, found.best.rmse, found.best.holdout_rmse)]
            label = f"{sample}{' --free braid_angle' if free else ''}"
            effects = f"{len(found.best.free)}: {', '.join(found.added)} ({found.status})"
            say(f"{label:36}{errors[0]:7.2f}{errors[1]:7.2f}{errors[2]:10.2f}  {effects}")
            inputs, measured = found.predictor.inputs, found.predictor.measured
        fit, hold = sarosi(inputs["pressure"], 1.0 - inputs["length"] / length, measured)
        say(f"{sample + ' Sarosi':36}{'':7}{scale * fit:7.2f}{scale * hold:10.2f}  5")


def say(text: str) -> None:
    """Print."""
    print(text, flush=True)  # noqa: T201


if __name__ == "__main__":
    main()
