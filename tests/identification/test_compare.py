"""Comparing measurements with the model: errors, exclusions, fits that recover what another model hid."""

from __future__ import annotations

from math import pi, radians, sin, sqrt, tan
from pathlib import Path

import numpy as np
import pytest

from mckibben.identification.compare import compare
from mckibben.identification.noise import noise_floor
from mckibben.identification.predict import force_gradient, predict, task_of, with_values
from mckibben.identification.read import read_measurement
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.errors import InputError
from mckibben.physics.muscle import Muscle
from mckibben.simulation.static import StaticModel

MUSCLE = Muscle(0.3, 0.0218, radians(26.5), 0.0018, 0.02)
CATALOGUE = default_catalogue()
DATA = Path(__file__).parents[3] / "shared" / "data"
G = 9.80665


def truth(pressure, length, *, angle=26.5, c10=0.0, prestress=0.0, friction=0.0):
    """Ideal force and neo-Hookean wall, written here on its own; friction is signed by the caller."""
    t = radians(angle)
    lam = length / 0.3
    ideal = pressure * pi * 0.0218**2 / 4 * (3 / tan(t) ** 2 * lam**2 - 1 / sin(t) ** 2)
    q = 1 / tan(t) ** 2
    hoop = sqrt(1 + q * (1 - lam**2))
    radial = 1 / (lam * hoop)
    d_hoop = -lam * q / hoop
    d_radial = -(hoop + lam * d_hoop) / (lam * hoop) ** 2
    wall = pi * 0.0218 * 0.0018 * c10 * 2 * (lam + hoop * d_hoop + radial * d_radial)
    return ideal + wall - prestress + friction


def csv(rows: list[str], header: str, *comments: str):
    text = "\n".join([*(f"# {comment}" for comment in comments), header, *rows]) + "\n"
    return read_measurement(text.encode(), "made.csv")


def force_map(noise: float = 0.0, **hidden):
    rng = np.random.default_rng(7)
    rows = [
        f"{p / 1e5},{1e3 * length},{truth(p, length, **hidden) + rng.normal(0, noise)}"
        for p in (3e5, 4e5, 5e5, 6e5, 7e5)
        for length in np.linspace(0.255, 0.3, 12)
    ]
    return csv(rows, "pressure_bar,length_mm,force_N", "kind: static")


def test_the_right_model_has_no_error():
    result = compare(force_map(), MUSCLE, {}, catalogue=CATALOGUE)
    assert result.rmse < 1e-9
    assert result.report()["rows_used"] == 60


def test_error_figures_are_those_of_the_definition():
    measurement = force_map(c10=0.4e6)
    result = compare(measurement, MUSCLE, {}, catalogue=CATALOGUE)
    measured = measurement.columns["force"]
    ideal = np.array(
        [
            truth(p, length)
            for p, length in zip(measurement.columns["pressure"], measurement.columns["length"], strict=True)
        ]
    )
    assert result.rmse == pytest.approx(float(np.sqrt(np.mean((measured - ideal) ** 2))), rel=1e-9)
    assert result.nrmse_percent == pytest.approx(100 * result.rmse / np.max(measured), rel=1e-9)
    assert result.holdout_rmse == result.rmse  # nothing was fitted
    assert result.report()["residual_mean"] == pytest.approx(float(np.mean(measured - ideal)), rel=1e-9)


def test_fit_recovers_the_hidden_constants_within_their_errors():
    measurement = force_map(noise=2.0, angle=26.0, c10=0.52e6, prestress=40.0)
    effects = {"bladder_elasticity": {}, "prestress": {}}
    result = compare(measurement, MUSCLE, effects, catalogue=CATALOGUE, fit=True, free=["braid_angle"])
    table = result.report()["parameters"]
    for got, expected in (
        (table["bladder_elasticity"]["shear_modulus"], 0.52e6),
        (table["prestress"]["force"], 40.0),
        (table["geometry"]["braid_angle"], radians(26.0)),
    ):
        assert abs(got["value"] - expected) < 4 * got["stderr"]
        assert not got["at_bound"]
    assert result.rmse == pytest.approx(2.0, rel=0.25)
    assert result.noise == pytest.approx(2.0, rel=0.35)
    assert result.rmse < result.holdout_rmse < 1.3 * result.rmse


