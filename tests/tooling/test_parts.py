"""The parts of the course: each imports what its pyproject.toml names, and the whole is their sum."""

import functools
import itertools
import re
import subprocess
import sys
import tomllib
import zipfile
from collections.abc import Iterable
from importlib import metadata
from pathlib import Path

import pytest
from packaging.requirements import Requirement

from tests.tooling.test_ci import ROOT, load
from tests.tooling.test_layers import imports

parts = load("parts")
PARTS = parts.find_parts(ROOT)
TESTED = [name for name, part in PARTS.items() if part.tests]
# Colab's own module, which is imported only there; and the package that an exercise's students build.
ELSEWHERE = {"google", "crate_interfaces"}
# What builds the lidar, a part of its own.
RAYS = {"sim/world/rays/rays.py", "sim/world/rays/setup.py"}
MODULES = metadata.packages_distributions()


def settings(folder: str) -> dict:
    return tomllib.loads((ROOT / folder / "pyproject.toml").read_text("utf-8"))


def plain(name: str) -> str:
    """A distribution's name as indexes write it."""
    return re.sub(r"[-_.]+", "-", name).lower()


def named(part, *, builds: bool = False) -> list[Requirement]:
    """What a part's pyproject.toml requires, the optional ones, too. builds: and what it is built with."""
    read = settings(part.folder)
    optional = read["project"].get("optional-dependencies", {}).values()
    lines = [*read["project"]["dependencies"], *itertools.chain(*optional)]
    return [Requirement(line) for line in lines + builds * read["build-system"]["requires"]]


def names(requirements: Iterable[Requirement]) -> set[str]:
    return {plain(each.name) for each in requirements}


def closure(requirements: Iterable[Requirement]) -> set[str]:
    """The distributions that are installed with these requirements, as far as they are installed here."""
    found: set[tuple[str, str]] = set()
    more = {(plain(each.name), extra) for each in requirements for extra in ("", *each.extras)}
    while more:
        found |= more
        needed = itertools.chain(*(required(*each) for each in more))
        more = {(plain(each.name), extra) for each in needed for extra in ("", *each.extras)} - found
    return {name for name, _ in found}


def required(name: str, extra: str) -> list[Requirement]:
    """What an installed distribution requires with this extra."""
    try:
        lines = metadata.requires(name) or []
    except metadata.PackageNotFoundError:
        return []
    found = map(Requirement, lines)
    return [each for each in found if each.marker is None or each.marker.evaluate({"extra": extra})]


@functools.cache
def available(name: str) -> set[str]:
    """The distributions that are installed where only this part is, with what it names."""
    needed = [PARTS[other] for other in PARTS[name].needs(PARTS)]
    return closure(itertools.chain(*(named(part, builds=True) for part in needed)))


def sources(part) -> dict[str, str]:
    """The sources of a part's modules, by file."""
    files = [path.relative_to(ROOT).as_posix() for path in (ROOT / part.folder).rglob("*.py")]
    own = [file for file in files if parts.owner(file, PARTS) == part]
    return {file: (ROOT / file).read_text("utf-8") for file in own}


@functools.cache
def of_the_course() -> dict[str, str]:
    """The part of each package and module of the course that can be imported."""
    found = {}
    for part in PARTS.values():
        folder = ROOT / part.folder
        top = folder if part.folder.startswith("ros_packages/") else ROOT
        for file in sources(part):
            path = Path(file.removesuffix(".py").removesuffix("/__init__"))
            found[".".join((ROOT / path).relative_to(top).parts)] = part.name
    return found


def foreign(name: str, file: str, source: str) -> list[str]:
    """A line for each import of a module that is not there where only this part is installed."""
    found = []
    for module in imports(source):
        whose = of_the_course().get(module) or of_the_course().get(module.split(".")[0])
        top = module.split(".")[0]
        beside = (ROOT / file).parent.joinpath(f"{top}.py").exists()
        if top in sys.stdlib_module_names or top in ELSEWHERE or (beside and whose is None):
            continue
        if whose is not None and whose in PARTS[name].needs(PARTS):
            continue
        if whose is None and {plain(each) for each in MODULES.get(top, [top])} & available(name):
            continue
        found.append(f"{file} imports {module}")
    return found


@pytest.mark.parametrize("name", TESTED)
def test_a_part_imports_only_what_it_names(name):
    part = PARTS[name]
    assert [line for file, source in sources(part).items() for line in foreign(name, file, source)] == []


def test_an_import_that_a_part_does_not_name_is_found():
    source = "import numpy\ndef f():\n    import nbgrader.utils\n    from grader.checks import check\n"
    lines = foreign("ros2-course-sim", "sim/world/robot.py", source)
    assert lines == ["sim/world/robot.py imports nbgrader.utils", "sim/world/robot.py imports grader.checks"]
    upward = "from grader.marking.extras.hub import cli\nfrom grader.checks import check\n"
    assert foreign("ros2-course-marking", "grader/marking/task.py", upward) == [
        "grader/marking/task.py imports grader.marking.extras.hub"
    ]


