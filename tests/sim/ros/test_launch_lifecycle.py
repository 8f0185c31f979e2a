"""Lifecycle nodes in launch files: their transitions are events, and events request transitions."""

import re
import subprocess
import sys
import textwrap

import pytest

from sim import run
from tests.patience import PATIENCE
from tests.sim.standalone.programs import environment, free_domain

LAMP = """
import sys, time
import rclpy
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn


class Lamp(LifecycleNode):
    def on_configure(self, state):
        if "slow" in sys.argv:
            time.sleep(20.0)
        return getattr(TransitionCallbackReturn, sys.argv[1], TransitionCallbackReturn.SUCCESS)

    def on_activate(self, state):
        self.get_logger().info("lit")
        return super().on_activate(state)


rclpy.init()
lamp = Lamp("lamp")
try:
    rclpy.spin(lamp)
except KeyboardInterrupt:
    pass
"""
FILE = """
import sys
from launch import LaunchDescription
from launch.actions import EmitEvent, LogInfo, RegisterEventHandler, Shutdown, TimerAction
from launch.events import matches_action
from launch_ros.actions import LifecycleNode, LifecycleTransition
from launch_ros.event_handlers import OnStateTransition
from launch_ros.events.lifecycle import ChangeState
from lifecycle_msgs.msg import Transition


def lamp(word="SUCCESS", **more):
    arguments = ["{folder}/lamp.py", *word.split()]
    found = dict(executable=sys.executable, exec_name="lamp", arguments=arguments, name="lamp", namespace="")
    return LifecycleNode(**(found | more))


def request(node, transition):
    return EmitEvent(event=ChangeState(lifecycle_node_matcher=matches_action(node), transition_id=transition))


def reached(node, state, *entities):
    return RegisterEventHandler(
        OnStateTransition(target_lifecycle_node=node, goal_state=state, entities=list(entities))
    )


def generate_launch_description():
{lines}
"""

BY_EVENTS = """
node = lamp()
return LaunchDescription([
    reached(node, "inactive", LogInfo(msg="is inactive"), request(node, Transition.TRANSITION_ACTIVATE)),
    reached(node, "active", LogInfo(msg="is active"), Shutdown(reason="done")),
    node,
    request(node, Transition.TRANSITION_CONFIGURE),
])
"""
XML = """
<launch>
  <arg name="auto" default="true"/>
  <lifecycle_node name="lamp" namespace="{namespace}" exec="python3" args="{folder}/lamp.py ok" {more}/>
</launch>
"""


@pytest.fixture
def launch_file(tmp_path):
    (tmp_path / "lamp.py").write_text(LAMP)
    (tmp_path / "none.py").write_text("pass")
    (tmp_path / "waits.py").write_text("import time; time.sleep(5.0)")

    def write(lines):
        file = tmp_path / "lamp.launch.py"
        lines = textwrap.indent(lines.strip(), "    ")
        file.write_text(FILE.replace("{lines}", lines).replace("{folder}", str(tmp_path)))
        return file

    return write


def logged(recording):
    """The log lines but those that a process was started, with their stamps."""
    lines = [f"[{line.level}] [{line.stamp:.1f}] [{line.node}]: {line.text}" for line in recording.logs]
    return [line for line in lines if "process started" not in line]


def test_events_bring_a_node_to_active(launch_file):
    recording = run(launch_file(BY_EVENTS), seconds=5, quiet=True)
    assert logged(recording) == [
        "[INFO] [0.1] [launch.user]: is inactive",
        "[INFO] [0.1] [lamp]: lit",
        "[INFO] [0.1] [launch.user]: is active",
        "[INFO] [0.1] [lamp-1]: sending signal 'SIGINT' to process[lamp-1]",
        "[INFO] [0.1] [lamp-1]: process has finished cleanly [pid 1]",
    ]
    assert recording.errors == []
    assert recording.digest == run(launch_file(BY_EVENTS), seconds=5, quiet=True).digest


def test_events_bring_a_node_of_a_real_process_to_active(launch_file):
    command = [sys.executable, "-m", "sim.ros2.terminal", "launch", str(launch_file(BY_EVENTS))]
    variables = environment(ROS_DOMAIN_ID=str(free_domain()), ROS_AUTOMATIC_DISCOVERY_RANGE="LOCALHOST")
    done = subprocess.run(
        command, env=variables, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=PATIENCE
    )
    assert done.returncode == 0
    lines = [re.sub(r"\[\d+\.\d+\]", "[STAMP]", line) for line in done.stdout.splitlines()]
    # The output of the process comes through a pipe: where its line stands among those of launch is open.
    lit = "[lamp-1] [INFO] [STAMP] [lamp]: lit"
    assert lit in lines
    assert [line for line in lines if line != lit][3:6] == [
        "[INFO] [launch.user]: is inactive",
        "[INFO] [launch.user]: is active",
        "[INFO] [lamp-1]: sending signal 'SIGINT' to process[lamp-1]",
    ]


