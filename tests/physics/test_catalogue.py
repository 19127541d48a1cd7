"""Effects are found in folders; what is wrong with a file is said by name."""

from __future__ import annotations

from pathlib import Path

import pytest

from mckibben.physics.catalogue import BUILT_IN_FOLDER, EffectCatalogue, default_catalogue, effect_of_file
from mckibben.physics.errors import InputError
from mckibben.physics.model import Model
from mckibben.physics.muscle import Muscle
from mckibben.physics.slots import SLOTS

SOURCE = (BUILT_IN_FOLDER / "coulomb_friction.py").read_text(encoding="utf-8")


def write(folder: Path, name: str, *changes: tuple[str, str]) -> None:
    """The friction effect as another file, with some of its text replaced."""
    text = SOURCE
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    (folder / name).write_text(text, encoding="utf-8")


def test_the_folder_is_the_registry() -> None:
    files = {path.stem for path in BUILT_IN_FOLDER.glob("*.py")} - {"__init__"}
    catalogue = default_catalogue()
    assert set(catalogue) == files
    assert list(catalogue) == sorted(files)
    assert len(catalogue) == len(files)
    assert all(catalogue[effect_id].id == effect_id for effect_id in files)
    assert catalogue.problems == []
    assert default_catalogue() is catalogue


def test_unknown_effect_names_the_nearest() -> None:
    with pytest.raises(InputError, match="there is no effect 'colomb_friction'") as caught:
        default_catalogue()["colomb_friction"]
    assert caught.value.hint == "Did you mean 'coulomb_friction'?"
    assert caught.value.code == "unknown_effect"
    assert "colomb_friction" not in default_catalogue()
    assert "coulomb_friction" in default_catalogue()


def test_unknown_effect_without_a_near_one_lists_them() -> None:
    with pytest.raises(InputError) as caught:
        default_catalogue()["xyz"]
    assert caught.value.hint is not None
    assert "coulomb_friction" in caught.value.hint


def test_a_new_file_appears_and_works(tmp_path: Path) -> None:
    write(
        tmp_path, "rope_drag.py", ("return force * direction", "return 2.0 * force * direction"),
        ("            -10.0,", "            -20.0,"), ("            10.0,", "            20.0,"),
        ("-11.1036383", "-22.2072766"),
    )  # fmt: skip
    (tmp_path / "_draft.py").write_text("raise RuntimeError", encoding="utf-8")
    (tmp_path / "notes.txt").write_text("not an effect", encoding="utf-8")
    catalogue = EffectCatalogue([tmp_path])
    assert set(catalogue) - set(default_catalogue()) == {"rope_drag"}
    assert catalogue.problems == []
    effect = catalogue["rope_drag"]
    state = {"muscle": Muscle(0.3, 0.02, 0.45), "length": 0.28, "pressure": 3e5, "direction": 1.0}
    change = Model([effect]).evaluate(values={"rope_drag": {**effect.defaults, "force": 10.0}}, **state).force
    assert change - Model().evaluate(values={}, **state).force == pytest.approx(20.0, rel=1e-12)


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("EFFECT = Effect(", "FRICTION = Effect(", "no module-level EFFECT"),
        ("EFFECT = Effect(", "EFFECT = dict(", "no module-level EFFECT"),
        ("*, direction: Value", "*, velocty: Value", "asks for 'velocty'"),
        (
            "*, direction: Value",
            "direction: Value",
            "'direction' of slot 'friction' must be keyword-only",
        ),
        (
            '"force",\n            "F_c"',
            '"direction",\n            "F_c"',
            "have the name of an argument of slot 'friction'",
        ),
        ('"force",\n            "F_c"', '"width",\n            "F_c"', "asks for 'force'"),
        ('slots={"friction"', 'slots={"rubbing"', "unknown slot 'rubbing'"),
        ('family="friction"', 'family="rubbing"', "family 'rubbing' is not one of geometry"),
        ('type="static"', 'type="statical"', "type 'statical' is not one of static"),
        ('"isobaric", ', '"isobarisch", ', "unknown measurement kinds ['isobarisch']"),
        ('zero_at=("no_motion",)', 'zero_at=("standstill",)', "unknown zero_at ['standstill']"),
        ("references=(_CHOU,)", "references=()", "must not be empty"),
        (
            "default=10.0",
            "default=-10.0",
            "default -10.0 is outside",
        ),
        ("return force * direction", "return force *", "SyntaxError"),
        ("from mckibben.physics.ops", "from mckibben.physics.opps", "ModuleNotFoundError"),
        ('title="Coulomb friction",', "", "missing 1 required"),
        (
            'title="Coulomb friction",',
            'title="Coulomb friction", titel="",',
            "unexpected keyword argument 'titel'",
        ),
    ],
)
def test_a_broken_file_of_the_user_becomes_a_problem(
    tmp_path: Path, old: str, new: str, message: str
) -> None:
    write(tmp_path, "broken.py", (old, new))
    write(tmp_path, "sound.py")
    catalogue = EffectCatalogue([tmp_path])
    assert "broken" not in catalogue
    assert "sound" in catalogue, "the others still load"
    (problem,) = catalogue.problems
    assert problem.file == "broken.py"
    assert message in problem.message


