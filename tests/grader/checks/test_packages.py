"""Measures over a package's files."""

import pytest

from grader import Missed
from grader.checks.packages import (
    build_warnings,
    builds_without_warnings,
    imports,
    imports_by_its_name,
    installs_by_itself,
    installs_only_its_name,
    names_what_it_imports,
    package_of,
    parsed,
    starts_a_node,
)
from grader.workspace.building import CUT, Built
from grader.workspace.package import Package, PackageRun
from grader.workspace.package_xml import PackageXml
from sim import Recording
from sim.evidence import CallbackError, Endpoint, Graph

MODULES = "lib/python3.12/site-packages"


def packaged(sources=(), depend=(), output="", installed=()):
    """A run of the package `patrol` with these sources, as pairs of a path below it and a text.

    installed: its files in install/, in the same form; those in lib/patrol are programs.
    """
    files = {f"patrol/{path}": text.encode() for path, text in dict(sources).items()}
    there = {path: text.encode() for path, text in dict(installed).items()}
    built = Built(there, frozenset(path for path in there if path.startswith("lib/patrol/")), output)
    package = Package(files, PackageXml("patrol", {"depend": frozenset(depend)}), built)
    return PackageRun.of(Recording(), package)


def missed(function, *arguments):
    with pytest.raises(Missed) as caught:
        function(*arguments)
    return caught.value


@pytest.mark.parametrize("run", [Recording(), PackageRun()])
def test_a_run_without_a_package_is_the_authors_mistake(run):
    with pytest.raises(ValueError, match=r"^this exercise has no package: give it one$"):
        package_of(run)


SOURCES = {
    "patrol/node.py": "import rclpy\nimport math\nfrom geometry_msgs.msg import Twist\nfrom . import parts",
    "launch/all.launch.py": "from launch import LaunchDescription\nimport launch_ros.actions\nimport my_interfaces",
    "patrol/rclpy_helpers.py": "import rclpyx, std_srvs.srv, tf2_ros",
    "setup.py": "import sensor_msgs",
    "test/test_node.py": "import nav_msgs",
    "tests/test_more.py": "import nav_msgs",
    "README.md": "import nav_msgs",
}
WANTED = ["geometry_msgs", "launch", "launch_ros", "my_interfaces", "rclpy", "std_srvs", "tf2_ros"]


def test_a_package_names_what_its_modules_and_launch_files_import_of_ros():
    names_what_it_imports(packaged(SOURCES, WANTED))
    miss = missed(names_what_it_imports, packaged(SOURCES, WANTED[2:]))
    assert miss.expected == f"<depend> or <exec_depend> for each of {', '.join(WANTED)} in package.xml"
    assert miss.saw == "none for geometry_msgs, launch"
    assert miss.hint == (
        "Anyone who installs your package gets only what package.xml names. Here all of ROS is installed, so it runs anyway. Add <depend>geometry_msgs</depend>."
    )


@pytest.mark.parametrize(
    ("line", "pair", "what"),
    [
        (
            "WARNING: package.xml: doesn't explicitly install a marker",
            "('share/ament_index/resource_index/packages', ['resource/patrol'])",
            "marker",
        ),
        ("WARNING: doesn't explicitly install the 'package.xml' file", "('share/patrol', ['package.xml'])", "package.xml"),
        ("WARNING: doesn't explicitly install something", "('share/patrol', ['package.xml'])", "package.xml"),
    ],
)
def test_a_package_installs_itself_what_colcon_would_add(line, pair, what):
    miss = missed(installs_by_itself, packaged(output=f"Starting >>> patrol\n{line}\nFinished <<< patrol\n"))
    assert miss.expected == f"{pair} in data_files"
    assert miss.saw == f"none: colcon installed it instead, and warns that it won't always ({what})"
    assert miss.hint == "Add this pair to data_files in setup.py, with a comma after it."


def test_a_package_that_installs_all_itself_passes():
    installs_by_itself(packaged(output="Starting >>> patrol\nFinished <<< patrol\n"))


OLD_OPTION = "/x/dist.py:289: UserWarning: Unknown distribution option: 'tests_require'\n  warnings.warn(msg)\n"
DASH = "/x/dist.py:599: SetuptoolsDeprecationWarning: Invalid dash-separated key 'script-dir' in 'develop'\n!!\n"


def test_a_warning_of_the_build_counts_once():
    run = packaged(output=f"Starting >>> patrol\n{OLD_OPTION}{DASH}{OLD_OPTION}warning: build_py: skipping.\n")
    assert build_warnings(package_of(run)) == [
        "Unknown distribution option: 'tests_require'",
        "Invalid dash-separated key 'script-dir' in 'develop'",
    ]
    miss = missed(builds_without_warnings, run)
    assert (miss.expected, miss.saw) == (
        "no warning of colcon build",
        "“Unknown distribution option: 'tests_require'”",
    )
    assert miss.about == ("Unknown distribution option: 'tests_require'",)


def test_a_build_that_hides_its_warnings_has_not_got_rid_of_them():
    builds_without_warnings(packaged({"setup.py": "import setuptools"}, output="Finished <<< patrol\n"))
    miss = missed(builds_without_warnings, packaged({"setup.py": "from warnings import filterwarnings"}))
    assert (miss.saw, miss.about) == ("a setup.py that imports warnings, to hide them", ("",))


