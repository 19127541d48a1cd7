r"""Dahl friction: Coulomb friction that builds up over a short travel after each reversal.

With the break-away distance :math:`x_b = \varepsilon_b L_0` and the share z of full friction

.. math:: F = F_c\left(\frac{P_+}{P_r}\right)^{q}\left(\frac{L}{L_0}\right)^{m} g\,z,
   \qquad P_r = 3\ \mathrm{bar}, \qquad g = 1 + (\sigma - 1)\,e^{-(\dot L/v_s)^2}

.. math:: \frac{dz}{dL} = \frac{(1 - z\operatorname{sgn}\dot L)^i}{x_b}

With :math:`\sigma = F_s/F_c \neq 1` slow sliding takes another force than fast sliding (Stribeck). That is
the LuGre law but for the way of building up, which here does not grow with g; its viscous part is an effect
of its own.

Dahl's stiffness is :math:`\sigma_0 = F_c/x_b` from rest, and :math:`2^i` times that after a reversal at full
friction. His exponent i is 1 where the rest of the way is covered exponentially, larger for ductile and
smaller for brittle contacts. Where the gas presses the contacts together, q > 0. Because z is a share, the
force is exactly zero for F_c = 0. Minor loops do not close.
"""

from mckibben.physics import ops
from mckibben.physics.contacts import LENGTH_POWER, PRESSURE_POWER, grip
from mckibben.physics.effect import Effect, Example, Prior, Signature, StateVariable, Twin
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source
from mckibben.physics.presliding import build_up


def friction(
    *,
    pressure: Value,
    length: Value,
    velocity: Value,
    muscle: Muscle,
    presliding: Value,
    force: Value,
    pressure_power: Value,
    length_power: Value,
    static_ratio: Value,
    stribeck_speed: Value,
) -> Value:
    """F_c (P/P_r)^q (L/L_0)^m (1 + (sigma - 1) exp(-(v/v_s)^2)) z [N]."""
    held = grip(
        pressure=pressure, length=length, nominal_length=muscle.nominal_length,
        pressure_power=pressure_power, length_power=length_power,
    )  # fmt: skip
    sliding = 1.0 + (static_ratio - 1.0) * ops.exp(-((velocity / stribeck_speed) ** 2))
    return force * held * sliding * presliding


def rates(
    *, velocity: Value, muscle: Muscle, presliding: Value, break_strain: Value, exponent: Value
) -> tuple[Value]:
    """dz/dt [1/s]: v (1 - z sgn v)^i/x_b; exactly 0 at rest."""
    rising = build_up(rate=velocity, share=presliding, exponent=exponent)
    return (rising / (break_strain * muscle.nominal_length),)


_DAHL = Source("Dahl, Aerospace Corp. TOR-0158(3107-18)-1 (1968); AIAA J. 14 (1976) 1675", "M")
_RANGE = Source("1-2.5 % of the maximum force", "E")
_WAY = Source("F_c over 15-200 kN/m for size 20: 0.1-3 mm of 300 mm", "E")
_RATIO = Source("static over sliding friction of threads 0.5 (Tondu) to 1.6", "E")
_STRIBECK = Source("Armstrong-Helouvry, Dupont & Canudas de Wit, Automatica 30 (1994) 1083: some mm/s", "M")
_LUGRE = Source("Canudas de Wit et al., IEEE Trans. Autom. Control 40 (1995) 419", "M")
_DEFINITION = Source("definition, by hand", "D")
_SIZE_20 = {"nominal_length": 0.3, "braid_diameter": 0.02, "braid_angle": 0.4363323129985824}

