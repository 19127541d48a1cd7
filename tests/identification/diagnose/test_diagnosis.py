"""Diagnoses of measurements whose hidden part was written here: what is found, what not, when to stop."""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from math import exp, radians, sin
from pathlib import Path

import numpy as np
import pytest

from mckibben.identification.diagnose.diagnosis import Diagnosis, diagnose
from mckibben.identification.diagnose.steps import SingleAddition
from mckibben.identification.diagnose.words import sentence_of
from mckibben.identification.fit.fitter import CancelledError
from mckibben.identification.predict import predictor_of
from mckibben.identification.predict.fit_model import FitModel, Free, free_geometry
from mckibben.measurement.measurement import Measurement
from mckibben.measurement.reading import read_measurement
from mckibben.physics.custom import custom_effect
from mckibben.simulation.outcome import Outcome, Watch
from tests.identification.synthetic import CATALOGUE, MUSCLE, csv, cycles, force_map, length_under
from tests.identification.synthetic import truth as hidden_force
from tests.looks import Looks
from tests.shipped import shipped_studio

DATA = Path(__file__).parents[4] / "shared" / "data"
FRICTION = 15.0


def coulomb(*, direction: float, **_: float) -> float:
    return FRICTION * direction


def ripple(*, kappa: float, **_: float) -> float:
    return 12.0 * sin(150.0 * kappa)


def fit_model(**effects: dict[str, float]) -> FitModel:
    chosen = tuple(CATALOGUE[name] for name in effects)
    return FitModel(MUSCLE, chosen, {e.id: e.defaults | effects[e.id] for e in chosen})


def diagnosis(
    measurement: Measurement, start: FitModel | None = None, *, geometry: Sequence[Free] = (), **options
) -> Diagnosis:
    predictor = predictor_of(measurement, MUSCLE)
    return diagnose(predictor, start or fit_model(), catalogue=CATALOGUE, geometry=geometry, **options)


@lru_cache
def of_friction(noise: float) -> Diagnosis:
    """Cycles at two speeds with Coulomb friction, from the ideal muscle."""
    return diagnosis(cycles(coulomb, noise=noise, each=30, second=3.0))


# --- made-up data without noise


def test_data_without_noise_end_at_their_digits():
    found = diagnosis(force_map(prestress=-30.0))
    assert (found.status, found.added) == ("ambiguous", ("prestress",))
    assert found.best.fit_model.values["prestress"]["force"] == pytest.approx(-30.0, rel=1e-6)
    assert {other.effect for other in found.alternatives} == {"force_offset"}


def test_what_changes_nothing_has_no_twins():
    """Without motion or a change of temperature several candidates do nothing, and are not alike for that."""
    found = diagnosis(force_map(noise=2.0, prestress=-30.0))
    idle = [candidate for candidate in found.candidates if abs(candidate.gain) < 1e-3]
    assert len(idle) > 3
    assert all(candidate.twins == () for candidate in idle)


# --- nothing is missing


@pytest.mark.parametrize(
    "measurement", [cycles(noise=2.0, each=30), force_map(noise=2.0)], ids=["cycles", "map"]
)
def test_noise_alone_is_adequate(measurement):
    found = diagnosis(measurement)
    assert found.status == "adequate"
    assert found.added == ()
    assert found.term is None
    assert found.noise == pytest.approx(2.0, rel=0.35)
    assert found.best.rmse == pytest.approx(2.0, rel=0.2)
    assert [step.added for step in found.path] == [None]
    assert found.judgement.predictable < 0.3


def test_a_right_model_with_effects_is_adequate():
    measurement = cycles(coulomb, noise=1.0, each=30, c10=0.4e6)
    start = fit_model(bladder_elasticity={"shear_modulus": 0.6e6}, coulomb_friction={"force": 4.0})
    found = diagnosis(measurement, start)
    assert found.status == "adequate"
    assert found.added == ()
    # The start model as given is far off; its numbers are refitted.
    assert found.start.rmse > 5.0 * found.best.rmse
    assert found.best.fit_model.values["bladder_elasticity"]["shear_modulus"] == pytest.approx(
        0.4e6, rel=0.01
    )
    assert found.best.fit_model.values["coulomb_friction"]["force"] == pytest.approx(FRICTION, rel=0.02)
    assert found.path[0].fitted_model.rmse == found.start.rmse
    assert found.path[-1].fitted_model.rmse == found.best.rmse


