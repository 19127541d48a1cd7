r"""Lost stroke of the ends: a short muscle pulls less and contracts less than a long one of the same braid.

Near its fittings the braid cannot widen, so a stroke :math:`\delta` is lost, whatever the length.
The gas acts as if the braid were contracted by :math:`\delta/L_0` more. Relative to the length :math:`L_r`,
for which the other values of the model hold, that is

.. math:: V(L) = V_i(L - o) - V_i(L_0 - o) + V_i(L_0), \qquad o = \delta\,(1 - L_0/L_r)

so a muscle of the length :math:`L_r` is unchanged. Volume at rest and diameter at mid-span are the braid's.
One stroke explains both measured effects of the length: the free contraction (Hunt) and the blocked force
(Bolen).
"""

from collections.abc import Callable

from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source
from mckibben.physics.slots import Shape


def shape(
    *, inner: Callable[[Value], Shape], length: Value, muscle: Muscle, stroke: Value, reference_length: Value
) -> Shape:
    """The volume at a length less o, shifted to the braid's at rest; the diameter at the length itself."""
    rest = muscle.nominal_length
    offset = stroke * (1.0 - rest / reference_length)
    change = inner(length - offset).volume - inner(rest - offset).volume
    return Shape(inner(rest).volume + change, inner(length).diameter)


_HUNT = Source(
    "Hunt, ASME DETC (2017), free contraction of six DMSP-10 of 153 to 281 mm at 6.2 bar, second-hand", "S2"
)
_BOLEN = Source(
    "Bolen & Hunt, GitHub Bipedal_Robot, maxBPAforce.m: blocked force of DMSP-10 and -20 over length", "S"
)
_FITTED = Source("fitted to the change with length in both: 10 mm in DMSP-10, 13 mm in DMSP-20", "C")
_REFERENCE = Source("length of the sample to which the rest of the model was fitted", "D")
# a = 13.796730, c_b = 5.598910, o = 10 mm (1 - 100/250) = 6 mm
_BY_HAND = Source("6 bar 78.539816 mm² [a (0.84^2 - 0.9^2)]", "D")
_AT_REST = Source("6 bar 78.539816 mm² [a (0.94^2 - 1)]", "D")
_DEFINITION = Source("the reference length changes nothing", "D")
_SIZE_10 = {"nominal_length": 0.1, "braid_diameter": 0.01, "braid_angle": 0.4363323129985824}
_VALUES = {"stroke": 0.01, "reference_length": 0.25}

EFFECT = Effect(
    title="Lost stroke of the ends",
    family="geometry",
    type="static",
    cause="Near its fittings the braid cannot widen, so a muscle of any length loses the same stroke at its "
    "ends. A short muscle therefore pulls less and contracts by a smaller share than a long one.",
    equation=r"V = V_i(L-o) - V_i(L_0-o) + V_i(L_0),\quad o = \delta\left(1-\frac{L_0}{L_r}\right)",
    parameters=(
        Parameter(
            *("stroke", r"\delta", "m"),
            default=0.01,
            lower=0.0,
            upper=0.04,
            source=_FITTED,
            description="Stroke lost at both ends together.",
            off=0.0,
        ),
        Parameter(
            *("reference_length", "L_r", "m"),
            default=0.25,
            lower=0.03,
            upper=10.0,
            source=_REFERENCE,
            description="Rest length of the muscle for which the other values of the model hold.",
            fitted=False,
            reference=True,
        ),
    ),
    slots={"shape": shape},
    kinds=frozenset({"isobaric", "isometric", "isotonic", "static", "transient"}),
    signature=Signature(
        text="proportional to pressure, falling with the length of the muscle; none at the reference length",
        direction="even",
        pressure_power=1.0,
        zero_at=("zero_pressure",),
        energy="conservative",
    ),
    confused_with=(
        Twin("length_offset", "muscles of several lengths, each measured with gauge blocks"),
        Twin("end_caps", "the blocked force of muscles of several lengths: end caps leave it alone"),
        Twin(
            "contraction_factor", "the blocked force of muscles of several lengths: a factor leaves it alone"
        ),
    ),
    prior=Prior(0.3, "clamped ends often lose some millimetres, more on short muscles"),
    references=(_HUNT, _BOLEN),
    examples=(
        Example(
            *("force_change", -67.876242, 1e-6, _BY_HAND, _VALUES, _SIZE_10),
            {"length": 0.09, "pressure": 6e5},
        ),
        Example(
            *("force_change", -75.678109, 1e-6, _AT_REST, _VALUES, _SIZE_10),
            {"length": 0.1, "pressure": 6e5},
        ),
        Example(
            *("force_change", 0.0, 1e-12, _DEFINITION, {"stroke": 0.03, "reference_length": 0.1}, _SIZE_10),
            {"length": 0.09, "pressure": 6e5},
        ),
    ),
    among_lengths=True,
)
