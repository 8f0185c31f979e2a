"""Nodes that wait, each in its own way, and say in their log when they went on."""

import multiprocessing
import multiprocessing.connection
import os
import sched
import signal
import subprocess
import threading
import time
from datetime import UTC, datetime
from select import select
from time import monotonic, sleep

import rclpy
from rclpy.clock import Clock, ClockChange, ClockType, JumpThreshold, ROSClock
from rclpy.duration import Duration
from rclpy.executors import MultiThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.task import Future
from rclpy.time_source import TimeSource
from std_msgs.msg import Header


class Timers(Node):
    """One timer on each kind of clock."""

    def __init__(self):
        super().__init__("timers")
        kinds = {
            "node": None,
            "steady": Clock(clock_type=ClockType.STEADY_TIME),
            "system": Clock(clock_type=ClockType.SYSTEM_TIME),
            "ros": ROSClock(),
        }
        for name, clock in kinds.items():
            self.create_timer(1.0, lambda name=name: self.get_logger().info(name), clock=clock)


class ResetCancelChange(Node):
    """A timer that is canceled at 1.25 s, started again at 2 s, and made faster at 3.25 s."""

    def __init__(self):
        super().__init__("timer")
        self.timer = self.create_timer(0.5, lambda: self.get_logger().info("tick"))
        self.later(1.25, self.timer.cancel)
        self.later(2.0, self.timer.reset)
        self.later(3.25, self.faster)

    def later(self, seconds, action):
        timer = self.create_timer(seconds, lambda: (timer.cancel(), action()))

    def faster(self):
        self.timer.timer_period_ns = 250_000_000


class Autostart(Node):
    """A timer that only runs once someone resets it."""

    def __init__(self):
        super().__init__("timer")
        timer = self.create_timer(0.5, lambda: self.get_logger().info("tick"), autostart=False)
        starter = self.create_timer(1.0, lambda: (starter.cancel(), timer.reset()))


class SlowCallback(Node):
    """A callback that sleeps 1 s of every 2 s; the fast timer's missed ticks are dropped."""

    def __init__(self):
        super().__init__("slow")
        self.create_timer(0.25, lambda: self.get_logger().info("fast"))
        self.create_timer(2.0, self.slow)

    def slow(self):
        time.sleep(1.0)
        self.get_logger().info("slow")


def sleep_loop():
    rclpy.init()
    node = Node("sleeper")
    for second in range(3):
        node.get_logger().info(str(second))
        time.sleep(0.7)


def early_bound_sleep():
    """`sleep` and `monotonic` were bound by this module, perhaps before sim came."""
    rclpy.init()
    node = Node("sleeper")
    before = monotonic()
    sleep(1.5)
    node.get_logger().info(f"{monotonic() - before:g}")


def rate_in_a_thread():
    """The usual recipe: spin in a thread, a rate in main."""
    rclpy.init()
    node = Node("rated")
    thread = threading.Thread(target=rclpy.spin, args=(node,), daemon=True)
    thread.start()
    rate = node.create_rate(4)
    for _ in range(4):
        rate.sleep()
        node.get_logger().info("rate")
    rclpy.shutdown()
    thread.join()


def rate_in_a_parallel_callback():
    rclpy.init()
    node = Node("rated")
    rate = node.create_rate(2)

    def once():
        timer.cancel()
        for _ in range(3):
            rate.sleep()
            node.get_logger().info("rate")

    timer = node.create_timer(1.0, once)
    executor = MultiThreadedExecutor()
    executor.add_node(node)
    executor.spin()


def clock_sleeps():
    rclpy.init()
    node = Node("clocked")
    clock = node.get_clock()
    begin = clock.now()
    clock.sleep_for(Duration(seconds=1.5))
    node.get_logger().info("for")
    clock.sleep_until(begin + Duration(seconds=4))
    node.get_logger().info("until")
    Clock().sleep_for(Duration(seconds=0.5))
    node.get_logger().info("system")


def selects():
    """Waits for files until one can be read, some seconds at most, or for no file at all."""
    rclpy.init()
    node = Node("selects")
    reading, writing = os.pipe()
    threading.Timer(1.5, os.write, [writing, b"!"]).start()
    for files, timeout in ([], 0.5), ([reading], 0.25), ([reading], 0), ([reading], None), ([reading], 5):
        ready, _, _ = select(files, [], [], timeout)
        node.get_logger().info(f"{len(ready)} ready")
    os.close(reading)
    os.close(writing)


def goes_by_a_schedule():
    rclpy.init()
    node = Node("scheduled")
    plan = sched.scheduler()
    for delay in (1.5, 0.5):
        plan.enter(delay, 1, node.get_logger().info, [f"after {delay}"])
    plan.run()


