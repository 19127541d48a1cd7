r"""A lower conductance of the tube than calculated, :math:`C_t' = f_t\,C_t`: bends, fittings, a kink.

It acts on drives with a tube; the conductance of the straight tube is that of `mckibben.physics.gas`.
"""

from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def tube_conductance(*, conductance: Value, factor: Value) -> Value:
    """f_t C_t [m^3/(s Pa)]."""
    return factor * conductance


_RANGE = Source("push-in fittings and bends take 10-50 %", "E")
_DEFINITION = Source("definition", "D")

EFFECT = Effect(
    title="Resistance of the tube",
    family="tube",
    type="static",
    cause="Fittings, bends and kinks narrow the tube beyond its own wall friction. The pressure in the "
    "muscle lags behind that at the valve, more so the faster the air flows.",
    equation=r"C_t' = f_t\,C_t",
    parameters=(
        Parameter(
            "factor",
            "f_t",
            "1",
            default=0.7,
            lower=0.05,
            upper=2.0,
            source=_RANGE,
            description="Conductance over that of the straight tube.",
            off=1.0,
            with_force=True,  # the tube of a large muscle is often wider than the one assumed
        ),
    ),
    slots={"tube_conductance": tube_conductance},
    kinds=frozenset({"transient"}),
    signature=Signature(
        text="a pressure difference between valve and muscle that grows with the square of the flow",
        direction=None,
        pressure_power=None,
        zero_at=(),
        energy="dissipative",
    ),
    confused_with=(
        Twin("flow_coefficient", "a second pressure sensor at the valve"),
        Twin("tube_delay", "a small step: the delay remains, the pressure difference vanishes"),
        Twin("dead_volume", "a second pressure sensor at the valve"),
    ),
    prior=Prior(0.4, "every tube throttles, and its length is seldom stated exactly"),
    references=(Source("Beater, Pneumatic Drives (2007)", "M"),),
    examples=(
        Example(
            "slot:tube_conductance", 6e-9, 1e-12, _DEFINITION, {"factor": 0.5}, {}, {"conductance": 1.2e-8}
        ),
    ),
)
