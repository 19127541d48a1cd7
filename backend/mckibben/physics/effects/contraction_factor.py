r"""Contraction factor of Tondu and Lopez: the conical ends make the muscle contract less than its middle.

The braid in the middle contracts by :math:`k\varepsilon` while the muscle contracts by :math:`\varepsilon`:
the volume is :math:`V_k(L) = V_0 + \frac1k\left[V_i(L_0(1-k\varepsilon)) - V_0\right]`, so that
:math:`-dV_k/dL` is the ideal area at :math:`k\varepsilon` and force and gas balance agree.

With :math:`k(P) = k + a_k e^{-P/P_k}` the force stays :math:`-P\,\partial V_k/\partial L`. So that a closed
path in P and L gains no work, the ends then store an energy U: the gas fills V instead of :math:`V_k`, and
besides :math:`-P\,\partial V/\partial L` the ends pull with :math:`F_e`,

.. math:: V = \frac{\partial (P V_k)}{\partial P} = V_k + \frac UP,\quad F_e = \frac{\partial U}{\partial L},
   \quad U = P^2\,\frac{a_k}{P_k}e^{-P/P_k}\,\frac{s^2\bigl(3L_0-2k(P)s\bigr)}{4\pi n^2},\quad s = L_0 - L

U is that of the ideal braid, also where other effects change the volume.

Where the ends stay behind the more the muscle is contracted, the middle contracts by
:math:`k\varepsilon + g\varepsilon^2`. The area of the ideal braid at that contraction, less that at
:math:`k\varepsilon`, adds :math:`L_0 \int_0^\varepsilon \Delta A\,d\varepsilon` to the volume. With
:math:`k = 1, g = 1/2` the area falls nearly in a straight line, as it does on measured maps.
"""

from collections.abc import Callable

from mckibben.physics import ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source
from mckibben.physics.slots import Shape


def shape(
    *,
    inner: Callable[[Value], Shape],
    length: Value,
    muscle: Muscle,
    pressure: Value,
    factor: Value,
    excess: Value,
    decay_pressure: Value,
    growth: Value,
) -> Shape:
    """The shape at the braid's length L0 (1 - k eps), its volume change over k, with U/P and g's part."""
    above = ops.positive_part(pressure)
    fading = excess * ops.exp(-above / decay_pressure)
    local = factor + fading
    stroke = muscle.nominal_length - length
    braid = inner(length - (local - 1.0) * stroke)
    rest = inner(muscle.nominal_length)
    volume = braid.volume + (1.0 / local - 1.0) * (braid.volume - rest.volume)
    bulge = stroke**2 * (3.0 * muscle.nominal_length - 2.0 * local * stroke)
    stored = above * fading / decay_pressure * bulge / (4.0 * ops.pi * muscle.braid.turns**2)
    return Shape(volume + stored + _by_growth(muscle, length, factor, growth), braid.diameter)


def _by_growth(muscle: Muscle, length: Value, factor: Value, growth: Value) -> Value:
    """L0 times the integral over eps of a A0 [(1 - k eps - g eps^2)^2 - (1 - k eps)^2] [m^3]."""
    contraction = ops.positive_part(1.0 - length / muscle.nominal_length)
    linear = contraction**3 / 3.0 - factor * contraction**4 / 4.0
    integral = -2.0 * growth * linear + growth**2 * contraction**5 / 5.0
    return integral * 3.0 * muscle.nominal_length**3 / (4.0 * ops.pi * muscle.braid.turns**2)


def tension(
    *, length: Value, muscle: Muscle, pressure: Value, factor: Value, excess: Value, decay_pressure: Value
) -> Value:
    """F_e = dU/dL [N], tension from the energy of the ends; 0 if the factor is independent of pressure."""
    above = ops.positive_part(pressure)
    fading = excess * ops.exp(-above / decay_pressure)
    stroke = muscle.nominal_length - length
    slope = 3.0 * stroke * (muscle.nominal_length - (factor + fading) * stroke)
    return -(above**2) * fading / decay_pressure * slope / (2.0 * ops.pi * muscle.braid.turns**2)


