r"""End caps: towards each fitting the muscle narrows to a cone that encloses less than a cylinder.

A cone of length :math:`\ell = \chi (D - D_f)_+/2` at each end leaves an active length :math:`L - 2\ell`:

.. math:: V = \frac{\pi D^2}{4}(L - 2\ell) + 2\,\frac{\pi\ell}{12}(D^2 + D D_f + D_f^2)
          = V_i - \frac{\pi\chi}{12}(2D + D_f)(D - D_f)_+^2

so that on the ideal braid :math:`\Delta F = -\chi P L (D - D_f)_+/(2\pi n^2)`. With :math:`D_f = D_0` and
small contraction this is Tondu's factor with :math:`k - 1 = \chi\cot^2\theta_0\,D_0/(3 L_0)`.

Where the ends hold no thread, all of it stays in a cylinder that is shorter than the muscle by
:math:`\chi_t (D - D_0)`. It then shortens by more than the muscle, which pulls a third to a half harder than
the ideal one at rest.
"""

from collections.abc import Callable

from mckibben.physics import ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source
from mckibben.physics.slots import Shape


def shape(
    *,
    inner: Callable[[Value], Shape],
    length: Value,
    muscle: Muscle,
    cone_factor: Value,
    threadless_factor: Value,
) -> Shape:
    """The shape with the volume reduced by the two cones; the diameter is that at mid-span."""
    whole = _beside_threadless_ends(inner, length, muscle, threadless_factor)
    fitting = ops.where(
        ops.greater(muscle.inside_diameter, 0.0), muscle.inside_diameter, muscle.braid_diameter
    )
    # One-sided: a muscle stretched below the diameter of the fitting has no cones.
    step = ops.positive_part(whole.diameter - fitting)
    lost = ops.pi / 12.0 * cone_factor * (2.0 * whole.diameter + fitting) * step**2
    return Shape(whole.volume - lost, whole.diameter)


def _beside_threadless_ends(
    inner: Callable[[Value], Shape], length: Value, muscle: Muscle, factor: Value
) -> Shape:
    """A cylinder of all the thread, shorter than the muscle by chi_t (D - D_0), and the cones at its ends.

    With the cylinder b cos(theta) long and b sin(theta)/(pi n) wide, t = chi_t/(pi n), the muscle's length is
    b (cos(theta) + t sin(theta)) - chi_t D_0, a quadratic equation for sin(theta).
    """
    thread, turns = muscle.braid
    rest = muscle.braid_diameter
    tangent = factor / (ops.pi * turns)
    reach = (length + factor * rest) / thread
    inside = 1.0 + tangent**2 - reach**2
    inside = 0.5 * (inside + (inside**2 + _LOCKED) ** 0.5)  # finite beyond the braid lock, without a corner
    sine = (tangent * reach + inside**0.5) / (1.0 + tangent**2)
    step = thread * sine / (ops.pi * turns) - rest
    cylinder = inner(length - factor * step)
    wide = rest + step
    cones = ops.pi / 12.0 * factor * step * (wide**2 + wide * rest + rest**2)
    return Shape(cylinder.volume + cones, cylinder.diameter)


_LOCKED = 1e-16  # fourth power of sin(theta) that is left at the braid lock
_CONE = Source("half angle of the cone 35-55 degrees", "E")
_CLOSED_FORM = Source("dF = -chi P L (D - D_f)/(2 pi n^2) evaluated by hand", "D")
_SIZE_10 = {"nominal_length": 0.1, "braid_diameter": 0.01, "braid_angle": 0.4363323129985824}
_CONTRACTED = {"length": 0.09, "pressure": 6e5}

EFFECT = Effect(
    title="Conical ends (lost active length)",
    family="geometry",
    type="static",
    cause="The braid is clamped at the fittings and cannot widen there, so the muscle ends in two cones "
    "that grow as it contracts. They enclose less gas than a cylinder, and the muscle pulls less.",
    equation=r"V = V_i - \frac{\pi\chi}{12}(2D+D_f)(D-D_f)^2,\quad "
    r"\Delta F = -\chi P\,\frac{L\,(D-D_f)}{2\pi n^2}",
    parameters=(
        Parameter(
            "cone_factor",
            r"\chi",
            "1",
            default=1.0,
            lower=-0.5,
            upper=2.0,
            source=_CONE,
            description="Length of a cone over its step in radius; 1 is a cone of 45 degrees, negative are "
            "round ends that enclose more than the cones of the ends without thread. The fitting "
            "has the inside diameter of the muscle, or its braid diameter when that is not given.",
            off=0.0,
        ),
        Parameter(
            "threadless_factor",
            r"\chi_t",
            "1",
            default=0.0,
            lower=0.0,
            upper=1.2,
            source=_CONE,
            description="The same of cones that hold no thread: all of it is in the cylinder between them.",
            off=0.0,
            fitted=False,
        ),
    ),
    slots={"shape": shape},
    kinds=frozenset({"isobaric", "isometric", "isotonic", "static", "transient"}),
    signature=Signature(
        text="proportional to pressure, growing in proportion to contraction and to diameter over length",
        direction="even",
        pressure_power=1.0,
        zero_at=("zero_pressure",),
        energy="conservative",
    ),
    confused_with=(
        Twin("contraction_factor", "two muscle lengths: with end caps k − 1 falls as 1/L₀"),
        Twin("length_offset", "gauge blocks, or two muscle lengths"),
        Twin("bladder_elasticity", "several pressures: the bladder's share does not grow with pressure"),
    ),
    prior=Prior(0.6, "every muscle ends in fittings that keep their diameter"),
    references=(
        Source("Tsagarakis & Caldwell, IEEE ICRA (2000)", "M"),
        Source("Doumit, Fahim & Munro, IEEE Trans. Robotics 25 (2009) 1282", "M"),
    ),
    examples=(
        Example(
            "force_change",
            # D = 13.688655 mm, b = 110.337792 mm, n = 1.4843034: -6e5 * 0.09 * 3.688655e-3 / (2 pi n^2)
            -14.389200,
            1e-6,
            _CLOSED_FORM,
            {"cone_factor": 1.0},
            _SIZE_10,
            _CONTRACTED,
        ),
        Example(
            "volume_change",
            # -pi/12 (2 * 13.688655 + 10) * 3.688655^2 mm^3
            -133.14132e-9,
            1e-6,
            _CLOSED_FORM,
            {"cone_factor": 1.0},
            _SIZE_10,
            _CONTRACTED,
        ),
    ),
)
