r"""Maxwell slip: four spring-slider cells that break loose one after the other.

Cell i carries the share :math:`w_i` of the force and slides after
:math:`x_i = \varepsilon_b L_0\,\rho^{\,i-4}`, so the last one after :math:`\varepsilon_b L_0`. The shares are
equal at the balance :math:`\sigma = 1`; above it the late cells carry more, below it the early ones. With the
deflection :math:`z_i` of a cell as a share of its limit

.. math:: F = F_c\left(\frac{P_+}{P_r}\right)^{q}\left(\frac{L}{L_0}\right)^{m}\sum_{i=1}^4 w_i z_i, \qquad
   w_i = \frac{\sigma^i}{\sum_k \sigma^k}, \qquad
   \dot z_i = \frac{\dot L}{x_i}\bigl[1 - s(z_i \operatorname{sgn}\dot L)\bigr]

The saturation s is 0 up to 0.9 of the limit and a smooth step from there to 1 at the limit. So a cell is
elastic below 0.9, never passes the limit, and its rate has no jump. Where the gas presses the threads
together, q > 0, with :math:`P_r = 3` bar.
"""

from mckibben.physics.contacts import LENGTH_POWER, PRESSURE_POWER, grip
from mckibben.physics.effect import Effect, Example, Prior, Signature, StateVariable, Twin
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source
from mckibben.physics.presliding import slide

_CELLS = 4


def friction(
    *,
    pressure: Value,
    length: Value,
    muscle: Muscle,
    cell_1: Value,
    cell_2: Value,
    cell_3: Value,
    cell_4: Value,
    force: Value,
    balance: Value,
    pressure_power: Value,
    length_power: Value,
) -> Value:
    """F_c (P/P_r)^q (L/L_0)^m times the weighted mean of the cells [N]."""
    weighted = cell_1 + balance * (cell_2 + balance * (cell_3 + balance * cell_4))
    limit = force * grip(
        pressure=pressure, length=length, nominal_length=muscle.nominal_length,
        pressure_power=pressure_power, length_power=length_power,
    )  # fmt: skip
    return limit * weighted / (1.0 + balance * (1.0 + balance * (1.0 + balance)))


def rates(
    *,
    velocity: Value,
    muscle: Muscle,
    cell_1: Value,
    cell_2: Value,
    cell_3: Value,
    cell_4: Value,
    break_strain: Value,
    ratio: Value,
) -> tuple[Value, ...]:
    """dz_i/dt [1/s] of the four cells; exactly 0 at rest."""
    cell_rates = []
    for index, cell in enumerate((cell_1, cell_2, cell_3, cell_4), start=1):
        limit = break_strain * muscle.nominal_length / ratio ** (_CELLS - index)
        cell_rates.append(slide(rate=velocity, share=cell) / limit)
    return tuple(cell_rates)


_MINH = Source("Vo-Minh, Tjahjowidodo, Ramon & Van Brussel, IEEE/ASME Trans. Mech. 16 (2011) 177", "M")
_RANGE = Source("1-2.5 % of the maximum force", "E")
_WAY = Source("break-away at 0.1-3 % of the rest length", "E")
_DEFINITION = Source("definition, by hand", "D")
_SIZE_20 = {"nominal_length": 0.3, "braid_diameter": 0.02, "braid_angle": 0.4363323129985824}

EFFECT = Effect(
    title="Maxwell-slip hysteresis",
    family="friction",
    type="hysteretic",
    cause="The crossings of the braid do not all slide at once: some slip early, some late. The friction "
    "depends on earlier reversals, so small loops close within large ones.",
    equation=r"F_{h} = F_c\,(P_+/P_r)^q (L/L_0)^m\,\frac{\sum_i \sigma^i z_i}{\sum_i \sigma^i},\quad "
    r"\dot z_i = \frac{\dot L}{x_i}\left[1-s(z_i\operatorname{sgn}\dot L)\right],"
    r"\quad x_i = \varepsilon_b L_0\,\rho^{\,i-4}",
    parameters=(
        Parameter(
            *("force", "F_c", "N", 10.0, 0.0, 200.0, _RANGE),
            description="Friction after a long travel; with a power q, that at 3 bar.",
            off=0.0,
        ),
        Parameter(
            *("break_strain", r"\varepsilon_b", "1", 0.02, 1.0e-3, 0.1),
            Source("break-away at 0.1-3 % of the rest length; the last cells of a wide spread, later", "E"),
            description="Travel until the last cell slides, as a share of the rest length.",
            fitted=False,
        ),
        Parameter(
            *("ratio", r"\rho", "1", 2.5, 1.1, 5.0, _WAY),
            description="Ratio of the travel limits of successive cells.",
            fitted=False,
        ),
        Parameter(
            *("balance", r"\sigma", "1", 1.0, 0.3, 3.0, Source("1 = equal cells", "E")),
            description="Ratio of the forces of successive cells: above 1 the late ones carry more.",
            fitted=False,
        ),
        PRESSURE_POWER,
        LENGTH_POWER,
    ),
    slots={"friction": friction, "rates": rates},
    states=tuple(
        StateVariable(
            *(f"cell_{i}", f"z_{i}", "1", 1.0, f"Deflection of cell {i} as a share of its limit."),
            sliding=1.0,
        )
        for i in range(1, _CELLS + 1)
    ),
    kinds=frozenset({"isobaric", "isotonic", "transient"}),
    signature=Signature(
        text="a loop whose width depends on the amplitude, with small loops that close within large ones",
        direction="odd",
        pressure_power=0.0,
        zero_at=("no_motion",),
        energy="dissipative",
    ),
    confused_with=(
        Twin("dahl", "loops within a loop: only Maxwell slip closes them"),
        Twin("bouc_wen", "loops within a loop: only Maxwell slip closes them"),
        Twin("bladder_elasticity", "both directions: the elastic force retraces, friction changes sign"),
        Twin("coulomb_friction", "small amplitudes: the Coulomb loop keeps its full width"),
    ),
    prior=Prior(0.3, "measured loops within loops often follow it"),
    references=(_MINH,),
    examples=(
        Example(
            *("slot:friction", 2.5, 1e-12, _DEFINITION, {"force": 10.0}, _SIZE_20),
            {"cell_1": 1.0, "cell_2": 0.5, "cell_3": -0.25, "cell_4": -0.25, "pressure": 2e5, "length": 0.24},
        ),
        Example(
            # 10 N (1 + 2 0.5 - 4 0.25 - 8 0.25)/15
            *(
                "slot:friction",
                -0.6666666666666666,
                1e-12,
                _DEFINITION,
                {"force": 10.0, "balance": 2.0},
                _SIZE_20,
            ),
            {"cell_1": 1.0, "cell_2": 0.5, "cell_3": -0.25, "cell_4": -0.25, "pressure": 2e5, "length": 0.24},
        ),
        Example(  # 2.5 N sqrt(2), but for the rounding at low pressure
            *(
                "slot:friction",
                3.5355339,
                1e-6,
                _DEFINITION,
                {"force": 10.0, "pressure_power": 0.5},
                _SIZE_20,
            ),
            {"cell_1": 1.0, "cell_2": 0.5, "cell_3": -0.25, "cell_4": -0.25, "pressure": 6e5, "length": 0.24},
        ),
        Example(
            # 0.03 m/s / (6 mm / 2.5), elastic
            *("slot:rates:2", 12.5, 1e-12, _DEFINITION, {"break_strain": 0.02, "ratio": 2.5}, _SIZE_20),
            {"velocity": 0.03},
        ),
    ),
)
