"""Joints: torque over angle of muscles on a pulley, a cam, or between two points with levers in the file.

Length and lever are written here once more, by coordinates and by an integral of their own; what is hidden
has a form that no effect of the catalogue has.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import pi

import numpy as np

from tests.truth.bench import rms
from tests.truth.cases import Case, file_name
from tests.truth.composition import Hidden, Record, Truth
from tests.truth.experiments import RecordBuilder, _run
from tests.truth.muscle import Array, Muscle

BAR = 1e5
FOUR = (2.0 * BAR, 3.2 * BAR, 4.4 * BAR, 6.0 * BAR)
COUNTERS = (4.0 * BAR, 2.5 * BAR, 3.4 * BAR, 1.5 * BAR)  # of the second muscle of a pair, by the swing
NONE: frozenset[str] = frozenset()


@dataclass(frozen=True)
class Path:
    """Length [m] and lever -dL/d angle [m] over the angle [rad], and how a user states them.

    Attributes:
        said: conditions of the file; empty where it has columns of lever and length.
    """

    length: Callable[[Array], Array]
    lever: Callable[[Array], Array]
    said: dict[str, str]


@dataclass(frozen=True)
class Turned:
    """What is hidden in a joint.

    Attributes:
        accepted: right answers.
        angle: zero error of the angle [rad].
        lever: factor of the true lever over the stated one.
        rub: torque of the bearing against the motion [N m], of the speed of the joint [rad/s].
        weight: torque to smaller angles [N m], of the angle.
        name: what it is.
    """

    accepted: frozenset[str] = NONE
    angle: float = 0.0
    lever: float = 1.0
    rub: Callable[[Array], Array] = np.zeros_like
    weight: Callable[[Array], Array] = np.zeros_like
    name: str = ""


def pulley(muscle: Muscle, radius: float, contraction: float) -> Path:
    begin = muscle.nominal * (1.0 - contraction)
    said = {"lever": f"{radius * 1e3:.6g} mm", "contraction_at_zero": f"{contraction * 100:.6g} %"}
    return Path(lambda a: begin - radius * a, lambda a: np.full_like(a, radius), said)


def cam(muscle: Muscle, radius: float, share: float, contraction: float) -> Path:
    """An eccentric pulley, r = R (1 + s sin a), its integral R (a + s (1 - cos a))."""
    begin = muscle.nominal * (1.0 - contraction)
    said = {
        "lever": f"{radius!r}*(1 + {share!r}*sin(angle))",
        "contraction_at_zero": f"{contraction * 100:.6g} %",
    }
    return Path(
        lambda a: begin - radius * (a + share * (1.0 - np.cos(a))),
        lambda a: radius * (1.0 + share * np.sin(a)),
        said,
    )


def strut(muscle: Muscle, radius: float) -> Path:
    """Between a point of the frame and one of the link; the file has lever and length in each row."""
    ox, oy = 0.012, muscle.nominal + 0.03

    def ends(a: Array) -> tuple[Array, Array]:
        return radius * np.cos(a) - ox, -radius * np.sin(a) - oy

    cord = float(np.hypot(*ends(np.array(0.9)))) - muscle.nominal * 0.995

    def lever(a: Array) -> Array:
        x, y = ends(a)
        px, py = radius * np.cos(a), -radius * np.sin(a)
        return np.abs(px * y - py * x) / np.hypot(x, y)

    return Path(lambda a: np.hypot(*ends(-a)) - cord, lambda a: lever(-a), {})


def _swings(
    path: Path, muscle: Muscle, truth: Truth, low: float, high: float, rows: int
) -> tuple[Record, Array]:
    """Slow swings at held pressures; the record of the muscle, and the true angle of each fine row."""
    builder, angles = RecordBuilder(), []
    for level in FOUR:
        reach = high
        for angle in np.linspace(low, high, 60):
            if 1.0 - float(path.length(np.array(angle))) / muscle.nominal > truth.longest_contraction(level):
                reach = min(reach, float(angle))
        corners = [low, reach, low]
        step, angle = _run(corners, 0.12, rows)
        begin = len(np.concatenate(builder.columns["time"])) if builder.columns["time"] else 0
        builder.pause(level, float(path.length(angle[:1])[0]))
        added = len(np.concatenate(builder.columns["time"])) - begin
        angles.append(np.full(added, angle[0]))
        builder.add(step, np.full(len(angle), level), path.length(angle), kept=True)
        angles.append(angle)
        builder.loops += 1
    return builder.record(), np.concatenate(angles)


def _torque(
    truth: Truth, record: Record, path: Path, angle: Array, turned: Turned, counter: Array | None = None
) -> Array:
    """Torque that the muscles give at the joint, less what is lost there [N m].

    A second muscle of the pressure ``counter`` has the mirrored path and pulls the other way.
    """

    def pull(pressure: Array, at: Array) -> Array:
        seen = replace(record, pressure=pressure, length=_true_length(path, at, turned))
        force = truth.force(seen.pressure, seen.length, seen.temperature) + truth.memory(seen)
        return turned.lever * path.lever(at) * np.maximum(force, 0.0)

    speed = np.gradient(angle, record.time)
    total = pull(record.pressure, angle) - turned.rub(speed) - turned.weight(angle)
    return total if counter is None else total - pull(counter, -angle)


def _true_length(path: Path, angle: Array, turned: Turned) -> Array:
    begin = path.length(np.zeros(1))
    return begin + turned.lever * (path.length(angle) - begin) if path.said else path.length(angle)


def jointed(
    name: str, seed: int, muscle: Muscle, path: Path, rng: np.random.Generator, *,
    turned: Turned = Turned(), hidden: tuple[Hidden, ...] = (), low: float = 0.02, high: float = 0.9,
    rows: int = 90, timed: bool = True, pair: bool = False,
) -> Case:  # fmt: skip
    truth = Truth(muscle, hidden=hidden)
    record, angle = _swings(path, muscle, truth, low, high, rows)
    keep = record.kept
    counter = np.array(COUNTERS)[record.group] if pair else None
    clean = _torque(truth, record, path, angle, turned, counter)
    full = float(np.max(np.abs(clean[keep])))
    level = float(rng.uniform(1e-3, 2e-3)) * full
    pressure = record.pressure[keep]
    written = angle[keep] + turned.angle
    shown = {"time": record.time, "pressure": record.pressure, "force": np.zeros_like(record.time)}
    for part in hidden:
        shown = part.reading(dict(shown)) if part.reading else shown
    pressure_read = shown["pressure"][keep] + rng.normal(0.0, 2e2, len(pressure))
    others = {"pressure": counter, "time": record.time, "force": np.zeros_like(record.time)}
    for part in hidden if pair else ():
        others = part.reading(dict(others)) if part.reading else others
    torque = clean[keep] + rng.normal(0.0, level, len(pressure))
    # The noise of the pressure goes through the muscle; what is left is that of the torque.
    raised = _torque(truth, replace(record, pressure=record.pressure + 100.0), path, angle, turned, counter)
    slope = (raised - clean)[keep] / 100.0
    moved = slope * (pressure_read - shown["pressure"][keep])
    noise = rms(torque - clean[keep] - moved)
    ratios = []
    if turned.accepted:
        ratios.append(_ratio(truth, record, path, angle, turned, written, keep, noise, counter))
    for index, part in enumerate(hidden):
        other = truth.without(index)
        seen = part.reading(dict(shown)) if part.reading else {"pressure": record.pressure}
        against = (
            part.reading({**others, "pressure": counter})["pressure"] if pair and part.reading else counter
        )
        lacking = _torque(other, replace(record, pressure=seen["pressure"]), path, angle, turned, against)
        ratios.append(rms((clean - lacking)[keep]) / noise)
    lines = [f"# {key}: {value}" for key, value in path.said.items()]
    lines.append(f"# rest length: {muscle.nominal * 1e3:.6g} mm")
    columns = {
        "Pressure [bar]": pressure_read * 1e-5,
        "Angle [deg]": np.degrees(written),
        "Torque [N*m]": torque,
    }
    if pair:
        columns["Pressure 2 [bar]"] = others["pressure"][keep] * 1e-5
    if timed:
        columns = {"Time [s]": record.time[keep], **columns}
    if not path.said:
        columns |= {
            "Moment arm [mm]": 1e3 * path.lever(angle[keep]),
            "Muscle length [mm]": 1e3 * path.length(angle[keep]),
        }
    if not timed:
        order = rng.permutation(len(torque))
        columns = {head: values[order] for head, values in columns.items()}
        clean_rows, torque = (clean[keep] + moved)[order], torque[order]
    else:
        clean_rows = clean[keep] + moved
    lines.append(",".join(columns))
    lines += [",".join(f"{value:.9g}" for value in row) for row in zip(*columns.values(), strict=True)]
    text = "\n".join(lines) + "\n"
    answers = [*([turned.accepted] if turned.accepted else []), *(part.accepted for part in hidden)]
    return Case(
        name=name,
        kind="static" if pair else "isobaric",
        hidden=tuple(answers),
        unknown=None,
        muscle=muscle.document(),
        drive=None,
        effects={},
        files={file_name(text): text},
        noise={"torque": noise},
        seed=seed,
        truths=(*([turned.name] if turned.accepted else []), *(part.name for part in hidden)),
        ratios=tuple(ratios),
        rows=len(torque),
        clean={"torque": clean_rows},
        measured={"torque": torque},
        held=None,
    )


def _ratio(
    truth: Truth, record: Record, path: Path, angle: Array, turned: Turned, written: Array, keep: Array,
    noise: float, counter: Array | None,
) -> float:  # fmt: skip
    """What the joint hides over the noise: against a joint that is as it is written."""
    plain = np.interp(record.time, record.time[keep], written)
    as_written = _torque(truth, record, path, plain, Turned(), counter)
    return rms((_torque(truth, record, path, angle, turned, counter) - as_written)[keep]) / noise


def rubbing(torque: float, rise: float) -> Callable[[Array], Array]:
    """A journal that rubs more when it is slow: M (1 + rise / (1 + (w/w0)^2)), its sign a smooth one."""
    return lambda w: torque * (1.0 + rise / (1.0 + (w / 0.2) ** 2)) * np.tanh(w / 0.004)


def hanging(moment: float, level: float, second: float) -> Callable[[Array], Array]:
    """A bent link: two masses, the second one a right angle ahead."""
    return lambda a: moment * (np.cos(a - level) + second * np.cos(a - level - pi / 2.0))
