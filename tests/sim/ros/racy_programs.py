"""Programs that are right only in some orders, each with a twin that is right in all."""

import threading
import time
from collections.abc import Callable
from typing import Any, NamedTuple

import rclpy
from geometry_msgs.msg import PointStamped, Twist
from rclpy.callback_groups import MutuallyExclusiveCallbackGroup, ReentrantCallbackGroup
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.qos import DurabilityPolicy, QoSProfile
from std_msgs.msg import Int32, String
from std_srvs.srv import Trigger

LATCHED = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)


class Sensor(Node):
    """Publishes a number on /a and on /b, and the same with stamps, ten times a second."""

    def __init__(self) -> None:
        super().__init__("sensor")
        self.number = 0
        self.plain = [self.create_publisher(Int32, topic, 10) for topic in ("a", "b")]
        self.stamped = [self.create_publisher(PointStamped, topic, 10) for topic in ("left", "right")]
        self.create_timer(0.1, self.tick)

    def tick(self) -> None:
        self.number += 1
        point = PointStamped()
        point.header.stamp = self.get_clock().now().to_msg()
        point.point.x = float(self.number)
        for publisher in self.plain:
            publisher.publish(Int32(data=self.number))
        for publisher in self.stamped:
            publisher.publish(point)


# -- pairing by arrival --------------------------------------------------------------------------


class PairsByArrival(Node):
    """Pairs the newest /a with each /b."""

    def __init__(self) -> None:
        super().__init__("pairs")
        self.last = None
        self.create_subscription(Int32, "a", self.on_a, 10)
        self.create_subscription(Int32, "b", self.on_b, 10)

    def on_a(self, message: Int32) -> None:
        self.last = message

    def on_b(self, message: Int32) -> None:
        assert self.last.data == message.data


class PairsByStamp(Node):
    """Pairs what has one stamp."""

    def __init__(self) -> None:
        super().__init__("pairs")
        self.waiting: dict[tuple[int, int], PointStamped] = {}
        for topic in ("left", "right"):
            self.create_subscription(PointStamped, topic, self.on_point, 10)

    def on_point(self, message: PointStamped) -> None:
        stamp = message.header.stamp.sec, message.header.stamp.nanosec
        if stamp in self.waiting:
            assert self.waiting.pop(stamp).point.x == message.point.x
        else:
            self.waiting[stamp] = message


# -- a value that is not there yet -----------------------------------------------------------------


class UsesUnset(Node):
    """Uses in one callback what another one sets first, on another topic."""

    def __init__(self) -> None:
        super().__init__("unset")
        self.create_subscription(Int32, "a", self.on_a, 10)
        self.create_subscription(Int32, "b", self.on_b, 10)

    def on_a(self, message: Int32) -> None:
        self.offset = message.data

    def on_b(self, message: Int32) -> None:
        self.get_logger().info(f"{message.data - self.offset}")


class WaitsUntilSet(UsesUnset):
    """The same, but it looks whether the value is there."""

    offset = None

    def on_b(self, message: Int32) -> None:
        if self.offset is not None:
            super().on_b(message)


# -- two timers of one node, which nothing but rclpy's habit orders (level any) ---------------------


class TwoTimers(Node):
    """One timer measures, the other sends what was measured."""

    def __init__(self) -> None:
        super().__init__("two_timers")
        self.measured, self.sent = 0, 0
        self.create_timer(0.1, self.measure)
        self.create_timer(0.1, self.send)

    def measure(self) -> None:
        self.measured += 1

    def send(self) -> None:
        self.sent += 1
        assert self.measured == self.sent


class OneTimer(TwoTimers):
    """One timer does both."""

    def __init__(self) -> None:
        Node.__init__(self, "one_timer")
        self.measured, self.sent = 0, 0
        self.create_timer(0.1, self.both)

    def both(self) -> None:
        self.measure()
        self.send()


# -- a diamond -------------------------------------------------------------------------------------


