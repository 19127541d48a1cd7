"""Summary of a profile likelihood."""

from __future__ import annotations

from mckibben.identification.fit.profile import Profile
from mckibben.report.summary import Summary, Table, figure


def summary_of(result: Profile) -> Summary:
    """The values tried, and the interval in one sentence."""
    rows = [
        [figure(value), figure(lost), figure(error)]
        for value, lost, error in zip(result.value, result.deviance, result.rmse, strict=True)
    ]
    unit = "" if result.unit == "1" else f" {result.unit}"
    head = [f"{result.name} [{result.unit}]", "deviance", "error"]
    return [Table(f"Profile of {result.name}", head, rows), sentence_of(result, unit)]


def sentence_of(result: Profile, unit: str) -> str:
    """The interval, or on which side the data do not bound the constant."""
    share = f"{100.0 * result.share:g} %"
    curvature = "" if result.stderr is None else f" (by the curvature ± {figure(result.stderr)}{unit})"
    best = f"{result.name} is {figure(result.best)}{unit}{curvature}"
    if result.low is None and result.high is None:
        return f"{best}; these data do not bound it within its plausible range"
    if result.low is None or result.high is None:
        end, other = ("at most", result.high) if result.low is None else ("at least", result.low)
        return f"{best}; with {share} {end} {figure(other)}{unit}, and not bounded on the other side"
    return f"{best}; with {share} between {figure(result.low)} and {figure(result.high)}{unit}"
