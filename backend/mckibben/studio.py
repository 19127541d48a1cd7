"""What every interface of the program works with: the presets and the effects, opened once."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from mckibben.muscle_input import GivenMuscle, StartModel, start_model
from mckibben.physics.catalogue import Catalogue, default_catalogue
from mckibben.presets import MusclePreset, PresetLibrary
from mckibben.simulation.limits import Limits
from mckibben.simulation.static import StaticModel

_LIMIT_UNITS = {"max_pressure": "Pa", "max_force": "N", "max_contraction": "1", "max_pretension": "1"}


class Studio:
    """Presets and effects of one run of the program.

    Args:
        presets: folder of the built-in presets.
        user_presets: folder of the user's own, where new ones are saved; None = saving is refused.
        effects: folders with further effect files (their Python code is executed).

    Raises:
        InputError: an effects folder does not exist.
        FileNotFoundError: the folder of the built-in presets does not exist.
    """

    def __init__(
        self, *, presets: Path, user_presets: Path | None = None, effects: Sequence[Path] = ()
    ) -> None:
        self.catalogue = Catalogue(effects) if effects else default_catalogue()
        table = {name: {p.name: p for p in effect.parameters} for name, effect in self.catalogue.items()}
        self.library = PresetLibrary(presets, user_presets, table)

    def start_model(
        self, muscle: GivenMuscle, effects: Mapping[str, Mapping[str, float | str]] | None
    ) -> StartModel:
        """The complete muscle and effects a caller means; see `mckibben.muscle_input.start_model`."""
        return start_model(muscle, effects, library=self.library, catalogue=self.catalogue)

    def static_model(self, start: StartModel) -> StaticModel:
        """The compiled static model of a muscle with its effects.

        Raises:
            InputError: a geometry that cannot pull, or a parameter outside its bounds.
        """
        return StaticModel(start.muscle, start.effects, catalogue=self.catalogue, limits=limits_of(start.preset))


def limits_of(preset: MusclePreset | None) -> Limits:
    """What the maker allows, in SI; nothing is known of a muscle given by geometry."""
    if preset is None:
        return Limits()
    given = {name: getattr(preset.limits, name) for name in _LIMIT_UNITS}
    return Limits(**{name: limit and limit.si(_LIMIT_UNITS[name]) for name, limit in given.items()})
