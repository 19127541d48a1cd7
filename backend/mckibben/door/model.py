"""A model: a muscle with the physical effects that act on it."""

# pyright: strict, reportMissingTypeStubs=false

from __future__ import annotations

import warnings
from collections.abc import Callable, Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self

import numpy as np

from mckibben.application.compare.compare import compared_whole
from mckibben.application.curves.curves import DEFAULT_PRESSURES, CurvesQuestion, curves, pressures_of
from mckibben.application.curves.inverse import answer, question_of_document
from mckibben.application.diagnose.diagnose import prepare
from mckibben.application.model.saved import fitted_model, keep, model_text, saved_model
from mckibben.application.muscle_summary import GeometrySummary, geometry_of, start_notices
from mckibben.application.operating_limits import pressure_notices
from mckibben.application.text_file import check_ending, write_text
from mckibben.documents.inverse import read_inverse
from mckibben.documents.saved_model import SavedModel
from mckibben.documents.start_model import StartModel
from mckibben.documents.studio import Studio
from mckibben.door.comparison import Comparison
from mckibben.door.curves import Curves
from mckibben.door.diagnosis import Diagnosis
from mckibben.door.exported import Exportable, model_to_export
from mckibben.door.inverse import Inverse
from mckibben.door.problem import reported
from mckibben.door.questions import Data, DocumentedDrive, StatedModel, question_of, watch_of
from mckibben.door.rendering import notebook_cell, plain_text
from mckibben.door.values import FloatArray, Quantities, Quantity, array_of, number_of
from mckibben.door.workspace import studio
from mckibben.export.subject import Stated
from mckibben.physics.errors import InputError, did_you_mean
from mckibben.report.summary import Summary, Table, figure

if TYPE_CHECKING:
    from plotly.graph_objects import Figure


_SHORTEST = 0.05  # shortest length accepted, share of the nominal length; no muscle contracts so far
_HIGHEST = 1e8  # Pa


