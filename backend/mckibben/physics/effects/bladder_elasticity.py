r"""Bladder elasticity: a hyperelastic wall that the braid forces to grow in diameter as the muscle shortens.

With :math:`\lambda_z = L/L_0`, the braid ties the hoop stretch to the axial one,
:math:`\lambda_\theta^2 = 1 + \cot^2\theta_0\,(1-\lambda_z^2)`, and incompressibility gives
:math:`\lambda_r = 1/(\lambda_z\lambda_\theta)`. The energy of the wall volume :math:`\pi D_b H L_0` is

.. math:: w = C_{10}\left[S(J) + y\,J^2 + y^2 J^3\right] + C_{01}\,(I_2-3), \qquad J = I_1-3, \qquad
   S(J) = \int_0^J \Bigl(\frac{j+c^2}{1+c^2}\Bigr)^{-n/2} dj

neo-Hookean, S = J, for n = 0, y = 0 and :math:`C_{01}=0`, Mooney-Rivlin for y = 0, Yeoh's of third order for
:math:`C_{01}=0`. To second order in J it is Fung's exponential with 2y and Gent's logarithm with
:math:`J_m = 1/(2y)`; it lies between their third terms, :math:`\tfrac23 y^2J^3` and :math:`\tfrac43 y^2J^3`.
Filled rubber is stiffer at small strains and softens with :math:`J^{-n/2}` beyond the strain c (Davies, De &
Thomas); C10 is then its modulus at J = 1. Because the hoop stretch dominates, the tension falls steeply over
the first 5 % of contraction and then saturates, at every pressure; with y > 0 it falls further.
"""

from mckibben.physics import ops
from mckibben.physics.effect import Effect, Example, Prior, Signature, Twin
from mckibben.physics.muscle import Muscle
from mckibben.physics.ops import Value
from mckibben.physics.parameter import Parameter, Source


def energy(
    *,
    length: Value,
    muscle: Muscle,
    shear_modulus: Value,
    mooney_constant: Value,
    stiffening: Value,
    softening: Value,
    onset: Value,
) -> Value:
    """Stored energy V_b {C10 [S + y J^2 + y^2 J^3] + C01 (I2-3)} of the wall [J]; 0 at the rest length."""
    axial = (length / muscle.nominal_length) ** 2
    hoop = 1.0 + (1.0 - axial) / ops.tan(muscle.braid_angle) ** 2
    radial = 1.0 / (axial * hoop)
    wall_volume = ops.pi * muscle.braid_diameter * muscle.wall_thickness * muscle.nominal_length
    first = axial + hoop + radial - 3.0
    second = 1.0 / axial + 1.0 / hoop + 1.0 / radial - 3.0
    small, power = onset**2, 1.0 - 0.5 * softening
    soft = ((first + small) ** power - small**power) * (1.0 + small) ** (1.0 - power) / power
    stiffer = soft + first * stiffening * first * (1.0 + stiffening * first)
    return wall_volume * (shear_modulus * stiffer + mooney_constant * second)


def elastomer(
    *,
    length: Value,
    muscle: Muscle,
    shear_modulus: Value,
    mooney_constant: Value,
    stiffening: Value,
    softening: Value,
    onset: Value,
) -> Value:
    """Tension dW/dL of the wall [N]; negative (it resists shortening) below the rest length."""
    constants = {"shear_modulus": shear_modulus, "mooney_constant": mooney_constant, "stiffening": stiffening}
    constants |= {"softening": softening, "onset": onset}
    return ops.derivative(lambda x: energy(length=x, muscle=muscle, **constants), length)


_FILLED = Source("Davies, De & Thomas, Rubber Chem. Technol. 67 (1994) 716: exponents of 0.1 to 1", "M")
_MAPS = Source("fit of the force maps of Martens & Boblan 2017, doi 10.3390/act6040033", "D")
_DERIVED = Source("strain energy differentiated by hand, latex constants", "D")
_LATEX = {"shear_modulus": 118.4e3, "mooney_constant": 105.7e3}  # Klute & Hannaford 2000
_SIZE = {
    "nominal_length": 0.3,
    "braid_diameter": 0.0218,
    "braid_angle": 0.46251225177849735,
    "wall_thickness": 0.0018,
}

