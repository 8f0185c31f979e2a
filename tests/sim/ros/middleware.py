"""What Fast DDS does between two processes, outside of any run: `python -m tests.sim.ros.middleware`.

Prints what stands below the first line of dashes in middleware_facts.txt. A listener and a speaker, each a
process of its own, print their events and when, in seconds; R is the reader and W the writer.
"""

import json
import os
import signal
import subprocess
import sys
import time

import rclpy
from rclpy.duration import Duration
from rclpy.event_handler import PublisherEventCallbacks, SubscriptionEventCallbacks
from rclpy.node import Node
from rclpy.qos import (
    DurabilityPolicy,
    HistoryPolicy,
    LivelinessPolicy,
    QoSProfile,
    ReliabilityPolicy,
    qos_policy_name_from_kind,
)
from std_msgs.msg import String

from tests.patience import PATIENCE
from tests.sim.ros.one_sided import ONE_SIDED

COUNTS = "total_count", "alive_count", "not_alive_count"
BEGIN = 0.0  # of a case, by the clock on the wall
UNTIL_BEGIN = 2.0  # s: from the moment at which both have found each other
HURRIED = QoSProfile(depth=10, deadline=Duration(seconds=0.2))
LEASE = Duration(seconds=0.5)
LEASED = QoSProfile(depth=10, liveliness_lease_duration=LEASE)
LONG_LEASE = QoSProfile(depth=10, liveliness_lease_duration=Duration(seconds=1))
BY_HAND = QoSProfile(depth=10, liveliness=LivelinessPolicy.MANUAL_BY_TOPIC, liveliness_lease_duration=LEASE)
SLOPPY_BY_HAND = QoSProfile(
    depth=10,
    reliability=ReliabilityPolicy.BEST_EFFORT,
    liveliness=LivelinessPolicy.MANUAL_BY_TOPIC,
    liveliness_lease_duration=LEASE,
)
BRIEF = QoSProfile(depth=50, lifespan=LEASE, durability=DurabilityPolicy.TRANSIENT_LOCAL)
ALL = QoSProfile(history=HistoryPolicy.KEEP_ALL)
SLOPPY = QoSProfile(depth=500, reliability=ReliabilityPolicy.BEST_EFFORT)

# For each case what both ends have, and what the speaker does: at a time of the case ("stop" the listener).
CASES = {
    "deadline": (
        HURRIED, HURRIED, [
            (1.0, "say"), (1.1, "say"), (1.25, "say"), (1.4, "say"), (2.15, "say"), (2.7, "leave"),
        ],
    ),
    "no lease": (10, 10, [(1.0, "say"), (1.5, "leave")]),
    "automatic, leaves": (LEASED, LEASED, [(1.5, "leave")]),
    "automatic, is killed": (LEASED, LEASED, [(1.5, "die")]),
    "automatic, sleeps in a callback": (LEASED, LEASED, [(1.0, "sleep"), (2.5, "leave")]),
    "by hand": (
        BY_HAND, BY_HAND, [(1.5, "say"), (1.8, "assert"), (3.0, "assert"), (4.0, "say"), (4.2, "leave")],
    ),
    "by hand, best effort": (SLOPPY_BY_HAND, SLOPPY_BY_HAND, [(1.5, "say"), (1.8, "assert"), (3.2, "leave")]),
    "by hand, any asked for": (LONG_LEASE, BY_HAND, [(1.5, "say"), (3.2, "leave")]),
    "lifespan in the queue": (BRIEF, BRIEF, [(0.5, "say"), (0.7, "say"), (1.0, "say"), (2.0, "leave")]),
    "keep all, listener stopped": (ALL, ALL, [(1.0, "stop"), (1.2, "flood"), (2.0, "go on"), (2.5, "leave")]),
    "depth 5, listener stopped": (500, 5, [(1.0, "stop"), (1.2, "heap"), (2.0, "go on"), (5.5, "leave")]),
    "best effort, listener stopped": (
        SLOPPY, SLOPPY, [(1.0, "stop"), (1.2, "heap"), (2.0, "go on"), (2.5, "say"), (3.0, "leave")],
    ),
    "all acknowledged": (10, 10, [(1.0, "say"), (1.1, "wait"), (5.0, "leave")]),
    **ONE_SIDED,
}  # fmt: skip
OWN_PROCESS = __name__ == "__main__"
JOINS = 1.0  # s: when the listener of a case on durability, or of a late joiner, makes its subscription
HEARTBEAT = "at once, or with the writer's heartbeat within 3 s"  # both occur, on an idle machine, too
SLEEPS = 0.8  # s: in the callback of a message, or of the first one where the history is measured


def now() -> float:
    return time.time() - BEGIN


def say(*words: object) -> None:
    print(json.dumps([round(now(), 3), " ".join(map(str, words))]), flush=True)


def reported(word: str):
    def tell(event: object) -> None:
        found = [name for name in COUNTS if hasattr(event, name)]
        if hasattr(event, "last_policy_kind"):
            say(f"{word} {qos_policy_name_from_kind(event.last_policy_kind)}")
            return
        say(word, *(f"{getattr(event, name)} ({getattr(event, name + '_change'):+d})" for name in found))

    return tell


