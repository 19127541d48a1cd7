r"""Hysteresis driven by pressure: the force on filling is lower than on venting, even at constant length.

.. math:: F = -F_p\,\bigl(1 - a + a\,A(L)_+/A(L_0)\bigr)\left(\frac{P_+}{P_r}\right)^{q}
   \sum_{k=1}^5 w_k z_k, \qquad P_r = 3\ \mathrm{bar}

.. math:: \dot z_k = \frac{\dot P}{r_k P_b}\bigl[1 - s(z_k\operatorname{sgn}\dot P)\bigr]

Five contacts in parallel stick and slip one after the other, at the changes of pressure :math:`r_k P_b`.
Their shares :math:`w_k` follow from the exponent i: after a reversal the force changes about as by Dahl's law
:math:`P_b\,dz/dP = (1 - z)^i`, and small loops close within large ones, which one state of Dahl does not do.

Friction that follows the length alone has exactly no loop at constant length; real muscles show one, because
threads micro-slip when the pressure strains them and presses them together. Where it is the pressure that
lags (a Preisach operator between gauge and braid), the loop is as wide in pressure at every length and has
the effective area A of the ideal braid in force: a = 1. Where the pressure presses the threads together, the
loop is wider at high pressure: q > 0.
"""

from mckibben.physics import ideal, ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, StateVariable, Twin
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source
from mckibben.physics.presliding import SLIDERS, pressed, shares_of_sliders, slide


def friction(
    *,
    muscle: Muscle,
    length: Value,
    pressure: Value,
    slip_1: Value,
    slip_2: Value,
    slip_3: Value,
    slip_4: Value,
    slip_5: Value,
    force: Value,
    exponent: Value,
    along_area: Value,
    pressure_power: Value,
) -> Value:
    """-F_p (1 - a + a A/A_0) (P/P_r)^q z [N], negative on filling; a ends at the zero-force length."""
    slips = (slip_1, slip_2, slip_3, slip_4, slip_5)
    filling = sum(w * z for w, z in zip(shares_of_sliders(exponent=exponent), slips, strict=True))
    here = ideal.area(braid=muscle.braid, length=length)
    relative = ops.positive_part(here / ideal.area(braid=muscle.braid, length=muscle.nominal_length))
    widened = pressed(pressure=pressure, power=pressure_power)
    return -force * (1.0 - along_area + along_area * relative) * widened * filling


def rates(
    *,
    pressure_rate: Value,
    slip_1: Value,
    slip_2: Value,
    slip_3: Value,
    slip_4: Value,
    slip_5: Value,
    break_pressure: Value,
) -> tuple[Value, ...]:
    """dz_k/dt [1/s] of the five contacts; exactly 0 at constant pressure."""
    slips = (slip_1, slip_2, slip_3, slip_4, slip_5)
    return tuple(
        slide(rate=pressure_rate, share=slip) / (limit * break_pressure)
        for slip, limit in zip(slips, SLIDERS, strict=True)
    )


_LOOP = Source("at most 2.5-3 % of the force in catalogues, a part of it at constant length", "E")
_WAY = Source("a tenth of the working pressure", "E")
_POWER = Source("0 a constant loop, 1 dry friction under the pressure of the gas", "D")
_SHARE = Source("a share: 0 all of it in force, 1 all of it in pressure", "D")
_SIZE_20 = {"nominal_length": 0.3, "braid_diameter": 0.02, "braid_angle": 0.4363323129985824}
_DEFINITION = Source("definition, by hand", "D")
_ALIKE = {f"slip_{k}": 0.6 for k in range(1, len(SLIDERS) + 1)}

