r"""Wall thickness of Chou and Hannaford: the gas fills the bore, not the braid's cylinder.

With a wall that keeps its thickness :math:`V = \pi(D-2t)^2L/4 = V_i - \pi t(D-t)L`, hence

.. math:: \Delta F = \pi P\left[\frac{b}{n\pi}\,t\left(2\sin\theta-\frac{1}{\sin\theta}\right) - t^2\right] .

Rubber keeps its volume instead: then bore and braid volumes differ by a constant, :math:`dV/dL` is the ideal
one, and the correction is exactly zero. A muscle described by its braid diameter should not need this effect.
"""

from collections.abc import Callable

from mckibben.physics import ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source
from mckibben.physics.slots import Shape


def shape(*, inner: Callable[[Value], Shape], length: Value, thickness: Value) -> Shape:
    """The shape without the wall's volume; the diameter stays that of the braid."""
    outside = inner(length)
    wall = ops.pi * thickness * (outside.diameter - thickness) * length
    return Shape(outside.volume - wall, outside.diameter)


_CHOU = Source("Chou & Hannaford, IEEE Trans. Robotics Autom. 12 (1996) 90", "M")
_CLOSED_FORM = Source("pi P [D90 t (2 sin theta - 1/sin theta) - t^2] evaluated by hand", "D")
_SIZE_10 = {"nominal_length": 0.1, "braid_diameter": 0.01, "braid_angle": 0.4363323129985824}
_BLOCKED = {"length": 0.1, "pressure": 6e5}

EFFECT = Effect(
    title="Wall thickness (constant)",
    family="geometry",
    type="static",
    cause="The gas only fills the bore, and a wall of constant thickness keeps it smaller than the braid. "
    "The muscle therefore displaces less gas, and pulls less, than its braid alone would.",
    equation=r"\Delta F = \pi P\left[\frac{b}{n\pi}\,t"
    r"\left(2\sin\theta-\frac{1}{\sin\theta}\right)-t^2\right]",
    parameters=(
        Parameter(
            "thickness",
            "t",
            "m",
            default=0.001,
            lower=0.0,
            upper=0.003,
            source=Source("hand-made bladders 0.5-1.6 mm, moulded 1.3-2.2 mm", "E"),
            description="Thickness of wall and braid between gas and the braid diameter, the same at "
            "every length.",
            off=0.0,
            across=True,
        ),
    ),
    slots={"shape": shape},
    kinds=frozenset({"isobaric", "isometric", "isotonic", "static", "transient"}),
    signature=Signature(
        text="proportional to pressure, largest at the rest length, nearly gone at a braid angle of 45°",
        direction="even",
        pressure_power=1.0,
        zero_at=("zero_pressure",),
        energy="conservative",
    ),
    confused_with=(
        Twin("effectiveness", "measure wall and braid diameter"),
        Twin("force_scale", "dead weights on the force sensor"),
        Twin("pressure_scale", "a pressure calibrator"),
    ),
    prior=Prior(0.3, "every wall takes room, but the stated diameter often counts it already"),
    references=(_CHOU,),
    examples=(
        Example("force_change", -34.390, 2e-5, _CLOSED_FORM, {"thickness": 0.5e-3}, _SIZE_10, _BLOCKED),
        Example("force_change", -69.72, 1e-4, _CLOSED_FORM, {"thickness": 1.0e-3}, _SIZE_10, _BLOCKED),
        Example(
            "volume",
            # pi/4 (10 - 2)^2 * 100 mm^3
            5.026548e-6,
            1e-6,
            _CLOSED_FORM,
            {"thickness": 1.0e-3},
            _SIZE_10,
            _BLOCKED,
        ),
    ),
)
