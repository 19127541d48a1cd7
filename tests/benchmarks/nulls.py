"""Nothing is missing, but the noise is a laboratory's: how often a diagnosis still says "adequate".

    python -m tests.benchmarks.nulls [--seeds 0,1,2]

The noise of the null cases of `tests.truth` is replaced: spikes, noise that grows with the force, correlated
noise, noise of the inputs, coarse digits, outlying groups of rows.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import replace
from types import MappingProxyType
from typing import Any

import numpy as np

from tests.benchmarks.diagnosis import say
from tests.benchmarks.entries import parts_of
from tests.benchmarks.workers import in_parallel, own_studio
from tests.truth.generate import case

BASES = (
    "nothing-isobaric", "nothing-known-wall-isometric", "nothing-thread-form-map", "nothing-isotonic",
)  # fmt: skip


def _white(random: np.random.Generator, clean: np.ndarray, sigma: float) -> np.ndarray:
    return sigma * random.standard_normal(len(clean))


def _spikes(random: np.random.Generator, clean: np.ndarray, sigma: float) -> np.ndarray:
    hit = random.random(len(clean)) < 0.02
    return _white(random, clean, sigma) + np.where(
        hit, 15.0 * sigma * random.standard_normal(len(clean)), 0.0
    )


def _students(random: np.random.Generator, clean: np.ndarray, sigma: float) -> np.ndarray:
    return sigma * random.standard_t(3, len(clean)) / np.sqrt(3.0)


def _growing(random: np.random.Generator, clean: np.ndarray, sigma: float) -> np.ndarray:
    share = np.abs(clean) / np.max(np.abs(clean))
    return sigma * (0.2 + 3.0 * share) * random.standard_normal(len(clean))


def _correlated(random: np.random.Generator, clean: np.ndarray, sigma: float) -> np.ndarray:
    noise, last = np.empty(len(clean)), 0.0
    for row, new in enumerate(random.standard_normal(len(clean))):
        last = 0.85 * last + np.sqrt(1.0 - 0.85**2) * new
        noise[row] = sigma * last
    return noise


def _coarse(random: np.random.Generator, clean: np.ndarray, sigma: float) -> np.ndarray:
    step = 4.0 * sigma
    return np.round((clean + 0.3 * _white(random, clean, sigma)) / step) * step - clean


NOISES: dict[str, Callable[[np.random.Generator, np.ndarray, float], np.ndarray]] = {
    "white": _white,
    "spikes": _spikes,
    "heavy tails": _students,
    "grows with force": _growing,
    "correlated": _correlated,
    "coarse digits": _coarse,
}
INPUTS = {"pressure noise": ("pressure", 1500.0), "length noise": ("stroke", 5e-5)}


def judged(given: tuple[str, str, int]) -> tuple[str, str, int, str, str]:
    """Status and names for one base, noise and seed."""
    from mckibben.identification.diagnose.diagnosis import diagnose
    from mckibben.identification.diagnose.entries import read_otherwise, statements
    from mckibben.identification.predict import predictor_of

    base, noise, seed = given
    made = case(base, seed)
    predictor, start, measurement, _, _ = parts_of(made, own_studio())
    random = np.random.default_rng([seed, sum(map(ord, base + noise))])
    (channel,) = predictor.channels
    name = channel.name
    if name == "length":
        name = next(n for n in ("length", "contraction", "displacement") if n in measurement.columns)
    clean, sigma = next(iter(made.clean.values())), next(iter(made.noise.values()))
    columns: dict[str, Any] = dict(measurement.columns)
    read = columns[name]
    unit = 1.0
    if channel.name == "length" and name != "length":
        unit = -1.0 if name == "displacement" else -1.0 / start.muscle.nominal_length
    if len(clean) != len(read):
        return base, noise, seed, "skipped", f"{len(clean)} of {len(read)} rows"
    drawn = NOISES.get(noise, _white)(random, clean, sigma)
    true_read = read - unit * (next(iter(made.measured.values())) - clean)
    columns[name] = true_read + unit * drawn
    if noise in INPUTS:
        what, size = INPUTS[noise]
        names = (
            [n for n in ("length", "contraction", "displacement") if n in columns]
            if what == "stroke"
            else [what]
        )
        for each in names:
            scale = 1.0 / start.muscle.nominal_length if each == "contraction" else 1.0
            columns[each] = columns[each] + scale * size * random.standard_normal(len(read))
    changed = replace(measurement, columns=MappingProxyType(columns))

    def again(readings: Any) -> Any:
        return predictor_of(read_otherwise(changed, readings), start.muscle)

    try:
        result = diagnose(
            again(()),
            start,
            catalogue=own_studio().catalogue,
            statements=statements(changed, start, again, elastic=own_studio().catalogue.values()),
        )
    except Exception as error:
        return base, noise, seed, "problem", f"{type(error).__name__}: {error}"[:90]
    doubted = [each.entry.hypothesis for each in result.context if each.stands]
    floor = float("nan") if result.noise is None else result.best.rmse / result.noise
    text = (
        f"{floor:.2f} x noise, structure {result.structure.share:.2f} {', '.join((*result.added, *doubted))}"
    )
    return base, noise, seed, result.status, text


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter)
    parser.add_argument("--seeds", default="0")
    parser.add_argument("--only", default="")
    given = parser.parse_args()
    seeds = [int(seed) for seed in given.seeds.split(",")]
    todo = [(b, n, s) for s in seeds for b in BASES for n in (*NOISES, *INPUTS) if given.only in f"{b} {n}"]
    results = []
    for line in in_parallel(judged, todo):
        results.append(line)
        mark = "ok" if line[3] in ("adequate", "skipped") else "--"
        say(f"{mark} {line[0]:30}{line[1]:18}{line[2]}  {line[3]:16}{line[4]}")
    lines = [line for line in results if line[3] != "skipped"]
    for words, part in (
        ("white noise (wanted 3 %)", [line for line in lines if line[1] == "white"]),
        ("other noise (wanted 10 %)", [line for line in lines if line[1] != "white"]),
        ("all", lines),
    ):
        wrong = sum(line[3] != "adequate" for line in part)
        if part:
            share, bound = wrong / len(part), upper_bound(wrong, len(part))
            say(f"{words}: not adequate {wrong} of {len(part)}, {share:.1%}, upper 95 % bound {bound:.1%}")


def upper_bound(wrong: int, of: int) -> float:
    """Upper end of the one-sided 95 % interval of a share, after Clopper and Pearson."""
    from scipy.stats import beta

    return 1.0 if wrong == of else float(beta.ppf(0.95, wrong + 1, of - wrong))


if __name__ == "__main__":
    main()
