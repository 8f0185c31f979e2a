"""The robot's files for Gazebo have its figures, and what checks them finds what is wrong."""

import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest
import yaml

from sim import World

ROOT = Path(__file__).parents[2]
BRIDGE = ROOT / "course" / "bridge"
sys.path.insert(0, str(BRIDGE))  # as the notebooks import what is beside them
from gazebo_checks import bridge_problems, controller_problems, urdf_problems  # noqa: E402
from gazebo_world import to_sdf  # noqa: E402

ROBOT = World.load("room").robot


def text(name):
    return (BRIDGE / "gazebo" / name).read_text(encoding="utf-8")


def numbers(values):
    return [float(value) for value in values.split()]


def test_the_files_of_the_course_have_no_problems():
    assert urdf_problems(text("robot.urdf")) == []
    assert bridge_problems(text("bridge.yaml")) == []
    assert controller_problems(text("controllers.yaml"), text("robot.urdf")) == []


def test_the_urdf_has_the_figures_of_the_simulated_robot():
    robot = ElementTree.fromstring(text("robot.urdf"))
    radii = {link.get("name"): float(link.find(".//cylinder").get("radius")) for link in robot.iter("link")}
    sides = [
        numbers(robot.find(f"joint[@name='{side}_wheel_joint']/origin").get("xyz"))[1]
        for side in ("left", "right")
    ]
    assert (radii["base_link"], radii["left_wheel"]) == (ROBOT.radius, ROBOT.wheel_radius)
    assert sides == [ROBOT.track_width / 2, -ROBOT.track_width / 2]
    assert sum(float(mass.get("value")) for mass in robot.iter("mass")) == pytest.approx(ROBOT.mass)


def test_the_sdf_has_the_figures_of_the_simulated_robot_and_of_the_urdf():
    model, lidar = ElementTree.fromstring(text("robot.sdf")).find("model"), World.load("room").lidar
    urdf = ElementTree.fromstring(text("robot.urdf"))
    drive = model.find("plugin[@name='gz::sim::systems::DiffDrive']")
    wanted = {
        "wheel_separation": ROBOT.track_width,
        "wheel_radius": ROBOT.wheel_radius,
        "max_linear_velocity": ROBOT.max_v,
        "max_angular_velocity": ROBOT.max_w,
        "max_linear_acceleration": ROBOT.max_acceleration,
    }
    assert {name: float(drive.find(name).text) for name in wanted} == wanted
    assert [float(mass.text) for mass in model.iter("mass")] == [
        float(mass.get("value")) for mass in urdf.iter("mass")
    ]
    assert int(model.find(".//samples").text) == lidar.rays
    assert [float(model.find(f".//range/{name}").text) for name in ("min", "max")] == [
        lidar.range_min,
        lidar.range_max,
    ]
    assert float(model.find(".//max_angle").text) == pytest.approx(lidar.angle_increment * 359, abs=1e-4)


def test_the_controllers_have_the_figures_of_the_simulated_robot():
    drive = yaml.safe_load(text("controllers.yaml"))["drive"]["ros__parameters"]
    assert (drive["wheel_separation"], drive["wheel_radius"]) == (ROBOT.track_width, ROBOT.wheel_radius)
    assert drive["cmd_vel_timeout"] == ROBOT.command_timeout


def test_the_room_for_gazebo_is_the_world_room():
    assert text("room.sdf") == to_sdf(World.load("room"))


def test_all_that_stands_in_a_world_is_in_its_sdf():
    world = World.generate("maze", seed=7)
    models = ElementTree.fromstring(to_sdf(world)).findall("world/model")
    assert len(models) == 1 + len(world.walls) + len(world.boxes) + len(world.circles)


LINK = '<link name="{}"><inertial><inertia ixx="{}" iyy="1" izz="1"/></inertial></link>'
JOINT = '<joint name="j" type="{}"><parent link="a"/><child link="b"/></joint>'


