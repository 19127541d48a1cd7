r"""Contraction factor of Tondu and Lopez: the conical ends make the muscle contract less than its middle.

The braid in the middle contracts by :math:`k\varepsilon` while the muscle contracts by :math:`\varepsilon`:
the volume is :math:`V(L) = V_0 + \frac1k\left[V_i(L_0(1-k\varepsilon)) - V_0\right]`, so that
:math:`-dV/dL` is the ideal area at :math:`k\varepsilon` and force and gas balance agree.
"""

from collections.abc import Callable

from mckibben.physics.effect import Effect, Example, Signature, Twin
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source
from mckibben.physics.slots import Shape


def shape(*, inner: Callable[[Value], Shape], length: Value, muscle: Muscle, factor: Value) -> Shape:
    """The shape at the braid's own length L0 (1 - k eps), its volume change divided by k."""
    stroke = muscle.nominal_length - length
    braid = inner(length - (factor - 1.0) * stroke)
    rest = inner(muscle.nominal_length)
    return Shape(braid.volume + (1.0 / factor - 1.0) * (braid.volume - rest.volume), braid.diameter)


_TONDU = Source("Tondu & Lopez, IEEE Control Systems 20(2) (2000) 15: k = 1.25-1.35", "M")
_CLOSED_FORM = Source("F = P A0 [a (1 - k eps)^2 - c_b] evaluated by hand", "D")
_SIZE_10 = {"nominal_length": 0.1, "braid_diameter": 0.01, "braid_angle": 0.4363323129985824}

EFFECT = Effect(
    title="Contraction factor of the ends (Tondu k)",
    family="geometry",
    type="static",
    cause="Towards its fittings the muscle is conical and takes no part in the contraction. The cylindrical "
    "middle therefore contracts k times as much as the muscle as a whole.",
    equation=r"F = P A_0\left[\frac{3}{\tan^2\theta_0}(1-k\varepsilon)^2 - \frac{1}{\sin^2\theta_0}\right]",
    parameters=(
        Parameter(
            "factor",
            "k",
            "1",
            1.1,
            0.7,
            2.5,
            _TONDU,
            "Contraction of the cylindrical middle over that of the whole muscle.",
            off=1.0,
        ),
    ),
    slots={"shape": shape},
    kinds=frozenset({"isobaric", "isometric", "isotonic", "diameter", "static", "transient"}),
    signature=Signature(
        text="proportional to pressure, zero at the nominal length, growing in proportion to contraction",
        direction="even",
        pressure_power=1.0,
        zero_at=("nominal_length", "zero_pressure"),
        energy="conservative",
    ),
    confused_with=(
        Twin("end_caps", "two muscle lengths: with end caps k - 1 falls as 1/L0"),
        Twin("bladder_elasticity", "several pressures: the bladder's share does not grow with pressure"),
        Twin("linear_elasticity", "several pressures: the elastic share does not grow with pressure"),
    ),
    references=(_TONDU,),
    examples=(
        Example(
            "force",
            # a = 13.796730, c_b = 5.598910: 0.6 MPa * 78.539816 mm^2 * (a * 0.875^2 - c_b)
            233.9329,
            2e-5,
            _CLOSED_FORM,
            {"factor": 1.25},
            _SIZE_10,
            {"length": 0.09, "pressure": 6e5},
        ),
        Example(
            "diameter",
            # D = D0 sqrt(c_b - a/3 * 0.875^2)
            0.01441482,
            2e-5,
            _CLOSED_FORM,
            {"factor": 1.25},
            _SIZE_10,
            {"length": 0.09, "pressure": 6e5},
        ),
    ),
)
