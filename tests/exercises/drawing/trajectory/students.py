"""Clients of FollowJointTrajectory: right ones, and wrong ones named by their defect."""

import math

import rclpy
from action_msgs.msg import GoalStatus
from control_msgs.action import FollowJointTrajectory
from rclpy.action import ActionClient
from rclpy.duration import Duration
from rclpy.node import Node
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64, String
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint

ACTION = "/arm_controller/follow_joint_trajectory"


class Student(Node):
    """As one would write it; the wrong ones change one thing each."""

    speed = 0.8

    def __init__(self):
        super().__init__("student")
        self.now = {}  # the joints' positions by name
        self.client = ActionClient(self, FollowJointTrajectory, ACTION)
        self.errors = self.create_publisher(Float64, "/worst_error", 10)
        self.outcomes = self.create_publisher(String, "/outcome", 10)
        self.create_subscription(JointState, "/joint_states", self.on_joints, 10)
        self.create_subscription(JointTrajectory, "/path", self.on_path, 10)

    def on_joints(self, msg):
        self.now.update(zip(msg.name, msg.position, strict=False))

    def on_path(self, path):
        goal = FollowJointTrajectory.Goal()
        goal.trajectory.joint_names = self.names(path)
        before, time = self.start(path), 0.0
        for point in path.points:
            positions = self.positions(point)
            time = self.later(time, self.way(before, positions) / self.speed)
            stamp = Duration(seconds=time).to_msg()
            goal.trajectory.points.append(JointTrajectoryPoint(positions=positions, time_from_start=stamp))
            before = positions
        self.send(goal)

    def names(self, path):
        return path.joint_names

    def positions(self, point):
        return list(point.positions)

    def start(self, path):
        return [self.now[name] for name in path.joint_names]

    def way(self, before, after):
        return max(abs(b - a) for a, b in zip(before, after, strict=False))

    def later(self, time, needed):
        return time + needed

    def send(self, goal):
        self.client.send_goal_async(goal, self.on_feedback).add_done_callback(self.on_response)

    def on_feedback(self, msg):
        self.errors.publish(Float64(data=self.worst(msg.feedback.error.positions)))

    def worst(self, errors):
        return max(abs(error) for error in errors)

    def on_response(self, future):
        if not future.result().accepted:
            self.say("rejected")
            return
        future.result().get_result_async().add_done_callback(self.on_result)

    def on_result(self, future):
        answer = future.result()
        if answer.status == GoalStatus.STATUS_SUCCEEDED:
            self.say("succeeded")
        else:
            self.say(f"aborted: {answer.result.error_string}")

    def say(self, text):
        self.outcomes.publish(String(data=text))


class WithAwait(Student):
    """The whole conversation in one coroutine; and a little slower than needed."""

    speed = 0.7

    async def on_path(self, path):
        super().on_path(path)

    def send(self, goal):
        self.executor.create_task(self.talk, goal)

    async def talk(self, goal):
        handle = await self.client.send_goal_async(goal, feedback_callback=self.on_feedback)
        if not handle.accepted:
            return self.say("rejected")
        answer = await handle.get_result_async()
        result = answer.result
        good = result.error_code == FollowJointTrajectory.Result.SUCCESSFUL
        return self.say("succeeded" if good else f"aborted: {result.error_string}")


class InItsOwnOrder(Student):
    """A design of its own: sorts the joints, and their positions with them."""

    def names(self, path):
        self.order = sorted(range(2), key=lambda index: path.joint_names[index])
        return [path.joint_names[index] for index in self.order]

    def positions(self, point):
        return [point.positions[index] for index in self.order]

    def start(self, path):
        return [self.now[path.joint_names[index]] for index in self.order]


class ByIndex(Student):
    """Shoulder first, whatever the path says."""

    def names(self, path):
        return ["shoulder_joint", "elbow_joint"]


class StartByIndex(Student):
    """Takes where the arm is in the order of the driver."""

    def on_joints(self, msg):
        self.latest = list(msg.position)

    def start(self, path):
        return self.latest


class Degrees(Student):
    def positions(self, point):
        return [math.degrees(position) for position in point.positions]


class OnePointOnly(Student):
    def on_path(self, path):
        path.points = path.points[-1:]
        super().on_path(path)


class TimesDoNotRise(Student):
    """Each time counts from the point before."""

    def later(self, time, needed):
        return needed


class NoTimes(Student):
    def later(self, time, needed):
        return 0.0


class TwoSecondsEach(Student):
    def later(self, time, needed):
        return time + 2.0


class SumOfTheWays(Student):
    """As if one joint turned after the other."""

    def way(self, before, after):
        return sum(abs(b - a) for a, b in zip(before, after, strict=False))


class FromZero(Student):
    """As if the arm were always stretched out."""

    def start(self, path):
        return [0.0, 0.0]


class FirstJointOnly(Student):
    def way(self, before, after):
        return abs(after[0] - before[0])


class WithoutAbs(Student):
    def worst(self, errors):
        return max(errors)


class NoFeedback(Student):
    def on_feedback(self, msg):
        pass


class WaitsForNoVelocity(Student):
    """Begins when the arm is at rest: but a noisy encoder measures 0.0 hardly ever."""

    waiting = None

    def on_joints(self, msg):
        super().on_joints(msg)
        if self.waiting is not None and all(rate == 0.0 for rate in msg.velocity):
            path, self.waiting = self.waiting, None
            super().on_path(path)

    def on_path(self, path):
        self.waiting = path


class DoesNotAskForAcceptance(Student):
    """Waits for the result of a goal that was rejected."""

    def on_response(self, future):
        future.result().get_result_async().add_done_callback(self.on_result)


class AlwaysSucceeded(Student):
    def on_result(self, future):
        self.say("succeeded")


class SaysAccepted(Student):
    def on_response(self, future):
        self.say("accepted")
        super().on_response(future)


class SaysNothing(Student):
    def say(self, text):
        pass


def main_that_spins_in_its_callback():
    """The classic deadlock: waits inside a callback for what only the executor could bring."""
    rclpy.init()
    node = Student()

    def send(goal):
        future = node.client.send_goal_async(goal, feedback_callback=node.on_feedback)
        while not future.done():
            node.get_clock().sleep_for(Duration(seconds=0.05))
        node.on_response(future)

    node.send = send
    rclpy.spin(node)


class Rounded(Student):
    def positions(self, point):
        return [round(position, 1) for position in point.positions]


class NeverBeginsAnew(Student):
    """The times of a path go on from those of the path before."""

    time = 0.0

    def later(self, time, needed):
        self.time += needed
        return self.time
