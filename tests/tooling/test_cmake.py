"""colcon builds packages that name other packages: what find_package finds, and what it explains."""

import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

from tests.tooling.test_ci import ROOT, load

prefix = load("prefix.py", "ros_packages/cmake")
COLCON = Path(sys.executable).with_name("colcon")
PACKAGE_XML = """\
<?xml version="1.0"?>
<package format="3">
  <name>{name}</name><version>0.0.0</version><description>It is built.</description>
  <maintainer email="me@example.com">me</maintainer><license>Apache-2.0</license>
  <buildtool_depend>ament_cmake</buildtool_depend>{depends}
  <export><build_type>ament_cmake</build_type></export>
</package>
"""
GENERATED = """\
find_package(ament_cmake REQUIRED)
if(BUILD_TESTING)
  find_package(ament_lint_auto REQUIRED)
  set(ament_cmake_copyright_FOUND TRUE)
  ament_lint_auto_find_test_dependencies()
endif()
ament_package()
"""
NAMES = "ament_lint_common control_msgs example_interfaces launch_ros message_filters nav2_msgs rclpy tf2"
NAMING = f"""\
find_package(ament_cmake REQUIRED)
foreach(package {NAMES} ament_cmake_mypy sensor_msgs_py xacro tf2_geometry_msgs tf2_msgs tf2_ros turtlesim)
  find_package(${{package}} REQUIRED)
endforeach()
ament_export_dependencies(tf2_ros turtlesim)
ament_package()
"""
AUTOMATIC = """\
find_package(ament_cmake_auto REQUIRED)
ament_auto_find_build_dependencies(REQUIRED tf2_ros)
if(BUILD_TESTING)
  ament_auto_find_test_dependencies()
endif()
ament_auto_package(INSTALL_TO_SHARE launch)
"""
PACKAGES = {"generated": GENERATED, "naming": NAMING, "automatic": AUTOMATIC}
USING = """\
find_package(ament_cmake REQUIRED)
find_package(turtlesim REQUIRED)
find_package(rosidl_default_generators REQUIRED)
rosidl_generate_interfaces(${PROJECT_NAME} "msg/Turtle.msg" DEPENDENCIES turtlesim)
ament_package()
"""
MEMBER = "<depend>turtlesim</depend><member_of_group>rosidl_interface_packages</member_of_group>"
EXCHANGE = """
from fleet.msg import Turtle
from rclpy.serialization import deserialize_message, serialize_message
from turtlesim.msg import Pose
sent = Turtle(pose=Pose(x=1.5), path=[Pose(y=2.0)])
received = deserialize_message(serialize_message(sent), Turtle)
print(received.pose.x, received.path[0].y)
"""
DEPENDS = "<depend>turtlesim</depend><depend>tf2_ros</depend><test_depend>ament_lint_auto</test_depend>"


@pytest.fixture
def configured(tmp_path, monkeypatch):
    """A prefix with the configurations of this version, found before the environment's."""
    prefix.write_cmake_packages(tmp_path / "prefix")
    monkeypatch.setenv("CMAKE_PREFIX_PATH", f"{tmp_path}/prefix:{sys.prefix}")
    monkeypatch.setenv("PATH", f"{sys.prefix}/bin:{os.environ['PATH']}")
    return tmp_path / "prefix"


def write(workspace: Path, name: str, rules: str, depends: str = "") -> None:
    folder = workspace / "src" / name
    (folder / "launch").mkdir(parents=True)
    (folder / "launch" / "one.launch.py").write_text("")
    (folder / "package.xml").write_text(PACKAGE_XML.format(name=name, depends=depends))
    head = f"cmake_minimum_required(VERSION 3.8)\nproject({name} NONE)\n"
    (folder / "CMakeLists.txt").write_text(f"{head}{rules}")


def colcon(folder: Path, *arguments: str, **variables: str) -> subprocess.CompletedProcess:
    # As ros.pth sets it, also where set-up did not write that yet.
    variables.setdefault("CMAKE_POLICY_VERSION_MINIMUM", "3.10")
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"} | variables
    return subprocess.run(
        [COLCON, *arguments], cwd=folder, env=environment, capture_output=True, text=True, check=False
    )


