"""What all formats keep: same bytes for the same model, who says what, hostile texts harmless."""

from __future__ import annotations

import csv
import io
import json
import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest
import symengine as se

from mckibben.documents.drive_reading import preset_document, read_document
from mckibben.documents.saved_model import read_saved_model
from mckibben.documents.start_model import StatedMuscle
from mckibben.export.drive_words import words_for
from mckibben.export.formats.latex import escaped
from mckibben.export.language import MATLAB, MODELICA, PYTHON, C, names_for, plain, words_of
from mckibben.export.registry import ExportedFile, formats
from mckibben.export.source import of_drive, of_saved, stated_source
from mckibben.export.sources import DRIVE_CONSTANTS
from mckibben.export.subject import Stated, subject_of
from mckibben.export.use_case import ExportQuestion, export, write_export
from mckibben.physics.drive_terms import CONSTANTS, COUNTER_OUTPUTS, OUTPUTS
from mckibben.physics.errors import InputError
from mckibben.physics.units import is_unit
from tests.export.models import studio, subject

ALL = ("c", "fmu", "fmu3", "json", "latex", "linear", "matlab", "modelica", "python", "table")
# tests/export/test_fmu.py, test_fmu3.py and test_linear.py examine the others.
TEXTS = tuple(form for form in ALL if form not in ("fmu", "fmu3", "linear"))
HOSTILE = (
    'a */ int x; /* "); system("id"); //\n#include <bad>\r\nend\u2028%}\n\\end{document}\\input{/etc/passwd}'
    " ??/\n ''' \"\"\" \x00\x1b[31m $(id) `id` =cmd|'/c calc'!A1 \u202e ../../x"
)
SAVED = {
    "schema": 1, "kind": "model", "muscle": {"preset": "DMSP-20", "nominal_length": 0.29},
    "effects": {"bladder_elasticity": {"shear_modulus": 5.1e5}, "coulomb_friction": {"force": 21.0}},
    "freed": [], "free": ["nominal_length"],
    "envelope": {"pressure": {"least": 1e5, "most": 5e5, "unit": "Pa"}},
    "assumed": ["the supply is 6 bar"],
    "origin": {
        "program": "mckibben 0.1.0", "made": "2026-01-01T00:00:00+00:00",
        "kind": "isobaric", "predicted": "force", "verdict": "Found",
        "error": {"rmse": 5.0, "holdout_rmse": None, "noise": 4.0, "unit": "N"},
        "files": [{"name": "map.csv", "sha256": "ab" * 32, "rows": 720}],
    },
}  # fmt: skip


def written(stated: Stated, form: str, stem: str | None = None) -> tuple[ExportedFile, ...]:
    return export(ExportQuestion(stated, form, stem), studio()).files


def texts(stated: Stated, form: str) -> str:
    return "\n".join(file.content.decode() for file in written(stated, form, "model"))


def test_one_file_is_one_format_and_each_has_title_and_note():
    assert tuple(formats()) == ALL
    for form in formats().values():
        assert form.title
        assert 10 < len(form.note) < 90


@pytest.mark.parametrize("form", TEXTS)
@pytest.mark.parametrize("name", ["DMSP-20", "paper-step-mpye"])
def test_the_same_model_gives_the_same_bytes(form, name):
    first = written(stated_source(name, studio()), form)
    from mckibben.export.drive_equations import drive_equations
    from mckibben.export.static_equations import static_equations

    for number in range(11):  # what a process has done before moves symengine's temporary names
        se.Dummy(f"x{number}")
    drive_equations.cache_clear()
    static_equations.cache_clear()
    assert written(stated_source(name, studio()), form) == first


@pytest.mark.parametrize("form", TEXTS)
def test_every_preset_can_be_taken_along(form):
    for kind in ("muscles", "drives"):
        for preset in studio().library.list(kind):
            assert all(file.content for file in written(stated_source(preset.id, studio()), form))