@pytest.mark.parametrize(
    ("code", "message"),
    [
        (
            "raise SystemExit",
            "line 1: it ends the program (SystemExit) when it is loaded; an effect",
        ),
        ("import sys\nsys.exit(3)", "line 2: it ends the program (SystemExit: 3) when it is loaded"),
        ("raise GeneratorExit('g')", "it ends the program (GeneratorExit: g)"),
        ("import asyncio\nraise asyncio.CancelledError", "line 2: it ends the program (CancelledError)"),
        ("class Own(BaseException): pass\nraise Own('x')", "line 2: it ends the program (Own: x)"),
        ("raise BaseExceptionGroup('all', [SystemExit()])", "it ends the program (BaseExceptionGroup: all"),
        ("\n\n1 / 0", "line 3: ZeroDivisionError: division by zero"),
        ("raise ValueError('two\\nlines')", "line 1: ValueError: effect file broken.py: two lines"),
        ("class Own(Exception):\n def __str__(self): 1 / 0\nraise Own", "line 3: Own"),
        ("def f(): f()\nf()", "RecursionError: maximum recursion depth"),
        ("\0", "null byte"),
    ],
)
def test_however_a_file_ends_it_becomes_a_problem(tmp_path: Path, code: str, message: str) -> None:
    (tmp_path / "broken.py").write_text(code, "utf-8")
    write(tmp_path, "sound.py")
    catalogue = EffectCatalogue([tmp_path])
    assert "sound" in catalogue, "the others still load"
    (problem,) = catalogue.problems
    assert message in problem.message
    assert "\n" not in problem.message


def test_a_long_message_is_cut(tmp_path: Path) -> None:
    (tmp_path / "broken.py").write_text("raise RuntimeError('x' * 100_000)", "utf-8")
    (problem,) = EffectCatalogue([tmp_path]).problems
    assert 300 < len(problem.message) < 400


def test_a_real_interrupt_ends_the_loading(tmp_path: Path) -> None:
    (tmp_path / "slow.py").write_text("raise KeyboardInterrupt", "utf-8")
    with pytest.raises(KeyboardInterrupt):
        EffectCatalogue([tmp_path])


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("seal.drag.py", "'seal.drag' cannot be the id of an effect; name the file with at most 64 letters"),
        ("seal drag.py", "'seal drag' cannot be the id"),
        ("1st.py", "'1st' cannot be the id"),
        ("überdruck.py", "cannot be the id"),
        ("x" * 65 + ".py", "cannot be the id"),
        ("custom.py", "'custom' is the id of the typed term; rename the file"),
    ],
)
def test_a_name_that_no_request_could_use_is_refused(tmp_path: Path, name: str, message: str) -> None:
    write(tmp_path, name)
    catalogue = EffectCatalogue([tmp_path])
    assert set(catalogue) == set(default_catalogue())
    assert message in catalogue.problems[0].message


def test_what_is_no_plain_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "folder.py").mkdir()
    (tmp_path / "nowhere.py").symlink_to(tmp_path / "gone")
    problems = EffectCatalogue([tmp_path]).problems
    assert [problem.message for problem in problems] == ["ValueError: it is not a plain file"] * 2


@pytest.mark.parametrize("code", ["raise SystemExit('x')", "raise ValueError('x')", "return nothing"])
def test_a_function_that_fails_names_effect_and_slot(tmp_path: Path, code: str) -> None:
    write(tmp_path, "broken.py", ("return force * direction", code))
    effect = effect_of_file(tmp_path / "broken.py")
    with pytest.raises(InputError, match="effect 'broken', slot 'friction': ") as caught:
        effect.call("friction", {"direction": 1.0, "velocity": 0.0}, effect.defaults)
    assert caught.value.field == "effects.broken"
    assert "broken.py" in str(caught.value.hint)


def test_an_example_that_is_not_so_is_refused(tmp_path: Path) -> None:
    write(tmp_path, "liar.py", ("            -10.0,", "            999.0,"))
    catalogue = EffectCatalogue([tmp_path])
    assert "liar" not in catalogue
    (problem,) = catalogue.problems
    assert problem.message == "ValueError: example 1: force_change is -10, not 999"


def test_an_effect_of_another_interface_is_refused(tmp_path: Path) -> None:
    write(tmp_path, "later.py", ('family="friction",', 'family="friction",\n    interface=2,'))
    (problem,) = EffectCatalogue([tmp_path]).problems
    assert "written for version 2 of mckibben.effects, and this is 1" in problem.message


def test_a_parameter_that_nothing_takes_is_refused(tmp_path: Path) -> None:
    write(
        tmp_path,
        "idle.py",
        ("direction: Value, force: Value", "direction: Value"),
        ("return force *", "return 3.0 *"),
    )
    (problem,) = EffectCatalogue([tmp_path]).problems
    assert "no slot function takes ['force']" in problem.message


def test_an_id_that_exists_is_refused(tmp_path: Path) -> None:
    write(tmp_path, "coulomb_friction.py", ("return force * direction", "return 2.0 * force * direction"))
    catalogue = EffectCatalogue([tmp_path])
    (problem,) = catalogue.problems
    assert "an effect 'coulomb_friction' exists already; rename the file" in problem.message
    own = catalogue["coulomb_friction"]
    assert own.call("friction", {"direction": 1.0, "velocity": 0.0}, own.defaults) == 10.0


def test_two_folders_with_one_id(tmp_path: Path) -> None:
    folders = [tmp_path / "a", tmp_path / "b"]
    for folder in folders:
        folder.mkdir()
        write(folder, "twice.py")
    catalogue = EffectCatalogue(folders)
    assert "twice" in catalogue
    assert len(catalogue.problems) == 1


def test_a_missing_folder_is_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="does not exist"):
        EffectCatalogue([tmp_path / "nowhere"])


def test_every_slot_says_what_it_does() -> None:
    for slot in SLOTS.values():
        assert slot.meaning
        assert slot.combined_by in ("chain", "sum", "product", "concatenate")
