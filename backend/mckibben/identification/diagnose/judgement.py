"""What speaks for and against a model on its data, whatever led to the model.

Two tests look for structure in its residual, and only both together prove one. The *ratio* asks whether a
free surface explains more than noise does that may be correlated and swing; noise outside of that family may
raise it by itself. The *gain* asks whether the surface predicts groups that it was not fitted to; noise that
is correlated beyond a group may raise that. What *repeats* in step throughout the file, as hum and vibration
do, or in the same places of several sweeps, is no noise. Rows that do not fit are named by evidence.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TypeVar

import numpy as np

from mckibben.identification.diagnose.repetition import Repetition, repetition
from mckibben.identification.diagnose.swept_rows import Over
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.predict.predictor import Predictor
from mckibben.identification.residual.correlated import Noises, Weighed, log_likelihood
from mckibben.identification.residual.outlying import NOTHING_OUTLYING, Outlying, outlying_of
from mckibben.identification.residual.surface import Surface, likelihood_ratio, residual_without, surface_of
from mckibben.identification.thresholds import JUDGED, ROWS, SCORE

_NEAR = 0.1  # of the frequency that the noise swings with, within which that of the line is looked for
PUSHES = "the force is below zero, and a muscle does not push"
DIGITS = 1e-9  # numerical resolution of noise-free data, share of the largest value
_MEDIAN = 0.6745  # median magnitude of a standard normal deviate

Found = TypeVar("Found")

#: Whether a proof holds, None where it cannot be told; and why it does not.
Proof = tuple[bool | None, str]


@dataclass(frozen=True, eq=False)
class Judgement:
    """What speaks for and against a model.

    Attributes:
        rmse: of the scaled residual.
        least: error that is one of rounding.
        noise: of neighbouring readings, or stated; None where it cannot be estimated.
        typical: standard deviation by the median magnitude of the residual.
        noises: what the noise of each channel may be if the model is right.
        ratio: see the module; 0 for fewer than twenty rows, and where the error is no more than the noise.
        surface: the free surface on the residual; None for fewer than twenty rows.
        outlying: rows that do not fit.
        pushing: values of a force that is below zero by more than noise where the model's is not.
        sweep: rows of a usual sweep.
        turning: number of rows at reversals, which are counted apart, that are far from all that the model
            allows there.
        repeats: what is periodic in the residual beyond doubt: noise that swings in step, or what is the same
            over the length or the pressure in several sweeps; None without it.
    """

    rmse: float
    least: float
    noise: float | None
    typical: float
    noises: Noises
    ratio: float
    surface: Surface | None
    outlying: Outlying
    repeats: Repetition | None
    sweep: float
    pushing: tuple[int, ...] = ()
    turning: int = 0

    @property
    def suspects(self) -> tuple[int, ...]:
        """Values that another mechanism than the model's has made: they do not fit, or push."""
        return tuple(sorted({*self.outlying.rows, *self.pushing}))

    @cached_property
    def _lowest_gain(self) -> float:
        gains = [] if self.surface is None else [low for low in self.surface.gain_low if np.isfinite(low)]
        return max(gains, default=0.0)

    @property
    def predictable(self) -> float:
        """Share of the mean square that the surface takes off groups that were left out, at best."""
        gains = [] if self.surface is None else [gain for gain in self.surface.gain if np.isfinite(gain)]
        return max(0.0, *gains) if gains else 0.0

    @property
    def depends_on(self) -> tuple[str, ...]:
        """The channels that the rest is predictable from, the most important first."""
        if self.surface is None or not self.predictable > JUDGED.gain:
            return ()
        return tuple(name for name, _ in self.surface.variables)

    @property
    def structured(self) -> bool:
        """Whether something is left that is no noise."""
        if self.repeats is not None and self.rmse > self.least and self.repeats.in_step:
            return True
        if self.surface is None:
            floor = self.noise or np.inf
            return self.rmse > JUDGED.few_mean * floor and self.typical > JUDGED.few_median * floor
        return (
            self._above
            and self._lowest_gain > JUDGED.gain
            and (self.ratio > JUDGED.ratio or self.repeats is not None)
        )

    @property
    def undecided(self) -> bool:
        """Whether no structure is proved, nor that there is none: a proof of `proofs` does not hold."""
        return not self.structured and any(holds is not True for holds, _ in self.proofs.values())

    @property
    def _lasting(self) -> bool:
        """Whether the rest is far above the scatter of neighbours, and alike over a good part of a sweep."""
        if self.noise is None or not self.rmse > JUDGED.few_mean * self.noise:
            return False
        longest = max(
            (max(weighed, key=lambda each: each.weight).noise.length for weighed in self.noises), default=0.0
        )
        return longest > JUDGED.lasting * self.sweep

    @property
    def _above(self) -> bool:
        """Whether the error is above what a surface would leave, and above the noise."""
        if self.surface is None or not self.rmse > self.least:
            return False
        return self.rmse > SCORE.at_floor * max(self.surface.left, self.noise or 0.0)

    @cached_property
    def proofs(self) -> dict[str, Proof]:
        """Each proof that nothing is missing: whether it holds, None where it cannot be told, and why not."""
        surface = self.surface
        known: Proof = (True, "")
        white, fit, gains = known, known, known
        if self.noise is None:
            known = None, "the noise cannot be estimated"
        elif self._lasting:
            known = False, "what is left lasts for a good part of a sweep, above the scatter of neighbours"
        elif surface is None and self.rmse > max(SCORE.at_floor * self.noise, self.least):
            known = False, "the error is above the noise"
        if self.repeats is not None and self.repeats.in_step and self.rmse > self.least:
            white = False, "what is left repeats in step"
        elif self._above and self.ratio > JUDGED.ratio:
            white = False, "a free surface explains more than noise does"
        if self.outlying.rows:
            fit = False, "rows do not fit beside the others"
        elif self.pushing:
            fit = False, PUSHES
        elif self.turning >= JUDGED.turned:
            fit = (
                False,
                f"{self.turning} of the rows at reversals, which are counted apart, lie off the model",
            )
        if surface is None:
            white = gains = None, "there are fewer than twenty rows"
        elif not np.isfinite(surface.gain_low[0]):
            gains = None, "there are too few groups to leave one out"
        elif self._above and surface.gain_low[0] > JUDGED.gain:
            gains = False, "a free surface predicts groups that were left out better than the model"
        return {"noise_known": known, "white": white, "no_outliers": fit, "rival_gains_nothing": gains}

    @property
    def likeliest(self) -> Weighed | None:
        """The likeliest noise of a single channel; None for several channels."""
        return max(self.noises[0], key=lambda each: each.weight) if len(self.noises) == 1 else None


