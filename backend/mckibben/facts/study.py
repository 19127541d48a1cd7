"""What studies watch in their runs, and what they say of all runs together."""

from __future__ import annotations

from dataclasses import replace

from mckibben.facts.figure import Condition, Figure, Group
from mckibben.facts.run import RUN, TRACKING
from mckibben.facts.sizing import SIZING
from mckibben.facts.timing import PHASES, TIMING

_ROWS = Condition("the run has rows", "the run has no rows")
_PROPOSAL = Condition("a drive fulfils the task", "no drive fulfils the task")
_HAVE = Condition("a run has the figure", "no run has this figure")
_TWO = Condition("two or more runs have the figure", "fewer than two runs have this figure")
_VARIES = Condition("quantity and figure vary", "the quantity or the figure does not vary")
_BLOCKS = Condition("enough blocks of runs are complete", "too few complete blocks of runs")
_RANDOM = Condition("the runs are random", "the runs are not random")

#: Columns whose extremes and last values can be watched, and the words for these.
COLUMNS = ("position", "velocity", "acceleration", "pressure", "force")
PICKS = {"largest": "Largest", "smallest": "Smallest", "last": "Last"}
#: Figures of the first proposal that can be watched.
BEST = (
    "nominal_length", "parallel", "pressure", "time", "time_down", "contraction", "force_reserve",
    "needed_pressure", "air_volume_anr", "impact_energy", "impact_energy_stroke", "impact_energy_return",
    "end_speed", "max_speed", "peak_force", "stiffness", "installed_length", "outer_diameter", "life",
    "probability",
)  # fmt: skip


def _of_timing(phase: str, words: str) -> list[Figure]:
    section = f"Timing, {words}"
    return [
        replace(each, name=f"timing.{phase}.{each.name}", label=f"{each.label}, {words}", section=section)
        for each in TIMING.values()
    ]


def _of_column(pick: str, words: str, column: Figure) -> Figure:
    return replace(
        column,
        name=f"{pick}.{column.name}",
        label=f"{words} {column.label.lower()}",
        definition=f"{words} signed value of the whole run. {column.definition}",
        exists_when=_ROWS,
        section=words,
    )


#: Path in a study -> watched figure of a run of a drive, or of a task.
WATCHED = Group(
    "study",
    "Watched figures",
    *(figure for phase, words in PHASES.items() for figure in _of_timing(phase, words)),
    *(replace(each, name=each.key, section=TRACKING.title) for each in TRACKING.values()),
    *(_of_column(pick, words, RUN[name]) for pick, words in PICKS.items() for name in COLUMNS),
    *(
        replace(SIZING[name], name=f"best.{name}", exists_when=_PROPOSAL, section="First proposal")
        for name in BEST
    ),
    Figure(
        "proposals", "", "1", "Number of proposals",
        "Drives that fulfil the task, at most as many as it asks for.",
    ),
)  # fmt: skip

#: A watched figure over all runs; values are in its unit.
SUMMARY = Group(
    "summary",
    "Figure over all runs",
    Figure("count", "n", "1", "Runs with the figure", "Runs that completed and have the figure."),
    Figure("missing", "", "1", "Runs without it", "Runs that failed, or that lack the figure."),
    Figure(
        "mean", "x̄", "", "Mean",
        "Mean of the runs that have the figure; of independent runs with the interval x̄ ± t s/√n.", _HAVE,
    ),
    Figure(
        "deviation", "s", "", "Standard deviation",
        "√(Σ(x − x̄)²/(n − 1)); of independent runs with its interval by χ².", _TWO,
    ),
    Figure("least", "", "", "Smallest", "Smallest value of the runs that have the figure.", _HAVE),
    Figure("most", "", "", "Largest", "Largest value of the runs that have the figure.", _HAVE),
    Figure(
        "percentiles", "x_p", "", "Percentiles",
        "By linear interpolation; of independent runs with an interval from the order of the values, for "
        "any distribution.", _HAVE,
    ),
)  # fmt: skip

#: Influence of a quantity on a watched figure.
INFLUENCE = Group(
    "influence",
    "Influence of a quantity",
    Figure(
        "rank_correlation", "ρ_s", "1", "Rank correlation",
        "Spearman's correlation of quantity and figure: −1 to 1, 0 for no monotonic influence.",
        _VARIES, "number",
    ),
    Figure(
        "first", "S_1", "1", "Alone",
        "Sobol: share of the variance of the figure due to the quantity alone.", _BLOCKS, "number"
    ),
    Figure(
        "first_error", "", "1", "± alone",
        "Half the confidence interval of that share.", _BLOCKS, "number",
    ),
    Figure(
        "total", "S_T", "1", "With all interactions",
        "Sobol: share of the variance of the figure due to the quantity with all its interactions.",
        _BLOCKS, "number",
    ),
    Figure(
        "total_error", "", "1", "± with interactions",
        "Half the confidence interval of that share.", _BLOCKS, "number",
    ),
    Figure(
        "mean_size", "μ*", "", "Mean size of the effects",
        "Morris: mean magnitude of the changes of the figure over the range of the quantity, of a "
        "distribution from its quantile 0.5/levels to 1 − 0.5/levels.", _BLOCKS,
    ),
    Figure(
        "mean_size_error", "", "", "± mean size",
        "Half the confidence interval of the mean size.", _BLOCKS,
    ),
    Figure("mean", "μ", "", "Mean effect", "Morris: mean of the same changes with their signs.", _BLOCKS),
    Figure(
        "deviation", "σ", "", "Deviation of the effects",
        "Morris: standard deviation of the same changes; large where the influence is not linear or "
        "depends on other quantities.", _BLOCKS,
    ),
)  # fmt: skip

#: A study as a whole.
STUDY = Group(
    "studied",
    "Study",
    Figure("runs", "", "1", "Runs", "Runs that were made."),
    Figure("planned", "", "1", "Planned runs", "Runs of the plan."),
    Figure("kept", "", "1", "Runs made before", "Runs of a study that was interrupted or asked before."),
    Figure(
        "probability", "p", "1", "Probability of keeping the limits",
        "Share of all runs that keep the limits, one without the figure counts as not keeping them; of "
        "independent runs with the interval of Clopper and Pearson.", quantity="ratio",
    ),
    Figure(
        "confidence", "", "1", "Confidence of the intervals",
        "Share of such studies whose interval holds the true value; an interval around a mean or an "
        "influence is written with ±, as half its width.", quantity="ratio",
    ),
    Figure("seed", "", "1", "Seed", "Seed of the random numbers.", _RANDOM, "number"),
    Figure(
        "front", "", "", "Pareto front",
        "Runs that keep the limits and of which no other is at least as good in every goal and better in "
        "one; of one goal the best run.",
    ),
)  # fmt: skip