def spin(node: Node, until: float) -> None:
    while now() < until:
        rclpy.spin_once(node, timeout_sec=min(0.005, max(until - now(), 0)))


def met(name: str, other: str) -> Node:
    """A node that has found the other one; in a process of its own it learns when the case begins."""
    global BEGIN
    node = Node(name)
    while other not in node.get_node_names():
        time.sleep(0.05)
    if OWN_PROCESS:
        print("met", flush=True)
        BEGIN = float(sys.stdin.readline())
    return node


def listen(case: str) -> None:
    """The listener of a case."""
    node, count = met("listener", "speaker"), [0]
    joins_late = case.startswith("durability") or case.endswith("late joiner")
    events = SubscriptionEventCallbacks(
        deadline=reported("requested"),
        liveliness=reported("changed"),
        message_lost=reported("missed"),
        incompatible_qos=reported("is offered another"),
    )

    def on_message(msg: String) -> None:
        count[0] += 1
        if case.startswith(("lifespan", "durability")):
            say("receives", msg.data)
        if (case.startswith("lifespan") and not joins_late) or (case.startswith("history") and count[0] == 1):
            time.sleep(SLEEPS)

    if joins_late:
        spin(node, JOINS)
    node.create_subscription(String, "facts", on_message, CASES[case][0], event_callbacks=events)
    spin(node, CASES[case][2][-1][0] + 0.6)
    say("has received", "some" if count[0] > 10 and case.endswith("stopped") else count[0])


def speak(case: str) -> None:
    """The speaker of a case."""
    node = met("speaker", "listener")
    events = PublisherEventCallbacks(
        deadline=reported("offered"),
        liveliness=reported("lost"),
        incompatible_qos=reported("is asked for another"),
    )
    publisher = node.create_publisher(String, "facts", CASES[case][1], event_callbacks=events)
    for stamp, what in CASES[case][2]:
        spin(node, stamp)
        if what in ("stop", "go on"):
            os.kill(int(os.environ["FACTS_LISTENER"]), signal.SIGSTOP if what == "stop" else signal.SIGCONT)
        DEEDS[what](node, publisher)


def flood(_: Node, publisher: object) -> None:
    begin = time.time()
    for number in range(1, 6000):
        try:
            publisher.publish(String(data="x"))
            begin = time.time()
        except Exception as error:
            say(f"message {number} was refused after {time.time() - begin:.1f} s: {error}")
            return


def heap(_: Node, publisher: object) -> None:
    for _ in range(3000):
        publisher.publish(String(data="x" * 2000))


def wait(_: Node, publisher: object) -> None:
    begin = time.time()
    done = publisher.wait_for_all_acked(Duration(seconds=5))
    waited = time.time() - begin
    say(f"all acknowledged: {done},", HEARTBEAT if waited < 3.3 else f"after {waited:.1f} s")


def leave(node: Node, _: object) -> None:
    node.destroy_node()
    rclpy.shutdown()
    say("leaves")


def die(*_: object) -> None:
    say("dies")
    os.kill(os.getpid(), signal.SIGKILL)


DEEDS = {
    "say": lambda node, publisher: publisher.publish(String(data=f"{now():.1f}")),
    "assert": lambda node, publisher: publisher.assert_liveliness(),
    "sleep": lambda node, publisher: time.sleep(1.4),
    "stop": lambda node, publisher: say("the listener is stopped"),
    "go on": lambda node, publisher: say("the listener goes on"),
    "flood": flood,
    "heap": heap,
    "burst": lambda node, publisher: [publisher.publish(String(data="x")) for _ in range(20)],
    "wait": wait,
    "leave": leave,
    "die": die,
}


def observe(case: str) -> list[tuple[float, str, str]]:
    """(seconds, R or W, words) of all that both sides printed."""
    settings = {
        "ROS_DOMAIN_ID": "97",
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "FASTDDS_BUILTIN_TRANSPORTS": "UDPv4",
    }
    sides: list[subprocess.Popen] = []
    for side in ("listen", "speak"):
        words = [sys.executable, "-m", "tests.sim.ros.middleware", side, case]
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
        sides.append(subprocess.Popen(words, env=os.environ | settings, text=True, **pipes))
        settings["FACTS_LISTENER"] = str(sides[0].pid)
    assert [side.stdout.readline() for side in sides] == ["met\n"] * 2
    begin, logged = time.time() + UNTIL_BEGIN, []
    for side in sides:
        side.stdin.write(f"{begin}\n")
        side.stdin.flush()
    for who, side in zip("RW", sides, strict=True):
        out, _ = side.communicate(timeout=PATIENCE)
        logged += [(stamp, who, words) for stamp, words in map(json.loads, out.splitlines())]
    return sorted(logged)


def main(words: list[str]) -> None:
    """One side of a case; or all cases, or those of these names."""
    if words[:1] in (["listen"], ["speak"]):
        rclpy.init()
        {"listen": listen, "speak": speak}[words[0]](words[1])
        return
    for case in words or CASES:
        print(f"== {case}")
        for stamp, who, logged in observe(case):
            print(f"{stamp:5.1f} {who} {logged}")


if __name__ == "__main__":
    main(sys.argv[1:])