def test_without_noise_nothing_is_missing_either():
    assert diagnosis(cycles(each=30)).status == "adequate"


def test_rounding_errors_are_no_effect():
    found = diagnosis(force_map())
    assert found.status == "adequate"


# --- one effect


@pytest.mark.parametrize("noise", [0.0, 1.0])
def test_one_missing_friction_is_found(noise):
    found = of_friction(noise)
    assert found.added == ("coulomb_friction",)
    # Steps of several millimetres do not show over which travel the friction changes sign.
    presliding = {"bouc_wen", "dahl", "maxwell_slip"}
    # Without any noise even their smallest travel is told from none.
    assert {(other.of, other.effect in presliding) for other in found.alternatives} == (
        {("coulomb_friction", True)} if noise else set()
    )
    value = found.best.fit_model.values["coulomb_friction"]["force"]
    assert value == pytest.approx(FRICTION, abs=0.2 * noise + 1e-4)
    assert found.start.rmse == pytest.approx(np.hypot(FRICTION, noise), rel=0.02)
    first = found.candidates[0]
    assert first.effect.id == "coulomb_friction"
    assert first.gain > 0.9
    assert "changes sign with the direction of motion" in first.why
    assert found.where[0].over in ("direction", "velocity")  # here the speed tells the direction
    assert found.where[0].share_explained > 0.95


def test_a_bladder_is_found_on_a_map():
    found = diagnosis(force_map(noise=1.0, c10=0.5e6))
    assert found.status == "missing_effects"
    assert found.added == ("bladder_elasticity",)
    table = {p.name: p for p in found.fit.parameters} if found.fit else {}
    shear = table["bladder_elasticity.shear_modulus"]
    assert shear.stderr is not None
    assert abs(shear.value - 0.5e6) < 4.0 * shear.stderr


def test_one_speed_cannot_tell_friction_from_damping():
    found = diagnosis(cycles(coulomb, noise=1.0, each=30))
    assert found.status == "ambiguous"
    assert found.added == ("coulomb_friction",)  # the simpler of both
    assert "viscous_damping" in {other.effect for other in found.alternatives}
    assert any("speed" in proposal.declared for proposal in found.proposals)


def test_two_effects_are_found_in_the_order_of_their_size():
    found = diagnosis(cycles(coulomb, noise=1.0, each=30, c10=0.4e6, second=3.0))
    assert {other.of for other in found.alternatives} == {"coulomb_friction"}  # its twins with presliding
    assert set(found.added) == {"bladder_elasticity", "coulomb_friction"}
    assert [step.added for step in found.path] == [None, "bladder_elasticity", "coulomb_friction"]
    errors = [step.fitted_model.rmse for step in found.path]
    assert errors == sorted(errors, reverse=True)
    assert errors[-1] == pytest.approx(1.0, rel=0.15)
    assert found.path[-1].fitted_model.fit_model.ids == found.best.fit_model.ids


def test_every_effect_that_can_show_is_a_candidate_with_its_reason():
    found = of_friction(1.0)
    several = {name for name, effect in CATALOGUE.items() if effect.among_lengths}
    expected = {
        name for name, effect in CATALOGUE.items() if not found.predictor.why_hidden(effect)
    } - several
    assert several <= {item.effect for item in found.not_tried if "several lengths" in item.why}
    assert {candidate.effect.id for candidate in found.candidates} == expected
    scores = [candidate.score for candidate in found.candidates]
    assert scores == sorted(scores)
    for candidate in found.candidates:
        assert candidate.why.startswith(candidate.effect.title)
        # An effect that cannot be switched off by what is fitted may do harm.
        if all(p.fitted or p.off is None for p in candidate.effect.parameters):
            assert candidate.gain > -1e-3
        assert candidate.fitted_model.fit_model.ids[-1] == candidate.effect.id


