"""Advice on a package's programs: packages of the score pages earn each of them."""

import re

import pytest

from grader.diagnosis import find_fault
from grader.diagnosis.error_advice import advice
from grader.diagnosis.package_rules import PACKAGE_RULES, own_module
from sim import run
from sim.evidence import CallbackError, Recording
from sim.ros.workspaces import INDEX, LAYOUT
from tests.exercises.score_tables import graded_exercises, page

HINTS = {
    line.removeprefix("  Hint: ")
    for folder in ("11_packages", "11b_launching", "11c_testing")
    for exercise in graded_exercises(folder)
    for block in page(folder.partition("_")[2], exercise).values()
    for line in block.splitlines()
    if line.startswith("  Hint: ")
}


@pytest.mark.parametrize("rule", PACKAGE_RULES, ids=lambda rule: f"{rule.type} {rule.pattern[:20]}")
def test_each_advice_is_earned(rule):
    pattern = re.sub(r"\\{\d(!r)?\\}", ".+", re.escape(rule.advice))
    assert any(re.fullmatch(pattern, hint) for hint in HINTS)


@pytest.mark.parametrize(
    "words", ["The full name of a package's module", "patrol.driver has no mian", "was not installed"]
)
def test_each_advice_on_own_modules_is_earned(words):
    assert any(words in hint for hint in HINTS)


def test_elsewhere_a_module_that_is_not_there_has_its_usual_advice():
    error = CallbackError(0.0, "/n", "main", "ModuleNotFoundError", "No module named 'speeds'", "")
    assert own_module(error, Recording()) == ""
    assert advice(error).startswith("Python can't find a module `speeds`")


@pytest.mark.parametrize(
    ("arguments", "hint"),
    {
        "turtlesim multism.launch.py": "Is the name misspelled? Write multisim.launch.py.",
        "turtlesmi multisim.launch.py": "Is the name misspelled? Write turtlesim.",
        "zzz.launch.py": "The path is relative to the folder that is named; `ls` shows what is there.",
        "turtlesim zzz.launch.py": "zzz.launch.py was not installed. In setup.py, data_files needs "
        "('share/' + package_name + '/launch', glob('launch/*')).",
    }.items(),
)
def test_a_launch_file_that_is_not_found_gets_advice(arguments, hint, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert find_fault(run(arguments, seconds=1, quiet=True)).hint == hint


FIND = "In setup.py, packages=find_packages(exclude=['test']) finds each folder that has an __init__.py."
CMAKE = "find_package(ament_cmake_python REQUIRED)\n"
UNINSTALLED = [
    ({"setup.py": "packages=['foo']"}, "foo.sub", f"foo/sub/__init__.py was not installed. {FIND}"),
    ({"setup.py": "packages=['foo']"}, "foo.sub.a", f"foo/sub/a.py was not installed. {FIND}"),
    ({"setup.py": "packages=[]"}, "foo", f"foo/__init__.py was not installed. {FIND}"),
    (
        {"setup.py": "packages=find_packages()", "foo/sub/__init__.py": None},
        "foo.sub",
        "foo/sub has no __init__.py, so its modules are not installed: add an empty file of that name, and "
        "build again.",
    ),
    (
        {"setup.py": "packages=find_packages()"},
        "foo.sub",
        "foo/sub/__init__.py was not installed. If it is newer than the last build, run colcon build again.",
    ),
    (
        {"CMakeLists.txt": f"{CMAKE}ament_python_install_package(foo)"},
        "foo.sub.a",
        "foo/sub/a.py was not installed. If it is newer than the last build, run colcon build again.",
    ),
    (
        {"CMakeLists.txt": "find_package(ament_cmake REQUIRED)"},
        "foo",
        "foo/__init__.py was not installed. In CMakeLists.txt, ament_python_install_package(${PROJECT_NAME}) "
        "installs the folder foo/, after find_package(ament_cmake_python REQUIRED).",
    ),
    ({"setup.py": "packages=['foo']"}, "foo.sbu", ""),
]


@pytest.mark.parametrize(("files", "module", "hint"), UNINSTALLED)
def test_a_module_that_a_built_package_left_out_is_found_in_its_sources(
    files, module, hint, tmp_path, monkeypatch
):
    built = tmp_path / "install/foo"
    (built / INDEX / "packages").mkdir(parents=True)
    (built / INDEX / "packages/foo").write_text("")
    (tmp_path / "install" / LAYOUT).write_text("isolated\n")
    code = {"foo/__init__.py": "", "foo/sub/__init__.py": "", "foo/sub/a.py": "def main(): pass\n"}
    for path, text in {"package.xml": "<package><name>foo</name></package>", **code, **files}.items():
        if text is not None:
            file = tmp_path / "src/foo_package" / path
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(built))
    error = CallbackError(0.0, "", "a", "ModuleNotFoundError", f"No module named '{module}'", "")
    assert own_module(error, Recording()) == hint