def test_zeros_of_a_clipped_map_are_not_measurements():
    rows = ["1,255,0", "1,270,0", "3,255,100", "3,270,210", "3,285,330"]
    result = compare(csv(rows, "pressure_bar,length_mm,force_N"), MUSCLE, {}, catalogue=CATALOGUE)
    assert result.report()["rows_used"] == 3
    assert result.report()["excluded"] == {"slack": 2}


def test_friction_of_a_known_direction_is_found():
    rows = [
        f"{p / 1e5},{1e3 * length},{truth(p, length, friction=17.0 * d)},{d}"
        for p in (2e5, 4e5)
        for d in (-1, 1)
        for length in np.linspace(0.26, 0.3, 9)
    ]
    measurement = csv(rows, "pressure_bar,length_mm,force_N,direction", "kind: isobaric")
    effect = {"coulomb_friction": {}}
    result = compare(measurement, MUSCLE, effect, catalogue=CATALOGUE, fit=True)
    assert result.report()["parameters"]["coulomb_friction"]["force"]["value"] == pytest.approx(
        17.0, rel=1e-6
    )


def test_isotonic_length_under_a_hanging_mass():
    lengths = np.linspace(0.26, 0.295, 8)
    load = 20 * G
    area = [truth(1.0, length) for length in lengths]  # the ideal force is proportional to pressure
    rows = [f"{load / a / 1e5},{1e3 * length}" for a, length in zip(area, lengths, strict=True)]
    measurement = csv(rows, "pressure_bar,length_mm", "kind: isotonic", "load_mass: 20 kg")
    result = compare(measurement, MUSCLE, {}, catalogue=CATALOGUE)
    assert result.task.channel == "length"
    assert result.rmse < 1e-9


def test_isotonic_fit_by_differences():
    pressures = np.linspace(3e5, 6e5, 9)
    rows = []
    for p in pressures:
        low, high = 0.2, 0.33
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if truth(p, middle, prestress=60.0) < 250.0 else (low, middle)
        rows.append(f"{p / 1e5},{1e3 * low}")
    measurement = csv(rows, "pressure_bar,length_mm", "kind: isotonic", "load_force: 250 N")
    result = compare(measurement, MUSCLE, {"prestress": {}}, catalogue=CATALOGUE, fit=True)
    assert result.report()["parameters"]["prestress"]["force"]["value"] == pytest.approx(60.0, rel=1e-4)


def test_isotonic_without_a_load_asks_for_it():
    measurement = csv(["1,300", "2,290", "3,280"], "pressure_bar,length_mm", "kind: isotonic")
    with pytest.raises(InputError) as error:
        task_of(measurement, MUSCLE)
    assert error.value.field == "load_force"
    assert "load_mass" in (error.value.hint or "")


def test_diameter_of_the_braid():
    lengths = np.linspace(0.24, 0.3, 6)
    t = radians(26.5)
    diameters = [0.0218 * sqrt(1 / sin(t) ** 2 - (length / 0.3) ** 2 / tan(t) ** 2) for length in lengths]
    rows = [f"{1e3 * length},{1e3 * d}" for length, d in zip(lengths, diameters, strict=True)]
    result = compare(csv(rows, "length_mm,diameter_mm"), MUSCLE, {}, catalogue=CATALOGUE)
    assert result.task.kind == "diameter"
    assert result.rmse < 1e-12


def test_transient_is_refused_with_a_way_out():
    measurement = csv(["0,0,0", "0.1,1,2", "0.2,2,3"], "time_s,pressure_bar,displacement_mm")
    with pytest.raises(InputError, match="transient") as error:
        compare(measurement, MUSCLE, {}, catalogue=CATALOGUE)
    assert error.value.field == "measurement"