def judged(model: FittedModel, predictor: Predictor, noise: float | None) -> Judgement:
    """The judgement on a fitted model.

    Rows that do not fit are named where noise that may be correlated does not explain them either, and where
    the model fits the others. Where a structure stays without them, it is the model that does not fit: its
    worst rows are no accidents.

    Args:
        model: the model.
        predictor: the data.
        noise: of the scaled residual.
    """
    outlying = outlying_of(model, predictor)
    outlying = replace(outlying, rows=_beyond_noise(model, outlying.rows))
    found = _judged(model, predictor, noise, outlying)
    rows = found.outlying.rows
    if rows and found.structured:
        without = predictor.setting_aside(rows)
        aside = np.isin(np.arange(len(model.residual)), rows)
        rest = replace(
            model,
            residual=np.where(aside, 0.0, residual_without(model, aside)),
            jacobian=np.where(aside[:, None], 0.0, model.jacobian),
            noise_lines=without.noise_lines,
            aside=without.aside,
        )
        if _judged(rest, without, noise, NOTHING_OUTLYING).structured:
            return replace(found, outlying=NOTHING_OUTLYING)
    return found


def _beyond_noise(model: FittedModel, rows: tuple[int, ...]) -> tuple[int, ...]:
    """Those of some rows that each raise the likelihood of the others by much when they are set aside."""
    jacobian, left = model.jacobian[:, model.inner], list(rows)

    def likelihood(aside: Sequence[int]) -> float:
        own = np.zeros((len(model.residual), len(aside)))
        own[list(aside), np.arange(len(aside))] = 1.0
        columns = np.hstack([jacobian, own])
        numbers, *_ = np.linalg.lstsq(columns, model.residual, rcond=None)
        return log_likelihood(columns, model.residual - columns @ numbers, model.noise_lines)

    while left:
        whole = likelihood(left)
        beyond = [
            row
            for row in left
            if whole - likelihood([other for other in left if other != row]) > ROWS.beyond_noise
        ]
        if beyond == left:
            break
        left = beyond
    return tuple(left)


def _judged(model: FittedModel, predictor: Predictor, noise: float | None, outlying: Outlying) -> Judgement:
    surface = surface_of(model, predictor)
    above = noise is None or model.rmse > SCORE.at_floor * noise
    return Judgement(
        rmse=model.rmse,
        least=DIGITS * float(np.max(np.abs(predictor.measured / predictor.scale))),
        noise=noise,
        typical=float(np.median(np.abs(model.residual))) / _MEDIAN,
        noises=model.noises,
        ratio=likelihood_ratio(model, predictor) if above else 0.0,
        surface=surface,
        outlying=outlying,
        repeats=_repeats(model, predictor, surface),
        pushing=_pushing(model, predictor, noise),
        turning=_turning(model, predictor, noise),
        sweep=float(np.median([len(sweep) for sweep in predictor.sweeps] or [len(model.residual)])),
    )


