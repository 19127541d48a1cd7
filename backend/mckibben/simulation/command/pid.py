r"""A sampled PID controller of the position: plain numbers, so that it runs in Python and compiled.

Parallel form, derivative of the measurement through a first-order filter, sample time h, error e = r - y:

.. math:: u_k = \mathrm{sat}\bigl(k_p e_k + I_k - k_d D_k + k_f r_k\bigr), \quad
   I_k = I_{k-1} + k_i h e_k, \quad D_k = \frac{T_f D_{k-1} + y_k - y_{k-1}}{T_f + h}

Anti-windup by conditional integration: a step of I that would push a saturated output further is not taken.

Units of the gains. Inside, all gains are SI: command (1 = full opening, or full scale of a pressure
regulator) per metre. A document gives plain numbers in **percent of the full command per millimetre** (kp
%/mm, ki %/(mm s), kd % s/mm), or texts with a unit. Why this reading: with kp = 2, ki = 10, kd = 0.01 and a
muscle that moves at about 1 m/s with the valve fully open, percent per mm gives kp = 20 1/m, ki = 100 1/(m
s): the loop :math:`s^2 + 20 s + 100 = (s + 10)^2` is critically damped with 0.1 s, the valve opens fully at
50 mm error, and the derivative (5 ms) is a small lead. Read per metre, the same numbers give :math:`s^2 + 2
s + 10`: poorly damped and too slow for a reference with a period of 1 s. Read as full opening per mm, the
valve would switch between its ends at 0.5 mm error.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

from mckibben.facts.linear import CONTROLLER
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.physics.units import si

MAX_GAIN = 1e9
SHORTEST_SAMPLE, LONGEST_SAMPLE = 1e-5, 1.0


class PidState(NamedTuple):
    """State of the controller from one sample to the next.

    Attributes:
        integral: I, in units of the command [-].
        rate: filtered rate of the measurement D [m/s].
        measurement: the last measurement [m].
    """

    integral: float
    rate: float
    measurement: float


def pid_step(
    reference: float,
    measurement: float,
    integral: float,
    rate: float,
    last_measurement: float,
    kp: float,
    ki: float,
    kd: float,
    filter_time: float,
    sample_time: float,
    low: float,
    high: float,
    feed_forward: float,
) -> tuple[float, float, float]:
    """One sample: (command, integral, rate) from reference, measurement and the last state.

    Positional plain numbers on purpose: numba compiles it too. Keep the measurement for
    the next call as ``last_measurement``. ``filter_time`` 0 takes the plain difference of two samples. The
    command is always within [low, high]. With ki = 0 the integral stays as it is (a constant bias).
    """
    error = reference - measurement
    rate = (filter_time * rate + measurement - last_measurement) / (filter_time + sample_time)
    other = kp * error - kd * rate + feed_forward * reference
    step = ki * sample_time * error
    command = other + integral + step
    if (command > high and step > 0.0) or (command < low and step < 0.0):
        command = other + integral
    else:
        integral += step
    return min(max(command, low), high), integral, rate


@dataclass(frozen=True, kw_only=True)
class PidController:
    """Gains, filter, sample time and output limits of a position controller, SI.

    Attributes:
        kp: proportional gain [1/m].
        ki: integral gain [1/(m s)].
        kd: derivative gain [s/m].
        derivative_filter: time constant of the derivative's filter [s]; 0 = none.
        sample_time: time between two commands, each held until the next [s].
        output_min, output_max: limits of the command [-]; -1 and 1 for a valve, 0 and 1 for a regulator.
        feed_forward: command per metre of reference [1/m].

    Raises:
        InputError: a gain that is negative, infinite or above `MAX_GAIN`, all gains zero, a sample time
            outside 10 µs to 1 s, a negative filter time, limits in the wrong order.
    """

    kp: float
    ki: float = 0.0
    kd: float = 0.0
    derivative_filter: float = 0.005
    sample_time: float = 0.001
    output_min: float = -1.0
    output_max: float = 1.0
    feed_forward: float = 0.0

    def __post_init__(self) -> None:
        for name in ("kp", "ki", "kd", "feed_forward"):
            gain = getattr(self, name)
            if not 0.0 <= gain <= MAX_GAIN:
                why = "a gain cannot be negative" if gain < 0.0 else "the gain is too large"
                raise InputError(f"{name}: {why}", field=name, hint="0 or more")
        if self.kp == self.ki == self.kd == self.feed_forward == 0.0:
            raise InputError("all gains are zero: the controller would do nothing", field="kp")
        if not SHORTEST_SAMPLE <= self.sample_time <= LONGEST_SAMPLE:
            raise InputError(
                f"sample_time: {self.sample_time:g} s is not between {SHORTEST_SAMPLE:g} s and "
                f"{LONGEST_SAMPLE:g} s",
                field="sample_time",
                hint="e.g. '1 ms'",
            )
        if not (math.isfinite(self.derivative_filter) and self.derivative_filter >= 0.0):
            problem = f"derivative_filter: {self.derivative_filter:g} s is not a filter time"
            raise InputError(problem, field="derivative_filter", hint="e.g. '5 ms'")
        if not -math.inf < self.output_min < self.output_max < math.inf:
            raise InputError(
                f"output_max: {self.output_max:g} is not above output_min = {self.output_min:g}",
                field="output_max",
            )

    def start(
        self, *, measurement: float, reference: float | None = None, command: float | None = None
    ) -> PidState:
        """The state before the first sample, at rest at ``measurement`` [m].

        With ``command`` and its reference the transfer is bumpless: a first sample at the same measurement
        gives this command, except for the first integration step.
        """
        integral = 0.0
        if command is not None:
            target = measurement if reference is None else reference
            integral = command - self.kp * (target - measurement) - self.feed_forward * target
        return PidState(integral, 0.0, measurement)

    def step(self, reference: float, measurement: float, state: PidState) -> tuple[float, PidState]:
        """Command [-] for this sample and the state for the next; see `pid_step`."""
        command, integral, rate = pid_step(reference, measurement, *state, *self.constants)
        return command, PidState(integral, rate, measurement)

    @property
    def constants(self) -> tuple[float, float, float, float, float, float, float, float]:
        """The last eight arguments of `pid_step`, in their order."""
        return (
            self.kp,
            self.ki,
            self.kd,
            self.derivative_filter,
            self.sample_time,
            self.output_min,
            self.output_max,
            self.feed_forward,
        )


# Keys of a document whose plain numbers are in the unit in which they are shown, percent per mm.
_GAINS = ("kp", "ki", "kd", "feed_forward")


def controller_from(
    document: Mapping[str, Any], *, field: str = "controller", output_min: float = -1.0
) -> PidController:
    """The controller of a drive document: ``{"type": "pid", "kp": 2.0, "ki": 10.0, "kd": 0.01, ...}``.

    A gain is a plain number in %/mm, %/(mm s), % s/mm, or a text with its unit (``"20 1/m"``). The key
    ``reference`` of the document is read by `signals.signal_from`.

    Args:
        document: the part of the document.
        field: its path, for messages.
        output_min: default lower limit: -1 for a valve that also exhausts, 0 for a pressure regulator.

    Raises:
        InputError: another type, an unknown key, a missing or impossible value.
    """
    if not isinstance(document, Mapping):
        raise InputError(f"{field}: an object is needed", field=field, hint='{"type": "pid", "kp": 2.0, ...}')
    kind = document.get("type", "pid")
    if kind != "pid":
        raise InputError(
            f"{field}.type: there is no controller '{str(kind)[:40]}'", field=f"{field}.type", hint="'pid'"
        )
    values: dict[str, float] = {"output_min": output_min}
    for key, raw in document.items():
        if key in ("type", "reference"):
            continue
        if key not in CONTROLLER:
            hint = did_you_mean(str(key), [*CONTROLLER, "type", "reference"])
            problem = f"{field}: a PID controller has no '{str(key)[:40]}'"
            raise InputError(problem, field=f"{field}.{str(key)[:40]}", hint=hint)
        value = si(raw, CONTROLLER[key].unit, field=f"{field}.{key}")
        shown = key in _GAINS and not isinstance(raw, str)
        values[key] = value * CONTROLLER[key].scale.factor if shown else value
    if "kp" not in values:
        raise InputError(f"{field}.kp is missing", field=f"{field}.kp", hint="e.g. 2.0 (percent per mm)")
    try:
        return PidController(**values)
    except InputError as error:
        where = f"{field}.{error.field}"
        raise InputError(f"{field}.{error.message}", field=where, hint=error.hint) from error