@pytest.mark.parametrize(
    ("robot", "problem"),
    [
        (LINK.format("a", 1) + LINK.format("b", 1), "expected one link without a parent, saw 2: a, b"),
        (LINK.format("a", 1) + JOINT.format("fixed"), "j: there is no link b"),
        (
            LINK.format("a", 1) + '<link name="b"/>' + JOINT.format("continuous"),
            "b moves and has no inertial: Gazebo ignores the link",
        ),
        (LINK.format("a", 0), "a: moments of inertia must be above 0, these are 0, 1, 1"),
        (LINK.format("a", 3), "a: no body has the moments 3, 1, 1: one exceeds the other two"),
    ],
)
def test_what_is_wrong_in_a_urdf_is_found(robot, problem):
    assert urdf_problems(f"<robot name='r'>{robot}</robot>") == [problem]


ENTRY = "- ros_topic_name: /scan\n  ros_type_name: sensor_msgs/msg/LaserScan\n  gz_type_name: gz.msgs.{}\n{}"


@pytest.mark.parametrize(
    ("file", "problem"),
    [
        ("scan: 1", "expected a list: each entry begins with a dash"),
        (ENTRY.format("LaserScan", "  lazi: true"), "/scan: lazi is no key of the bridge"),
        (
            ENTRY.format("LaserScan", "  direction: IN"),
            "/scan: IN is none of BIDIRECTIONAL, GZ_TO_ROS, ROS_TO_GZ",
        ),
        (
            ENTRY.format("Lidar", ""),
            "/scan: expected gz.msgs.LaserScan for sensor_msgs/msg/LaserScan, saw gz.msgs.Lidar",
        ),
        (
            "- topic_name: /a\n  ros_type_name: a/msg/B\n  gz_type_name: gz.msgs.B",
            "/a: expected a type of the table for a/msg/B, saw gz.msgs.B",
        ),
        ("- topic_name: /a\n  gz_type_name: gz.msgs.Twist", "/a: ros_type_name is missing"),
        (
            "- ros_type_name: geometry_msgs/msg/Twist\n  gz_type_name: gz.msgs.Twist",
            "entry 1: no topic: give ros_topic_name or gz_topic_name",
        ),
    ],
)
def test_what_is_wrong_in_the_bridge_s_file_is_found(file, problem):
    assert bridge_problems(file) == [problem]


@pytest.mark.parametrize(
    ("old", "new", "problem"),
    [
        (
            "    drive:\n      type",
            "    driver:\n      type",
            "drive is not listed in controller_manager with a type",
        ),
        ("[left_wheel_joint]", "[left_joint]", "drive: the robot has no joint left_joint"),
        ("drive:\n  ros__p", "drive:\n  ros_p", "drive: expected ros__parameters, with two underscores"),
    ],
)
def test_what_is_wrong_with_controllers_is_found(old, new, problem):
    wrong = text("controllers.yaml").replace(old, new)
    assert controller_problems(wrong, text("robot.urdf")) == [problem]


ARM = """
controller_manager:
  ros__parameters:
    arm:
      type: joint_trajectory_controller/JointTrajectoryController
arm:
  ros__parameters:
    joints: [left_wheel_joint]
    command_interfaces: [position]
    state_interfaces: [position, velocity]
"""


@pytest.mark.parametrize(
    ("old", "new", "problem"),
    [
        ("[left_wheel_joint]", "[shoulder]", "arm: the robot has no joint shoulder"),
        ("    command_interfaces: [position]\n", "", "arm: command_interfaces is missing, or empty"),
        ("[left_wheel_joint]", "[]", "arm: joints is missing, or empty"),
        (
            "[position]",
            "[angle]",
            "arm: command_interfaces has angle; expected position, velocity, acceleration, effort",
        ),
    ],
)
def test_what_is_wrong_with_a_controller_of_an_arm_is_found(old, new, problem):
    assert controller_problems(ARM, text("robot.urdf")) == []
    assert controller_problems(ARM.replace(old, new), text("robot.urdf")) == [problem]
