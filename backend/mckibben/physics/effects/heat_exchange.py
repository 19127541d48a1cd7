r"""Heat exchange between gas and wall, :math:`\dot Q = h\,(\pi D L + \pi D^2/2)\,(T_w - T)`.

With this effect the chamber obeys the energy balance with this coefficient: h = 0 is an adiabatic chamber
(exponent 1.4), a large h an isothermal one, and in between the exponent follows from the speed. The wall
stays at ambient temperature.
"""

from mckibben.physics import gas
from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def heat(
    *, length: Value, diameter: Value, gas_temperature: Value, ambient_temperature: Value, coefficient: Value
) -> Value:
    """h (pi D L + pi D^2/2) (T_w - T) [W], positive into the gas."""
    return gas.wall_heat_flow(
        coefficient=coefficient,
        diameter=diameter,
        length=length,
        gas_temperature=gas_temperature,
        wall_temperature=ambient_temperature,
    )


_RANGE = Source("small vessels: 20-60 W/(m2 K) at rest, several hundred during a fast fill", "M")
_BY_HAND = Source("30 * pi * 0.02 * (0.3 + 0.01) * (293 - 333) W", "D")

EFFECT = Effect(
    title="Heat exchange with the wall",
    family="gas",
    type="dynamic",
    cause="Filling warms the gas and venting cools it, and the wall equalises the temperature within about a "
    "second. After a fast fill with the valve closed the pressure therefore drops again.",
    equation=r"\dot Q = h\,(\pi D L + \tfrac{\pi}{2} D^2)\,(T_w-T)",
    parameters=(
        Parameter(
            "coefficient",
            "h",
            "W/(m2*K)",
            default=gas.WALL_HEAT_TRANSFER,
            lower=0.0,
            upper=1000.0,
            source=_RANGE,
            description="Heat transfer coefficient; 0 is an adiabatic chamber.",
            off=0.0,
        ),
    ),
    slots={"heat": heat},
    kinds=frozenset({"transient"}),
    signature=Signature(
        text="pressure falls towards an asymptote within seconds after a fast fill, and rises after venting",
        direction=None,
        pressure_power=None,
        zero_at=(),
        energy="dissipative",
    ),
    confused_with=(
        Twin("leak", "close the valve and wait: heat exchange ends at an asymptote, a leak continues"),
        Twin("creep", "log the pressure: creep changes the length, not the pressure"),
        Twin("flow_coefficient", "filling and venting: a conductance leaves no drift afterwards"),
    ),
    prior=Prior(0.5, "the wall always takes heat from compressed air"),
    references=(
        Source("first law of a chamber with flow", "D"),
        Source("Richer & Hurmuzlu, J. Dyn. Syst. Meas. Control 122 (2000) 416", "M"),
    ),
    examples=(
        Example(
            "slot:heat",
            -23.37344934270806,
            1e-12,
            _BY_HAND,
            {"coefficient": 30.0},
            {},
            {"length": 0.3, "diameter": 0.02, "gas_temperature": 333.0, "ambient_temperature": 293.0},
        ),
    ),
)