@pytest.mark.parametrize(
    ("setup", "name"),
    [
        ("import sys\nsys.modules['warn' + 'ings'].simplefilter('ignore')", "sys"),
        ("import os\nos.dup2(1, 2)", "os.dup2"),
        ("import os\nvars(os)['dup2'](1, 2)", "vars"),
        ("from importlib import import_module", "importlib"),
        ("__import__('warnings')", "__import__"),
    ],
)
def test_a_setup_that_could_hide_a_warning_is_named(setup, name):
    miss = missed(builds_without_warnings, packaged({"setup.py": setup}))
    assert miss.expected == "a setup.py that calls setup(...), and nothing else"
    assert miss.saw == f"“{name}” in it"
    assert miss.about == ("",)


def test_a_setup_that_looks_for_files_hides_nothing():
    setup = "import os\nfrom glob import glob\nfrom pathlib import Path\nglob(os.path.join('launch', '*'))"
    builds_without_warnings(packaged({"setup.py": setup}))


@pytest.mark.parametrize("check", [installs_by_itself, builds_without_warnings])
def test_an_output_of_which_a_part_is_left_out_is_too_long(check):
    miss = missed(check, packaged(output=f"no matter{CUT}Finished <<< patrol\n"))
    assert (miss.expected, miss.saw) == ("the output of a build, which is short", "more than 50 kB")
    assert miss.hint == "Print nothing in setup.py."


def test_a_program_that_runs_no_node_and_has_no_error_does_nothing():
    run = packaged()
    miss = missed(starts_a_node, run)
    assert (miss.expected, miss.saw) == ("a program that runs a node", "no node")
    assert miss.hint == "What files say counts once a program runs."
    run.errors = [CallbackError(0.0, "", "main", "ValueError", "", "")]
    starts_a_node(run)
    run.errors, run.graph = [], Graph(["/probe", "/hello"])
    run.course_nodes = {"/probe"}
    starts_a_node(run)


def test_what_is_imported_by_a_function_is_what_the_nodes_use():
    run = packaged({"patrol/node.py": "from importlib import import_module"}, depend=["rclpy"])
    run.graph = Graph(
        ["/a"],
        [
            Endpoint("publisher", "/a", "/x", "std_msgs/msg/String", {}),
            Endpoint("publisher", "/a", "/tf", "tf2_msgs/msg/TFMessage", {}),
            Endpoint("service", "/a", "/a/get_parameters", "rcl_interfaces/srv/GetParameters", {}),
            Endpoint("publisher", "/b", "/y", "nav_msgs/msg/Path", {}, from_course=True),
        ],
    )
    miss = missed(names_what_it_imports, run)
    assert miss.expected == "<depend> or <exec_depend> for each of rclpy, std_msgs in package.xml"
    assert miss.saw == "none for std_msgs"


def test_at_the_top_of_what_is_installed_is_the_package_alone():
    own = {f"{MODULES}/patrol/node.py": "", f"{MODULES}/patrol-0.0.0-py3.12.egg-info/PKG-INFO": "", "setup.sh": ""}
    installs_only_its_name(packaged(installed=own))
    miss = missed(
        installs_only_its_name,
        packaged(installed={**own, f"{MODULES}/utils.py": "", f"{MODULES}/scripts/drive.py": ""}),
    )
    assert (miss.expected, miss.saw) == ("only patrol at the top of what is installed", "also scripts, utils")
    assert miss.hint == (
        "Other packages may install a module of the same name, and Python imports the first one that it finds. "
        "Move your modules into the folder patrol/ that has __init__.py."
    )


@pytest.mark.parametrize(
    ("path", "text", "saw"),
    [
        (f"{MODULES}/patrol/node.py", "from speeds import FAST", "an import of speeds in node.py"),
        (f"{MODULES}/patrol/node.py", "import sys\nsys.path.append('..')", "sys.path in node.py"),
        ("lib/patrol/drive", "import speeds", "an import of speeds in drive"),
        (f"{MODULES}/patrol/node.py", "import sys\nvars(sys)['path'].append('..')", "vars in node.py"),
        (f"{MODULES}/patrol/node.py", "import importlib", "importlib in node.py"),
        ("lib/patrol/drive", "exec(open('speeds.py').read())", "exec in drive"),
    ],
)
def test_a_module_of_the_package_is_imported_by_the_packages_name(path, text, saw):
    helper = {f"{MODULES}/patrol/speeds.py": "import sys, rclpy", "lib/other/x": "import speeds"}
    right = "from patrol import speeds\nfrom .speeds import FAST"
    # What setuptools makes of an entry point is a program, and uses importlib.
    imports_by_its_name(packaged(installed={**helper, path: right, "lib/patrol/x": "import importlib.metadata"}))
    miss = missed(imports_by_its_name, packaged(installed={**helper, path: text}))
    assert (miss.expected, miss.saw) == ("imports from patrol or patrol.MODULE", saw)
    assert miss.hint == "A module of the package is found by the package's name, from every folder."


def test_imports_are_full_names_and_those_of_the_same_package_begin_with_dots():
    source = b"import a.b, c\ndef f():\n    from d.e import g, h\nfrom . import i\nfrom ..j import k"
    assert list(imports(source)) == ["a.b", "c", ".", ".i", "..j", "..j.k", "d.e", "d.e.g", "d.e.h"]


@pytest.mark.parametrize("source", [b"def f(:", b"\x00", "(" * 100_000, "-" * 100_000 + "1"])
def test_what_python_cannot_parse_imports_nothing(source):
    assert parsed(source).body == []