@pytest.mark.parametrize("form", TEXTS)
def test_every_file_says_what_it_is(form):
    saved = of_saved(read_saved_model(SAVED, "the model"), studio(), "model.json")
    about = subject_of(saved, studio()).about
    for file in written(saved, form, "model"):
        raw = file.content.decode()
        text = raw if form in ("json", "latex") else " ".join(re.sub(r"\n\W*", " ", raw).split())
        for said in (about.id, about.hash, "map.csv", "100000", "500000", "the supply is 6 bar", "510000"):
            assert (escaped(said) if form == "latex" else said) in text, (file.name, said)
        assert "[D]" in text or '"grade": "D"' in text or r"& D \\" in text


def test_the_source_of_each_constant_is_that_of_its_number():
    saved = of_saved(read_saved_model(SAVED, "the model"), studio(), "model.json")
    found = {each.name: each for each in subject_of(saved, studio()).about.constants}
    assert found["nominal_length"].source == "fitted to map.csv"
    assert found["bladder_elasticity.shear_modulus"].grade == "D"
    angle = studio().library.muscle("DMSP-20").geometry.braid_angle
    assert (found["braid_angle"].source, found["braid_angle"].grade) == (angle.source, angle.grade)
    lift = subject_of(stated_source("propneu-20", studio()), studio()).about
    drive = {each.name: each for each in lift.constants}
    assert drive["drive.mass"].source == "Fitted to the printed figures"
    assert "drive.tube_volume" not in drive  # there is no tube
    assert any("dead times" in sentence for sentence in lift.left_out)


def test_json_gives_the_same_model_again(tmp_path: Path):
    model = tmp_path / "model.json"
    model.write_text(json.dumps(SAVED), "utf-8")
    for name in ("DMSP-20", "DMSP-10:250mm", "propneu-20", "paper-pid-triangle", str(model)):
        path, again = tmp_path / "out.json", tmp_path / "again.json"
        first = stated_source(name, studio())
        write_export(ExportQuestion(first, "json"), path, studio())
        second = stated_source(str(path), studio())
        write_export(ExportQuestion(second, "json"), again, studio())
        one, other = (json.loads(each.read_text("utf-8")) for each in (path, again))
        assert one["document"] == other["document"]
        assert one["about"]["hash"] == other["about"]["hash"]
        here, there = subject_of(first, studio()), subject_of(second, studio())
        assert here.statics.values == there.statics.values
        assert here.statics.muscle == there.statics.muscle
    assert json.loads(path.read_text("utf-8"))["document"] == SAVED


def test_tables_interpolate_as_well_as_they_say():
    model = subject("together_0").statics
    from mckibben.export.formats.table import lookup_of, pressures_for
    from mckibben.simulation.statics.inverse import pressure_for_force

    table = lookup_of(model)
    random = np.random.default_rng(1)
    pressure, contraction = random.uniform(0, 6e5, 3000), random.uniform(-0.04, 0.25, 3000)
    from scipy.interpolate import RegularGridInterpolator

    theirs = RegularGridInterpolator((table.pressure, table.contraction), table.force)(
        np.column_stack([pressure, contraction])
    )
    exact = model.force(length=model.muscle.nominal_length * (1.0 - contraction), pressure=pressure)
    worst = float(np.max(np.abs(theirs - exact)))
    assert 0.3 * table.force_error < worst <= 1.1 * table.force_error
    assert table.force_error_pulling < table.force_error
    found = pressures_for(model, np.array([100.0, 500.0]), np.array([0.28, 0.27]), 6e5)
    for value, force, length in zip(found, (100.0, 500.0), (0.28, 0.27), strict=True):
        assert value == pytest.approx(pressure_for_force(model, force=force, length=length).value, abs=0.01)
    assert np.isnan(pressures_for(model, np.array([5000.0]), np.array([0.28]), 6e5)[0])