def test_a_bladder_is_found_without_a_stated_wall_by_its_product_with_the_modulus():
    bare = MUSCLE._replace(wall_thickness=0.0)
    predictor = predictor_of(force_map(noise=1.0, c10=0.3e6), bare)
    found = diagnose(predictor, FitModel(bare), catalogue=CATALOGUE)
    assert found.added == ("bladder_elasticity",)
    best = found.best.fit_model
    assert found.best.rmse == pytest.approx(1.0, rel=0.2)
    assert best.assumed == {"wall_thickness"}
    # The hidden wall of 1.8 mm at 0.3 MPa; what was assumed instead of it only shifts the modulus.
    product = best.values["bladder_elasticity"]["shear_modulus"] * best.muscle.wall_thickness
    assert product == pytest.approx(0.3e6 * 0.0018, rel=0.02)
    said = next(message for message in found.messages if "wall thickness" in message)
    assert "1.5 mm is assumed" in said
    assert f"shear modulus x wall thickness = {product:.4g} N/m" in said
    assert "state wall_thickness" in said
    # Without the effect nothing of the muscle was assumed.
    assert found.start.fit_model.muscle == bare
    assert best.without("bladder_elasticity").muscle == bare


def test_every_effect_is_a_candidate_or_told_with_the_reason():
    found = diagnosis(force_map(noise=1.0), fit_model(prestress={"force": 0.0}))
    tried = {candidate.effect.id for candidate in found.candidates}
    reasons = {item.effect: item.why for item in found.not_tried}
    assert tried | set(reasons) | {"prestress"} == set(CATALOGUE)
    assert not tried & set(reasons)
    assert reasons["dahl"].startswith("it does not show in static data, only in isobaric")
    assert "only in transient" in reasons["leak"]


# --- what cannot be told apart


def test_an_offset_of_the_sensor_and_a_prestress_are_one_group():
    """Both are one constant force under tension; only a slack muscle, like no muscle, tells them apart."""
    found = diagnosis(cycles(noise=1.0, each=30, prestress=40.0))
    assert found.status == "ambiguous"
    assert len(found.added) == 1
    names = {found.added[0], *(other.effect for other in found.alternatives)}
    assert names == {"prestress", "force_offset"}
    other = found.alternatives[0]
    assert other.difference < 1e-3
    twins = {c.effect.id: c.twins for c in found.candidates if c.effect.id in names}
    assert "prestress" in twins["force_offset"]
    assert "force_offset" in twins["prestress"]
    assert len(found.proposals) == 1
    assert "with the muscle removed" in found.proposals[0].declared
    assert found.proposals[0].protocol.startswith("pressure ramps up and down from vented")
    assert 3.0 < found.proposals[0].separation < 40.0  # 40 N, beside a noise of 1 N, in a part of the rows


def test_slack_rows_with_noise_do_not_bend_the_fit():
    """A load cell shows the slack muscle as 0 N with its noise, not as the model's force below zero."""
    rng = np.random.default_rng(5)
    pressure, length = rng.uniform(1.5e5, 6e5, 200), rng.uniform(0.22, 0.3, 200)
    force = np.maximum(hidden_force(pressure, length, c10=0.5e6), 0.0) + rng.normal(0.0, 2.0, 200)
    assert np.count_nonzero(force < 6.0) > 40
    rows = [f"{p / 1e5},{1e3 * x},{f}" for p, x, f in zip(pressure, length, force, strict=True)]
    found = diagnosis(csv(rows, "pressure_bar,length_mm,force_N", "kind: static"))
    assert found.added == ("bladder_elasticity",)
    assert found.best.rmse < 1.1 * 2.0
    assert found.best.fit_model.number("bladder_elasticity.shear_modulus") == pytest.approx(0.5e6, rel=0.02)