class Square(Node):
    """Publishes the square of /a on /squared."""

    def __init__(self) -> None:
        super().__init__("square")
        self.publisher = self.create_publisher(Int32, "squared", 10)
        self.create_subscription(Int32, "a", self.on_a, 10)

    def on_a(self, message: Int32) -> None:
        self.publisher.publish(Int32(data=message.data**2))


class DiamondSink(Node):
    """Takes it that a number comes before its square."""

    def __init__(self) -> None:
        super().__init__("sink")
        self.newest = 0
        self.create_subscription(Int32, "squared", self.on_squared, 10)
        self.create_subscription(Int32, "a", self.on_a, 10)

    def on_a(self, message: Int32) -> None:
        self.newest = message.data

    def on_squared(self, message: Int32) -> None:
        assert message.data == self.newest**2


class PatientSink(DiamondSink):
    """Keeps what came first until the other is there."""

    def __init__(self) -> None:
        super().__init__()
        self.numbers: set[int] = set()
        self.squares: set[int] = set()

    def on_a(self, message: Int32) -> None:
        self.numbers.add(message.data)
        self.match()

    def on_squared(self, message: Int32) -> None:
        self.squares.add(message.data)
        self.match()

    def match(self) -> None:
        done = {number for number in self.numbers if number**2 in self.squares}
        self.numbers -= done
        self.squares -= {number**2 for number in done}


# -- two drivers of one topic ------------------------------------------------------------------------


class Driver(Node):
    """Drives at 0.2 m/s."""

    def __init__(self) -> None:
        super().__init__("driver")
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_timer(0.1, self.drive)

    def drive(self) -> None:
        command = Twist()
        command.linear.x = 0.2
        self.publisher.publish(command)


class Brake(Driver):
    """Stops the robot at the same times."""

    def __init__(self) -> None:
        Node.__init__(self, "brake")
        self.publisher = self.create_publisher(Twist, "cmd_vel", 10)
        self.create_timer(0.1, self.drive)

    def drive(self) -> None:
        self.publisher.publish(Twist())


class LastCommandWins(Node):
    """Takes it that the brake's command is always the last of a moment."""

    def __init__(self) -> None:
        super().__init__("base")
        self.command = Twist()
        self.create_subscription(Twist, "cmd_vel", self.on_command, 10)
        self.create_timer(0.1, self.move)
        self.moves = 0

    def on_command(self, message: Twist) -> None:
        self.command = message

    def move(self) -> None:
        self.moves += 1
        assert self.command.linear.x == 0 or self.moves < 10


class SlowestCommandWins(LastCommandWins):
    """Takes the slowest command of each period; both have been there for long by then."""

    def __init__(self) -> None:
        super().__init__()
        self.slowest = 0.0

    def on_command(self, message: Twist) -> None:
        self.slowest = min(self.slowest, message.linear.x)

    def move(self) -> None:
        assert self.slowest == 0
        self.slowest = 0.0


# -- starts --------------------------------------------------------------------------------------


class AnnouncesOnce(Node):
    """Says once, 0.3 s after its start, where to go."""

    qos: Any = 10

    def __init__(self) -> None:
        super().__init__("announcer")
        self.publisher = self.create_publisher(String, "target", self.qos)
        self.timer = self.create_timer(0.3, self.announce)

    def announce(self) -> None:
        self.publisher.publish(String(data="kitchen"))
        self.timer.cancel()


class AnnouncesLatched(AnnouncesOnce):
    """The same for all who come later."""

    qos = LATCHED


class NeedsTarget(Node):
    """Has to know the target two seconds after its start."""

    qos: Any = 10

    def __init__(self) -> None:
        super().__init__("needs_target")
        self.target = ""
        self.create_subscription(String, "target", self.on_target, self.qos)
        self.create_timer(2.0, self.go)

    def on_target(self, message: String) -> None:
        self.target = message.data

    def go(self) -> None:
        assert self.target == "kitchen"


class NeedsLatchedTarget(NeedsTarget):
    """Subscribes to what was said before."""

    qos = LATCHED


