"""Measurements made with formulas written here, and a linear subject without any physics."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import cos, pi, radians, sin, sqrt, tan
from typing import Any

import numpy as np

from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.predict.fit_model import FitModel, Free
from mckibben.identification.predict.predictor import PredictedChannel, Predictor
from mckibben.measurement.measurement import Measurement
from mckibben.measurement.reading import read_measurement
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.effect import Effect
from mckibben.physics.muscle import Muscle

MUSCLE = Muscle(0.3, 0.0218, radians(26.5), 0.0018, 0.02)
# The same muscle as a request gives it.
BRAID = {
    "braid_diameter": "21.8 mm", "braid_angle": "26.5 deg", "nominal_length": "300 mm",
    "wall_thickness": "1.8 mm", "inside_diameter": "20 mm",
}  # fmt: skip
LIFT: dict[str, Any] = {
    "muscle": BRAID,
    "effects": {},
    "supply": {"pressure": "6 bar"},
    "valve": {"sonic_conductance": "0.4 l/(s*bar)", "critical_pressure_ratio": 0.3},
    "load": {"mass": "12 kg"},
    "command": {"shape": "pulse", "on": "0 s", "off": "1 s"},
    "stops": {"min_contraction": 0.0, "max_contraction": 0.35},
    "duration": "2 s",
}
CATALOGUE = default_catalogue()
G = 9.80665


def truth(pressure, length, *, angle=26.5, c10=0.0, prestress=0.0, friction=0.0):
    """Ideal force and neo-Hookean wall, written here on its own; friction is signed by the caller."""
    t = radians(angle)
    lam = length / 0.3
    ideal = pressure * pi * 0.0218**2 / 4 * (3 / tan(t) ** 2 * lam**2 - 1 / sin(t) ** 2)
    q = 1 / tan(t) ** 2
    hoop = np.sqrt(1 + q * (1 - lam**2))
    radial = 1 / (lam * hoop)
    d_hoop = -lam * q / hoop
    d_radial = -(hoop + lam * d_hoop) / (lam * hoop) ** 2
    wall = pi * 0.0218 * 0.0018 * c10 * 2 * (lam + hoop * d_hoop + radial * d_radial)
    return ideal + wall - prestress + friction


def length_under(load, pressure, **hidden) -> float:
    """The length at which `truth` carries a load, by bisection [m]."""
    low, high = 0.2, 0.3 / cos(radians(26.5)) - 1e-6
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if truth(pressure, middle, **hidden) < load else (low, middle)
    return low


def diameter(length) -> float:
    """Diameter of the braid at a length [m]."""
    t = radians(26.5)
    return 0.0218 * sqrt(1 / sin(t) ** 2 - (length / 0.3) ** 2 / tan(t) ** 2)


def csv(rows: Sequence[str], header: str, *comments: str) -> Measurement:
    """A measurement from the lines of a file."""
    return read_measurement(text(rows, header, *comments).encode(), "made.csv")


def text(rows: Sequence[str], header: str, *comments: str) -> str:
    """The text of a measurement file."""
    return "\n".join([*(f"# {comment}" for comment in comments), header, *rows]) + "\n"


def force_map(noise: float = 0.0, **hidden) -> Measurement:
    """Five pressures times twelve lengths."""
    rng = np.random.default_rng(7)
    rows = [
        f"{p / 1e5},{1e3 * length},{truth(p, length, **hidden) + rng.normal(0, noise)}"
        for p in (3e5, 4e5, 5e5, 6e5, 7e5)
        for length in np.linspace(0.255, 0.3, 12)
    ]
    return csv(rows, "pressure_bar,length_mm,force_N", "kind: static")


def cycle_rows(
    extra=lambda **_: 0.0,
    *,
    noise: float = 0.0,
    levels: Sequence[float] = (2e5, 4e5, 6e5),
    high: float = 0.16,
    each: int = 60,
    seed: int = 3,
    second: float = 1.0,
    **hidden,
) -> list[str]:
    """Rows of isobaric cycles over time, shortening and lengthening again at 20 mm/s; two per pressure.

    The second one of a pressure goes ``second`` times as fast.
    ``extra`` gives a further force [N] from pressure, length, kappa, direction and time.
    """
    rng = np.random.default_rng(seed)
    rows, clock = [], 0.0
    for level in levels:
        share = np.linspace(0.0, 4.0, 4 * each + 1)[:-1]
        way = np.interp(share, [0, 1, 2, 3, 4], [0.0, high, 0.0, high, 0.0])
        direction = np.where(share % 2 < 1, -1, 1)
        step = 0.3 * high / each / 0.02
        steps = np.where(share < 2, step, step / second)
        for kappa, sign, pause in zip(way, direction, steps, strict=True):
            length = 0.3 * (1 - kappa)
            force = truth(level, length, **hidden) + rng.normal(0, noise)
            force += extra(pressure=level, length=length, kappa=kappa, direction=sign, time=clock)
            rows.append(f"{clock:.6f},{level},{length:.12g},{force:.12g},{sign}")
            clock += pause
    return rows


CYCLE_HEADER = "time_s,pressure_Pa,length_m,force_N,direction"


def cycles(extra=lambda **_: 0.0, **options) -> Measurement:
    """The measurement of `cycle_rows`."""
    return csv(cycle_rows(extra, **options), CYCLE_HEADER, "kind: isobaric")


class Plain(Predictor):
    """Values beside y = X b, for tests of what works on any subject: no physics, no effects."""

    def __init__(
        self,
        measured: np.ndarray,
        design: np.ndarray,
        folds: Sequence[np.ndarray],
        inputs: Mapping[str, np.ndarray] = {},
    ) -> None:
        self.kind = "static"
        self.measured, self.design = measured, design
        self.channels = (PredictedChannel("force", "N", slice(None), 1.0, float(np.max(np.abs(measured)))),)
        self.scale = np.ones(len(measured))
        self.folds = tuple(folds)
        self.groups = self.folds[0]
        self.records = np.zeros(len(measured), int)
        self.row_numbers = np.arange(len(measured))
        self.sweeps = [np.arange(len(measured))]
        self.inputs = dict(inputs)
        self.rows_used, self.excluded, self.messages = len(measured), {}, ()

    def predict(self, fit_model: FitModel, *, clipped: bool = True) -> np.ndarray:
        return np.zeros(len(self.measured))

    def why_hidden(self, effect: Effect) -> str:
        return "nothing shows here"

    def prepared(self, fit_model: FitModel, candidates: Sequence[Effect]) -> Plain:
        return self


def linear_node(
    measured: np.ndarray,
    design: np.ndarray,
    folds: Sequence[np.ndarray],
    bounds: Sequence[tuple[float, float]] | None = None,
) -> FittedModel:
    """The least-squares fit of y = X b as a node, solved here; ``bounds`` are told, not obeyed."""
    numbers = np.linalg.lstsq(design, measured, rcond=None)[0] if design.shape[1] else np.empty(0)
    limits = bounds or [(-1e6, 1e6)] * len(numbers)
    free = tuple(
        Free(f"x.b{number}", float(value), low, high, "1")
        for number, (value, (low, high)) in enumerate(zip(numbers, limits, strict=True))
    )
    return FittedModel(FitModel(MUSCLE), free, frozenset(), measured - design @ numbers, design, tuple(folds))