def test_a_freed_braid_angle_leaves_nothing_missing():
    """A muscle of 27 degrees taken for one of 26.5; `test_contest` asks about entries that nobody freed."""
    freed = diagnosis(force_map(noise=1.0, angle=27.0), geometry=free_geometry(MUSCLE, ["braid_angle"], {}))
    assert freed.added == ()
    assert freed.status == "adequate"
    assert [step.refitted for step in freed.path] == [False, True]
    assert sentence_of(freed, CATALOGUE).startswith("Nothing is missing: the error of ")
    assert "with the numbers of the model refitted; before" in sentence_of(freed, CATALOGUE)


def test_an_error_is_not_called_noise_where_the_noise_is_not_known():
    """Forces of another machine in twelve rows: hundreds of newtons off, and nothing tells the noise."""
    places = [(p, x) for p in (2, 4, 6) for x in (300, 290, 280, 270)]
    rows = [f"{p},{x},{300.0 + 250.0 * np.sin(2.3 * i)}" for i, (p, x) in enumerate(places)]
    found = diagnosis(csv(rows, "pressure_bar,length_mm,force_N", "kind: static"))
    assert found.noise is None
    assert found.status == "undecided"
    assert "the noise cannot be estimated and there are fewer than twenty rows" in sentence_of(found, {})


# --- what nobody knows


def test_a_ripple_is_an_unknown_effect_told_with_its_period_but_without_a_formula():
    found = diagnosis(cycles(ripple, noise=1.0, each=40))
    assert found.status == "unknown_effect"
    assert found.added == ()
    assert found.judgement.predictable > 0.8
    assert found.judgement.depends_on[0] == "contraction"
    assert found.term is None
    said = sentence_of(found, {})
    period = float(said.split("it repeats every ")[1].split(" mm of length")[0])
    assert period == pytest.approx(1e3 * 0.3 * 2.0 * np.pi / 150.0, rel=0.02)
    # A ripple depends on the contraction and is largest somewhere: beside its period both would mislead.
    assert "depends on" not in said
    assert "look where" not in said


def test_an_unknown_effect_without_a_formula_is_told_with_its_place():
    def bump(*, kappa: float, **_: float) -> float:
        return 14.0 * exp(-(((kappa - 0.08) / 0.012) ** 2))

    found = diagnosis(cycles(bump, noise=1.0, each=40))
    assert (found.status, found.repetition) == ("unknown_effect", None)
    assert found.term is not None
    assert found.term.smooth, "described, by a bell at its place; no short formula halves it"
    said = sentence_of(found, {})
    assert "No short formula halves it" in said
    # A tenth of the rows around the place with the largest error: the top of the bump is among them.
    low, high = map(float, said.split("largest: contraction ")[1].split(" %")[0].split(" to "))
    assert low < 8.0 < high
    contraction = 100.0 * (1.0 - found.predictor.inputs["length"] / 0.3)
    inside = (contraction >= low) & (contraction <= high)
    assert np.sqrt(np.mean(found.best.residual[inside] ** 2)) > 1.1 * found.best.rmse


def test_a_smooth_unknown_effect_is_proposed_as_a_short_term():
    """Friction in proportion to the square of the contraction: no effect of the catalogue."""

    def growing(*, kappa: float, direction: float, **_: float) -> float:
        return 3000.0 * kappa**2 * direction

    found = diagnosis(cycles(growing, noise=1.0, each=40, second=3.0))
    assert found.status == "unknown_effect"
    assert found.term is not None
    assert found.term.formula == "c1*kappa**2*sign(v)"
    assert found.term.coefficients["c1"] == pytest.approx(3000.0, rel=0.01)
    assert "look where" not in sentence_of(found, {})
    # The term can be typed; with it only the noise is left.
    effect = custom_effect(found.term.formula, found.term.coefficients)
    start = FitModel(MUSCLE, (effect,), {"custom": effect.defaults})
    assert found.predictor.rmse(found.predictor.residual(start)) < 1.2


