r"""Threshold pressure: the gas must first widen the bladder until it touches the braid.

A thin tube of modulus E, wall H and inner radius :math:`r_i` reaches a braid of radius :math:`r_b` at
:math:`P_{th} \approx E H (r_b-r_i)/r_i^2`. The work of the gas below contact is not modelled, so the law is
lumped: force and gas work balance only while the pressure stays above the threshold.

A bladder that touches at one place before another widens the contact over a range :math:`s P_{th}` of
pressures; the loss is then :math:`P_{th}(1-e^{-P/(sP_{th})})`, at most P, which is sharp for s = 0.
"""

from mckibben.physics import ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source

_SHARP = 1e-3  # least softness, where exp() is 0 above a thousandth of the threshold


def pressure(*, pressure: Value, threshold: Value, softness: Value) -> Value:
    """max(P - P_th (1 - exp(-P/(s P_th))), 0) [Pa]; without a threshold P itself."""
    above = ops.positive_part(pressure)
    span = ops.maximum(softness, _SHARP) * ops.maximum(threshold, 1.0)
    # Written as P minus a loss, so that a threshold of 0 leaves negative gauge pressures unchanged.
    return pressure - ops.minimum(threshold * (1.0 - ops.exp(-above / span)), above)


_TUBE = Source("E H (r_b - r_i)/r_i^2 of latex, 1 N/mm², 1 mm, 5 to 6 mm", "D")
_CLOSED_FORM = Source("(P - P_th) A0 (2/sin^2 theta0 - 3), A0 (...) = 643.85527 mm^2", "D")
_SIZE_10 = {"nominal_length": 0.1, "braid_diameter": 0.01, "braid_angle": 0.4363323129985824}

EFFECT = Effect(
    title="Threshold pressure",
    family="elastomer",
    type="static",
    cause="The bladder is narrower than the braid and must first be inflated until it touches it. Below that "
    "pressure there is no force, and above it the effective pressure is lower by this amount.",
    equation=r"P_{eff} = \max\left(P-P_{th}\left(1-e^{-P/(sP_{th})}\right),\,0\right)",
    parameters=(
        Parameter(
            "threshold",
            "P_{th}",
            "Pa",
            default=4.0e4,
            lower=0.0,
            upper=2.0e5,
            source=_TUBE,
            description="Gauge pressure at which the bladder touches the braid.",
            off=0.0,
        ),
        Parameter(
            *("softness", "s", "1", 0.0, 0.0, 2.0, Source("0 = touches everywhere at once", "E")),
            description="Range of pressures over which contact is made, as a share of the threshold.",
            fitted=False,
            natural=True,
        ),
    ),
    slots={"pressure": pressure},
    kinds=frozenset({"isobaric", "isometric", "isotonic", "static", "transient"}),
    signature=Signature(
        text="a dead zone, then a force loss that is constant in pressure and shaped like the ideal force",
        direction="even",
        pressure_power=None,
        zero_at=("zero_pressure", "zero_force_length"),
        energy="lumped",
    ),
    confused_with=(
        Twin("pressure_offset", "vent to the atmosphere and read the pressure sensor"),
        Twin(
            "bladder_elasticity", "force against pressure at several lengths: the bladder's intercept grows"
        ),
        Twin("effectiveness", "force against pressure: the intercept changes, or the slope"),
        Twin("prestress", "lengths near the zero-force length: there the threshold vanishes"),
    ),
    prior=Prior(0.4, "most bladders need some pressure before they touch the braid"),
    references=(
        Source("Colbrunn, Nelson & Quinn, IEEE/RSJ IROS (2001)", "M"),
        Source("Tondu, J. Intell. Mater. Syst. Struct. 23 (2012) 225", "M"),
    ),
    examples=(
        Example(
            "force",
            # 5.6e5 * 643.85527e-6
            360.55895,
            1e-7,
            _CLOSED_FORM,
            {"threshold": 4e4},
            _SIZE_10,
            {"length": 0.1, "pressure": 6e5},
        ),
        Example(
            "force",
            0.0,
            1e-12,
            _CLOSED_FORM,
            {"threshold": 4e4},
            _SIZE_10,
            {"length": 0.1, "pressure": 3e4},
        ),
    ),
)
