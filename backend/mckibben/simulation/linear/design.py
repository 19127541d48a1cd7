"""Design of a position controller: a published rule on the linear plant, then refined on nonlinear runs.

The rule is that of Tyreus and Luyben (Ind. Eng. Chem. Res. 31 (1992) 2625; with derivative in Luyben &
Luyben, Essentials of Process Control, 1997; both grade M): from the ultimate gain K_u and period P_u of the
loop, k_p = K_u/2.2, T_i = 2.2 P_u, T_d = P_u/6.3. It is made for plants that integrate. The refinement
changes the three gains, and feeds a share of the command forward where the plant settles by itself, with a
simplex (Nelder & Mead 1965) until steps of the nonlinear drive meet the goals.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from mckibben.physics.errors import InputError
from mckibben.simulation.command.pid import MAX_GAIN, PidController
from mckibben.simulation.linear.equations import COMMAND, READING
from mckibben.simulation.linear.linearise import Linearisation
from mckibben.simulation.linear.loop import hold_response, loop_frequencies
from mckibben.simulation.linear.response import frequencies_for, frequency_response, static_gain
from mckibben.simulation.linear.trials import LEAST_MODULUS, Bench, Goals, StepFigures, Trial, Variation
from mckibben.simulation.outcome import Watch

Array = np.ndarray

RULE = "Tyreus and Luyben 1992, from the ultimate gain and period of the linear loop"
_GAINS = ("kp", "ki", "kd", "feed_forward")
_EVALUATIONS = (80, 80, 60)  # of each simplex


@dataclass(frozen=True)
class Design:
    """A designed controller.

    Attributes:
        goals: with the height of the step.
        rule: name and source of the rule.
        ultimate_gain, ultimate_period: of the linear loop [1/m], [s]; None where it has none.
        trials: the drive's own controller if it has one, that of the rule, the refined one.
        robust: the refined controller with mass and supply 20 % lower and higher.
        evaluations: runs of the refinement.
        remarks: what to know, as sentences.
    """

    goals: Goals
    rule: str
    ultimate_gain: float | None
    ultimate_period: float | None
    trials: tuple[Trial, ...]
    robust: tuple[Variation, ...]
    evaluations: int
    remarks: tuple[str, ...]

    @property
    def refined(self) -> Trial:
        """The last of the trials."""
        return self.trials[-1]


def design(linear: Linearisation, goals: Goals, watch: Watch | None = None) -> Design:
    """Design a PID controller of the position at an operating point.

    Args:
        linear: the operating point and its models.
        goals: what a step shall do.
        watch: may end the refinement early; the best so far is then the result.

    Raises:
        InputError: the load rests on a stop, or the step leaves the range between the stops. Field "design".
    """
    point, drive = linear.point, linear.point.bound.drive
    if point.on_stop is not None:
        raise InputError(
            "no controller can be designed where the load rests on its end stop",
            field="design",
            hint="state another operating point",
        )
    goals = replace(goals, step=_step(linear, goals))
    bench = Bench(linear, goals, watch or Watch())
    ultimate = ultimate_of(linear, bench.template)
    remarks = []
    if ultimate is None:
        start = _slow(linear, bench.template)
        remarks.append("the rule gives nothing: the loop has no ultimate gain; the search begins slowly")
    else:
        start = by_rule(bench.template, *ultimate)
    trials = []
    if drive.controller is not None:
        trials.append(bench.trial("own", bench.commanding(drive.controller)))
    trials.append(bench.trial("rule", start))
    best = _refined(bench, [trial.controller for trial in trials], ultimate)
    trials.append(bench.trial("refined", best))
    if not trials[-1].figures.meets:
        remarks.append(_missed(trials[-1].figures, goals))
    loop = trials[-1].margins
    if not loop.stable:
        remarks.append(
            "the linear loop of the refined controller is unstable, so it has no margins: the drive "
            "stays within bounds by what the linear model loses"
        )
    elif loop.modulus_margin is not None and loop.modulus_margin < LEAST_MODULUS - 0.01:
        remarks.append(
            f"the linear loop of the refined controller comes within {loop.modulus_margin:.2g} of -1, "
            f"less than {LEAST_MODULUS:g}: it relies on what the linear model loses"
        )
    robust = tuple(bench.variations(best))
    if trials[-1].figures.meets and not all(each.figures.meets for each in robust):
        remarks.append(_not_robust(robust, goals))
    if bench.ended:
        remarks.append("the search was ended early; this is the best controller so far")
    return Design(
        goals=goals,
        rule=RULE,
        ultimate_gain=None if ultimate is None else ultimate[0],
        ultimate_period=None if ultimate is None else ultimate[1],
        trials=tuple(bench.of_drive(trial) for trial in trials),
        robust=robust,
        evaluations=bench.runs,
        remarks=tuple(remarks),
    )


def ultimate_of(linear: Linearisation, controller: PidController) -> tuple[float, float] | None:
    """Gain [1/m] at which a proportional loop oscillates for ever, and the period [s]; None without one."""
    model = linear.primary
    frequency = loop_frequencies(controller, frequencies_for(model))
    plant = frequency_response(model, COMMAND.name, READING.name, frequency)
    plant = plant * hold_response(controller.sample_time, frequency)
    crossed = np.flatnonzero(
        (np.signbit(plant.imag[:-1]) != np.signbit(plant.imag[1:])) & (plant.real[:-1] < 0.0)
    )
    if not len(crossed):
        return None
    sizes = np.abs(plant.real[crossed])
    i = int(crossed[np.argmax(sizes)])
    gain, period = 1.0 / abs(float(plant.real[i])), 1.0 / float(frequency[i])
    return (gain, period) if 0.0 < gain < MAX_GAIN else None


def by_rule(template: PidController, gain: float, period: float) -> PidController:
    """The controller of the rule of Tyreus and Luyben."""
    kp = gain / 2.2
    return replace(template, kp=kp, ki=kp / (2.2 * period), kd=kp * period / 6.3)


def _slow(linear: Linearisation, template: PidController) -> PidController:
    """A gain with which the loop crosses 1 at the lowest frequency of interest."""
    low = frequencies_for(linear.primary)[:1]
    size = abs(frequency_response(linear.primary, COMMAND.name, READING.name, low)[0])
    return replace(template, kp=min(max(0.3 / size, 1e-6), MAX_GAIN) if size > 0.0 else 1.0)


def _step(linear: Linearisation, goals: Goals) -> float:
    point, drive = linear.point, linear.point.bound.drive
    low, high = (stop / drive.load.lever_ratio for stop in drive.stops)
    step = goals.step if goals.step is not None else 0.1 * (high - low)
    if not low < point.position + step < high:
        raise InputError(
            f"a step of {step * 1e3:.4g} mm from {point.position * 1e3:.4g} mm ends beyond the end stops at "
            f"{low * 1e3:.4g} mm and {high * 1e3:.4g} mm",
            field="design",
            hint='a smaller step, e.g. "step 5 mm"',
        )
    return step


class _Enough(Exception):  # noqa: N818 - it ends the search, it is no error
    """The goals are met on all drives, or the search is to end."""


def _refined(
    bench: Bench, starts: list[PidController], ultimate: tuple[float, float] | None
) -> PidController:
    """The best controller of a simplex search over the logarithms of the gains."""
    from scipy.optimize import minimize

    best: tuple[float, PidController] = (math.inf, starts[0])
    seen: list[tuple[float, PidController]] = []

    def tried(controller: PidController) -> float:
        nonlocal best
        if bench.watch.ended(min(bench.runs / (3.0 * sum(_EVALUATIONS)), 1.0)) is not None:
            bench.ended = True
            raise _Enough
        cost, met = bench.cost(controller)
        seen.append((cost, controller))
        if cost < best[0]:
            best = cost, controller
        if met:
            raise _Enough
        return cost

    def controller_of(logs: Array) -> PidController:
        gains = np.exp(np.clip(logs, -18.0, math.log(MAX_GAIN)))
        return replace(bench.template, **dict(zip(_GAINS, map(float, gains), strict=False)))

    try:
        for start in starts:
            for factor in (1.0, 0.4, 2.5):
                tried(replace(start, kp=factor * start.kp, ki=factor * start.ki, kd=factor * start.kd))
        for factor in (1.0, 0.5, 0.25):  # hardly any integral and derivative
            kp = factor * starts[-1].kp
            tried(replace(starts[-1], kp=kp, ki=0.1 * kp, kd=1e-3 * kp))
        # A plant that settles by itself: mostly integral, with a share of the command fed forward.
        static = static_gain(bench.linear.primary, COMMAND.name, READING.name)
        ahead = 0.0 if not static or static < 0.0 else min(1.0 / static, 0.1 * MAX_GAIN)
        if ultimate is not None:
            gain, period = ultimate
            for share, fed in ((0.5, 0.0), (1.0, 0.0), (1.5, 0.0), (0.5, 0.6), (0.15, 0.8)):
                kp, ki, kd = 0.15 * gain, share * gain / period, 0.06 * gain * period
                tried(replace(starts[-1], kp=kp, ki=ki, kd=kd, feed_forward=fed * ahead))
        ranked = sorted(seen, key=lambda pair: pair[0])
        for number, evaluations in enumerate(_EVALUATIONS):
            # From the best two beginnings, then from the best so far: the cost has several minima.
            first = best[1] if number == len(_EVALUATIONS) - 1 else ranked[number][1]
            gains = [first.kp, max(first.ki, 1e-2 * first.kp), max(first.kd, 1e-3 * first.kp)]
            if ahead:
                gains.append(max(first.feed_forward, 0.02 * ahead))
            width = len(gains)
            simplex = np.log(np.maximum(gains, 1e-8)) + np.vstack([np.zeros(width), 0.7 * np.eye(width)])
            minimize(
                lambda logs: tried(controller_of(logs)),
                simplex[0],
                method="Nelder-Mead",
                options={"initial_simplex": simplex, "maxfev": evaluations, "xatol": 0.02, "fatol": 1e-3},
            )
    except _Enough:
        pass
    return best[1]


def _not_robust(robust: tuple[Variation, ...], goals: Goals) -> str:
    """What is missed with another mass and supply, where the drive itself meets the goals."""
    missed = [each for each in robust if not each.figures.meets]
    worst = max(each.figures.overshoot for each in missed)
    times = [each.figures.settling for each in missed]
    late = max((each for each in times if each is not None), default=0.0)
    settling = (
        f"not settled within {2.0 * goals.settling:.3g} s"
        if None in times
        else f"settled in {late:.3g} s at worst"
    )
    return (
        f"the drive as stated meets the goals, and misses them in {len(missed)} of {len(robust)} "
        f"combinations of mass and supply: overshoot up to {worst * 100:.3g} %, {settling}"
    )


def _missed(figures: StepFigures, goals: Goals) -> str:
    missed = []
    if figures.overshoot > goals.overshoot:
        missed.append(f"overshoot {figures.overshoot * 100:.3g} % instead of {goals.overshoot * 100:.3g} %")
    if figures.settling is None:
        missed.append(f"the position does not stay within 2 % within {2.0 * goals.settling:.3g} s")
    elif figures.settling > goals.settling:
        missed.append(f"settling in {figures.settling:.3g} s instead of {goals.settling:.3g} s")
    if goals.unsaturated and figures.saturated > 0.0:
        missed.append(f"the command is at its limits for {figures.saturated * 100:.3g} % of the time")
    return "no PID controller that was tried meets the goals: " + "; ".join(missed)