@pytest.mark.examination("test_a_ripple_is_an_unknown_effect_told_with_its_period_but_without_a_formula")
def test_a_catalogued_part_is_found_beside_an_unknown_one():
    def both(**state: float) -> float:
        return coulomb(**state) + ripple(**state)  # type: ignore[arg-type]

    found = diagnosis(cycles(both, noise=1.0, each=40, second=3.0))
    assert found.status == "unknown_effect"
    # Beside a ripple of this size the first rows after a reversal do not tell Dahl's law from Coulomb's.
    assert "coulomb_friction" in {*found.added, *(other.effect for other in found.alternatives)}
    assert found.term is None
    assert "it repeats every 12." in sentence_of(found, {})


# --- noise, geometry, the end


def test_a_stated_noise_counts():
    measurement = cycles(noise=2.0, each=20)
    found = diagnosis(measurement, noise=2.5)
    assert (found.noise, found.noise_how) == (2.5, "given")
    assert found.status == "adequate"
    assert diagnosis(measurement).noise_how == "third differences of the residual within sweeps"


def test_freed_geometry_explains_what_geometry_can():
    measurement = force_map(noise=1.0, angle=25.5)
    angle = free_geometry(MUSCLE, ["braid_angle"], {"braid_angle": radians(2.0)})
    found = diagnosis(measurement, geometry=angle)
    assert found.status == "adequate"
    assert np.degrees(found.best.fit_model.muscle.braid_angle) == pytest.approx(25.5, abs=0.05)


def test_geometry_that_a_fit_moved_is_told():
    angle = free_geometry(MUSCLE, ["braid_angle"], {"braid_angle": radians(2.0)})
    found = diagnosis(force_map(noise=1.0, angle=25.5), geometry=angle)
    assert any("braid angle by -3.8 %" in message for message in found.messages)


def test_a_diagnosis_is_repeatable():
    first, second = of_friction(1.0), of_friction.__wrapped__(1.0)
    assert first.added == second.added
    assert first.best.rmse == second.best.rmse
    assert first.judgement.surface.variables == second.judgement.surface.variables


def test_progress_and_candidates_are_told():
    shares: list[float] = []
    told = []

    class Told(Watch):
        def ended(self, share: float):
            shares.append(share)
            return super().ended(share)

    found = diagnosis(
        cycles(coulomb, noise=1.0, each=20), watch=Told(time_limit=1e3), on_candidate=told.append
    )
    assert shares == sorted(shares)
    assert shares[0] >= 0.0
    assert shares[-1] <= 1.0
    assert {c.effect.id for c in told} == {c.effect.id for c in found.candidates}
    # A useful answer comes first: nearly the lowest error of all, in this example of a friction.
    assert told[0].fitted_model.rmse < 1.1 * min(c.fitted_model.rmse for c in told)


@pytest.mark.parametrize("fits", [1, 10, 60])
def test_whoever_goes_away_ends_it(fits):
    asked = []

    def gone() -> bool:
        asked.append(1)
        return len(asked) >= fits

    with pytest.raises(CancelledError):
        diagnosis(cycles(coulomb, noise=1.0, each=20, c10=0.4e6), watch=Watch(cancelled=gone, time_limit=1e3))
    assert len(asked) == fits


def test_without_time_for_the_start_model_there_is_nothing_to_keep():
    with pytest.raises(CancelledError) as end:
        diagnosis(cycles(coulomb, noise=1.0, each=20), watch=Looks(0))
    assert end.value.outcome is Outcome.TIMED_OUT


@pytest.mark.parametrize("fits", [1, 2, 6, 60])
def test_a_time_limit_keeps_what_was_found(fits):
    data = cycles(coulomb, noise=1.0, each=20, c10=0.4e6)
    told: list[SingleAddition] = []
    found = diagnosis(data, watch=Looks(fits), on_candidate=told.append)
    done = found.unfinished
    assert found.status == "unfinished"
    assert done is not None
    assert done.limit == 7.0
    assert done.models <= fits
    shown = {single.effect.id for single in told}
    assert done.tried == len(shown) == len(found.candidates)
    # What was not tried is named, each effect once; nothing is claimed beside what was fitted.
    untried = {each.effect for each in found.not_tried}
    assert not untried & shown
    assert len(untried | shown) == len(untried) + done.tried
    assert found.alternatives == found.evidence == found.corrections == found.context == ()
    # The path leads from the start model to the best model, one fitted effect at a time.
    effects = [set(step.fitted_model.fit_model.ids) for step in found.path]
    assert [step.added for step in found.path if step.added] == list(found.added)
    for step, before, after in zip(found.path[1:], effects, effects[1:], strict=False):
        assert after - before == ({step.added} if step.added else set())
    best = min((single.fitted_model.rmse for single in told), default=found.root.rmse)
    assert found.path[-1].fitted_model.rmse <= 1.05 * best
    if fits > 2:
        assert found.path[-1].fitted_model.rmse < 0.7 * found.start.rmse