_TONDU = Source("Tondu & Lopez, IEEE Control Systems 20(2) (2000) 15: k = 1.25-1.35", "M")
_KERSCHER = Source("Kerscher, Albiez, Zoellner & Dillmann, IEEE/RAS-EMBS BioRob (2006)", "M")
_CLOSED_FORM = Source("F = P A0 [a (1 - k eps)^2 - c_b] evaluated by hand", "D")
_DECAYED = Source("the same with k(P_k) = 1.1 + 0.2/e = 1.17357589", "D")
_FROM_WORK = Source("V_k + U/P = 13.070603 + 0.073489 cm3 by hand", "D")
_DECAYING = {"factor": 1.1, "excess": 0.2, "decay_pressure": 1.5e5}
_AT_DECAY = {"length": 0.09, "pressure": 1.5e5}
_SIZE_10 = {"nominal_length": 0.1, "braid_diameter": 0.01, "braid_angle": 0.4363323129985824}

EFFECT = Effect(
    title="Contraction factor of the ends (Tondu k)",
    family="geometry",
    type="static",
    cause="Near its fittings the muscle is conical and does not contract. The cylindrical "
    "middle therefore contracts k times as much as the muscle as a whole.",
    equation=r"F = P A_0\left[\frac{3}{\tan^2\theta_0}(1-k_P\varepsilon)^2 - \frac{1}{\sin^2\theta_0}\right]"
    r",\quad k_P = k + a_k e^{-P/P_k} + g\varepsilon",
    parameters=(
        Parameter(
            *("factor", "k", "1"),
            default=1.1,
            lower=0.7,
            upper=2.5,
            source=_TONDU,
            description="Contraction of the cylindrical middle over that of the whole muscle; the value at "
            "high pressure if it depends on pressure.",
            off=1.0,
            measured=(1.0, 2.5),
        ),
        Parameter(
            *("excess", "a_k", "1"),
            default=0.0,
            lower=0.0,
            upper=1.0,
            source=Source("0.02-0.3 with a bladder in the model, more without one", "E"),
            description="Excess of the factor at low pressure; 0 is the same factor at every pressure.",
            off=0.0,
            fitted=False,
        ),
        Parameter(
            *("decay_pressure", "P_k", "Pa"),
            default=1.5e5,
            lower=2.0e4,
            upper=1.0e6,
            source=Source("1-3 bar", "E"),
            description="Gauge pressure at which the excess has fallen to 1/e.",
            fitted=False,
        ),
        Parameter(
            *("growth", "g", "1"),
            default=0.0,
            lower=0.0,
            upper=2.5,
            source=Source("0.5 on the force maps of Martens & Boblan 2017, both sizes", "D"),
            description="Growth of the factor with contraction; 0 is the same factor at every contraction.",
            off=0.0,
            fitted=False,
        ),
    ),
    slots={"shape": shape, "tension": tension},
    kinds=frozenset({"isobaric", "isometric", "isotonic", "diameter", "static", "transient"}),
    signature=Signature(
        text="proportional to pressure, zero at the rest length, growing in proportion to contraction",
        direction="even",
        pressure_power=1.0,
        zero_at=("nominal_length", "zero_pressure"),
        energy="conservative",
    ),
    confused_with=(
        Twin("end_caps", "two muscle lengths: with end caps k − 1 falls as 1/L₀"),
        Twin("bladder_elasticity", "several pressures: the bladder's share does not grow with pressure"),
        Twin("linear_elasticity", "several pressures: the elastic share does not grow with pressure"),
    ),
    prior=Prior(0.3, "an empirical summary of what the ends do"),
    references=(_TONDU, _KERSCHER),
    examples=(
        Example(
            "force",
            # a = 13.796730, c_b = 5.598910: 0.6 MPa * 78.539816 mm^2 * (a * 0.875^2 - c_b)
            233.9329,
            2e-5,
            _CLOSED_FORM,
            {"factor": 1.25},
            _SIZE_10,
            {"length": 0.09, "pressure": 6e5},
        ),
        Example(
            # D = D0 sqrt(c_b - a/3 * 0.875^2)
            *("diameter", 0.01441482, 2e-5, _CLOSED_FORM, {"factor": 1.25}, _SIZE_10),
            {"length": 0.09, "pressure": 6e5},
        ),
        Example("force", 60.666561, 1e-7, _DECAYED, _DECAYING, _SIZE_10, _AT_DECAY),
        Example("volume", 13.144092e-6, 1e-7, _FROM_WORK, _DECAYING, _SIZE_10, _AT_DECAY),
    ),
)
