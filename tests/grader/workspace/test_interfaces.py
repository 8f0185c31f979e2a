"""Packages of interfaces: which definitions are built, and what a type of them is."""

import sys

import pytest

from grader.exercises.launching.keeper.crates import INTERFACES
from grader.workspace import judge_types
from grader.workspace.building import Built, build
from grader.workspace.interfaces import MODULES, package_name, type_hash
from grader.workspace.package import make_package, with_interfaces
from grader.workspace.package_xml import CMAKE
from sim.ros.remote.validation import ProtocolError, valid_interface
from tests.exercises.launching.crates import students as crates
from tests.exercises.packages.greeter import students as greeter


def encoded(files):
    return {path: text.encode() for path, text in files.items()}


RIGHT, GREETER = encoded(crates.RIGHT), encoded(greeter.RIGHT)


def with_cmake(text):
    return {**RIGHT, crates.CMAKE: text.encode()}


def test_only_a_package_that_cmake_builds_is_one_of_interfaces():
    assert package_name(RIGHT) == "crate_interfaces"
    assert package_name(GREETER) == ""
    assert package_name({**RIGHT, "crate_interfaces/setup.py": b""}) == ""
    assert package_name({"a/b/CMakeLists.txt": b""}) == ""


def test_the_courses_own_types_are_those_of_the_right_package():
    built = build(INTERFACES.sources)
    assert (built.problem, INTERFACES.difference(built.files)) == ("", "")
    assert "share/crate_interfaces/srv/FindCrates.srv" in built.files
    assert not [path for path in built.files if path.endswith((".c", ".h"))]


@pytest.mark.parametrize(
    ("sources", "problem"),
    [
        (with_cmake("project(a)"), "CMakeLists.txt names no definition."),
        (with_cmake("# msg/Crate.msg"), "CMakeLists.txt names no definition."),
        (with_cmake("msg/Num.msg"), "CMakeLists.txt names msg/Num.msg, but there is no such file."),
        (with_cmake("msg/Crate.msg"), "rosidl_generate_interfaces has no DEPENDENCIES geometry_msgs."),
        ({**RIGHT, crates.CRATE: b"float64 Mass"}, "The types could not be built."),
    ],
)
def test_a_package_that_cmake_would_not_build_is_not_built(sources, problem):
    built = build(sources)
    assert (built.problem, built.files) == (problem, {})


def test_a_hash_that_can_not_be_read_is_none():
    path = "share/a/msg/B.json"
    assert [type_hash({path: text}, "a", "msg/B") for text in (b"{}", b"[", b'{"type_hashes": []}')] == [
        ""
    ] * 3


def made(**files):
    """The package of a greeter with the built files of an interface package."""
    package = make_package("greeter", GREETER, lambda _: Built({"lib/greeter/hello": b""}))
    return with_interfaces(package, INTERFACES, RIGHT, lambda _: Built(**files))


def test_types_that_are_not_those_of_the_task_are_a_fault():
    fault = made(files={})
    assert (fault.expected, fault.saw, fault.hint, fault.sentence, fault.before_start) == (
        "crate_interfaces with the types that the task describes",
        "Crate is not built",
        "Earn the points for crate_interfaces first: the check there shows what is missing.",
        "The types that your package uses are built.",
        True,
    )
    assert made(problem="The types could not be built.").saw == "The types could not be built."


def test_a_package_of_interfaces_that_can_not_be_built_is_judged_by_its_sources():
    found = make_package("crate_interfaces", RIGHT, lambda _: Built(problem="No."), CMAKE)
    assert found.built.problem == "No."


@pytest.fixture
def without_types(monkeypatch):
    """A process that hasn't got the course's types yet, whatever ran in it before."""
    provided = [str(folder / MODULES) for folder in judge_types._provided.values()]
    monkeypatch.setattr(judge_types, "_provided", {})
    monkeypatch.setattr(sys, "path", [folder for folder in sys.path if folder not in provided])
    for name in [name for name in sys.modules if name.partition(".")[0] == "crate_interfaces"]:
        monkeypatch.delitem(sys.modules, name)
    valid_interface.cache_clear()
    yield
    valid_interface.cache_clear()
    for name in [name for name in sys.modules if name.partition(".")[0] == "crate_interfaces"]:
        del sys.modules[name]


@pytest.mark.usefixtures("without_types")
def test_types_that_the_course_can_not_build_are_a_mistake_of_the_course():
    with pytest.raises(RuntimeError, match=r"^The course's own crate_interfaces can't be built: No\.\nmore$"):
        judge_types.provide(INTERFACES, lambda _: Built(problem="No.", output="more"))


@pytest.mark.usefixtures("without_types")
def test_a_judge_decodes_with_types_of_its_own():
    with pytest.raises(
        ProtocolError, match=r"^the type crate_interfaces/msg/Crate, which is not installed here$"
    ):
        valid_interface("crate_interfaces/msg/Crate", "msg")
    builds = []
    for _ in range(2):
        judge_types.provide(INTERFACES, lambda sources: builds.append(1) or build(sources))
    assert len(builds) == 1
    assert valid_interface("crate_interfaces/msg/Crate", "msg")(label="oak").label == "oak"
