r"""Bouc-Wen hysteresis, normalised to A = 1 and |z| <= 1, because the usual set of parameters is redundant.

.. math:: F = F_c\left(\frac{P_+}{P_r}\right)^{q}\left(\frac{L}{L_0}\right)^{m} z, \qquad
   \dot z = \frac{1}{\varepsilon_b L_0}\Bigl[\dot L - \beta|\dot L||z|^{n-1}z - (1-\beta)\,\dot L|z|^n\Bigr]

With n = 1 and :math:`\beta = 1` it is the Dahl law; a large n is bilinear. It takes work over any path from
rest for :math:`\beta \ge 1/2`, which is the lower bound. Where the gas presses the threads
together, q > 0, with :math:`P_r = 3` bar.
"""

from mckibben.physics import ops
from mckibben.physics.contacts import LENGTH_POWER, PRESSURE_POWER, grip
from mckibben.physics.effect import Effect, Example, Prior, Signature, StateVariable, Twin
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source

# |z|^n is computed as (z^2 + this)^(n/2), so that its derivatives by z and by n are finite at z = 0.
_ROUNDING = 1e-12


def friction(
    *,
    pressure: Value,
    length: Value,
    muscle: Muscle,
    presliding: Value,
    force: Value,
    pressure_power: Value,
    length_power: Value,
) -> Value:
    """F_c (P/P_r)^q (L/L_0)^m z [N]."""
    held = grip(
        pressure=pressure, length=length, nominal_length=muscle.nominal_length,
        pressure_power=pressure_power, length_power=length_power,
    )  # fmt: skip
    return force * held * presliding


def rates(
    *,
    velocity: Value,
    muscle: Muscle,
    presliding: Value,
    break_strain: Value,
    exponent: Value,
    unloading_share: Value,
) -> tuple[Value]:
    """dz/dt [1/s]; exactly 0 at rest, and never outwards where |z| = 1."""
    log = 0.5 * ops.log(presliding**2 + _ROUNDING)
    opposing = ops.absolute(velocity) * ops.exp((exponent - 1.0) * log) * presliding
    along = velocity * ops.exp(exponent * log)
    bent = unloading_share * opposing + (1.0 - unloading_share) * along
    return ((velocity - bent) / (break_strain * muscle.nominal_length),)


_BOUC = Source("Wen, J. Eng. Mech. Div. ASCE 102 (1976) 249; Lin et al. 2015 for air muscles", "M")
_RANGE = Source("1-2.5 % of the maximum force", "E")
_WAY = Source("F_c over 15-200 kN/m for size 20: 0.1-3 mm of 300 mm", "E")
_DEFINITION = Source("definition, by hand", "D")
_SIZE_20 = {"nominal_length": 0.3, "braid_diameter": 0.02, "braid_angle": 0.4363323129985824}

EFFECT = Effect(
    title="Bouc-Wen hysteresis",
    family="friction",
    type="hysteretic",
    cause="Threads and elastomer yield gradually before they slide. A single state with a free exponent "
    "describes how sharply the friction force bends over after a reversal.",
    equation=r"F_{h} = F_c\,(P_+/P_r)^q (L/L_0)^m\,z,\quad \varepsilon_b L_0\,\dot z = "
    r"\dot L-\beta|\dot L||z|^{n-1}z-(1-\beta)\dot L|z|^n",
    parameters=(
        Parameter(
            "force",
            "F_c",
            "N",
            default=10.0,
            lower=0.0,
            upper=200.0,
            source=_RANGE,
            description="Friction after a long travel; with a power q, that at 3 bar.",
            off=0.0,
        ),
        Parameter(
            "break_strain",
            r"\varepsilon_b",
            "1",
            default=0.002,
            lower=1.0e-4,
            upper=0.03,
            source=_WAY,
            description="Travel over which friction builds up, as a share of the rest length.",
            fitted=False,
        ),
        Parameter(
            "exponent",
            "n",
            "1",
            default=1.5,
            lower=1.0,
            upper=10.0,
            source=_BOUC,
            description="Sharpness of the bend; a large value gives a bilinear loop.",
            fitted=False,
        ),
        Parameter(
            "unloading_share",
            r"\beta",
            "1",
            default=0.5,
            lower=0.5,
            upper=1.0,
            source=_BOUC,
            description="Bend of the branch after a reversal; 0.5 unloads along a straight line, 1 like "
            "Dahl.",
            fitted=False,
            natural=True,
        ),
        PRESSURE_POWER,
        LENGTH_POWER,
    ),
    slots={"friction": friction, "rates": rates},
    states=(
        StateVariable(
            "presliding", "z", "1", 1.0, "Share of full friction, positive on lengthening.", sliding=1.0
        ),
    ),
    kinds=frozenset({"isobaric", "isotonic", "transient"}),
    signature=Signature(
        text="a loop of constant width at every pressure, with corners of adjustable sharpness",
        direction="odd",
        pressure_power=0.0,
        zero_at=("no_motion",),
        energy="dissipative",
    ),
    confused_with=(
        Twin("dahl", "the branch after a reversal at fine steps; with n = 1 both are the same law"),
        Twin("maxwell_slip", "loops within a loop: only Maxwell slip closes them"),
        Twin("coulomb_friction", "the corners of a loop: Coulomb friction jumps at the reversal"),
    ),
    prior=Prior(0.15, "one particular form of a hysteresis loop, with many constants"),
    references=(_BOUC,),
    examples=(
        Example(
            *("slot:friction", 2.5, 1e-12, _DEFINITION, {"force": 10.0}, _SIZE_20),
            {"presliding": 0.25, "pressure": 2e5, "length": 0.24},
        ),
        Example(
            # 2.5 N sqrt(2), but for the rounding at low pressure
            *("slot:friction", 3.5355339, 1e-6, _DEFINITION, {"force": 10.0, "pressure_power": 0.5}),
            _SIZE_20,
            {"presliding": 0.25, "pressure": 6e5, "length": 0.24},
        ),
        Example(
            "slot:rates",
            # (0.03 - 0.03 * 0.5^2) m/s / 0.6 mm: loading
            37.5,
            1e-9,
            _DEFINITION,
            {"break_strain": 0.002, "exponent": 2.0, "unloading_share": 0.5},
            _SIZE_20,
            {"velocity": 0.03, "presliding": 0.5},
        ),
    ),
)
