"""Ways to start the watcher: right ones, and wrong ones named by their defect."""

import rclpy
from geometry_msgs.msg import Twist
from rclpy.node import Node
from rclpy.time import Time

from grader.exercises.frames import Watcher
from sim import Process

PARTS = ("Both", "Impatient", "Turner")


class Both(Watcher):
    """Drives the other robot, too."""

    def __init__(self):
        super().__init__()
        self.publisher = self.create_publisher(Twist, "/watched", 10)
        self.other = self.create_publisher(Twist, "/cmd_vel", 10)
        self.create_timer(0.1, self.drive)

    def drive(self):
        command = Twist()
        command.linear.x = 0.1
        self.other.publish(command)


class Impatient(Watcher):
    """Gives up where a frame isn't there within a second."""

    looks = 0

    def watch(self):
        self.looks += 1
        known = self.buffer.can_transform("tower/base_link", "scout/base_link", Time())
        if self.looks == 10 and not known:
            raise SystemExit("No frame scout/base_link: nothing to watch")
        super().watch()


class Turner(Node):
    """Turns without a look at anything."""

    def __init__(self):
        super().__init__("watcher")
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_timer(0.1, self.drive)

    def drive(self):
        command = Twist()
        command.angular.z = 0.5
        self.publisher.publish(command)


def launch():
    return Process(Watcher, parameters={"target": "scout"}, remappings=[("cmd_vel", "/tower/cmd_vel")])


def launch_in_a_namespace():
    return Process(Watcher, parameters=[{"target": "scout"}], remappings=[("/cmd_vel", "/tower/cmd_vel")])


def launch_with_words():
    words = ["--ros-args", "-p", "target:=scout", "-r", "cmd_vel:=/tower/cmd_vel"]
    return Process(Watcher, arguments=words)


def main():
    rclpy.init(args=["--ros-args", "-p", "target:=scout", "-r", "cmd_vel:=tower/cmd_vel"])
    rclpy.spin(Watcher())


def launch_in_the_namespace_of_the_tower():
    """A design of its own: cmd_vel is a relative name, so the namespace decides whose commands these are."""
    return Process(Watcher, namespace="/tower", parameters={"target": "scout"})


def launch_in_a_namespace_without_a_slash():
    return Process(Watcher, namespace="tower", parameters=[{"target": "scout"}])


def launch_with_a_namespace_in_words():
    return Process(Watcher, arguments=["--ros-args", "-r", "__ns:=/tower", "-p", "target:=scout"])


def launch_under_another_name():
    """A namespace and a name of its own, as each robot has them."""
    return Process(Watcher, name="tower_watcher", namespace="tower", parameters={"target": "scout"})


def launch_renamed_in_words():
    remappings = [("cmd_vel", "/tower/cmd_vel"), ("__node", "guard")]
    return Process(Watcher, parameters={"target": "scout"}, remappings=remappings)


def in_the_namespace_of_the_scout():
    return Process(Watcher, namespace="/scout", parameters={"target": "scout"})


def as_it_is():
    return Process(Watcher)


def target_alone():
    return Process(Watcher, parameters={"target": "scout"})


def remapping_alone():
    return Process(Watcher, remappings=[("cmd_vel", "/tower/cmd_vel")])


def misspelt_parameter():
    return Process(Watcher, parameters={"targt": "scout"}, remappings=[("cmd_vel", "/tower/cmd_vel")])


def watches_itself():
    return Process(Watcher, parameters={"target": "tower"}, remappings=[("cmd_vel", "/tower/cmd_vel")])


def remapped_the_other_way():
    return Process(Watcher, parameters={"target": "scout"}, remappings=[("/tower/cmd_vel", "cmd_vel")])


def starts_another_program():
    return Process(Turner, remappings=[("cmd_vel", "/tower/cmd_vel")])


def gives_up_after_a_second():
    return Process(Impatient, parameters={"target": "scout"}, remappings=[("cmd_vel", "/tower/cmd_vel")])


def drives_both():
    """Both topics have the same name in the root, so the topic of one of them is set in the program."""
    return Process(Both, parameters={"target": "scout"}, remappings=[("/watched", "/tower/cmd_vel")])
