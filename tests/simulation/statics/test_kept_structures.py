"""Structures that other processes have compiled before: the same numbers, and only where that is sure."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import symengine as se

from mckibben.physics.catalogue import BUILT_IN_FOLDER, EffectCatalogue, default_catalogue
from mckibben.physics.custom import custom_effect
from mckibben.physics.effect import Effect
from mckibben.simulation import kept_code
from mckibben.simulation.statics import compiled
from mckibben.simulation.statics.compiled import CompiledState


@pytest.fixture
def compilations(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[list[int]]:
    """Each compilation of this test, which begins with nothing kept."""
    monkeypatch.setenv("MCKIBBEN_CACHE", str(tmp_path))
    kept_code._folder.cache_clear()
    made: list[int] = []

    def lambdify(*args: object, **options: object) -> object:
        made.append(1)
        return se.Lambdify(*args, **options)

    monkeypatch.setattr(compiled, "se", SimpleNamespace(Lambdify=lambdify))
    yield made
    kept_code._folder.cache_clear()


def effects(*names: str) -> tuple[Effect, ...]:
    return tuple(default_catalogue()[name] for name in names)


def values(made: CompiledState) -> np.ndarray:
    rows = np.random.default_rng(1).uniform(0.2, 0.9, (7, made._width))
    return made._function(rows)


def test_a_structure_is_compiled_once_and_gives_the_same_numbers(compilations: list[int]) -> None:
    chosen = effects("bladder_elasticity", "dahl")
    names = ("bladder_elasticity.shear_modulus", "braid_angle")
    one = CompiledState(chosen, names, memory=True, quick=True)
    two = CompiledState(chosen, names, memory=True, quick=True)
    assert len(compilations) == 1
    assert (one.constants, one.inputs, one.compliant) == (two.constants, two.inputs, two.compliant)
    np.testing.assert_array_equal(values(one), values(two))


def test_whatever_differs_is_compiled(compilations: list[int]) -> None:
    chosen = effects("bladder_elasticity", "dahl")
    (bladder, dahl) = chosen
    CompiledState(chosen)
    CompiledState(chosen[:1])
    CompiledState(chosen, quick=True)
    CompiledState(chosen, memory=True)
    CompiledState(chosen, ("braid_angle",))
    CompiledState((bladder, replace(dahl, parameters=dahl.parameters[::-1])))
    assert len(compilations) == 6


def test_typed_terms_and_files_of_the_user_are_not_kept(compilations: list[int], tmp_path: Path) -> None:
    source = BUILT_IN_FOLDER / "prestress.py"
    folder = tmp_path / "effects"
    folder.mkdir()
    (folder / "own.py").write_text(source.read_text("utf-8"), "utf-8")
    own = EffectCatalogue([folder])["own"]
    for effect in (own, custom_effect("c*P")):
        CompiledState((effect,))
        CompiledState((effect,))
    assert len(compilations) == 4


def test_what_is_no_compiled_function_is_not_loaded(
    compilations: list[int], monkeypatch: pytest.MonkeyPatch
) -> None:
    """A pickle may run anything; only the parts of a compiled function are allowed."""
    chosen = effects("prestress")
    CompiledState(chosen)
    spoilt = b"cos\nsystem\n(S'exit 1'\ntR."
    monkeypatch.setattr("mckibben.simulation.statics.compiled.kept", lambda key: spoilt)
    assert np.all(np.isfinite(values(CompiledState(chosen))))
    assert len(compilations) == 2
