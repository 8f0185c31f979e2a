"""Packages for packages.station: right ones in three styles, then wrong ones, each named by its defect."""

from tests.students.workspaces import Workspace, changed, package

PARTS = ("SENSOR", "DISPLAY", "POINTS", "RIGHT", "SETUP", "CFG")
SENSOR = """\
import rclpy
from rclpy.node import Node
from std_msgs.msg import Float32


class Sensor(Node):
    def __init__(self):
        super().__init__("sensor")
        self.count = 0
        self.publisher = self.create_publisher(Float32, "temperature", 10)
        self.create_timer(0.2, self.measure)

    def measure(self):
        self.count += 1
        self.publisher.publish(Float32(data=20.0 + 0.1 * (self.count % 10)))


def main():
    rclpy.init()
    rclpy.spin(Sensor())
"""
DISPLAY = """\
import rclpy
from rclpy.node import Node
from std_msgs.msg import Float32, String


class Display(Node):
    def __init__(self):
        super().__init__("display")
        self.publisher = self.create_publisher(String, "display", 10)
        self.create_subscription(Float32, "temperature", self.show, 10)

    def show(self, msg):
        self.publisher.publish(String(data=f"{msg.data:.1f} degrees"))


def show():
    rclpy.init()
    rclpy.spin(Display())
"""
POINTS = "'sensor = station.sensor:main', 'display = station.display:show'"
RIGHT = package(
    "station", POINTS, "rclpy std_msgs", {"station/sensor.py": SENSOR, "station/display.py": DISPLAY}
)
SETUP, CFG = "station/setup.py", "station/setup.cfg"

Station = Workspace(__name__, RIGHT)
InOneText = Workspace(
    __name__,
    changed(RIGHT, SETUP, f"[{POINTS}]", "'sensor=station.sensor:main\\ndisplay=station.display:show'"),
)
ByTheClasses = Workspace(  # a design of its own
    __name__,
    changed(
        changed(RIGHT, SETUP, POINTS, "'sensor = station.start:one', 'display = station.start:other'"),
        "station/station/start.py",
        "",
        "from station.display import show as other\nfrom station.sensor import main as one\n",
    ),
)
NoEntryPoints = Workspace(__name__, changed(RIGHT, SETUP, POINTS, ""))
OnlyTheSensor = Workspace(__name__, changed(RIGHT, SETUP, ", 'display = station.display:show'", ""))
TypoInTheName = Workspace(__name__, changed(RIGHT, SETUP, "'display =", "'dispaly ="))
DisplayHasNoMain = Workspace(__name__, changed(RIGHT, SETUP, "display:show", "display:main"))
ModuleWithEnding = Workspace(__name__, changed(RIGHT, SETUP, "station.sensor:main", "station.sensor.py:main"))
NoPackageInFront = Workspace(__name__, changed(RIGHT, SETUP, "station.sensor:main", "sensor:main"))
WithASlash = Workspace(__name__, changed(RIGHT, SETUP, "station.sensor:main", "station/sensor:main"))
Swapped = Workspace(
    __name__,
    changed(RIGHT, SETUP, POINTS, "'sensor = station.display:show', 'display = station.sensor:main'"),
)
NoComma = Workspace(__name__, changed(RIGHT, SETUP, ", 'display = station", " 'display = station"))
NoFunctions = Workspace(
    __name__, changed(RIGHT, SETUP, POINTS, "'sensor = station.sensor', 'display = station.display:show'")
)
OneTooMany = Workspace(__name__, changed(RIGHT, SETUP, POINTS, f"{POINTS}, 'station = station.sensor:main'"))
NoSetupCfg = Workspace(__name__, changed(RIGHT, CFG))
CfgIsBroken = Workspace(__name__, changed(RIGHT, CFG, "[install]", "install"))
OtherWords = Workspace(
    __name__, changed(RIGHT, "station/station/display.py", ":.1f} degrees", ":.0f} degrees")
)
