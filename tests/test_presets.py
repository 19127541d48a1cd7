"""The preset library, and the numbers in the preset files."""

from __future__ import annotations

import csv
import json
import math
import os
import re
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, get_args

import numpy as np
import pytest

from mckibben import cli
from mckibben.cli.drive_commands import NO_DRIVE
from mckibben.documents.start_model import StatedMuscle
from mckibben.documents.studio import Studio
from mckibben.documents.task import SizingTask
from mckibben.physics.catalogue import default_catalogue
from mckibben.physics.errors import InputError
from mckibben.physics.parameter import GRADES, Parameter, Source
from mckibben.presets import (
    CurvePreset,
    MeasurementPreset,
    MusclePreset,
    PresetLibrary,
    Quantity,
    TaskPreset,
)
from mckibben.presets.quantity import Grade, quantities

ROOT = Path(__file__).parents[1]
PRESETS = ROOT / "presets"
REFERENCE_DATA = ROOT.parent / "shared" / "data"
DOCUMENTS = ("designs", "drives", "examples", "tasks")  # checked by what runs them
FILES = sorted(path for path in PRESETS.glob("*/*.json") if path.parent.name not in DOCUMENTS)
TASKS = sorted((PRESETS / "tasks").glob("*.json"))
BLOCKED_FORCE = {10: 473.3, 20: 1515.0, 40: 6203.0}  # MuscleSIM, 6 bar, 0 %


@pytest.fixture(scope="module")
def library() -> PresetLibrary:
    return PresetLibrary(PRESETS)


def muscle(library: PresetLibrary, preset_id: str) -> MusclePreset:
    return library.muscle(preset_id)


def curve(library: PresetLibrary, size: int) -> CurvePreset:
    preset = library.get("curves", f"musclesim-{size}")
    assert isinstance(preset, CurvePreset)
    return preset


def measurement(library: PresetLibrary, preset_id: str) -> MeasurementPreset:
    preset = library.get("measurements", preset_id)
    assert isinstance(preset, MeasurementPreset)
    return preset


# --- the built-in files


def test_every_file_is_valid(library: PresetLibrary) -> None:
    assert library.problems() == []
    loaded = {preset.id.replace("/", "-") for kind in library.kinds for preset in library.list(kind)}
    assert {path.stem for path in FILES} <= loaded
    assert len(FILES) >= 30


