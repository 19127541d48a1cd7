r"""The measured pressure is not that in the muscle: a tube between the two, or a slow pressure sensor.

With the pressure d by which the muscle is behind, its volume V(L), and the absolute pressures up- and
downstream of the tube, the air flows as through a restriction of ISO 6358-1:

.. math:: P_m = P - d, \qquad \dot d = \dot P - \frac{P_d}{\tau}\,\frac{V(L_0)}{V_t}\,\frac{Q}{Q_r}, \qquad
   Q = p_u^{1+\lambda}\Bigl[1-\Bigl(\frac{r-b}{1-b}\Bigr)_+^2\Bigr]^m, \quad r = \frac{p_d}{p_u}

Of the volume behind the tube a share :math:`\phi` is fixed, :math:`V_t = \phi V(L_0) + (1-\phi) V(L)`; all of
it is about a filter. :math:`Q_r` is the flow into 3 bar at a lag of :math:`P_d = 0.1` bar; below about 1 mbar
the flow is linear. The index m is 1/2 for an orifice and 1 for a capillary; in laminar flow,
:math:`Q \propto p_u^2 - p_d^2`, it is 1 with b = 0 and :math:`\lambda = 1`. The gas that a change of volume
takes is not counted. A negative time is a sensor behind the muscle, :math:`P_m = P + 5d,\ \dot d = \dot P
- 5d/|\tau|`, to first order :math:`P + |\tau|\dot P`. Below 0.1 ms, and where a valve fills the muscle,
the pressure stays as it is.
"""

from functools import partial

from mckibben.physics import ops
from mckibben.physics.braid import volume
from mckibben.physics.effect import Effect, Example, Prior, Signature, StateVariable, Twin
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source
from mckibben.physics.presliding import REFERENCE_PRESSURE
from mckibben.physics.units import STANDARD_ATMOSPHERE

_SHORTEST = 1e-4  # s
_USUAL = 1e4  # Pa, the lag at which the time is stated
_ROUNDED = 7e-4  # of 1 - ((r - b)/(1 - b))^2, about 1 mbar; the slope of a root would be infinite
_SHARPER = 5.0  # a derivative over a fifth of the time
_SMALLEST = 0.05  # of the volume at rest; a stretched braid closes
_LEAST = 1e4  # Pa, absolute; of trial values that are no pressures


def pressure(*, pressure: Value, behind: Value, time: Value) -> Value:
    """P - d [Pa], P + 5 d of a slow sensor; P itself without a lag."""
    late = ops.where(ops.greater(time, _SHORTEST), behind, 0.0)
    early = ops.where(ops.greater(-time, _SHORTEST), _SHARPER * behind, 0.0)
    return pressure - late + early


def rates(
    *,
    muscle: Muscle,
    length: Value,
    pressure: Value,
    pressure_rate: Value,
    behind: Value,
    time: Value,
    index: Value,
    critical_ratio: Value,
    laminar: Value,
    fixed_share: Value,
) -> tuple[Value]:
    """dd/dt [Pa/s]: dP/dt less what flows through the tube."""
    sensor = STANDARD_ATMOSPHERE + pressure
    usual = STANDARD_ATMOSPHERE + REFERENCE_PRESSURE
    flow = _flow(usual + _USUAL, usual, index, critical_ratio)
    narrow = _USUAL * _flow(sensor, sensor - behind, index, critical_ratio) / flow
    upstream = ops.maximum(ops.maximum(sensor, sensor - behind), _LEAST)
    narrow = narrow * ops.exp(laminar * ops.log(upstream / (usual + _USUAL)))
    full = volume(braid=muscle.braid, length=muscle.nominal_length)
    behind_tube = ops.maximum(volume(braid=muscle.braid, length=length), _SMALLEST * full) / full
    narrow = narrow / (fixed_share + (1.0 - fixed_share) * behind_tube)
    followed = ops.where(ops.greater(time, _SHORTEST), narrow, _SHARPER * behind)
    rate = pressure_rate - followed / ops.maximum(ops.absolute(time), _SHORTEST)
    return (ops.where(ops.greater(ops.absolute(time), _SHORTEST), rate, 0.0),)


def _flow(one: Value, other: Value, index: Value, critical_ratio: Value) -> Value:
    """The flow from one absolute pressure to another over its conductance [Pa]; negative backwards."""
    upstream = ops.maximum(ops.maximum(one, other), _LEAST)
    ratio = ops.minimum(one, other) / upstream
    bent = ops.positive_part(ratio - critical_ratio) / (1.0 - critical_ratio)
    open_share = ops.positive_part(1.0 - bent**2)
    powered = open_share * ops.exp(0.5 * (index - 1.0) * ops.log(open_share**2 + _ROUNDED**2))
    return ops.where(ops.greater(one, other), upstream, -upstream) * powered


