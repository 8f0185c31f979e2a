"""Packages for launching.crates: right ones in three styles, then wrong ones, each named by its defect."""

import re
from collections.abc import Mapping

from tests.students.workspaces import Workspace, changed

PARTS = ("XML", "CMAKE", "CRATE", "FIND", "LIFT", "FILES", "RIGHT", "LISTS", "SPARSE", "BARE", "but")
XML, CMAKE, CRATE, FIND, LIFT = FILES = [
    f"crate_interfaces/{path}"
    for path in ("package.xml", "CMakeLists.txt", "msg/Crate.msg", "srv/FindCrates.srv", "action/Lift.action")
]
RIGHT = {
    XML: """\
<?xml version="1.0"?>
<package format="3">
  <name>crate_interfaces</name>
  <version>0.0.0</version>
  <description>What a warehouse and its robots tell each other</description>
  <maintainer email="you@example.org">you</maintainer>
  <license>Apache-2.0</license>

  <buildtool_depend>ament_cmake</buildtool_depend>
  <buildtool_depend>rosidl_default_generators</buildtool_depend>
  <depend>geometry_msgs</depend>
  <exec_depend>rosidl_default_runtime</exec_depend>
  <member_of_group>rosidl_interface_packages</member_of_group>

  <export>
    <build_type>ament_cmake</build_type>
  </export>
</package>
""",
    CMAKE: """\
cmake_minimum_required(VERSION 3.10)
project(crate_interfaces)

find_package(ament_cmake REQUIRED)
find_package(rosidl_default_generators REQUIRED)
find_package(geometry_msgs REQUIRED)

rosidl_generate_interfaces(${PROJECT_NAME}
  "msg/Crate.msg"
  "srv/FindCrates.srv"
  "action/Lift.action"
  DEPENDENCIES geometry_msgs
)

ament_export_dependencies(rosidl_default_runtime)
ament_package()
""",
    CRATE: """\
uint8 EMPTY=0
uint8 FULL=1

string label
float64 mass  # kg
uint8 state   # EMPTY or FULL
geometry_msgs/Point place  # m
""",
    FIND: "float64 heaviest  # kg\n---\nCrate[] crates\n",
    LIFT: "string label\nfloat64 height  # m\n---\nbool lifted\n---\nfloat64 height  # m, now\n",
}
LISTS = """\
cmake_minimum_required(VERSION 3.10)
project(crate_interfaces VERSION 0.0.0 LANGUAGES C CXX)
#[[ What is listed here
    becomes types. ]]
FIND_PACKAGE(ament_cmake REQUIRED)
find_package(geometry_msgs REQUIRED)  # a point
find_package(rosidl_default_generators REQUIRED)

set(crate_files msg/Crate.msg "srv/FindCrates.srv")
list(APPEND crate_files action/Lift.action)
rosidl_generate_interfaces(${PROJECT_NAME} "${crate_files}" DEPENDENCIES geometry_msgs)
ament_package()
"""


SPARSE = """\
# A crate, and where it is
string label       # as on its side
float64 mass 1.0   # kg, if no one weighed it
uint8\tstate
uint8 FULL = 0x01
uint8 EMPTY = 0
geometry_msgs/Point place
"""


def but(path: str, old: str = "", new: str | None = None, files: Mapping[str, str] = RIGHT) -> Workspace:
    """The right package with another text in one of its files; without `new`, without this file."""
    return Workspace(__name__, changed(files, path, old, new))


Crates = Workspace(__name__, RIGHT)
ListsOfFiles = but(CMAKE, "", LISTS)  # a design of its own
WrittenOtherwise = but(
    XML,
    "<depend>geometry_msgs</depend>",
    "<build_depend>geometry_msgs</build_depend>\n  <exec_depend>geometry_msgs</exec_depend>",
    {**RIGHT, CRATE: SPARSE, FIND: RIGHT[FIND].replace("Crate[]", "crate_interfaces/Crate[]")},
)

SavedOnWindows = Workspace(__name__, {path: text.replace("\n", "\r\n") for path, text in RIGHT.items()})
MarkedByAnEditor = but(CMAKE, "", f"\ufeff{RIGHT[CMAKE]}", {**RIGHT, XML: f"\ufeff{RIGHT[XML]}"})
SpacesAndTabs = Workspace(
    __name__,
    {**RIGHT, CRATE: re.sub("$", " \t", RIGHT[CRATE], flags=re.M), LIFT: RIGHT[LIFT].replace(" ", "\t")},
)
BuiltInItsFolder = Workspace(
    __name__,
    RIGHT
    | {f"crate_interfaces/{place}/COLCON_IGNORE": "" for place in ("build", "install", "log")}
    | {f"crate_interfaces/build/crate_interfaces/file_{number}": "" for number in range(300)},
)