def test_default_effects_exist_with_units_and_values_the_effects_accept() -> None:
    table = {
        effect_id: {parameter.name: parameter for parameter in effect.parameters}
        for effect_id, effect in default_catalogue().items()
    }
    assert PresetLibrary(PRESETS, effects=table).problems("muscles") == []


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_every_value_has_unit_source_and_grade(path: Path) -> None:
    def values(part: Any) -> Iterator[dict[str, Any]]:
        if isinstance(part, dict):
            if "value" in part:
                yield part
            else:
                for item in part.values():
                    yield from values(item)

    document = json.loads(path.read_text(encoding="utf-8"))
    found = list(values(document))
    assert found or document["kind"] == "curve"
    for value in found:
        assert set(value) <= {"value", "unit", "source", "grade", "note"}
        assert value["source"].strip()
        assert value["grade"] in GRADES


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_files_are_written_for_diffs(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert text.endswith("}\n")
    lines = text.splitlines()
    assert all((len(line) - len(line.lstrip(" "))) % 2 == 0 for line in lines)
    assert all(len(line) <= 110 for line in lines if line.lstrip()[0] in "-0123456789")


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_a_title_describes_the_preset_and_not_what_a_user_makes_of_its_document(path: Path) -> None:
    assert "title" not in json.loads(path.read_text(encoding="utf-8")).get("document", {})


def test_grades_are_those_of_the_physics() -> None:
    assert set(get_args(Grade)) == set(GRADES)


def test_general_knowledge_and_estimates_are_not_verified(library: PresetLibrary) -> None:
    for kind in library.kinds:
        for preset in library.list(kind):
            unverified = [path for path, value in quantities(preset) if value.grade in ("M", "E")]
            grounds = getattr(preset, "grounds", {})  # of the plain values in a drive document
            unverified += [path for path, ground in grounds.items() if ground.grade in ("M", "E")]
            assert all(value.verified == (value.grade not in ("M", "E")) for _, value in quantities(preset))
            assert preset.verified == (not unverified), preset.id
            assert preset.public()["verified"] is preset.verified
    assert not muscle(library, "DMSP-20").verified
    assert muscle(library, "paper").verified


def test_the_muscles_the_command_line_promises_are_there(library: PresetLibrary) -> None:
    ids = [preset.id for preset in library.list("muscles")]
    assert {"MAS-10", "MAS-20", "MAS-40", "DMSP-5", "DMSP-10", "DMSP-20", "DMSP-40", "hand-made"} <= set(ids)
    assert ids.index("DMSP-5") < ids.index("DMSP-10")  # natural order
    assert muscle(library, "DMSP-10").geometry.nominal_length.si("m") == 0.25
    assert muscle(library, "DMSP-20").geometry.nominal_length.si("m") == 0.3


def test_muscles_refer_to_presets_that_exist(library: PresetLibrary) -> None:
    for preset in library.list("muscles"):
        assert isinstance(preset, MusclePreset)
        if preset.reference_curve:
            assert library.get("curves", preset.reference_curve).id == preset.reference_curve
        if preset.measurement:
            assert measurement(library, preset.measurement).muscle == preset.id


@pytest.mark.parametrize("size", [10, 20, 40])
def test_screwed_series_equals_the_press_fitted_one(library: PresetLibrary, size: int) -> None:
    mas, dmsp = muscle(library, f"MAS-{size}"), muscle(library, f"DMSP-{size}")
    assert mas.effect_values() == dmsp.effect_values()
    for (path, a), (_, b) in zip(quantities(mas.geometry), quantities(dmsp.geometry), strict=True):
        assert a.value == b.value, path
    assert not mas.geometry.braid_angle.verified  # an assumption


@pytest.mark.parametrize("preset_id", ["DMSP-5", "DMSP-10", "DMSP-20", "DMSP-40", "hand-made"])
def test_braid_is_bore_plus_wall(library: PresetLibrary, preset_id: str) -> None:
    geometry = muscle(library, preset_id).geometry
    assert geometry.wall_thickness is not None
    assert geometry.braid_diameter.si("m") == pytest.approx(
        geometry.inside_diameter.si("m") + geometry.wall_thickness.si("m"), rel=1e-9
    )


# --- the default models against the maker's curves and the measured maps


def force(preset: MusclePreset, pressure: np.ndarray, contraction: np.ndarray) -> np.ndarray:
    """Independent of mckibben.physics: virtual work of gas volume and strain energy, by differences."""
    geometry = preset.geometry
    L0, D0 = geometry.nominal_length.si("m"), geometry.braid_diameter.si("m")
    theta = geometry.braid_angle.si("rad")
    assert geometry.wall_thickness is not None
    wall = math.pi * D0 * geometry.wall_thickness.si("m") * L0
    effects = preset.effect_values()
    C10 = effects["bladder_elasticity"]["shear_modulus"]
    C01 = effects["bladder_elasticity"]["mooney_constant"]
    thread, turns = L0 / math.cos(theta), L0 * math.tan(theta) / (math.pi * D0)

    def volume(length: np.ndarray) -> np.ndarray:
        return length * (thread**2 - length**2) / (4.0 * math.pi * turns**2)

    def energy(length: np.ndarray) -> np.ndarray:
        axial = length / L0
        hoop = np.sqrt(thread**2 - length**2) / (math.pi * turns) / D0
        radial = 1.0 / (axial * hoop)
        first = axial**2 + hoop**2 + radial**2 - 3.0
        second = axial**-2 + hoop**-2 + radial**-2 - 3.0
        return wall * (C10 * first + C01 * second)

    length, step = L0 * (1.0 - contraction), 1e-5 * L0
    slope_volume = (volume(length + step) - volume(length - step)) / (2.0 * step)
    slope_energy = (energy(length + step) - energy(length - step)) / (2.0 * step)
    return -pressure * slope_volume + slope_energy - effects["prestress"]["force"]


def rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def percentages(preset: MusclePreset) -> list[float]:
    """The percentages in the note that says how well the default model fits."""
    note = preset.geometry.braid_angle.note or ""
    return [float(number) for number in re.findall(r"([0-9.]+) %", note)]


@pytest.mark.parametrize("size", [10, 20, 40])
def test_default_model_follows_the_maker_within_3_percent(library: PresetLibrary, size: int) -> None:
    preset, points = muscle(library, f"DMSP-{size}"), curve(library, size)
    columns = points.si_columns()
    rows = points.used & (columns["contraction"] >= 0.0) & (columns["contraction"] <= 0.25)
    assert rows.sum() > 40
    pressure, contraction, given = (columns[name][rows] for name in ("pressure", "contraction", "force"))
    model = force(preset, pressure, contraction)
    full_scale = BLOCKED_FORCE[size]
    pulling = given > 0.0
    clipped = np.maximum(model, 0.0)
    errors = {
        "pulling points, model clipped": rms(clipped[pulling] - given[pulling]),
        "all points, both clipped": rms(clipped - np.maximum(given, 0.0)),
        "all points, unclipped": rms(model - given),
    }
    assert {name: error / full_scale for name, error in errors.items() if error > 0.03 * full_scale} == {}
    noted = percentages(preset)[1:4]  # the first one is the contraction range
    assert noted == pytest.approx([100.0 * error / full_scale for error in errors.values()], abs=0.011)


@pytest.mark.parametrize("preset_id", ["DMSP-10", "DMSP-20"])
def test_default_model_follows_the_measured_map(library: PresetLibrary, preset_id: str) -> None:
    preset = muscle(library, preset_id)
    assert preset.measurement is not None
    points = measurement(library, preset.measurement)
    columns = points.si_columns()
    pulls = np.array(points.slack) == 0
    contraction = 1.0 - columns["length"] / points.nominal_length.si("m")
    model = np.maximum(force(preset, columns["pressure"], contraction), 0.0)
    error = rms((model - columns["force"])[pulls]) / columns["force"].max()
    assert error < 0.032
    assert percentages(preset)[4] == pytest.approx(100.0 * error, abs=0.011)


@pytest.mark.parametrize("size", [10, 20, 40])
def test_what_a_preset_says_of_its_stretched_side_is_what_the_curves_of_the_maker_say(
    library: PresetLibrary, size: int
) -> None:
    preset, points = muscle(library, f"DMSP-{size}"), curve(library, size)
    columns = points.si_columns()
    rows = points.used & (columns["contraction"] < 0.0)
    pressure, contraction, given = (columns[name][rows] for name in ("pressure", "contraction", "force"))
    off = force(preset, pressure, contraction) - given
    stated = re.search(r"−([\d.]+) % its force is (\d+) N below to (\d+) N above", preset.stretched or "")
    assert stated
    least, below, above = (float(number) for number in stated.groups())
    assert -100.0 * contraction.min() == pytest.approx(least, abs=0.05)
    assert (-off.min(), off.max()) == (pytest.approx(below, abs=1.0), pytest.approx(above, abs=1.0))
    assert muscle(library, f"MAS-{size}").stretched == preset.stretched


def test_material_is_the_same_in_all_sizes(library: PresetLibrary) -> None:
    for size in (10, 20, 40):
        preset = muscle(library, f"DMSP-{size}")
        effects = preset.effect_values()
        assert effects["bladder_elasticity"]["shear_modulus"] == pytest.approx(0.468e6)
        area = math.pi * preset.geometry.braid_diameter.si("m") * 1.8e-3
        assert effects["prestress"]["force"] / area == pytest.approx(0.20e6, rel=0.01)


def test_a_prestress_without_a_value_is_that_of_the_measured_muscles() -> None:
    """110 N of 20 mm and 40 N of 10 mm, fitted to the maps of Martens & Boblan."""
    studio = Studio(presets=PRESETS)
    found = {}
    for size in (10, 20):
        start = studio.start_model(StatedMuscle(preset=f"DMSP-{size}"), {"prestress": {}})
        found[size] = start.effects["prestress"]["force"]
        assert studio.static_model(start).values["prestress"] == start.effects["prestress"]
    assert found[20] == 110.0
    assert found[10] == pytest.approx(40.0, rel=0.2)


def test_smallest_muscle_reaches_its_catalogue_force(library: PresetLibrary) -> None:
    preset = muscle(library, "DMSP-5")
    assert preset.limits.max_force is not None
    blocked = force(preset, np.array([6e5]), np.array([0.0]))[0]
    assert blocked == pytest.approx(preset.limits.max_force.si("N"), rel=0.02)


def test_the_muscle_of_another_maker_follows_its_published_formula() -> None:
    """F = pi r0^2 P [a (1 - k e)^2 - b], a = 3/tan^2 20 deg, b = 1/sin^2 20 deg, k = 1.25, r0 = 8.5 mm."""
    studio = Studio(presets=PRESETS)
    model = studio.static_model(studio.start_model(StatedMuscle("LAAS-17"), None))
    a, b = 3.0 / math.tan(math.radians(20.0)) ** 2, 1.0 / math.sin(math.radians(20.0)) ** 2
    contraction = np.array([0.0, 0.08, 0.16, 0.24])
    expected = math.pi * 0.0085**2 * 4e5 * (a * (1.0 - 1.25 * contraction) ** 2 - b)
    got = model.force(length=0.185 * (1.0 - contraction), pressure=np.full(4, 4e5))
    assert got == pytest.approx(expected, rel=1e-6)
    free = (1.0 - math.sqrt(b / a)) / 1.25  # where the formula gives no force
    assert model.force(length=0.185 * (1.0 - free), pressure=4e5, clipped=False) == pytest.approx(
        0.0, abs=1e-6
    )


# --- the data


def test_the_point_that_breaks_the_pattern_is_excluded(library: PresetLibrary) -> None:
    points = curve(library, 20)
    columns = points.si_columns()
    index = int(np.flatnonzero(~points.used)[0])
    assert (~points.used).sum() == 1
    assert columns["force"][index] == 112.0
    assert columns["pressure"][index] == 2e5
    assert columns["contraction"][index] == pytest.approx(0.12)
    assert curve(library, 10).used.all()


@pytest.mark.skipif(not REFERENCE_DATA.is_dir(), reason="needs the transcribed reference data")
def test_curves_are_transcribed_exactly(library: PresetLibrary) -> None:
    with (REFERENCE_DATA / "musclesim_curves.csv").open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    for size in (10, 20, 40):
        columns = curve(library, size).data_columns
        of_size = [row for row in rows if row["inside_diameter_mm"] == str(size)]
        assert columns.pressure.values == [float(row["pressure_bar"]) for row in of_size]
        assert columns.contraction.values == [float(row["contraction_pct"]) for row in of_size]
        assert columns.force.values == [float(row["force_N"]) for row in of_size]


@pytest.mark.skipif(not REFERENCE_DATA.is_dir(), reason="needs the transcribed reference data")
@pytest.mark.parametrize("sample", ["10-250", "20-300"])
def test_maps_are_transcribed_exactly(library: PresetLibrary, sample: str) -> None:
    points = measurement(library, f"martens-dmsp-{sample}")
    with (REFERENCE_DATA / f"DMSP-{sample}_force_map.csv").open(encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    columns = points.data_columns
    assert columns.pressure.values == [float(row["pressure_kPa"]) for row in rows]
    assert columns.length.values == [float(row["length_mm"]) for row in rows]
    assert columns.force.values == [float(row["force_N"]) for row in rows]
    assert points.slack == [int(row["force_clipped_zero"]) for row in rows]
    assert "10.3390/act6040033" in points.references[0]
    assert "Erratum" in points.references[0]


def test_measured_maps_are_whole_without_the_reference_data(library: PresetLibrary) -> None:
    for sample, rows, largest in (("10-250", 5 * 17, 542.5), ("20-300", 6 * 21, 1653.5)):
        points = measurement(library, f"martens-dmsp-{sample}")
        columns = points.si_columns()
        assert len(points.slack) == rows
        assert columns["force"].max() == largest
        assert (columns["force"][np.array(points.slack) == 1] == 0.0).all()


@pytest.mark.parametrize(
    ("flow", "conductance"), [(100, 0.43), (350, 1.50), (700, 3.00), (1400, 6.01), (2000, 8.58)]
)
def test_sonic_conductance_comes_from_the_nominal_flow(
    library: PresetLibrary, flow: float, conductance: float
) -> None:
    b = 0.3
    ratio = (6.0 / 7.0 - b) / (1.0 - b)
    assert flow / 60 * (1.293 / 1.185) / (7 * math.sqrt(1 - ratio**2)) == pytest.approx(conductance, abs=6e-3)
    valves = [preset.to_document() for preset in library.list("valves")]
    rated = [valve["data"] for valve in valves if valve["data"].get("nominal_flow", {}).get("value") == flow]
    assert rated
    for data in rated:
        assert data["nominal_flow"]["unit"] == "l/min"
        assert data["sonic_conductance"]["value"] == pytest.approx(conductance)
        assert Quantity(**data["sonic_conductance"]).si("m^3/(s*Pa)") == pytest.approx(conductance * 1e-8)
        assert not Quantity(**data["sonic_conductance"]).verified
        assert data["critical_pressure_ratio"]["value"] == b
        assert data["critical_pressure_ratio"]["grade"] == "E"


@pytest.mark.parametrize(
    ("tube", "conductance", "ratio"),
    [
        ("PUN-H-4x0.75", 0.42, 0.29),
        ("PUN-H-6x1", 1.20, 0.35),
        ("PUN-H-8x1.25", 2.78, 0.41),
        ("PUN-H-10x1.5", 4.49, 0.43),
    ],
)
def test_tube_conductance_comes_from_its_formula(
    library: PresetLibrary, tube: str, conductance: float, ratio: float
) -> None:
    data = dict(quantities(library.get("tubes", tube)))
    d = data["data.inside_diameter"].si("m")
    length = data["data.reference_length"].si("m")
    C = 0.029 * d**2 / math.sqrt(length / d**1.25 + 510)
    assert data["data.sonic_conductance"].si("m^3/(s*Pa)") == pytest.approx(C, abs=0.006e-8)
    assert data["data.sonic_conductance"].value == pytest.approx(conductance, abs=0.011)
    assert data["data.critical_pressure_ratio"].value == pytest.approx(474 * C / d**2, abs=0.006)
    assert data["data.critical_pressure_ratio"].value == ratio


@pytest.mark.parametrize("tube", ["PUN-H-4x0.75", "PUN-H-8x1.25"])
def test_contradicting_bores_say_so(library: PresetLibrary, tube: str) -> None:
    data = dict(quantities(library.get("tubes", tube)))
    bore = data["data.outside_diameter"].value - 2 * data["data.wall_thickness"].value
    assert data["data.inside_diameter"].value != bore
    assert "contradict" in (data["data.inside_diameter"].note or "")


# --- files that cannot be used


def good() -> dict[str, Any]:
    return json.loads((PRESETS / "muscles" / "DMSP-20.json").read_text(encoding="utf-8"))


def edit(path: str, value: Any) -> Callable[[dict[str, Any]], None]:
    def apply(document: dict[str, Any]) -> None:
        *parents, last = path.split(".")
        for key in parents:
            document = document[key]
        document[last] = value

    return apply


def drop(path: str) -> Callable[[dict[str, Any]], None]:
    def apply(document: dict[str, Any]) -> None:
        *parents, last = path.split(".")
        for key in parents:
            document = document[key]
        del document[last]

    return apply


QUANTITY = {"value": 1, "unit": "mm", "source": "test", "grade": "user"}
EFFECTS = {
    "contraction_factor": {p.name: p for p in default_catalogue()["contraction_factor"].parameters},
    "bladder_elasticity": {
        "shear_modulus": Parameter(
            "shear_modulus",
            "C",
            "Pa",
            default=1e5,
            lower=0.0,
            upper=3e6,
            source=Source("test", "E"),
            description="test",
        ),
        "mooney_constant": Parameter(
            "mooney_constant",
            "C",
            "Pa",
            default=0.0,
            lower=0.0,
            upper=2e6,
            source=Source("test", "E"),
            description="test",
        ),
    },
    "prestress": {"force"},
    "lost_stroke": {"stroke", "reference_length"},
    "dahl": {"force", "break_strain"},
    "viscous_damping": {"coefficient", "length_power"},
}
MUTATIONS: dict[str, tuple[Callable[[dict[str, Any]], None], str, str]] = {
    "unknown key": (edit("geometry.braid_angel", QUANTITY), "geometry.braid_angel", "braid_angle"),
    "unknown top key": (edit("limitz", {}), "limitz", "limits"),
    "unknown key of a value": (edit("limits.max_force.units", "N"), "limits.max_force.units", "unit"),
    "missing value": (drop("geometry.braid_angle"), "geometry.braid_angle", ""),
    "missing unit": (drop("geometry.braid_angle.unit"), "geometry.braid_angle.unit", ""),
    "wrong dimension": (edit("geometry.braid_angle.unit", "mm"), "geometry.braid_angle.unit", "25 deg"),
    "unknown unit": (edit("limits.max_pressure.unit", "barr"), "limits.max_pressure.unit", "6 bar"),
    "unknown unit of free data": (
        edit("data.colour", {**QUANTITY, "unit": "blorps"}),
        "data.colour.unit",
        "mm",
    ),
    "nan": (edit("geometry.braid_angle.value", math.nan), "geometry.braid_angle.value", "finite"),
    "infinite": (edit("data.weight_per_length.value", math.inf), "data.weight_per_length.value", "finite"),
    "text for a number": (edit("limits.max_force.value", "1500"), "limits.max_force.value", ""),
    "yes for a number": (edit("limits.max_force.value", True), "limits.max_force.value", ""),
    "huge number": (edit("limits.max_force.value", 10**400), "limits.max_force.value", ""),
    "number that overflows in Pa": (
        edit("limits.max_pressure.value", 1e308),
        "limits.max_pressure.value",
        "",
    ),
    "angle past the neutral one": (
        edit("geometry.braid_angle.value", 60),
        "geometry.braid_angle.value",
        "between",
    ),
    "no source": (edit("limits.max_force.source", "  "), "limits.max_force.source", ""),
    "unknown grade": (edit("limits.max_force.grade", "X"), "limits.max_force.grade", ""),
    "angle of 95 degrees": (edit("geometry.braid_angle.value", 95), "geometry.braid_angle.value", "between"),
    "negative wall": (edit("geometry.wall_thickness.value", -1), "geometry.wall_thickness.value", "between"),
    "braid below bore": (edit("geometry.braid_diameter.value", 18), "geometry.braid_diameter.value", "bore"),
    "negative tolerance": (edit("tolerance.braid_angle.value", -2), "tolerance.braid_angle.value", "between"),
    "wrong kind": (edit("kind", "valve"), "kind", ""),
    "wrong schema": (edit("schema", 2), "schema", ""),
    "id of another file": (edit("id", "DMSP-21"), "id", "DMSP-21.json"),
    "id with a path": (edit("id", "../DMSP-20"), "id", ""),
    "list for an object": (edit("geometry", []), "geometry", ""),
    "unknown effect": (edit("effects.prestres", {}), "effects.prestres", "prestress"),
    "unknown parameter": (
        edit("effects.prestress", {"forse": QUANTITY}),
        "effects.prestress.forse",
        "force",
    ),
    "parameter of another dimension": (
        edit("effects.bladder_elasticity.shear_modulus.unit", "mm"),
        "effects.bladder_elasticity.shear_modulus.unit",
        "bar",
    ),
    "parameter out of bounds": (
        edit("effects.bladder_elasticity.shear_modulus.value", 5),
        "effects.bladder_elasticity.shear_modulus.value",
        "between",
    ),
    "surrogate": (edit("title", "\ud800"), "title", ""),
    "bad key": (edit("data.Not A Key", QUANTITY), "data.Not A Key", ""),
}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A preset folder with the muscles only."""
    shutil.copytree(PRESETS / "muscles", tmp_path / "presets" / "muscles")
    return tmp_path / "presets"


@pytest.mark.parametrize("name", MUTATIONS)
def test_a_bad_file_is_a_problem_and_the_rest_loads(folder: Path, name: str) -> None:
    change, field, hint = MUTATIONS[name]
    document = good()
    change(document)
    (folder / "muscles" / "DMSP-20.json").write_text(json.dumps(document), encoding="utf-8")
    library = PresetLibrary(folder, effects=EFFECTS)
    problems = [problem for problem in library.problems("muscles") if problem.file == "muscles/DMSP-20.json"]
    assert [problem.field for problem in problems] == [field], problems
    assert problems[0].message
    assert hint in (problems[0].hint or "")
    ids = {preset.id for preset in library.list("muscles")}
    assert "DMSP-20" not in ids
    assert {"DMSP-10", "DMSP-40", "paper", "MAS-20"} <= ids


@pytest.mark.parametrize(
    ("content", "field"),
    [
        (b"", "line 1, column 1"),
        (b'{"schema": 1,', "line 1, column 14"),
        (b"[1, 2]", None),
        (b"\xff\xfe{}", None),
        (b"[" * 200_000, None),
        (b'{"a":' * 900 + b"1" + b"}" * 900, ".".join("a" * 33)),
        (b'{"schema": 1, "schema": 1}', "schema"),
        (b'{"value": ' + b"9" * 5000 + b"}", None),
        (b'"' + b"x" * 1_000_001 + b'"', None),
    ],
    ids=["empty", "cut off", "list", "utf-16", "deep list", "deep object", "twice", "digits", "large"],
)
def test_a_file_that_is_no_document_is_a_problem(folder: Path, content: bytes, field: str | None) -> None:
    (folder / "muscles" / "bad.json").write_bytes(content)
    library = PresetLibrary(folder)
    (problem,) = library.problems()
    assert (problem.file, problem.field) == ("muscles/bad.json", field)
    assert problem.message
    assert len(library.list("muscles")) == len(list((PRESETS / "muscles").glob("*.json")))


def test_ids_that_differ_in_case_only_are_duplicates(folder: Path) -> None:
    (folder / "muscles" / "dmsp-20.json").write_text(
        json.dumps({**good(), "id": "dmsp-20"}), encoding="utf-8"
    )
    library = PresetLibrary(folder)
    (problem,) = library.problems()
    assert problem.field == "id"
    assert "exists already" in problem.message


@pytest.mark.parametrize(
    ("change", "field"),
    [
        (edit("data_columns.force.values", [1.0]), "data_columns.force.values"),
        (edit("data_columns.pressure.unit", "mm"), "data_columns.pressure.unit"),
        (edit("data_columns.force.unit", "K"), "data_columns.force.unit"),
        (edit("excluded", [{"index": 999, "why": "test"}]), "excluded.0.index"),
        (edit("excluded", [{"index": -1, "why": "test"}]), "excluded.0.index"),
        (drop("data_columns.contraction"), "data_columns.contraction"),
    ],
)
def test_a_bad_curve_is_a_problem(
    tmp_path: Path, change: Callable[[dict[str, Any]], None], field: str
) -> None:
    document = json.loads((PRESETS / "curves" / "musclesim-20.json").read_text(encoding="utf-8"))
    change(document)
    (tmp_path / "curves").mkdir()
    (tmp_path / "curves" / "musclesim-20.json").write_text(json.dumps(document), encoding="utf-8")
    (problem,) = PresetLibrary(tmp_path).problems("curves")
    assert (problem.file, problem.field) == ("curves/musclesim-20.json", field)


def test_a_design_carries_any_document(tmp_path: Path) -> None:
    (tmp_path / "designs").mkdir()
    design = {
        "schema": 1,
        "kind": "design",
        "id": "one",
        "title": "One",
        "document": {"muscle": [1, {"a": None}]},
    }
    (tmp_path / "designs" / "one.json").write_text(json.dumps(design), encoding="utf-8")
    assert PresetLibrary(tmp_path).get("designs", "one").to_document()["document"] == design["document"]


# --- example tasks


def sized(path: Path, capsysbinary: pytest.CaptureFixture[bytes]) -> dict[str, Any]:
    """The answer of the command line to an example task."""
    code = cli.run(["size", str(path), "--json"])
    answer = json.loads(capsysbinary.readouterr().out)
    assert code == (0 if answer["proposals"] else NO_DRIVE)
    return answer


@pytest.mark.parametrize("path", TASKS, ids=lambda path: path.stem)
def test_every_example_task_does_what_its_title_says(
    path: Path, capsysbinary: pytest.CaptureFixture[bytes], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("MCKIBBEN_DATA", str(tmp_path))
    preset = json.loads(path.read_text(encoding="utf-8"))
    task = SizingTask.model_validate(preset["document"])
    answer = sized(path, capsysbinary)
    figures = re.findall(r"[\d.]+ ?(?:kg|mm|s|bar|N·m|°)(?! muscle)", preset["title"])
    assert figures
    for figure in figures:
        assert re.search(rf"\b{re.escape(figure)}", answer["about"]), figure
    if path.stem == "too-fast-150kg":
        assert answer["proposals"] == []
        assert {item["binding"] for item in answer["rejected"]} >= {"time", "force"}
        return
    assert answer["proposals"]
    for found in answer["proposals"]:
        assert found["time"] <= (task.time or math.inf) * (1 + 1e-6)
        stroke = found["nominal_length"] * found["contraction"]
        if task.load.pair is None:
            assert stroke == pytest.approx(task.stroke, rel=1e-6)
        else:
            assert stroke == pytest.approx(found["pulley_radius"] * task.load.pair.angle, rel=1e-6)
    if task.catalogue.muscles is not None:
        assert {found["muscle"] for found in answer["proposals"]} <= set(task.catalogue.muscles)


def test_the_tasks_of_the_paper_state_what_it_prints(library: PresetLibrary) -> None:
    for size, time in ((20, 0.19), (10, 0.23)):
        preset = library.get("tasks", f"propneu-{size}")
        assert isinstance(preset, TaskPreset)
        task = SizingTask.model_validate(preset.document)
        assert (task.stroke, task.supply_pressure, task.time) == (0.2, 6e5, time)
        assert task.catalogue.muscles == [f"DMSP-{size}"]
        drive = library.get("drives", f"propneu-{size}").to_document()
        assert preset.document["load"] == {"mass": drive["document"]["load"]["mass"]}
        assert {"stroke", "time", "supply_pressure", "load.mass"} <= set(preset.grounds)
        for name in preset.grounds:
            value: Any = preset.document
            for key in name.split("."):
                value = value[key]


# --- asking


def test_nearest_match_for_an_unknown_id(library: PresetLibrary) -> None:
    with pytest.raises(InputError) as caught:
        library.get("muscles", "DMPS-20")
    assert caught.value.code == "not_found"
    assert "DMSP-20" in (caught.value.hint or "")
    with pytest.raises(InputError, match="kind of preset") as caught:
        library.list("muscle")
    assert (caught.value.code, caught.value.hint) == ("not_found", "Did you mean 'muscles'?")


@pytest.mark.parametrize("asked", ["MPYE-5-1/8-HF", "mpye-5-1/8-hf", "MPYE-5-1-8-HF"])
def test_ids_with_a_slash(library: PresetLibrary, asked: str) -> None:
    assert library.get("valves", asked).id == "MPYE-5-1/8-HF"


def test_effect_values_are_in_si(library: PresetLibrary) -> None:
    assert muscle(library, "DMSP-20").effect_values() == {
        "bladder_elasticity": {"shear_modulus": pytest.approx(0.468e6), "mooney_constant": 0.0},
        "prestress": {"force": 24.7},
        "lost_stroke": {"stroke": pytest.approx(0.013), "reference_length": pytest.approx(0.3)},
        "dahl": {"force": 17.0, "break_strain": pytest.approx(0.002)},
        "viscous_damping": {"coefficient": 192.0, "length_power": 1.0},
    }
    assert muscle(library, "paper").effect_values() == {}


def test_libraries_share_what_no_file_has_changed(folder: Path) -> None:
    one, other = PresetLibrary(folder), PresetLibrary(folder)
    first = one.list("muscles")[0]
    assert other.get("muscles", first.id) is first
    # With effects to check against, it is read again.
    assert PresetLibrary(folder, effects=EFFECTS).get("muscles", first.id) is not first
    path = folder / "muscles" / f"{first.id}.json"
    path.write_text(path.read_text("utf-8").replace('"title": "', '"title": "New '), "utf-8")
    assert PresetLibrary(folder).get("muscles", first.id).title.startswith("New ")
    assert other.get("muscles", first.id) is first


def test_a_missing_folder_is_said_at_once(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError, match="no preset folder"):
        PresetLibrary(tmp_path / "nowhere")
    assert PresetLibrary(tmp_path).list("valves") == []


# --- saving


@pytest.fixture
def own(tmp_path: Path) -> PresetLibrary:
    return PresetLibrary(PRESETS, tmp_path / "user", effects=EFFECTS)


def own_muscle(**changes: Any) -> dict[str, Any]:
    return {**good(), "id": "my-muscle", "title": "Mine", **changes}


def test_a_saved_muscle_is_there_and_comes_back(own: PresetLibrary, tmp_path: Path) -> None:
    saved = own.save_muscle(own_muscle())
    assert saved.origin == "user"
    assert saved.public()["origin"] == "user"
    assert own.get("muscles", "MY-muscle").to_document() == saved.to_document()
    kept = {path.name for path in (tmp_path / "user" / "muscles").iterdir()}
    assert kept - {".lock"} == {"my-muscle.json"}
    again = PresetLibrary(PRESETS, tmp_path / "user")
    assert again.muscle("my-muscle").to_document() == saved.to_document()
    own.save_muscle(own_muscle(title="Mine, second try"))
    assert again.get("muscles", "my-muscle").title == "Mine, second try"


@pytest.mark.parametrize(
    "preset_id",
    ["../x", "a/b", "a.b", "", ".", "-x", "x" * 65, "a\x00b", "ä", "x\n", "con fig", "..\\x"],
)
def test_an_id_that_is_no_plain_name_is_refused(own: PresetLibrary, tmp_path: Path, preset_id: str) -> None:
    with pytest.raises(InputError) as caught:
        own.save_muscle(own_muscle(id=preset_id))
    assert caught.value.field == "id"
    assert not (tmp_path / "user").exists()


@pytest.mark.parametrize("preset_id", ["DMSP-20", "dmsp-20", "PAPER"])
def test_built_in_muscles_cannot_be_overwritten(own: PresetLibrary, preset_id: str) -> None:
    with pytest.raises(InputError, match="taken by a built-in") as caught:
        own.save_muscle(own_muscle(id=preset_id))
    assert (caught.value.code, caught.value.field) == ("conflict", "id")


def test_saving_needs_a_user_folder(library: PresetLibrary) -> None:
    with pytest.raises(InputError, match="no user folder") as caught:
        library.save_muscle(own_muscle())
    assert caught.value.code == "conflict"


@pytest.mark.parametrize("name", [name for name in MUTATIONS if not name.startswith("id ")])
def test_a_bad_muscle_is_not_saved(own: PresetLibrary, tmp_path: Path, name: str) -> None:
    change, field, _ = MUTATIONS[name]
    document = own_muscle()
    change(document)
    with pytest.raises(InputError) as caught:
        own.save_muscle(document)
    assert caught.value.field == field
    assert not (tmp_path / "user").exists()


def test_a_link_is_replaced_and_never_followed(own: PresetLibrary, tmp_path: Path) -> None:
    outside = tmp_path / "outside.json"
    outside.write_text("precious", encoding="utf-8")
    muscles = tmp_path / "user" / "muscles"
    muscles.mkdir(parents=True)
    (muscles / "my-muscle.json").symlink_to(outside)
    (problem,) = own.problems("muscles")
    assert (problem.file, problem.field) == ("user/muscles/my-muscle.json", None)
    assert "plain file" in problem.message
    own.save_muscle(own_muscle())
    assert outside.read_text(encoding="utf-8") == "precious"
    assert not (muscles / "my-muscle.json").is_symlink()
    assert own.problems("muscles") == []


def test_a_linked_folder_is_not_written_to(own: PresetLibrary, tmp_path: Path) -> None:
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    (tmp_path / "user").mkdir()
    (tmp_path / "user" / "muscles").symlink_to(elsewhere, target_is_directory=True)
    with pytest.raises(InputError, match="link"):
        own.save_muscle(own_muscle())
    assert list(elsewhere.iterdir()) == []


def test_a_folder_that_cannot_be_written_is_said(tmp_path: Path) -> None:
    (tmp_path / "user").write_text("a file, not a folder", encoding="utf-8")
    with pytest.raises(InputError, match="cannot be written") as caught:
        PresetLibrary(PRESETS, tmp_path / "user").save_muscle(own_muscle())
    assert caught.value.code == "conflict"


def test_changes_of_user_files_are_seen(own: PresetLibrary, tmp_path: Path) -> None:
    own.save_muscle(own_muscle())
    path = tmp_path / "user" / "muscles" / "my-muscle.json"
    path.write_text("{", encoding="utf-8")
    assert [problem.file for problem in own.problems("muscles")] == ["user/muscles/my-muscle.json"]
    path.write_text(json.dumps(own_muscle(title="Edited by hand")), encoding="utf-8")
    os.utime(path, ns=(1, 1))
    assert own.get("muscles", "my-muscle").title == "Edited by hand"
    path.unlink()
    with pytest.raises(InputError, match="no preset 'my-muscle'"):
        own.get("muscles", "my-muscle")


def test_a_user_file_cannot_shadow_a_built_in(own: PresetLibrary, tmp_path: Path) -> None:
    (tmp_path / "user" / "muscles").mkdir(parents=True)
    (tmp_path / "user" / "muscles" / "DMSP-20.json").write_text(
        json.dumps({**good(), "title": "False"}), encoding="utf-8"
    )
    assert own.get("muscles", "DMSP-20").title == "Festo DMSP-20"
    assert [problem.field for problem in own.problems("muscles")] == ["id"]
