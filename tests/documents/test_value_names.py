"""Values of presets in words: the titles that a user sees, never keys."""

from __future__ import annotations

from mckibben.documents.value_names import value_names
from mckibben.presets import MusclePreset, ValvePreset
from mckibben.presets.quantity import quantities
from tests.shipped import shipped_studio


def test_values_of_an_effect_stand_behind_its_title() -> None:
    paths = ["effects.dahl.force", "limits.max_pressure", "effects.dahl.break_strain"]
    titles = shipped_studio().catalogue
    assert value_names(paths, titles) == ("Dahl friction (force, break strain)", "max pressure")
    assert value_names(["effects.my_own.force"], {}) == ("my own (force)",)


def test_every_value_of_the_shipped_presets_has_words() -> None:
    studio = shipped_studio()
    for preset in (*studio.library.list("muscles"), *studio.library.list("valves")):
        assert isinstance(preset, MusclePreset | ValvePreset)
        paths = [path for path, _ in quantities(preset)]
        names = value_names(paths, studio.catalogue)
        assert not [name for name in names if "_" in name or "." in name]
        for effect in preset.effects:
            assert any(name.startswith(studio.catalogue[effect].title) for name in names)
