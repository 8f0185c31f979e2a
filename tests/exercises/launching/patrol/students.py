"""Packages for launching.patrol: right ones in three styles, then one with each fault, and the broken one."""

from grader.exercises.launching.patrol.answers import FAULTS, FILES
from tests.students.workspaces import Workspace, changed

PARTS = ("FAULTS", "FILES", "BROKEN", "NODE", "with_fault")
NODE = "patrol/patrol/driver.py"


def with_fault(number: int) -> Workspace:
    """The package with this fault alone."""
    return Workspace(__name__, changed(FILES, *FAULTS[number]))


Patrol = Workspace(__name__, FILES)
WithMoreWords = Workspace(__name__, changed(FILES, "patrol/package.xml", "ahead", "ahead, and never back"))
ForOneNode = Workspace(  # a design of its own: settings for one node by its full name
    __name__, changed(FILES, "patrol/config/patrol.yaml", "/**:", "/scout/driver:")
)
BrokenTag = with_fault(0)
NoNeeds = with_fault(1)
NoModules = with_fault(2)
MissingComma = with_fault(3)
OtherFunction = with_fault(4)
OtherMarker = with_fault(5)
LaunchNotInstalled = with_fault(6)
ProgramsElsewhere = with_fault(7)
FromItsFolder = with_fault(8)
OtherExecutable = with_fault(9)
OneUnderscore = with_fault(10)
WholeNumber = with_fault(11)
TooFast = Workspace(__name__, changed(FILES, "patrol/patrol/speeds.py", "0.2", "0.5"))
OtherNode = Workspace(__name__, changed(FILES, "patrol/config/patrol.yaml", "/**:", "/driver:"))
OtherNamespace = Workspace(
    __name__, changed(FILES, "patrol/launch/patrol.launch.py", 'namespace="scout"', 'namespace="robot"')
)
NoMarker = Workspace(
    __name__,
    changed(
        FILES,
        "patrol/setup.py",
        "        ('share/ament_index/resource_index/packages', ['resource/' + package_name]),\n",
        "",
    ),
)
