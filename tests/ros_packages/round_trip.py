"""Serve and use one interface of each kind in the real rclpy, and print what came back as JSON.

    python round_trip.py SECONDS    how long an answer may take, until it counts as missing

Run as a process of its own by test_round_trip.py and, under other Pythons, by test_other_pythons.py.
"""

import json
import sys
import threading
import time

import rclpy
from action_msgs.msg import GoalStatus
from example_interfaces.action import Fibonacci
from example_interfaces.srv import AddTwoInts
from geometry_msgs.msg import TransformStamped
from nav2_msgs.action import NavigateToPose
from rclpy.action import ActionClient, ActionServer, CancelResponse
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from tf2_msgs.msg import TFMessage

TIMEOUT = float(sys.argv[1])
PAUSE = 20  # a goal of more numbers waits there to be canceled


class Server(Node):
    """Answers sums, counts Fibonacci numbers, and drives to a pose without a robot."""

    def __init__(self):
        super().__init__("server", namespace="interfaces", start_parameter_services=False)
        group = ReentrantCallbackGroup()
        self.create_service(AddTwoInts, "add", self.add, callback_group=group)
        ActionServer(
            self,
            Fibonacci,
            "count",
            self.count,
            callback_group=group,
            cancel_callback=lambda _: CancelResponse.ACCEPT,
        )
        ActionServer(self, NavigateToPose, "drive", self.drive, callback_group=group)

    def add(self, request, response):
        response.sum = request.a + request.b
        return response

    def count(self, goal):
        feedback = Fibonacci.Feedback(sequence=[0, 1])
        while len(feedback.sequence) < goal.request.order:
            if goal.is_cancel_requested:
                goal.canceled()
                return Fibonacci.Result(sequence=feedback.sequence)
            if len(feedback.sequence) < PAUSE:
                feedback.sequence.append(feedback.sequence[-1] + feedback.sequence[-2])
                goal.publish_feedback(feedback)
            time.sleep(0.02)
        goal.succeed()
        return Fibonacci.Result(sequence=feedback.sequence)

    def drive(self, goal):
        goal.publish_feedback(NavigateToPose.Feedback(current_pose=goal.request.pose, distance_remaining=1.5))
        goal.abort()
        return NavigateToPose.Result(error_code=7, error_msg=f"no tree {goal.request.behavior_tree}")


class Client(Node):
    """Calls the server and stores its answers."""

    def __init__(self):
        super().__init__("client", namespace="interfaces", start_parameter_services=False)
        self.received = []
        self.publisher = self.create_publisher(TFMessage, "tf", 10)
        self.create_subscription(TFMessage, "tf", self.received.append, 10)

    def add(self, a, b):
        client = self.create_client(AddTwoInts, "add")
        assert client.wait_for_service(TIMEOUT)
        return wait(client.call_async(AddTwoInts.Request(a=a, b=b))).sum

    def run(self, action, name, goal, feedbacks, cancel=False):
        feedback = []
        client = ActionClient(self, action, name)
        assert client.wait_for_server(TIMEOUT)
        handle = wait(client.send_goal_async(goal, lambda message: feedback.append(message.feedback)))
        if cancel:
            until(lambda: len(feedback) >= feedbacks)
            assert len(wait(handle.cancel_goal_async()).goals_canceling) == 1
        answer = wait(handle.get_result_async())
        # The result and the last feedback are separate messages; either may come first.
        until(lambda: len(feedback) >= feedbacks)
        return answer, feedback

    def transform(self):
        transform = TransformStamped(child_frame_id="base_link")
        transform.header.frame_id = "odom"
        transform.transform.translation.x = 1.25
        until(lambda: self.publisher.get_subscription_count())
        self.publisher.publish(TFMessage(transforms=[transform, transform]))
        until(lambda: self.received)
        return self.received[0].transforms


def until(condition):
    end = time.monotonic() + TIMEOUT
    while not condition():
        assert time.monotonic() < end, "nothing came back in time"
        time.sleep(0.005)


def wait(future):
    until(future.done)
    return future.result()


def use(client):
    counted, steps = client.run(Fibonacci, "count", Fibonacci.Goal(order=8), feedbacks=6)
    canceled, _ = client.run(Fibonacci, "count", Fibonacci.Goal(order=40), feedbacks=2, cancel=True)
    goal = NavigateToPose.Goal(behavior_tree="none.xml")
    goal.pose.header.frame_id, goal.pose.pose.position.x = "map", 2.5
    driven, shown = client.run(NavigateToPose, "drive", goal, feedbacks=1)
    (endpoint,) = client.get_publishers_info_by_topic("tf")
    return {
        "sum": client.add(2**40, 3),
        "count": [counted.status == GoalStatus.STATUS_SUCCEEDED, list(counted.result.sequence)],
        "steps": [list(step.sequence) for step in steps],
        "canceled": [
            canceled.status == GoalStatus.STATUS_CANCELED,
            len(canceled.result.sequence) <= PAUSE,
        ],
        "drive": [
            driven.status == GoalStatus.STATUS_ABORTED,
            driven.result.error_code,
            driven.result.error_msg,
        ],
        "shown": [[each.current_pose.header.frame_id, each.current_pose.pose.position.x] for each in shown],
        "transforms": [
            [t.header.frame_id, t.child_frame_id, t.transform.translation.x] for t in client.transform()
        ],
        "tf hash": str(endpoint.topic_type_hash),
    }


def main():
    rclpy.init()
    server, client = Server(), Client()
    executor = MultiThreadedExecutor(4)
    for node in (server, client):
        executor.add_node(node)
    spinning = threading.Thread(target=executor.spin, daemon=True)
    spinning.start()
    print(json.dumps(use(client)))
    executor.shutdown()
    spinning.join()
    rclpy.shutdown()


main()
