"""Poles, zeros, frequency response, bandwidth and time response of a linear model."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from mckibben.facts.linear import FALLEN, LINEAR_MODEL, POLE
from mckibben.facts.result import result_class
from mckibben.simulation.linear.model import LinearModel

Array = np.ndarray

_USUAL = {"1": 1.0, "Pa": 1e5, "N": 100.0}  # usual sizes of inputs, by their unit
_NOTHING = 1e-8  # share of the strongest input below which one does not act

_FROM = 1e-4  # Hz; from here on the turns of a phase are counted
_STANDS = 1e-6  # a pole slower than this is an integrator [rad/s]
_SAME = 1e-5  # relative distance of a pole and a zero that cancel
_SLOWEST, _FASTEST = 0.01, 200.0  # Hz, of a frequency axis
_POINTS = 240
_ASIDE = 1e-3  # damping ratio below which a pole counts as undamped for the phase


@result_class
class Pole:
    """An eigenvalue of A; of a complex pair the one with the positive imaginary part."""

    FIGURES: ClassVar = POLE.name

    real: float
    imaginary: float
    frequency: float
    oscillation_frequency: float | None
    damping: float | None
    time_constant: float | None
    kind: Literal["integrator", "real", "oscillation", "unstable"]
    """"integrator", "real", "oscillation", "unstable"."""
    cancelled: bool
    """Whether the chosen channel does not show it, because a zero cancels it."""


def eigenvalues(model: LinearModel) -> Array:
    """Poles [rad/s], in ascending magnitude."""
    scales = model.scales[0]
    values = np.linalg.eigvals(model.a * scales / scales[:, None]).astype(complex)
    return values[np.argsort(np.abs(values), kind="stable")]


def zeros(model: LinearModel, input_name: str, output_name: str) -> Array:
    """Zeros of a channel [rad/s]: finite generalised eigenvalues of its Rosenbrock matrix."""
    from scipy.linalg import eigvals

    a, b, c, d = _scaled_channel(model, input_name, output_name)
    size = len(a)
    if not (np.any(b) and np.any(c)):
        return np.empty(0, complex)
    matrix = np.block([[a, b[:, None]], [c[None, :], np.array([[d]])]])
    weight = np.zeros((size + 1, size + 1))
    weight[:size, :size] = np.eye(size)
    pairs = np.asarray(eigvals(matrix, weight, homogeneous_eigvals=True))
    alpha, beta = pairs[0], pairs[1]
    largest = 1e8 * max(1.0, float(np.abs(np.linalg.eigvals(a)).max(initial=0.0)))
    finite = np.abs(alpha) < largest * np.abs(beta)
    values = (alpha[finite] / beta[finite]).astype(complex)
    return values[np.argsort(np.abs(values), kind="stable")]


def _scaled_channel(
    model: LinearModel, input_name: str, output_name: str
) -> tuple[Array, Array, Array, float]:
    """A channel with states, input and output over their magnitudes."""
    states, inputs, outputs = model.scales
    into = inputs[[port.name for port in model.inputs].index(input_name)]
    out = outputs[[port.name for port in model.outputs].index(output_name)]
    a, b, c, d = model.channel(input_name, output_name)
    return a * states / states[:, None], b * into / states, c * states / out, d * into / out


def poles_of(model: LinearModel, input_name: str, output_name: str) -> tuple[list[Pole], list[complex]]:
    """The poles, and the zeros of a channel that cancel none of them; one of each complex pair.

    An input that acts on nothing, as the supply on a closed valve, shows no pole.
    """
    values = eigenvalues(model)
    if not _acts(model, input_name, output_name):
        return [_pole(complex(value), cancelled=True) for value in values if value.imag >= 0.0], []
    left = list(zeros(model, input_name, output_name))
    poles = []
    for value in values:
        near = [i for i, zero in enumerate(left) if abs(zero - value) <= _SAME * max(abs(value), 0.1)]
        if near:
            left.pop(near[0])
        if value.imag < 0.0:
            continue
        poles.append(_pole(complex(value), cancelled=bool(near)))
    return poles, [complex(zero) for zero in left if zero.imag >= -1e-9 * max(1.0, abs(zero))]


def _acts(model: LinearModel, input_name: str, output_name: str) -> bool:
    """Whether an input acts at all: a side of a valve is that of an opening which is not exactly 0."""
    scales = np.array([_USUAL[port.unit] for port in model.inputs])
    _, b, c, d = model.channel(input_name, output_name)
    others = np.abs(model.b * scales).max(axis=1)
    scale = _USUAL[next(port.unit for port in model.inputs if port.name == input_name)]
    return bool(d != 0.0 or (np.any(np.abs(b) * scale > _NOTHING * others) and np.any(c)))


def _pole(value: complex, *, cancelled: bool) -> Pole:
    size = abs(value)
    if size < _STANDS:
        return Pole(0.0, 0.0, 0.0, None, None, None, "integrator", cancelled)
    real = 0.0 if abs(value.real) < 1e-9 * size else value.real
    kind = "unstable" if real > 0.0 else "oscillation" if value.imag > 1e-9 * size else "real"
    decay = -1.0 / real if real < 0.0 else None
    swings = abs(value.imag) / (2.0 * math.pi) if abs(value.imag) > 1e-9 * size else None
    return Pole(real, value.imag, size / (2.0 * math.pi), swings, -real / size, decay, kind, cancelled)


def frequencies_for(model: LinearModel, cover: Sequence[float] = ()) -> Array:
    """A frequency axis [Hz] around the poles that matter, and beyond the frequencies to cover."""
    sizes = np.abs(eigenvalues(model)) / (2.0 * math.pi)
    known = sizes[(sizes > _SLOWEST) & (sizes < _FASTEST)]
    if not len(known):
        known = np.array([1.0])
    low, high = max(_SLOWEST, 0.1 * known.min()), min(_FASTEST, max(10.0 * known.max(), 20.0))
    if len(cover):
        low, high = min(low, 0.7 * min(cover)), max(high, 1.4 * max(cover))
    return np.geomspace(low, high, _POINTS)


def frequency_response(
    model: LinearModel, input_name: str, output_name: str, frequency: Array, *, aside: float = 0.0
) -> NDArray[np.complex128]:
    """Complex response of a channel, with the dead time of a command.

    Args:
        model: the model.
        input_name, output_name: the channel.
        frequency: [Hz], shape (n,); a pole on it gives infinity.
        aside: how far to the right of the imaginary axis, as a share of the frequency.
    """
    a, b, c, d = _scaled_channel(model, input_name, output_name)
    s = (2j + 2.0 * aside) * math.pi * np.asarray(frequency, float)
    systems = s[:, None, None] * np.eye(len(a)) - a
    with np.errstate(all="ignore"):
        try:
            states = np.linalg.solve(systems, np.broadcast_to(b[:, None], (len(s), len(a), 1)))[:, :, 0]
        except np.linalg.LinAlgError:
            states = np.full((len(s), len(a)), np.inf)
        response = states @ c + d
    inputs, outputs = model.scales[1:]
    into = inputs[[port.name for port in model.inputs].index(input_name)]
    out = outputs[[port.name for port in model.outputs].index(output_name)]
    delay = model.dead_time if input_name.endswith("command") else 0.0
    return response * (out / into) * np.exp(-s * delay)


def phase_of(
    model: LinearModel, input_name: str, output_name: str, frequency: Array, response: Array
) -> Array:
    """The phase of a response without jumps of a whole turn [rad].

    The turns are counted from far below the lowest frequency, where each integrator has taken a quarter. An
    undamped pole takes half a turn, as one with little damping does: the turns are then counted a trifle to
    the right of the imaginary axis, on a finer axis around each pole.

    Args:
        model, input_name, output_name: the channel of the response, or of its plant.
        frequency: [Hz], ascending.
        response: at these frequencies.
    """
    near = [
        abs(pole.imag) / (2.0 * math.pi) * (1.0 + 0.5 * _ASIDE * np.arange(-40, 41))
        for pole in eigenvalues(model)
        if pole.imag > _STANDS and abs(pole.real) < _ASIDE * pole.imag
    ]
    first = float(frequency[0])
    below = np.geomspace(min(_FROM, 0.5 * first), first, 120)
    axis = np.unique(np.concatenate([below, frequency, *near]))
    beside = frequency_response(model, input_name, output_name, axis, aside=_ASIDE if near else 0.0)
    turned = np.unwrap(np.angle(beside))
    turned -= _turns(model, input_name, output_name, float(turned[0]))
    turned = np.interp(frequency, axis, turned)
    angle = np.angle(response)
    own = np.angle(frequency_response(model, input_name, output_name, frequency))
    plant = own + 2.0 * math.pi * np.round((turned - own) / (2.0 * math.pi))
    return plant + np.unwrap(np.angle(np.exp(1j * (angle - own))))


def _turns(model: LinearModel, input_name: str, output_name: str, lowest: float) -> float:
    """Whole turns by which a phase at the lowest frequency is off: a quarter falls for each integrator."""
    poles, origin = poles_of(model, input_name, output_name)
    falls = sum(pole.kind == "integrator" and not pole.cancelled for pole in poles)
    off = lowest - 0.5 * math.pi * (sum(abs(zero) < _STANDS for zero in origin) - falls)
    return 2.0 * math.pi * round(off / (2.0 * math.pi)) if abs(off) > math.pi + 0.1 else 0.0


def static_gain(model: LinearModel, input_name: str, output_name: str) -> float | None:
    """Gain at 0 Hz; None where the channel integrates."""
    if not _acts(model, input_name, output_name):
        return 0.0
    left = poles_of(model, input_name, output_name)[0]
    if any(pole.kind == "integrator" and not pole.cancelled for pole in left):
        return None
    lowest = np.array([1e-9])
    value = frequency_response(model, input_name, output_name, lowest)[0]
    return float(value.real) if np.isfinite(value) else None


def bandwidth(model: LinearModel, input_name: str, output_name: str) -> tuple[float | None, str | None]:
    """Frequency at which the gain has fallen by 3 dB below that at 0 Hz [Hz], or why there is none."""
    gain = static_gain(model, input_name, output_name)
    if gain is None:
        return None, LINEAR_MODEL["static_gain"].exists_when.otherwise
    if gain == 0.0:
        return None, "the channel has no static gain"
    axis = np.geomspace(1e-4, 1e4, 1601)
    ratio = np.abs(frequency_response(model, input_name, output_name, axis)) / abs(gain)
    below = np.flatnonzero(ratio < FALLEN)
    if not len(below) or below[0] == 0:
        return None, LINEAR_MODEL["bandwidth"].exists_when.otherwise
    i = int(below[0])
    share = (FALLEN - ratio[i - 1]) / (ratio[i] - ratio[i - 1])
    return float(axis[i - 1] * (axis[i] / axis[i - 1]) ** share), None
