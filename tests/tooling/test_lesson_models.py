"""Programs that lessons give as models do what their text says, above all when they have to stop."""

import importlib
import sys

import pytest
from geometry_msgs.msg import Twist
from lifecycle_msgs.srv import ChangeState
from rclpy.lifecycle import LifecycleNode, TransitionCallbackReturn
from rclpy.node import Node

from sim import Process, run
from tests.tooling.test_lessons import ROOT, cells


def motor():
    """The class Motor of lesson 12."""
    names = {"LifecycleNode": LifecycleNode, "TransitionCallbackReturn": TransitionCallbackReturn}
    names["Twist"] = Twist
    exec(dict(cells("course", "12_safety/lesson"))["life-class"], names)
    return names["Motor"]


class Manager(Node):
    """Requests a transition every second, and logs how many publishers the robot's commands have."""

    labels = ()

    def __init__(self):
        super().__init__("manager")
        self.client = self.create_client(ChangeState, "/motor/change_state")
        self.left = list(self.labels)
        self.create_timer(1.0, self.tick)

    def tick(self):
        self.get_logger().info(f"{self.count_publishers('/cmd_vel')}")
        if self.left:
            request = ChangeState.Request()
            request.transition.label = self.left.pop(0)
            self.client.call_async(request)


def managed(node, *labels):
    """A run in which the node goes through these transitions, at 1 s, 2 s, ..."""
    manager = type("Manager", (Manager,), {"labels": labels})
    return run(node, companions=[manager], world="yard", seconds=len(labels) + 2.5, quiet=True)


def drives(recording, second):
    """The speeds that were commanded within a second of the run, m/s."""
    rows = recording.during(second + 0.2, second + 0.99).messages("/cmd_vel")
    return [row.message.linear.x for row in rows]


def motor_that_fails():
    """A motor whose activation fails when it already drives."""

    class Fails(motor()):
        def on_activate(self, state):
            super().on_activate(state)
            raise RuntimeError("the motor has no current")

    return Fails


def test_a_lifecycle_node_drives_only_while_it_is_active():
    recording = managed(motor(), "configure", "activate", "deactivate", "activate")
    assert [set(drives(recording, second)) for second in range(1, 6)] == [set(), {0.3}, set(), {0.3}, {0.3}]


@pytest.mark.parametrize("last", ["deactivate", "shutdown"])
def test_a_lifecycle_node_stops_the_robot_from_whatever_state_it_is_taken(last):
    recording = managed(motor(), "configure", "activate", last)
    commands = recording.during(2.95).messages("/cmd_vel")
    assert commands[-1].message == Twist()
    assert drives(recording, 3) == drives(recording, 4) == []
    before, after = (recording.pose_at(stamp) for stamp in (3.6, recording.ended.stamp))
    assert before[1:] == pytest.approx(after[1:])


def test_a_lifecycle_node_that_is_configured_again_has_one_timer_and_one_publisher():
    again = managed(motor(), "configure", "activate", "deactivate", "cleanup", "configure", "activate")
    assert len(drives(again, 6)) == len(drives(again, 2))
    counted = [line.text for line in again.logs if line.node == "manager"]
    assert counted == ["0", "1", "1", "1", "0", "1", "1", "1"]


def test_a_lifecycle_node_that_fails_while_it_drives_stops():
    recording = managed(motor_that_fails(), "configure", "activate")
    assert drives(recording, 3) == []
    assert recording.messages("/cmd_vel")[-1].message == Twist()


class Stopper(Node):
    """Logs its gap."""

    def __init__(self):
        super().__init__("stopper")
        self.get_logger().info(f"{self.declare_parameter('gap', 0.3).value}")


@pytest.mark.parametrize(("last", "gap"), [("/right/stopper", "1.5"), ("/**", "0.5")])
def test_of_two_parts_of_a_settings_file_the_later_one_counts(last, gap, tmp_path):
    parts = sorted(("/**", "/right/stopper"), key=lambda part: part == last)
    values = {"/**": 0.5, "/right/stopper": 1.5}
    text = "".join(f"{part}:\n  ros__parameters:\n    gap: {values[part]}\n" for part in parts)
    (tmp_path / "stopper.yaml").write_text(text)
    words = ["--ros-args", "--params-file", str(tmp_path / "stopper.yaml")]
    recording = run(Process(Stopper, namespace="/right", arguments=words), seconds=1, quiet=True)
    assert [line.text for line in recording.logs if line.node == "right.stopper"] == [gap]


def test_the_courier_of_lesson_15_is_unlucky_in_the_order_that_the_lesson_shows(monkeypatch):
    monkeypatch.syspath_prepend(ROOT / "course/15_races")
    courier = importlib.import_module("courier")
    monkeypatch.setitem(sys.modules, "courier", courier)  # forgotten afterwards
    pushed = {
        order: bool(run(courier.main, world=courier.CORRIDOR, seconds=4, quiet=True, order=order).contacts)
        for order in (0, 148, courier.UNLUCKY)
    }
    assert pushed == {0: False, 148: False, courier.UNLUCKY: True}