def test_packages_build_that_name_linters_messages_and_python_packages(configured, tmp_path):
    for name, rules in PACKAGES.items():
        write(tmp_path, name, rules, DEPENDS if name == "automatic" else "")
    done = colcon(tmp_path, "build")
    assert (done.returncode, done.stderr) == (0, "")
    installed = tmp_path / "install" / "automatic" / "share" / "automatic"
    assert (installed / "launch" / "one.launch.py").is_file()
    exported = (installed / "cmake" / "ament_cmake_export_dependencies-extras.cmake").read_text()
    assert 'set(_exported_dependencies "turtlesim;tf2_ros")' in exported


@pytest.mark.parametrize(
    ("package", "sentence"),
    {
        "cv_bridge": "cv_bridge (converts between ROS images and OpenCV's arrays) is a ROS package that the "
        "course does not include. Remove its find_package if nothing here uses it.",
        "catkin": "catkin is a package of ROS 1. ROS 2 has ament_cmake, or ament_python.",
    }.items(),
)
def test_a_package_that_is_not_here_is_explained_in_a_sentence(package, sentence, configured, tmp_path):
    rules = f"find_package({package} QUIET)\nif({package}_FOUND)\n  message(FATAL_ERROR no)\nendif()\n"
    write(tmp_path, "mine", f"{rules}find_package({package} REQUIRED)\n")
    done = colcon(tmp_path, "build")
    assert done.returncode == 1
    assert sentence in re.sub(r"\s+", " ", done.stderr)


REQUIRES_CPP = """\
find_package(ament_cmake REQUIRED)
find_package(rclcpp QUIET)
if(rclcpp_FOUND)
  message(FATAL_ERROR no)
endif()
find_package(rclcpp REQUIRED)
find_package(rclcpp_components REQUIRED)
{uses}
ament_package()
"""
NOT_HERE = "and C++ nodes are not built here. Write the node in Python, or remove the lines of talker."
LINKED = """\
add_library(talker INTERFACE)
set_target_properties(talker PROPERTIES LINK_LIBRARIES rclcpp::rclcpp)
"""
IN_AUTO = "find_package(ament_cmake_auto REQUIRED)\nament_auto_add_executable(talker src/talker.cpp)\n"
IN_CPP = {
    "": "",
    "add_library(shape INTERFACE)\ntarget_link_libraries(shape INTERFACE m)": "",
    LINKED: f"talker uses rclcpp, which is for C++ (ROS's library for C++), {NOT_HERE}",
    'rclcpp_components_register_nodes(talker "a::Talker")': "talker uses rclcpp_components, which is for C++ "
    f"(components in C++), {NOT_HERE}",
    IN_AUTO: f"talker is in C++, {NOT_HERE}",
}


@pytest.mark.parametrize(("uses", "sentence"), IN_CPP.items())
def test_packages_for_cpp_may_be_required_as_long_as_no_target_uses_one(uses, sentence, configured, tmp_path):
    write(tmp_path, "mine", REQUIRES_CPP.format(uses=uses))
    done = colcon(tmp_path, "build")
    assert done.returncode == (1 if sentence else 0), done.stderr
    assert sentence in re.sub(r"\s+", " ", done.stderr)


@pytest.fixture
def explaining(configured, tmp_path, monkeypatch):
    """colcon with the extension that pyproject.toml names, also where set-up did not register it yet."""
    group = "colcon_core.event_handler"
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    lines = [f"{name} = {value}" for name, value in project["entry-points"][group].items()]
    folder = tmp_path / "registered" / "course_test-0.dist-info"
    folder.mkdir(parents=True)
    (folder / "METADATA").write_text("Metadata-Version: 2.1\nName: course-test\nVersion: 0\n")
    (folder / "entry_points.txt").write_text("\n".join([f"[{group}]", *lines]))
    return {"PYTHONPATH": str(folder.parent)}