EFFECT = Effect(
    title="Dahl friction",
    family="friction",
    type="hysteretic",
    cause="Threads in contact shear elastically before they slide. After a reversal the friction therefore "
    "changes sign smoothly, over a short travel of the muscle.",
    equation=r"F_{h} = F_c\,(P_+/P_r)^q (L/L_0)^m\left[1+(\sigma-1)e^{-(\dot L/v_s)^2}\right] z,\quad "
    r"\dot z = \frac{\dot L\,(1-z\operatorname{sgn}\dot L)^i}{\varepsilon_b L_0}",
    parameters=(
        Parameter(
            *("force", "F_c", "N", 10.0, 0.0, 200.0, _RANGE),
            description="Friction after a long travel; with a power q, that at 3 bar.",
            off=0.0,
        ),
        Parameter(
            *("break_strain", r"\varepsilon_b", "1", 0.002, 1.0e-4, 0.03, _WAY),
            description="Travel over which friction builds up, as a share of the rest length.",
            fitted=False,
        ),
        Parameter(
            *("exponent", "i", "1", 1.0, 0.5, 3.0),
            Source("Dahl (1968): 0 to 1 brittle, 1 and more ductile contacts", "M"),
            description="Exponent of Dahl's law: 1 builds up exponentially, more builds up more slowly.",
            fitted=False,
        ),
        PRESSURE_POWER,
        LENGTH_POWER,
        Parameter(
            *("static_ratio", r"\sigma", "1", 1.0, 0.3, 3.0, _RATIO),
            description="Friction of slow sliding over that of fast sliding.",
            fitted=False,
            off=1.0,
        ),
        Parameter(
            *("stribeck_speed", "v_s", "m/s", 0.003, 2e-4, 0.1, _STRIBECK),
            description="Speed over which slow sliding becomes fast sliding.",
            fitted=False,
        ),
    ),
    slots={"friction": friction, "rates": rates},
    states=(
        StateVariable(
            "presliding", "z", "1", 1.0, "Share of full friction, positive on lengthening.", sliding=1.0
        ),
    ),
    kinds=frozenset({"isobaric", "isotonic", "transient"}),
    signature=Signature(
        text="a loop of constant width at every pressure, with rounded corners, the same at every speed",
        direction="odd",
        pressure_power=0.0,
        zero_at=("no_motion",),
        energy="dissipative",
    ),
    confused_with=(
        Twin("coulomb_friction", "the corners of a loop: Coulomb friction jumps at the reversal"),
        Twin("maxwell_slip", "loops within a loop: only Maxwell slip closes them"),
        Twin("bouc_wen", "the branch after a reversal at fine steps; the shapes are very similar"),
        Twin("viscous_damping", "three speeds over two decades: Dahl friction does not change"),
        Twin("pressure_hysteresis", "a pressure loop at constant length: Dahl friction shows no loop"),
    ),
    prior=Prior(0.25, "one particular form of friction before sliding"),
    references=(_DAHL, _LUGRE),
    examples=(
        Example(
            *("slot:friction", -7.5, 1e-12, _DEFINITION, {"force": 10.0}, _SIZE_20),
            {"presliding": -0.75, "pressure": 2e5, "length": 0.24, "velocity": 0.0},
        ),
        Example(
            # -7.5 N sqrt(2) 0.8^2, but for the rounding at low pressure
            *("slot:friction", -6.7882251, 1e-6, _DEFINITION),
            {"force": 10.0, "pressure_power": 0.5, "length_power": 2.0},
            _SIZE_20,
            {"presliding": -0.75, "pressure": 6e5, "length": 0.24, "velocity": 0.0},
        ),
        Example(
            # (-0.03 - 0.03 * 0.5) m/s / 0.6 mm
            *("slot:rates", -75.0, 1e-12, _DEFINITION, {"break_strain": 0.002}, _SIZE_20),
            {"velocity": -0.03, "presliding": 0.5},
        ),
        Example(
            # -7.5 N (1 + 0.5/e) at the Stribeck speed
            *("slot:friction", -8.879548, 1e-6, _DEFINITION),
            {"force": 10.0, "static_ratio": 1.5, "stribeck_speed": 0.003},
            _SIZE_20,
            {"presliding": -0.75, "pressure": 2e5, "length": 0.24, "velocity": -0.003},
        ),
    ),
)
