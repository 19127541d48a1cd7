r"""The loop of a linear model with the drive's sampled controller: margins, closed loop, stability.

The controller is exact: with z = exp(j w h), the sample time h, and the hold of the command until the next
sample,

.. math:: K(z) = k_p + \frac{k_i h}{1 - z^{-1}} + \frac{k_d (1 - z^{-1})}{T_f + h - T_f z^{-1}}, \quad
   H = e^{-j\omega h/2}\,\frac{\sin(\omega h/2)}{\omega h/2}, \quad L = K\,H\,G\,e^{-j\omega\tau}
"""

from __future__ import annotations

import math
from typing import Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from mckibben.facts.linear import FALLEN, MARGINS
from mckibben.facts.result import result_class
from mckibben.simulation.command.pid import PidController
from mckibben.simulation.linear.equations import COMMAND, READING
from mckibben.simulation.linear.model import LinearModel
from mckibben.simulation.linear.response import frequency_response

Array = np.ndarray
Complex = NDArray[np.complex128]


@result_class
class Margins:
    """Stability of a closed loop, and how far a stable one is from its limit."""

    FIGURES: ClassVar = MARGINS.name

    stable: bool
    """Whether the sampled closed loop of the linear model is stable."""
    gain_margin: float | None
    gain_margin_at: float | None
    phase_margin: float | None
    crossover: float | None
    delay_margin: float | None
    modulus_margin: float | None
    bandwidth: float | None


def controller_response(controller: PidController, frequency: Array) -> tuple[Complex, Complex]:
    """Response of the controller [1/m] to the measurement (negative feedback) and to the reference."""
    h, lag = controller.sample_time, controller.derivative_filter
    both: Complex
    rate: Complex
    back: Complex = np.exp(-2j * math.pi * np.asarray(frequency, float) * h)
    with np.errstate(all="ignore"):
        both = controller.kp + controller.ki * h / (1.0 - back)
        rate = controller.kd * (1.0 - back) / (lag + h - lag * back)
    return both + rate, both + controller.feed_forward


def hold_response(sample_time: float, frequency: Array) -> Complex:
    """Response of a hold over the sample time."""
    turn = math.pi * np.asarray(frequency, float) * sample_time
    return np.asarray(np.exp(-1j * turn) * np.sinc(turn / math.pi), complex)


def loop_response(model: LinearModel, controller: PidController, frequency: Array) -> tuple[Complex, Complex]:
    """Open loop, and closed loop from the reference to the position reading."""
    plant = frequency_response(model, COMMAND.name, READING.name, frequency)
    plant = plant * hold_response(controller.sample_time, frequency)
    feedback, forward = controller_response(controller, frequency)
    with np.errstate(all="ignore"):
        return feedback * plant, forward * plant / (1.0 + feedback * plant)


def loop_frequencies(controller: PidController, axis: Array) -> Array:
    """A dense axis from below a frequency axis up to half the sampling frequency [Hz]."""
    top = 0.4999 / controller.sample_time
    return np.geomspace(min(0.1 * float(axis[0]), 1e-3), top, 6000)


def margins(model: LinearModel, controller: PidController, axis: Array) -> Margins:
    """Margins of the loop; an unstable one has none.

    Args:
        model: the plant.
        controller: the controller.
        axis: frequencies [Hz] around the poles of the model.
    """
    radius = float(np.abs(closed_loop_eigenvalues(model, controller)).max(initial=0.0))
    if not radius < 1.0 - 1e-12:
        return Margins(False, None, None, None, None, None, None, None)
    frequency = loop_frequencies(controller, axis)
    loop, closed = loop_response(model, controller, frequency)
    log_gain = np.log(np.maximum(np.abs(loop), 1e-300))
    # The real axis is crossed left of the origin where the imaginary part changes its sign.
    crossings = _changes(loop.imag) & (loop.real[:-1] < 0.0)
    gain_margin = gain_at = None
    for i in np.flatnonzero(crossings):
        share = loop.imag[i] / (loop.imag[i] - loop.imag[i + 1])
        size = abs(loop.real[i] + share * (loop.real[i + 1] - loop.real[i]))
        if size > 0.0 and (gain_margin is None or abs(math.log(size)) < abs(math.log(gain_margin))):
            gain_margin, gain_at = float(1.0 / size), float(frequency[i])
    phase_margin = crossover = None
    delays = []
    for i in np.flatnonzero(_changes(log_gain)):
        share = log_gain[i] / (log_gain[i] - log_gain[i + 1])
        value = loop[i] + share * (loop[i + 1] - loop[i])
        angle = math.remainder(np.angle(-value), 2.0 * math.pi)
        at = float(frequency[i] * (frequency[i + 1] / frequency[i]) ** share)
        delays.append((angle % (2.0 * math.pi)) / (2.0 * math.pi * at))
        if phase_margin is None or abs(angle) < abs(phase_margin):
            phase_margin, crossover = angle, at
    low = np.abs(closed) < FALLEN
    start = np.flatnonzero(~low)
    fallen = np.flatnonzero(low[start[0] :]) if len(start) else []
    width = float(frequency[start[0] + fallen[0]]) if len(fallen) and start[0] == 0 else None
    return Margins(
        stable=True,
        gain_margin=gain_margin,
        gain_margin_at=gain_at,
        phase_margin=phase_margin,
        crossover=crossover,
        delay_margin=min(delays, default=None),
        modulus_margin=float(np.abs(1.0 + loop).min()),
        bandwidth=width,
    )


