r"""The valve's conductance differs from its data sheet by one factor, :math:`C' = f_C\,C`, both ways."""

from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def conductance(*, conductance: Value, factor: Value) -> Value:
    """f_C C [m^3/(s Pa)]."""
    return factor * conductance


_RANGE = Source("tolerance of nominal flows 10-20 %, ports and elbows in series up to a half", "E")
_DEFINITION = Source("definition", "D")

EFFECT = Effect(
    title="Conductance of the valve",
    family="valve",
    type="static",
    cause="A nominal flow is measured under one condition and with large ports. Ports, elbows and silencers "
    "in the real circuit, and the tolerance of the valve, make it pass less.",
    equation=r"C' = f_C\,C",
    parameters=(
        Parameter(
            "factor",
            "f_C",
            "1",
            default=0.85,
            lower=0.1,
            upper=3.0,
            source=_RANGE,
            description="Conductance over that of the data sheet.",
            off=1.0,
        ),
    ),
    slots={"fill_conductance": conductance, "exhaust_conductance": conductance},
    kinds=frozenset({"transient"}),
    signature=Signature(
        text="filling and venting take longer by one factor",
        direction=None,
        pressure_power=None,
        zero_at=(),
        energy="dissipative",
    ),
    confused_with=(
        Twin("dead_volume", "a rigid vessel of known volume in place of the muscle gives the conductance"),
        Twin("exhaust_restriction", "filling and venting: a restricted exhaust slows venting alone"),
        Twin("tube_resistance", "a second pressure sensor at the valve"),
        Twin("supply_droop", "log the supply pressure"),
    ),
    prior=Prior(0.5, "data sheets state conductances for the bare valve, without its fittings"),
    references=(Source("ISO 6358", "M"),),
    examples=(
        Example(
            "slot:fill_conductance", 8.5e-9, 1e-12, _DEFINITION, {"factor": 0.85}, {}, {"conductance": 1e-8}
        ),
        Example(
            "slot:exhaust_conductance", 1.5e-8, 1e-12, _DEFINITION, {"factor": 1.5}, {}, {"conductance": 1e-8}
        ),
    ),
)