@pytest.mark.parametrize(
    ("effects", "said"),
    [
        ({"coulomb_friction": {"force": 21.0}}, "changes the force by up to 21 N."),
        ({"dahl": {"force": 33.0}}, "changes the force by up to 33 N."),
        ({"bladder_elasticity": {}}, "does not change the force."),
    ],
)
def test_a_table_says_what_friction_would_change(effects, said):
    """A muscle that slides against a constant friction pulls this much more or less."""
    start = studio().start_model(StatedMuscle(preset="DMSP-20"), effects)
    text = texts(Stated(start), "table")
    assert said in " ".join(re.sub(r"\n\W*", " ", text).split())


def test_the_csv_of_a_table_holds_the_force_of_the_model():
    stated = stated_source("DMSP-20", studio())
    file = next(file for file in written(stated, "table", "t") if file.name == "t_force.csv")
    rows = [line for line in file.content.decode().splitlines() if not line.startswith("#")]
    head, *body = csv.reader(io.StringIO("\n".join(rows)))
    contraction, model = np.array(head[1:], float), subject_of(stated, studio()).statics
    for row in (body[3], body[-1]):
        expected = model.force(length=0.3 * (1.0 - contraction), pressure=float(row[0]))
        np.testing.assert_allclose(np.array(row[1:], float), expected, rtol=1e-7, atol=1e-6)


def test_tables_over_pressure_are_those_of_the_inverse_questions():
    """Blocked force and free contraction, and how exact a line between two rows is."""
    from mckibben.export.formats.table import lookup_of
    from mckibben.simulation.statics.inverse import contraction_for_force

    stated = stated_source("DMSP-20", studio())
    model = subject_of(stated, studio()).statics
    table = lookup_of(model)
    file = next(file for file in written(stated, "table", "t") if file.name == "t_over_pressure.csv")
    head, *body = csv.reader(line for line in file.content.decode().splitlines() if line[0] != "#")
    assert head == ["pressure_Pa", "blocked_force_N", "free_contraction"]
    pressure, blocked, free = (np.array([row[place] for row in body[1:]], float) for place in range(3))
    for row in (5, 20):
        force = float(model.force(length=0.3, pressure=pressure[row])[0])
        assert blocked[row] == pytest.approx(force, rel=1e-8)
        found = contraction_for_force(model, force=0.0, pressure=pressure[row])
        assert free[row] == pytest.approx(found.value, rel=1e-6)
    between = np.random.default_rng(2).uniform(pressure[0], pressure[-1], 300)
    exact = model.force(length=0.3, pressure=between)
    assert np.max(np.abs(np.interp(between, pressure, blocked) - exact)) <= 1.1 * table.blocked_error + 1e-6
    assert "free contraction within" in " ".join(table.notes)


def hostile(form: str) -> Stated:
    """A drive whose title is hostile, with a typed term over several lines."""
    effects = {"custom": {"term": "-c*(sign(v)\n*P)", "c": 1e-6}, "bladder_elasticity": {}}
    document = preset_document("propneu-20", studio()).model_copy(
        update={"title": HOSTILE[:200], "effects": effects}
    )
    if form != "table":
        return of_drive(document, studio(), "x")
    start = studio().start_model(StatedMuscle(preset="DMSP-20"), effects)
    return Stated(start, HOSTILE)


def hostile_saved() -> Stated:
    """A model that was fitted to a file with a hostile name."""
    origin = {**SAVED["origin"], "verdict": HOSTILE[:200]}
    origin["files"] = [{"name": HOSTILE, "sha256": "ab" * 32, "rows": 720}]
    saved = read_saved_model({**SAVED, "assumed": [HOSTILE], "origin": origin}, "the model")
    return of_saved(saved, studio(), "model.json")