class Model(Exportable):
    """A muscle with its effects; SI inside, arguments are SI numbers or texts with a unit.

    Tension of the ideal muscle: F = (π D0² p / 4) (a (1 - κ)² - b), a = 3 / tan² α, b = 1 / sin² α, with the
    braid diameter D0 at the braid angle α, gauge pressure p and contraction κ = 1 - L/L0. Each effect changes
    it as `mckibben.effects` tells. Models do not change; `with_effect` and the like make another one.

    Args:
        preset: id of a muscle preset, whose values the other arguments replace.
        nominal_length: length between the fittings at rest, "300 mm".
        inside_diameter, braid_diameter: bore, and diameter of the braid at the braid angle; without the
            latter the bore is taken.
        braid_angle: between thread and axis at rest, "25 deg".
        wall_thickness: of the bladder at rest.
        thread_length, turns: of one thread, instead of diameter and angle.
        rhombus: the lattice, ``{"side": "2 mm", "along": 60, "around": 20}``, instead of these.
        effects: effect id -> parameters; None for those of the preset, or none for a muscle by geometry.

    Raises:
        Problem: a geometry that is missing, impossible or stated twice, an unknown preset, effect or unit.
    """

    __slots__ = ("__weakref__", "_stated", "_studio")

    _stated: StatedModel
    _studio: Studio

    @reported
    def __init__(
        self,
        *,
        preset: str | None = None,
        nominal_length: Quantity | None = None,
        inside_diameter: Quantity | None = None,
        braid_diameter: Quantity | None = None,
        braid_angle: Quantity | None = None,
        wall_thickness: Quantity | None = None,
        thread_length: Quantity | None = None,
        turns: float | None = None,
        rhombus: Mapping[str, Quantity] | None = None,
        effects: Mapping[str, Mapping[str, Quantity]] | None = None,
    ) -> None:
        stated: dict[str, object] = {
            "preset": preset,
            "nominal_length": nominal_length,
            "inside_diameter": inside_diameter,
            "braid_diameter": braid_diameter,
            "braid_angle": braid_angle,
            "wall_thickness": wall_thickness,
            "thread_length": thread_length,
            "turns": turns,
            "rhombus": None if rhombus is None else dict(rhombus),
        }
        muscle = {name: value for name, value in stated.items() if value is not None}
        self._make(StatedModel(muscle, None if effects is None else _copied(effects)), studio())

    def _make(self, stated: StatedModel, of: Studio) -> None:
        self._set(_stated=stated, _studio=of)
        stated.sample(of)

    @classmethod
    def of(cls, stated: StatedModel, of: Studio) -> Self:
        """The model of documents, for the rest of the door."""
        model = cls.__new__(cls)
        model._make(stated, of)
        return model

    @classmethod
    @reported
    def preset(
        cls,
        id: str,
        *,
        length: Quantity | None = None,
        effects: Mapping[str, Mapping[str, Quantity]] | None = None,
    ) -> Model:
        """The model of a muscle preset, "DMSP-20".

        Args:
            id: of the preset; `mckibben.presets` lists them.
            length: nominal length; None = that of the preset, where data state none.
            effects: instead of those of the preset.

        Raises:
            Problem: an unknown preset (with the nearest match), a length that cannot be.
        """
        muscle: dict[str, object] = {"preset": id}
        if length is not None:
            muscle["nominal_length"] = length
        return cls.of(StatedModel(muscle, None if effects is None else _copied(effects)), studio())

    @property
    def geometry(self) -> GeometrySummary:
        """Dimensions at rest, SI."""
        return geometry_of(self._sample)

    @property
    def effects(self) -> Mapping[str, Mapping[str, float]]:
        """Effect id -> parameter -> value, SI; all parameters."""
        return {name: dict(values) for name, values in self._sample.effects.items()}

    @property
    def document(self) -> dict[str, Any]:
        """The model as the JSON document that `save` writes."""
        return self._saved().to_document()

    @property
    def has_preset_effects(self) -> bool:
        """Whether its effects are those of its preset, untouched."""
        return self._stated.effects is None

    @property
    def is_saved(self) -> bool:
        """Whether it was fitted to measurements, or loaded from a saved model."""
        return self._stated.saved is not None

    @property
    def _sample(self) -> StartModel:
        return self._stated.sample(self._studio)

    @reported
    def with_effect(self, effect: str, /, **parameters: Quantity) -> Model:
        """The same muscle with one more effect, or with other parameters of an effect that it has.

        Args:
            effect: id; `mckibben.effects` lists them. "custom" takes ``term="-c*sign(v)*P"`` and its
                constants.
            parameters: SI numbers or texts with a unit; the others keep their values or take their defaults.

        Raises:
            Problem: an unknown effect or parameter (with the nearest match), a value outside its bounds.
        """
        effects = self._effect_documents()
        effects[effect] = {**effects.get(effect, {}), **parameters}
        return self._with_effects(effects)

    @reported
    def without(self, *effects: str) -> Model:
        """The same muscle without these effects.

        Raises:
            Problem: the model does not have one of them.
        """
        known = self._effect_documents()
        for effect in effects:
            if effect not in known:
                hint = did_you_mean(effect, known) or "the model has no effects"
                raise InputError(f"the model has no effect '{effect}'", hint=hint)
            del known[effect]
        return self._with_effects(known)

    @reported
    def ideal(self) -> Model:
        """The same muscle without any effect."""
        return self._with_effects({})

    @reported
    def with_geometry(self, **dimensions: Quantity) -> Model:
        """The same model with other dimensions: ``nominal_length``, ``braid_angle`` and the like.

        Raises:
            Problem: an unknown or impossible dimension.
        """
        return Model.of(self._stated.changed(muscle={**self._stated.muscle, **dimensions}), studio())

    def _effect_documents(self) -> dict[str, dict[str, float | str]]:
        sample = self._sample
        stated = self._stated.effects or {}
        return {name: {**values, **stated.get(name, {})} for name, values in sample.effects.items()}

    def _with_effects(self, effects: dict[str, dict[str, float | str]]) -> Model:
        return Model.of(self._stated.changed(effects=effects), studio())

    @reported
    def force(
        self,
        *,
        pressure: Quantities,
        contraction: Quantities | None = None,
        length: Quantities | None = None,
        direction: Quantities = 0.0,
        unclipped: bool = False,
    ) -> FloatArray:
        """Tension [N] at pressures and lengths, which broadcast as numpy arrays do.

        Args:
            pressure: gauge pressure [Pa] or texts.
            contraction: 1 - L/L0; or
            length: [m].
            direction: sign of dL/dt, for friction: -1 shortening, 1 lengthening, 0 the mean.
            unclipped: False = a slack muscle has no tension; True = what it would push.

        Returns:
            The tension, with the shape of the arguments together.

        Raises:
            Problem: a value without a unit that fits, a length that no muscle has, shapes that do not fit.

        >>> muscle = Model(inside_diameter="20 mm", braid_angle="25 deg", nominal_length="300 mm")
        >>> muscle.force(pressure="6 bar", contraction=["0 %", "10 %"]).round(1).tolist()
        [1545.3, 1051.1]
        """
        return _force_of(
            self._stated.start(self._studio), self._studio, pressure=pressure, contraction=contraction,
            length=length, direction=direction, unclipped=unclipped,
        )  # fmt: skip

    @reported
    def curves(
        self,
        pressure: str | Sequence[Quantity] | FloatArray | None = None,
        *,
        points: int = 200,
        contraction_from: Quantity | None = None,
        contraction_to: Quantity | None = None,
        load: Quantity | None = None,
        fixed_length: Quantity | None = None,
        unclipped: bool = False,
        further_stiffness: bool = False,
        at_pressure: Quantity | None = None,
        at_contraction: Quantity | None = None,
    ) -> Curves:
        """Force, stiffness, volume and diameter over the contraction.

        Args:
            pressure: gauge pressures, "1 bar, 6 bar" or a list; None = 1 to 6 bar.
            points: number of lengths.
            contraction_from, contraction_to: the range; None = from the pretension limit to the last end.
            load: constant load, for operating points [N].
            fixed_length: where the force is shown over the pressure [m].
            unclipped: whether to show what a slack muscle would push.
            further_stiffness: whether to answer the stiffness that the force implies and the secant too.
            at_pressure: gauge pressure at which `lift` says what the muscle does with the load [Pa].
            at_contraction: the contraction whose pressure `lift` holds too.

        Raises:
            Problem: a pressure or range that cannot be used, a muscle without a length.
        """
        question = CurvesQuestion(
            self._stated.start(self._studio),
            DEFAULT_PRESSURES if pressure is None else _pressures_in(pressure),
            _at_least_two(points),
            unclipped,
            _optional_number(contraction_from, "1", "contraction_from"),
            _optional_number(contraction_to, "1", "contraction_to"),
            _optional_number(load, "N", "load"),
            _optional_number(fixed_length, "m", "fixed_length"),
            further_stiffness=further_stiffness,
            at_pressure=_optional_number(at_pressure, "Pa", "at_pressure"),
            at_contraction=_optional_number(at_contraction, "1", "at_contraction"),
        )
        return Curves.of(curves(question, self._studio), _name=self.name)

    @reported
    def inverse(
        self,
        question: str,
        *,
        force: Quantity | None = None,
        length: Quantity | None = None,
        contraction: Quantity | None = None,
        pressure: Quantity | None = None,
        load: Quantity | None = None,
        preload: Quantity | None = None,
        stroke: Quantity | None = None,
        direction: int | None = None,
        temperature: Quantity | None = None,
    ) -> Inverse:
        """Which pressure, contraction or stroke belongs to a force; `value` is the answer.

        Args:
            question: "pressure" (of ``force`` at ``length`` or ``contraction``), "contraction" (of ``force``
                at ``pressure``), "working_range" (from ``preload`` without pressure to ``load`` at
                ``pressure``) or "stroke_pressure" (that lifts ``load`` by ``stroke``).
            force: of the muscle [N].
            length, contraction: where it acts.
            pressure: gauge pressure [Pa].
            load, preload: at the end and at the start of the stroke [N].
            stroke: from the rest length [m].
            direction: sign of dL/dt, for friction: -1 shortening, 1 lengthening, 0 none.
            temperature: of the muscle [K].

        Raises:
            Problem: an unknown question, a quantity that is missing, not asked for or impossible.
        """
        stated = {
            "question": question, "force": force, "length": length, "contraction": contraction,
            "pressure": pressure, "load": load, "preload": preload, "stroke": stroke, "direction": direction,
            "temperature": temperature,
        }  # fmt: skip
        document = read_inverse(stated)
        start = self._stated.start(self._studio)
        found = answer(question_of_document(document, start), self._studio)

        def at(pressures: list[float]) -> Curves:
            return self.curves(pressures or None)

        return Inverse.of(found, _name=self.name, _curves=at)

    def plot(self, pressure: str | Sequence[Quantity] | FloatArray | None = None) -> Figure:
        """Force over contraction at some pressures; a Plotly figure."""
        return self.curves(pressure).plot()

    @reported
    def compare(
        self,
        data: Data,
        *,
        fit: bool = False,
        free: str | Sequence[str] = (),
        use: str | Sequence[str] = (),
        keep: str | Sequence[str] = (),
        drive: DocumentedDrive | None = None,
        validate: Data = (),
        strict: bool = False,
        ties: Mapping[str, str] | None = None,
    ) -> Comparison[Model]:
        """The error of this model on measurements, with or without a fit.

        Args:
            data: a measurement, the path of a file, or a list; several are several specimens.
            fit: fit the parameters of the effects.
            free: geometry, constants as "effect.parameter", or "start" (stroke and speed at the start of runs
                under a measured pressure; found without ``fit`` too), to be fitted as well.
            use, keep: entries that are wrong, or right, as stated: an answer to ``doubts`` of a diagnosis.
            drive: a `mckibben.Drive`: valve, tube, supply and load of a transient measurement.
            validate: measurements to check the model on, which it is not fitted to; see ``validation``.
            strict: refuse instead of assuming what nobody states.
            ties: fitted constants that always have the value of another one,
                ``{"valve_delay.closing_time": "valve_delay.opening_time"}``.

        Raises:
            Problem: names the file or argument, what is wrong and what would be right.
        """
        question, names = question_of(
            self._stated, self._studio, data, free=free, use=use, keep=keep,
            drive=None if drive is None else drive.parsed, strict=strict, refit=fit, validate=validate,
        )  # fmt: skip
        compared = compared_whole(question, fit=fit, ties=ties)
        model = self
        if compared.comparison.fit is not None:
            saved = fitted_model(question, compared, self._studio)
            model = Model.of(StatedModel.of_saved(saved, "the fitted model"), self._studio)
        return Comparison[Model].of(compared.result, model=model, _compared=compared.comparison, _name=names)

    @reported
    def diagnose(
        self,
        data: Data,
        *,
        free: str | Sequence[str] = (),
        noise: float | str | None = None,
        use: str | Sequence[str] = (),
        keep: str | Sequence[str] = (),
        drive: DocumentedDrive | None = None,
        validate: Data = (),
        strict: bool = False,
        progress: Callable[[float], object] | None = None,
    ) -> Diagnosis[Model]:
        """Which physical effect this model of the measurements is missing.

        Args:
            data, free, use, keep, drive, validate, strict: as in `compare`.
            noise: standard deviation of the predicted channel where it is known, "2 N"; a number is SI.
            progress: called with the share that is done, 0 to 1, a few times a second.

        Raises:
            Problem: names the file or argument, what is wrong and what would be right.
        """
        question, names = question_of(
            self._stated, self._studio, data, free=free, use=use, keep=keep,
            drive=None if drive is None else drive.parsed, strict=strict, noise=noise, validate=validate,
        )  # fmt: skip
        result = prepare(question, self._studio)(watch_of(progress))
        saved = saved_model(question, result, self._studio)
        model = Model.of(StatedModel.of_saved(saved, "the diagnosed model"), self._studio)

        def again() -> Comparison[Model]:
            return model.compare(data, fit=True, use=use, keep=keep, drive=drive, strict=strict)

        return Diagnosis[Model].of(
            result, model=model, _question=question, _studio=self._studio, _name=names, _again=again
        )

    @reported
    def save(self, path: str | PathLike[str]) -> None:
        """Write the model as JSON, for `mckibben.load` and the option ``--model`` of the command line.

        Raises:
            Problem: the file cannot be written, or its ending is not .json.
        """
        check_ending(Path(path), (".json",))
        write_text(Path(path), model_text(self._saved()))

    @reported
    def keep(self, id: str, *, title: str = "") -> Self:
        """Save the model as a muscle of your own, for `Model.preset`, sizing tasks, command line and page.

        A model of `diagnose`, or of `compare` with a fit, keeps how sure its values are and where it was
        measured: its curves and runs have intervals, and say where they leave that range.

        Args:
            id: of the preset, letters, digits and hyphens; one of your own with this id is replaced.
            title: its name for display; "" = the id.

        Returns:
            The model of the new preset.

        Raises:
            Problem: an id that cannot be used or belongs to the program, a model with a typed term.
        """
        of = studio()
        return self.of(StatedModel({"preset": keep(self._saved(), of, id=id, title=title).id}), of)

    def _to_export(self) -> tuple[Stated, Studio]:
        return model_to_export(self._stated, self._studio, self.name)

    def _saved(self) -> SavedModel:
        return self._stated.to_saved(self._studio)

    @property
    def name(self) -> str:
        """Preset and length, "DMSP-20, 300 mm", or what is known of the geometry."""
        return self._stated.named(self._studio)

    def _summary(self) -> Summary:
        return _summary_of(self._sample, self.name, with_length=self._stated.has_length(self._studio))

    def __str__(self) -> str:
        return plain_text(self._summary())

    def __repr__(self) -> str:
        effects = ", ".join(self._sample.effects) or "ideal"
        return f"<Model {self.name}: {effects}>"

    def _repr_html_(self) -> str:
        return notebook_cell(f"Model {self.name}", (), self._summary())

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Model) and self.document == other.document

    def __hash__(self) -> int:
        return hash(model_text(self._saved()))


