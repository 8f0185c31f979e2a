"""Workspaces for launching.keeper: right ones in three styles, then wrong ones, each named by its defect."""

from collections.abc import Mapping

from tests.exercises.launching.crates.students import CMAKE, CRATE, LISTS, SPARSE
from tests.exercises.launching.crates.students import RIGHT as INTERFACES
from tests.students.workspaces import Workspace, changed, package

PARTS = (
    "NODE",
    "RIGHT",
    "XML",
    "KEEPER",
    "ON_SCAN",
    "ON_FIND",
    "SORTED",
    "FOUND",
    "but",
    "scans",
    "finds",
    "with_files",
)
NODE = """\
import rclpy
from crate_interfaces.msg import Crate
from crate_interfaces.srv import FindCrates
from rclpy.node import Node


class Keeper(Node):
    def __init__(self):
        super().__init__("keeper")
        self.crates = {}
        self.full = self.create_publisher(Crate, "full", 10)
        self.create_subscription(Crate, "crates", self.on_crate, 10)
        self.create_service(FindCrates, "find_crates", self.on_find)

    def on_crate(self, msg):
        self.crates[msg.label] = msg
        if msg.state == Crate.FULL:
            self.full.publish(msg)

    def on_find(self, request, response):
        response.crates = [crate for crate in self.crates.values() if crate.mass <= request.heaviest]
        return response


def main():
    rclpy.init()
    rclpy.spin(Keeper())
"""
KEEPER, XML = "crate_keeper/crate_keeper/keeper.py", "crate_keeper/package.xml"
RIGHT = INTERFACES | package(
    "crate_keeper",
    "'keeper = crate_keeper.keeper:main'",
    "rclpy crate_interfaces",
    {"crate_keeper/keeper.py": NODE},
)
ON_SCAN = NODE[NODE.index("        self.crates[msg.label] = msg") : NODE.index("    def on_find")]
ON_FIND = NODE[NODE.index("        response.crates = ") : NODE.index("def main")]
FOUND = "[crate for crate in self.crates.values() if crate.mass <= request.heaviest]"


def but(old: str, new: str, path: str = KEEPER) -> Workspace:
    """The right workspace with another text in one of its files."""
    return Workspace(__name__, changed(RIGHT, path, old, new))


def with_files(files: Mapping[str, str]) -> Workspace:
    """The right workspace with these files in place of its own."""
    return Workspace(__name__, {**RIGHT, **files})


def scans(*lines: str) -> Workspace:
    """The right workspace with another callback of /crates."""
    return but(ON_SCAN, "".join(f"        {line}\n" for line in lines) + "\n")


def finds(*lines: str) -> Workspace:
    """The right workspace with another callback of /find_crates."""
    return but(ON_FIND, "".join(f"        {line}\n" for line in lines) + "\n\n")


Keeper = Workspace(__name__, RIGHT)
OtherDefinition = with_files({CRATE: SPARSE, CMAKE: LISTS})  # a design of its own
LightestFirst = finds(
    "for crate in sorted(self.crates.values(), key=lambda crate: crate.mass):",
    "    if not crate.mass > request.heaviest:",
    "        response.crates.append(crate)",
    "return response",
)
ByItsNumber = scans(
    "self.crates.update({msg.label: msg})",
    "if msg.state:",
    "    self.full.publish(Crate(label=msg.label, mass=msg.mass, state=1, place=msg.place))",
)

NoInterfaces = Workspace(
    __name__, {path: text for path, text in RIGHT.items() if not path.startswith("crate_interfaces")}
)
WrongMessage = but("float64 mass", "float32 mass", CRATE)
NoAction = but('  "action/Lift.action"\n', "", CMAKE)
CanNotBeBuilt = but("geometry_msgs/Point place", "Point place", CRATE)
NothingIsPublished = scans("self.crates[msg.label] = msg")
ForwardsAll = scans("self.crates[msg.label] = msg", "self.full.publish(msg)")
ForwardsTheEmptyOnes = but("== Crate.FULL", "== Crate.EMPTY")
OnlyTheLabel = but("self.full.publish(msg)", "self.full.publish(Crate(label=msg.label))")
TextInstead = but('create_publisher(Crate, "full"', 'create_publisher(FindCrates.Request, "full"')
NoService = but('        self.create_service(FindCrates, "find_crates", self.on_find)\n', "")
OtherName = but('"find_crates"', '"find_crate"')
FindsNothing = finds("return response")
NoReturn = finds(f"response.crates = {FOUND}")
Lighter = but("<= request.heaviest", "< request.heaviest")
Heavier = but("<= request.heaviest", ">= request.heaviest")
FirstOnesStay = scans(
    "self.crates.setdefault(msg.label, msg)", "if msg.state == Crate.FULL:", "    self.full.publish(msg)"
)
AllEverScanned = but("self.crates[msg.label] = msg", "self.crates[len(self.crates)] = msg")
OnlyTheFullOnes = but("self.crates[msg.label] = msg\n", "if msg.state: self.crates[msg.label] = msg\n")
ImportsAModule = but("from crate_interfaces.msg import Crate", "from crate_interfaces import Crate")
NoNeed = but("  <depend>crate_interfaces</depend>\n", "", XML)
