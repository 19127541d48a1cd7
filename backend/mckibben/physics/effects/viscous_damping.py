r"""Viscous damping that may grow with pressure and differ between shortening and lengthening.

.. math:: F = (c_0 + c_P P)\,(L_r/L_0)^m\,r\,\Bigl|\frac{\dot L}{v_r}\Bigr|^{n-1}\dot L,
   \quad r = 1\ (\dot L<0),\quad r = r_l\ (\dot L>0)

At the reference speed :math:`v_r = 0.1\,m/s` the coefficient is force over speed for any exponent n. Below
about 0.1 mm/s the law becomes linear, so that its slope stays finite at rest for n < 1. A wall that resists
its rate of strain has a coefficient that goes with 1/L0, m = 1: it is then that of a muscle of
:math:`L_r = 250\,mm`. With m = 0 it is that of the muscle itself.
Reynolds' hand-made muscle: 1010 N s/m + 6.91e-3 N s/(m Pa) on shortening, a tenth of it on lengthening.
"""

from mckibben.physics import ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source

REFERENCE_SPEED, REFERENCE_LENGTH = 0.1, 0.25  # m/s, m
# Below this speed [m/s] the power of the speed is constant.
_CREEPING = 1e-4


def friction(
    *,
    muscle: Muscle,
    velocity: Value,
    pressure: Value,
    coefficient: Value,
    pressure_coefficient: Value,
    lengthening_ratio: Value,
    exponent: Value,
    length_power: Value,
) -> Value:
    """(c0 + c_P P) (L_r/L0)^m r |v/v_r|^(n-1) v [N]; 0 at rest. Below the atmosphere c_P adds nothing."""
    scale = (REFERENCE_LENGTH / muscle.nominal_length) ** length_power
    ratio = ops.where(ops.greater(velocity, 0.0), lengthening_ratio, 1.0)
    linear = (coefficient + pressure_coefficient * ops.positive_part(pressure)) * scale * ratio * velocity
    squared = (velocity**2 + _CREEPING**2) / (REFERENCE_SPEED**2 + _CREEPING**2)
    return linear * squared ** (0.5 * (exponent - 1.0))


_REYNOLDS = Source("Reynolds et al., Ann. Biomed. Eng. 31 (2003) 310, coefficients second-hand", "S2")
_RANGE = Source("50-500 N s/m for size 20, 280-3800 N s/m hand-made at 2-6 bar", "E")
_POWER = Source("powers of 0.5 to 1 reported for McKibben muscles; 2 would be a throttled flow", "M")
_STRAIN = Source("1: the same stress at the same rate of strain", "D")
_BY_HAND = Source("1.01 + 0.00691 P N s/mm with P = 400 kPa, times 10 mm/s", "D")
_POWER_BY_HAND = Source("200 N s/m * 25 mm/s * (25/100)^-0.5, 4e-6 of it rounded off", "D")
_SIZE_20 = {"nominal_length": 0.3, "braid_diameter": 0.02, "braid_angle": 0.4363323129985824}
_HAND_MADE = {"coefficient": 1010.0, "pressure_coefficient": 6.91e-3, "lengthening_ratio": 0.074}

EFFECT = Effect(
    title="Viscous damping",
    family="friction",
    type="rate",
    cause="Elastomer, lubricated threads and the flow within the wall resist fast motion. The force is lower "
    "while the muscle shortens and higher while it lengthens, increasingly so at higher speed.",
    equation=r"F_{v} = (c_0 + c_P P)\left(\frac{L_r}{L_0}\right)^m r"
    r"\left|\frac{\dot L}{v_r}\right|^{n-1}\dot L,\quad "
    r"r = 1\ (\dot L<0),\ r = r_l\ (\dot L>0),\quad v_r = 0.1\,\mathrm{m/s}",
    parameters=(
        Parameter(
            *("coefficient", "c_0", "N*s/m"),
            default=200.0,
            lower=0.0,
            upper=5000.0,
            source=_RANGE,
            description="Damping coefficient without pressure: force over speed, at 0.1 m/s when the "
            "exponent is not 1.",
            off=0.0,
        ),
        Parameter(
            *("pressure_coefficient", "c_P", "N*s/(m*Pa)"),
            default=0.0,
            lower=0.0,
            upper=2.0e-2,
            source=_REYNOLDS,
            description="Growth of the damping coefficient with pressure; 6.9e-3 N s/(m Pa) in "
            "Reynolds' muscle.",
            off=0.0,
            fitted=False,
        ),
        Parameter(
            *("lengthening_ratio", "r_l", "1"),
            default=1.0,
            lower=0.0,
            upper=2.0,
            source=_REYNOLDS,
            description="Damping on lengthening as a share of that on shortening; 0.07 in Reynolds' muscle.",
            fitted=False,
        ),
        Parameter(
            *("exponent", "n", "1"),
            default=1.0,
            lower=0.3,
            upper=2.0,
            source=_POWER,
            description="Exponent of the force over the speed; 1 is linear damping.",
            fitted=False,
        ),
        Parameter(
            *("length_power", "m", "1"),
            default=0.0,
            lower=0.0,
            upper=1.0,
            source=_STRAIN,
            description="Power of 250 mm over the rest length; 0 = the coefficients are the muscle's own.",
            fitted=False,
            reference=True,
        ),
    ),
    slots={"friction": friction},
    kinds=frozenset({"isobaric", "isotonic", "transient"}),
    signature=Signature(
        text="a loop whose width grows with the speed and vanishes for slow motion",
        direction="odd",
        pressure_power=0.0,
        zero_at=("no_motion",),
        energy="dissipative",
    ),
    confused_with=(
        Twin("coulomb_friction", "three speeds over two decades: Coulomb friction does not change"),
        Twin("pressure_friction", "three speeds at three pressures, crossed"),
        Twin("sensor_lag", "isometric pressure steps: without motion only the sensor lags"),
        Twin("time_skew", "swap the channels, or a tap on the rig that every channel records"),
        Twin("creep", "a fast step: creep goes on for seconds after the motion has stopped"),
    ),
    prior=Prior(0.5, "rubber and braid resist every fast motion"),
    references=(
        _REYNOLDS,
        Source("Serres, Reynolds et al., Comput. Methods Biomech. Biomed. Eng. 12 (2009) 423", "M"),
    ),
    examples=(
        Example(
            "force_change",
            -37.74,
            1e-9,
            _BY_HAND,
            _HAND_MADE,
            _SIZE_20,
            {"length": 0.28, "pressure": 4e5, "velocity": -0.01, "direction": -1.0},
        ),
        Example(
            "force_change",
            # 0.074 of 37.74 N
            2.79276,
            1e-9,
            _BY_HAND,
            _HAND_MADE,
            _SIZE_20,
            {"length": 0.28, "pressure": 4e5, "velocity": 0.01, "direction": 1.0},
        ),
        Example(
            "force_change",
            -10.0,
            1e-5,
            _POWER_BY_HAND,
            {"coefficient": 200.0, "exponent": 0.5},
            _SIZE_20,
            {"length": 0.28, "pressure": 4e5, "velocity": -0.025, "direction": -1.0},
        ),
        Example(
            *("force_change", 1.0, 1e-9, Source("60 N s/m * 250/300 * 20 mm/s", "D")),
            {"coefficient": 60.0, "length_power": 1.0},
            _SIZE_20,
            {"length": 0.28, "pressure": 4e5, "velocity": 0.02, "direction": 1.0},
        ),
    ),
)
