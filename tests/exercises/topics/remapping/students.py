"""Ways to start OneMeter: right ones, and wrong ones named by their defect."""

import rclpy
from geometry_msgs.msg import Twist

from grader.exercises.topics import OneMeter
from sim import Process

PARTS = ("one_meter", "TwoMeters", "StillOnItsWay")  # what the others are made of


def one_meter(*remappings, **settings):
    return Process(OneMeter, remappings=remappings, **settings)


as_task_says = one_meter(("velocity", "/cmd_vel"), ("pose", "/odom"))
without_slashes = one_meter(("velocity", "cmd_vel"), ("pose", "odom"))
with_full_names = one_meter(("/velocity", "/cmd_vel"), ("/pose", "/odom"), name="driver")
with_node_prefix = one_meter(("one_meter:velocity", "/cmd_vel"), ("one_meter:pose", "/odom"))
as_lists = Process(OneMeter, remappings=[["velocity", "/cmd_vel"], ["pose", "/odom"]])
as_words = Process(OneMeter, arguments=["--ros-args", "-r", "velocity:=/cmd_vel", "-r", "pose:=/odom"])


def main():
    rclpy.init(args=["--ros-args", "-r", "velocity:=/cmd_vel", "-r", "pose:=/odom"])
    rclpy.spin(OneMeter())
    rclpy.shutdown()


class TwoMeters(OneMeter):
    """Another goal than the one of the task."""

    def on_pose(self, msg):
        self.x = msg.pose.pose.position.x - 1.0


class StillOnItsWay(OneMeter):
    """Near enough at the end of the run, but it drives on."""

    def drive(self):
        msg = Twist()
        msg.linear.x = 0.125
        self.publisher.publish(msg)


two_meters = Process(TwoMeters, remappings=as_task_says.remappings)
still_on_its_way = Process(StillOnItsWay, remappings=as_task_says.remappings)
not_at_all = one_meter()
the_wrong_way_round = one_meter(("/cmd_vel", "velocity"), ("/odom", "pose"))
crossed = one_meter(("velocity", "/odom"), ("pose", "/cmd_vel"))
misspelt_target = one_meter(("velocity", "/cmdvel"), ("pose", "/odom"))
in_a_namespace = one_meter(("velocity", "cmd_vel"), ("pose", "odom"), namespace="robot")
words_in_place_of_pairs = one_meter("velocity:=/cmd_vel", "pose:=/odom")
one_pair_without_list = Process(OneMeter, remappings=("velocity", "/cmd_vel"))
