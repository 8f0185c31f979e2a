"""Packages for packages.gauge: right ones in three styles, then wrong ones, each named by its defect."""

from tests.students.workspaces import Workspace, changed, package

PARTS = (
    *("RAISES", "BEGIN", "TEST", "TRY", "NODE", "CONVERT", "RIGHT", "NO_PROGRAM", "NOTHING", "GAUGE"),
    *("MODULE", "INSIDE"),
)
NODE = """\
import rclpy
from rclpy.node import Node
from std_msgs.msg import Float32

from gauge.convert import celsius


class Gauge(Node):
    def __init__(self):
        super().__init__("gauge")
        self.publisher = self.create_publisher(Float32, "celsius", 10)
        self.create_subscription(Float32, "volts", self.on_message, 10)

    def on_message(self, msg):
        value = celsius(msg.data)
        if value is not None:
            self.publisher.publish(Float32(data=value))


def main():
    rclpy.init()
    rclpy.spin(Gauge())
"""
CONVERT = """\
def celsius(volts):
    if not 0.0 <= volts <= 3.3:
        return None
    return 100.0 * volts - 50.0
"""
INSIDE = "def celsius(volts):\n    return 100.0 * volts - 50.0 if 0.0 <= volts <= 3.3 else None\n"
RIGHT = package(
    "gauge",
    "'gauge = gauge.node:main'",
    "rclpy std_msgs",
    {"gauge/node.py": NODE, "gauge/convert.py": CONVERT},
)
GAUGE, MODULE = "gauge/gauge/node.py", "gauge/gauge/convert.py"

Gauge = Workspace(__name__, RIGHT)
BesideIt = Workspace(__name__, changed(RIGHT, GAUGE, "from gauge.convert", "from .convert"))
WholeModule = Workspace(
    __name__,
    changed(
        changed(RIGHT, GAUGE, "from gauge.convert import celsius", "from gauge import convert"),
        GAUGE, "= celsius(", "= convert.celsius(",
    ),
)  # fmt: skip
FromItsFolder = Workspace(__name__, changed(RIGHT, GAUGE, "from gauge.convert", "from convert"))
NotInstalled = Workspace(__name__, changed(RIGHT, "gauge/setup.py", "find_packages(exclude=['test'])", "[]"))
NoInit = Workspace(__name__, changed(RIGHT, "gauge/gauge/__init__.py"))
AllInOne = Workspace(
    __name__, changed(changed(RIGHT, MODULE), GAUGE, "from gauge.convert import celsius\n", f"\n{INSIDE}")
)
CopiedIntoTheNode = Workspace(
    __name__, changed(RIGHT, GAUGE, "from gauge.convert import celsius\n", f"\n{INSIDE}")
)
OtherName = Workspace(
    __name__,
    changed(
        changed(RIGHT, MODULE, "def celsius", "def to_celsius"),
        GAUGE,
        "import celsius",
        "import to_celsius as celsius",
    ),
)
KnowsMessages = Workspace(
    __name__,
    changed(RIGHT, MODULE, "def celsius", "from std_msgs.msg import Float32  # noqa\n\n\ndef celsius"),
)
RAISES = changed(RIGHT, MODULE, "return None", "raise ValueError(volts)")
BEGIN, TEST = "        value = celsius(msg.data)\n", "        if value is not None:\n            self"
TRY = f"        try:\n    {BEGIN}        except ValueError:\n            return\n        self"
ByAnException = Workspace(__name__, changed(RAISES, GAUGE, BEGIN + TEST, TRY))  # a design of its own
LosesZeroDegrees = Workspace(__name__, changed(RIGHT, GAUGE, "if value is not None:", "if value:"))
NoOffset = Workspace(__name__, changed(RIGHT, MODULE, " - 50.0", ""))
BrokenCable = Workspace(__name__, changed(RIGHT, MODULE, "0.0 <= volts <= 3.3", "-9.0 <= volts <= 9.0"))
Silent = Workspace(__name__, changed(RIGHT, GAUGE, '"celsius", 10', '"kelvin", 10'))
NO_PROGRAM = changed(RIGHT, "gauge/setup.py", "'gauge = gauge.node:main'", "")
OnlyAModule = Workspace(__name__, NO_PROGRAM)
NOTHING = "def celsius(volts):\n    pass\n"
NothingInside = Workspace(__name__, changed(RIGHT, MODULE, "", NOTHING))
