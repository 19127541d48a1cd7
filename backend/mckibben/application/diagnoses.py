"""A diagnosis as JSON: candidates, path, verdict, and models that can be sent back."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from mckibben.application.asked import Asked
from mckibben.application.start import Json, geometry_json
from mckibben.application.wording import sentence_of
from mckibben.documents.studio import Studio
from mckibben.identification.diagnose.diagnosis import FEWEST_VALUES, Diagnosis, SingleAddition, diagnose
from mckibben.identification.diagnose.next_measurement import declared
from mckibben.identification.fit.comparison import check_finite, parameter_table
from mckibben.identification.fit.fitted_model import FittedModel
from mckibben.identification.fit.fitter import CancelledError
from mckibben.identification.predict import predictor_of
from mckibben.identification.predict.fit_model import free_geometry
from mckibben.identification.residual.profiles import variables_of
from mckibben.identification.residual.structure import SYMBOLS
from mckibben.measurement.reduction import reduced
from mckibben.physics.custom import CUSTOM, TERM
from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError
from mckibben.simulation.outcome import Watch

_MOST_ROWS = 3000
_CURVE = 200

#: A diagnosis that takes longer is stopped [s].
TIME_LIMIT = 300.0


def prepare(asked: Asked, studio: Studio) -> Callable[[Watch], Json]:
    """The diagnosis a request means, ready to start.

    Raises:
        InputError: the measurement does not allow it.
    """
    fit_model = asked.fit_model()
    measurement = asked.points.measurement
    notes: list[str] = []
    used = measurement
    left_out = dict(asked.points.left_out)
    if measurement.kind != "transient" and measurement.rows > _MOST_ROWS:
        less = reduced(measurement, _MOST_ROWS)
        used = less.measurement
        left_out |= measurement.exclusions
        notes.append(less.message)
    predictor = predictor_of(used, fit_model.muscle, asked.drive)
    check_finite(predictor, fit_model)
    if len(predictor.measured) < FEWEST_VALUES:
        raise InputError(
            f"{measurement.name}: {len(predictor.measured)} values are too few for a diagnosis",
            field="measurement",
            hint=f"measure at least {FEWEST_VALUES}, at several pressures or lengths; 'compare' takes fewer",
        )
    geometry = free_geometry(
        fit_model.muscle, asked.free, {} if asked.start.preset is None else asked.start.preset.tolerance
    )
    if asked.noise is not None and len(predictor.channels) > 1:
        raise InputError(
            "one noise cannot be stated for several predicted channels", field="noise", hint="leave it out"
        )
    rows = measurement.rows + sum(asked.points.left_out.values())
    left_out |= predictor.excluded
    if averaged := rows - predictor.rows_used - sum(left_out.values()):
        left_out["averaged into the others"] = averaged
    # A typed term is not a candidate, but stays in the model that has it.
    catalogue = {**studio.catalogue, **asked.start.catalogue}

    def work(watch: Watch) -> Json:
        def tell(candidate: SingleAddition) -> None:
            if watch.found is not None:
                watch.found(_candidate(asked, candidate, catalogue))

        try:
            result = diagnose(
                predictor,
                fit_model,
                catalogue=catalogue,
                geometry=geometry,
                freed=asked.freed,
                noise=asked.noise,
                watch=watch,
                found=tell,
            )
        except CancelledError as stop:
            raise InputError(
                "the diagnosis was stopped before it was done", hint="fewer rows or effects", code="stopped"
            ) from stop
        counts = {"rows": rows, "rows_used": predictor.rows_used, "excluded": left_out}
        return counts | _answer(asked, result, catalogue, notes=notes)

    return work


def _answer(asked: Asked, result: Diagnosis, catalogue: Mapping[str, Effect], *, notes: list[str]) -> Json:
    predictor, best = result.predictor, result.best
    start = asked.start
    full_scale = float(np.max(np.abs(predictor.measured / predictor.scale)))
    muscle = best.fit_model.muscle
    titles = {name: effect.title for name, effect in catalogue.items()}
    experiments = [
        {
            "pair": [p.first, p.second],
            "declared": p.declared,
            "protocol": p.protocol,
            "separation": p.separation,
        }
        for p in result.proposals
    ]
    nexts = [p.sentence(titles) for p in result.proposals]
    return {
        "kind": predictor.kind,
        "predicted": predictor.predicted,
        "unit": predictor.unit,
        "baseline": {
            "rmse": result.start.rmse,
            "nrmse_percent": 100.0 * result.start.rmse / full_scale if full_scale else None,
            "holdout_rmse": result.start.holdout_rmse,
        },
        "noise_floor": {"rmse": result.noise, "how": result.noise_how},
        "channels": _channels(result),
        "where": [profile.report() for profile in result.where],
        "candidates": [_candidate(asked, c, catalogue) for c in result.candidates],
        "path": [
            {
                "added": step.added,
                "rmse": step.fitted_model.rmse,
                "holdout_rmse": step.fitted_model.holdout_rmse,
                "model": {"effects": asked.effects_json(step.fitted_model.fit_model)},
                "freed": sorted(step.fitted_model.freed),
            }
            for step in result.path
        ],
        "verdict": {
            "status": result.status,
            "effects": list(result.added),
            "indistinguishable": groups_of(result),
            "unexplained_share": result.structure.share,
            "unexplained_in": [name for name, _ in result.structure.variables],
            "proposed_term": _term(asked, result),
            "next_measurement": "; ".join(nexts[:3]) or None,
            "experiments": experiments,
            "sentence": sentence_of(result, titles),
        },
        "parameters": parameter_table(best.fit_model, result.fit),
        "correlations": [
            {"a": a, "b": b, "value": value}
            for a, b, value in (result.fit.correlations if result.fit else ())
        ],
        "geometry": geometry_json(
            start if muscle == start.muscle else replace(start, muscle=muscle, rhombus=None)
        ),
        "model": {
            "muscle": {name: float(value) for name, value in muscle._asdict().items() if value},
            "effects": asked.effects_json(best.fit_model),
        },
        "freed": sorted(best.freed),
        "not_tried": [{"effect": item.effect, "why": item.why} for item in result.not_tried],
        "messages": [*asked.points.measurement.messages, *notes, *result.messages],
    }


def groups_of(result: Diagnosis) -> list[list[str]]:
    """Effects that these data cannot tell apart: each added effect with what could stand in for it."""
    found = []
    for added in result.added:
        others = [other.effect for other in result.alternatives if other.of == added]
        if others:
            found.append([added, *others])
    return found


def _channels(result: Diagnosis) -> Json:
    predictor = result.predictor
    if len(predictor.channels) < 2:
        return {}
    residual = result.best.residual * predictor.scale
    return {
        channel.name: {
            "rmse": float(np.sqrt(np.mean(residual[channel.rows] ** 2))),
            "unit": channel.unit,
            "noise_floor": channel.noise,
            "full_scale": channel.full_scale,
        }
        for channel in predictor.channels
    }


def _candidate(asked: Asked, candidate: SingleAddition, catalogue: Mapping[str, Effect]) -> Json:
    fitted_model, effect = candidate.fitted_model, candidate.effect
    twin = catalogue.get(candidate.twins[0]) if candidate.twins else None
    return {
        "effect": effect.id,
        "title": effect.title,
        "rmse": fitted_model.rmse,
        "holdout_rmse": fitted_model.holdout_rmse,
        "gain_percent": 100.0 * candidate.gain,
        "delta_bic": candidate.score,
        "parameters": _parameters(fitted_model, effect),
        "twins": list(candidate.twins),
        "why": candidate.why,
        "equation": effect.equation,
        "freed": sorted(fitted_model.freed),
        "next_measurement": None if twin is None else declared(effect, twin) or None,
        "model": {"effects": asked.effects_json(fitted_model.fit_model)},
    }


def _parameters(fitted_model: FittedModel, effect: Effect) -> Json:
    errors = fitted_model.standard_errors
    free = {p.name: number for number, p in enumerate(fitted_model.free)}
    found = {}
    for p in effect.parameters:
        place = free.get(f"{effect.id}.{p.name}")
        found[p.name] = {
            "value": fitted_model.fit_model.values[effect.id][p.name],
            "stderr": None if place is None else errors[place],
            "unit": p.unit,
            "at_bound": place is not None and bool(fitted_model.at_bound[place]),
            "fitted": place is not None,
        }
    return found


def _term(asked: Asked, result: Diagnosis) -> Json | None:
    """The proposed term with a model that has it and a curve over what it mostly depends on."""
    term = result.term
    if term is None:
        return None
    effects = asked.effects_json(result.best.fit_model)
    formula, coefficients = term.formula, dict(term.coefficients)
    if CUSTOM in effects:  # one typed term at a time: the new one goes on where it ends
        old = effects[CUSTOM]
        renamed = {name: f"d{name[1:]}" for name in coefficients}
        for name, other in renamed.items():
            formula = formula.replace(f"{name}*", f"{other}*")
        coefficients = {renamed[name]: value for name, value in coefficients.items()}
        formula = f"{old[TERM]} + {formula}"
        coefficients |= {name: float(value) for name, value in old.items() if name != TERM}
    variables = variables_of(result.predictor, result.best.fit_model.muscle.nominal_length)
    name = next(
        (n for n, _ in result.structure.variables if n in SYMBOLS.values()),
        next(n for n in SYMBOLS.values() if n in variables),
    )
    x = variables[name]
    rows = np.argsort(x, kind="stable")
    rows = rows[np.unique(np.linspace(0, len(rows) - 1, _CURVE).astype(int))]
    return {
        "formula": formula,
        "coefficients": coefficients,
        "share": term.share,
        "model": {"effects": {**effects, CUSTOM: {TERM: formula, **coefficients}}},
        "curve": {
            "x": name,
            "values": x[rows],
            "term": term.values[rows],
            "residual": result.best.residual[rows],
        },
    }