def without_suspects(
    predictor: Predictor,
    first: Found,
    again: Callable[[Predictor], Found | None],
    of: Callable[[Found], Judgement | None],
) -> Found:
    """What is found when the rows that do not fit are set aside, again as others show only without these.

    In a run, rows that do not fit are an event and no wrong readings.

    Args:
        predictor: the data, with all rows.
        first: what is found with them.
        again: finds the same of other rows; None where it cannot.
        of: the judgement in it.
    """
    found, aside = first, list[int]()
    for _ in range(0 if predictor.simulated else JUDGED.rounds):
        judgement = of(found)
        rows = () if judgement is None else judgement.suspects
        without = again(predictor.setting_aside([*aside, *rows])) if rows else None
        if without is None:
            break
        aside, found = [*aside, *rows], without
    return found


def _pushing(model: FittedModel, predictor: Predictor, noise: float | None) -> tuple[int, ...]:
    """Values of a force that a muscle cannot have: below zero, and below what the model predicts."""
    found: list[int] = []
    for channel in predictor.channels:
        if channel.name == "force" and noise is not None:
            rows = np.arange(len(model.residual))[channel.rows]
            below = predictor.measured[rows] / predictor.scale[rows] < -JUDGED.pushed * noise
            found += rows[below & (model.residual[rows] < -JUDGED.pushed * noise)].tolist()
    counted = np.ones(len(model.residual), bool) if model.aside is None else ~model.aside
    return tuple(row for row in found if counted[row])


def _turning(model: FittedModel, predictor: Predictor, noise: float | None) -> int:
    """Number of rows at reversals that are far from all that the model allows there."""
    reversals = predictor.at_reversals(model.fit_model)
    if reversals is None or noise is None:
        return 0
    return int(np.count_nonzero(reversals.distance > JUDGED.turning * max(noise, model.rmse)))


def _repeats(model: FittedModel, predictor: Predictor, surface: Surface | None) -> Repetition | None:
    """What repeats in a residual; where it is in step throughout, by the quantity over which it is found.

    What the test itself repeats is in step as well: a surface describes that better than a line does.
    """
    line, found = _line(model, predictor), left_repetition(predictor, model.residual)
    if line is not None and surface is not None:
        rest = model.mean_square - 0.5 * line.amplitude**2 / len(predictor.channels)
        if rest > surface.left**2:
            line = None
    if found is None or line is None:
        return line or found
    return replace(found, in_step=True)


def left_repetition(predictor: Predictor, residual: np.ndarray) -> Repetition | None:
    """What of the residual repeats over length, pressure or time, in the channel with the largest rest."""
    channel = max(predictor.channels, key=lambda each: float(np.mean(residual[each.rows] ** 2)))
    inside = np.zeros(len(residual), bool)
    inside[channel.rows] = True
    sweeps = [np.asarray(sweep)[inside[sweep]] for sweep in predictor.sweeps]
    return repetition(residual, predictor.inputs, sweeps=sweeps, records=predictor.records)


def _line(model: FittedModel, predictor: Predictor) -> Repetition | None:
    """The strongest swing of a channel that stays in step throughout its rows."""
    found = []
    for weighed in model.noises:
        best = max(weighed, key=lambda each: each.weight)
        noise, rows = best.noise, best.chain.rows
        share = 1.0 - noise.white
        if (
            not noise.second
            or noise.length < JUDGED.in_step * best.chain.longest
            or share < JUDGED.line_share
        ):
            continue
        over: Over = "time" if "time" in predictor.inputs else "rows"
        place = (
            predictor.inputs["time"][rows] if over == "time" else predictor.row_numbers[rows].astype(float)
        )
        numbers = np.diff(predictor.row_numbers[rows])
        steps = np.diff(place)[numbers > 0] / numbers[numbers > 0]  # within records
        period, amplitude = _in_step(model.residual[rows], place, noise.period * float(np.median(steps)))
        # What swings for long without keeping step is noise.
        share = min(share, 0.5 * amplitude**2 / max(float(np.mean(model.residual[rows] ** 2)), 1e-300))
        if share < JUDGED.line_share:
            continue
        line = Repetition(
            over=over, period=period, share=share, amplitude=amplitude, grows=False, left_out=share, parts=1,
            shown=1, in_step=True,
        )  # fmt: skip
        found.append(line)
    return max(found, key=lambda each: each.amplitude, default=None)


def _in_step(residual: np.ndarray, place: np.ndarray, period: float) -> tuple[float, float]:
    """Period and amplitude of the sine near a period that explains most of a residual."""
    cycles = float(np.ptp(place)) / period
    near = np.linspace(1.0 - _NEAR, 1.0 + _NEAR, 2 * int(np.ceil(8.0 * _NEAR * cycles)) + 3)
    best = (0.0, period, 0.0)
    for factor in near:
        angle = 2.0 * np.pi * factor * place / period
        columns = np.column_stack([np.sin(angle), np.cos(angle), np.ones(len(place))])
        numbers, *_ = np.linalg.lstsq(columns, residual, rcond=None)
        explained = float(np.sum((columns @ numbers) ** 2))
        best = max(best, (explained, period / float(factor), float(np.hypot(*numbers[:2]))))
    return best[1], best[2]
