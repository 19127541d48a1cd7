"""The varied quantities of a study document, in SI, and the plan of its runs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import inf, prod

import numpy as np

from mckibben.documents.study import (
    MOST_RUNS,
    Distribution,
    LognormalDistribution,
    NormalDistribution,
    StudyDocument,
    TriangularDistribution,
    UniformDistribution,
    VariedQuantity,
)
from mckibben.documents.study_fields import StudyField
from mckibben.physics.errors import InputError, fields_inside
from mckibben.physics.units import si
from mckibben.studies import plan as plans
from mckibben.studies.optimise import FigureGoal, FigureLimit, OptimisationPlan
from mckibben.studies.sensitivity import morris_plan, sobol_plan
from mckibben.studies.table import Figure
from mckibben.studies.variable import (
    Quantile,
    Variable,
    log_uniform,
    lognormal,
    normal,
    triangular,
    uniform,
)

_LEAST_SHARE = 1e-9  # of a distribution that truncation leaves: less would be a mistake, and inexact
_RANDOM = ("latin_hypercube", "monte_carlo", "sobol", "morris")


def variables_of(document: StudyDocument, fields: Sequence[StudyField]) -> tuple[Variable, ...]:
    """The varied quantities.

    Args:
        document: the study.
        fields: of its quantities, in order.

    Raises:
        InputError: values that do not fit the field or the method; names the field of the study.
    """
    found: list[Variable] = []
    for place, (quantity, field) in enumerate(zip(document.quantities, fields, strict=True)):
        with fields_inside(f"quantities.{place}"):
            variable = _variable(quantity, field)
            _check_method(variable, document.method.type)
            if variable.name in {other.name for other in found}:
                raise InputError(f"{variable.name} is varied twice", field="path", hint="once is enough")
            found.append(variable)
    return tuple(found)


def _variable(quantity: VariedQuantity, field: StudyField) -> Variable:
    name = f"{quantity.path} (factor)" if quantity.relative else quantity.path
    if quantity.relative and field.unit is None:
        raise InputError(f"{quantity.path} is no quantity and has no factor", field="relative")
    unit = "1" if quantity.relative else field.unit

    def number(value: float | str, at: str) -> float:
        if isinstance(value, str) and unit is None:
            raise InputError(f"{quantity.path} is no quantity, it only takes values", field=at)
        with fields_inside(at):
            return si(value, unit or "1")

    values, quantile, bounds = None, None, None
    if quantity.values is not None:
        if unit is None and any(isinstance(value, str) for value in quantity.values):
            texts = tuple(str(value) for value in quantity.values)
            return Variable(name, quantity.path, None, np.arange(float(len(texts))), texts)
        values = np.array([number(value, f"values.{i}") for i, value in enumerate(quantity.values)])
    elif quantity.distribution is not None:
        with fields_inside("distribution"):
            quantile = _quantile(quantity.distribution, number, unit)
    else:
        low, high = number(quantity.begin or 0.0, "from"), number(quantity.end or 0.0, "to")
        logarithmic = quantity.scale == "logarithmic"
        if not low < high:
            raise InputError(f"the range ends at {high:g}, which is not above {low:g}", field="to")
        if logarithmic and low <= 0.0:
            raise InputError("a logarithmic range begins above 0", field="from")
        quantile = (log_uniform if logarithmic else uniform)(least=low, most=high)
        bounds = (low, high)
        if quantity.points is not None:
            spaced = np.geomspace if logarithmic else np.linspace
            values = spaced(low, high, quantity.points)
    return Variable(
        name, quantity.path, unit, values, (), quantile, quantity.relative, bounds,
        quantity.distribution is not None,
    )  # fmt: skip


def _quantile(law: Distribution, number: Callable[[float | str, str], float], unit: str | None) -> Quantile:
    """The inverse distribution function of a distribution.

    Raises:
        InputError: parameters that make no distribution.
    """
    least = -inf if law.least is None else number(law.least, "least")
    most = inf if law.most is None else number(law.most, "most")
    if not least < most:
        raise InputError(f"'most', {most:g}, is not above 'least', {least:g}", field="most")
    if isinstance(law, UniformDistribution):
        return uniform(least=least, most=most)
    if isinstance(law, TriangularDistribution):
        mode = number(law.mode, "mode")
        if not least <= mode <= most:
            raise InputError(f"the mode {mode:g} is not between {least:g} and {most:g}", field="mode")
        return triangular(least=least, mode=mode, most=most)
    if isinstance(law, NormalDistribution):
        mean, deviation = number(law.mean, "mean"), _difference(law.deviation, number, unit)
        _check_left((least - mean) / deviation, (most - mean) / deviation)
        return normal(mean=mean, deviation=deviation, least=least, most=most)
    return _lognormal(law, number(law.median, "median"), least, most)


def _lognormal(law: LognormalDistribution, median: float, least: float, most: float) -> Quantile:
    if not median > 0.0:
        raise InputError(f"the median of a lognormal distribution is above 0, not {median:g}", field="median")
    if not most > 0.0:
        raise InputError("a lognormal distribution has no values below 0", field="most")
    with np.errstate(divide="ignore"):
        low, high = np.log(np.array([max(least, 0.0), most]) / median) / law.log_deviation
    _check_left(float(low), float(high))
    return lognormal(median=median, log_deviation=law.log_deviation, least=max(least, 0.0), most=most)


def _difference(value: float | str, number: Callable[[float | str, str], float], unit: str | None) -> float:
    """A standard deviation in SI."""
    if unit == "K" and isinstance(value, str) and "K" not in value:
        raise InputError(
            f"'{value}' is a temperature, not a difference of two", field="deviation", hint="e.g. '2 K'"
        )
    deviation = number(value, "deviation")
    if not deviation > 0.0:
        raise InputError(f"the deviation is above 0, not {deviation:g}", field="deviation")
    return deviation


def _check_left(low: float, high: float) -> None:
    """Raise InputError if truncation leaves next to nothing of a normal distribution."""
    from scipy.special import ndtr

    left = ndtr(-low) - ndtr(-high) if low > 0.0 else ndtr(high) - ndtr(low)
    if left < _LEAST_SHARE:
        raise InputError(
            f"only {left:.2g} of the distribution lies between 'least' and 'most'",
            field="least" if low > 0.0 else "most",
            hint="move the bounds, or state a uniform distribution",
        )


def _check_method(variable: Variable, method: str) -> None:
    """Raise InputError for a quantity that the method cannot vary."""
    if method in ("grid", "list") and variable.values is None:
        what = "a distribution" if variable.tolerance else "a range without points"
        raise InputError(
            f"a {method} needs values, and {variable.path} has {what}",
            field="distribution" if variable.tolerance else "points",
            hint='"values": [...], or "from", "to" and "points"',
        )
    if method in _RANDOM and variable.quantile is None:
        raise InputError(
            f"{method} needs a range or a distribution of {variable.path}, not values",
            field="values",
            hint='e.g. "from": "8 kg", "to": "12 kg"',
        )
    if method == "optimisation" and variable.bounds is None:
        raise InputError(
            f"an optimisation needs a range of {variable.path}",
            field="distribution" if variable.tolerance else "values",
            hint='e.g. "from": "8 kg", "to": "12 kg"',
        )
    if method == "robust" and not variable.tolerance and variable.values is None:
        raise InputError(
            f"the range of {variable.path} has no number of points", field="points", hint='e.g. "points": 5'
        )


def plan_of(
    document: StudyDocument,
    variables: tuple[Variable, ...],
    figures: tuple[Figure, ...],
    most_runs: int = MOST_RUNS,
) -> plans.Plan:
    """The runs of a study.

    Raises:
        InputError: more runs than allowed, lists of different length, no tolerance in a robust study.
    """
    method = document.method
    sizes = [len(variable.values) for variable in variables if variable.values is not None]
    if method.type == "list" and len(set(sizes)) > 1:
        raise InputError(
            f"the lists have {' and '.join(map(str, sizes))} values", field="quantities",
            hint="as many in each, or the method grid",
        )  # fmt: skip
    if method.type == "robust" and not any(variable.tolerance for variable in variables):
        raise InputError(
            "a robust study needs a quantity with a distribution", field="quantities",
            hint='e.g. "distribution": {"type": "normal", "mean": 1, "deviation": 0.05}, "relative": true',
        )  # fmt: skip
    count = len(variables)
    runs = {
        "grid": lambda: prod(sizes),
        "list": lambda: sizes[0],
        "sobol": lambda: getattr(method, "samples", 0) * (count + 2),
        "morris": lambda: getattr(method, "trajectories", 0) * (count + 1),
        "optimisation": lambda: getattr(method, "population", 0) * getattr(method, "generations", 0),
        "robust": lambda: (
            getattr(method, "runs", 0)
            * prod(len(v.values) for v in variables if v.values is not None and not v.tolerance)
        ),
    }.get(method.type, lambda: getattr(method, "runs", 0))()
    if runs > most_runs:
        raise InputError(
            f"the study would make {runs} runs, at most {most_runs} are allowed here", field="method",
            hint="fewer values, points or samples",
        )  # fmt: skip
    match method.type:
        case "grid":
            return plans.grid(variables)
        case "list":
            return plans.listed(variables)
        case "latin_hypercube":
            return plans.latin_hypercube(variables, method.runs, method.seed)
        case "monte_carlo":
            return plans.monte_carlo(variables, method.runs, method.seed)
        case "sobol":
            return sobol_plan(variables, method.samples, method.seed)
        case "morris":
            return morris_plan(variables, method.trajectories, method.levels, method.seed)
        case "robust":
            return plans.robust(variables, method.runs, method.seed)
        case "optimisation":
            return OptimisationPlan(
                variables,
                figures,
                goals_of(document),
                limits_of(document, figures),
                method.population,
                method.generations,
                method.seed,
            )


def goals_of(document: StudyDocument) -> tuple[FigureGoal, ...]:
    """The goals of a study."""
    return tuple(FigureGoal(goal.figure, goal.direction == "maximise") for goal in document.goals)


def limits_of(document: StudyDocument, figures: Sequence[Figure]) -> tuple[FigureLimit, ...]:
    """The limits of a study in SI.

    Raises:
        InputError: a value with a wrong unit, or limits that nothing can keep.
    """
    units = {figure.path: figure.unit for figure in figures}
    found = []
    for place, limit in enumerate(document.limits):
        ends = []
        for name, value, default in (
            ("at_least", limit.at_least, -inf),
            ("at_most", limit.at_most, inf),
        ):
            with fields_inside(f"limits.{place}.{name}"):
                ends.append(default if value is None else si(value, units[limit.figure]))
        if ends[0] > ends[1]:
            raise InputError(
                f"nothing is at least {ends[0]:g} and at most {ends[1]:g}", field=f"limits.{place}.at_most"
            )
        found.append(FigureLimit(limit.figure, *ends))
    return tuple(found)