def waits_for_children():
    """Runs another program, one that is too slow, and a copy of itself."""
    rclpy.init()
    node = Node("parent")
    node.get_logger().info(str(subprocess.run(["true"], timeout=60).returncode))
    try:
        subprocess.run(["sleep", "60"], timeout=0.01)
    except subprocess.TimeoutExpired:
        node.get_logger().info("too slow")
    child = multiprocessing.get_context("fork").Process(target=signal.pause)
    child.start()
    child.join(0.01)
    node.get_logger().info(f"alive: {child.is_alive()}")
    child.kill()
    child.join()
    node.get_logger().info(f"alive: {child.is_alive()}")


def waits_for_a_slow_child():
    rclpy.init()
    Node("parent")
    subprocess.run(["sleep", "60"], check=True)


def waits_for_a_slow_shell():
    rclpy.init()
    Node("parent")
    os.system("sleep 60")


def asks_the_shell():
    rclpy.init()
    Node("parent").get_logger().info(f"{os.system('exit 3')} {os.system('kill -9 $$')}")


def waits_for_what_a_slow_child_prints():
    rclpy.init()
    Node("parent")
    with subprocess.Popen(["sleep", "60"], stdout=subprocess.PIPE) as child:
        try:
            child.communicate()
        finally:
            child.kill()


def waits_for_a_slow_child_with_a_timeout():
    rclpy.init()
    Node("parent")
    with subprocess.Popen(["sleep", "60"]) as child:
        try:
            child.wait(timeout=50)
        finally:
            child.kill()


def waits_for_a_slow_connection():
    rclpy.init()
    Node("parent")
    here, _there = multiprocessing.Pipe()
    multiprocessing.connection.wait([here])


def waits_shortly_for_a_connection():
    rclpy.init()
    node = Node("parent")
    here, there = multiprocessing.Pipe()
    node.get_logger().info(str(len(multiprocessing.connection.wait([here], 0.01))))
    there.send(1)
    node.get_logger().info(str(len(multiprocessing.connection.wait([here]))))


def busy_wait():
    """Waits as one should not: it asks for the time over and over."""
    rclpy.init()
    node = Node("busy")
    start = time.time()
    while time.time() - start < 1.0:
        pass
    node.get_logger().info("over")


def busy_wait_on_the_node_clock():
    rclpy.init()
    node = Node("busy")
    start = node.get_clock().now()
    while node.get_clock().now() - start < Duration(seconds=1.0):
        pass
    node.get_logger().info("over")


def all_clocks():
    """What every clock shows after 2.5 s."""
    rclpy.init()
    node = Node("clocks")
    time.sleep(2.5)
    seconds = {
        "time": time.time() - 1_735_689_600,
        "time_ns": time.time_ns() / 1e9 - 1_735_689_600,
        "gettime": time.clock_gettime(time.CLOCK_REALTIME) - 1_735_689_600,
        "gettime_ns": time.clock_gettime_ns(time.CLOCK_MONOTONIC) / 1e9 - 10_800,
        "monotonic": time.monotonic() - 10_800,
        "perf_counter": time.perf_counter() - 10_800,
        "computing": time.clock_gettime(time.CLOCK_PROCESS_CPUTIME_ID),
        "process_time": time.process_time(),
        "node": node.get_clock().now().nanoseconds / 1e9 - 1_735_689_600,
        "steady": Clock(clock_type=ClockType.STEADY_TIME).now().nanoseconds / 1e9 - 10_800,
        "system": Clock().now().nanoseconds / 1e9 - 1_735_689_600,
    }
    for name, value in seconds.items():
        node.get_logger().info(f"{name} {value:g}")


def looks_back():
    """A second before the start there was time, too: ROS's, the system's and Python's, all the same.

    The steady clock has its own: it counts from when the computer was switched on.
    """
    rclpy.init()
    node = Node("historian")
    steady = Clock(clock_type=ClockType.STEADY_TIME)
    clocks = {"node": node.get_clock(), "ros": ROSClock(), "system": Clock(), "steady": steady}

    def tell():
        for name, clock in clocks.items():
            node.get_logger().info(f"{name} {(clock.now() - Duration(seconds=1)).nanoseconds}")
        node.get_logger().info(f"time {time.time_ns() - 1_000_000_000} {time.time() - 1.0}")

    tell()
    node.create_timer(0.25, tell)
    rclpy.spin(node)


