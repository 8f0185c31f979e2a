"""Six small systems: two are right in every order, and four are right by luck."""
# mypy: disable-error-code="var-annotated, assignment"
# Students see these classes, which are written as in a lesson.

from collections.abc import Mapping
from typing import NamedTuple

from rclpy.node import Node
from rclpy.task import Future
from std_msgs.msg import Bool, Float64, Int32, String
from std_srvs.srv import Trigger


class Labeler(Node):
    """Publishes a label for each parcel: its number, its color and its weight."""

    def __init__(self) -> None:
        super().__init__("labeler")
        self.seen = {}
        self.labels = self.create_publisher(String, "labels", 10)
        self.create_subscription(String, "scale", self.on_scale, 10)
        self.create_subscription(String, "camera", self.on_camera, 10)

    def on_scale(self, msg: String) -> None:
        """Store a weight: "7 2.4" means that parcel 7 weighs 2.4 kg."""
        self.store("weight", *msg.data.split())

    def on_camera(self, msg: String) -> None:
        """Store a color: "7 red" means that parcel 7 is red."""
        self.store("color", *msg.data.split())

    def store(self, kind: str, parcel: str, value: str) -> None:
        """Publish the label when both are there."""
        self.seen[kind] = value
        if len(self.seen) == 2:
            self.labels.publish(String(data=f"{parcel} {self.seen['color']} {self.seen['weight']}"))
            self.seen = {}


class Dock(Node):
    """Opens the gate for one robot after the other, and admits it; there is room for one."""

    def __init__(self) -> None:
        super().__init__("dock")
        self.robot, self.waiting = None, []  # the one in the dock; those that have arrived
        self.admitted = self.create_publisher(String, "admitted", 10)
        self.gate = self.create_client(Trigger, "open_gate")
        self.create_subscription(String, "arrivals", self.on_arrival, 10)
        self.create_subscription(String, "departures", self.on_departure, 10)

    def on_arrival(self, msg: String) -> None:
        """Store the name of a robot that has arrived."""
        self.waiting.append(msg.data)
        self.take_next()

    def on_departure(self, msg: String) -> None:
        """The dock is free."""
        self.robot = None
        self.take_next()

    def take_next(self) -> None:
        """Open the gate for the robot that waits longest, if the dock is free."""
        if self.robot is None and self.waiting:
            robot = self.waiting.pop(0)
            future = self.gate.call_async(Trigger.Request())
            future.add_done_callback(lambda _: self.admit(robot))

    def admit(self, robot: str) -> None:
        """The gate is open."""
        self.robot = robot
        self.admitted.publish(String(data=robot))


class Collector(Node):
    """Publishes the points of a path as one message."""

    def __init__(self) -> None:
        super().__init__("collector")
        self.points, self.count = [], None
        self.paths = self.create_publisher(String, "paths", 10)
        self.create_subscription(String, "points", self.on_point, 10)
        self.create_subscription(Int32, "path_sizes", self.on_size, 10)

    def on_point(self, msg: String) -> None:
        """Store a point."""
        self.points.append(msg.data)

    def on_size(self, msg: Int32) -> None:
        """A path has this number of points."""
        self.count = msg.data
        self.send()

    def send(self) -> None:
        """Publish the path, and keep the points of the next one."""
        self.paths.publish(String(data=" ".join(self.points[: self.count])))
        self.points, self.count = self.points[self.count :], None


class Rider(Node):
    """Calls a lift, and enters the one that was sent when its doors have opened."""

    def __init__(self) -> None:
        super().__init__("rider")
        self.lift = None  # the one to wait for
        self.enter = self.create_publisher(String, "enter", 10)
        self.caller = self.create_client(Trigger, "call_lift")
        self.create_subscription(String, "rides", self.on_ride, 10)
        self.create_subscription(String, "open_doors", self.on_doors, 10)

    def on_ride(self, msg: String) -> None:
        """The robot wants to ride to this floor."""
        self.lift = None
        self.caller.call_async(Trigger.Request()).add_done_callback(self.on_called)

    def on_called(self, future: Future) -> None:
        """Store which lift is coming."""
        self.lift = future.result().message

    def on_doors(self, msg: String) -> None:
        """The doors of this lift have opened."""
        if msg.data == self.lift:
            self.enter.publish(msg)
            self.lift = None


class JobStarter(Node):
    """Starts a job for an order, and cancels it if a stop follows."""

    def __init__(self) -> None:
        super().__init__("job_starter")
        self.job, self.stopped = None, False
        self.cancels = self.create_publisher(String, "cancels", 10)
        self.starter = self.create_client(Trigger, "start_job")
        self.create_subscription(String, "orders", self.on_order, 10)
        self.create_subscription(String, "stops", self.on_stop, 10)

    def on_order(self, msg: String) -> None:
        """Start its job."""
        self.job, self.stopped = None, False
        self.starter.call_async(Trigger.Request()).add_done_callback(self.on_started)

    def on_started(self, future: Future) -> None:
        """Store the number of the job."""
        self.job = future.result().message
        self.cancel()

    def on_stop(self, msg: String) -> None:
        """The job has to stop."""
        self.stopped = True
        self.cancel()

    def cancel(self) -> None:
        """Publish the number of a job that was stopped."""
        if self.stopped and self.job is not None:
            self.cancels.publish(String(data=self.job))
            self.job = None


class SpeedGate(Node):
    """Passes the speed of a joystick on, or 0 if something is close."""

    def __init__(self) -> None:
        super().__init__("speed_gate")
        self.speed, self.blocked = 0.0, False
        self.speeds = self.create_publisher(Float64, "speed", 10)
        self.create_subscription(Float64, "joystick", self.on_joystick, 10)
        self.create_subscription(Bool, "close", self.on_close, 10)
        self.create_timer(0.05, self.publish)

    def on_joystick(self, msg: Float64) -> None:
        """Store the speed."""
        self.speed = msg.data

    def on_close(self, msg: Bool) -> None:
        """Store whether something is close."""
        self.blocked = msg.data

    def publish(self) -> None:
        """Publish the speed for now."""
        self.speeds.publish(Float64(data=0.0 if self.blocked else self.speed))


class SystemParts(NamedTuple):
    """A system.

    node: its class. delayed: topics to it and services, whose messages and responses can be delayed. shown:
    further topics, on which it publishes, or which answer what it publishes.
    """

    node: type[Node]
    delayed: tuple[str, ...]
    shown: tuple[str, ...]


SYSTEMS: Mapping[str, SystemParts] = {
    "labeler": SystemParts(Labeler, ("scale", "camera"), ("labels",)),
    "dock": SystemParts(Dock, ("arrivals", "open_gate"), ("admitted", "departures")),
    "collector": SystemParts(Collector, ("points", "path_sizes"), ("paths",)),
    "rider": SystemParts(Rider, ("rides", "call_lift", "open_doors"), ("enter",)),
    "job_starter": SystemParts(JobStarter, ("orders", "stops", "start_job"), ("cancels",)),
    "speed_gate": SystemParts(SpeedGate, ("joystick", "close"), ("speed",)),
}
