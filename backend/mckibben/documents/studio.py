"""Presets and effects, loaded once and shared by all interfaces of the program."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import groupby
from pathlib import Path

from mckibben.documents.start_model import PresetFacts, StartModel, StatedMuscle, preset_facts, start_model
from mckibben.physics.catalogue import EffectCatalogue, default_catalogue, installed_effects
from mckibben.physics.effect import Effect
from mckibben.physics.errors import InputError
from mckibben.physics.sliding import acting_at_rest, sliding_effects
from mckibben.presets import MusclePreset, PresetLibrary
from mckibben.presets.order_code import order_code
from mckibben.simulation.statics.model import StaticModel

_SHOWN = 3  # problems of one preset file


class Studio:
    """Presets and effects of one run of the program.

    Args:
        presets: folder of the built-in presets.
        user_presets: folder for presets of the user; None = presets cannot be saved.
        effects: folders with further effect files (their Python code is executed); those of installed
            packages are there without being named.

    Raises:
        InputError: an effects folder does not exist.
        FileNotFoundError: the folder of the built-in presets does not exist.
    """

    def __init__(
        self, *, presets: Path, user_presets: Path | None = None, effects: Sequence[Path] = ()
    ) -> None:
        self._installed = installed_effects()
        own = effects or self._installed
        self.catalogue = EffectCatalogue(effects, self._installed) if own else default_catalogue()
        #: Effect id -> parameter name -> parameter; presets are checked against it.
        self.effect_table = {
            name: {p.name: p for p in effect.parameters} for name, effect in self.catalogue.items()
        }
        self.library = PresetLibrary(presets, user_presets, self.effect_table)
        self._own = (*(() if user_presets is None else (user_presets,)), *effects)
        self._facts: dict[str, tuple[MusclePreset, PresetFacts]] = {}

    def own_mark(self) -> str:
        """Of the contents of all files of the user, wherever they are: what he changes in them changes it."""
        mark = hashlib.sha256()
        for point in sorted(self._installed, key=lambda point: point.name):
            version = "" if point.dist is None else point.dist.version
            mark.update(f"{point.name} {point.value} {version}\n".encode())
        for folder in self._own:
            for path in sorted(folder.rglob("*")):
                if path.suffix in (".json", ".py") and path.is_file():
                    mark.update(f"{path.relative_to(folder).as_posix()}\n".encode() + path.read_bytes())
        return mark.hexdigest()

    def start_model(
        self, muscle: StatedMuscle, effects: Mapping[str, Mapping[str, float | str]] | None
    ) -> StartModel:
        """The complete muscle and effects of a request; see `mckibben.documents.start_model.start_model`.

        Raises:
            InputError: as there, or there is no such preset.
        """
        preset = None if muscle.preset is None else self.facts(muscle.preset)
        return start_model(muscle, effects, preset=preset, catalogue=self.catalogue)

    def is_built_in(self, preset_id: str | None, effects: Iterable[str]) -> bool:
        """Whether a muscle and effects are part of the program, without files or code of the user."""
        known = preset_id is None or self.library.is_built_in("muscles", preset_id)
        return known and set(effects) <= set(default_catalogue())

    def facts(self, preset_id: str) -> PresetFacts:
        """A muscle preset in SI, cached until its file changes.

        An order code (``DMSP-20-300N-RM-CM``) is its series and diameter with the length that it states.

        Raises:
            InputError: there is no such preset; names the nearest, or the part of an order code that is not
                understood.
        """
        try:
            preset = self.library.muscle(preset_id)
        except InputError as error:
            ordered = self._ordered(preset_id)
            if ordered is not None:
                return ordered
            raise error.at("muscle.preset", code="unknown_preset") from error
        known = self._facts.get(preset.id)
        if known is None or known[0] is not preset:
            known = self._facts[preset.id] = preset, preset_facts(preset, self.catalogue)
        return known[1]

    def _ordered(self, text: str) -> PresetFacts | None:
        known = [preset.id for preset in self.library.list("muscles")]
        try:
            code = order_code(text, known)
        except InputError as error:
            raise error.at("muscle.preset", code="unknown_preset") from error
        if code is None:
            return None
        facts = self.facts(code.preset)
        return replace(facts, muscle=facts.muscle._replace(nominal_length=code.length))

    def slow_model(self, start: StartModel, *, directed: bool = True) -> StaticModel:
        """As `static_model`, for curves with a direction: friction with memory is fully built up in it.

        Args:
            start: the muscle with its effects.
            directed: False = only the mean curve is asked (direction and velocity are zero); effects of the
                program that act in motion alone are then left out of what is compiled. Those of the user
                stay: nobody has checked that they vanish at rest.

        Raises:
            InputError: as there.
        """
        known = start.catalogue or self.catalogue
        effects = tuple(known[name] for name in start.effects)
        model = StaticModel(
            start.muscle, start.effects, catalogue=_sliding_catalogue(effects), limits=start.limits
        )
        if not directed:
            model.effects = _at_rest(model.effects)
        return model

    def static_model(self, start: StartModel) -> StaticModel:
        """The compiled static model of a muscle with its effects.

        Raises:
            InputError: a geometry that cannot pull, or a parameter outside its bounds.
        """
        return StaticModel(
            start.muscle, start.effects, catalogue=start.catalogue or self.catalogue, limits=start.limits
        )


@lru_cache(maxsize=256)
def _sliding_catalogue(effects: tuple[Effect, ...]) -> dict[str, Effect]:
    return {effect.id: effect for effect in sliding_effects(effects=effects)}


@lru_cache(maxsize=256)
def _at_rest(effects: tuple[Effect, ...]) -> tuple[Effect, ...]:
    built_in = default_catalogue()
    acting = set(acting_at_rest(effects=effects))
    return tuple(effect for effect in effects if effect in acting or effect.id not in built_in)


def unused_files(studio: Studio, user_presets: Path | None) -> Iterator[str]:
    """Which files of effects and presets are not used, where and why, what would be right; one line each.

    Args:
        studio: what was loaded.
        user_presets: the user's folder of presets.
    """
    for problem in studio.catalogue.problems:
        yield f"effect file {problem.file} is not used: {problem.message}"
    for file, problems in groupby(studio.library.problems(), key=lambda problem: problem.file):
        name = file.removeprefix("user/")
        path = file if name == file or user_presets is None else user_presets / name
        listed = list(problems)
        for problem in listed[:_SHOWN]:
            known = not problem.field or problem.field in problem.message.replace("'", "")
            said = problem.message if known else f"{problem.field}: {problem.message}"
            hint = f" ({problem.hint.rstrip('.')})" if problem.hint else ""
            yield " ".join(f"preset file {path} is not used: {said}{hint}".split())
        if more := len(listed[_SHOWN:]):
            yield f"preset file {path}: and {more} more"
