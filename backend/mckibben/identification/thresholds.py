"""Every threshold of the diagnosis that decides what is said, with its meaning.

What each is worth is examined by `python -m tests.benchmarks.sensitivity --thresholds`, which varies them by
20 %. Numerical limits, such as the steps of a fit, stand where they are used.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Score:
    """When a model with more numbers is better."""

    least_score: float = 8.0
    """Least reduction of the score: between "strong" (6) and "very strong" (10) evidence on the scale of Kass
    & Raftery (1995).
    """
    least_gain: float = 0.02
    """Least relative reduction of the rms error by an additional number."""
    least_gain_at_floor: float = 0.05
    """The same where the error has reached the noise: the rest may only be the inexact form of a correct
    effect.
    """
    at_floor: float = 1.15
    """Error over the noise, which is itself an estimate, up to which it has reached the noise."""
    below_floor: float = 0.5
    """Smallest error of a fold that counts, share of the noise; less is chance."""


@dataclass(frozen=True)
class Search:
    """How far a search looks."""

    beam: int = 4
    """Models kept in each round."""
    first: int = 6
    """The same while nothing has proved better than the start: the half of a pair may look poor."""
    tried: int = 8
    """Candidates fitted for each model: those with the largest first-order gain."""
    flexible: int = 2
    """Effects tried in exchange for the sake of their further constants."""
    patience: int = 2
    """Rounds without a better model after which the search stops; one where predictions are costly."""
    alike: float = 0.02
    """Share of the mean square; models whose residuals differ by less are merged."""
    exactly: float = 1e-4
    """The same where effects that differ but little may lead on to different ones."""
    deepest: int = 7
    """Most effects added."""
    nothing_left: float = 1.05
    """Error over the noise below which the search stops."""
    rang: float = 0.7
    """Error over that of the start model below which a single effect shows less noise."""
    within: float = 1.15
    """Error over the best error above which a model is dropped near the noise."""
    far: float = 1.5
    """Error over the noise above which two steps are tried at once."""
    of_two: float = 0.75
    """Largest share of the mean square that two steps may leave; less gain may follow an unknown effect."""


@dataclass(frozen=True)
class Pairs:
    """Which two steps at once are worth fitting."""

    fitted: int = 12
    """Most pairs fitted."""
    together: float = 1.5
    """Least gain of a pair over that of its better step."""
    least: float = 0.05
    """Least gain of a step that counts for that, share of the sum of squares."""


@dataclass(frozen=True)
class Twins:
    """What data cannot tell apart."""

    same: float = 0.5
    """Difference of fitted predictions over the noise up to which they are the same: an inexact form of a
    correct effect causes differences of this size.
    """
    imitated: float = 0.25
    """The same for an effect that can act as another one: it imitates it closely, with further constants."""
    cosine: float = 0.99
    """Cosine between sensitivities above which they count as parallel."""
    as_good: float = 1.05
    """Error of an exchange with parallel sensitivity over that of the best model, at most."""
    halves: int = 4
    """Effects tried as the first of two in the place of one."""
    seconds: int = 2
    """Second ones tried beside each of them."""
    near: float = 1.5
    """Error over that of the best model of an exchange whose own law may bring it there."""
    tried: int = 8
    """Exchanges that are fitted for each effect in any case."""
    promise: float = 0.3
    """First-order gain, as a share of the largest one, from which further ones are fitted."""
    undecided: float = 9.0
    """Difference of -2 log likelihood below which two models are equally likely: three standard
    deviations.
    """


@dataclass(frozen=True)
class Ends:
    """Models that fit alike are chosen by the ends of the data."""

    share: float = 0.15
    """Share of the rows at each end of an input."""
    most: float = 0.5
    """Share of the rows above which an end is none."""
    alike: float = 1.03
    """Ratio of errors up to which models fit alike."""
    least: float = 0.10
    """Decrease of the mean logarithm of the squares at the ends that counts."""


@dataclass(frozen=True)
class Usual:
    """When a constant that data hardly tell has its usual value."""

    told: float = 4.0
    """Difference of scores, two standard deviations, from which data tell a constant."""
    alike: float = 1.001
    """Ratio of errors up to which they do not: many rows seem to tell more than a form that is not quite
    right can.
    """


@dataclass(frozen=True)
class Entries:
    """When an entry is doubted."""

    searched: int = 2
    """Entries with a search of their own."""
    singles: int = 6
    """Effects that each entry is fitted with alone."""
    least_gain: float = 0.1
    """Least relative reduction of the error by an entry."""
    least_change: float = 0.01
    """Least relative change of a quantity; less is the accuracy of a ruler."""
    certain: float = 0.98
    """Largest confidence: the models themselves are not exact."""
    as_much: float = 2.0
    """Score that chance decides: an entry that is worse by less explains as much."""
    as_good: float = 1.05
    """Error over that of the best model up to which an entry explains the data as well."""
    within_reach: float = 2.0
    """The same up to which a search may find the laws that the effects lack beside the entry."""
    much: float = 0.5
    """Share of the excess over the noise that an entry above the noise must explain."""


@dataclass(frozen=True)
class Judged:
    """When what is left is a structure."""

    ratio: float = 16.0
    """Twice the gain in log likelihood from which a surface is more than correlated noise; of 170 files with
    noise of eleven kinds the largest had 9.
    """
    gain: float = 0.1
    """Lower end of the gain on left-out groups from which a surface says something of them."""
    lasting: float = 0.5
    """Rows over which noise is alike, over those of a sweep, from which what is missing may look so."""
    in_step: float = 5.0
    """Rows over which a swing stays in step, over those of the longest line, from which it is one."""
    line_share: float = 0.2
    """Least share of the variance that a swing explains."""
    few_mean: float = 5.0
    """Error over the noise from which rows too few for a surface show a structure, and from which what is
    left is far above the scatter of neighbours.
    """
    few_median: float = 2.0
    """Median error over the noise from which they do."""
    pushed: float = 4.0
    """Standard deviations of the noise below zero from which a force is no pull."""
    turning: float = 5.0
    """Error over the noise from which a row at a reversal is off."""
    turned: int = 2
    """Rows at reversals that are off, from which they are no accident."""
    rounds: int = 3
    """Rounds in which rows are set aside."""


@dataclass(frozen=True)
class Probability:
    """What is called missing."""

    likely: float = 0.3
    """Probability below which an effect is not called missing. One that is called missing by mistake costs
    less than one that is overlooked, because the next experiment shows it.
    """
    even: float = 0.5
    """Probability below which an effect is missing only perhaps: it is less likely than not."""
    unknown: float = 0.1
    """Probability before any data that something acts which no effect of the catalogue describes."""
    read: float = 0.99
    """Probability of an effect that is read from the data, without a fit that could mistake it for another
    one.
    """


@dataclass(frozen=True)
class Gauge:
    """When a pressure sensor shows its zero error while the muscle is vented."""

    least: float = 5e3
    """Pa below zero; less may be noise or a change of the barometric pressure."""
    plateau: float = 3e3
    """Pa; readings within this distance of the lowest form the plateau."""
    rows: int = 4
    """Fewest rows of a plateau."""


@dataclass(frozen=True)
class Repetition:
    """When a rest is said to repeat."""

    false_alarm: float = 1e-4
    """Chance of noise, over all periods tried, below which a repetition is named."""
    share: float = 0.2
    """Least share of the rest."""
    periods: float = 3.0
    """Fewest periods in the range."""
    holds: float = 0.5
    """Least share on the half that was left out, over that on all rows."""
    slower: float = 0.5
    """Share over that of the found period above which a period twice as long or longer is a smooth course."""
    first: float = 1.0
    """Cycles from which slower courses are looked at."""
    far: float = 0.6
    """Share of the found cycles up to which they are."""
    driven: float = 0.75
    """Share of the power of what drives the test, in time."""
    faster: float = 10.0
    """How much faster than that a repetition in time has to be: multiples of what drives it are no hum."""
    moves: float = 1e-2
    """Change of a quantity within a record, over its range; less is none."""
    parts: int = 3
    """Parts of the range that each must show it."""
    everywhere: float = 0.2
    """Least share in each of them, over that on all rows."""
    shown: float = 2.0 / 3.0
    """Least share of the records, or sweeps, that the others predict."""
    turns: float = 0.05
    """Way back, over the range, from which the motion has turned."""
    likelier: float = 4.0
    """Difference of log likelihoods from which a thread is distinguished from what rings after each turn."""
    alike: float = 0.9
    """Share over the best one, from which data do not tell the coordinates apart."""


@dataclass(frozen=True)
class Rows:
    """When a row does not fit."""

    share: float = 0.05
    """Share of rows that may be anything, before any is seen."""
    per_row: float = 1.0
    """Log evidence that each row set aside has to gain: e times likelier than with it."""
    beyond_noise: float = 8.0
    """Log likelihood of the others, with noise that may be correlated, that it has to gain: a row that is
    four standard deviations off.
    """
    surface_pays: float = 3.0
    """Log evidence from which a surface is there: 20 times likelier than none."""
    fewest: int = 8
    """Rows below which nothing can be said."""
    chance: float = 0.05
    """Probability that rows anywhere lie at any of the places, below which the place tells."""
    grows: float = 3.0
    """Standard errors of its slope from which the noise grows with the reading."""
    steepest: float = 1.0
    """Largest slope: noise in proportion to the reading."""
    beside: int = 3
    """Rows from a row that does not fit to the next one, up to which both are in a row."""
    many_levels: float = 0.5
    """Levels over rows, above which a variable has no places that rows share."""


@dataclass(frozen=True)
class FreeSurface:
    """What a free surface may be and when it tells something."""

    fewest: int = 20
    """Rows below which a surface says nothing: 17 rows of a joint gave no gain whatever was hidden."""
    fewest_groups: int = 3
    """Groups with rows inside the range of the others, below which the gain has no interval."""
    fewest_of_a_way: int = 4
    """Rows of either direction of motion, from which its sign is a variable."""
    matters: float = 0.02
    """Share of the surface below which a channel is not named."""
    per_number: int = 2
    """Rows for each number of a model without physics, at least."""


@dataclass(frozen=True)
class Noise:
    """How the noise is estimated."""

    fewest: int = 30
    """Third differences; with fewer, near neighbours give the better estimate."""
    same: float = 1.25
    """Largest ratio of the estimates from 16 and from 8 neighbours."""


@dataclass(frozen=True)
class ProposedTerm:
    """When a formula is proposed."""

    terms: int = 3
    """Most terms of a short proposal."""
    smooth_terms: int = 9
    """Most terms of a smooth description."""
    smooth: float = 0.8
    """Its largest error over that without it."""
    halved: float = 0.5
    """Largest error of a short one over that without it, on the folds left out."""
    worth: float = 0.1
    """Least share by which a further term lowers the mean square of the folds left out."""
    simpler: float = 0.02
    """Share of the mean square by which a form of lower order may be worse."""


@dataclass(frozen=True)
class Told:
    """What is said."""

    refitted: float = 0.98
    """Error over the error before, below which the refit of the start model is mentioned."""
    worth_telling: float = 0.15
    """Share of the residual that depends on variables, above which it is mentioned."""
    different: float = 2.0
    """Error on a left-out specimen over that on left-out groups, above which the specimens differ."""
    most: float = 0.5
    """Share of the rest that repeats, from which the variables that it depends on are not named."""
    mostly_white: float = 0.8
    """Share of white noise from which the rest is not described."""
    swings: float = 0.5
    """Periods over which noise stays in step, from which it swings."""


SCORE = Score()
SEARCH = Search()
PAIRS = Pairs()
TWINS = Twins()
ENDS = Ends()
USUAL = Usual()
ENTRIES = Entries()
JUDGED = Judged()
PROBABILITY = Probability()
GAUGE = Gauge()
REPETITION = Repetition()
ROWS = Rows()
SURFACE = FreeSurface()
NOISE = Noise()
TERM = ProposedTerm()
WORDS = Told()
