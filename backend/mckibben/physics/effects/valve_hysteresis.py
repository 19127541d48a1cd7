r"""Hysteresis of the valve: the spool follows its command with a play (backlash) of full width w.

.. math:: \tau\,\dot y = \max\!\bigl(u-\tfrac w2-y,\,0\bigr) - \max\!\bigl(y-u-\tfrac w2,\,0\bigr)

This is the play operator with a lag of :math:`\tau = 0.2` ms, so that the state does not jump with the
command.
"""

from mckibben.physics import ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, StateVariable, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source

_FOLLOWING_TIME = 2e-4  # s


def opening(*, opening: Value, position: Value, width: Value) -> Value:
    """The position behind the play [-]; the command itself without a play."""
    return ops.where(ops.greater(width, 0.0), position, opening)


def drive_rates(*, opening: Value, position: Value, width: Value) -> tuple[Value]:
    """dy/dt [1/s]; 0 while the command stays within the play."""
    pushed = ops.positive_part(opening - 0.5 * width - position)
    pulled = ops.positive_part(position - opening - 0.5 * width)
    return (ops.where(ops.greater(width, 0.0), 1.0, 0.0) * (pushed - pulled) / _FOLLOWING_TIME,)


_RANGE = Source("0.4 % of the span for spool valves, 0.5-2 % for pressure regulators", "M")
_BY_HAND = Source("(0.5 - 0.02 - 0.3)/0.2 ms", "D")

EFFECT = Effect(
    title="Hysteresis of the valve",
    family="valve",
    type="hysteretic",
    cause="Friction on the spool and magnetic remanence keep it behind its command. The same command gives "
    "different openings, or pressures of a regulator, when rising and when falling.",
    equation=r"\tau\,\dot y = \max(u-\tfrac{w}{2}-y,\,0)-\max(y-u-\tfrac{w}{2},\,0)",
    parameters=(
        Parameter(
            "width",
            "w",
            "1",
            default=0.004,
            lower=0.0,
            upper=0.1,
            source=_RANGE,
            description="Full width of the loop, share of full command.",
            off=0.0,
        ),
    ),
    slots={"opening": opening, "drive_rates": drive_rates},
    states=(StateVariable("position", "y", "1", 1.0, "Opening behind the play."),),
    order=-20,  # before the dynamics of the spool (-10)
    kinds=frozenset({"transient"}),
    signature=Signature(
        text="a loop of pressure over command, while force over measured pressure has none",
        direction=None,
        pressure_power=None,
        zero_at=(),
        energy="lumped",
    ),
    confused_with=(
        Twin("pressure_hysteresis", "plot the force over the measured pressure, not over the command"),
        Twin("valve_deadband", "a slow command up and down: a deadband has no loop"),
        Twin("coulomb_friction", "plot the stroke over the measured pressure, not over the command"),
    ),
    prior=Prior(0.1, "the position of most spools is controlled"),
    references=(_RANGE, Source("Krasnosel'skii & Pokrovskii, Systems with Hysteresis (1989)", "M")),
    examples=(
        Example(
            "slot:drive_rates",
            900.0,
            1e-9,
            _BY_HAND,
            {"width": 0.04},
            {},
            {"opening": 0.5, "position": 0.3},
        ),
        Example(
            "slot:drive_rates", 0.0, 1e-12, _BY_HAND, {"width": 0.04}, {}, {"opening": 0.31, "position": 0.3}
        ),
    ),
)