NoCMake = but(CMAKE)
OfPython = but(XML, "<build_type>ament_cmake", "<build_type>ament_python")
SmallLetters = but(CRATE, files={**RIGHT, "crate_interfaces/msg/crate.msg": RIGHT[CRATE]})
NoDefinitions = Workspace(__name__, {path: RIGHT[path] for path in (XML, CMAKE)})
MarkedDefinition = but(CRATE, "uint8 EMPTY", "\ufeffuint8 EMPTY")
SpaceOfAPage = but(CRATE, "string label", "string\xa0label")
CommentAfterDashes = but(FIND, "---\n", "---# the answer\n")
NoDashes = but(FIND, "---\n", "")
CapitalField = but(CRATE, "float64 mass ", "float64 Mass ")
ConstantWithoutSign = but(CRATE, "FULL=1", "FULL 1")
TwoSlashes = but(CRATE, "geometry_msgs/Point", "geometry_msgs/msg/Point")
OtherType = but(CRATE, "float64 mass", "float32 mass")
OtherName = but(CRATE, "float64 mass", "float64 weight")
OwnPoint = but(CRATE, "geometry_msgs/Point", "Point")
OneMore = but(CRATE, "float64 mass  # kg\n", "float64 mass\nfloat64 height\n")
OtherOrder = but(CRATE, "string label\nfloat64 mass  # kg\n", "float64 mass\nstring label\n")
NoConstants = but(CRATE, "uint8 EMPTY=0\nuint8 FULL=1\n", "")
OtherConstants = but(CRATE, "uint8 EMPTY=0\nuint8 FULL=1\n", "uint8 FULL=0\nuint8 EMPTY=1\n")
OneCrate = but(FIND, "Crate[] crates", "Crate crates")
AllInTheRequest = but(FIND, "---\nCrate[] crates\n", "Crate[] crates\n---\n")
FeedbackFirst = but(LIFT, "", "string label\nfloat64 height\n---\nfloat64 height\n---\nbool lifted\n")
NoFeedback = but(LIFT, "float64 height  # m, now\n", "")
NoGroup = but(XML, "  <member_of_group>rosidl_interface_packages</member_of_group>\n", "")
OnlyToBuild = but(XML, "<depend>geometry_msgs</depend>", "<build_depend>geometry_msgs</build_depend>")
NoVersion = but(CMAKE, "cmake_minimum_required(VERSION 3.10)\n", "")
OtherProject = but(CMAKE, "project(crate_interfaces)", "project(crates)")
NoCommand = but(CMAKE, "rosidl_generate_interfaces", "rosidl_target_interfaces")
FindsNoGenerators = but(CMAKE, "find_package(rosidl_default_generators REQUIRED)\n", "")
FindsNothing = but(CMAKE, "find_package", "find_program")
FindsNoGeometry = but(CMAKE, "find_package(geometry_msgs REQUIRED)\n", "")
ForgetsTheAction = but(CMAKE, '  "action/Lift.action"\n', "")
BARE = re.sub('"\\w+/', '"', RIGHT[CMAKE])
FilesWithoutFolders = but(CMAKE, "", BARE)
NoNameBeforeTheFiles = but(CMAKE, "(${PROJECT_NAME}\n  ", "(")
OneTooMany = but(CMAKE, '"msg/Crate.msg"', '"msg/Crate.msg"\n  "msg/Num.msg"')
NoFiles = but(CMAKE, "${PROJECT_NAME}\n", "${PROJECT_NAME})\nset(files\n")
NoWords = but(CMAKE, "(${PROJECT_NAME}\n", "()\nset(files\n")
OtherDependencies = but(CMAKE, "DEPENDENCIES geometry_msgs", "DEPENDENCIES std_msgs")
NoDependencies = but(CMAKE, "  DEPENDENCIES geometry_msgs\n", "")
NoEnd = but(CMAKE, "ament_package()\n", "")
OpenBracket = but(CMAKE, "geometry_msgs\n)", "geometry_msgs\n")
NothingIsBuilt = but(CMAKE, "project(crate_interfaces)\n", "project(crate_interfaces)\nif(FALSE)\n",
                     {**RIGHT, CMAKE: RIGHT[CMAKE] + "endif()\n"})
