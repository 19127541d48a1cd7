r"""Mullins effect: rubber is softer below the largest stretch it has seen (run-in).

With the largest contraction :math:`\varepsilon_m` the muscle has seen,

.. math:: F_{el} \to F_{el}\left[1 - d\left(1-e^{-(\varepsilon_m-\varepsilon)/\varepsilon_c}\right)\right]
   \ (0 \le \varepsilon < \varepsilon_m), \quad \dot\varepsilon_m = \max(\varepsilon-\varepsilon_m,0)/\tau

The state follows within 2 ms, so that its rate has no jump. A muscle that had been contracted by
:math:`\varepsilon_r` before the record has :math:`\varepsilon_m \ge \varepsilon_r`. The model has no
recovery; real rubber recovers in hours or days.
"""

from mckibben.physics import ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, StateVariable, Twin
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source

_FOLLOWING_TIME = 2e-3  # s


def elastomer_factor(
    *, muscle: Muscle, length: Value, largest: Value, loss: Value, strain: Value, run_in: Value
) -> Value:
    """1 - d (1 - exp(-gap/eps_c)) [-] with the gap to the largest contraction; 1 on the virgin curve."""
    gap = ops.positive_part(ops.maximum(largest, run_in) - ops.positive_part(muscle.contraction(length)))
    return 1.0 - loss * (1.0 - ops.exp(-gap / strain))


def rates(*, muscle: Muscle, length: Value, largest: Value) -> tuple[Value]:
    """d eps_m/dt [1/s]; never negative."""
    return (ops.positive_part(muscle.contraction(length) - largest) / _FOLLOWING_TIME,)


_LOSS = Source("first-cycle loss of 5-20 % moulded, 10-40 % hand-made", "E")
_OGDEN = Source("Ogden & Roxburgh, Proc. R. Soc. A 455 (1999) 2861", "M")
_BY_HAND = Source("definition, by hand", "D")
_SIZE_10 = {"nominal_length": 0.1, "braid_diameter": 0.01, "braid_angle": 0.4363323129985824}

EFFECT = Effect(
    title="Mullins effect (run-in)",
    family="elastomer",
    type="hysteretic",
    cause="The first stretch breaks bonds between rubber and filler that recover only over hours. A fresh "
    "muscle is stiffer in its first cycles, until it has been contracted as far as it is used.",
    equation=r"F_{el}\left[1-d\left(1-e^{-(\varepsilon_m-\varepsilon)/\varepsilon_c}\right)\right],\quad "
    r"\varepsilon_m = \max_{t'\le t}\varepsilon(t')",
    parameters=(
        Parameter(
            "loss",
            "d",
            "1",
            default=0.1,
            lower=0.0,
            upper=0.7,
            source=_LOSS,
            description="Largest share of the elastic force that is lost.",
            off=0.0,
        ),
        Parameter(
            "strain",
            r"\varepsilon_c",
            "1",
            default=0.05,
            lower=0.005,
            upper=0.3,
            source=Source("a fifth of the working range", "E"),
            description="Contraction below the largest one over which the loss develops.",
            fitted=False,
        ),
        Parameter(
            *("run_in", r"\varepsilon_r", "1", 0.0, 0.0, 0.4, Source("0 = a new muscle", "D")),
            description="Largest contraction that the muscle had seen before the record.",
            fitted=False,
            natural=True,
            reference=True,
        ),
    ),
    slots={"elastomer_factor": elastomer_factor, "rates": rates},
    states=(
        StateVariable(
            *("largest", r"\varepsilon_m", "1", 0.1, "Largest contraction seen in the record."),
            lasting="run_in",
            largest="contraction",
        ),
    ),
    kinds=frozenset({"isobaric", "isotonic", "transient"}),
    signature=Signature(
        text="the first cycle differs from all later ones; the lost stiffness returns only beyond the "
        "largest contraction so far",
        direction=None,
        pressure_power=0.0,
        zero_at=("no_motion",),
        energy="dissipative",
    ),
    confused_with=(
        Twin("creep", "wait ten minutes and repeat: creep recovers, the first-cycle loss does not"),
        Twin("temperature", "let the muscle cool: heating returns with work, the first-cycle loss does not"),
        Twin("bladder_elasticity", "compare the first cycle with the third"),
    ),
    prior=Prior(0.15, "it shows only before the rubber is run in"),
    references=(_OGDEN, Source("Mullins, Rubber Chem. Technol. 42 (1969) 339", "M")),
    examples=(
        Example(
            "slot:elastomer_factor",
            # 1 - 0.2 (1 - exp(-0.1/0.05))
            0.8270670566473226,
            1e-12,
            _BY_HAND,
            {"loss": 0.2, "strain": 0.05},
            _SIZE_10,
            {"length": 0.09, "largest": 0.2},
        ),
        Example(
            "slot:elastomer_factor",
            1.0,
            1e-12,
            _BY_HAND,
            {"loss": 0.2, "strain": 0.05},
            _SIZE_10,
            {"length": 0.08, "largest": 0.2},
        ),
        Example(
            # of a muscle that had been contracted by 20 % before
            *("slot:elastomer_factor", 0.8270670566473226, 1e-12, _BY_HAND),
            {"loss": 0.2, "strain": 0.05, "run_in": 0.2},
            _SIZE_10,
            {"length": 0.09, "largest": 0.1},
        ),
    ),
)