def knows_when_a_message_came():
    """What a subscription's second argument says is by the same clock."""
    rclpy.init()
    node = Node("clerk")
    publisher = node.create_publisher(Header, "minutes", 10)
    node.create_timer(0.5, lambda: publisher.publish(Header(stamp=node.get_clock().now().to_msg())))

    def on_message(msg, information):
        sent, came = information["source_timestamp"], information["received_timestamp"]
        node.get_logger().info(f"{msg.stamp.sec} {msg.stamp.nanosec} {sent} {came}")

    node.create_subscription(Header, "minutes", on_message, 10)
    rclpy.spin(node)


def calendar():
    """The clock that people read."""
    rclpy.init()
    node = Node("calendar")
    time.sleep(3661)
    node.get_logger().info(time.strftime("%Y-%m-%d %H:%M:%S", time.gmtime()))


def date_and_time():
    rclpy.init()
    node = Node("calendar")
    time.sleep(3661)
    node.get_logger().info(datetime.now(UTC).strftime("%Y-%m-%d %H:%M:%S"))


def throttled_log():
    rclpy.init()
    node = Node("chatty")
    for count in range(10):
        node.get_logger().info(f"throttled {count}", throttle_duration_sec=1.0)
        node.get_logger().info("once", once=True)
        node.get_logger().info(f"not the first {count}", skip_first=True)
        time.sleep(0.25)


def three_timeouts():
    """Waits three times 0.2 s for what never comes."""
    rclpy.init()
    node = Node("waiting")
    for _ in range(3):
        rclpy.spin_until_future_complete(node, Future(), timeout_sec=0.2)
        node.get_logger().info("timeout")


class JumpCallbacks(Node):
    """Registers for jumps in time: by a clock that goes out of scope at once, and by two that stay.

    No one keeps the handle of the second, and the third's callback raises.
    """

    def __init__(self):
        super().__init__("jumps")
        self.clock = ROSClock()
        self.tell_jumps(ROSClock(), lambda jump: self.get_logger().info("gone"))
        self.tell_jumps(self.get_clock(), lambda jump: self.get_logger().info("node"))
        self.kept = self.tell_jumps(self.clock, lambda jump: 1 / 0)
        self.create_timer(0.5, lambda: self.get_logger().info(f"tick {self.clock.now().nanoseconds}"))

    def tell_jumps(self, clock, callback):
        threshold = JumpThreshold(min_forward=Duration(nanoseconds=1), min_backward=None)
        return clock.create_jump_callback(threshold, post_callback=callback)


class SwitchesTime(Node):
    """Sets `use_sim_time` at 0.5 s and at 1 s, and takes it back at 1.5 s; its clock tells before and after.

    No one keeps the handle of the second, and the third is unregistered. The fourth asks for jumps alone.
    """

    def __init__(self):
        super().__init__("switches")
        self.values = iter([True, True, False])
        self.kept = self.tell("kept")
        self.tell("gone")
        self.tell("unregistered").unregister()
        self.fourth = self.tell("jumps", min_forward=Duration(nanoseconds=1), on_clock_change=False)
        self.timer = self.create_timer(0.5, self.switch)

    def tell(self, name, min_forward=None, on_clock_change=True):
        say = self.get_logger().info
        clock = self.get_clock()
        return clock.create_jump_callback(
            JumpThreshold(min_forward=min_forward, min_backward=None, on_clock_change=on_clock_change),
            pre_callback=lambda: say(f"{name} before: {clock.ros_time_is_active}"),
            post_callback=lambda jump: say(
                f"{name} after: {clock.ros_time_is_active}, {ClockChange(jump.clock_change).name}"
            ),
        )

    def switch(self):
        value = next(self.values, None)
        if value is None:
            self.timer.cancel()
        else:
            self.set_parameters([Parameter("use_sim_time", value=value)])
            self.get_logger().info(f"{self.get_clock().now().nanoseconds}")


def switch_ends_a_sleep():
    """The time that was slept for loses its meaning: the sleep ends, and says that it did not get there."""
    rclpy.init()
    node = Node("sleeper")
    node.create_timer(0.5, lambda: node.set_parameters([Parameter("use_sim_time", value=True)]))
    threading.Thread(target=rclpy.spin, args=[node], daemon=True).start()
    for _ in range(2):
        node.get_logger().info(str(node.get_clock().sleep_for(Duration(seconds=2))))


def clock_of_a_time_source():
    """What is attached to a time source follows its switch."""
    rclpy.init()
    node = Node("source")
    source, clock = TimeSource(node=node), ROSClock()
    for value in (True, False):
        node.set_parameters([Parameter("use_sim_time", value=value)])
        source.attach_clock(clock)
        node.get_logger().info(str(clock.ros_time_is_active))