EFFECT = Effect(
    title="Pressure-driven hysteresis",
    family="friction",
    type="hysteretic",
    cause="The pressure strains the threads and presses them together, so that they slip a little even at "
    "constant length. The force on filling is then lower than on venting at the same pressure.",
    equation=r"F_{h} = -F_p\,(1-a+a\,A_+/A_0)\,(P_+/P_r)^q\sum_k w_k(i) z_k,\quad "
    r"\dot z_k = \frac{\dot P}{r_k P_b}\left[1-s(z_k\operatorname{sgn}\dot P)\right]",
    parameters=(
        Parameter(
            *("force", "F_p", "N", 5.0, 0.0, 100.0, _LOOP),
            description="Half the width of the pressure loop; with a power q, that at 3 bar.",
            off=0.0,
        ),
        Parameter(
            *("break_pressure", "P_b", "Pa", 3.0e4, 1.0e3, 3.0e5, _WAY),
            description="Change of pressure over which the loop opens after a reversal.",
            fitted=False,
        ),
        Parameter(
            *("exponent", "i", "1", 1.0, 0.5, 3.0, Source("1 for one kind of contact, more for many", "E")),
            description="Exponent of Dahl's law: how slowly the loop reaches its full width.",
            fitted=False,
        ),
        Parameter(
            *("along_area", "a", "1", 0.0, 0.0, 1.0, _SHARE),
            description="Share of the loop that follows the effective area; 1 = the same width in pressure "
            "at every length.",
            fitted=False,
            natural=True,
        ),
        Parameter(
            *("pressure_power", "q", "1", 0.0, 0.0, 1.0, _POWER),
            description="Power of the pressure with which the loop widens.",
            fitted=False,
            natural=True,
        ),
    ),
    slots={"friction": friction, "rates": rates},
    states=tuple(
        StateVariable(
            *(f"slip_{k}", f"z_{k}", "1", 1.0, f"Contact {k} as a share of its limit, positive on filling."),
            sliding=-1.0,
        )
        for k in range(1, len(SLIDERS) + 1)
    ),
    kinds=frozenset({"isometric", "isotonic", "transient"}),
    signature=Signature(
        text="a loop of force over pressure at constant length, nothing at constant pressure",
        direction="odd",
        pressure_power=None,
        zero_at=(),
        energy="lumped",
    ),
    confused_with=(
        Twin("coulomb_friction", "a pressure loop at constant length: only the pressure-driven one shows"),
        Twin("pressure_friction", "a length loop at constant pressure: only friction shows"),
        Twin("sensor_lag", "two rates of the pressure ramp: a lag widens the loop, hysteresis does not"),
        Twin("time_skew", "two rates of the pressure ramp: a skew widens the loop, hysteresis does not"),
    ),
    prior=Prior(0.2, "seen where pressure is swept at a fixed length"),
    references=(
        Source("Minh et al., IEEE/ASME AIM (2010), isometric force-pressure loops", "M"),
        Source("Lin, Lin, Yu & Chen, Control Eng. Pract. 40 (2015) 35", "M"),
    ),
    examples=(
        Example(
            *("slot:friction", -3.0, 1e-12, _DEFINITION, {"force": 5.0}, _SIZE_20),
            {**_ALIKE, "length": 0.3, "pressure": 3e5},
        ),
        Example(
            # -3 N (3 (5/6)^2 cos^2 25° - 1)/(3 cos^2 25° - 1)
            *("slot:friction", -1.457272, 1e-6, _DEFINITION, {"force": 5.0, "along_area": 1.0}, _SIZE_20),
            {**_ALIKE, "length": 0.25, "pressure": 3e5},
        ),
        Example(
            # -3 N ((0.75^2 + 0.01^2)/3^2)^(1/4), the second term from the rounding
            *("slot:friction", -1.5000666622226833, 1e-9, _DEFINITION),
            {"force": 5.0, "pressure_power": 0.5},
            _SIZE_20,
            {**_ALIKE, "length": 0.3, "pressure": 7.5e4},
        ),
        Example(
            # -1e5 Pa/s / (0.14 * 0.3 bar), still elastic
            *("slot:rates:0", -23.80952380952381, 1e-12, _DEFINITION, {"break_pressure": 3e4}, {}),
            {"pressure_rate": -1e5, **_ALIKE},
        ),
    ),
)
