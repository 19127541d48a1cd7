"""The diagnosis on measured force maps, beside formulas from the literature fitted to the same points:

    python -m tests.benchmarks.measured [--data FOLDER]

Maps of Martens & Boblan (Actuators 6 (2017) 33), from the ideal muscle with nominal geometry; and, p in kPa
and contraction k in %, the formulas of

- Sarosi, five parameters: F = (p + a1) exp(a2 k) + a3 k p + a4 p + a5;
- Hildebrandt & Sawodny, seven: F = p (a1 + a2 k + a3 k^2) + a4 + a5 k + a6 k^2 + a7 k^3, effective area times
  pressure plus elastic force (the paper was not at hand: the form as others cite it);
- Tondu & Lopez, three: F = p (a1 (1 - a2 k)^2 - a3).

Left out: each pressure, and in the column after it each length, is predicted by the formula, or the model,
that was fitted to the others; in percent of the largest force.

On 25 November 2026, left out: DMSP-20 0.41 % with 6 numbers (Hildebrandt 0.415 with 7, Sarosi 0.46 with 5),
lengths 1.5 % (3.4 and 11 %); DMSP-10 0.19 % with 7 (0.26 and 2.5 %), lengths 4.9 % (248 and 17 %). A day
before, DMSP-20 had 0.68 and 1.2 % with 4. Its map is a straight line over the pressure at each length, to
0.14 % with two numbers for each; its lengths are whole millimetres, and half of one is 9 N or 0.5 % at 6 bar.
The wall that softens, the ends that stay behind and a zero are found two steps at once only.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from pathlib import Path

import numpy as np
from scipy.optimize import least_squares

from mckibben.documents.studio import Studio
from mckibben.identification.diagnose.diagnosis import Diagnosis, diagnose
from mckibben.identification.fit.fitted_model import counts
from mckibben.identification.predict import predictor_of
from mckibben.identification.predict.fit_model import FitModel, free_geometry
from mckibben.measurement.reading import read_measurement
from mckibben.physics.catalogue import default_catalogue
from mckibben.resources import presets_folder

Array = np.ndarray
Formula = Callable[[Array, Array, Array], Array]
DATA = Path(__file__).parents[3] / "shared" / "data"
MAPS = (("DMSP-20-300", "DMSP-20", 0.3), ("DMSP-10-250", "DMSP-10", 0.25))
#: Formula -> (function of a, p and k; starts of a fit).
FORMULAS: dict[str, tuple[Formula, tuple[tuple[float, ...], ...]]] = {
    "Sarosi": (
        lambda a, p, k: (p + a[0]) * np.exp(a[1] * k) + a[2] * k * p + a[3] * p + a[4],
        (
            (200.0, -0.3, -0.04, 1.5, -100.0),
            (100.0, -0.1, -0.02, 0.5, 0.0),
            (20.0, -0.5, -0.05, 2.0, 0.0),
        ),
    ),
    "Hildebrandt": (
        lambda a, p, k: p * (a[0] + a[1] * k + a[2] * k**2) + a[3] + a[4] * k + a[5] * k**2 + a[6] * k**3,
        ((2.0, -0.05, 1e-3, 0.0, -10.0, 0.1, 0.01),),
    ),
    "Tondu": (lambda a, p, k: p * (a[0] * (1.0 - a[1] * k) ** 2 - a[2]), ((4.0, 0.015, 2.0),)),
}


def of_formula(name: str, pressure: Array, contraction: Array, force: Array) -> tuple[float, float, float]:
    """Rms error of a formula [N]: of the fit to all points, over left-out pressures, and left-out lengths."""
    formula, starts = FORMULAS[name]
    p, k = pressure / 1e3, 100.0 * contraction

    def misfit(a: Array, rows: Array) -> Array:
        return formula(a, p[rows], k[rows]) - force[rows]

    def fitted(rows: Array) -> Array:
        ends = [least_squares(misfit, start, args=(rows,), x_scale="jac") for start in starts]
        return min(ends, key=lambda end: end.cost).x

    every = np.arange(len(force))

    def left_out(levels: Array) -> float:
        parts = [misfit(fitted(every[levels != one]), every[levels == one]) for one in np.unique(levels)]
        return float(np.sqrt(np.mean(np.concatenate(parts) ** 2)))

    whole = misfit(fitted(every), every)
    with np.errstate(over="ignore"):  # Sarosi's exponential on its way
        return float(np.sqrt(np.mean(whole**2))), left_out(np.round(p / 10.0)), left_out(np.round(k, 2))


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
    say(f"{'rms error, % of largest force':36}{'start':>7}{'end':>7}{'left out':>10}{'length':>8}  numbers")
    for sample, preset, length in MAPS:
        path = folder / f"{sample}_force_map.csv"
        for free in ((), ("braid_angle",)):
            found = on_map(studio, path, preset, length, free)
            scale = 100.0 / float(np.max(found.predictor.measured))
            lengths = np.average(found.best.fold_squares[1], weights=counts(found.best.folds[1]))
            errors = [found.start.rmse, found.best.rmse, found.best.holdout_rmse, float(np.sqrt(lengths))]
            errors = [scale * error for error in errors]
            label = f"{sample}{' --free braid_angle' if free else ''}"
            effects = f"{len(found.best.free)}: {', '.join(found.added)} ({found.status})"
            say(f"{label:36}{errors[0]:7.2f}{errors[1]:7.2f}{errors[2]:10.3f}{errors[3]:8.2f}  {effects}")
            inputs, measured = found.predictor.inputs, found.predictor.measured
        contraction = 1.0 - inputs["length"] / length
        for name, (_, starts) in FORMULAS.items():
            fit, hold, length_left = of_formula(name, inputs["pressure"], contraction, measured)
            numbers = len(starts[0])
            errors = [scale * error for error in (fit, hold, length_left)]
            say(f"{sample + ' ' + name:36}{'':7}{errors[0]:7.2f}{errors[1]:10.3f}{errors[2]:8.2f}  {numbers}")


def say(text: str) -> None:
    """Print."""
    print(text, flush=True)  # noqa: T201


if __name__ == "__main__":
    main()