def test_a_package_that_no_one_has_is_explained_in_a_sentence(explaining, tmp_path):
    requires = {"near": "std_msg", "far": "zzz_interfaces", "first": "second"}
    for name, other in requires.items():
        write(tmp_path, name, f"find_package(ament_cmake REQUIRED)\nfind_package({other} REQUIRED)\n")
    write(tmp_path, "second", "find_package(ament_cmake REQUIRED)\nament_package()\n")
    done = colcon(tmp_path, "build", "--continue-on-error", **explaining)
    said = [
        line for line in done.stderr.splitlines() if line.startswith((*(f"{name}: " for name in requires),))
    ]
    begin = "its CMakeLists.txt requires {}, which is neither installed nor in this workspace."
    assert sorted({*said}) == [
        f"far: {begin.format('zzz_interfaces')} Put its source into src, or remove the line.",
        "first: second is a package of this workspace, but first does not depend on it, so it is not built "
        "first. Write <depend>second</depend> into the package.xml of first.",
        f"near: {begin.format('std_msg')} Did you mean std_msgs?",
    ]


def test_a_package_xml_that_is_not_valid_is_named_during_the_build(explaining, tmp_path):
    folder = tmp_path / "src" / "wrong"
    folder.mkdir(parents=True)
    (folder / "setup.py").write_text("from setuptools import setup\nsetup(name='wrong')\n")
    (folder / "package.xml").write_text(PACKAGE_XML.format(name="wrong", depends="<depend>a<depend>"))
    done = colcon(tmp_path, "build", **explaining)
    why = "its package.xml is not valid: mismatched tag: line 7, column 2"
    said = f"wrong: {why}. It is built without ROS, and ros2 does not find it."
    assert said in done.stderr.splitlines()


def test_the_environment_lets_cmake_build_what_was_written_for_an_older_one():
    assert prefix.PTH.endswith("os.environ.setdefault('CMAKE_POLICY_VERSION_MINIMUM', '3.10')\n")


@pytest.mark.soak  # rosidl and its C++ take half a minute
def test_a_package_uses_the_messages_of_one_of_the_course(configured, tmp_path):
    for kind in ("action", "msg", "srv"):
        here = configured / "share" / "turtlesim" / kind
        here.symlink_to(Path(sys.prefix, "share", "turtlesim", kind))
    write(tmp_path, "fleet", USING, MEMBER)
    rules = tmp_path / "src" / "fleet" / "CMakeLists.txt"
    rules.write_text(rules.read_text().replace(" NONE", ""))
    (tmp_path / "src" / "fleet" / "msg").mkdir()
    (tmp_path / "src" / "fleet" / "msg" / "Turtle.msg").write_text(
        "turtlesim/Pose pose\nturtlesim/Pose[] path\n"
    )
    done = colcon(tmp_path, "build")
    assert done.returncode == 0, done.stderr
    script = f". {tmp_path}/install/setup.sh; {sys.executable} -c '{EXCHANGE}'"
    done = subprocess.run(["sh", "-c", script], capture_output=True, text=True, check=False)
    assert (done.stdout, done.stderr) == ("1.5 2.0\n", "")


def test_a_configuration_that_a_wheel_brought_stays(tmp_path):
    config = tmp_path / "share" / "rclcpp" / "cmake" / "rclcppConfig.cmake"
    config.parent.mkdir(parents=True)
    config.write_text("# generated\n")
    prefix.write_cmake_packages(tmp_path)
    prefix.write_cmake_packages(tmp_path)  # its own files are written again
    assert config.read_text() == "# generated\n"
    empty = tmp_path / "share" / "tf2_ros" / "cmake" / "tf2_rosConfig.cmake"
    assert empty.read_text() == "# Written by the course's set-up.\nset(tf2_ros_FOUND_AMENT_PACKAGE TRUE)\n"


def test_the_courses_own_folder_has_nothing_for_colcon(tmp_path):
    done = colcon(ROOT, "--log-base", str(tmp_path), "list")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")
    left = ["install/", "log/", "build/"]
    ignored = subprocess.run(["git", "check-ignore", *left], cwd=ROOT, capture_output=True, text=True)
    assert ignored.stdout.split() == left
