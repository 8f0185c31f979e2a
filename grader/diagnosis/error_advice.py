"""From an exception to advice for a beginner."""

from __future__ import annotations

import re

from grader.diagnosis.field_rules import FIELD_RULES
from grader.diagnosis.package_rules import PACKAGE_RULES, launch_file_advice
from grader.diagnosis.parameter_rules import PARAMETER_RULES
from grader.diagnosis.python_rules import PYTHON_RULES
from grader.diagnosis.rules import RULES
from grader.diagnosis.sensor_rules import SENSOR_RULES
from grader.diagnosis.service_rules import SERVICE_RULES
from grader.diagnosis.transform_rules import TRANSFORM_RULES
from sim.evidence import CallbackError
from sim.notebook import explain_missing_name
from sim.ros.absent_names import explain_absent_name
from sim.suggestions import closest_match

_HOMES = {
    "rclpy": "import rclpy",
    "Node": "from rclpy.node import Node",
    "QoSProfile": "from rclpy.qos import QoSProfile",
    **{
        name: f"from std_msgs.msg import {name}"
        for name in ("String", "Bool", "Int32", "Int64", "Float32", "Float64", "Empty")
    },
    **{name: f"from geometry_msgs.msg import {name}" for name in ("Twist", "Vector3", "Pose", "PoseStamped")},
    **{
        name: f"from sensor_msgs.msg import {name}"
        for name in ("Imu", "LaserScan", "JointState", "Temperature")
    },
    "Odometry": "from nav_msgs.msg import Odometry",
    **{name: f"from std_srvs.srv import {name}" for name in ("SetBool", "Trigger")},
    "AddTwoInts": "from example_interfaces.srv import AddTwoInts",
    "Fibonacci": "from example_interfaces.action import Fibonacci",
    **{
        name: f"from rclpy.action import {name}"
        for name in ("ActionClient", "ActionServer", "CancelResponse", "GoalResponse")
    },
    "MultiThreadedExecutor": "from rclpy.executors import MultiThreadedExecutor",
    **{
        name: f"from rclpy.callback_groups import {name}"
        for name in ("MutuallyExclusiveCallbackGroup", "ReentrantCallbackGroup")
    },
}


_ALL_RULES = (
    *PACKAGE_RULES,
    *SERVICE_RULES,
    *PARAMETER_RULES,
    *SENSOR_RULES,
    *TRANSFORM_RULES,
    *FIELD_RULES,
    *RULES,
    *PYTHON_RULES,
)


def advice(error: CallbackError) -> str:
    """Return what to do about an error, if it's one of the usual ones; else ""."""
    if error.type == "NameError":
        return _unknown_name(error)
    absent = explain_absent_name(error.type, error.text) or launch_file_advice(error)
    if absent:
        return absent
    for rule in _ALL_RULES:
        found = re.search(rule.pattern, error.text) if error.type == rule.type else None
        if found:
            return rule.advice.format(*found.groups())
    if error.type == "AttributeError":
        return _unknown_attribute(error)
    return ""


def _unknown_name(error: CallbackError) -> str:
    name = next(iter(re.findall(r"name '(\w+)'", error.text)), "")
    not_run = explain_missing_name(name)
    if not_run:
        return not_run
    if name in _HOMES:
        return f"`{name}` is not imported: write `{_HOMES[name]}` at the top."
    near = closest_match(name, _HOMES, 0.75)
    if near:
        return f"Python doesn't know `{name}`. Did you mean `{near}`? Import it with `{_HOMES[near]}`."
    return (
        f"Python doesn't know `{name}` here: it is a typo, its import is missing, or it belongs to the node, "
        f"as `self.{name}`."
    )


def _unknown_attribute(error: CallbackError) -> str:
    found = re.search(r"'(\w+)' object has no attribute '(\w+)'", error.text)
    if not found:
        return ""
    owner, name = found.groups()
    owner = re.sub(r"_(Request|Response|Goal|Result|Feedback)$", r".\1", owner)  # as students write it
    own = error.callback.split(".")[0] == owner
    near = re.search(r"Did you mean: '(\w+)'", error.text)
    if near:
        return f"There is no `{'self.' * own}{name}`. Did you mean `{'self.' * own}{near[1]}`?"
    if own:
        return (
            f"`self.{name}` does not exist (yet): check its spelling; set it in __init__ before it is used."
        )
    if not owner[0].isupper():
        return f"A {owner} has no `{name}`: check its spelling, and what the name before the dot stands for."
    return (
        f"{owner} has no `{name}`: check its spelling. For a message, `{owner}.get_fields_and_field_types()` "
        "lists the fields."
    )
