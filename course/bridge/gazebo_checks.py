"""Checks the files of a robot for Gazebo, without Gazebo; a sentence for each problem."""

from pathlib import Path
from xml.etree import ElementTree

import yaml

NAMES = ("ros_topic_name", "gz_topic_name", "topic_name")
TYPES = ("ros_type_name", "gz_type_name")
OPTIONS = ("direction", "subscriber_queue", "publisher_queue", "lazy")
TRAJECTORIES = "joint_trajectory_controller/JointTrajectoryController"
INTERFACES = ("position", "velocity", "acceleration", "effort")
DIRECTIONS = ("BIDIRECTIONAL", "GZ_TO_ROS", "ROS_TO_GZ")
# Those that this robot needs, of the table in the README of ros_gz_bridge.
PAIRS = {
    "rosgraph_msgs/msg/Clock": "gz.msgs.Clock",
    "geometry_msgs/msg/Twist": "gz.msgs.Twist",
    "geometry_msgs/msg/TwistStamped": "gz.msgs.Twist",
    "nav_msgs/msg/Odometry": "gz.msgs.Odometry",
    "sensor_msgs/msg/Image": "gz.msgs.Image",
    "sensor_msgs/msg/Imu": "gz.msgs.IMU",
    "sensor_msgs/msg/JointState": "gz.msgs.Model",
    "sensor_msgs/msg/LaserScan": "gz.msgs.LaserScan",
    "tf2_msgs/msg/TFMessage": "gz.msgs.Pose_V",
}


def urdf_problems(text: str) -> list[str]:
    """A URDF: one tree of links, and inertias that a physics engine can use."""
    robot = ElementTree.fromstring(text)
    links = [link.get("name") for link in robot.findall("link")]
    children, problems = [], []
    for joint in robot.findall("joint"):
        ends = joint.find("parent").get("link"), joint.find("child").get("link")
        children.append(ends[1])
        problems += [f"{joint.get('name')}: there is no link {end}" for end in ends if end not in links]
    roots = [link for link in links if link not in children]
    if len(roots) != 1:
        problems.append(f"expected one link without a parent, saw {len(roots)}: {', '.join(roots)}")
    fixed = [joint.find("child").get("link") for joint in robot.findall("joint[@type='fixed']")]
    for link in robot.findall("link"):
        name = link.get("name")
        if name in children and name not in fixed and link.find("inertial") is None:
            problems.append(f"{name} moves and has no inertial: Gazebo ignores the link")
        problems += _inertia_problems(link)
    return problems


def _inertia_problems(link: ElementTree.Element) -> list[str]:
    inertia = link.find("inertial/inertia")
    if inertia is None:
        return []
    x, y, z = (float(inertia.get(name)) for name in ("ixx", "iyy", "izz"))
    if min(x, y, z) <= 0:
        return [f"{link.get('name')}: moments of inertia must be above 0, these are {x:g}, {y:g}, {z:g}"]
    if x + y < z or y + z < x or z + x < y:
        return [f"{link.get('name')}: no body has the moments {x:g}, {y:g}, {z:g}: one exceeds the other two"]
    return []


def bridge_problems(text: str) -> list[str]:
    """The YAML file of ros_gz_bridge: keys, directions, and pairs of types that it can convert."""
    entries, problems = yaml.safe_load(text), []
    if not isinstance(entries, list):
        return ["expected a list: each entry begins with a dash"]
    for number, entry in enumerate(entries, 1):
        name = next((str(entry[key]) for key in NAMES if key in entry), f"entry {number}")
        unknown = sorted(set(entry) - {*NAMES, *TYPES, *OPTIONS})
        problems += [f"{name}: {key} is no key of the bridge" for key in unknown]
        problems += [f"{name}: {key} is missing" for key in TYPES if key not in entry]
        if name == f"entry {number}":
            problems.append(f"{name}: no topic: give {NAMES[0]} or {NAMES[1]}")
        if entry.get("direction", DIRECTIONS[0]) not in DIRECTIONS:
            problems.append(f"{name}: {entry['direction']} is none of {', '.join(DIRECTIONS)}")
        ros, gazebo = (entry.get(key) for key in TYPES)
        if ros and gazebo and PAIRS.get(ros) != gazebo:
            expected = PAIRS.get(ros, "a type of the table")
            problems.append(f"{name}: expected {expected} for {ros}, saw {gazebo}")
    return problems


def controller_problems(controllers: str, urdf: str) -> list[str]:
    """The YAML file of ros2_control's controllers: each is listed with its type, and its joints exist."""
    settings, problems = yaml.safe_load(controllers), []
    joints = {joint.get("name") for joint in ElementTree.fromstring(urdf).findall("joint")}
    manager = settings.get("controller_manager", {}).get("ros__parameters", {})
    listed = {name: value for name, value in manager.items() if isinstance(value, dict)}
    types = {name: value["type"] for name, value in listed.items() if "type" in value}
    for name in settings:
        if name != "controller_manager" and name not in types:
            problems.append(f"{name} is not listed in controller_manager with a type")
        parameters = settings[name].get("ros__parameters")
        if parameters is None:
            problems.append(f"{name}: expected ros__parameters, with two underscores")
            continue
        wanted = [joint for side in ("left", "right") for joint in parameters.get(f"{side}_wheel_names", [])]
        wanted += parameters.get("joints", [])
        problems += [f"{name}: the robot has no joint {joint}" for joint in wanted if joint not in joints]
        if types.get(name) == TRAJECTORIES:
            problems += trajectory_problems(name, parameters)
    return problems


def trajectory_problems(name: str, parameters: dict) -> list[str]:
    """A JointTrajectoryController's parameters: which joints, and what to command and read of each."""
    missing = [key for key in ("joints", "command_interfaces", "state_interfaces") if not parameters.get(key)]
    problems = [f"{name}: {key} is missing, or empty" for key in missing]
    for key in ("command_interfaces", "state_interfaces"):
        unknown = [value for value in parameters.get(key, []) if value not in INTERFACES]
        problems += [f"{name}: {key} has {value}; expected {', '.join(INTERFACES)}" for value in unknown]
    return problems


def read(name: str) -> str:
    """The text of a file in the folder gazebo/."""
    return Path("gazebo", name).read_text(encoding="utf-8")
