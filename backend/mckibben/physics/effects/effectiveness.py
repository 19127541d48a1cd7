r"""Effectiveness: all losses lumped into one factor, optionally with a pressure to overcome first.

:math:`F = E\,(1 - P_0/P)_+\,F_\text{ideal}`: a constant factor when :math:`P_0 = 0`, the threshold form
otherwise. It scales the force without touching the volume, so it stores no energy and dissipates none: it
is a correction, not a mechanism. A constant factor does not change the largest contraction of the ideal
model. Where the loss fades with pressure instead of ending at one,

.. math:: F = E\,\bigl(1 - P_0/P\bigr)_+\bigl(1 - s_0 e^{-P/P_s}\bigr)\,F_\text{ideal}
"""

from mckibben.physics import ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source

# Lower bound of P in P0/P [Pa], so that it stays finite at P = 0, where the force is 0 anyway.
_LEAST_PRESSURE = 1.0


def force_factor(
    *, pressure: Value, factor: Value, threshold: Value, fading_loss: Value, decay_pressure: Value
) -> Value:
    """E max(1 - P0/P, 0) (1 - s0 exp(-P/Ps)) [-]."""
    above = ops.positive_part(pressure)
    faded = 1.0 - fading_loss * ops.exp(-above / decay_pressure)
    return factor * ops.positive_part(1.0 - threshold / ops.maximum(pressure, _LEAST_PRESSURE)) * faded


_COLBRUNN = Source("Colbrunn, Nelson & Quinn, IEEE/RSJ IROS (2001)", "M")
_RANGE = Source("0.94-1.05 for moulded, 0.6-1.0 for hand-made muscles", "E")
_CLOSED_FORM = Source("factor times the blocked force P A0 (2/sin^2 theta0 - 3) = 386.31316 N", "D")
_SIZE_10 = {"nominal_length": 0.1, "braid_diameter": 0.01, "braid_angle": 0.4363323129985824}
_BLOCKED = {"length": 0.1, "pressure": 6e5}

EFFECT = Effect(
    title="Effectiveness",
    family="geometry",
    type="static",
    cause="Ends, bladder and braid take up part of the work of the gas. While the single causes are unknown, "
    "their sum is described by the ratio of real to ideal force.",
    equation=r"F = E\,\max\left(1-\frac{P_0}{P},\,0\right)\left(1-s_0 e^{-P/P_s}\right) F_{ideal}",
    parameters=(
        Parameter(
            "factor",
            "E",
            "1",
            default=0.9,
            lower=0.3,
            upper=1.3,
            source=_RANGE,
            description="Real over ideal force at high pressure.",
            off=1.0,
            measured=(0.6, 1.05),
        ),
        Parameter(
            "threshold",
            "P_0",
            "Pa",
            default=0.0,
            lower=0.0,
            upper=1.5e5,
            source=Source("5-120 kPa over all sizes", "E"),
            description="Gauge pressure below which the muscle does not pull; 0 is a constant factor.",
            off=0.0,
            fitted=False,
        ),
        Parameter(
            "fading_loss",
            "s_0",
            "1",
            default=0.0,
            lower=0.0,
            upper=1.0,
            source=Source("0 for a constant factor, 1 where the force only sets in with pressure", "E"),
            description="Additional share of the force lost at very low pressure; it fades with pressure.",
            off=0.0,
            fitted=False,
            natural=True,
        ),
        Parameter(
            "decay_pressure",
            "P_s",
            "Pa",
            default=1.0e5,
            lower=2.0e4,
            upper=1.0e6,
            source=Source("bladders seat on the braid within 0.2-2 bar", "E"),
            description="Pressure over which the additional loss fades to 37 %.",
            fitted=False,
        ),
    ),
    slots={"force_factor": force_factor},
    kinds=frozenset({"isobaric", "isometric", "isotonic", "static", "transient"}),
    signature=Signature(
        text="a constant share of the ideal force: proportional to pressure, the same shape over contraction",
        direction="even",
        pressure_power=1.0,
        zero_at=("zero_pressure", "zero_force_length"),
        energy="lumped",
    ),
    confused_with=(
        Twin(
            "pressure_scale",
            "a pressure calibrator; no muscle test can tell them apart",
            by_muscle_test=False,
        ),
        Twin("force_scale", "dead weights on the force sensor"),
        Twin("threshold_pressure", "force against pressure: the slope changes, or the intercept does"),
        Twin(
            "wall_thickness", "measure wall and braid diameter; the wall's share shrinks towards 45 degrees"
        ),
        Twin(
            "bladder_elasticity",
            "force against pressure at four lengths: the slope changes, or the intercept",
        ),
    ),
    prior=Prior(0.3, "an empirical factor for everything that scales the force"),
    references=(_COLBRUNN,),
    examples=(
        Example(
            "force",
            347.68184,
            1e-7,
            _CLOSED_FORM,
            {"factor": 0.9, "threshold": 0.0},
            _SIZE_10,
            _BLOCKED,
        ),
        Example(
            "force",
            # 0.9 (1 - 1/6) 386.31316
            289.73487,
            1e-7,
            _CLOSED_FORM,
            {"factor": 0.9, "threshold": 1e5},
            _SIZE_10,
            _BLOCKED,
        ),
        Example(
            "force",
            # 0.9 (1 - 0.5 exp(-2)) 386.31316
            324.155034,
            1e-7,
            _CLOSED_FORM,
            {"factor": 0.9, "fading_loss": 0.5, "decay_pressure": 3e5},
            _SIZE_10,
            _BLOCKED,
        ),
    ),
)