def _copied(effects: Mapping[str, Mapping[str, float | str]]) -> dict[str, dict[str, float | str]]:
    return {str(name): dict(values) for name, values in effects.items()}


def _summary_of(start: StartModel, name: str, *, with_length: bool) -> Summary:
    """Dimensions and effects.

    Args:
        start: the model.
        name: for the title.
        with_length: whether it has a length of its own.
    """
    muscle = start.muscle
    rows = [
        [
            "rest length",
            figure(muscle.nominal_length * 1e3, unit=" mm") if with_length else "that of the data",
        ],
        ["braid diameter", figure(muscle.braid_diameter * 1e3, unit=" mm")],
        ["braid angle", figure(muscle.braid_angle * 57.29577951308232, unit=" deg")],
        ["inside diameter", figure(muscle.inside_diameter * 1e3, unit=" mm")],
        ["wall thickness", figure(muscle.wall_thickness * 1e3, unit=" mm") if muscle.wall_thickness else "–"],
    ]
    parameters = [
        [f"{effect}.{p.name}", f"{values[p.name]:.5g}", p.unit]
        for effect, values in start.effects.items()
        for p in start.catalogue[effect].parameters
    ]
    summary: Summary = [Table(name, ["", ""], rows)]
    if start.term is not None:
        summary.append(f"term: {start.term}")
    if parameters:
        summary.append(Table("Effects", ["parameter", "value", "unit"], parameters))
    elif start.effects:
        summary.append(f"effects: {', '.join(start.effects)}")
    else:
        summary.append("ideal: no effects")
    return [*summary, *(notice.message for notice in start_notices(start))]