def test_each_part_stands_on_those_before_it():
    assert {name: sorted(part.needs(PARTS) - {name}) for name, part in PARTS.items()} == {
        "ros2-course-interfaces": [],
        "ros2-course-lidar": [],
        "ros2-course-packages": ["ros2-course-interfaces"],
        "ros2-course-sim": (sim := ["ros2-course-interfaces", "ros2-course-lidar", "ros2-course-packages"]),
        "ros2-course-grader": (grader := [*sim, "ros2-course-sim"]),
        "ros2-course-marking": (marking := ["ros2-course-grader", *grader]),
        "ros2-course-extras": sorted(["ros2-course-marking", *marking]),
    }


def test_each_test_of_sim_grader_and_ros_packages_is_of_one_part():
    """Those of the whole are in the other folders of tests/."""
    listed = {word.removeprefix("--ignore=") for name in TESTED for word in PARTS[name].tests}
    assert {f"tests/{room}" for room in ("ros_packages", "sim", "grader", "exercises", "marking")} <= listed
    assert [word for word in listed if not (ROOT / word).exists()] == []


def test_the_whole_names_what_its_parts_name():
    """And JupyterLab, and what only pages of course/bridge/ import. The site has its own environment."""
    whole = settings(".")["project"]
    extras = whole["optional-dependencies"]
    everything = [Requirement(line) for line in [*whole["dependencies"], *itertools.chain(*extras.values())]]
    of_parts = names(itertools.chain(*map(named, PARTS.values())))
    assert names(everything) - of_parts == {"jupyterlab", *extras["bridge"]}
    site = settings("grader/marking")["project"]["optional-dependencies"]["site"]
    assert of_parts - closure(everything) - set(PARTS) == set(site)
    assert site == settings(".")["dependency-groups"]["site"]


def test_the_whole_has_the_entry_points_of_its_parts():
    found: dict[str, dict[str, str]] = {}
    for part in PARTS.values():
        for group, entries in settings(part.folder)["project"].get("entry-points", {}).items():
            found.setdefault(group, {}).update(entries)
    assert settings(".")["project"]["entry-points"] == found


def test_a_file_belongs_to_the_innermost_part_around_it():
    marking = "grader/marking/extras/hub/cli.py", "grader/marking/task.py"
    files = (*marking, "grader/score.py", "tests/ports.py")
    owners = [parts.owner(file, PARTS) for file in files]
    assert [part and part.name for part in owners] == [
        *("ros2-course-extras", "ros2-course-marking", "ros2-course-grader", None)
    ]


def test_a_copy_for_a_part_has_no_file_of_those_above_it(tmp_path):
    parts.copy_files(PARTS["ros2-course-sim"], PARTS, tmp_path)
    assert (tmp_path / "sim/ros/run.py").exists() and (tmp_path / "ros_packages/python/launch").exists()
    assert (tmp_path / "tests/grader/test_score.py").exists()
    assert not (tmp_path / "grader").exists()


def test_a_part_that_is_not_there_is_refused_with_those_that_are(monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["parts", "hub"])
    with pytest.raises(SystemExit):
        parts.main()
    assert capsys.readouterr().err.splitlines()[-1] == (
        ".ci/parts: error: there is no part hub with tests: name one of ros_packages/interfaces, "
        "ros_packages/python, sim, grader, grader/marking, grader/marking/extras"
    )


@pytest.mark.soak
def test_each_part_is_a_wheel_and_together_they_have_all_commands(tmp_path):
    """In an environment that has these wheels, and nothing of this folder."""
    wheels, found = tmp_path / "wheels", []
    pure = [PARTS[name] for name in TESTED if name != "ros2-course-interfaces"]
    for part in pure:
        build = [parts.BIN / "uv", "--no-config", "build", "--quiet", "--wheel", "--out-dir", wheels]
        subprocess.run([*build, ROOT / part.folder], check=True)
        with zipfile.ZipFile(next(wheels.glob(f"{part.name.replace('-', '_')}-*.whl"))) as archive:
            found.append({name for name in archive.namelist() if ".dist-info/" not in name})
        assert {file.removeprefix("ros_packages/python/") for file in sources(part)} - found[-1] <= RAYS
    assert sum(map(len, found)) == len(set().union(*found))
    python = tmp_path / "environment" / "bin" / "python"
    parts.install([*wheels.glob("*.whl")], pure[-1].needs(PARTS), [], python)
    shown = subprocess.check_output([python, "-m", "grader", "--help"], cwd=tmp_path, text=True)
    assert shown.endswith("likeness, mark, mark-one, platform, receipts, variants, verify\n")
    line = "from grader.exercises import nodes; print(nodes.hello.points)"
    assert subprocess.check_output([python, "-c", line], cwd=tmp_path, text=True) == "10.0\n"