@pytest.mark.parametrize(
    ("more", "arguments", "lines"),
    [
        ('autostart="true"', "", ["[INFO] [0.1] [hall.lamp]: lit"]),
        ('autostart="$(var auto)"', "", ["[INFO] [0.1] [hall.lamp]: lit"]),
        ('autostart="$(var auto)"', "auto:=false", []),
        ("", "", []),
    ],
)
def test_a_node_in_xml_starts_active_with_autostart(tmp_path, more, arguments, lines):
    (tmp_path / "lamp.py").write_text(LAMP)
    file = tmp_path / "lamp.launch.xml"
    file.write_text(XML.format(namespace="hall", folder=tmp_path, more=more).strip())
    assert logged(run(f"{file} {arguments}", seconds=1, quiet=True)) == lines


def test_yaml_has_the_same(tmp_path):
    (tmp_path / "lamp.py").write_text(LAMP)
    file = tmp_path / "lamp.launch.yaml"
    entity = f"{{name: lamp, namespace: '', exec: python3, args: {tmp_path}/lamp.py ok, autostart: true}}"
    file.write_text(f"launch:\n- lifecycle_node: {entity}\n")
    assert logged(run(file, seconds=1, quiet=True)) == ["[INFO] [0.1] [lamp]: lit"]


ONE_AND_BACK = """
ids = [Transition.TRANSITION_CONFIGURE, Transition.TRANSITION_ACTIVATE, 4]
goals = ("inactive", "active")
node = lamp(namespace="hall")
return LaunchDescription([
    node,
    LifecycleTransition(lifecycle_node_names=["hall/lamp"], transition_ids=ids),
    *(reached(node, goal, LogInfo(msg=goal)) for goal in goals),
    RegisterEventHandler(OnStateTransition(start_state="deactivating", entities=LogInfo(msg="out"))),
])
"""


def test_transitions_follow_each_other(launch_file):
    recording = run(launch_file(ONE_AND_BACK), seconds=1, quiet=True)
    texts = [line.text for line in recording.logs if line.node == "launch.user"]
    assert texts == ["inactive", "active", "inactive", "out"] or texts == [
        "inactive",
        "active",
        "out",
        "inactive",
    ]


MANAGER = "launch_ros.utilities.lifecycle_event_manager"
TRANSITION = "launch_ros.actions.lifecycle_transition"


@pytest.mark.parametrize(
    ("lines", "expected"),
    [
        (
            "return LaunchDescription([lamp('FAILURE', autostart=True)])",
            f"[ERROR] [0.1] [{MANAGER}]: Failed to make transition 'TRANSITION_CONFIGURE' for "
            "LifecycleNode '/lamp'",
        ),
        (
            "return LaunchDescription([lamp('ERROR', autostart='true')])",
            f"[INFO] [0.1] [{TRANSITION}]: Stopping transitions for /lamp because "
            "'error occured during transitions'",
        ),
        (
            "return LaunchDescription([lamp(arguments=['{folder}/none.py'], autostart=True)])",
            f"[WARN] [0.1] [{MANAGER}]: Abandoning wait for the '/lamp/change_state' service, because "
            "the node has exited.",
        ),
        (
            "return LaunchDescription([lamp(arguments=['{folder}/waits.py'], autostart=True),"
            " TimerAction(period=1.0, actions=[Shutdown()])])",
            f"[WARN] [1.0] [{MANAGER}]: Abandoning wait for the '/lamp/change_state' service, due to "
            "shutdown.",
        ),
        (
            "return LaunchDescription([lamp('SUCCESS slow', autostart=True),"
            " TimerAction(period=1.0, actions=[Shutdown()])])",
            f"[WARN] [1.0] [{MANAGER}]: Abandoning wait for the '/lamp/change_state' service response, "
            "due to shutdown.",
        ),
    ],
)
def test_what_stops_transitions_is_logged(launch_file, lines, expected):
    recording = run(launch_file(lines), seconds=3, quiet=True)
    assert expected in logged(recording)