class Server(Node):
    """A service."""

    def __init__(self) -> None:
        super().__init__("server")
        self.create_service(Trigger, "trigger", self.answer)

    def answer(self, request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        response.success = True
        return response


class CallsAtOnce(Node):
    """Takes it that the server is there after 0.2 s."""

    def __init__(self) -> None:
        super().__init__("caller")
        self.client = self.create_client(Trigger, "trigger")
        self.timer = self.create_timer(0.2, self.call)

    def call(self) -> None:
        assert self.client.service_is_ready()
        self.client.call_async(Trigger.Request())
        self.timer.cancel()


class CallsWhenReady(CallsAtOnce):
    """Tries again until it is there."""

    def call(self) -> None:
        if self.client.service_is_ready():
            super().call()


class CountsFromOne(Node):
    """Takes it that it sees a publisher's first message."""

    def __init__(self) -> None:
        super().__init__("counts")
        self.seen = 0
        self.create_subscription(Int32, "a", self.on_a, 10)

    def on_a(self, message: Int32) -> None:
        self.seen += 1
        assert message.data == self.seen


class CountsOn(CountsFromOne):
    """Begins with the first number that it sees: one publisher's messages come in their order."""

    def on_a(self, message: Int32) -> None:
        self.seen = self.seen or message.data - 1
        super().on_a(message)


# -- threads -----------------------------------------------------------------------------------------


class LosesUpdates(Node):
    """Two threads count with one number."""

    def __init__(self) -> None:
        super().__init__("counter")
        self.count, self.lock = 0, threading.Lock()
        self.workers = [threading.Thread(target=self.work) for _ in range(2)]
        for worker in self.workers:
            worker.start()
        self.create_timer(0.5, self.look)

    def work(self) -> None:
        for _ in range(10):
            self.increment()
            time.sleep(0.01)

    def increment(self) -> None:
        count = self.count
        self.count = count + 1

    def look(self) -> None:
        if not any(worker.is_alive() for worker in self.workers):
            assert self.count == 20


class CountsUnderLock(LosesUpdates):
    """The same under a lock."""

    def increment(self) -> None:
        with self.lock:
            super().increment()


class ChecksThenActs(Node):
    """A thread looks whether there is a job, and then takes it, while the timer withdraws jobs."""

    def __init__(self) -> None:
        super().__init__("jobs")
        self.job: str | None = None
        self.lock = threading.Lock()
        self.create_timer(0.02, self.change)
        threading.Thread(target=self.work, daemon=True).start()

    def change(self) -> None:
        self.job = None if self.job else "sweep"

    def work(self) -> None:
        while rclpy.ok():
            self.take()
            time.sleep(0.005)

    def take(self) -> None:
        if self.job is not None:
            job = self.job
            job.upper()


class ActsOnCopy(ChecksThenActs):
    """Looks at a copy that nothing changes."""

    def take(self) -> None:
        job = self.job
        if job is not None:
            job.upper()


class Parallel(Node):
    """Two timers of different groups move one amount between two accounts."""

    def __init__(self) -> None:
        super().__init__("parallel")
        self.left, self.right, self.lock = 100, 0, threading.Lock()
        groups = self.groups()
        self.create_timer(0.05, self.to_right, callback_group=groups[0])
        self.create_timer(0.05, self.look, callback_group=groups[1])

    def groups(self) -> list[Any]:
        return [MutuallyExclusiveCallbackGroup(), MutuallyExclusiveCallbackGroup()]

    def to_right(self) -> None:
        self.left -= 1
        self.right += 1

    def look(self) -> None:
        total = self.left + self.right
        assert total == 100


class OneGroup(Parallel):
    """The same in one group, whose callbacks exclude each other."""

    def groups(self) -> list[Any]:
        return [MutuallyExclusiveCallbackGroup()] * 2


class ParallelUnderLock(Parallel):
    """The same in parallel, under a lock."""

    def groups(self) -> list[Any]:
        return [ReentrantCallbackGroup()] * 2

    def to_right(self) -> None:
        with self.lock:
            super().to_right()

    def look(self) -> None:
        with self.lock:
            super().look()


def in_parallel(node: Callable[[], Node]) -> Callable[[], None]:
    """A main() that spins a node with several threads."""

    def main() -> None:
        rclpy.init()
        executor = MultiThreadedExecutor()
        executor.add_node(node())
        executor.spin()

    main.__name__ = node.__name__
    return main


class TwoLocks(Node):
    """Two threads take two locks, in different orders: now and then each waits for the other."""

    def __init__(self) -> None:
        super().__init__("two_locks")
        self.a, self.b, self.done = threading.Lock(), threading.Lock(), 0
        for work in self.works():
            threading.Thread(target=work, daemon=True).start()
        self.create_timer(1.5, self.look)

    def works(self) -> list[Callable[[], None]]:
        return [lambda: self.work(self.a, self.b), lambda: self.work(self.b, self.a)]

    def work(self, first: threading.Lock, second: threading.Lock) -> None:
        for _ in range(5):
            with first:
                self.done += 0
                with second:
                    self.done += 1
            time.sleep(0.01)

    def look(self) -> None:
        assert self.done == 10


class OneOrderOfLocks(TwoLocks):
    """Both take them in one order."""

    def works(self) -> list[Callable[[], None]]:
        return [lambda: self.work(self.a, self.b)] * 2


class MapBeforeScan(Node):
    """Takes it that the map, which is sent once, is there before the first scan."""

    def __init__(self) -> None:
        super().__init__("localizer")
        self.map = None
        self.create_subscription(Int32, "map", self.on_map, LATCHED)
        self.create_subscription(Int32, "scan", self.on_scan, 10)

    def on_map(self, message: Int32) -> None:
        self.map = message

    def on_scan(self, message: Int32) -> None:
        assert self.map is not None


class MapThenScan(MapBeforeScan):
    """Leaves out the scans before the map."""

    def on_scan(self, message: Int32) -> None:
        if self.map is not None:
            super().on_scan(message)


class MapServer(Node):
    """Publishes a map once."""

    def __init__(self) -> None:
        super().__init__("map_server")
        self.create_publisher(Int32, "map", LATCHED).publish(Int32(data=1))


class Lidar(Node):
    """Publishes scans."""

    def __init__(self) -> None:
        super().__init__("lidar")
        self.publisher = self.create_publisher(Int32, "scan", 10)
        self.create_timer(0.1, lambda: self.publisher.publish(Int32(data=1)))


class Racy(NamedTuple):
    """Programs that fail in some order, and twins that never do. level: at which it varies."""

    wrong: tuple[Any, ...]
    right: tuple[Any, ...]
    level: str = "network"
    seconds: float = 2.0


PROGRAMS = {
    "pairing": Racy((PairsByArrival, Sensor), (PairsByStamp, Sensor)),
    "unset": Racy((UsesUnset, Sensor), (WaitsUntilSet, Sensor)),
    "timers": Racy((TwoTimers,), (OneTimer,), "any"),
    "diamond": Racy((DiamondSink, Square, Sensor), (PatientSink, Square, Sensor)),
    "drivers": Racy((LastCommandWins, Driver, Brake), (SlowestCommandWins, Driver, Brake)),
    "announced": Racy((NeedsTarget, AnnouncesOnce), (NeedsLatchedTarget, AnnouncesLatched), seconds=3.0),
    "service": Racy((CallsAtOnce, Server), (CallsWhenReady, Server)),
    "first": Racy((CountsFromOne, Sensor), (CountsOn, Sensor)),
    "map": Racy((MapBeforeScan, MapServer, Lidar), (MapThenScan, MapServer, Lidar)),
    "updates": Racy((LosesUpdates,), (CountsUnderLock,), "host"),
    "check": Racy((ChecksThenActs,), (ActsOnCopy,), "host"),
    "groups": Racy((in_parallel(Parallel),), (in_parallel(OneGroup),), "host"),
    "reentrant": Racy((in_parallel(Parallel),), (in_parallel(ParallelUnderLock),), "network"),
    "locks": Racy((TwoLocks,), (OneOrderOfLocks,), "host"),
}
