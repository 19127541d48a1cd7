"""Statements about a measurement that may be wrong: sizes, load, supply, units, signs and zeros of channels.

Each is a hypothesis with an id. A stated quantity is fitted within a plausible range, together with the
effects; a channel is read in another way. What lies within the error of a sensor (an offset, a scale) is an
effect of the catalogue and not listed here.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mckibben.identification.predict.fit_model import LOAD, SUPPLY, FitModel, Free
from mckibben.identification.predict.predictor import Predictor
from mckibben.measurement.measurement import REFERENCE, STROKES, Measurement
from mckibben.measurement.rescaled import rescaled
from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.physics.muscle import HIGHEST_PRESSURE, NEUTRAL_ANGLE
from mckibben.physics.units import GRAVITY, STANDARD_ATMOSPHERE

#: Standard atmosphere [Pa]: what a gauge reading and an absolute reading differ by.
_PSI, _POUND, _INCH = 6894.757, 4.4482216, 25.4
# Plausible sizes: pressure [Pa], force [N], stroke over the nominal length, duration [s].
_PRESSURES, _FORCES, _STROKES, _DURATIONS = (2e4, HIGHEST_PRESSURE), (1.0, 2e4), (0.005, 0.5), (0.02, 1e5)
_ANGLE = np.radians(10.0)
_SUPPLIES, _WALLS = (0.4, 2.5), (0.08, 12.5)  # over the stated value
# A priori odds of a mistake against none, and of the rarer ones.
_USUAL, _RARE = 0.2, 0.1


@dataclass(frozen=True)
class OtherReading:
    """Another way of reading a channel: true value = factor * reading + offset."""

    channel: str
    factor: float
    offset: float
    words: str


@dataclass(frozen=True)
class StatedEntry:
    """A statement that may be wrong.

    Attributes:
        hypothesis: id, as in ``--use`` and ``--keep``.
        field: what it is about: a field of the muscle or a channel.
        title: in words, with "the".
        stated: the stated value [SI]; None for a way of reading.
        unit: SI unit of a quantity.
        free: the quantity with its plausible range; None for a way of reading.
        reading: the other way of reading; None for a quantity.
        prior: odds of the mistake against none.
        vouched: whether more than the user's entry stands behind it: words of the file, such as "N" or
            "gauge", or the catalogue that the muscle is from.
    """

    hypothesis: str
    field: str
    title: str
    stated: float | None
    unit: str
    free: Free | None
    reading: OtherReading | None
    prior: float
    vouched: bool = False

    def value(self, number: float) -> float:
        """The value of a quantity [SI] from the number of the fit."""
        stated = self.stated or 0.0
        if self.free is not None and self.free.name == LOAD:
            return stated + number
        return stated * number if self.free is not None and self.free.name == SUPPLY else number


@dataclass(frozen=True)
class Statements:
    """What is stated about a measurement, and what of it may be wrong.

    Attributes:
        entries: the statements that may be wrong.
        predictor: the data with some channels read in other ways.
        readings: accepted ways of reading.
        kept: hypotheses that the user has ruled out; they are still examined and told, but never asked about.
    """

    entries: tuple[StatedEntry, ...]
    predictor: Callable[[Sequence[OtherReading]], Predictor]
    readings: tuple[OtherReading, ...] = ()
    kept: frozenset[str] = frozenset()

    def read(self, reading: OtherReading) -> Predictor:
        """The data with one channel read in another way.

        Raises:
            InputError: the changed data cannot be compared.
        """
        return self.predictor((*self.readings, reading))

    def using(self, hypotheses: Iterable[str]) -> tuple[Statements, tuple[StatedEntry, ...]]:
        """The statements after accepting some hypotheses, and the accepted entries.

        Channels are read in the accepted ways; accepted quantities are for the fit and no longer doubted.

        Raises:
            InputError: there is no such hypothesis for these data, it is ruled out, or two are about the same
                statement.
        """
        accepted = tuple(self._entry(hypothesis, "use") for hypothesis in dict.fromkeys(hypotheses))
        readings = tuple(entry.reading for entry in accepted if entry.reading is not None)
        settled: dict[str, str] = {}
        for entry in accepted:
            other = settled.setdefault(entry.field, entry.hypothesis)
            if other != entry.hypothesis:
                raise InputError(
                    f"'{other}' and '{entry.hypothesis}' are both about {entry.title}",
                    field="use",
                    hint="use one of them",
                )
            if entry.hypothesis in self.kept:
                raise InputError(
                    f"'{entry.hypothesis}' is both used and kept", field="use", hint="choose one"
                )
        left = tuple(entry for entry in self.entries if entry.field not in settled)
        return replace(self, readings=(*self.readings, *readings), entries=left), accepted

    def keeping(self, hypotheses: Iterable[str]) -> Statements:
        """The statements with some hypotheses ruled out.

        Raises:
            InputError: there is no such hypothesis for these data.
        """
        kept = frozenset(self._entry(hypothesis, "keep").hypothesis for hypothesis in hypotheses)
        return replace(self, kept=self.kept | kept)

    def _entry(self, hypothesis: str, field: str) -> StatedEntry:
        for entry in self.entries:
            if entry.hypothesis == hypothesis:
                return entry
        known = [entry.hypothesis for entry in self.entries]
        raise InputError(
            f"'{hypothesis[:60]}' is not a doubtful statement of these data",
            field=field,
            hint=did_you_mean(hypothesis, known),
        )


def read_otherwise(measurement: Measurement, readings: Iterable[OtherReading]) -> Measurement:
    """A measurement with some channels read in other ways.

    Raises:
        InputError: the channels fit the measurement's kind no longer.
    """
    for reading in readings:
        measurement = rescaled(measurement, reading.channel, factor=reading.factor, offset=reading.offset)
    return measurement


def statements(
    measurement: Measurement,
    fit_model: FitModel,
    predictor: Callable[[Sequence[OtherReading]], Predictor],
    *,
    supply: float | None = None,
    elastic: Iterable[Effect] = (),
    catalogued: Collection[str] = (),
) -> Statements:
    """Everything stated about a measurement that may be wrong.

    Args:
        measurement: the data; of several files all together.
        fit_model: the start model, with the stated muscle.
        predictor: the data with some channels read in other ways.
        supply: stated supply pressure of a drive whose command was measured [Pa].
        elastic: effects whose force is in proportion to the wall, where that is stated.
        catalogued: fields of the muscle that are those of a catalogue.
    """
    entries = (
        *_quantities(measurement, fit_model),
        *_of_supply(measurement, supply),
        *_of_wall(fit_model, elastic),
        *_readings(measurement, fit_model),
    )
    fields = {f"muscle.{name}" for name in catalogued}
    return Statements(
        tuple(replace(entry, vouched=entry.vouched or entry.field in fields) for entry in entries), predictor
    )


def _quantities(measurement: Measurement, fit_model: FitModel) -> Iterator[StatedEntry]:
    muscle = fit_model.muscle
    rest, diameter, angle = muscle.nominal_length, muscle.braid_diameter, muscle.braid_angle
    yield _quantity(
        "rest_length", "nominal_length", "the rest length", rest, 0.6 * rest, 1.7 * rest, "m", _USUAL
    )
    yield _quantity(
        "braid_diameter",
        "braid_diameter",
        "the braid diameter",
        diameter,
        0.6 * diameter,
        1.7 * diameter,
        "m",
        _RARE,
    )
    steepest = min(angle + _ANGLE, 0.95 * NEUTRAL_ANGLE)
    flattest = max(angle - _ANGLE, np.radians(8.0))
    yield _quantity("braid_angle", "braid_angle", "the braid angle", angle, flattest, steepest, "rad", _RARE)
    if measurement.kind == "isotonic" and "force" not in measurement.columns:
        force = float(measurement.conditions.get("load_force") or 0.0)
        force += float(measurement.conditions.get("load_mass") or 0.0) * GRAVITY
        if force > 0.0:
            more = Free(LOAD, 0.0, -0.8 * force, 4.0 * force, "N", off=0.0, usual=0.1 * force)
            yield StatedEntry("load", "load", "the load", force, "N", more, None, _USUAL)


def _of_supply(measurement: Measurement, supply: float | None) -> Iterator[StatedEntry]:
    if supply is None or not supply > 0.0 or "command" not in measurement.columns:
        return
    low, high = _SUPPLIES
    free = Free(SUPPLY, 1.0, low, high, "1", off=1.0, usual=0.05)
    yield StatedEntry("supply", "supply", "the supply pressure", supply, "Pa", free, None, _USUAL)


def _of_wall(fit_model: FitModel, elastic: Iterable[Effect]) -> Iterator[StatedEntry]:
    """A stated wall: only its product with a modulus shows, so moduli keep their values beside it."""
    wall = fit_model.muscle.wall_thickness
    effects = [effect for effect in elastic if "wall_thickness" in effect.needs]
    if not wall or "wall_thickness" in fit_model.assumed or not effects:
        return
    moduli = {f"{effect.id}.{p.name}" for effect in effects for p in effect.parameters if p.unit == "Pa"}
    high = min(_WALLS[1] * wall, 0.25 * fit_model.muscle.braid_diameter)
    entry = _quantity(
        "wall_thickness", "wall_thickness", "the wall thickness", wall, _WALLS[0] * wall, high, "m", _RARE
    )
    assert entry.free is not None  # noqa: S101 - it is a quantity
    yield replace(entry, free=replace(entry.free, fixes=frozenset(moduli)))


def _quantity(
    hypothesis: str, name: str, title: str, value: float, low: float, high: float, unit: str, prior: float
) -> StatedEntry:
    field = f"muscle.{name}"
    free = Free(name, value, low, high, unit, off=value, usual=0.05 * abs(value))
    return StatedEntry(hypothesis, field, title, value, unit, free, None, prior)


def _readings(measurement: Measurement, fit_model: FitModel) -> Iterator[StatedEntry]:
    columns, in_words = measurement.columns, measurement.in_words
    rest = fit_model.muscle.nominal_length
    if "pressure" in columns:
        for hypothesis, factor, offset, words, prior in (
            ("absolute_pressure", 1.0, -STANDARD_ATMOSPHERE, "absolute", _USUAL),
            ("gauge_pressure", 1.0, STANDARD_ATMOSPHERE, "gauge", _RARE),
            ("pressure_in_psi", _PSI / 1e5, 0.0, "in psi", _RARE),
            ("pressure_in_bar_not_psi", 1e5 / _PSI, 0.0, "in bar and not in psi", _RARE),
            ("pressure_in_MPa", 10.0, 0.0, "in MPa", _RARE),
            ("pressure_in_bar_not_MPa", 0.1, 0.0, "in bar and not in MPa", _RARE),
            ("pressure_in_kPa", 0.01, 0.0, "in kPa", _RARE),
            ("pressure_in_bar_not_kPa", 100.0, 0.0, "in bar and not in kPa", _RARE),
            ("pressure_in_mbar", 1e-3, 0.0, "in mbar", _RARE),
        ):
            true = factor * columns["pressure"] + offset
            lowest = -0.2e5 if offset else -0.5e5
            if float(np.min(true)) > lowest and _within(float(np.max(true)), _PRESSURES):
                said = (REFERENCE if offset else "pressure") in in_words
                yield _reading(hypothesis, "pressure", "the pressure", factor, offset, words, prior, said)
    if "force" in columns:
        largest = float(np.max(columns["force"])), float(-np.min(columns["force"]))
        for hypothesis, factor, words in (
            ("force_in_kgf", GRAVITY, "in kgf"),
            ("force_in_N_not_kgf", 1.0 / GRAVITY, "in N and not in kgf"),
            ("force_in_lbf", _POUND, "in lbf"),
            ("force_in_N_not_lbf", 1.0 / _POUND, "in N and not in lbf"),
            ("force_in_kN", 1e3, "in kN"),
            ("force_in_N_not_kN", 1e-3, "in N and not in kN"),
            ("force_sign", -1.0, "with tension negative"),
        ):
            # Without a force below zero there is nothing that a sign could explain, and the other way round.
            if factor < 0.0 and largest[1] < largest[0]:
                continue
            size = largest[1] if factor < 0.0 else largest[0]
            if _within(abs(factor) * size, _FORCES):
                said = factor > 0.0 and "force" in in_words
                yield _reading(hypothesis, "force", "the force", factor, 0.0, words, _RARE, said)
    stroke = next((columns[name] for name in STROKES if name in columns), None)
    if stroke is not None:
        share = "contraction" in columns and "length" not in columns
        size = float(np.ptp(stroke)) if share else float(np.ptp(stroke)) / rest
        for hypothesis, factor, words in (
            ("stroke_in_inch", _INCH, "in inch and not in mm"),
            ("stroke_in_mm_not_inch", 1.0 / _INCH, "in mm and not in inch"),
            ("stroke_in_cm", 10.0, "in cm and not in mm"),
            ("stroke_in_mm_not_cm", 0.1, "in mm and not in cm"),
            ("stroke_in_percent", 0.01, "in percent"),
            ("stroke_not_in_percent", 100.0, "not in percent"),
            ("stroke_sign", -1.0, "with the other sign: positive = longer"),
        ):
            if share != ("percent" in hypothesis) and factor > 0.0:
                continue
            if factor < 0.0 and "length" in columns:
                continue
            if _within(abs(factor) * size, _STROKES):
                said = factor > 0.0 and any(name in in_words for name in STROKES)
                yield _reading(hypothesis, "stroke", "the displacement", factor, 0.0, words, _RARE, said)
    if "time" in columns and measurement.kind == "transient":
        lasting = float(np.ptp(columns["time"]))
        for hypothesis, factor, words in (
            ("time_in_ms", 1e-3, "in ms"),
            ("time_in_s_not_ms", 1e3, "in s and not in ms"),
            ("time_in_min", 60.0, "in minutes"),
        ):
            if _within(factor * lasting, _DURATIONS):
                said = "time" in in_words
                yield _reading(hypothesis, "time", "the time", factor, 0.0, words, _RARE, said)


def _reading(
    hypothesis: str, channel: str, title: str, factor: float, offset: float, words: str, prior: float,
    said: bool,
) -> StatedEntry:  # fmt: skip
    reading = OtherReading(channel, factor, offset, words)
    return StatedEntry(hypothesis, channel, title, None, "", None, reading, prior, vouched=said)


def _within(value: float, limits: tuple[float, float]) -> bool:
    return limits[0] <= value <= limits[1]


def predicted_scale(predictor: Predictor, reading: OtherReading | None) -> float:
    """Factor between a predicted channel read in the other way and as stated.

    Errors of the two are compared after division by it.
    """
    if reading is None or len(predictor.channels) != 1:
        return 1.0
    names: Mapping[str, tuple[str, ...]] = {"force": ("force",), "stroke": ("length", "displacement")}
    (channel,) = predictor.channels
    return abs(reading.factor) if channel.name in names.get(reading.channel, ()) else 1.0
