r"""Thread extensibility of Davis: the tension of the threads lengthens them.

N threads carry :math:`N T_t = P b' L/(2\pi n^2)` and lengthen by :math:`b'/b - 1 = N T_t/(N E_t A_t)`, hence

.. math:: b' = \frac{b}{1-q}, \qquad q = \frac{P\,b\,L}{2\pi n^2\,N E_t A_t} .

The tension is that of the stretched braid, so b' is where the work of the gas and the energy
:math:`\tfrac12 N E_t A_t b (b'/b-1)^2` of the threads balance, and :math:`\oint (F\,dL + P\,dV) = 0` over any
closed path in P and L, with the volume of the stretched braid.
"""

from mckibben.physics import ops
from mckibben.physics.braid import Braid
from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source

# Upper bound that keeps the law finite: threads break long before they double in length.
_LARGEST_Q = 0.5


def braid(*, braid: Braid, pressure: Value, length: Value, compliance: Value) -> Braid:
    """The braid with stretched threads and the same turns."""
    unit_tension = pressure * braid.thread_length * length / (2.0 * ops.pi * braid.turns**2)
    q = ops.minimum(compliance * unit_tension, _LARGEST_Q)
    return Braid(braid.thread_length / (1.0 - q), braid.turns)


_DAVIS = Source("Davis, Tsagarakis, Canderle & Caldwell, Int. J. Robotics Res. 22 (2003) 213", "M")
_STIFF = Source("N E_t A_t 60 kN to 12 MN moulded, 2-60 kN hand-made nylon or PET", "E")
_CLOSED_FORM = Source("P (b^2 - b'^2)/(4 pi n^2) evaluated by hand", "D")
_SIZE_10 = {"nominal_length": 0.1, "braid_diameter": 0.01, "braid_angle": 0.4363323129985824}
_BLOCKED = {"length": 0.1, "pressure": 6e5}

EFFECT = Effect(
    title="Thread extensibility",
    family="geometry",
    type="static",
    cause="The threads carry the gas pressure around and along the muscle and stretch under it. A longer "
    "thread at the same length means a larger braid angle, and so less pull.",
    equation=r"F = \frac{P\,(3L^2-b'^2)}{4\pi n^2},\quad b' = \frac{b}{1-q},\quad "
    r"q = \frac{P\,b\,L}{2\pi n^2\,N E_t A_t}",
    parameters=(
        Parameter(
            "compliance",
            r"\frac{1}{N E_t A_t}",
            "1/N",
            default=1.0e-6,
            lower=0.0,
            upper=1.0e-4,
            source=_STIFF,
            description="Strain of the threads per total tension, 1/(N E_t A_t).",
            off=0.0,
        ),
    ),
    slots={"braid": braid},
    kinds=frozenset({"isobaric", "isometric", "isotonic", "diameter", "static", "transient"}),
    signature=Signature(
        text="a force loss that grows with nearly the square of pressure and hardly depends on contraction; "
        "the diameter grows with pressure at constant length",
        direction="even",
        pressure_power=None,
        zero_at=("zero_pressure",),
        energy="conservative",
    ),
    confused_with=(
        Twin("rig_compliance", "diameter against pressure at constant length, or a rigid rod for the muscle"),
        Twin("pressure_scale", "a pressure calibrator at several pressures"),
        Twin("creep", "hold the pressure: the stretch of the threads does not increase"),
    ),
    prior=Prior(0.2, "aramid and polyester threads stretch little at usual forces"),
    references=(_DAVIS,),
    examples=(
        Example(
            "force_change",
            # N T_t = 478.24487 N, q = 4.7824487e-3: -6e5 * 0.1103378^2 (1/(1-q)^2 - 1)/(4 pi * 1.4843034^2)
            -2.541845,
            1e-6,
            _CLOSED_FORM,
            {"compliance": 1.0e-5},
            _SIZE_10,
            _BLOCKED,
        ),
    ),
)
