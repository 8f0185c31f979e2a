"""Ways to start OneMetre: right ones, and wrong ones named by their defect."""

import rclpy
from geometry_msgs.msg import Twist

from grader.exercises.topics import OneMetre
from sim import Process

PARTS = ("one_metre", "TwoMetres", "StillOnItsWay")  # what the others are made of


def one_metre(*remappings, **settings):
    return Process(OneMetre, remappings=remappings, **settings)


as_task_says = one_metre(("velocity", "/cmd_vel"), ("pose", "/odom"))
without_slashes = one_metre(("velocity", "cmd_vel"), ("pose", "odom"))
with_full_names = one_metre(("/velocity", "/cmd_vel"), ("/pose", "/odom"), name="driver")
with_node_prefix = one_metre(("one_metre:velocity", "/cmd_vel"), ("one_metre:pose", "/odom"))
as_lists = Process(OneMetre, remappings=[["velocity", "/cmd_vel"], ["pose", "/odom"]])
as_words = Process(OneMetre, arguments=["--ros-args", "-r", "velocity:=/cmd_vel", "-r", "pose:=/odom"])


def main():
    rclpy.init(args=["--ros-args", "-r", "velocity:=/cmd_vel", "-r", "pose:=/odom"])
    rclpy.spin(OneMetre())
    rclpy.shutdown()


class TwoMetres(OneMetre):
    """Another goal than the one of the task."""

    def on_pose(self, msg):
        self.x = msg.pose.pose.position.x - 1.0


class StillOnItsWay(OneMetre):
    """Near enough at the end of the run, but it drives on."""

    def drive(self):
        msg = Twist()
        msg.linear.x = 0.125
        self.publisher.publish(msg)


two_metres = Process(TwoMetres, remappings=as_task_says.remappings)
still_on_its_way = Process(StillOnItsWay, remappings=as_task_says.remappings)
not_at_all = one_metre()
only_velocity = one_metre(("velocity", "/cmd_vel"))
only_pose = one_metre(("pose", "/odom"))
the_wrong_way_round = one_metre(("/cmd_vel", "velocity"), ("/odom", "pose"))
crossed = one_metre(("velocity", "/odom"), ("pose", "/cmd_vel"))
misspelt_target = one_metre(("velocity", "/cmdvel"), ("pose", "/odom"))
misspelt_source = one_metre(("velocty", "/cmd_vel"), ("pose", "/odom"))
in_a_namespace = one_metre(("velocity", "cmd_vel"), ("pose", "odom"), namespace="robot")
words_in_place_of_pairs = one_metre("velocity:=/cmd_vel", "pose:=/odom")
one_pair_without_list = Process(OneMetre, remappings=("velocity", "/cmd_vel"))