@reported
def load(path: str | PathLike[str]) -> Model:
    """The model in a JSON file.

    It may be what `Model.save` or ``mckibben diagnose --save`` wrote, a muscle by its geometry, a muscle
    preset, or a drive document, of which muscle and effects are taken.

    Raises:
        Problem: names the file, the field, what is wrong and what would be right.
    """
    of = studio()
    return Model.of(StatedModel.of_file(Path(fspath(path)), of), of)


def model_of_document(document: Mapping[str, object], of: Studio) -> Model:
    """The model of muscle and effects of a drive document."""
    return Model.of(StatedModel.of_parts(document, "", of), of)


def _force_of(
    start: StartModel,
    studio: Studio,
    *,
    pressure: Quantities,
    contraction: Quantities | None,
    length: Quantities | None,
    direction: Quantities,
    unclipped: bool,
) -> FloatArray:
    """Tension [N]; arguments as in `Model.force`.

    Raises:
        InputError: as there.
    """
    senses = np.sign(array_of(direction, "1", "direction"))
    model = studio.slow_model(start, directed=bool(np.any(senses)))
    rest = float(model.muscle.nominal_length)
    if contraction is not None and length is None:
        lengths = np.asarray(rest * (1.0 - array_of(contraction, "1", "contraction")))
    elif length is not None and contraction is None:
        lengths = array_of(length, "m", "length")
    else:
        raise InputError("give either the contraction or the length", hint='e.g. contraction="10 %"')
    shortest, longest = _SHORTEST * rest, model.longest
    outside = lengths[(lengths < shortest) | (lengths > longest)]
    if outside.size:
        raise InputError(
            f"a length of {outside[0] * 1e3:.4g} mm is out of reach",
            hint=f"between {shortest * 1e3:.4g} mm and the braid lock at {longest * 1e3:.4g} mm",
        )
    pressures = array_of(pressure, "Pa", "pressure", "gauge")
    if np.any((pressures < 0.0) | (pressures > _HIGHEST)):
        raise InputError("pressure: a value is not between 0 and 1000 bar", hint="gauge pressures")
    smallest = float(np.min(pressures[pressures > 0.0], initial=np.inf))
    for notice in pressure_notices({"pressure": smallest}):
        warnings.warn(notice.message, stacklevel=4)  # at the line that calls `Model.force`
    try:
        columns = np.broadcast_arrays(pressures, lengths, senses)
    except ValueError as error:
        shapes = ", ".join(str(values.shape) for values in (pressures, lengths, senses))
        raise InputError(f"arrays of the shapes {shapes} do not fit together") from error
    tension = model.force(
        pressure=columns[0].ravel(),
        length=columns[1].ravel(),
        direction=columns[2].ravel(),
        clipped=not unclipped,
    )
    return np.asarray(tension, dtype=np.float64).reshape(columns[0].shape)


def _pressures_in(pressure: str | Sequence[Quantity] | FloatArray) -> tuple[float, ...]:
    """Pressures from a text or a list [Pa].

    Raises:
        InputError: a value that is no pressure.
    """
    if isinstance(pressure, str):
        return pressures_of(pressure.split(","), "pressure")
    values = np.atleast_1d(np.asarray(pressure, dtype=object)).ravel().tolist()
    return pressures_of(values, "pressure")


def _optional_number(value: Quantity | None, unit: str, name: str) -> float | None:
    """A value in SI, None for None."""
    return None if value is None else number_of(value, unit, name)


def _at_least_two(points: int) -> int:
    """A number of points.

    Raises:
        InputError: it is not between 2 and 100 000.
    """
    if not 2 <= points <= 100_000:
        raise InputError(f"points: {points} is not between 2 and 100 000", hint="e.g. 200")
    return points
