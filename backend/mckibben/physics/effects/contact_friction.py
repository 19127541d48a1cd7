r"""Contact friction of Tondu and Lopez: strands rub over a contact area that changes with contraction.

.. math:: F = f(v)\,P\,S(\varepsilon)\operatorname{sgn} v,
   \quad S = \pi D_0 L_0\frac{\sin 2\theta_0}{\sin 2\theta}, \quad f = f_k + (f_s - f_k)\,e^{-|v|/v_s}

The published coefficients have :math:`f_k > f_s`: friction rises with speed.
"""

from mckibben.physics import ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source

# S has a pole at the braid lock (theta = 0), far outside any working range; lower bound of sin(theta)^2.
_LEAST_SINE_SQUARED = 0.01


def contact_area(*, muscle: Muscle, length: Value) -> Value:
    """S = pi D0 L0 sin(2 theta0)/sin(2 theta) [m^2]; smallest at a braid angle of 45 degrees."""
    cosine = length / muscle.braid.thread_length
    sine = ops.sqrt(ops.maximum(1.0 - cosine**2, _LEAST_SINE_SQUARED))
    rest = ops.pi * muscle.braid_diameter * muscle.nominal_length
    return rest * ops.sin(muscle.braid_angle) * ops.cos(muscle.braid_angle) / (sine * cosine)


def friction(
    *,
    muscle: Muscle,
    length: Value,
    pressure: Value,
    velocity: Value,
    direction: Value,
    static_coefficient: Value,
    kinetic_coefficient: Value,
    stribeck_speed: Value,
) -> Value:
    """f(v) P S(eps) sgn(dL/dt) [N]; 0 at rest and at or below atmospheric pressure."""
    fading = ops.exp(-ops.absolute(velocity) / stribeck_speed)
    coefficient = kinetic_coefficient + (static_coefficient - kinetic_coefficient) * fading
    area = contact_area(muscle=muscle, length=length)
    return coefficient * ops.positive_part(pressure) * area * direction


_TONDU = Source("Tondu & Lopez, IEEE Control Systems 20(2) (2000) 15, second-hand", "S2")
_BY_HAND = Source("f P pi D0 L0 at the rest length, by hand", "D")
_SIZE_20 = {"nominal_length": 0.3, "braid_diameter": 0.02, "braid_angle": 0.4363323129985824}
_VALUES = {"static_coefficient": 0.015, "kinetic_coefficient": 0.105, "stribeck_speed": 0.15}
_NOMINAL = {"length": 0.3, "pressure": 3e5}

EFFECT = Effect(
    title="Contact friction (Tondu)",
    family="friction",
    type="rate",
    cause="The gas presses the strands of the braid together, and they rub on each other. The area in "
    "contact follows the braid angle, and the coefficient follows the speed.",
    equation=r"F_{fr} = \left[f_k+(f_s-f_k)e^{-|\dot L|/v_s}\right] P\,"
    r"\pi D_0L_0\frac{\sin 2\theta_0}{\sin 2\theta}\,\operatorname{sgn}\dot L",
    parameters=(
        Parameter(
            "static_coefficient",
            "f_s",
            "1",
            default=0.015,
            lower=0.0,
            upper=0.1,
            source=_TONDU,
            description="Coefficient at low speed.",
            off=0.0,
        ),
        Parameter(
            "kinetic_coefficient",
            "f_k",
            "1",
            default=0.105,
            lower=0.0,
            upper=0.3,
            source=_TONDU,
            description="Coefficient at high speed.",
            off=0.0,
        ),
        Parameter(
            "stribeck_speed",
            "v_s",
            "m/s",
            default=0.15,
            lower=0.01,
            upper=1.0,
            source=_TONDU,
            description="Speed of the transition between the two coefficients.",
            fitted=False,
        ),
    ),
    slots={"friction": friction},
    kinds=frozenset({"isobaric", "isotonic", "static", "transient"}),
    signature=Signature(
        text="a loop that widens with pressure and speed, and shrinks with contraction towards 45 degrees",
        direction="odd",
        pressure_power=1.0,
        zero_at=("no_motion", "zero_pressure"),
        energy="dissipative",
    ),
    confused_with=(
        Twin("pressure_friction", "two muscle lengths: contact friction grows with the length"),
        Twin("coulomb_friction", "loops at three pressures: width growing with pressure or constant"),
        Twin("viscous_damping", "speeds over two decades: contact friction levels off"),
    ),
    prior=Prior(0.25, "one particular form of the friction between threads"),
    references=(_TONDU,),
    examples=(
        Example(
            # 0.015 * 3e5 * pi * 0.02 * 0.3
            *("force_change", 84.823002, 1e-7, _BY_HAND, _VALUES, _SIZE_20, {**_NOMINAL, "direction": 1.0}),
        ),
        Example(
            # v = -v_s: 0.105 - 0.09/e = 0.0718908503 times 5654.8668 N
            *("force_change", -406.533181, 1e-7, _BY_HAND, _VALUES, _SIZE_20),
            {**_NOMINAL, "velocity": -0.15, "direction": -1.0},
        ),
    ),
)
