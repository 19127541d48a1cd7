"""What a maintainer relies on is true: pinned versions, changelog, citation, the paths in CONTRIBUTING."""

from __future__ import annotations

import re
import subprocess
import sys
import tomllib
import zipfile
from importlib.metadata import PackageNotFoundError, requires, version
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from mckibben import __version__

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
# Where the versions were pinned; the answer must not depend on the machine that asks.
PINNED_ON = {
    "os_name": "posix", "sys_platform": "linux", "platform_system": "Linux", "platform_machine": "x86_64",
    "python_version": "3.11", "python_full_version": "3.11.7", "implementation_name": "cpython",
    "platform_python_implementation": "CPython",
}  # fmt: skip
PINNED = re.compile(r"([A-Za-z0-9][A-Za-z0-9._-]*)==([0-9][A-Za-z0-9.!+]*)")


def pinned() -> dict[str, str]:
    """Name -> version of `constraints.txt`."""
    lines = (ROOT / "constraints.txt").read_text("utf-8").splitlines()
    found = [(line, PINNED.fullmatch(line)) for line in lines if not line.startswith("#")]
    wrong = [line for line, match in found if match is None]
    assert not wrong, f"only name==version, no hosts, no options: {wrong}"
    return {canonicalize_name(match[1]): match[2] for _, match in found if match}


def wanted() -> dict[str, list[Requirement]]:
    """Name -> requirements of the project with its tests, and of what these bring along where it was pinned.

    Another version than the pinned one may bring along something else, and is not asked.
    """
    texts = [*PROJECT["dependencies"], *PROJECT["optional-dependencies"]["test"]]
    versions = pinned()
    open_ = [Requirement(text) for text in texts]
    found: dict[str, list[Requirement]] = {}
    seen = set()
    while open_:
        requirement = open_.pop()
        name = canonicalize_name(requirement.name)
        found.setdefault(name, []).append(requirement)
        key = (name, frozenset(requirement.extras))
        if key not in seen and versions.get(name) == installed(name):
            seen.add(key)
            further = [Requirement(text) for text in requires(name) or ()]
            open_ += [each for each in further if applies(each, requirement.extras)]
    return found


def installed(name: str) -> str:
    """The version on this machine."""
    try:
        return version(name)
    except PackageNotFoundError:
        return ""


def applies(requirement: Requirement, extras: set[str]) -> bool:
    """Whether a package with these extras needs it."""
    marker = requirement.marker
    return marker is None or any(marker.evaluate({**PINNED_ON, "extra": e}) for e in ("", *extras))


def test_every_package_that_is_installed_for_the_tests_is_pinned() -> None:
    missing = sorted(wanted().keys() - pinned().keys())
    assert not missing, f"constraints.txt lacks: {missing}"


def test_pinned_versions_are_those_that_the_project_allows() -> None:
    versions = pinned()
    wrong = [
        f"{name}=={versions[name]} is not {requirement}"
        for name, requirements in wanted().items()
        for requirement in requirements
        if name in versions and not requirement.specifier.contains(versions[name], prereleases=True)
    ]
    assert not wrong, "\n".join(wrong)


def test_the_changelog_begins_with_this_version_and_its_date() -> None:
    heads = re.findall(r"^## (.*)$", (ROOT / "CHANGELOG.md").read_text("utf-8"), re.MULTILINE)
    released = [head for head in heads if head != "Unreleased"]
    assert all(re.fullmatch(r"\d+\.\d+\.\d+ - \d{4}-\d\d-\d\d", head) for head in released)
    assert heads[: len(heads) - len(released)] in ([], ["Unreleased"])
    number, date = released[0].split(" - ")
    assert number == __version__
    citation = (ROOT / "CITATION.cff").read_text("utf-8")
    assert f"\nversion: {number}\n" in citation
    assert f"\ndate-released: {date}\n" in citation
    assert f"\nlicense: {PROJECT['license']}\n" in citation


def test_each_promise_of_security_names_the_test_that_proves_it() -> None:
    text = (ROOT / "SECURITY.md").read_text("utf-8")
    promises = re.findall(r"^- .*?(?=\n- |\n\n)", text, re.MULTILINE | re.DOTALL)
    assert len(promises) > 20
    for promise in promises:
        named = re.findall(r"`([a-z0-9_/]+\.py)::(test_[a-z0-9_]+)`", promise)
        assert named, promise
        for file, test in named:
            found = (ROOT / "tests" / file).read_text("utf-8")
            assert re.search(rf"^(async )?def {test}\(", found, re.MULTILINE), f"{file}::{test}"


def test_files_and_commands_that_are_named_exist() -> None:
    for document in ("CONTRIBUTING.md", "SECURITY.md"):
        text = (ROOT / document).read_text("utf-8")
        paths = re.findall(r"[`\s]((?:backend|frontend|tests|presets|\.ci)/[\w./]*\w)", text)
        paths += re.findall(r"`((?:physics|application|cli|server)/[\w./]+\.py)`", text)
        roots = (ROOT, ROOT / "backend" / "mckibben", ROOT / "tests")
        absent = [path for path in paths if not any((root / path).exists() for root in roots)]
        assert not absent, f"{document}: {absent}"


@pytest.mark.examination(
    "tests/simulation/integrate/test_first_use.py::test_the_first_answer_compiles_no_integrator"
)
def test_a_wheel_brings_the_compiled_integrators(tmp_path: Path) -> None:
    """An editable installation has them in its place: only a wheel can lose them on the way."""
    where = ["--wheel-dir", str(tmp_path), str(ROOT)]
    subprocess.run([sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", *where], check=True)
    (wheel,) = tmp_path.glob("mckibben-*.whl")
    names = zipfile.ZipFile(wheel).namelist()
    code = [name for name in names if name.startswith("mckibben/_data/compiled/code/")]
    assert len([name for name in code if not name.endswith(".lock")]) >= 4