_of_flow = partial(Parameter, fitted=False, natural=True)
_TUBE = Source("1 l behind 2 m of tube of 4 mm: 20 to 100 ms; amplifiers of 1 to 30 Hz: 5 to 160 ms", "E")
_FLOW = Source("ISO 6358-1 (2013): 1/2 orifices, more for tubes; 1 laminar", "M")
_RATIO = Source("ISO 6358-1 (2013): 0.1 long tubes to 0.5 smooth orifices", "M")
_DEFINITION = Source("definition, by hand", "D")
_SIZE_20 = {"nominal_length": 0.3, "braid_diameter": 0.02, "braid_angle": 0.4363323129985824}

EFFECT = Effect(
    title="Lag between pressure sensor and muscle",
    family="sensor",
    type="measurement",
    cause="The pressure is measured at the valve, and a tube and its fittings lie between the sensor and the "
    "muscle; or the sensor and its amplifier are slower than the muscle. The muscle then pulls with a "
    "pressure that the record shows earlier or later.",
    equation=r"P_m = P-d,\quad \dot d = \dot P-\frac{P_d}{\tau}\,\frac{V(L_0)}{V_t}\,\frac{Q}{Q_r},\quad "
    r"Q = p_u^{1+\lambda}\left[1-\left(\frac{r-b}{1-b}\right)_+^2\right]^m",
    parameters=(
        Parameter(
            *("time", r"\tau", "s", 0.02, -0.5, 2.0, _TUBE),
            description="Time constant of the tube at a lag of 0.1 bar and a pressure of 3 bar; negative "
            "where the sensor is slower than the muscle.",
            off=0.0,
        ),
        _of_flow(
            *("index", "m", "1", 1.0, 0.4, 1.0, _FLOW),
            description="Subsonic index of the tube: 1/2 an orifice, 1 a capillary.",
        ),
        _of_flow(
            *("critical_ratio", "b", "1", 0.2, 0.0, 0.6, _RATIO),
            description="Ratio of the pressures below which the air flows at the speed of sound.",
        ),
        _of_flow(
            *("laminar", r"\lambda", "1", 0.0, 0.0, 1.0, _FLOW),
            description="Power of the upstream pressure beyond that of an orifice: 1 in laminar flow.",
        ),
        _of_flow(
            *("fixed_share", r"\phi", "1", 0.0, 0.0, 1.0),
            Source("0 the muscle alone; 1 the same at every length: to first order a filter", "D"),
            description="Share of the filled volume at rest that is not the muscle's.",
        ),
    ),
    slots={"pressure": pressure, "rates": rates},
    states=(StateVariable("behind", "d", "Pa", 1e4, "Pressure by which the muscle is behind, or before."),),
    kinds=frozenset({"isometric", "isotonic", "transient"}),
    signature=Signature(
        text="a false loop whose width grows with the rate of the pressure, and rounded steps",
        direction=None,
        pressure_power=None,
        zero_at=(),
        energy="lumped",
    ),
    confused_with=(
        Twin("sensor_lag", "a clamped muscle whose length changes at a held pressure: the force sensor lags"),
        Twin("time_skew", "steps: a skew shifts the edge, a lag rounds it"),
        Twin("pressure_hysteresis", "pressure ramps at rates two decades apart: hysteresis does not change"),
        Twin("viscous_damping", "pressure ramps at a clamped length: a damping shows no loop"),
    ),
    prior=Prior(0.25, "the pressure is mostly measured at the valve, and a tube leads to the muscle"),
    references=(Source("ISO 6358-1 (2013); Beater, Pneumatic Drives (2007)", "M"),),
    examples=(
        Example(
            *("slot:pressure", 1.9e5, 1e-9, _DEFINITION, {"time": 0.02}, {}),
            {"pressure": 2e5, "behind": 1e4},
        ),
        Example(
            *("slot:pressure", 2.5e5, 1e-9, _DEFINITION, {"time": -0.02}, {}),
            {"pressure": 2e5, "behind": 1e4},
        ),
        Example(
            # 1e6 Pa/s - 1e4 Pa/0.02 s: the lag and the pressure at which the time is stated
            *("slot:rates", 5e5, 1e-9, _DEFINITION, {"time": 0.02}, _SIZE_20),
            {"length": 0.3, "pressure": 3.1e5, "pressure_rate": 1e6, "behind": 1e4},
        ),
        Example(  # a filter, whatever the length
            *("slot:rates", 5e5, 1e-9, _DEFINITION, {"time": 0.02, "fixed_share": 1.0}, _SIZE_20),
            {"length": 0.24, "pressure": 3.1e5, "pressure_rate": 1e6, "behind": 1e4},
        ),
        Example(
            # choked: -0.1 bar/20 ms (801.325/411.325)/sqrt(1 - ((401.325/411.325 - 0.2)/0.8)^2)
            *("slot:rates", -3981447, 1e-4, _DEFINITION, {"time": 0.02, "index": 0.5}, _SIZE_20),
            {"length": 0.3, "pressure": 7e5, "pressure_rate": 0.0, "behind": 7e5},
        ),
        Example(
            # a slow sensor follows linearly: 1e6 Pa/s - 5 * 8e3 Pa/0.02 s
            *("slot:rates", -1e6, 1e-9, _DEFINITION, {"time": -0.02}, _SIZE_20),
            {"length": 0.3, "pressure": 3e5, "pressure_rate": 1e6, "behind": 8e3},
        ),
    ),
)