@pytest.mark.parametrize("of", ["document", "file"])
@pytest.mark.parametrize("form", TEXTS)
def test_hostile_texts_stay_texts(form, of):
    """Without what stands in comments and texts nothing of them is left."""
    text = texts(hostile(form) if of == "document" else hostile_saved(), form)
    assert not set(text) & set("\x00\x1b\r")
    assert form == "json" or not set(text) & set("\u2028\u202e")
    if form == "c":
        code = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
    elif form == "latex":
        code = text.replace(r"\textbackslash{}", "")
        assert code.count(r"\end{document}") == 1
        assert r"\input" not in code.replace(r"\usepackage[utf8]{inputenc}", "")
        return
    elif form == "json":
        about = json.loads(text)["about"]
        assert HOSTILE[:200] in (about["title"] if of == "document" else about["origin"][0])
        return
    else:
        mark = {"matlab": "%", "modelica": "//", "python": "#", "table": "[#%]"}[form]
        bare = re.sub(r'"[^"\n]*"', "", text) if form == "modelica" else text
        code = "\n".join(re.sub(rf"^\s*{mark}.*|\s+{mark} .*", "", line) for line in bare.splitlines())
    assert "system" not in code
    assert "bad" not in code
    assert "passwd" not in code


@pytest.mark.skipif(shutil.which("gcc") is None, reason="gcc is not installed")
def test_hostile_c_compiles(tmp_path: Path):
    write_export(ExportQuestion(hostile("c"), "c"), tmp_path / "plant.c", studio())
    command = ["gcc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-c", "-O0", "plant.c"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_hostile_python_runs(tmp_path: Path):
    write_export(ExportQuestion(hostile("python"), "python"), tmp_path / "plant.py", studio())
    subprocess.run([sys.executable, "-I", "plant.py"], cwd=tmp_path, check=True, capture_output=True)


def test_names_are_safe_different_and_no_words_of_the_language():
    for language in (C, PYTHON, MATLAB, MODELICA):
        names = names_for(["while", "a.b", "a_b", "A B", "", "ü", "t3", "9 lives", HOSTILE], language)
        assert len({name.lower() for name in names.values()}) == 9
        for name in names.values():
            assert re.fullmatch(r"[a-z][a-z0-9_]{0,60}", name)
            assert name not in language.reserved
    assert words_of("../../etc/passwd") == "etc_passwd"
    assert plain("a */ b ??/ /*\n\\") == "a * / b ? ?/ / * /"


@pytest.mark.parametrize("name", ["../x", "a b", "x;rm", "a/b", "", "-x", "\u202e"])
def test_names_of_files_are_checked(name):
    with pytest.raises(InputError, match="cannot be the name of the file"):
        written(stated_source("DMSP-20", studio()), "c", name)
    if re.fullmatch(r"[A-Za-z0-9_.-]*", name):
        return
    with pytest.raises(InputError):
        written(stated_source("DMSP-20", studio()), "matlab", name)


@pytest.mark.parametrize(
    ("form", "name"),
    [
        ("matlab", "end"), ("matlab", "evaluate"), ("matlab", "Raw"), ("matlab", "sqrt"), ("matlab", "rates"),
        ("table", "function"), ("python", "numpy"), ("python", "Random"), ("python", "class"),
        ("python", "lift-20"), ("c", "math"), ("modelica", "real"),
    ],
)  # fmt: skip
def test_a_file_has_no_name_that_the_program_reads_as_something_else(form, name, tmp_path: Path):
    """`numpy.py` would be imported in place of numpy, `evaluate.m` holds a function of that name."""
    stated = stated_source("propneu-20" if form != "table" else "DMSP-20", studio())
    with pytest.raises(InputError, match=f"-o: '{name}' cannot be the name of the file"):
        write_export(ExportQuestion(stated, form), tmp_path / f"{name}.x", studio(), named="-o")
    assert not list(tmp_path.iterdir())


def test_latex_has_no_letter_that_its_fonts_lack():
    """pdflatex stops at the first one."""
    said = escaped("Ünïcöde Łódź ȷ Ƀ ơ Ǻ ŧ ŉ ſ ﬁ 日 µ – “x” 5 €")
    assert said == r"Ünïcöde Łódź ? ? o A ? ? s f ? µ -- ``x'' 5 \texteuro{}"
    every = escaped("".join(map(chr, range(0xA1, 0x3000))))
    assert all(c < "\u0180" and c not in "ĦħĸĿŀŉŦŧſ" for c in every)


@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="LaTeX is not installed")
def test_latex_compiles_with_any_title(tmp_path: Path):
    odd = "".join(map(chr, range(0x21, 0x250)))
    start = studio().start_model(
        StatedMuscle(preset="DMSP-20"), {"custom": {"term": "-c*P_1", "c": 1.0, "P_1": 2.0}}
    )
    stated = Stated(start, odd)
    write_export(ExportQuestion(stated, "latex"), tmp_path / "m.tex", studio())
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "m.tex"]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True)
    assert done.returncode == 0, done.stdout.decode("latin1")[-2000:]