def test_unknown_geometry_to_free_names_the_nearest():
    with pytest.raises(InputError) as error:
        compare(force_map(), MUSCLE, {}, catalogue=CATALOGUE, fit=True, free=["braid_angel"])
    assert error.value.hint == "Did you mean 'braid_angle'?"


def test_noise_floor_ignores_what_is_smooth():
    measurement = force_map(noise=3.0, c10=0.5e6)
    task = task_of(measurement, MUSCLE)
    model = StaticModel(MUSCLE)
    estimate = noise_floor(task, task.measured - predict(task, model))
    assert estimate == pytest.approx(3.0, rel=0.35)


@pytest.mark.parametrize("effect", sorted(CATALOGUE))
def test_exact_gradient_of_every_effect_is_the_central_difference(effect):
    measurement = force_map(c10=0.4e6)
    task = task_of(measurement, MUSCLE)
    task = type(task)(**{**task.__dict__, "state": {
        **task.state,
        "direction": np.where(np.arange(60) % 2, 1.0, -1.0),
        "velocity": np.full(60, 0.02),
        "temperature": np.full(60, 310.0),
    }})  # fmt: skip
    # The elastomer gives the temperature something to act on, the compliance tests the implicit derivative.
    effects = {"bladder_elasticity": {}, "rig_compliance": {}, effect: {}}
    model = StaticModel(MUSCLE, effects)
    names = (*(f"{effect}.{p.name}" for p in CATALOGUE[effect].parameters), "braid_angle", "nominal_length")
    exact = force_gradient(task, MUSCLE, model.effects, model.values, names)
    for column, name in enumerate(names):
        if name in MUSCLE._fields:
            value, step = getattr(MUSCLE, name), 1e-6
        else:
            parameter = CATALOGUE[effect].parameter(name.split(".")[1])
            value = model.values[effect][parameter.name]
            step = 1e-5 * (parameter.upper - parameter.lower)
        sides = []
        for sign in (1, -1):
            muscle, values = with_values(MUSCLE, model.values, [name], [value + sign * step])
            shifted = StaticModel(muscle)  # unchecked values: a step may leave the bounds
            shifted.values, shifted.effects = values, model.effects
            shifted._compiled, shifted._constants = (
                model._compiled,
                model._compiled.pack(muscle, values),
            )
            sides.append(predict(task, shifted, clipped=False))
        central = (sides[0] - sides[1]) / (2 * step)
        scale = np.max(np.abs(central)) + 1e-12
        np.testing.assert_allclose(exact[:, column] / scale, central / scale, atol=2e-4)


@pytest.mark.parametrize(
    ("sample", "nominal_length", "bore", "shear_constant"),
    [("DMSP-20-300", 0.296, 0.020, 0.465e6), ("DMSP-10-250", 0.250, 0.010, 0.471e6)],
)
def test_force_maps_of_martens_and_boblan(sample, nominal_length, bore, shear_constant):
    path = DATA / f"{sample}_force_map.csv"
    if not path.exists():
        pytest.skip(f"{path.name} is not beside the project")
    measurement = read_measurement(path.read_bytes(), path.name)
    muscle = Muscle(nominal_length, bore + 0.0018, radians(25.5), 0.0018, bore)
    ideal = compare(measurement, muscle, {}, catalogue=CATALOGUE)
    fitted = compare(
        measurement,
        muscle,
        {"bladder_elasticity": {}, "prestress": {}},
        catalogue=CATALOGUE,
        fit=True,
        free=["braid_angle"],
    )
    # Independent fit of the same three parameters: 1.26 % and 1.23 % of full scale.
    assert fitted.nrmse_percent <= 1.3
    assert ideal.nrmse_percent > 15.0
    shear = fitted.report()["parameters"]["bladder_elasticity"]["shear_modulus"]["value"]
    assert shear == pytest.approx(shear_constant, rel=0.01)
    assert fitted.holdout_rmse is not None
    assert fitted.holdout_rmse < 0.016 * fitted.full_scale