EFFECT = Effect(
    title="Bladder elasticity (hyperelastic)",
    family="elastomer",
    type="static",
    cause="The elastomer wall is stretched around the muscle when the braid makes it thicker. Its energy "
    "comes from the gas, so the muscle pulls less as it contracts.",
    equation=r"F_{bl} = \frac{\pi D_b H L_0}{L_0}\,\frac{d}{d\lambda_z}"
    r"\left[C_{10}\{S+yJ^2+y^2J^3\} + C_{01}(I_2-3)\right],\quad J = I_1-3,\quad "
    r"S = \int_0^J\Bigl(\frac{j+c^2}{1+c^2}\Bigr)^{-n/2}dj,\quad "
    r"\lambda_\theta^2 = 1+\cot^2\theta_0\,(1-\lambda_z^2)",
    parameters=(
        Parameter(
            *("shear_modulus", "C_{10}", "Pa"),
            default=0.468e6,
            lower=0.0,
            upper=3.0e6,
            source=_MAPS,
            description="First Mooney-Rivlin constant C10; the shear modulus of a neo-Hookean wall is "
            "twice this value.",
            off=0.0,
        ),
        Parameter(
            "mooney_constant",
            "C_{01}",
            "Pa",
            default=0.0,
            lower=-0.5e6,
            upper=2.0e6,
            source=Source("Klute & Hannaford 2000, latex 0.106 MPa", "M"),
            description="Second Mooney-Rivlin constant C01; 0 is a neo-Hookean wall. Nearly collinear "
            "with C10.",
            off=0.0,
            fitted=False,
        ),
        Parameter(
            "stiffening",
            "y",
            "1",
            default=0.0,
            lower=0.0,
            upper=0.5,
            source=Source("Yeoh's C20/C10; Gent's 1/(2 J_m): 0.005 of gum, 0.1 of highly filled rubber", "M"),
            description="Excess of the energy at large strain; 0 is a neo-Hookean wall, larger when polymer "
            "chains approach their limit of extension.",
            fitted=False,
        ),
        Parameter(
            *("softening", "n", "1"),
            default=0.0,
            lower=0.0,
            upper=1.5,
            source=_FILLED,
            description="Softening of a filled rubber with its strain; 0 is a neo-Hookean wall.",
            off=0.0,
            fitted=False,
        ),
        Parameter(
            *("onset", "c", "1"),
            default=0.4,
            lower=0.02,
            upper=0.6,
            source=_FILLED,
            description="Strain beyond which a filled rubber softens.",
            fitted=False,
        ),
    ),
    slots={"elastomer": elastomer},
    needs=("wall_thickness",),
    kinds=frozenset({"isobaric", "isometric", "isotonic", "static", "transient"}),
    signature=Signature(
        text="constant in pressure, rising steeply over the first 5 % of contraction and then saturating",
        direction="even",
        pressure_power=0.0,
        zero_at=("nominal_length",),
        energy="conservative",
    ),
    confused_with=(
        Twin("prestress", "lengths near the rest length: there the prestress acts, the bladder does not"),
        Twin(
            "linear_elasticity",
            "contractions beyond 10 %: a linear spring keeps rising, the bladder saturates",
        ),
        Twin("threshold_pressure", "force over pressure at several lengths: the intercept grows"),
        Twin("contraction_factor", "several pressures: the effect of the factor grows with pressure"),
    ),
    prior=Prior(0.9, "every muscle has a rubber bladder, and it resists every change of diameter"),
    references=(
        Source("Yeoh, Rubber Chem. Technol. 66 (1993) 754; Gent, ibid. 69 (1996) 59", "M"),
        Source("Klute & Hannaford, J. Dyn. Syst. Meas. Control 122 (2000) 386", "M"),
        Source("Martens & Boblan, Actuators 6(4):33 (2017), doi 10.3390/act6040033", "S2"),
    ),
    examples=tuple(
        Example("force_change", tension, 1e-5, _DERIVED, _LATEX, _SIZE, {"length": length, "pressure": 3e5})
        for length, tension in ((0.285, -78.939), (0.270, -100.678), (0.240, -108.932))
    ),
)