def test_files_stand_beside_each_other_or_in_a_zip_and_nowhere_else(tmp_path: Path):
    stated = stated_source("DMSP-20", studio())
    assert write_export(ExportQuestion(stated, "c"), tmp_path / "m.c", studio()) == [
        tmp_path / "m.c", tmp_path / "m.h"
    ]  # fmt: skip
    assert '#include "m.h"' in (tmp_path / "m.c").read_text("utf-8")
    (path,) = write_export(ExportQuestion(stated, "c"), tmp_path / "m.zip", studio())
    with zipfile.ZipFile(path) as archive:
        assert archive.namelist() == ["m.c", "m.h"]
    folder = tmp_path / "folder"
    folder.mkdir()
    named = write_export(ExportQuestion(stated, "python"), folder, studio())
    assert [each.name for each in named] == ["dmsp_20_300_mm.py"]
    with pytest.raises(InputError, match="there is no folder"):
        write_export(ExportQuestion(stated, "c"), tmp_path / "none" / "m.c", studio())
    assert {each.name for each in tmp_path.iterdir()} == {"m.c", "m.h", "m.zip", "folder"}


def test_what_a_format_cannot_carry_is_refused_by_name():
    document = preset_document("propneu-20", studio())
    bouncing = document.model_copy(update={"stops": document.stops.model_copy(update={"restitution": 0.3})})
    stated = of_drive(bouncing, studio(), "x")
    with pytest.raises(InputError, match="restitution"):
        written(stated, "modelica")
    assert written(stated, "c")
    with pytest.raises(InputError, match="no format 'fortran'"):
        written(stated, "fortran")
    assert "NOT COMPILED" in texts(stated_source("DMSP-20", studio()), "modelica")


def test_a_command_of_too_many_pieces_is_left_out_and_said():
    document = preset_document("propneu-20", studio()).to_document()
    document["effects"] = {}  # no dead times, which swallow short pulses
    document["command"] = {"shape": "square", "period": "1 ms"}
    document["duration"] = 20.0
    stated = of_drive(read_document(document, "the drive"), studio(), "x")
    for form in ("c", "python", "matlab", "modelica"):
        text = texts(stated, form)
        assert len(text) < 100_000
        assert "set the input yourself" in " ".join(re.sub(r"\n\W*", " ", text).split())


def test_a_model_of_several_lengths_needs_one():
    several = {**SAVED, "muscle": {"braid_angle": 0.46, "braid_diameter": 0.0218}}
    with pytest.raises(InputError, match=r"m\.json: muscle\.nominal_length.*several lengths"):
        of_saved(read_saved_model(several, "the model"), studio(), "m.json")
    of_preset = of_saved(
        read_saved_model({**SAVED, "muscle": {"preset": "DMSP-20"}}, "m"), studio(), "m.json"
    )
    assert any("several lengths" in each for each in subject_of(of_preset, studio()).about.assumed)


def test_every_quantity_of_a_drive_has_unit_and_meaning():
    assert set(DRIVE_CONSTANTS) == set(CONSTANTS)
    assert set(words_for("output", (*OUTPUTS, *COUNTER_OUTPUTS), ())) == {*OUTPUTS, *COUNTER_OUTPUTS}
    for name in ("propneu-20", "paper-step-mpye"):
        runnable = subject_of(stated_source(name, studio()), studio()).runnable
        assert runnable is not None
        for kind in ("state", "parameter", "input", "output", "switch"):
            for words in runnable.words(kind).values():
                assert len(words.meaning) > 5
                assert words.unit == "1" or is_unit(words.unit)