def _changes(values: Array) -> Array:
    return np.signbit(values[:-1]) != np.signbit(values[1:])


def sampled(
    model: LinearModel, sample_time: float, input_name: str, output_name: str
) -> tuple[Array, Array, Array, float]:
    """The model from sample to sample with a held input; past inputs are states where there is a dead time.

    Returns:
        Phi, gamma, c, d: x[k+1] = Phi x[k] + gamma u[k], y[k] = c x[k] + d u[k].
    """
    from scipy.linalg import expm

    a, b, c, d = model.channel(input_name, output_name)
    scales = model.scales[0]
    a, b, c = a * scales / scales[:, None], b / scales, c * scales
    size = len(a)
    block: Any = np.zeros((size + 1, size + 1))
    block[:size, :size], block[:size, size] = a, b
    whole = math.floor(model.dead_time / sample_time + 1e-9)
    late = max(model.dead_time - whole * sample_time, 0.0)  # within the sample
    first: Any = expm(block * late)
    second: Any = expm(block * (sample_time - late))
    phi = second[:size, :size] @ first[:size, :size]
    older = second[:size, :size] @ first[:size, size]  # of the command before
    newer = second[:size, size]
    past = whole + (1 if late > 0.0 else 0)
    if past == 0:
        return phi, newer, c, d
    total = size + past  # past commands: u[k-1], u[k-2], ...
    big, gamma = np.zeros((total, total)), np.zeros(total)
    big[:size, :size] = phi
    gamma[size] = 1.0
    for index in range(1, past):
        big[size + index, size + index - 1] = 1.0
    if late > 0.0:
        big[:size, size + past - 1] = older
        if past == 1:
            gamma[:size] = newer
        else:
            big[:size, size + past - 2] = newer
    else:
        big[:size, size + past - 1] = newer
    return big, gamma, np.concatenate([c, np.zeros(past)]), d


def closed_loop_eigenvalues(model: LinearModel, controller: PidController) -> Array:
    """Eigenvalues of the closed loop from sample to sample; stable inside the unit circle."""
    return np.linalg.eigvals(_closed(model, controller)[0])


def _closed(model: LinearModel, controller: PidController) -> tuple[Any, Any, Any]:
    """Closed loop z[k+1] = M z[k] + r[k] n, y = q z: plant states, integral, filtered rate, last reading.

    At a sample the plant gives y, then the controller u from y; the plant has no direct feedthrough to y.
    """
    h = controller.sample_time
    phi, gamma, c, _ = sampled(model, h, COMMAND.name, READING.name)
    size = len(phi)
    ki = controller.ki * h
    share, gain = (
        controller.derivative_filter / (controller.derivative_filter + h),
        1.0 / (controller.derivative_filter + h),
    )
    # Rows over (x, integral, rate, last reading, reference).
    width = size + 4
    reading = np.concatenate([c, np.zeros(4)])
    target = np.zeros(width)
    target[-1] = 1.0
    unit = np.eye(width)
    integral = unit[size] + ki * (target - reading)
    rate = share * unit[size + 1] + gain * (reading - unit[size + 2])
    command = (
        controller.kp * (target - reading) + integral - controller.kd * rate
        + controller.feed_forward * target
    )  # fmt: skip
    rows = np.zeros((size + 3, width))
    rows[:size, :size] = phi
    rows[:size] += np.outer(gamma, command)
    rows[size], rows[size + 1], rows[size + 2] = integral, rate, reading
    keep = size + 3
    if controller.ki == 0.0:  # then the integral is a constant, not a part of the loop
        alive = [index for index in range(keep) if index != size]
        return rows[np.ix_(alive, alive)], rows[alive, -1], reading[alive]
    return rows[:, :keep], rows[:, -1], reading[:keep]
