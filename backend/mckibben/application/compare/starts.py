"""The fitted starts of runs in words."""

from __future__ import annotations

from mckibben.identification.fit.least_squares import FitResult
from mckibben.identification.predict.fit_model import START_SPEED, START_STROKE, is_start


def start_messages(fit: FitResult | None) -> list[str]:
    """Where each run begins by a fit, with standard errors; none where no start was fitted."""
    found: dict[str, dict[str, str]] = {}
    for parameter in fit.parameters if fit is not None else ():
        if not is_start(parameter.name):
            continue
        begin = START_STROKE if parameter.name.startswith(START_STROKE) else START_SPEED
        error = "" if parameter.stderr is None else f" ± {1e3 * parameter.stderr:.2g}"
        limit = " (at its limit)" if parameter.at_bound else ""
        unit = "mm" if begin == START_STROKE else "mm/s"
        run = parameter.name.removeprefix(begin).removeprefix("_")
        value = f"{1e3 * parameter.value:+.3g}".replace("-", "\N{MINUS SIGN}")
        found.setdefault(run, {})[begin] = f"{value}{error} {unit}{limit}"
    return [
        f"start of {f'run {run}' if run else 'the run'}, fitted: stroke {each.get(START_STROKE, '0 mm')} "
        f"beyond its first reading, speed {each.get(START_SPEED, '0 mm/s')}"
        for run, each in found.items()
    ]
