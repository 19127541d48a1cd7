r"""Deadband of a valve with overlap: nothing flows within :math:`\pm\delta` of the middle position.

.. math:: x_{eff} = \operatorname{sgn}x\;\frac{\max(|x|-\delta,\,0)}{1-\delta}

Full command is still full opening, at which the conductance of the data sheet is measured.
"""

from mckibben.physics import ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def opening(*, opening: Value, half_width: Value) -> Value:
    """The opening beyond the overlap [-]; exactly 0 within it, +-1 at full command."""
    beyond = ops.positive_part(opening - half_width) - ops.positive_part(-opening - half_width)
    return beyond / (1.0 - half_width)


_RANGE = Source("1-5 % of the span around the middle position of proportional spool valves", "E")
_BY_HAND = Source("-(0.62 - 0.05)/0.95", "D")

EFFECT = Effect(
    title="Deadband of the valve",
    family="valve",
    type="static",
    cause="The edges of the spool overlap the ports, so that a closed valve is tight. Small commands around "
    "the middle move no air, and a controller hunts across them.",
    equation=r"x_{eff} = \operatorname{sgn}x\,\frac{\max(|x|-\delta,\,0)}{1-\delta}",
    parameters=(
        Parameter(
            "half_width",
            r"\delta",
            "1",
            default=0.02,
            lower=0.0,
            upper=0.3,
            source=_RANGE,
            description="Opening on either side of the middle at which flow begins.",
            off=0.0,
        ),
    ),
    slots={"opening": opening},
    kinds=frozenset({"transient"}),
    signature=Signature(
        text="no change of pressure for small commands, and a limit cycle or a lasting error under control",
        direction=None,
        pressure_power=None,
        zero_at=(),
        energy="lumped",
    ),
    confused_with=(
        Twin("coulomb_friction", "log the pressure: in a deadband it stands still, under friction it moves"),
        Twin("threshold_pressure", "log the pressure: in a deadband it stands still"),
        Twin("valve_hysteresis", "a slow command up and down: a deadband has no loop"),
    ),
    prior=Prior(0.25, "spools overlap their ports unless they are lapped"),
    references=(_RANGE,),
    examples=(
        Example("slot:opening", -0.6, 1e-12, _BY_HAND, {"half_width": 0.05}, {}, {"opening": -0.62}),
        Example("slot:opening", 0.0, 1e-12, _BY_HAND, {"half_width": 0.05}, {}, {"opening": 0.05}),
    ),
)