# --- measured


LONG = pytest.mark.examination("test_the_maps_of_martens_and_boblan_from_the_ideal_muscle")


@pytest.mark.parametrize(
    ("sample", "preset", "nominal_length", "free"),
    [
        ("DMSP-20-300", "DMSP-20", 0.3, ()),
        pytest.param("DMSP-20-300", "DMSP-20", 0.3, ("braid_angle",), marks=LONG),
        pytest.param("DMSP-10-250", "DMSP-10", 0.25, (), marks=LONG),
        pytest.param("DMSP-10-250", "DMSP-10", 0.25, ("braid_angle",), marks=LONG),
    ],
)
def test_the_maps_of_martens_and_boblan_from_the_ideal_muscle(sample, preset, nominal_length, free):
    path = DATA / f"{sample}_force_map.csv"
    if not path.exists():
        pytest.skip(f"{path.name} is not beside the project")
    facts = shipped_studio().facts(preset)
    muscle = facts.muscle._replace(nominal_length=nominal_length)
    predictor = predictor_of(read_measurement(path.read_bytes(), path.name), muscle)
    geometry = free_geometry(muscle, free, facts.tolerance)
    found = diagnose(predictor, FitModel(muscle), catalogue=CATALOGUE, geometry=geometry)
    full_scale = float(np.max(predictor.measured))
    assert len(found.best.free) <= 7  # as many as Hildebrandt's formula
    assert found.best.rmse <= 0.010 * full_scale
    assert found.best.holdout_rmse <= 0.013 * full_scale
    # Hyperelastic walls and a constant force fit these maps best of all published structures.
    assert {"bladder_elasticity", "linear_elasticity"} & set(found.added)


def test_a_diagnosis_changes_none_of_its_arguments():
    """The same predictor serves a comparison, a diagnosis and its report one after the other."""
    rows = [f"{p},{length_under(100.0, p, prestress=40.0)}" for p in np.linspace(1.5e5, 6e5, 60)]
    predictor = predictor_of(csv(rows, "pressure_Pa,length_m", "kind: isotonic"), MUSCLE)
    start = fit_model(prestress={"force": 30.0})
    before = dict(vars(predictor))
    assert before["unknown_load"] is not None
    first = diagnose(predictor, start, catalogue=CATALOGUE)
    assert vars(predictor) == before
    again = diagnose(predictor, start, catalogue=CATALOGUE)
    assert (again.added, again.best.rmse) == (first.added, first.best.rmse)


def test_a_constant_without_a_slope_where_it_stands_is_found_where_it_has_one() -> None:
    """The bladder touches bit by bit: the softness of the threshold is 0 by default, without a slope."""
    random, rows = np.random.default_rng(3), []
    for length in (0.29, 0.27, 0.25):
        for share in np.linspace(0.02, 1.0, 40):
            pressure = 4e5 * share**2
            acting = pressure - 0.4e5 * (1.0 - np.exp(-pressure / 0.4e5))
            force = hidden_force(acting, length) + random.normal(0.0, 1.0)
            rows.append(f"{pressure / 1e5:.6f},{length * 1e3:.1f},{force:.3f}")
    found = diagnosis(csv(rows, "pressure_bar,length_mm,force_N", "kind: static"), noise=1.0)
    assert found.added == ("threshold_pressure",)
    assert found.best.fit_model.number("threshold_pressure.softness") == pytest.approx(1.0, abs=0.1)
    assert found.best.rmse < 1.1
